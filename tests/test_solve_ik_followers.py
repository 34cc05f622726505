"""A success keeps every joint inside its limits, the joints that follow another as well."""

from math import cos, sin

import numpy as np
import pytest

from robotics1 import IKSolver, PositionTask, ik_solutions, iterate_ik, load_robot

XY = PositionTask("xy")


def follower_arm(folder, leader, follower, multiplier, least=None):
    """A planar 2R whose second joint turns as the first one does, times a multiplier."""
    path = folder / "follower.urdf"
    path.write_text(
        f"""<robot name="follower"><link name="base"/><link name="a"/><link name="b"/><link name="tool"/>
        <joint name="q1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
        <limit lower="{-leader if least is None else least}" upper="{leader}" velocity="1" effort="1"/></joint>
        <joint name="q2" type="revolute"><parent link="a"/><child link="b"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
        <limit lower="{-follower}" upper="{follower}" velocity="1" effort="1"/>
        <mimic joint="q1" multiplier="{multiplier}"/></joint>
        <joint name="tip" type="fixed"><parent link="b"/><child link="tool"/><origin xyz="0.8 0 0"/></joint>
        </robot>""",
        encoding="utf-8",
    )
    return load_robot(path, tool="tool")


def tip(q1, multiplier):
    return np.array([cos(q1) + 0.8 * cos(q1 + multiplier * q1), sin(q1) + 0.8 * sin(q1 + multiplier * q1)])


@pytest.mark.parametrize("multiplier", [1.0, -0.5, 2.0])
def test_targets_inside_the_limits_of_both_are_reached_inside_them(tmp_path, multiplier):
    robot = follower_arm(tmp_path, 0.4, 0.9, multiplier)
    reach = min(float(robot.upper[0]), 0.9 / abs(multiplier), 0.4)
    for q1 in np.linspace(-reach, reach, 7):
        found = IKSolver(robot, XY)(tip(q1, multiplier))
        assert found.converged
        assert robot.within_limits(found.q, tolerance=0.0)
        assert abs(found.q[0]) <= 0.4
        assert abs(multiplier * found.q[0]) <= 0.9 + 1e-9
        every = ik_solutions(robot, XY, tip(q1, multiplier), starts=10)
        assert every.within_limits.all()
        assert np.abs(every.q[:, 0] - q1).min() < 1e-6


def test_a_leader_far_from_zero_whose_follower_comes_round_after_two_turns_is_searched_where_it_can_be(tmp_path):
    robot = follower_arm(tmp_path, 1e6, 1e6, 0.5, least=20)
    target = tip(25.0, 0.5)
    found = IKSolver(robot, XY)(target)
    assert found.converged
    assert robot.within_limits(found.q, tolerance=0.0)
    assert np.abs(tip(found.q[0], 0.5) - target).max() < 1e-6
    assert ik_solutions(robot, XY, target, starts=10).within_limits.all()


def test_beyond_the_limits_of_the_robot_there_is_no_success_and_an_iteration_says_so(tmp_path):
    robot = follower_arm(tmp_path, 0.4, 0.9, 1.0)
    target = tip(0.6, 1.0)
    assert not IKSolver(robot, XY, time_limit=0.05)(target).converged
    assert not len(ik_solutions(robot, XY, target, starts=10))
    run = iterate_ik(robot, XY, target, [0.55], method="pseudoinverse")
    assert run.converged
    assert not run.within_limits
