"""Trapezoidal, bang-bang and double-S profiles of a given duration; one-sided values at their switching times."""

from math import inf, nan, sqrt

import numpy as np
import pytest
from hypothesis import given, strategies as st
from motions import assert_derivatives

import robotics1 as r1

distance = st.floats(0.05, 5) | st.floats(-5, -0.05)
bound = st.floats(0.2, 5)


# --- trapezoidal


@given(distance, bound, st.floats(1.001, 4))
def test_trapezoid_with_acceleration_a_has_ramps_of_half_t_minus_root(delta, A, slack):
    T = slack * 2 * sqrt(abs(delta) / A)
    law = r1.trapezoidal(1, 1 + delta, T, acceleration=A).joint()
    Ts = T / 2 - sqrt(T**2 / 4 - abs(delta) / A)
    assert law.breakpoints == pytest.approx([Ts, T - Ts], rel=1e-9)
    assert law.peak(1).value == pytest.approx(np.sign(delta) * A * Ts, rel=1e-9)
    assert law.peak(2).value == pytest.approx(np.sign(delta) * A, rel=1e-12)
    assert (law(0), law(law.end), law.duration) == pytest.approx((1, 1 + delta, T), abs=1e-12)
    assert law.velocity(T) == pytest.approx(0, abs=1e-12)


@given(distance, st.floats(0.2, 5), st.floats(1.001, 1.999))
def test_trapezoid_with_cruise_velocity_v_has_acceleration_v2_over_vt_minus_delta(delta, T, share):
    V = share * abs(delta) / T
    law = r1.trapezoidal(0, delta, T, velocity=V).joint()
    assert law.peak(1).value == pytest.approx(np.sign(delta) * V, rel=1e-12)
    assert abs(law.peak(2).value) == pytest.approx(V**2 / (V * T - abs(delta)), rel=1e-9)
    assert law(law.end) == pytest.approx(delta, abs=1e-12)
    assert law.duration == pytest.approx(T, rel=1e-12)


def test_trapezoid_of_least_acceleration_and_greatest_velocity_is_the_triangle():
    for law in (
        r1.trapezoidal(0, 2, 3, acceleration=8 / 9).joint(),
        r1.trapezoidal(0, 2, 3, velocity=4 / 3).joint(),
        r1.trajectories.bang_bang(0, 2, 3).joint(),
    ):
        t = np.linspace(0, 3, 13)
        assert law(t) == pytest.approx(np.where(t < 1.5, 4 / 9 * t**2, 2 - 4 / 9 * (3 - t) ** 2), abs=1e-9)


def test_trapezoid_between_velocities_of_the_same_ramps():
    """From 0.5 to −0.2 with A = 2 and cruise 1: ramps of 0.25 s and 0.6 s go 0.1875 and 0.24."""
    delta = 0.1875 + 0.24 + 1.0 * 1.15
    for options in ({"acceleration": 2}, {"velocity": 1}):
        law = r1.trapezoidal(0, delta, 2.0, 0.5, -0.2, **options).joint()
        assert law.breakpoints == pytest.approx([0.25, 1.4], abs=1e-9)
        assert law.velocity([0, 0.25, 1.4, 2]) == pytest.approx([0.5, 1, 1, -0.2], abs=1e-9)
        assert law.peak(2).value == pytest.approx(2, abs=1e-9)
        assert law(law.end) == pytest.approx(delta, abs=1e-12)


def test_trapezoid_of_joints_takes_a_bound_for_each():
    motion = r1.trapezoidal([0, 1, 5], [1, -1, 5], 2, velocity=[0.6, 1.2, 3])
    assert motion.extremes(1)[1] == pytest.approx(np.array([[0, -1.2, 0], [0.6, 0, 0]]))
    assert motion([0, 2]) == pytest.approx(np.array([[0, 1, 5], [1, -1, 5]]))


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        ((0, 1, 1), {}, "either"),
        ((0, 1, 1), {"acceleration": 5, "velocity": 1.5}, "either"),
        ((0, 1, 1), {"acceleration": 3.9}, "-0.975 to 0.975"),
        ((0, 1, 1), {"acceleration": 0}, "positive"),
        ((0, 1, 1), {"velocity": -1}, "positive"),
        ((0, 1, 1), {"velocity": 1}, "between 1 and 2"),
        ((0, 1, 1), {"velocity": 2.1}, "between 1 and 2"),
        ((0, 1, 0), {"velocity": 1.5}, "positive"),
        ((0, 1, nan), {"velocity": 1.5}, "positive"),
        ((0, 1, 1), {"velocity": [1, 1]}, "shape"),
        ((0, 1, 1), {"velocity": "fast"}, "real numbers"),
        ((0, 0, 1, 1, -1), {"acceleration": 1.9}, "too short for a ramp"),
    ],
)
def test_trapezoids_that_cannot_be_are_input_errors_that_say_what_can(arguments, options, message):
    with pytest.raises(r1.InputError, match=message):
        r1.trapezoidal(*arguments, **options)


# --- bang-bang


@given(st.floats(-5, 5), st.floats(0.2, 5), st.floats(-3, 3), st.floats(-3, 3))
def test_bang_bang_switches_between_two_parabolas_of_opposite_acceleration(delta, T, v0, v1):
    law = r1.trajectories.bang_bang(0.5, 0.5 + delta, T, v0, v1).joint()
    assert law(law.end) == pytest.approx(0.5 + delta, abs=1e-9)
    assert law.velocity([0, T]) == pytest.approx([v0, v1], abs=1e-9)
    assert law.duration == pytest.approx(T, rel=1e-9)
    assert law.acceleration(0) == pytest.approx(law.acceleration(T) * (1 if not law.breakpoints.size else -1))
    assert law.breakpoints.size <= 1


def test_bang_bang_from_rest_to_rest_has_acceleration_4_delta_over_t2():
    law = r1.trajectories.bang_bang(1, -2, 1.5).joint()
    assert law.peak(2).value == pytest.approx(-4 * 3 / 1.5**2)
    assert (law.peak(1).value, law.peak(1).time) == pytest.approx((-2 * 3 / 1.5, 0.75))


def test_bang_bang_at_the_mean_velocity_needs_no_switch():
    assert r1.trajectories.bang_bang(0, 2, 2, 1, 1).joint().peak(2).value == 0
    law = r1.trajectories.bang_bang(0, 2, 2, 0.5, 1.5).joint()
    assert law.acceleration([0, 1, 2]) == pytest.approx([0.5] * 3)


# --- double-S


@given(distance, bound, bound, bound, st.floats(0, 3))
def test_double_s_of_seven_phases_is_the_integral_of_its_jerk(delta, V, A, J, extra):
    V = max(V, A**2 / J)  # so that A is reached
    Tv = extra + abs(delta)
    T = 2 * (V / A + A / J) + Tv
    delta = np.sign(delta) * V * (Tv + V / A + A / J)
    law = r1.trajectories.double_s(0, delta, T, acceleration=A, jerk=J).joint()
    durations = [A / J, V / A - A / J, A / J, Tv, A / J, V / A - A / J, A / J]
    assert [phase.duration for phase in law.phases] == pytest.approx(durations, abs=1e-6 * T)
    assert law.cruise_velocity == pytest.approx(np.sign(delta) * V, rel=1e-9)
    assert abs(law.peak(2).value) == pytest.approx(A, rel=1e-6)
    assert abs(law.peak(3).value) == pytest.approx(J, rel=1e-12)
    assert law(law.end) == pytest.approx(delta, rel=1e-9)


def test_double_s_with_a_jerk_alone_has_ramps_of_two_phases():
    """V = J Tj², with Tj = (T − Tv)/4: here Tj = 0.5, Tv = 1."""
    law = r1.trajectories.double_s(0, 2 * (2 * 0.5 + 1), 3, jerk=8).joint()
    assert law.breakpoints == pytest.approx([0.5, 1, 2, 2.5], abs=1e-9)
    assert law.peak(1).value == pytest.approx(2)
    assert law.peak(2).value == pytest.approx(4)


def test_double_s_is_smooth_where_the_trapezoid_jumps():
    motion = r1.trajectories.double_s([0, 1], [1, 0.5], 3, acceleration=1, jerk=4)
    assert_derivatives(motion)
    for t in motion.breakpoints:
        assert motion.acceleration(t) == pytest.approx(motion.acceleration(t, side="left"), abs=1e-9)
    assert motion.acceleration([0, 3]) == pytest.approx(np.zeros((2, 2)), abs=1e-9)


@given(distance, bound, bound)
def test_the_least_duration_itself_serves_and_no_phase_is_negative(delta, A, J):
    fastest = r1.minimum_time(0, delta, r1.MotionLimits(acceleration=A, jerk=J), "double_s").duration
    law = r1.trajectories.double_s(0, delta, fastest, acceleration=A, jerk=J).joint()
    assert law(law.end) == pytest.approx(delta, rel=1e-9)
    assert min(phase.duration for phase in law.phases) >= 0


@given(distance, bound, bound, st.floats(1.01, 3))
def test_the_peak_velocity_is_told_where_the_cruise_begins(delta, A, J, slack):
    fastest = r1.minimum_time(0, delta, r1.MotionLimits(acceleration=A, jerk=J), "double_s").duration
    law = r1.trajectories.double_s(0, delta, slack * fastest, acceleration=A, jerk=J).joint()
    ramp = sum(phase.duration for phase in law.phases[:3])
    assert law.peak(1).time == pytest.approx(ramp, rel=1e-9)
    assert law.peak(1).value == pytest.approx(law.cruise_velocity, rel=1e-9)


def test_double_s_errors_say_which_durations_serve():
    with pytest.raises(r1.InputError, match=r"the next possible duration is 2\.51984"):
        r1.trajectories.double_s(0, 1, 1, jerk=2)  # the fastest has T³ = 32 Δ/J
    with pytest.raises(r1.InputError, match="positive"):
        r1.trajectories.double_s(0, 1, 3, jerk=-2)


def test_stretched_phases_are_those_of_the_stretched_law():
    law = r1.curves.stretched(r1.trajectories.double_s(0, 2, 3, acceleration=2, jerk=8).joint(), 3)
    starts = np.cumsum([0, *(phase.duration for phase in law.phases)])
    assert starts[-1] == pytest.approx(9) == law.duration
    for phase, start in zip(law.phases, starts, strict=False):
        if phase.duration > 1e-9:
            assert law.jerk(start + phase.duration / 2) == pytest.approx(phase.jerk)
            assert law.acceleration(start + phase.duration / 2) == pytest.approx(
                phase.acceleration + phase.jerk * phase.duration / 2
            )
    cruise = law.phases[3]
    assert (cruise.duration, law.velocity(4.5)) == pytest.approx((law.cruise_time, law.cruise_velocity))


def test_cruise_profile_goes_v_times_cruise_and_ramp_time():
    law = r1.trajectories.cruise_profile(3, 2, acceleration=5, jerk=12, start=1)
    assert law(law.end) - law(0) == pytest.approx(3 * (2 + 3 / 5 + 5 / 12))
    assert law.duration == pytest.approx(2 + 2 * (3 / 5 + 5 / 12))
    back = r1.trajectories.cruise_profile(-3, 2, acceleration=5)
    assert back(back.end) == pytest.approx(-3 * (2 + 3 / 5))
    for arguments in ({"acceleration": inf}, {"acceleration": 0}, {"acceleration": 1, "jerk": -1}):
        with pytest.raises(r1.InputError):
            r1.trajectories.cruise_profile(1, 1, **arguments)
    with pytest.raises(r1.InputError):
        r1.trajectories.cruise_profile(1, -1, acceleration=1)


# --- sides


def test_values_at_switching_times_are_those_of_the_side():
    law = r1.trapezoidal(0, 3, 4, velocity=1).joint()
    t = law.breakpoints
    assert t == pytest.approx([1, 3])
    assert law.acceleration(t).tolist() == pytest.approx([0, -1])
    assert law.acceleration(t, side="left").tolist() == pytest.approx([1, 0])
    assert law.acceleration([0, 4]) == pytest.approx([1, -1])
    assert law.acceleration([0, 4], side="left") == pytest.approx([1, -1])
    assert law.acceleration(np.nextafter(1, 0)) == 0  # a rounded switching time is one
    assert law.acceleration(1 - 1e-9) == pytest.approx(1)


@pytest.mark.parametrize(
    "motion",
    [
        r1.trapezoidal([0, 1], [1, 0.5], 3, acceleration=[1, 2]),
        r1.trapezoidal([0, 1], [1, 0.5], 3, [0.1, -0.2], [0.3, 0], acceleration=[1, 2]),
        r1.trajectories.bang_bang([0, 1], [1, 0.5], 3, [0.1, -0.2], [0.3, 0]),
        r1.trajectories.double_s([0, 1], [1, 0.5], 3, [0.1, -0.2], [0.3, 0], acceleration=[1, 2], jerk=9),
    ],
)
def test_derivatives_between_the_switching_times(motion):
    assert_derivatives(motion)
    for t in motion.breakpoints:
        assert motion(t) == pytest.approx(motion(t - 1e-9), abs=1e-8)
        assert motion.velocity(t) == pytest.approx(motion.velocity(t, side="left"), abs=1e-9)


def test_pieces_have_coefficients_in_tau_and_in_t():
    first, cruise, last = r1.trapezoidal(1, 4, 4, velocity=1).joint().pieces
    assert first.coefficients_t == pytest.approx([1, 0, 0.5])
    assert cruise.coefficients[:2] == pytest.approx([1.5, 2])
    assert (cruise.duration, last.duration) == pytest.approx((2, 1))
    assert last.coefficients == pytest.approx([3.5, 1, -0.5])


# --- joints with laws of their own


def test_a_joint_that_arrives_first_stays():
    motion = r1.curves.JointTrajectory((r1.cubic(0, 1, 1).joint(), r1.trajectories.bang_bang(2, 0, 3).joint()))
    assert motion([0.5, 1, 2, 3])[:, 0] == pytest.approx([0.5, 1, 1, 1])
    assert motion.velocity([0.5, 1, 2])[:, 0] == pytest.approx([1.5, 0, 0])
    assert motion.acceleration(1, side="left") == pytest.approx([-6, -8 / 9])
    assert motion.acceleration(1) == pytest.approx([0, -8 / 9])
    assert motion.breakpoints == pytest.approx([1, 1.5])
    times, values = motion.extremes(2)
    assert values == pytest.approx(np.array([[-6, -8 / 9], [6, 8 / 9]]))
    assert times == pytest.approx(np.array([[1, 0], [0, 1.5]]), abs=1e-12)
    braking = r1.curves.JointTrajectory((r1.trajectories.bang_bang(0, -1, 2, -1).joint(), r1.cubic(0, 1, 3).joint()))
    times, values = braking.extremes(2)  # −1 m/s comes to rest in 2 s with 0.5 m/s², and stays
    assert (times[:, 0], values[:, 0]) == (pytest.approx([2, 0]), pytest.approx([0, 0.5]))
    held = r1.curves.JointTrajectory((r1.trajectories.bang_bang(0, 1, 1, 0, 2).joint(), r1.cubic(0, 1, 1).joint()))
    assert held.extremes(2)[1][0, 0] == pytest.approx(2)  # no end before the others, so no zero


def test_laws_that_cannot_go_together_are_input_errors():
    with pytest.raises(r1.InputError, match="joint 0 arrives at 1 s with the velocity 1"):
        r1.curves.JointTrajectory((r1.cubic(0, 1, 1, v1=1).joint(), r1.cubic(0, 1, 2).joint()))
    with pytest.raises(r1.InputError, match="one timing law for each"):
        r1.curves.JointTrajectory(())
    with pytest.raises(r1.InputError, match="below 1"):
        r1.curves.JointTrajectory((r1.cubic(0, 1, 1).joint(),)).joint(1)
