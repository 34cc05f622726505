"""Numbers of any size in tracking, meeting and timing along a path: a finite answer or a Robotics1Error."""

import warnings
from contextlib import suppress

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st

import robotics1 as r1

SIZES = [0.0, 1.0, -1.0, 0.5, 5e-324, 1e-300, 1e-150, 1e-30, 1e-12, 1e12, 1e30, 1e150, 1e300, 1.7e308, np.inf, np.nan]
number = st.sampled_from(SIZES) | st.floats(-3, 3)
CALLS = {
    "simulate_tracking": lambda a, b, c, d: r1.simulate_tracking(r1.cubic([a], [b], c), [d], 1.0, samples=3).q,
    "simulate_tracking, gain": lambda a, b, c, d: (
        r1.simulate_tracking(r1.cubic([0], [1], 1), [a], b, rate_limits=c, samples=3).command
    ),
    "smallest_gain": lambda a, b, c, d: r1.control.smallest_gain(r1.cubic([0], [1], 1), [a], b).gain,
    "time_optimal": lambda a, b, c, d: (
        r1.trajectories.time_optimal(r1.line_path([0, 0], [a, b]), r1.MotionLimits(c, d), grid=10).duration
    ),
    "timing_bounds": lambda a, b, c, d: (
        r1.trajectories.timing_bounds(r1.curves.arc_path([0, 0], [a, b], 1.0), c, d).velocity
    ),
    "parabolic_blends": lambda a, b, c, d: r1.curves.parabolic_blends([[0, 0], [a, 0], [a, b]], c, d).duration,
    "linear_segments_with_blends": lambda a, b, c, d: (
        r1.trajectories.linear_segments_with_blends([0, 1, c], [a, b, 0], acceleration=d).duration
    ),
    "joins": lambda a, b, c, d: r1.curves.CurveSequence((r1.cubic(a, b, c), r1.cubic(b, a, d))).joins[0].jumps,
    "stretched": lambda a, b, c, d: r1.curves.stretched(r1.cubic(a, b, c), d).velocity(0.0),
    "knot_times": lambda a, b, c, d: r1.trajectories.knot_times([a, b, c], d),
    "cubic_hermite_spline": lambda a, b, c, d: r1.trajectories.cubic_hermite_spline([0, 1, d], [a, b, c]).duration,
}


@pytest.mark.parametrize("name", CALLS)
@settings(max_examples=15)
@given(a=number, b=number, c=number, d=number)
def test_numbers_of_any_size_give_a_finite_answer_or_a_typed_error(name, a, b, c, d):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with suppress(r1.Robotics1Error):
            assert np.isfinite(CALLS[name](a, b, c, d)).all()
