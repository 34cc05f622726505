"""Robots from the screws of their joints, against a plain product of exponentials and Pinocchio's own joints."""

from math import inf, pi, sqrt

import numpy as np
import pinocchio as pin
import product_of_exponentials as poe
import pytest
from arms import ARMS, arm, random_q
from hypothesis import given, strategies as st

import robotics1 as r1
from robotics1.rigid_motions import robot_from_screws, screws

L1, L2 = 0.425, 0.392
HOME = np.array([[-1, 0, 0, L1 + L2], [0, 0, 1, 0.191], [0, 1, 0, -0.006], [0, 0, 0, 1]])
UR5 = [  # Lynch and Park 2017, example 4.5: W1 = 0.109, W2 = 0.082, H1 = 0.089, H2 = 0.095
    ([0, 0, 1], [0, 0, 0]),
    ([0, 1, 0], [-0.089, 0, 0]),
    ([0, 1, 0], [-0.089, 0, L1]),
    ([0, 1, 0], [-0.089, 0, L1 + L2]),
    ([0, 0, -1], [-0.109, L1 + L2, 0]),
    ([0, 1, 0], [0.006, 0, L1 + L2]),
]
vectors = st.tuples(*[st.floats(-1, 1)] * 3)
axes = vectors.filter(lambda w: np.linalg.norm(w) > 0.1).map(lambda w: np.array(w) / np.linalg.norm(w))


@st.composite
def joint_screws(draw):
    """A revolute, a prismatic or a helical joint, as (w, v)."""
    w, kind = draw(axes), draw(st.sampled_from("RRPH"))
    if kind == "P":
        return np.zeros(3), w
    return w, -np.cross(w, draw(vectors)) + (draw(st.floats(-0.5, 0.5)) * w if kind == "H" else 0)


def linear_first(pairs):
    return [np.concatenate([v, w]) for w, v in pairs]


def test_the_ur5_of_lynch_and_park_is_at_its_published_pose():
    robot = robot_from_screws(HOME, space=UR5)
    T = r1.forward_kinematics(robot, [0, -pi / 2, 0, 0, pi / 2, 0]).homogeneous
    wanted = [[0, -1, 0, 0.095], [1, 0, 0, 0.109], [0, 0, 1, 0.988], [0, 0, 0, 1]]
    assert pytest.approx(np.array(wanted), abs=1e-12) == T


@given(pairs=st.lists(joint_screws(), min_size=1, max_size=5), seed=st.integers(0, 99))
def test_forward_kinematics_is_the_product_of_exponentials_in_space_and_in_the_body(pairs, seed):
    rng = np.random.default_rng(seed)
    M = pin.exp6(rng.uniform(-1, 1, 6)).homogeneous
    q = rng.uniform(-2, 2, len(pairs))
    S = linear_first(pairs)
    robot = robot_from_screws(M, space=pairs)
    assert robot.joint_names == tuple(f"q{i + 1}" for i in range(len(pairs)))
    assert r1.forward_kinematics(robot, q).homogeneous == pytest.approx(poe.pose(M, S, q), abs=1e-12)
    assert r1.frame_jacobian(robot, q, kind="space") == pytest.approx(poe.space_jacobian(S, q), abs=1e-12)
    behind = M @ poe.pose(np.eye(4), S, q)
    found = r1.forward_kinematics(robot_from_screws(M, body=pairs), q)
    assert found.homogeneous == pytest.approx(behind, abs=1e-12)


def test_a_helical_joint_moves_as_pinocchios():
    w, h = np.array([0.6, 0.0, 0.8]), 0.15
    model = pin.Model()
    model.addJoint(0, pin.JointModelHelicalUnaligned(w, h), pin.SE3.Identity(), "h")
    data = model.createData()
    robot = robot_from_screws(np.eye(4), space=[(w, h * w)])
    for q in (-2.0, 0.3, 5.0):
        pin.forwardKinematics(model, data, np.array([q]))
        assert r1.forward_kinematics(robot, [q]).homogeneous == pytest.approx(data.oMi[1].homogeneous, abs=1e-14)
    with pytest.raises(r1.FormulaError, match=r"slides by 0\.15 times the angle of 'q1'"):
        r1.formulas(robot, r1.PositionTask())


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("kind", ["space", "body"])
def test_the_screws_of_a_robot_make_a_robot_that_moves_alike(name, kind):
    robot = arm(name)
    frame = robot.tool or robot.frame_names[-1]
    found, zero = screws(robot, kind=kind, frame=frame), np.zeros(robot.nq)
    moving = [i for i, pair in enumerate(found) if pair.any()]
    M = r1.forward_kinematics(robot, zero, frame=frame)
    again = robot_from_screws(M, **{kind: found[moving]})
    q = random_q(robot, 4)
    wanted = r1.forward_kinematics(robot, q, frame=frame).homogeneous
    assert r1.forward_kinematics(again, q[moving]).homogeneous == pytest.approx(wanted, abs=1e-12)


def test_a_robot_of_screws_has_formulas_solutions_and_limits_as_any_other():
    robot = robot_from_screws(
        [[1, 0, 0, 0.9], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]],
        space=[([0, 0, 1], [0, 0, 0]), ([0, 0, 1], [0, -0.5, 0])],
        lower=[-1, None],
        upper=[2, None],
    )
    plane = r1.PositionTask("xy")
    assert str(r1.formulas(robot, plane).determinant) == "sin(q2)/5"
    assert len(r1.ik_solutions(robot, plane, [0.5, 0.4])) == 2
    assert (robot.lower.tolist(), robot.upper.tolist()) == ([-1, -inf], [2, inf])


def test_screws_of_planar_arm_are_those_of_the_book():
    found = screws(arm("planar_2r"))
    l1 = arm("planar_2r").parameters["l1"]
    assert found == pytest.approx(np.array([[[0, 0, 1], [0, 0, 0]], [[0, 0, 1], [0, -l1, 0]]]), abs=1e-15)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({}, "either space="),
        ({"space": UR5, "body": UR5}, "either space="),
        ({"space": []}, "must hold 1 to"),
        ({"space": 3}, "must be a list of"),
        ({"space": [([0, 0, 2], [0, 0, 0])]}, r"screw 1 of space must have \|w\| = 1.*Divide"),
        ({"body": [([0, 0, 1], [0, 0, 0]), ([0, 0, 0], [0, 0, 0])]}, r"screw 2 of body must have"),
        ({"space": [([0, 0, 1e-7], [1, 0, 0])]}, r"screw 1 of space must have"),
        ({"space": [([0, 0, 1], [0, 0])]}, "screw 1 of space must"),
        ({"space": ["wv"]}, "screw 1 of space must"),
        ({"space": UR5, "lower": [1] * 6, "upper": [0] * 6}, "lower ≤ upper"),
        ({"space": UR5, "lower": [1]}, "lower must have one number or None"),
    ],
)
def test_what_is_no_screw_is_refused(arguments, words):
    with pytest.raises(r1.InputError, match=words):
        robot_from_screws(np.eye(4), **arguments)


def test_a_robot_with_a_follower_is_no_product_of_exponentials(tmp_path):
    joint = '<joint name="{0}" type="continuous"><parent link="{1}"/><child link="{2}"/><axis xyz="0 0 1"/>{3}</joint>'
    follower = '<origin xyz="1 0 0"/><mimic joint="a" multiplier="2"/>'
    text = joint.format("a", "x", "y", "") + joint.format("b", "y", "z", follower)
    tip = (
        '<link name="t"/><joint name="c" type="fixed"><parent link="z"/><child link="t"/><origin xyz="1 0 0"/></joint>'
    )
    path = tmp_path / "follower.urdf"
    path.write_text(f'<robot name="f"><link name="x"/><link name="y"/><link name="z"/>{tip}{text}</robot>')
    with pytest.raises(r1.InputError, match="a joint follows another"):
        screws(r1.load_robot(path))


def test_an_oblique_axis_keeps_its_direction():
    w = np.array([1, 1, 0]) / sqrt(2)
    robot = robot_from_screws(np.eye(4), space=[(w, [0, 0, 0])])
    assert r1.forward_kinematics(robot, [pi]).rotation @ [1, 0, 0] == pytest.approx([0, 1, 0], abs=1e-15)
