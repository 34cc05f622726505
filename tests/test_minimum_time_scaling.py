"""Uniform time scaling to bounds on joints and on norms, the shortest duration of a shape, and violated limits."""

from math import inf, pi, sqrt

import numpy as np
import pytest
from hypothesis import given, strategies as st

import robotics1 as r1

bound = st.floats(0.2, 5)


class Lissajous:
    """q = (sin t, 2 cos 3t), 0 ≤ t ≤ 2: a motion of somebody else, without extremes of its own."""

    duration = 2.0

    def __call__(self, t):
        return np.stack([np.sin(t), 2 * np.cos(3 * np.asarray(t))], axis=-1)

    def velocity(self, t, *, side="right"):
        return np.stack([np.cos(t), -6 * np.sin(3 * np.asarray(t))], axis=-1)

    def acceleration(self, t, *, side="right"):
        return np.stack([-np.sin(t), -18 * np.cos(3 * np.asarray(t))], axis=-1)

    def jerk(self, t, *, side="right"):
        return np.stack([-np.cos(t), 54 * np.sin(3 * np.asarray(t))], axis=-1)


# --- joints


@given(bound, bound, bound)
def test_factor_is_the_largest_of_v_ratio_root_of_a_ratio_cube_root_of_j_ratio(V, A, J):
    """From 0 to 1 in 1 s the cubic has peaks 3/2, 6, 12."""
    scaling = r1.trajectories.scale_to_limits(r1.cubic([0], [1], 1), r1.MotionLimits(V, A, J))
    ratios = {"velocity": 1.5 / V, "acceleration": sqrt(6 / A), "jerk": np.cbrt(12 / J)}
    assert scaling.factor == pytest.approx(max(ratios.values()))
    assert scaling.duration == pytest.approx(scaling.factor)
    assert max(ratios, key=ratios.get) in {demand.quantity for demand in scaling.active}
    assert {use.quantity: use.stretch for use in scaling.uses} == pytest.approx(ratios)


@given(st.tuples(bound, bound), st.tuples(bound, bound), st.tuples(bound, bound))
def test_a_scaled_motion_keeps_every_bound_and_touches_one(q1, V, A):
    motion = r1.trapezoidal([0, 0], q1, 2, velocity=0.75 * np.array(q1))
    scaling = r1.trajectories.scale_to_limits(motion, r1.MotionLimits(V, A))
    used = [np.abs(scaling.trajectory.extremes(k)[1]).max(axis=0) / b for k, b in ((1, V), (2, A))]
    assert np.max(used) == pytest.approx(1)
    assert isinstance(scaling.trajectory, r1.curves.JointTrajectory)
    touched = {(int(j), k) for k, row in enumerate(used) for j in np.flatnonzero(row > 1 - 1e-7)}
    names = ["velocity", "acceleration"]
    assert touched <= {(demand.joint, names.index(demand.quantity)) for demand in scaling.active}


def test_scaling_slows_down_or_speeds_up_or_only_slows_down():
    motion, loose = r1.cubic([0], [1], 1), r1.MotionLimits(velocity=3)
    assert r1.trajectories.scale_to_limits(motion, loose).factor == pytest.approx(0.5)
    kept = r1.trajectories.scale_to_limits(motion, loose, speed_up=False)
    assert (kept.factor, kept.active) == (1.0, ())
    assert r1.trajectories.scale_to_limits(
        motion, r1.MotionLimits(velocity=0.5), speed_up=False
    ).factor == pytest.approx(3)


def test_any_motion_is_scaled_by_the_exact_extremes_of_its_interpolants():
    limits = r1.MotionLimits(velocity=[0.5, 4], acceleration=[1, 6])
    scaling = r1.trajectories.scale_to_limits(Lissajous(), limits)
    assert scaling.factor == pytest.approx(max(1 / 0.5, 6 / 4, sqrt(1 / 1), sqrt(18 / 6)), rel=1e-12)
    (active,) = scaling.active
    assert (active.joint, active.quantity, active.value, active.time) == pytest.approx((0, "velocity", 0.5, 0))
    slow, t = scaling.trajectory, np.linspace(0, 2, 7)
    assert slow.duration == pytest.approx(4)
    assert slow(2 * t) == pytest.approx(Lissajous()(t))
    assert slow.velocity(2 * t) == pytest.approx(Lissajous().velocity(t) / 2)
    assert slow.acceleration(2 * t, side="left") == pytest.approx(Lissajous().acceleration(t) / 4)
    assert slow.jerk(1.0) == pytest.approx(Lissajous().jerk(0.5) / 8)
    assert slow.breakpoints.size == 0
    with pytest.raises(r1.InputError):
        slow(4.1)


def test_extremes_of_any_motion_are_those_of_the_formula():
    times, values = r1.curves.stretched(Lissajous(), 1.0).extremes(1)
    assert values == pytest.approx(np.array([[np.cos(2), -6], [1, 6]]), abs=1e-12)
    assert times == pytest.approx(np.array([[2, pi / 6], [0, pi / 2]]), abs=1e-6)
    motion = r1.quintic([0, 1], [1, -1], 2, 0.4, -0.3)
    plain = type("Plain", (), {n: getattr(motion, n) for n in ("velocity", "acceleration", "jerk", "duration")})
    plain.__call__ = lambda self, t: motion(t)
    for order in range(4):
        values = r1.curves.stretched(plain(), 1.0).extremes(order)[1]
        assert values == pytest.approx(motion.extremes(order)[1], abs=1e-10)


def test_extremes_of_a_law_are_of_shape_2():
    times, values = r1.cubic(0, 2, 1).joint().extremes(1)
    assert times.shape == values.shape == (2,)


# --- norms


def test_norm_bounds_of_a_circle_are_v_v2_over_r_and_the_tangential_acceleration():
    """Radius 0.5 at 1 m/s: the normal acceleration is 2 m/s²."""
    law = r1.trapezoidal(0, 2, 3, velocity=1).joint()  # ramps of 1 s, 1 m/s²
    motion = r1.curves.PathTrajectory(r1.curves.circle_path([0, 0, 0], 0.5), law)
    scaling = r1.trajectories.scale_to_limits(motion, r1.trajectories.NormLimits(normal_acceleration=0.5))
    assert scaling.factor == pytest.approx(2)
    assert [(demand.quantity, demand.joint) for demand in scaling.active] == [("normal acceleration", None)]
    assert str(scaling.active[0]).startswith("the norm of the normal acceleration is 0.5 at t = ")
    whole = r1.trajectories.scale_to_limits(motion, r1.trajectories.NormLimits(velocity=1, acceleration=1))
    assert whole.factor == pytest.approx(5**0.25)  # √(1² + 2²) at the end of a ramp
    assert r1.trajectories.scale_to_limits(
        motion, r1.trajectories.NormLimits(velocity=0.1, acceleration=1)
    ).factor == pytest.approx(10)


@given(st.tuples(bound, bound, bound), st.tuples(bound, bound, bound), bound, bound)
def test_norms_of_a_cubic_in_space_are_the_roots_of_polynomials(v0, v1, V, A):
    """|ṗ|² is a polynomial of degree 4 in τ: its largest value from NumPy's roots."""
    motion = r1.cubic([0, 0, 0], [1, -1, 2], 2, v0, v1)
    scaling = r1.trajectories.scale_to_limits(motion, r1.trajectories.NormLimits(velocity=V, acceleration=A))
    expected = []
    for rate, limit, order in ((motion.rate, V, 1), (motion.rate.rate, A, 2)):
        square = sum(np.polynomial.Polynomial(c) ** 2 for c in rate.coefficients.T)
        places = [x.real for x in square.deriv().roots() if abs(x.imag) < 1e-9 and 0 < x.real < 1]
        expected.append((np.sqrt(max(square(x) for x in (0, 1, *places))) / limit) ** (1 / order))
    assert scaling.factor == pytest.approx(max(expected), rel=1e-9)


def test_rows_choose_the_coordinates_of_the_norm():
    motion = r1.cubic([0, 0], [3, 4], 1.5)
    assert r1.trajectories.scale_to_limits(motion, r1.trajectories.NormLimits(velocity=5)).factor == pytest.approx(1)
    assert r1.trajectories.scale_to_limits(
        motion, r1.trajectories.NormLimits(velocity=5, rows=slice(0, 1))
    ).factor == pytest.approx(0.6)


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: r1.trajectories.scale_to_limits(r1.cubic(0, 1, 1), (1, 2)), "MotionLimits"),
        (lambda: r1.trajectories.scale_to_limits(3, r1.MotionLimits(1)), "trajectory must be a motion"),
        (lambda: r1.trajectories.scale_to_limits(r1.cubic(0, 0, 1), r1.MotionLimits(1)), "nothing moves"),
        (lambda: r1.trajectories.scale_to_limits(r1.cubic(0, 1, 1), r1.MotionLimits()), "there is none"),
        (lambda: r1.trajectories.scale_to_limits(r1.cubic([0, 0], [1, 1], 1), r1.MotionLimits([1, 1, 1])), "shape"),
        (
            lambda: r1.trajectories.scale_to_limits(r1.cubic(0, 1, 1), r1.MotionLimits(1, 1, deceleration=2)),
            "constant accelerations",
        ),
        (lambda: r1.trajectories.NormLimits(velocity=0), "positive"),
        (lambda: r1.trajectories.NormLimits(acceleration=[1, 2]), "shape"),
    ],
)
def test_misuse_of_scaling_is_an_input_error(call, message):
    with pytest.raises(r1.InputError, match=message):
        call()


# --- the shortest duration of a shape


def test_shortest_duration_with_given_accelerations_at_the_ends():
    limits = r1.MotionLimits(velocity=2, acceleration=5, jerk=40)

    def motion(T):
        return r1.quintic([0, 1], [1, -2], T, v0=[0.5, 0.9], a0=[1, -2], a1=[0, 3])

    T = r1.trajectories.minimum_duration(motion, limits)

    def used(T):
        return max(np.abs(motion(T).extremes(k)[1]).max() / b for k, b in ((1, 2), (2, 5), (3, 40)))

    assert used(T) == pytest.approx(1, abs=1e-9)
    assert min(used(x) for x in np.linspace(0.02, 0.9999, 100) * T) > 1


@pytest.mark.parametrize(
    ("bounds", "velocities", "accelerations", "distance"),
    [
        ((0.8808, 1.8499, 18.0488), (-0.4512, 0.3506), (1.8374, 1.4710), 1.1953),
        ((0.7049, 1.4732, 19.1478), (0.5231, -0.2856), (-1.0677, 0.1291), 1.4317),
    ],
)
def test_shortest_duration_before_durations_that_violate_the_same_bound_again(
    bounds, velocities, accelerations, distance
):
    """The violated bound is kept for a while at the same τ and then passed again, within eight times the duration."""

    def used(T):
        motion = r1.quintic(0, distance, T, *velocities, *accelerations)
        return max(np.abs(motion.extremes(k)[1]).max() / bound for k, bound in enumerate(bounds, start=1))

    T = r1.trajectories.minimum_duration(
        lambda T: r1.quintic(0, distance, T, *velocities, *accelerations), r1.MotionLimits(*bounds)
    )
    assert used(T) == pytest.approx(1, abs=1e-9)
    assert min(used(x) for x in np.linspace(0.05, 0.9999, 200) * T) > 1


def test_shortest_duration_does_not_miss_a_window_before_durations_that_will_not_do():
    """Straight on at 1 m/s over 0.1 m is possible in 0.1 s; a little later it would need 6·0.05/0.15² m/s² and more."""

    def motion(T):
        return r1.cubic(0, 0.1, T, 1, 1)

    loose = r1.MotionLimits(velocity=2, acceleration=2)  # 6 (0.1 − T)/T² = 2, while 6 (T − 0.1)/T² = 2 is soon after
    assert r1.trajectories.minimum_duration(motion, loose) == pytest.approx((sqrt(40.8) - 6) / 4)
    limits = r1.MotionLimits(velocity=1, acceleration=2)
    assert r1.trajectories.minimum_duration(motion, limits) == pytest.approx(0.1)
    later = r1.trajectories.minimum_duration(motion, limits, at_least=0.11)
    assert later > 2
    assert np.abs(motion(later).extremes(2)[1]).max() == pytest.approx(2)
    for T in np.linspace(0.11, 0.999 * later, 40):
        assert np.abs(motion(T).extremes(2)[1]).max() > 2


def test_shortest_duration_of_a_mixed_spline():
    q, shares, limits = [0, 1, 3, 2], np.array([0, 0.3, 0.6, 1]), r1.MotionLimits(2, 3, 20)
    T = r1.trajectories.minimum_duration(lambda T: r1.trajectories.polynomial_spline(T * shares, q, (4, 3, 4)), limits)
    once = r1.trajectories.scale_to_limits(r1.trajectories.polynomial_spline(shares, q, (4, 3, 4)), limits)
    assert pytest.approx(once.duration, rel=1e-9) == T  # at rest at the ends both are the same


@pytest.mark.parametrize(
    ("motion", "limits", "message"),
    [
        (
            lambda T: r1.cubic(0, 1, T, v0=3),
            r1.MotionLimits(1, 1),
            "no duration keeps these bounds: joint 0's velocity",
        ),
        (lambda T: r1.quintic(0, 1, T, a1=3), r1.MotionLimits(acceleration=1), "joint 0's acceleration passes 1"),
        (lambda T: r1.cubic(0, 0, T, 1, 1), r1.MotionLimits(velocity=1), "arbitrarily short"),
        (lambda T: r1.cubic(0, 1, T), r1.MotionLimits(), "no bound"),
        (lambda T: r1.cubic(0, 1, T), r1.MotionLimits(1, 1, deceleration=2), "trapezoidal"),
        (lambda T: r1.cubic(0, 1, T, v0=np.sin(9 * T)), r1.MotionLimits(9, 1), "powers of T"),
        (3, r1.MotionLimits(1), "function of the duration"),
    ],
)
def test_misuse_of_shortest_duration_is_an_input_error(motion, limits, message):
    with pytest.raises(r1.InputError, match=message):
        r1.trajectories.minimum_duration(motion, limits)


# --- limits of a robot


def test_limit_violations_of_every_kind_of_motion_are_exact(planar_2r):
    """The velocity limits of the arm are 4 rad/s."""
    for motion, peak, time in (
        (r1.trajectories.cosine([0, 0], [3, 1], 1), 1.5 * pi, 0.5),
        (r1.trapezoidal([0, 0], [3, 1], 1, velocity=[5, 1.5]), 5, 0.4),
        (r1.cubic_spline([0, 0.5, 1], [[0, 0], [1, 0], [3, 1]]), None, None),
        (r1.curves.stretched(r1.quintic([0, 0], [3, 1], 2), 0.5), 15 / 8 * 3, 0.5),
    ):
        (violation,) = r1.trajectories.limit_violations(planar_2r, motion)
        assert (violation.joint, violation.quantity, violation.limit) == ("q1", "velocity", 4)
        if peak is not None:
            assert (violation.value, violation.time) == pytest.approx((peak, time), abs=1e-6)


def test_limit_violations_of_more_limits(planar_2r):
    motion = r1.cubic([0, 0], [1, 0.5], 1)
    assert r1.trajectories.limit_violations(planar_2r, motion) == ()
    found = r1.trajectories.limit_violations(
        planar_2r, motion, r1.MotionLimits(velocity=[9, 0.5], acceleration=4, jerk=[inf, 5])
    )
    assert [(v.joint, v.quantity, v.limit) for v in found] == [
        ("q2", "velocity", 0.5),
        ("q1", "acceleration", -4),
        ("q1", "acceleration", 4),
        ("q2", "jerk", -5),
    ]
    assert [v.value for v in found] == pytest.approx([0.75, -6, 6, -6])


def test_limit_violations_of_another_robots_motion_are_input_errors(planar_2r):
    with pytest.raises(r1.InputError, match="of 3 joints; the robot has 2"):
        r1.trajectories.limit_violations(planar_2r, r1.cubic([0] * 3, [1] * 3, 1))
    with pytest.raises(r1.InputError, match="limits must be MotionLimits"):
        r1.trajectories.limit_violations(planar_2r, r1.cubic([0, 0], [1, 1], 1), (1, 2))


def test_the_acceleration_in_a_sharp_bend_of_a_spline_is_found_to_the_rounding_of_its_values():
    """κ = 85/m over 3 m, by arc length: the values are rounded to 1e-12, and no interpolant is finer."""
    path = r1.curves.by_arc_length(r1.trajectories.spline_path([[2.4, 0.6, 0.8], [0.8, -0.6, -0.1], [1.4, -0.4, 0.2]]))
    motion = r1.curves.PathTrajectory(path, r1.cubic(0, path.end, 2).joint())
    peak = r1.trajectories.peak_norm(motion, "acceleration")
    t = peak.time + np.linspace(-1e-3, 1e-3, 20001)
    assert peak.resolved
    assert np.linalg.norm(motion.acceleration(t), axis=1).max() == pytest.approx(peak.value, rel=1e-8)
    scaled = r1.trajectories.scale_to_limits(motion, r1.trajectories.NormLimits(acceleration=2))
    assert r1.trajectories.peak_norm(scaled.trajectory, "acceleration").value == pytest.approx(2, rel=1e-8)


def test_a_motion_that_is_noise_is_an_input_error():
    class Noise:
        duration = 1.0
        breakpoints = ()

        def __call__(self, t, side="right"):
            return np.sin(1e9 * np.atleast_1d(t) ** 2)[:, None] if np.ndim(t) else np.zeros(1)

        velocity = acceleration = jerk = __call__

    with pytest.raises(r1.InputError, match="oscillates too quickly"):
        r1.trajectories.scale_to_limits(Noise(), r1.trajectories.NormLimits(acceleration=2))
    with pytest.raises(r1.InputError, match="oscillates too quickly"):
        r1.trajectories.scale_to_limits(Noise(), r1.MotionLimits(acceleration=2))


@pytest.mark.parametrize("motion", [r1.cubic([0.0], [2.0], 1.0), r1.curves.line_path([0, 0], [1, 1])])
def test_a_motion_in_the_place_of_a_function_of_its_duration_is_told_apart(motion):
    with pytest.raises(r1.InputError, match=r"and it is a motion; .* scale_to_limits"):
        r1.trajectories.minimum_duration(motion, r1.MotionLimits(velocity=1.0))
