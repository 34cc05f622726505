"""A robot whose joints follow others is the same after it was pickled: Pinocchio alone loses what a follower does."""

import copy
import pickle

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given
from mimic_arms import text_of, trees

import robotics1 as r1

LATE = """<robot name="late"><link name="base"/><link name="a"/><link name="tool"/>
<joint name="front" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 0.6 0.8"/>
<mimic joint="back" multiplier="0.5" offset="0.1"/></joint>
<joint name="back" type="continuous"><parent link="a"/><child link="tool"/><axis xyz="1 0 0"/>
<origin xyz="0.3 0.1 0"/></joint></robot>"""  # the leader stands behind its follower


def alike(robot, other):
    q, qdot = np.linspace(-1, 1, robot.nq), np.linspace(0.5, -0.5, robot.nv)
    assert other.model == robot.model
    for question in (lambda x: r1.forward_kinematics(x, q).homogeneous, lambda x: r1.frame_jacobian(x, q)):
        assert np.array_equal(question(other), question(robot))
    rates = [r1.frame_jacobian_rate(x, q, qdot) for x in (robot, other)]
    assert np.array_equal(*rates)
    torques = [pin.rnea(x.model, x.model.createData(), q, qdot, qdot) for x in (robot, other)]
    assert np.array_equal(*torques)


@given(trees())
def test_a_tree_with_followers_is_the_same_after_pickling_and_copying(joints):
    robot = r1.load_robot(text_of(joints))
    for other in (pickle.loads(pickle.dumps(robot)), copy.deepcopy(robot), copy.copy(robot)):
        alike(robot, other)
    alike(robot, pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(robot)))))


def test_a_follower_before_its_leader_is_the_same_after_pickling():
    robot = r1.load_robot(LATE)
    alike(robot, pickle.loads(pickle.dumps(robot)))


@pytest.mark.parametrize(
    "robot",
    [
        r1.textbook_robots.planar_arm("RPR", ["l1", 0.5], parameters={"l1": 0.4}, absolute=True),
        r1.rigid_motions.robot_from_screws(np.eye(4), space=[([0, 0, 1], [0, -0.4, 0.1])]),
    ],
)
def test_absolute_angles_and_helical_joints_are_followers_too(robot):
    alike(robot, pickle.loads(pickle.dumps(robot)))
