"""Polynomial and trigonometric laws: coefficients, peaks, derivatives, one-sided values, shapes, misuse."""

from math import inf, nan, pi, sqrt

import numpy as np
import pytest
from hypothesis import given, strategies as st
from motions import RATES, assert_derivatives, dense_peak
from scipy.interpolate import BPoly

import robotics1 as r1

LAWS = {
    "cubic": r1.cubic,
    "quintic": r1.quintic,
    "septic": r1.trajectories.septic,
    "cosine": r1.trajectories.cosine,
    "cycloidal": r1.trajectories.cycloidal,
}
number = st.floats(-5, 5)
pair = st.tuples(number, number).map(np.array)
duration = st.floats(0.2, 5)

# From rest to rest over Δ in T: |q̇| Tˡ/Δ, |q̈|, |d³q/dt³| at most, and the first τ at which.
PEAKS = {
    "cubic": [(3 / 2, 1 / 2), (6, 0), (12, 0)],
    "quintic": [(15 / 8, 1 / 2), (10 / sqrt(3), 1 / 2 - sqrt(3) / 6), (60, 0)],
    "septic": [(35 / 16, 1 / 2), (84 / 25 * sqrt(5), 1 / 2 - sqrt(5) / 10), (105 / 2, 1 / 2)],
    "cosine": [(pi / 2, 1 / 2), (pi**2 / 2, 0), (pi**3 / 2, 1 / 2)],
    "cycloidal": [(2, 1 / 2), (2 * pi, 1 / 4), (4 * pi**2, 0)],
}


# --- closed forms


@pytest.mark.parametrize("name", sorted(LAWS))
@pytest.mark.parametrize(("delta", "T"), [(1.0, 1.0), (-2.5, 0.7), (0.3, 4.0)])
def test_rest_to_rest_peaks_are_c_delta_over_T_to_the_order(name, delta, T):
    law = LAWS[name](0.4, 0.4 + delta, T).joint()
    for order, (c, tau) in enumerate(PEAKS[name], start=1):
        peak = (law.peak(1), law.peak(2), law.peak(3))[order - 1]
        assert abs(peak.value) == pytest.approx(c * abs(delta) / T**order, rel=1e-12)
        assert peak.time == pytest.approx(tau * T, abs=1e-9 * T)
        assert getattr(law, RATES[order - 1])(peak.time) == pytest.approx(peak.value, rel=1e-9)
    assert (law(0), law(law.end), law.duration) == pytest.approx((0.4, 0.4 + delta, T), abs=1e-14)


def test_rest_to_rest_coefficients_are_those_of_every_book():
    assert r1.quintic(0, 1, 3).coefficients[:, 0].tolist() == [0, 0, 0, 10, -15, 6]
    assert r1.trajectories.septic(0, 1, 3).coefficients[:, 0].tolist() == [0, 0, 0, 0, 35, -84, 70, -20]
    t = r1.quintic(0, 2, 0.5).coefficients_t[:, 0]
    assert t == pytest.approx([0, 0, 0, 20 / 0.5**3, -30 / 0.5**4, 12 / 0.5**5])


@given(pair, pair, duration, pair, pair, pair, pair)
def test_quintic_and_septic_are_scipys_bernstein_polynomials_of_the_same_derivatives(q0, q1, T, v0, v1, a0, a1):
    t = np.linspace(0, T, 9)
    for motion, ends in (
        (r1.cubic(q0, q1, T, v0, v1), [[q0, v0], [q1, v1]]),
        (r1.quintic(q0, q1, T, v0, v1, a0, a1), [[q0, v0, a0], [q1, v1, a1]]),
        (r1.trajectories.septic(q0, q1, T, v0, v1, a0, a1), [[q0, v0, a0, 0 * a0], [q1, v1, a1, 0 * a1]]),
    ):
        bernstein = BPoly.from_derivatives([0, T], ends)
        for order, f in enumerate((motion, motion.velocity, motion.acceleration, motion.jerk)):
            wanted = bernstein(t, nu=order)
            assert f(t) == pytest.approx(wanted, abs=1e-11 * (1 + np.abs(wanted).max()) / min(T, 1) ** order)


def test_cosine_and_cycloidal_are_their_formulas():
    t = np.linspace(0, 3, 11)
    tau = t / 3
    assert r1.trajectories.cosine([1], [3], 3)(t)[:, 0] == pytest.approx(1 + (1 - np.cos(pi * tau)), abs=1e-15)
    assert r1.trajectories.cycloidal([1], [3], 3)(t)[:, 0] == pytest.approx(
        1 + 2 * (tau - np.sin(2 * pi * tau) / (2 * pi)), abs=1e-15
    )
    assert r1.trajectories.cycloidal([1], [3], 3).acceleration([0, 3])[:, 0] == pytest.approx([0, 0], abs=1e-14)
    assert r1.trajectories.cosine([1], [3], 3).acceleration([0, 3])[:, 0] == pytest.approx(
        [pi**2 / 9, -(pi**2) / 9], abs=1e-14
    )


@pytest.mark.parametrize("name", sorted(LAWS))
def test_laws_are_point_symmetric_about_the_middle(name):
    law = LAWS[name](0, 1, 2).joint()
    t = np.linspace(0, 1, 6)
    assert law(1 - t) + law(1 + t) == pytest.approx(np.ones(6), abs=1e-14)


# --- derivatives and extremes


@pytest.mark.parametrize("name", sorted(LAWS))
def test_velocity_acceleration_and_jerk_are_the_derivatives(name):
    assert_derivatives(LAWS[name]([0.5, -1], [3, 0.2], 1.5))


@given(pair, pair, duration, pair, pair, pair)
def test_no_sample_passes_the_extremes_of_any_order(q0, q1, T, v0, v1, a0):
    for motion in (r1.quintic(q0, q1, T, v0, v1, a0, -a0), r1.trajectories.septic(q0, q1, T, v0, v1, a0, -a0)):
        for order in (1, 2, 3):
            _, values = motion.extremes(order)
            largest, dense = np.abs(values).max(), dense_peak(motion, order)
            assert dense <= largest * (1 + 1e-9)
            assert dense == pytest.approx(largest, rel=1e-4, abs=1e-9)


def test_extremes_where_the_leading_coefficients_are_only_rounding():
    """A parabola written as a quintic has its extreme where the parabola has it."""
    motion = r1.quintic(0.1, 0.1 + 0.3 - 0.7, 1, 0.3, 0.3 - 1.4, -1.4, -1.4)
    times, values = motion.extremes()
    assert times[1, 0] == pytest.approx(0.3 / 1.4, abs=1e-9)
    assert values[1, 0] == pytest.approx(0.1 + 0.3**2 / 2.8, abs=1e-12)


def test_equal_peaks_are_told_at_the_earlier_instant():
    law = r1.cubic(0, 1, 2).joint()
    assert (law.peak(2).value, law.peak(2).time) == (1.5, 0.0)
    back = r1.cubic(1, 0, 2).joint()
    assert (back.peak(2).value, back.peak(2).time) == (-1.5, 0.0)


# --- polynomials through any derivatives


def test_polynomial_through_five_conditions_has_degree_four():
    quartic = r1.trajectories.polynomial_through([(0, 0, [0, 1]), (0, 1, 0), (1, 0, 2), (2, 0, [1, 3]), (2, 1, 0)])
    assert quartic.coefficients_t == pytest.approx(np.array([[0, 1], [0, 0], [6.75, 1.5], [-6.25, -0.5], [1.5, 0]]))
    assert quartic.duration == 2


@given(pair, pair, duration, pair, pair)
def test_polynomial_through_the_ends_derivatives_is_the_quintic(q0, q1, T, v0, a1):
    conditions = [(0, 0, q0), (T, 0, q1), (0, 1, v0), (T, 1, 0), (0, 2, 0), (T, 2, a1)]
    wanted = r1.quintic(q0, q1, T, v0, 0, 0, a1)
    assert r1.trajectories.polynomial_through(conditions).coefficients == pytest.approx(wanted.coefficients, abs=1e-9)


def test_polynomial_through_meets_derivatives_of_every_order_at_inner_instants():
    conditions = [(0, 0, 1.0), (0.5, 1, -2.0), (0.5, 2, 3.0), (1.25, 0, 0.4), (2, 3, 7.0)]
    q = r1.trajectories.polynomial_through(conditions)
    for t, order, value in conditions:
        assert (q, q.velocity, q.acceleration, q.jerk)[order](t) == pytest.approx([value], abs=1e-12)


@pytest.mark.parametrize(
    ("conditions", "message"),
    [
        ([(0, 0, 1), (0, 0, 2), (1, 0, 0)], "given twice"),
        ([(0, 0, 1), (0, 0, 1), (1, 0, 0)], "given twice"),
        ([(0, 0, 0), (1, 0, 1), (0.5, 1, 1)], "do not determine"),
        ([(0, 1, 0), (1, 1, 1)], "do not determine"),
        ([(0, 0, 0), (0, 1, 1)], "more than one instant"),
        ([(-1, 0, 0), (1, 0, 1)], "non-negative"),
        ([(0, -1, 0), (1, 0, 1)], "at least 0"),
        ([(0, 0, [0, 1]), (1, 0, [1, 2, 3])], "shape"),
        ([(0, 0), (1, 0, 1)], r"\(t, order, value\)"),
        ([], "empty"),
        (3, r"\(t, order, value\)"),
        ([(0, 0, nan), (1, 0, 1)], "finite"),
    ],
)
def test_contradictory_conditions_are_input_errors(conditions, message):
    with pytest.raises(r1.InputError, match=message):
        r1.trajectories.polynomial_through(conditions)


# --- shapes and sides


@pytest.mark.parametrize("name", sorted(LAWS))
def test_a_law_gives_a_number_for_a_number_and_k_for_k_times(name):
    law = LAWS[name]([0, 5], [1, 7], 2).joint(1)
    for f in (law, law.velocity, law.acceleration, law.jerk):
        assert isinstance(f(1), float)
        assert f([0, 1, 2]).shape == (3,)
        assert f([0, 1, 2])[1] == f(1)
    assert law.breakpoints.shape == (0,)


@pytest.mark.parametrize("name", sorted(LAWS))
def test_a_motion_gives_n_for_a_number_and_k_by_n_for_k_times(name):
    motion = LAWS[name]([0, 5, 1], [1, 7, 1], 2)
    for f in (motion, motion.velocity, motion.acceleration, motion.jerk):
        assert f(1).shape == (3,)
        assert f(np.linspace(0, 2, 5)).shape == (5, 3)
        assert f(np.linspace(0, 2, 5))[4] == pytest.approx(f(2), abs=1e-15)
    assert motion.velocity(1)[2] == 0


@pytest.mark.parametrize("name", sorted(LAWS))
@pytest.mark.parametrize("t", [-0.1, 2.1, nan, inf, "now", None, [0.5, 3]])
def test_times_outside_are_input_errors(name, t):
    motion = LAWS[name]([0], [1], 2)
    for f in (motion, motion.velocity, motion.jerk, motion.joint(), motion.joint().acceleration):
        with pytest.raises(r1.InputError):
            f(t)


@pytest.mark.parametrize("name", sorted(LAWS))
def test_misuse_of_laws_is_an_input_error(name):
    law = LAWS[name]
    for arguments in (
        ([0, 0], [1], 1),
        ([0], [1], 0),
        ([0], [1], -1),
        ([0], [1], nan),
        ("a", "b", 1),
        ([[0]], [[1]], 1),
    ):
        with pytest.raises(r1.InputError):
            law(*arguments)
    motion = law([0, 1], [1, 2], 2)
    for call in (lambda: motion.velocity(1, side="middle"), lambda: motion.joint(2), lambda: motion.joint(-1)):
        with pytest.raises(r1.InputError):
            call()


def test_numbers_that_leave_the_range_of_floats_are_input_errors():
    for arguments in ((0, 1, 1e-31), (0, 1, 1e31), (0, -1e31, 1)):
        for law in LAWS.values():
            with pytest.raises(r1.InputError, match=r"larger than 1e\+30, or unreasonably small"):
                law(*arguments)
    assert r1.quintic(0, 1, 1e-30).extremes(3)[1].max() == pytest.approx(60e90)


# --- stretching


@pytest.mark.parametrize("name", sorted(LAWS))
def test_stretched_by_k_divides_the_derivatives_by_powers_of_k(name):
    motion = LAWS[name]([0, 5], [1, 3], 2)
    slow = r1.curves.stretched(motion, 3)
    t = np.linspace(0, 2, 9)
    assert slow.duration == pytest.approx(6)
    assert slow(3 * t) == pytest.approx(motion(t), abs=1e-14)
    for order, rate in enumerate(RATES, start=1):
        assert getattr(slow, rate)(3 * t) == pytest.approx(getattr(motion, rate)(t) / 3**order, abs=1e-12)
    law = r1.curves.stretched(motion.joint(1), 3)
    assert law(3 * t) == pytest.approx(motion(t)[:, 1], abs=1e-14)
    for factor in (0, -1, inf, "k"):
        with pytest.raises(r1.InputError):
            r1.curves.stretched(motion, factor)
