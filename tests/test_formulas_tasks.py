"""Formulas of tasks whose rows depend on the pose, and of the user's own functions."""

from math import atan2, cos, hypot, pi, sin

import numpy as np
import pytest
import sympy
from arms import arm, random_q
from dh_arms import puma
from differences import derivative
from formula_values import number, real, same
from sympy import Abs, Matrix, sqrt

from robotics1 import (
    FormulaError,
    FunctionTask,
    OrientationTask,
    PointingTask,
    PoseTask,
    TaskError,
    formulas,
    load_robot,
    robot_from_dh,
)

H = pi / 2
q1, q2, q3 = real("q1:4")
l1, l2, l3 = real("l1 l2 l3")
c, s = sympy.cos, sympy.sin


def zyz_wrist():
    """Three joints about z, y, z: the joint angles are ZYZ angles of the tool."""
    return robot_from_dh([("R", 0, -H, 0, 0), ("R", 0, H, 0, 0), ("R", 0, 0, "d", 0)], parameters={"d": 0.3})


def test_pointing_of_a_zyz_wrist_is_c1s2_s1s2_c2_and_its_jacobian_the_derivative():
    f = formulas(zyz_wrist(), PointingTask("z"))
    assert list(f.value) == [s(q2) * c(q1), s(q1) * s(q2), c(q2)]
    assert same(f.jacobian, f.value.jacobian([q1, q2, q3]))
    assert f.jacobian[:, 2] == Matrix([0, 0, 0])
    assert f.determinant == 0  # |r| is 1


def test_pointing_along_an_axis_given_by_numbers():
    f = formulas(zyz_wrist(), PointingTask((0, 3, 4)))
    q = [0.3, -0.8, 1.1]
    value = number(f.value, f, q).ravel()
    assert value == pytest.approx(f.task.value(f.robot, q), abs=1e-12)
    assert number(f.jacobian, f, q) == pytest.approx(derivative(lambda x: f.task.value(f.robot, x), q), abs=1e-9)


def test_zyz_angles_of_a_zyz_wrist_have_the_rates_of_its_joints():
    f = formulas(zyz_wrist(), OrientationTask(angles="ZYZ"))
    assert f.value[1] == sympy.atan2(Abs(s(q2)), c(q2))
    sign = s(q2) / Abs(s(q2))
    assert f.jacobian == Matrix([[1, 0, 0], [0, sign, 0], [0, 0, 1]])
    assert f.determinant == sign
    assert f.jacobian_rate == sympy.zeros(3, 3)


def test_zyx_angles_of_a_zyz_wrist_have_the_determinant_s2_over_the_cosine_of_pitch():
    """det J = det J_geometric / det T: −s2 / (−cos φ2), with sin φ2 = s2 c3."""
    f = formulas(zyz_wrist(), OrientationTask(angles="ZYX"))
    assert f.determinant == s(q2) / sqrt(1 - s(q2) ** 2 * c(q3) ** 2)
    q = [0.4, 0.7, -0.9]
    assert number(f.jacobian, f, q) == pytest.approx(derivative(lambda x: f.task.value(f.robot, x), q), abs=1e-9)


@pytest.mark.parametrize(("angles", "fixed"), [("ZYZ", False), ("XYZ", True), ("YXZ", False), ("Z-YX", False)])
def test_the_determinant_of_an_analytic_jacobian_is_that_of_pinocchio_on_a_6r(angles, fixed):
    f = formulas(puma(), PoseTask(angles=angles, fixed=fixed))
    for seed in range(3):
        q = np.random.default_rng(seed).uniform(-2, 2, 6)
        J = f.task.jacobian(f.robot, q)
        assert number(f.determinant, f, q) == pytest.approx(np.linalg.det(J), rel=1e-9, abs=1e-12)
        assert number(f.jacobian, f, q) == pytest.approx(J, abs=1e-9 * max(1, np.abs(J).max()))


def test_the_determinant_of_the_analytic_jacobian_of_a_puma_is_elbow_shoulder_wrist_over_sine_of_nutation():
    f = formulas(puma(), PoseTask(angles="ZYZ"))
    geometric = formulas(puma(), PoseTask())
    cosine = formulas(puma(), PoseTask()).value[2, 2]
    assert sympy.simplify(f.determinant * sqrt(1 - cosine**2) / geometric.determinant) == -1


def test_the_minors_of_a_tall_analytic_jacobian_are_those_of_its_numbers():
    robot = arm("anthropomorphic")
    f = formulas(robot, PoseTask(angles="ZYX"))
    q = [0.3, 0.5, -0.7]
    J = f.task.jacobian(robot, q)
    assert len(f.minors) == 20
    for out, minor in f.minors.items():
        assert number(minor, f, q) == pytest.approx(np.linalg.det(np.delete(J, out, axis=0)), abs=1e-10)


def test_angles_that_are_singular_everywhere_are_a_task_error():
    f = formulas(load_robot("planar_2r"), OrientationTask(angles="ZYZ"))
    with pytest.raises(TaskError, match="ZYZ angles are singular"):
        _ = f.jacobian


def test_polar_coordinates_of_a_2r_have_the_determinant_l1_l2_s2_over_rho():
    polar = FunctionTask(lambda p, R, q: [np.linalg.norm(p), np.arctan2(p[1], p[0])], 2)
    f = formulas(load_robot("planar_2r"), polar)
    rho = sqrt(l1**2 + 2 * l1 * l2 * c(q2) + l2**2)
    assert f.value[0] == rho
    assert f.jacobian == Matrix([[0, -l1 * l2 * s(q2) / rho], [1, l2 * (l1 * c(q2) + l2) / rho**2]])
    assert f.determinant == l1 * l2 * s(q2) / rho


def test_the_distance_of_a_3r_from_a_point_has_the_jacobian_of_central_differences():
    def distance(p, R, q):
        return [np.sqrt((p[0] - 0.3) ** 2 + (p[1] + 0.2) ** 2 + (p[2] - 0.1) ** 2)]

    f = formulas(arm("anthropomorphic"), FunctionTask(distance, 1))
    q = [0.4, 0.8, -0.5]
    wanted = derivative(lambda x: f.task.value(f.robot, x), q)
    assert number(f.jacobian, f, q) == pytest.approx(wanted, abs=1e-9)
    minors = [number(f.minors[out], f, q) for out in ((1, 2), (0, 2), (0, 1))]
    assert minors == pytest.approx(wanted[0], abs=1e-9)


def test_a_function_that_is_the_planar_pose_has_its_formulas():
    def pose(p, R, q):
        return [p[0], p[1], q[0] + q[1] + q[2]]

    names = {"l1": 0.5, "l2": 0.4, "l3": 0.3}
    robot = robot_from_dh([("R", name, 0, 0, 0) for name in names], parameters=names)
    f = formulas(robot, FunctionTask(pose, 3))
    assert f.value[2] == q1 + q2 + q3
    assert list(f.jacobian.row(2)) == [1, 1, 1]
    assert f.determinant == l1 * l2 * s(q2)


def test_a_function_of_q_alone_is_differentiated_as_it_stands():
    """The user's own direct kinematics: r = (cos q1 + cos(q1 + q2), sin q1 + sin(q1 + q2))."""

    def hand(p, R, q):
        return [np.cos(q[0]) + np.cos(q[0] + q[1]), np.sin(q[0]) + np.sin(q[0] + q[1])]

    f = formulas(load_robot("planar_2r"), FunctionTask(hand, 2))
    assert same(f.jacobian, Matrix([[-s(q1) - s(q1 + q2), -s(q1 + q2)], [c(q1) + c(q1 + q2), c(q1 + q2)]]))
    assert f.determinant == s(q2)


def test_a_function_of_the_rotation_follows_from_omega_cross_R():
    """The height of a point 0.2 m along the tool's y axis, z + 0.2 R_zy, on a skewed spatial arm; and R Rᵀ = 1."""
    f = formulas(arm("spatial"), FunctionTask(lambda p, R, q: [p[2] + 0.2 * R[2, 1]], 1))
    q = random_q(f.robot, 5)
    J = number(f.jacobian, f, q)
    assert pytest.approx(derivative(lambda x: f.task.value(f.robot, x), q), abs=1e-9) == J
    unit = formulas(arm("six_r"), FunctionTask(lambda p, R, q: [R[0] @ R[1], R[2] @ R[2]], 2))
    assert number(unit.value, unit, random_q(unit.robot, 6)).ravel() == pytest.approx([0, 1], abs=1e-12)
    assert number(unit.jacobian, unit, random_q(unit.robot, 6)) == pytest.approx(np.zeros((2, 6)), abs=1e-12)


def test_numbers_with_many_digits_are_decimals_and_short_ones_fractions():
    f = formulas(arm("spatial"), PoseTask())
    assert all(x.q <= 10**12 for entry in f.jacobian for x in entry.atoms(sympy.Rational))
    assert formulas(robot_from_dh([("R", 0.089159, 0, 0, 0)]), PointingTask("x")).value == Matrix([c(q1), s(q1), 0])
    short = formulas(robot_from_dh([("R", 0.089159, 0, 0, 0)]), FunctionTask(lambda p, R, q: p[:1], 1))
    assert list(short.value) == [sympy.Rational(89159, 10**6) * c(q1)]


def test_a_function_written_with_sympy_or_with_numpy_has_the_same_formula():
    robot = load_robot("planar_2r")
    by_sympy = formulas(robot, FunctionTask(lambda p, R, q: [sympy.sqrt(p[0] ** 2 + p[1] ** 2)], 1))
    by_numpy = formulas(robot, FunctionTask(lambda p, R, q: [np.hypot(p[0], p[1])], 1))
    by_power = formulas(robot, FunctionTask(lambda p, R, q: [(p @ p) ** 0.5], 1))
    assert by_sympy.jacobian == by_numpy.jacobian == by_power.jacobian


def test_a_function_with_a_prismatic_joint():
    """PRR: r = q1 y, with y = l2 s2 + l3 s23."""
    f = formulas(load_robot("prr"), FunctionTask(lambda p, R, q: [q[0] * p[1]], 1))
    y = l2 * s(q2) + l3 * s(q2 + q3)
    dy = l2 * c(q2) + l3 * c(q2 + q3)
    assert same(f.jacobian, Matrix([[y, q1 * dy, q1 * l3 * c(q2 + q3)]]))


def test_a_minor_of_numbers_is_the_quotient_of_their_formula():
    """A ratio r = y/x: one row (−y, x, ...)/x²; the minors are the entries."""
    f = formulas(load_robot("planar_2r"), FunctionTask(lambda p, R, q: [p[1] / p[0]], 1))
    q = [0.5, 0.9]
    x, y = (1.2 * cos(q[0]) + 0.8 * cos(sum(q)), 1.2 * sin(q[0]) + 0.8 * sin(sum(q)))
    assert number(f.minors[(1,)], f, q) == pytest.approx(hypot(x, y) ** 2 / x**2)
    assert number(f.value, f, q)[0, 0] == pytest.approx(y / x)
    assert atan2(y, x) < H


def test_rows_that_are_no_quotients_of_polynomials_have_a_jacobian_and_no_minors():
    f = formulas(load_robot("planar_2r"), FunctionTask(lambda p, R, q: [p[0] + q[0] ** 2], 1))
    assert f.jacobian[0] == -l1 * s(q1) - l2 * s(q1 + q2) + 2 * q1
    with pytest.raises(FormulaError, match="no quotients of short polynomials"):
        _ = f.minors


@pytest.mark.parametrize(
    ("function", "message"),
    [
        (lambda p, R, q: [sin(p[0])], "cannot be read as a formula"),
        (lambda p, R, q: [float(p[0])], "cannot be read as a formula"),
        (lambda p, R, q: [p[0] if p[0] > 0 else p[1]], "its truth depends on q"),
        (lambda p, R, q: [np.maximum(p[0], p[1])], "its truth depends on q"),
        (lambda p, R, q: [np.linalg.det(R)], "cannot be read as a formula"),
        (lambda p, R, q: [1 / (q[0] - q[0])], "must be a real function"),
        (lambda p, R, q: [p[0] * sympy.Symbol("k")], "of p, R and q alone"),
        (lambda p, R, q: [sympy.Function("h")(p[0])], "of p, R and q alone"),
        (lambda p, R, q: [sympy.I * p[0]], "must be a real function"),
        (lambda p, R, q: p[:2], r"must return shape \(1,\); it returned shape \(2,\)"),
        (lambda p, R, q: p[0], r"must return shape \(1,\); it returned shape \(\)"),
        (lambda p, R, q: None, "cannot be read|must return"),
    ],
)
def test_a_function_that_cannot_be_read_is_a_formula_error_that_says_why(function, message):
    with pytest.raises(FormulaError, match=message):
        formulas(load_robot("planar_2r"), FunctionTask(function, 1))


def test_a_long_arm_has_a_verified_pose_jacobian_as_products_and_long_rows_are_refused():
    """A 7R arm with no parallel axes: J is written as products of short matrices, and its minors in short axes."""
    rows = [
        ("R", a, (-1) ** i * H, d, 0) for i, (a, d) in enumerate([(0, 0.3), (0, 0), (0.1, 0.3), (0.1, 0), (0, 0.4)])
    ]
    robot = robot_from_dh([*rows, ("R", 0.1, H, 0, 0), ("R", 0, 0, 0.1, 0)])
    f = formulas(robot, PoseTask())
    q = np.random.default_rng(2).uniform(-2, 2, 7)
    assert number(f.jacobian, f, q) == pytest.approx(f.task.jacobian(robot, q), abs=1e-9)
    assert max(entry.count_ops() for entry in f.jacobian) < 500
    assert set(f.minors) == {(i,) for i in range(7)}
    with pytest.raises(FormulaError, match="more than 20000 products of terms"):
        _ = formulas(robot, PointingTask()).minors
