"""The Jacobian of an arm with a spherical wrist, in blocks."""

from math import pi

import numpy as np
import pytest
import sympy
from arms import arm

import robotics1 as r1

wrist_jacobian = r1.singularities.wrist_jacobian
q1, q2, q3, q4, q5 = sympy.symbols("q1:6", real=True)
a2, d4 = sympy.symbols("a2 d4", real=True)
WRIST = [("R", 0, -pi / 2, 0, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, 0, "d6", 0)]
LENGTHS = {"a2": 0.42, "d4": 0.39, "d6": 0.08}


def anthropomorphic():
    rows = [("R", 0, pi / 2, 0, 0), ("R", "a2", 0, 0, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, -pi / 2, "d4", 0)]
    return r1.robot_from_dh([*rows, ("R", 0, pi / 2, 0, 0), ("R", 0, 0, "d6", 0)], parameters=LENGTHS)


def numbers(M, q, robot):
    symbols = [*sympy.symbols(f"q1:{robot.nq + 1}", real=True), *(sympy.Symbol(n, real=True) for n in robot.parameters)]
    return np.array(sympy.lambdify(symbols, M, "numpy")(*q, *robot.parameters.values()), dtype=float)


def test_the_determinant_of_an_anthropomorphic_arm_is_that_of_arm_times_wrist():
    found = wrist_jacobian(anthropomorphic())
    shoulder = a2 * sympy.cos(q2) + d4 * sympy.sin(q2 + q3)
    assert sympy.simplify(found.arm_determinant**2 - (a2 * d4 * sympy.cos(q3) * shoulder) ** 2) == 0
    assert sympy.simplify(found.wrist_determinant**2 - sympy.sin(q5) ** 2) == 0
    assert found.jacobian[:3, 3:] == sympy.zeros(3, 3)


@pytest.mark.parametrize("reference", ["world", "link3", "tool"])
def test_the_blocks_are_those_of_pinocchio_at_the_wrist_centre(reference):
    robot, q = anthropomorphic(), np.array([0.3, -0.5, 0.7, 1.1, 0.4, -0.2])
    found = wrist_jacobian(robot, reference=reference)
    J = r1.frame_jacobian(robot, q, reference=reference)
    R = np.eye(3) if reference == "world" else r1.forward_kinematics(robot, q, frame=reference).rotation
    tool = r1.forward_kinematics(robot, q)
    centre = tool.translation - LENGTHS["d6"] * tool.rotation[:, 2]
    linear = J[:3] + np.cross(J[3:].T, R.T @ (centre - tool.translation)).T
    assert numbers(found.jacobian, q, robot) == pytest.approx(np.vstack([linear, J[3:]]), abs=1e-12)
    assert found.arm.shape == found.coupling.shape == found.wrist.shape == (3, 3)
    det = float(numbers(sympy.Matrix([found.determinant]), q, robot).squeeze())
    assert det == pytest.approx(np.linalg.det(np.vstack([linear, J[3:]])), abs=1e-12)


def test_a_wrist_centre_without_a_frame_is_a_point_of_the_tools_link():
    rows = [("R", 0, pi / 2, 0, 0), ("R", 0.4, 0, 0, 0), ("R", 0.1, pi / 2, 0, 0)]
    wrist = [("R", 0, -pi / 2, 0.3, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, 0, 0.2, 0)]
    robot = r1.robot_from_dh([*rows, *wrist])
    screws = r1.rigid_motions.screws(robot)
    same = r1.rigid_motions.robot_from_screws(r1.forward_kinematics(robot, np.zeros(6)), space=screws)
    q = np.array([0.3, -0.5, 0.7, 1.1, 0.4, -0.2])
    ours, theirs = (numbers(wrist_jacobian(arm_).determinant * sympy.ones(1), q, arm_) for arm_ in (robot, same))
    assert ours == pytest.approx(theirs, abs=1e-9)
    assert abs(float(ours.squeeze())) > 1e-4


def test_an_arm_of_seven_joints_has_blocks_and_no_determinant():
    rows = [("R", 0, -pi / 2, 0.3, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, pi / 2, 0.4, 0), ("R", 0, -pi / 2, 0, 0)]
    wrist = [("R", 0, -pi / 2, 0.4, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, 0, 0.1, 0)]
    found = wrist_jacobian(r1.robot_from_dh([*rows, *wrist]))
    assert found.arm.shape == (3, 4)
    with pytest.raises(r1.TaskError, match="3 × 4"):
        _ = found.determinant


def ur5():
    rows = [("R", 0, pi / 2, 0.0892, 0), ("R", -0.425, 0, 0, 0), ("R", -0.392, 0, 0, 0)]
    return r1.robot_from_dh([*rows, ("R", 0, pi / 2, 0.109, 0), ("R", 0, -pi / 2, 0.095, 0), ("R", 0, 0, 0.082, 0)])


@pytest.mark.parametrize("robot", [lambda: arm("planar_3r"), lambda: arm("prr"), ur5, lambda: arm("planar_2r")])
def test_an_arm_without_a_spherical_wrist_is_refused(robot):
    with pytest.raises(r1.TaskError, match="wrist"):
        wrist_jacobian(robot())
