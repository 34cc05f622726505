"""Whatever is handed to the functions of timing and splines: a finite motion or a Robotics1Error, nothing else."""

from math import inf

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings, strategies as st
from test_misuse import JUNK, answer

import robotics1 as r1

VIA = [[0, 0], [1, 1], [0, 0]]
LIMITS = r1.MotionLimits(1, 2)

# Of anything: what each function makes of a, b, c, d.
FUNCTIONS = {
    "quintic": lambda a, b, c, d: r1.quintic(a, b, c, d, d, d),
    "septic": r1.trajectories.septic,
    "cosine": lambda a, b, c, d: r1.trajectories.cosine(a, b, c),
    "cycloidal": lambda a, b, c, d: r1.trajectories.cycloidal([0, 1], [1, 2], a),
    "trapezoidal": lambda a, b, c, d: r1.trapezoidal(a, b, c, d, acceleration=5),
    "trapezoidal, V": lambda a, b, c, d: r1.trapezoidal([0, 1], [1, 2], 2, a, velocity=b),
    "bang_bang": r1.trajectories.bang_bang,
    "double_s": lambda a, b, c, d: r1.trajectories.double_s([0, 1], [1, 2], a, acceleration=b, jerk=c),
    "cruise_profile": lambda a, b, c, d: r1.trajectories.cruise_profile(a, b, acceleration=c, jerk=d),
    "polynomial_through": lambda a, b, c, d: r1.trajectories.polynomial_through([(0, 0, a), (b, 0, 1.0), (1, c, d)]),
    "polynomial_through, all": lambda a, b, c, d: r1.trajectories.polynomial_through(a),
    "limits": r1.MotionLimits,
    "norms": lambda a, b, c, d: r1.trajectories.NormLimits(a, b, c, d, rows=a),
    "minimum_time": lambda a, b, c, d: r1.minimum_time(a, b, LIMITS, v0=c, v1=d),
    "minimum_time, limits": lambda a, b, c, d: r1.minimum_time([0, 1], [1, 2], r1.MotionLimits(a, b, c), "double_s"),
    "minimum_time, options": lambda a, b, c, d: r1.minimum_time([0, 1], [1, 2], a, b, coordination=c),
    "minimum_duration": lambda a, b, c, d: r1.trajectories.minimum_duration(lambda T: r1.cubic(0, 1, T), a, at_least=b),
    "minimum_duration, limits": lambda a, b, c, d: r1.trajectories.minimum_duration(
        lambda T: r1.cubic(0, 1, T), LIMITS, at_least=a
    ),
    "minimum_duration, motion": lambda a, b, c, d: r1.trajectories.minimum_duration(lambda T: a, LIMITS),
    "scale_to_limits": lambda a, b, c, d: r1.trajectories.scale_to_limits(a, LIMITS),
    "scale_to_limits, limits": lambda a, b, c, d: r1.trajectories.scale_to_limits(r1.cubic([0], [1], 1), a),
    "stretched": lambda a, b, c, d: r1.curves.stretched(r1.cubic([0], [1], 1), a),
    "stretched, motion": lambda a, b, c, d: r1.curves.stretched(a, 2),
    "cubic_spline": lambda a, b, c, d: r1.cubic_spline(b, a),
    "cubic_spline, ends": lambda a, b, c, d: r1.cubic_spline([0, 1, 2], VIA, v0=a, v1=b, bc_type=c),
    "cubic_spline, times": lambda a, b, c, d: r1.cubic_spline(a, VIA, a0=b, a1=c),
    "cubic_hermite_spline": lambda a, b, c, d: r1.trajectories.cubic_hermite_spline([0, 1, 2], [0, 1, 2], a),
    "polynomial_spline": lambda a, b, c, d: r1.trajectories.polynomial_spline([0, 1, 2], VIA, a, b, continuity=c),
    "polynomial_spline, conditions": lambda a, b, c, d: r1.trajectories.polynomial_spline(
        [0, 1, 2], VIA, (3, 3), [(0, 1, a), (b, c, d)]
    ),
    "virtual_point_spline": lambda a, b, c, d: r1.trajectories.virtual_point_spline([0, 1, 2], VIA, a, b, c, d),
    "knot_times": lambda a, b, c, d: r1.trajectories.knot_times(a, b, c),
    "JointTrajectory": lambda a, b, c, d: r1.curves.JointTrajectory(a),
    "JointTrajectory, one": lambda a, b, c, d: r1.curves.JointTrajectory((r1.cubic(0, 1, 1).joint(), a)),
    "PiecewisePolynomial": lambda a, b, c, d: r1.curves.PiecewisePolynomial(a, b),
}


def assert_finite(found):
    """A motion has finite values, derivatives and extremes; other answers are let pass."""
    motion = getattr(found, "trajectory", found)
    if not hasattr(motion, "jerk") or not hasattr(motion, "duration"):
        return
    T = motion.duration
    assert 0 <= T < inf
    for t in (0.0, T / 2, T, [0.0, T]):
        for f in (motion, motion.velocity, motion.acceleration, motion.jerk):
            assert np.isfinite(f(t)).all()
    for order in range(4):
        assert np.isfinite(motion.extremes(order)[1]).all()


@pytest.mark.parametrize("name", sorted(FUNCTIONS))
@settings(suppress_health_check=list(HealthCheck))
@given(a=JUNK, b=JUNK, c=JUNK, d=JUNK)
def test_anything_is_refused_or_gives_a_finite_motion(name, a, b, c, d):
    assert_finite(answer(FUNCTIONS[name], a, b, c, d))


EXTREME = [0.0, 1.0, -1.0, 0.5, 1e-17, 1e-12, 1e-300, 1e9, -1e9, 1e29, 1e150, 1e300, -1e300, 1e-150]
number = st.sampled_from(EXTREME) | st.floats(allow_nan=False, allow_infinity=False) | st.floats(-3, 3)
positive = number.map(abs) | st.just(inf)

# Of numbers of any size: positions q and r, velocities v and w, a duration T and two bounds V and A.
MOTIONS = {
    "quintic": lambda q, r, v, w, T, V, A: r1.quintic(q, r, T, v, w, v, w),
    "septic": lambda q, r, v, w, T, V, A: r1.trajectories.septic(q, r, T, v, w, v, w),
    "cosine": lambda q, r, v, w, T, V, A: r1.trajectories.cosine(q, r, T),
    "trapezoidal, V": lambda q, r, v, w, T, V, A: r1.trapezoidal(q, r, T, v, w, velocity=V),
    "trapezoidal, A": lambda q, r, v, w, T, V, A: r1.trapezoidal(q, r, T, v, w, acceleration=A),
    "bang_bang": lambda q, r, v, w, T, V, A: r1.trajectories.bang_bang(q, r, T, v, w),
    "double_s": lambda q, r, v, w, T, V, A: r1.trajectories.double_s(q, r, T, acceleration=V, jerk=A),
    "least time": lambda q, r, v, w, T, V, A: r1.minimum_time(q, r, r1.MotionLimits(V, A), v0=v, v1=w),
    "least time, double-S": lambda q, r, v, w, T, V, A: r1.minimum_time(
        q, r, r1.MotionLimits(T, V, A), "double_s", v0=v, v1=w
    ),
    "least time, cubic": lambda q, r, v, w, T, V, A: r1.minimum_time(q, r, r1.MotionLimits(V, A), "cubic", v0=v, v1=w),
    "least time, bang-bang": lambda q, r, v, w, T, V, A: r1.minimum_time(
        q, r, r1.MotionLimits(V, A), "bang_bang", v0=v, v1=w
    ),
    "least time, straight": lambda q, r, v, w, T, V, A: r1.minimum_time(
        [q, r], [v, w], r1.MotionLimits(V, A), coordination="straight"
    ),
    "scaled": lambda q, r, v, w, T, V, A: r1.trajectories.scale_to_limits(
        r1.cubic(q, r, T, v, w), r1.MotionLimits(V, A)
    ),
    "spline": lambda q, r, v, w, T, V, A: r1.cubic_spline([0, T, V], [q, r, v]),
    "mixed": lambda q, r, v, w, T, V, A: r1.trajectories.polynomial_spline([0, T, V], [q, r, v], (4, 4)),
    "through": lambda q, r, v, w, T, V, A: r1.trajectories.polynomial_through(
        [(0, 0, q), (0, 1, v), (T, 0, r), (T, 1, w)]
    ),
}


@pytest.mark.parametrize("name", sorted(MOTIONS))
@given(q=number, r=number, v=number, w=number, T=positive, V=positive, A=positive)
def test_numbers_of_any_size_are_refused_or_give_a_finite_motion(name, q, r, v, w, T, V, A):
    assert_finite(answer(MOTIONS[name], q, r, v, w, T, V, A))
