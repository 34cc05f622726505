"""The fastest motion along a path: closed forms, bounds held and touched, faster than any scaled law; misuse."""

import sys

import numpy as np
import pytest

import robotics1 as r1

V, A = np.array([2.2, 2.2, 2.6]), np.array([15, 7.5, 10.0])
LIMITS = r1.MotionLimits(V, A)
CURVE = r1.trajectories.spline_path([[0, 0, 0], [1, -1, 0.5], [0.5, 1, 2], [2, 0, 1]])
PATHS = {
    "spline": CURVE,
    "parabolic blends": r1.curves.polyline_path([[0, 0, 0], [1, 0, 1], [1, 1, 0]], blend=0.2),
    "arc": r1.curves.arc_through([0, 0, 0], [1, 0, 0.5], [1, 1, 1]),
    "spline by arc length": r1.curves.by_arc_length(CURVE),
}


@pytest.mark.parametrize(
    ("goal", "v", "a"), [([1, 0.5, 0], 2.2, 15), ([0.2, -2, 1], 2.2, 7.5), ([0.01, 0.02, 0], 2.2, 7.5)]
)
def test_along_a_line_it_is_the_trapezoid_of_the_tightest_joint(goal, v, a):
    """Of the bounds V/|Δ| and A/|Δ| on s ∈ [0, 1]: T = 1/v + v/a, or 2/√a."""
    goal = np.array(goal)
    share = np.abs(goal)
    v, a = (V[share > 0] / share[share > 0]).min(), (A[share > 0] / share[share > 0]).min()
    wanted = 1 / v + v / a if v**2 <= a else 2 / np.sqrt(a)
    answer = r1.trajectories.time_optimal(r1.line_path([0, 0, 0], goal), LIMITS, grid=400)
    assert answer.duration == pytest.approx(wanted, rel=5e-3)
    assert answer.duration >= wanted * (1 - 1e-6)
    assert {demand.quantity for demand in answer.active} <= {"velocity", "acceleration"}
    assert answer.active


@pytest.mark.parametrize("kind", sorted(PATHS))
def test_the_bounds_hold_everywhere_and_one_is_touched(kind):
    answer = r1.trajectories.time_optimal(PATHS[kind], LIMITS)
    t = np.linspace(0, answer.duration, 30_001)
    motion = answer.trajectory
    use = max((np.abs(motion.velocity(t)) / V).max(), (np.abs(motion.acceleration(t)) / A).max())
    assert use == pytest.approx(1, abs=1e-4)
    assert answer.active
    assert motion(0.0) == pytest.approx(PATHS[kind](0.0))
    assert motion(answer.duration) == pytest.approx(PATHS[kind](PATHS[kind].end))
    assert motion.velocity([0, answer.duration]) == pytest.approx(np.zeros((2, 3)), abs=1e-6)


@pytest.mark.parametrize("kind", sorted(PATHS))
def test_a_bound_is_nearly_used_at_every_instant(kind):
    """A time-optimal law is bang-bang: at each s some joint is at a bound, but for the grid."""
    answer = r1.trajectories.time_optimal(PATHS[kind], LIMITS, grid=400)
    motion, t = answer.trajectory, np.linspace(0.02, 0.98, 301) * answer.duration
    use = np.maximum((np.abs(motion.velocity(t)) / V).max(axis=1), (np.abs(motion.acceleration(t)) / A).max(axis=1))
    assert np.quantile(use, 0.05) > 0.9


def test_it_is_faster_than_the_best_trapezoid_scaled_to_the_bounds():
    laws = (r1.trapezoidal(0, CURVE.end, 1, velocity=f * CURVE.end).joint() for f in (1.05, 1.2, 1.5, 2))
    scaled = min(r1.trajectories.scale_to_limits(r1.curves.PathTrajectory(CURVE, law), LIMITS).duration for law in laws)
    assert r1.trajectories.time_optimal(CURVE, LIMITS).duration < 0.85 * scaled


def test_a_finer_grid_needs_less_correction_and_no_more_time():
    coarse, fine = (r1.trajectories.time_optimal(CURVE, LIMITS, grid=n) for n in (50, 400))
    assert 1 <= fine.correction < coarse.correction
    assert fine.correction < 1.01
    assert fine.duration < coarse.duration


@pytest.mark.parametrize(
    ("arguments", "options", "message"),
    [
        ((3, LIMITS), {}, "path must be a path of points"),
        ((CURVE, (1, 1)), {}, "must be MotionLimits"),
        ((CURVE, r1.MotionLimits(1)), {}, "each joint needs a bound on the acceleration"),
        ((CURVE, r1.MotionLimits(acceleration=1)), {}, "each joint needs a bound on the velocity"),
        ((CURVE, r1.MotionLimits(1, 1, 1)), {}, "leave out the other bounds"),
        ((CURVE, r1.MotionLimits(1, 1, deceleration=2)), {}, "leave out the other bounds"),
        ((CURVE, r1.MotionLimits([1, 1], 1)), {}, "shape"),
        ((CURVE, LIMITS), {"grid": 3}, "grid"),
        ((r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]]), r1.MotionLimits(1, 1)), {}, "the tangent jumps at s = 1,"),
        (
            (r1.trajectories.spline_path([[0, 0], [1, 1]], bc_type="clamped"), r1.MotionLimits(1, 1)),
            {},
            "no tangent at s = 0",
        ),
    ],
)
def test_misuse_of_fastest_along_is_an_input_error(arguments, options, message):
    with pytest.raises(r1.InputError, match=message):
        r1.trajectories.time_optimal(*arguments, **options)


def test_without_toppra_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "toppra", None)
    with pytest.raises(r1.MissingExtraError, match=r"robotics1\[toppra\]"):
        r1.trajectories.time_optimal(CURVE, LIMITS)
