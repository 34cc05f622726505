"""Numeric derivatives: their estimated error bounds the true one, and steps go with the size of an arm."""

from math import cos, exp, sin

import numpy as np
import pytest
import sympy
from arms import arm, random_q
from hypothesis import given, settings, strategies as st

import robotics1 as r1
from robotics1.differentiation import (
    Estimate,
    configuration_derivative,
    derivative,
    derivative_inside,
    directional_derivative,
)
from robotics1.symbolic.tasks.verification import AGREES, MARGIN, TaskNumbers, Trials, numeric_determinant

numbers = st.floats(-3, 3)


@given(numbers, numbers, st.floats(0.1, 30), st.floats(0.02, 2), st.sampled_from([1e-6, 1.0, 1e6]))
def test_the_estimated_error_bounds_that_of_the_derivative(a, b, k, c, scale):
    """Of waves of many lengths, of a pole at a distance c, and of numbers of any size."""
    found = derivative(lambda t: scale * np.array([a * sin(k * t + b), exp(b * t), 1 / (c**2 + (t - a) ** 2)]))
    true = scale * np.array([a * k * cos(b), b, 2 * a / (c**2 + a**2) ** 2])
    assert (np.abs(found.value - true) <= 3 * found.error).all()
    assert (found.error <= 1e-8 * (scale + np.abs(true))).all()


def test_a_derivative_of_a_derivative_knows_the_noise_of_the_inner_one():
    def inner(t):
        return derivative(lambda s: sin(1 + s + 2 * t))

    found = derivative(lambda t: inner(t).value, noise=inner(0.0).error)
    assert abs(found.value + 2 * sin(1)) <= found.error
    assert found.error < 1e-11


def test_where_a_function_has_a_corner_the_error_is_found_to_be_large_or_the_steps_are_smaller():
    assert derivative(abs).value == pytest.approx(0)  # the mean of both sides
    found = derivative(lambda t: abs(t - 1e-3))
    assert abs(found.value + 1) <= found.error + 1e-12


@pytest.mark.parametrize("size", [1e-3, 1.0, 30.0])
def test_derivatives_along_a_slide_are_as_exact_for_small_arms_as_for_large_ones(size):
    robot = r1.robot_from_dh([("R", size, 0, 0, 0), ("P", 0, np.pi / 2, 0, 0), ("R", size, 0, 0, 0)])
    q, qdot = np.array([0.3, 0.4 * size, 0.5]), np.array([0.2, 0.7 * size, -0.4])

    def f(x):
        p = r1.forward_kinematics(robot, x).translation / size
        return np.array([1 / (0.5 + p @ p), p[2] ** 3])

    def exact(x):
        p, J = r1.forward_kinematics(robot, x).translation / size, r1.frame_jacobian(robot, x)[:3] / size
        return np.array([-2 * p / (0.5 + p @ p) ** 2, [0, 0, 3 * p[2] ** 2]]) @ J

    units = np.array([1, size, 1])
    assert configuration_derivative(f, robot, q) * units == pytest.approx(exact(q) * units, abs=1e-10)
    assert directional_derivative(f, robot, q, qdot) == pytest.approx(exact(q) @ qdot, abs=1e-10)


@pytest.mark.parametrize("name", ["spatial", "redundant", "cylindrical"])
def test_differences_along_a_direction_and_along_each_joint_agree_with_the_jacobian(name):
    robot = arm(name)
    q, qdot = random_q(robot, 8), np.random.default_rng(9).normal(size=robot.nv)

    def position(x):
        return r1.forward_kinematics(robot, x).translation.copy()

    J = r1.frame_jacobian(robot, q)[:3]
    assert configuration_derivative(position, robot, q) == pytest.approx(J, abs=1e-11)
    assert directional_derivative(position, robot, q, qdot) == pytest.approx(J @ qdot, abs=1e-12)
    assert directional_derivative(position, robot, q, 0 * qdot) == pytest.approx([0, 0, 0])
    assert directional_derivative(position, robot, q, 1e6 * qdot) == pytest.approx(1e6 * J @ qdot, rel=1e-11, abs=1e-5)


def test_a_derivative_at_a_jump_uses_one_side_only():
    def f(t, side):
        return np.array([np.sin(t)]) if t < 1 or (t == 1 and side == "left") else np.array([5 + t**3])

    for t, side, expected in [(1.0, "left", cos(1)), (1.0, "right", 3), (0.0, "right", 1), (2.0, "right", 12)]:
        assert derivative_inside(f, t, [0.0, 1.0, 2.0], side) == pytest.approx([expected], abs=1e-9)
    assert derivative_inside(f, 0.9999, [0.0, 1.0, 2.0], "right") == pytest.approx([cos(0.9999)], abs=1e-9)


# --- formulas are compared with numbers whose error is known


@pytest.fixture
def planar_2r():
    return r1.load_robot("planar_2r")


@pytest.mark.parametrize("f", [lambda p, R, q: [p @ p], lambda p, R, q: [(p @ p) ** 2 / (1 + p[0] ** 2)]])
def test_the_numbers_of_a_velocity_product_are_good_enough_to_compare_with(planar_2r, f):
    """On a processor without AVX-512 the numbers were off by 1.1e-9, and a right formula was refused."""
    found = r1.formulas(planar_2r, r1.FunctionTask(f, 1))
    assert found.velocity_product.shape == (1, 1)
    for point in found._trials.points:
        value, error = found._numbers.jacobian_rate(point)
        assert MARGIN * error.max() <= AGREES * max(1.0, np.abs(value).max())


def test_a_wrong_formula_is_refused_and_rough_numbers_decide_nothing(planar_2r):
    q1, q2 = q = sympy.symbols("q1 q2", real=True)
    trials = Trials(planar_2r, q, sympy.symbols("w1 w2", real=True))
    right = sympy.Matrix([sympy.sin(q1) * q2])

    def at(point, error=1e-15):
        return Estimate(np.array([sin(point.q[0]) * point.q[1]]), np.array([error]))

    trials.verify(right, at, "r")
    for wrong in (right * (1 + 1e-7), right + sympy.Matrix([2e-9]), -right):
        with pytest.raises(r1.FormulaError, match="differs from Pinocchio"):
            trials.verify(wrong, at, "r")
    trials.verify(right + sympy.Matrix([2e-9]), lambda point: at(point, 1e-9), "r")  # within what the numbers know
    with pytest.raises(r1.FormulaError, match="cannot be compared"):
        trials.verify(right, lambda point: at(point, 1e-6), "r")


@pytest.mark.parametrize("size", [1.0, 300.0])
@settings(max_examples=5)
@given(seed=st.integers(0, 20))
def test_determinants_of_large_arms_are_not_refused_for_their_rounding(size, seed):
    a, b, c = size * np.random.default_rng(seed).uniform(0.2, 1, 3)
    robot = r1.robot_from_dh([("R", 0, np.pi / 2, a, 0), ("R", b, 0, 0, 0), ("R", c, 0, 0, 0)])
    found = r1.formulas(robot, r1.PositionTask())
    q = np.array([0.3, 0.7, 0.9])
    det = float(found.determinant.evalf(subs=dict(zip(found.q, q, strict=True))))
    expected = np.linalg.det(r1.PositionTask().jacobian(robot, q))
    assert det == pytest.approx(expected, rel=1e-9)


def test_a_wrong_determinant_of_a_small_arm_is_refused_too():
    """Of an arm of a tenth of a millimetre det J is 1e-8 m², which is no rounding."""
    robot = r1.robot_from_dh([("R", "l1", 0, 0, 0), ("R", "l2", 0, 0, 0)], parameters={"l1": 1e-4, "l2": 1e-4})
    det = r1.formulas(robot, r1.PositionTask("xy")).determinant
    trials = Trials(robot, sympy.symbols("q1 q2", real=True), sympy.symbols("w1 w2", real=True))

    def minor(point):
        return numeric_determinant(TaskNumbers(r1.PositionTask("xy"), [0, 1]).jacobian(point))

    trials.verify(det, minor, "det J")
    for wrong in (det * (1 + 1e-7), 0 * det, det + 1e-14):
        with pytest.raises(r1.FormulaError, match="det J differs"):
            trials.verify(wrong, minor, "det J")
