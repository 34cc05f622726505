"""An arm as a chain of elementary transforms, held against a plain product of matrices."""

from math import cos, pi, sin

import numpy as np
import pytest
import sympy

import robotics1 as r1

robot_from_transforms = r1.textbook_robots.robot_from_transforms


def elementary(kind, x):
    T = np.eye(4)
    i = "xyz".index(kind[1])
    if kind[0] == "T":
        T[i, 3] = x
        return T
    j, k = (i + 1) % 3, (i + 2) % 3
    T[j, j] = T[k, k] = cos(x)
    T[k, j], T[j, k] = sin(x), -sin(x)
    return T


def product(*steps):
    T = np.eye(4)
    for kind, x in steps:
        T = T @ elementary(kind, x)
    return T


def test_the_pose_is_the_product_of_the_transforms():
    texts = ["Tz(d1)", "Rz(q1 + pi/2)", "Ry(-q2)", "Tx(l2)", "Tx(q3 - 0.1)", "Rx(0.3)", ("Ty", 0.2), ("Rz", "q4")]
    robot = robot_from_transforms(texts, parameters={"d1": 0.3, "l2": 0.5})
    q = [0.4, -0.7, 0.25, 1.1]
    steps = [("Tz", 0.3), ("Rz", 0.4 + pi / 2), ("Ry", 0.7), ("Tx", 0.5), ("Tx", 0.15), ("Rx", 0.3), ("Ty", 0.2)]
    assert r1.forward_kinematics(robot, q).homogeneous == pytest.approx(product(*steps, ("Rz", 1.1)), abs=1e-14)
    assert robot.joint_names == ("q1", "q2", "q3", "q4")
    assert robot.revolute.tolist() == [True, True, False, True]
    longer = robot.with_parameters({"l2": 1.5})
    assert r1.forward_kinematics(longer, q).homogeneous == pytest.approx(
        product(*steps[:3], ("Tx", 1.5), *steps[4:], ("Rz", 1.1)), abs=1e-14
    )


def test_a_joint_that_comes_again_follows_the_first():
    robot = robot_from_transforms(["Rz(-q1)", "Tx(1)", "Rz(q1)", "Tx(0.5)", "Rz(2*q1 + 0.1)"])
    assert robot.nv == 1
    T = product(("Rz", -0.3), ("Tx", 1), ("Rz", 0.3), ("Tx", 0.5), ("Rz", 0.7))
    assert r1.forward_kinematics(robot, [0.3]).homogeneous == pytest.approx(T, abs=1e-14)
    slide = robot_from_transforms(["Tx(q1)", "Tx(-0.5*q1)"])
    assert r1.forward_kinematics(slide, [0.4]).translation == pytest.approx([0.2, 0, 0])


def test_formulas_keep_the_names():
    robot = robot_from_transforms(["Rz(q1)", "Tx(a + 2*b)", "Ty(a*b)"], parameters={"a": 0.2})
    q1, a, b = sympy.symbols("q1 a b", real=True)
    x = r1.formulas(robot, r1.PositionTask("x")).value[0]
    assert sympy.expand(x - (a + 2 * b) * sympy.cos(q1) + a * b * sympy.sin(q1)) == 0
    assert dict(robot.parameters) == {"a": 0.2, "b": 1.0}


def test_a_dh_table_is_four_transforms_a_row():
    rows = [("R", 0.1, pi / 2, 0.3, 0.2), ("R", 0.4, 0, 0, 0), ("P", 0.0, -pi / 2, 0.1, 0.3)]
    texts = []
    for i, (kind, a, alpha, d, theta) in enumerate(rows, 1):
        turn, slide = (f"q{i} + {theta}", d) if kind == "R" else (theta, f"q{i} + {d}")
        texts += [("Rz", turn), ("Tz", slide), ("Tx", a), ("Rx", alpha)]
    q = [0.3, -0.4, 0.2]
    expected = r1.forward_kinematics(r1.robot_from_dh(rows), q).homogeneous
    assert r1.forward_kinematics(robot_from_transforms(texts), q).homogeneous == pytest.approx(expected, abs=1e-14)


def test_limits_are_those_of_the_joints_and_printed_angles_are_said():
    robot = robot_from_transforms(["Rx(1.5708)", "Rz(q1)", "Tz(q2)"], lower=[-1, 0], upper=[1, None])
    assert robot.lower.tolist() == [-1, 0]
    assert robot.upper.tolist() == [1, np.inf]
    assert "1.5708" in robot.warnings[0]
    assert "π/2" in robot.warnings[0]
    assert r1.forward_kinematics(robot, [0, 1]).translation == pytest.approx([0, -1, 0], abs=1e-15)


@pytest.mark.parametrize(
    ("transforms", "words"),
    [
        (["Rw(q1)"], "Rx, Ry, Rz"),
        ("Rz(q1)", "list"),
        (["Rz(0.3)"], "must have a joint"),
        (["Rz(q2)", "Rz(q1)"], "order q1, q2"),
        (["Rz(2*q1)"], "first comes as"),
        (["Rz(q1)", "Tx(q1)"], "both turn and slide"),
        (["Rz(q1*q2)"], "one at most"),
        (["Rz(q1**2)"], "number times q1"),
        (["Rz(q1)", "Tx(sin(a))"], "polynomial"),
        (["Rz(q1)", "Tx(import os)"], "formula"),
        (["Rz(q1)", ("Tx", None)], "formula"),
        ([("Rz",)], "transform 1"),
        *((["Rz(q1)", f"Tx({word})"], "finite number") for word in ("nan", "-inf", "2*Infinity + 1")),
    ],
)
def test_what_is_no_transform_is_refused(transforms, words):
    with pytest.raises(r1.InputError, match=words):
        robot_from_transforms(transforms)


def test_unknown_parameters_and_crossed_limits_are_errors():
    with pytest.raises(r1.UnknownNameError, match="'l1'"):
        robot_from_transforms(["Rz(q1)", "Tx(l1)"], parameters={"l2": 1})
    with pytest.raises(r1.InputError, match="lower ≤ upper"):
        robot_from_transforms(["Rz(q1)"], lower=[1], upper=[0])
    with pytest.raises(r1.UnknownNameError):
        robot_from_transforms(["Rz(q1)", "Tx(l1)"]).with_parameters({"l2": 1})
