"""Formulas of published examinations, 2009 to 2013: the robot of the question, and the formula of its solution."""

from math import pi

import numpy as np
import pytest
import sympy
from dh_arms import NAMED_CABLE, dh, offset_arm, planar_rpr
from formula_values import number, real, same
from sympy import Matrix, cos, sin, sqrt

from robotics1 import OrientationTask, PoseTask, PositionTask, formulas, robot_from_dh, subspaces

H = pi / 2
q1, q2, q3, q4 = real("q1:5")
L, L1, L2, L3, alpha = real("L L1 L2 L3 alpha")

CAMERA = [("R", 0, H, "L1", 0), ("R", "L2", 0, 0, 0), ("R", "L3", 0, 0, 0)]
CAMERA_TOOL = [[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]]


def test_2012_09_10_2_position_of_an_arm_with_a_shoulder_offset():
    rows = [("R", "a1", H, 0, 0), ("R", "a2", 0, 0, 0), ("R", "a3", 0, 0, 0)]
    robot, (a1, a2, a3) = robot_from_dh(rows, parameters={"a1": 0.2, "a2": 0.5, "a3": 0.5}), real("a1 a2 a3")
    f = formulas(robot, PositionTask())
    out, up = a1 + a2 * cos(q2) + a3 * cos(q2 + q3), a2 * sin(q2) + a3 * sin(q2 + q3)
    assert same(f.value, Matrix([out * cos(q1), out * sin(q1), up]))
    assert number(f.value, f, [0, pi / 4, -pi / 4]).ravel() == pytest.approx([1.053553, 0, 0.353553], abs=1e-6)


def test_2010_07_07_ii_wrist_centre_of_a_six_axis_arm():
    rows = [("R", "a1", H, "d1", 0), ("R", "a2", 0, 0, 0), ("R", "a3", H, 0, 0)]
    rows += [("R", 0, -H, "d4", 0), ("R", 0, H, 0, 0), ("R", 0, 0, 0.17, 0)]
    lengths = {"a1": 0.35, "a2": 0.85, "a3": 0.145, "d1": 0.815, "d4": 0.82}
    f, (a1, a2, a3, d1, d4) = (
        formulas(robot_from_dh(rows, parameters=lengths), PositionTask(frame="link4")),
        real(list(lengths)),
    )
    ahead, up = a2 + a3 * cos(q3) + d4 * sin(q3), a3 * sin(q3) - d4 * cos(q3)
    out = a1 + ahead * cos(q2) - up * sin(q2)
    assert same(f.value, Matrix([out * cos(q1), out * sin(q1), d1 + ahead * sin(q2) + up * cos(q2)]))


def test_2012_06_11_2a_planar_rpr_tip_and_its_2x3_jacobian():
    f = formulas(planar_rpr(), PositionTask("xy"))
    x, y = q2 * cos(q1) + L * cos(q1 + q3), q2 * sin(q1) + L * sin(q1 + q3)
    assert same(f.value, Matrix([x, y]))
    assert same(f.jacobian, Matrix([[-y, cos(q1), -L * sin(q1 + q3)], [x, sin(q1), L * cos(q1 + q3)]]))


def test_2012_06_11_2b_planar_rpr_minors():
    """That of the first two columns is −(q2 + L c3); the printed sign is an erratum."""
    f = formulas(planar_rpr(), PositionTask("xy"))
    wanted = {(2,): -(q2 + L * cos(q3)), (1,): L * q2 * sin(q3), (0,): L * cos(q3)}
    assert {out: sympy.expand(minor - wanted[out]) for out, minor in f.minors.items()} == dict.fromkeys(wanted, 0)


def test_2012_06_11_2c_planar_rpr_where_all_minors_vanish():
    f = formulas(planar_rpr(), PositionTask("xy"))
    J = f.jacobian.subs({q2: 0, q3: sympy.pi / 2})
    assert same(J, Matrix([[-L * cos(q1), cos(q1), -L * cos(q1)], [-L * sin(q1), sin(q1), -L * sin(q1)]]))
    assert same(J * Matrix([1, L, 0]), Matrix([0, 0]))


def test_2012_04_26_1b_velocity_of_a_camera_in_its_own_axes_and_in_those_of_the_base():
    robot = robot_from_dh(CAMERA, parameters={"L1": 0.5, "L2": 0.4, "L3": 0.3}, tool_placement=CAMERA_TOOL)
    own, base = (formulas(robot, PositionTask(reference=axes)).jacobian for axes in ("tool", "world"))
    c1, s1, s, c = cos(q1), sin(q1), sin(q2 + q3), cos(q2 + q3)
    shoulder, height = L2 * cos(q2) + L3 * c, L2 * sin(q2) + L3 * s
    assert same(own, Matrix([[shoulder, 0, 0], [0, L3 + L2 * cos(q3), L3], [0, L2 * sin(q3), 0]]))
    x, y = [-s1 * shoulder, -c1 * height, -L3 * c1 * s], [c1 * shoulder, -s1 * height, -L3 * s1 * s]
    assert same(base, Matrix([x, y, [0, shoulder, L3 * c]]))


def test_2012_02_09_1_angular_jacobian_of_a_wrist_with_twists_alpha_and_minus_alpha():
    rows = [("R", 0, "alpha", "d4", 0), ("R", 0, "-alpha", "d5", 0), ("R", 0, 0, 0, 0)]
    f = formulas(robot_from_dh(rows, parameters={"alpha": 1.0, "d4": 0.3, "d5": 0.2}), OrientationTask())
    s, c = sin(alpha), cos(alpha)
    wanted = [
        [0, sin(q1) * s, (1 - cos(q2)) * sin(q1) * s * c - cos(q1) * sin(q2) * s],
        [0, -cos(q1) * s, (cos(q2) - 1) * cos(q1) * s * c - sin(q1) * sin(q2) * s],
        [1, c, cos(q2) * s**2 + c**2],
    ]
    assert same(f.jacobian, Matrix(wanted))
    assert same(f.determinant, -sin(q2) * s**2)


def test_2012_02_09_2b_rrp_jacobian_and_determinant_s2_q3_squared():
    f = formulas(robot_from_dh([("R", 0, H, 1, 0), ("R", 0, H, 0, 0), ("P", 0, 0, 0, 0)]), PositionTask())
    wanted = [
        [-sin(q1) * sin(q2) * q3, cos(q1) * cos(q2) * q3, cos(q1) * sin(q2)],
        [cos(q1) * sin(q2) * q3, sin(q1) * cos(q2) * q3, sin(q1) * sin(q2)],
        [0, sin(q2) * q3, -cos(q2)],
    ]
    assert same(f.jacobian, Matrix(wanted))
    assert f.determinant == q3**2 * sin(q2)


def test_2012_01_11_1d_manipulability_of_a_planar_3r_is_the_root_of_the_sum_of_squared_minors():
    (l1, l2, l3), names = real("l1 l2 l3"), {"l1": 1, "l2": 0.5, "l3": 0.25}
    robot = robot_from_dh([("R", name, 0, 0, 0) for name in names], parameters=names)
    f = formulas(robot, PositionTask("xy"))
    H2 = sum(minor**2 for minor in f.minors.values())
    wanted = (l1 * (l2 * sin(q2) + l3 * sin(q2 + q3))) ** 2
    wanted += (l3 * (l1 * sin(q2 + q3) + l2 * sin(q3))) ** 2 + (l2 * l3 * sin(q3)) ** 2
    assert same(H2, wanted)
    assert number(sqrt(H2), f, [0.3, 1.48, 0.24]) == pytest.approx(0.795515, abs=1e-6)


def test_2011_02_03_1_to_3_arm_with_a_shoulder_offset():
    shoulder = L1 + L2 * cos(q2) + L3 * cos(q2 + q3)
    in_last = formulas(offset_arm(), PositionTask(reference="tool"))
    assert same(in_last.jacobian, Matrix([[0, L2 * sin(q3), 0], [0, L3 + L2 * cos(q3), L3], [-shoulder, 0, 0]]))
    assert in_last.determinant == -L2 * L3 * shoulder * sin(q3)
    angular = formulas(offset_arm(), OrientationTask())
    assert angular.jacobian == Matrix([[0, sin(q1), sin(q1)], [0, -cos(q1), -cos(q1)], [1, 0, 0]])
    assert angular.determinant == 0
    impossible = Matrix([cos(q1), sin(q1), 0])
    assert same(impossible.T * angular.jacobian, sympy.zeros(1, 3))


CABLE_BASE = [[1, 0, 0, 0.22], [0, 1, 0, 0.14], [0, 0, 1, 0.346], [0, 0, 0, 1]]


def test_2011_07_04_2_position_of_a_cable_arm_with_an_elbow_offset():
    robot = robot_from_dh(NAMED_CABLE, parameters={"a3": 0.045, "d3": 0.55}, base_placement=CABLE_BASE)
    f, (a3, d3) = formulas(robot, PositionTask(), point=(0, 0, "L")), real("a3 d3")
    (c1, c2, c3, c4), (s1, s2, s3, s4) = (list(map(turn, (q1, q2, q3, q4))) for turn in (cos, sin))
    side, along = a3 + L * s4 - a3 * c4, d3 + a3 * s4 + L * c4
    x, y = (c1 * c2 * c3 - s1 * s3) * side + c1 * s2 * along, (s1 * c2 * c3 + c1 * s3) * side + s1 * s2 * along
    base = [sympy.Rational(value) for value in ("0.22", "0.14", "0.346")]
    assert same(f.value, Matrix(base) + Matrix([x, y, c2 * along - s2 * c3 * side]))
    at = number(f.value, f, [0.3, 0.5, -0.7, 0.9], L=0.35).ravel()
    assert at == pytest.approx([0.829858, 0.13229, 0.943759], abs=1e-6)


def test_2011_07_04_4_and_5_cable_arm_jacobian_in_the_axes_of_link_2():
    robot = dh(*NAMED_CABLE, a3=0.045, d3=0.55)
    f = formulas(robot, PositionTask(reference="link2"), point=(0, 0, "L"))
    J = number(f.jacobian, f, [0.3, 0.5, -0.7, 0.9], L=0.35)
    wanted = [
        [0.164627, 0.802813, 0.187591, 0.193362],
        [0.580341, 0, 0.222716, -0.162867],
        [0.089936, -0.222716, 0, -0.246192],
    ]
    assert pytest.approx(np.array(wanted), abs=1e-6) == J
    a3, d3 = real("a3 d3")
    stretched = f.jacobian.subs({q2: 0, q3: 0, q4: 0})
    assert stretched.applyfunc(sympy.simplify) == Matrix([[0, L + d3, 0, L], [0, 0, 0, 0], [0, 0, 0, a3]])
    assert subspaces(number(f.jacobian, f, [0.7, 0, 0, 0], L=0.35)).rank == 2


def test_2010_06_15_1a_vertical_coordinate_of_an_rp_arm_has_the_jacobian_q2_c1_s1():
    robot = robot_from_dh([("R", 0, H, 0, H), ("P", 0, 0, 0, 0)])
    f = formulas(robot, PositionTask("y"))
    assert f.jacobian == Matrix([[q2 * cos(q1), sin(q1)]])
    assert f.minors == {(0,): sin(q1), (1,): q2 * cos(q1)}


def test_2010_01_12_2a_geometric_jacobian_of_a_cylindrical_arm():
    f = formulas(robot_from_dh([("R", 0, 0, 0, 0), ("P", 0, H, 0, H), ("P", 0, 0, 0, 0)]), PoseTask())
    rows = [[-q3 * sin(q1), 0, cos(q1)], [q3 * cos(q1), 0, sin(q1)], [0, 1, 0], [0, 0, 0], [0, 0, 0], [1, 0, 0]]
    assert f.jacobian == Matrix(rows)
    assert f.minors[(3, 4, 5)] == q3


def test_2009_12_17_1_first_four_joints_of_a_7r_arm():
    rows = [("R", 0, H, 0, 0), ("R", 0, H, 0, 0), ("R", 0, H, "L", 0), ("R", "L", 0, 0, 0)]
    f = formulas(robot_from_dh(rows, parameters={"L": 1.0}), PositionTask())
    c1, s1, c2, s2, c3, s3, c4, s4 = (g(q) for q in (q1, q2, q3, q4) for g in (cos, sin))
    wanted = [
        L * (c1 * s2 + c1 * s2 * s4 + (s1 * s3 + c1 * c2 * c3) * c4),
        L * (s1 * s2 + s1 * s2 * s4 - (c1 * s3 - s1 * c2 * c3) * c4),
        L * (-c2 - c2 * s4 + s2 * c3 * c4),
    ]
    assert same(f.value, Matrix(wanted))


def test_2009_11_10_2b_orientation_of_a_camera_on_three_joints():
    robot = robot_from_dh(
        [("R", 0, -H, 0, 0), ("R", 0, H, 0.25, 0), ("R", 0, H, 0, 0)],
        base_placement=[[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0.2], [0, 0, 0, 1]],
    )
    c1, s1, c2, s2, c3, s3 = (g(q) for q in (q1, q2, q3) for g in (cos, sin))
    y = [c1 * c2 * c3 - s1 * s3, c1 * s2, c1 * c2 * s3 + s1 * c3]
    z = [s1 * c2 * c3 + c1 * s3, s1 * s2, s1 * c2 * s3 - c1 * c3]
    assert same(formulas(robot, OrientationTask()).value, Matrix([[-s2 * c3, c2, -s2 * s3], y, z]))


def test_2009_06_10_b1_position_jacobian_of_a_planar_prp():
    robot = robot_from_dh(
        [("P", 0, H, 0, 0), ("R", 0, H, 0, 0), ("P", 0, 0, 0, 0)],
        base_placement=[[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]],
        tool_placement=[[0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 0], [0, 0, 0, 1]],
    )
    f = formulas(robot, PositionTask("xy"))
    assert f.jacobian == Matrix([[0, q3 * cos(q2), sin(q2)], [1, q3 * sin(q2), -cos(q2)]])
    assert set(f.minors.values()) == {-q3, -sin(q2), -q3 * cos(q2)}
