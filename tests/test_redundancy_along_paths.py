"""Several tasks along trajectories, by priority and within rate limits."""

import numpy as np
import pytest

import robotics1 as r1
from robotics1.redundancy import NearObjective, follow_by_priority

XY = r1.PositionTask("xy")
FOUR = r1.textbook_robots.planar_arm("RRRR", [1.0, 1.0, 1.0, 1.0])
Q0 = np.array([0.3, 0.6, -0.9, 0.7])
TIP = XY.value(FOUR, Q0)
LINE = r1.line_path(TIP, TIP + np.array([-0.6, 0.4]))
MOTION = r1.curves.PathTrajectory(LINE, r1.cubic(0, LINE.end, 2.0))
ELBOW = r1.PositionTask("y", frame="link3")


def test_both_levels_are_met_where_they_are_compatible():
    height = ELBOW.value(FOUR, Q0)
    run = follow_by_priority(FOUR, [(XY, MOTION, 10), (ELBOW, height, 10)], Q0, samples=21).require()
    assert run.complete
    assert XY.value(FOUR, run.q[-1]) == pytest.approx(LINE(LINE.end), abs=1e-7)
    assert [ELBOW.value(FOUR, q)[0] for q in run.q] == pytest.approx([height[0]] * 21, abs=1e-7)
    moved = np.gradient(run.q, run.t, axis=0)[1:-1]
    assert run.qdot[1:-1] == pytest.approx(moved, abs=0.02)
    assert run.scales == pytest.approx(np.ones((21, 2)))


def test_a_lower_level_that_is_in_conflict_does_not_disturb_the_first():
    run = follow_by_priority(FOUR, [(XY, MOTION, 10), (ELBOW, [3.5], 1)], Q0, damping=0.3, samples=11)
    assert run.largest_errors[0] < 1e-6
    assert run.largest_errors[1] > 0.1
    with pytest.raises(r1.NotConverged, match="level 2"):
        run.require()


def test_an_objective_uses_what_is_left():
    rest = np.zeros(4)
    plain = follow_by_priority(FOUR, [(XY, MOTION)], Q0, samples=11)
    near = follow_by_priority(FOUR, [(XY, MOTION)], Q0, objective=NearObjective(rest), gain=3.0, samples=11)
    assert near.largest_errors[0] < 1e-6
    assert np.linalg.norm(near.q[-1]) < np.linalg.norm(plain.q[-1]) - 0.05


def test_rates_stay_within_their_limits_and_the_path_is_followed():
    free = follow_by_priority(FOUR, [(XY, MOTION, 10)], Q0, samples=41)
    fastest = np.abs(free.qdot).max(axis=0)
    limit = np.where(fastest == fastest.max(), 0.7, 2.0) * fastest
    held = follow_by_priority(FOUR, [(XY, MOTION, 10)], Q0, limits=limit, samples=41).require()
    assert (np.abs(free.qdot) > limit).any()
    assert (np.abs(held.qdot) <= limit + 1e-12).all()
    assert held.scales == pytest.approx(np.ones((41, 1)))
    slow = follow_by_priority(FOUR, [(XY, MOTION, 10)], Q0, limits=0.05, samples=11)
    assert (slow.scales < 1).any()
    assert slow.largest_errors[0] > 1e-3
    assert "slowed down" in slow.explain()


@pytest.mark.parametrize(
    ("levels", "options", "words"),
    [
        ([], {}, "levels must be a list"),
        ([(XY,)], {}, "level 1 must be"),
        ([(XY, TIP)], {}, "at least one level needs a trajectory"),
        ([(ELBOW, MOTION)], {}, "must have 1 rows"),
        ([(XY, MOTION, -1)], {}, "gain of level 1 must not be negative"),
        ([(XY, MOTION)], {"limits": 1.0, "damping": 0.1}, "leave out objective="),
    ],
)
def test_misuse_says_what_would_be_right(levels, options, words):
    with pytest.raises(r1.InputError, match=words):
        follow_by_priority(FOUR, levels, Q0, **options)
