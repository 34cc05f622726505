from math import inf, nan

import closed_forms as cf
import numpy as np
import pytest
from arms import arm
from hypothesis import given, strategies as st

from robotics1 import InputError, cubic
from robotics1.curves import PiecewisePolynomial
from robotics1.trajectories import limit_violations

value = st.floats(-10, 10)
pair = st.tuples(value, value).map(np.array)
duration = st.floats(0.1, 10)

# The exam's cubic to the right arm: q, q̇ at t_rv, and the printed coefficients of τ², τ³ and t², t³.
RIGHT = {"q": [1.0294, 1.4250], "qdot": [-0.7359, -0.6278], "T": 1.38034}
RIGHT_TAU = [[4.1040, 5.1415], [-3.0746, -3.7165]]
RIGHT_T = [[2.1539, 2.6984], [-1.1690, -1.4130]]


# --- formulas


@given(pair, pair, duration, pair, pair)
def test_cubic_coefficients_are_the_four_boundary_conditions(q0, q1, T, v0, v1):
    trajectory = cubic(q0, q1, T, v0, v1)
    assert trajectory.coefficients == pytest.approx(cf.cubic_coefficients(q0, q1, T, v0, v1), abs=1e-12)
    assert trajectory(0) == pytest.approx(q0, abs=1e-12)
    assert trajectory(T) == pytest.approx(q1, abs=1e-11)
    assert trajectory.velocity(0) == pytest.approx(v0, abs=1e-12)
    assert trajectory.velocity(T) == pytest.approx(v1, abs=1e-9)


def test_cubic_from_rest_is_the_exams():
    trajectory = cubic([0, 0], RIGHT["q"], RIGHT["T"], v1=RIGHT["qdot"])
    assert trajectory.coefficients[2:] == pytest.approx(np.array(RIGHT_TAU), abs=3e-4)
    assert trajectory.coefficients_t[2:] == pytest.approx(np.array(RIGHT_T), abs=3e-4)
    assert not trajectory.coefficients[:2].any()


def test_rest_to_rest_passes_the_middle_at_three_halves_of_the_mean_speed():
    trajectory = cubic([1, -2], [3, 2], 4)
    assert trajectory(2) == pytest.approx([2, 0], abs=1e-15)
    assert trajectory.velocity(2) == pytest.approx([0.75, 1.5], abs=1e-15)
    assert trajectory.acceleration(0) == pytest.approx([6 * 2 / 16, 6 * 4 / 16], abs=1e-15)
    assert trajectory.acceleration(2) == pytest.approx([0, 0], abs=1e-15)


@given(pair, pair, duration, st.floats(0, 1))
def test_coefficients_t_are_those_of_powers_of_t(q1, v1, T, tau):
    trajectory = cubic([0.5, -1], q1, T, v1=v1)
    t = tau * T
    by_powers = sum(c * t**k for k, c in enumerate(trajectory.coefficients_t))
    assert trajectory(t) == pytest.approx(by_powers, abs=1e-10)
    rate = sum(c * t**k for k, c in enumerate(trajectory.rate.coefficients_t))
    assert trajectory.velocity(t) == pytest.approx(rate, abs=1e-9)


# --- central differences


@pytest.mark.parametrize("t", [0.2, 0.7, 1.3])
def test_velocity_and_acceleration_are_the_derivatives(t):
    trajectory = cubic([0.5, -1, 2], [3, 0.2, -1], 1.5, [1, -2, 0.3], [-0.4, 0.6, 2])
    h = 1e-5
    slope = (trajectory(t + h) - trajectory(t - h)) / (2 * h)
    bend = (trajectory.velocity(t + h) - trajectory.velocity(t - h)) / (2 * h)
    assert trajectory.velocity(t) == pytest.approx(slope, abs=1e-8)
    assert trajectory.acceleration(t) == pytest.approx(bend, abs=1e-8)


# --- shapes


def test_many_times_give_one_row_each():
    trajectory = cubic([0, 1], [1, 3], 2, v1=0.5)
    times = np.linspace(0, 2, 7)
    for motion in (trajectory, trajectory.velocity, trajectory.acceleration):
        assert motion(times) == pytest.approx(np.array([motion(t) for t in times]), abs=1e-15)
        assert motion(times).shape == (7, 2)
        assert motion(1).shape == (2,)


def test_a_single_joint_may_be_a_number():
    trajectory = cubic(0, 2, 1)
    assert trajectory(0.5).tolist() == [1.0]
    assert trajectory.coefficients.shape == (4, 1)


# --- extremes


def test_extremes_are_where_the_quadratic_formula_puts_them():
    """q = 0.96 τ − 3 τ² + 2 τ³ has q' = 6 (τ − 0.2) (τ − 0.8), with q = 0.088 and −0.128 there."""
    times, values = PiecewisePolynomial.from_pieces([([[0.0], [0.96], [-3], [2]], 2.0)]).extremes()
    assert times[:, 0] == pytest.approx([1.6, 0.4], abs=1e-12)
    assert values[:, 0] == pytest.approx([-0.128, 0.088], abs=1e-12)


@given(pair, pair, pair, pair)
def test_no_sample_passes_the_extremes_and_they_are_on_the_curve(q0, q1, v0, v1):
    trajectory = cubic(q0, q1, 1.7, v0, v1)
    times, (low, high) = trajectory.extremes()
    samples = trajectory(np.linspace(0, 1.7, 200))
    assert (samples >= low - 1e-9).all()
    assert (samples <= high + 1e-9).all()
    for row, wanted in enumerate((low, high)):
        assert [trajectory(times[row, i])[i] for i in range(2)] == pytest.approx(wanted, abs=1e-9)


@pytest.mark.parametrize(("q0", "q1"), [([1], [1]), ([0], [2]), ([2], [0])])
def test_extremes_of_monotonic_and_constant_motions_are_the_ends(q0, q1):
    _, values = cubic(q0, q1, 3).extremes()
    assert values[:, 0].tolist() == sorted([q0[0], q1[0]])


# --- limits


def test_limit_violations_name_the_joint_the_quantity_the_worst_value_and_its_time(planar_2r):
    """Rest to rest over Δ in T passes its largest speed 3Δ/2T in the middle."""
    violations = limit_violations(planar_2r, cubic([0, 0], [3, 1], 0.5))
    assert [(v.joint, v.quantity, v.limit) for v in violations] == [("q1", "velocity", 4.0)]
    assert (violations[0].value, violations[0].time) == pytest.approx((9.0, 0.25), abs=1e-9)
    assert str(violations[0]) == "the velocity of q1 is 9 at t = 0.25 s, beyond its limit 4"


def test_limit_violations_see_an_excursion_between_two_ends_inside(prr):
    """q1 from 0 to 0 with v0 = 8, T = 2: q = 16 τ − 32 τ² + 16 τ³, largest 64/27 at τ = 1/3."""
    trajectory = cubic([0, 0, 0], [0, 0, 0], 2, [8, 0, 0], [0, 0, 0])
    position = next(v for v in limit_violations(prr, trajectory) if v.quantity == "position")
    assert (position.joint, position.limit) == ("q1", 2.0)
    assert (position.value, position.time) == pytest.approx((64 / 27, 2 / 3), abs=1e-12)


def test_joints_without_limits_violate_nothing():
    robot = arm("continuous")
    trajectory = cubic([0, 0, 0], [50, 0, -50], 1)
    assert limit_violations(robot, trajectory) == ()


def test_touching_a_limit_is_allowed(prr):
    assert limit_violations(prr, cubic([0, 0, 0], [2, 0, 0], 2)) == ()  # speed 1.5, position 2: both the limit


# --- misuse


@pytest.mark.parametrize("t", [-0.1, 2.1, nan, inf, "now", None, [0.5, 3]])
def test_times_outside_the_motion_are_input_errors(t):
    trajectory = cubic([0], [1], 2)
    for motion in (trajectory, trajectory.velocity, trajectory.acceleration):
        with pytest.raises(InputError):
            motion(t)


@pytest.mark.parametrize(
    "arguments",
    [
        ([0, 0], [1], 1),
        ([0], [1], 0),
        ([0], [1], -1),
        ([0], [1], nan),
        ([nan], [1], 1),
        ([0, 0], [1, 1], 1, [1, 2, 3]),
        ([0, 0], [1, 1], 1, 0, [inf, 0]),
        ("a", "b", 1),
        ([[0]], [[1]], 1),
        ([0], [1], None),
    ],
)
def test_boundary_conditions_that_do_not_agree_are_input_errors(arguments):
    with pytest.raises(InputError):
        cubic(*arguments)


def test_the_integral_of_a_velocity_is_the_motion_from_its_start():
    """v = 2t for 3 s, then 6 for 1 s: x = 1 + t², then 10 + 6 (t − 3)."""
    motion = PiecewisePolynomial.from_pieces([([0.0, 6.0], 3.0), ([6.0], 1.0)]).integral(1.0)
    np.testing.assert_allclose(motion([0.0, 2.0, 3.0, 3.5, 4.0]), [1, 5, 10, 13, 16])
    several = cubic([0.0, 1.0], [2.0, -1.0], 0.7, v0=[0.3, -0.2])
    back = several.rate.integral([0.0, 1.0])
    t = np.linspace(0, 0.7, 11)
    np.testing.assert_allclose(back(t), several(t), atol=1e-15)
    state = PiecewisePolynomial.from_pieces([([[4.0, 5.0]], 0.0)]).integral([1.0, 2.0])
    np.testing.assert_array_equal([state(0.0), state.velocity(0.0)], [[1, 2], [4, 5]])
