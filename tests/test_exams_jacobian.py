"""Questions of examinations of 2009 to 2013 on the Jacobian, answered in numbers with the public API.

Those that ask for formulas of a Jacobian alone are in test_formulas_exams.py.
"""

from itertools import product
from math import pi

import numpy as np
import pytest
import sympy
from dh_arms import CABLE, SPATIAL_4R, dh
from formula_values import number, real, same
from sympy import Matrix, cos, sin

from robotics1 import OrientationTask, PoseTask, PositionTask, formulas, joint_velocity, robot_from_dh, subspaces

H = pi / 2
XY, XYZ, TURN, TWIST = PositionTask("xy"), PositionTask("xyz"), OrientationTask(), PoseTask()
q1, q2, q3, q4, q5 = real("q1:6")
THREE = [("R", 0.2, H, 0, 0), ("R", 0.5, 0, 0, 0), ("R", 0.5, 0, 0, 0)]
ANTHROPOMORPHIC = [("R", 0, H, "d1", 0), ("R", "a2", 0, 0, 0), ("R", "a3", 0, 0, 0)]
SCARA = [("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0, 0)]
CART = [("P", 0, H, 0, H), ("P", 0, H, 0, H), ("R", 0, H, "d0", 0), ("R", "l2", 0, 0, 0), ("R", "l3", 0, 0, 0)]
CART_BASE = [[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]]  # the slides along x and y, joint 3 upwards


def planar(*lengths):
    return robot_from_dh([("R", length, 0, 0, 0) for length in lengths])


def shifted(x, y, z):
    T = np.eye(4)
    T[:3, 3] = x, y, z
    return T


def same_points(found, wanted, digits=1e-4):
    assert len(found) == len(wanted)
    assert all(min(np.abs(np.subtract(point, other)).max() for other in found) <= digits for point in wanted)


def test_2013_01_09_2a_planar_4r_tip_velocity():
    J = XY.jacobian(planar(1, 1, 1, 1), [0, 0, -pi / 4, H])
    wanted = [[0, 0, 0, -0.707107], [3.414214, 2.414214, 1.414214, 0.707107]]
    assert J == pytest.approx(np.array(wanted), abs=1e-6)


def test_2013_01_09_3_error_of_joint_1_is_felt_by_a2_c2_plus_a3_c23_and_most_when_stretched_out():
    """|∂p/∂q1| = |a2 c2 + a3 c23| ≤ a2 + a3, with equality at q2 = q3 = 0."""
    a2, a3 = real("a2 a3")
    robot = robot_from_dh(ANTHROPOMORPHIC, parameters={"d1": 0.4, "a2": 0.5, "a3": 0.3})
    column = formulas(robot, XYZ).jacobian[:, 0]
    assert same(column.dot(column), (a2 * cos(q2) + a3 * cos(q2 + q3)) ** 2)
    norms = [np.linalg.norm(XYZ.jacobian(robot, [0.3, *q])[:, 0]) for q in product(np.linspace(-pi, pi, 41), repeat=2)]
    assert 0.01 * max(norms) == pytest.approx(0.008)
    assert 0.01 * np.linalg.norm(XYZ.jacobian(robot, [0.3, 0, 0])[:, 0]) == pytest.approx(0.008)


def test_2012_09_10_3_joint_velocity_for_a_velocity_of_the_last_origin():
    robot, q = robot_from_dh(THREE), [0, pi / 4, -pi / 4]
    J = [[0, -0.3536, 0], [1.0536, 0, 0], [0, 0.8536, 0.5]]
    assert XYZ.jacobian(robot, q) == pytest.approx(np.array(J), abs=1e-4)
    assert joint_velocity(robot, XYZ, [1, 1, 0.5], q).qdot == pytest.approx([0.9492, -2.8284, 5.8284], abs=1e-4)


def test_2012_09_10_4_angular_velocity_of_the_last_frame():
    J = TURN.jacobian(robot_from_dh(THREE), [0, pi / 4, -pi / 4])
    assert J == pytest.approx(np.array([[0, 0, 0], [0, -1, -1], [1, 0, 0]]), abs=1e-12)
    assert J @ [0.949169, -2.828427, 5.828427] == pytest.approx([0, -3, 0.9492], abs=1e-4)


def test_2011_09_12_a_scara_realises_a_twist_in_one_way():
    robot, q = robot_from_dh(SCARA), [0, H, 1, -H]
    answer, J = joint_velocity(robot, TWIST, [1, -1, 1, 0, 0, -1], q), TWIST.jacobian(robot, q)
    assert (answer.rank, answer.feasible, subspaces(J).null.shape) == (4, True, (4, 0))
    assert answer.qdot == pytest.approx([-1, 0, 1, 0], abs=1e-12)
    assert np.linalg.det(J.T @ J) == pytest.approx(1)


def test_2011_07_04_4_cable_arm_jacobian_in_the_axes_of_link_2_at_a_configuration():
    robot = robot_from_dh(CABLE, base_placement=shifted(0.22, 0.14, 0.346), tool_placement=shifted(0, 0, 0.35))
    q, task = [0.3, 0.5, -0.7, 0.9], PositionTask("xyz", reference="link2")
    wanted = [
        [0.164627, 0.802813, 0.187591, 0.193362],
        [0.580341, 0.0, 0.222716, -0.162867],
        [0.089936, -0.222716, 0.0, -0.246192],
    ]
    assert task.jacobian(robot, q) == pytest.approx(np.array(wanted), abs=1e-6)
    f = formulas(robot, task)
    assert number(f.jacobian, f, q) == pytest.approx(np.array(wanted), abs=1e-6)


@pytest.mark.parametrize(
    ("second", "J", "longest", "vertices"),
    [
        (pi / 3, [[-3.5, -2], [2.5981, 0]], 7, [[-6.5, 2.5981], [6.5, -2.5981], [0.5, -2.5981], [-0.5, 2.5981]]),
        (
            2.748894,
            [[-1.2389, 0.2611], [0.6152, -1.9829]],
            3.9425,
            [[1.6305, -3.5895], [-1.6305, 3.5895], [-0.8474, -2.3591], [0.8474, 2.3591]],
        ),
    ],
)
def test_2011_06_17_ab_tip_velocities_of_a_2r_with_bounded_joint_speeds(second, J, longest, vertices):
    """The box |q̇1| ≤ 1, |q̇2| ≤ 1.5 mapped by J: a parallelogram, whose longest velocity is at a vertex."""
    found = XY.jacobian(planar(3, 2), [pi / 6, second])
    corners = np.array(list(product((-1, 1), (-1.5, 1.5)))) @ found.T
    assert found == pytest.approx(np.array(J), abs=1e-4)
    same_points(corners, vertices)
    assert np.linalg.norm(corners, axis=1).max() == pytest.approx(longest, abs=1e-4)


def test_2009_12_17_1_geometric_jacobian_of_the_first_four_joints_of_a_7r_arm():
    robot, q = dh(*SPATIAL_4R, L=1.0), [0, 3 * pi / 4, pi, pi]
    wanted = [
        [0, -1.414214, 0, -0.707107],
        [0, 0, -1, 0],
        [0, 0, 0, -0.707107],
        [0, 0, 0.707107, 0],
        [0, -1, 0, -1],
        [1, 0, 0.707107, 0],
    ]
    assert TWIST.jacobian(robot, q) == pytest.approx(np.array(wanted), abs=1e-6)


def test_2009_09_10_a_wrist_centre_of_an_arm_on_a_synchro_drive_and_its_inputs():
    """Inputs (v, w, q̇1, q̇2, q̇3), with ẋ = v cos θ, ẏ = v sin θ; the arm's base does not turn."""
    robot = robot_from_dh(CART, parameters={"d0": 0.3, "l2": 0.4, "l3": 0.4}, base_placement=np.array(CART_BASE, float))
    th, l2, l3 = real("th l2 l3")
    G = sympy.diag(Matrix([[cos(th), 0], [sin(th), 0]]), sympy.eye(3))
    out, up = l2 * cos(q4) + l3 * cos(q4 + q5), l2 * sin(q4) + l3 * sin(q4 + q5)
    wanted = [
        [cos(th), 0, -out * sin(q3), -up * cos(q3), -l3 * sin(q4 + q5) * cos(q3)],
        [sin(th), 0, out * cos(q3), -up * sin(q3), -l3 * sin(q4 + q5) * sin(q3)],
        [0, 0, 0, out, l3 * cos(q4 + q5)],
    ]
    assert same(formulas(robot, XYZ).jacobian * G, Matrix(wanted))
