"""Inverse kinematics by priority: every level by forward kinematics, and its least error by brute force."""

from math import atan2, cos, hypot, pi, sin, sqrt

import numpy as np
import pytest
from arms import arm, random_q
from hypothesis import given, strategies as st
from scipy.optimize import minimize

import robotics1 as r1
from robotics1.redundancy import PriorityIKStatus, ik_by_priority

XY = r1.PositionTask("xy")
ELBOW = r1.PositionTask("y", frame="link3")
FOUR = r1.textbook_robots.planar_arm("RRRR", [1.0, 1.0, 1.0, 1.0])
THREE = r1.textbook_robots.planar_arm("RRR", [1.0, 0.8, 0.5])
REALISED, LEAST = PriorityIKStatus.REALISED, PriorityIKStatus.LEAST_ERROR
seeds = st.integers(0, 10**6)


def statuses(found):
    return [level.status for level in found.levels]


def tips(lengths, q):
    """The ends of the links of a planar arm, by hand."""
    angles = np.cumsum(q)
    return np.cumsum([[length * cos(a), length * sin(a)] for length, a in zip(lengths, angles, strict=True)], axis=0)


def test_levels_that_are_compatible_are_all_realised():
    found = ik_by_priority(FOUR, [(XY, [2.0, 1.0]), (ELBOW, [0.5])], [0.1, 0.2, 0.3, 0.4]).require()
    ends = tips([1, 1, 1, 1], found.q)
    assert ends[3] == pytest.approx([2, 1], abs=1e-9)
    assert ends[1][1] == pytest.approx(0.5, abs=1e-9)
    assert [level.freedom for level in found.levels] == [4, 2]
    assert "level 2: realised" in found.explain()


@pytest.mark.parametrize("start", [[0.1, 0.2, 0.3, 0.4], [0, 0, 0, 0], [2.0, -1.0, 0.5, 0.4]])
def test_an_arm_stretches_towards_a_target_out_of_its_reach(start):
    """|e| = |r_d| − 4, with q = (atan2(1, 5), 0, 0, 0): the second level has no choice."""
    found = ik_by_priority(FOUR, [(XY, [5.0, 1.0]), (ELBOW, [0.5])], start, starts=4)
    assert statuses(found) == [LEAST, LEAST]
    assert found.levels[0].error_norm == pytest.approx(hypot(5, 1) - 4, abs=1e-9)
    assert np.sin(found.q) == pytest.approx([sin(atan2(1, 5)), 0, 0, 0], abs=1e-6)
    assert found.levels[1].freedom == 0
    assert found.converged
    with pytest.raises(r1.NotConverged, match="level 1: not realised"):
        found.require()


def test_a_start_at_the_largest_error_is_left():
    """The arm points away from its target, on one line with it: the slope is zero there, and nothing is the least."""
    found = ik_by_priority(THREE, [(XY, [-1.0, 0.0])], [0.0, 0.0, 0.0]).require()
    assert tips([1.0, 0.8, 0.5], found.q)[2] == pytest.approx([-1, 0], abs=1e-9)


def test_the_least_error_of_the_second_level_is_that_of_all_self_motions_by_brute_force():
    """The tip of a 3R arm is held: for each direction of the last link both elbows of the other two, by hand."""
    target, wanted = np.array([1.2, 0.9]), 1.1
    best = np.inf
    for phi in np.linspace(-pi, pi, 20001):
        x, y = target - 0.5 * np.array([cos(phi), sin(phi)])
        c = (x * x + y * y - 1 - 0.64) / 1.6
        for s in (sqrt(1 - c * c), -sqrt(1 - c * c)) if abs(c) <= 1 else ():
            best = min(best, abs(wanted - sin(atan2(y, x) - atan2(0.8 * s, 1 + 0.8 * c))))
    levels = [(XY, target), (r1.PositionTask("y", frame="link2"), [wanted])]
    found = ik_by_priority(THREE, levels, [0.3, 0.8, 0.2], starts=10)
    assert statuses(found) == [REALISED, LEAST]
    assert found.levels[1].error_norm == pytest.approx(best, abs=1e-7)


@given(seeds)
def test_no_motion_that_keeps_the_first_level_makes_the_second_better(seed):
    """Of drawn targets, from the answer: SLSQP with the first level as its constraint finds nothing better."""
    rng = np.random.default_rng(seed)
    first = tips([1] * 4, rng.uniform(-2, 2, 4))[3]
    second = rng.uniform(-3, 3, 2)
    middle = r1.PositionTask("xy", frame="link3")
    found = ik_by_priority(FOUR, [(XY, first), (middle, second)], rng.uniform(-2, 2, 4))
    ends = tips([1] * 4, found.q)
    assert ends[3] == pytest.approx(first, abs=1e-8)
    assert found.levels[1].error == pytest.approx(second - ends[1], abs=1e-9)
    assert found.converged
    better = minimize(
        lambda q: np.sum((tips([1] * 4, q)[1] - second) ** 2),
        found.q,
        method="SLSQP",
        constraints={"type": "eq", "fun": lambda q: tips([1] * 4, q)[3] - first},
        options={"ftol": 1e-12},
    )
    near = np.abs(better.x - found.q).max() < 0.1 and np.abs(tips([1] * 4, better.x)[3] - first).max() < 1e-8
    assert not near or sqrt(better.fun) >= found.levels[1].error_norm - 1e-5


@pytest.mark.parametrize("name", ["six_r", "prr", "cylindrical", "planar_3r"])
def test_on_arms_of_every_kind_a_lower_level_leaves_the_higher_ones_as_they_are(name):
    robot = arm(name)
    goal, start = random_q(robot, 5), random_q(robot, 6)
    first, second, third = r1.PositionTask("z"), r1.PositionTask("x"), r1.PositionTask("y")
    levels = [(first, first.value(robot, goal)), (second, second.value(robot, goal)), (third, [50.0])]
    found = ik_by_priority(robot, levels, start, starts=3)
    T = r1.forward_kinematics(robot, found.q).translation
    assert statuses(found)[:2] == [REALISED, REALISED]
    assert T[2] == pytest.approx(levels[0][1][0], abs=1e-8)
    assert T[0] == pytest.approx(levels[1][1][0], abs=1e-8)
    assert found.levels[2].error == pytest.approx([50 - T[1]], abs=1e-12)
    alone = ik_by_priority(robot, levels[:1], start)
    assert alone.levels[0].status is REALISED


def test_a_pose_first_and_the_height_of_the_elbow_with_the_freedom_that_is_left():
    rows = [("R", 0, a, d, 0) for a, d in ((-pi / 2, 0.34), (pi / 2, 0), (pi / 2, 0.4), (-pi / 2, 0))]
    rows += [("R", 0, -pi / 2, 0.4, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, 0, 0.126, 0)]
    seven = r1.robot_from_dh(rows)
    goal = np.array([0.3, 0.7, -0.2, 1.1, 0.4, -0.8, 0.2])
    T, elbow = r1.forward_kinematics(seven, goal), r1.PositionTask("z", frame="link4")
    at_goal = elbow.value(seven, goal)[0]
    start = goal + 0.3
    reached = ik_by_priority(seven, [("pose", T), (elbow, [at_goal])], start).require()
    assert r1.forward_kinematics(seven, reached.q).isApprox(T, 1e-7)
    assert elbow.value(seven, reached.q) == pytest.approx([at_goal], abs=1e-8)
    assert [level.freedom for level in reached.levels] == [7, 1]
    highest = ik_by_priority(seven, [("pose", T), (elbow, [3.0])], start)
    assert statuses(highest) == [REALISED, LEAST]
    assert elbow.value(seven, highest.q)[0] > at_goal


def test_an_orientation_that_no_planar_arm_has_is_approached_as_far_as_the_position_allows():
    """The planar arm turns about z: of a turn by 0.5 about x the nearest rotation is none at all, 0.5 away."""
    levels = [
        (XY, [1.5, 0.4]),
        (r1.OrientationTask(), np.array([[1, 0, 0], [0, cos(0.5), -sin(0.5)], [0, sin(0.5), cos(0.5)]])),
    ]
    found = ik_by_priority(THREE, levels, [0.2, 0.5, -0.3], starts=4)
    assert statuses(found) == [REALISED, LEAST]
    assert found.levels[1].error_norm == pytest.approx(0.5, abs=1e-8)
    assert sum(found.q) % (2 * pi) == pytest.approx(0.0, abs=1e-5) or sum(found.q) % (2 * pi) == pytest.approx(2 * pi)


# --- within the joint limits


def limited(seed):
    """A planar arm of four joints with drawn lengths and limits."""
    rng = np.random.default_rng(seed)
    lengths, low, high = rng.uniform(0.3, 1, 4), rng.uniform(-2, -0.1, 4), rng.uniform(0.1, 2, 4)
    robot = r1.robot_from_dh([("R", x, 0, 0, 0) for x in lengths], lower=low.tolist(), upper=high.tolist())
    return rng, robot, lengths, low, high


@given(seeds)
def test_within_limits_no_configuration_near_the_answer_is_better_at_the_first_level(seed):
    """Targets inside, at and beyond what the limits leave: a bounded minimisation from the answer finds no less."""
    rng, robot, lengths, low, high = limited(seed)
    target = rng.uniform(-1, 1, 2) * lengths.sum()
    found = ik_by_priority(robot, [(XY, target)], rng.uniform(-3, 3, 4))
    assert found.within_limits
    assert (found.q >= low).all()
    assert (found.q <= high).all()
    assert found.levels[0].error == pytest.approx(target - tips(lengths, found.q)[3], abs=1e-9)
    assert found.converged
    better = minimize(
        lambda q: np.sum((tips(lengths, q)[3] - target) ** 2),
        found.q,
        bounds=list(zip(low, high, strict=True)),
        method="L-BFGS-B",
        options={"ftol": 1e-15, "gtol": 1e-10},
    )
    near = np.abs(better.x - found.q).max() < 0.1
    assert not near or sqrt(better.fun) >= found.levels[0].error_norm - 1e-5


@given(seeds)
def test_within_limits_no_motion_that_keeps_the_first_level_makes_the_second_better(seed):
    rng, robot, lengths, low, high = limited(seed)
    target, second = tips(lengths, rng.uniform(low, high))[3], rng.uniform(-2, 2, 2)
    middle = r1.PositionTask("xy", frame="link3")
    found = ik_by_priority(robot, [(XY, target), (middle, second)], rng.uniform(low, high))
    if found.levels[0].status is not REALISED:
        return  # the descent ended in another least error of the first level
    assert found.within_limits
    assert found.levels[1].error == pytest.approx(second - tips(lengths, found.q)[2], abs=1e-9)
    assert found.converged
    better = minimize(
        lambda q: np.sum((tips(lengths, q)[2] - second) ** 2),
        found.q,
        method="SLSQP",
        bounds=list(zip(low, high, strict=True)),
        constraints={"type": "eq", "fun": lambda q: tips(lengths, q)[3] - target},
        options={"ftol": 1e-12},
    )
    near = np.abs(better.x - found.q).max() < 0.1 and np.abs(tips(lengths, better.x)[3] - target).max() < 1e-8
    assert not near or sqrt(better.fun) >= found.levels[1].error_norm - 1e-5


def test_by_hand_a_shoulder_that_stops_at_45_degrees_leaves_the_projection_on_its_line():
    """Of one joint, 0 ≤ q ≤ π/4, to (0, 1): the tip stops at 45°, and |e| = 2 sin(22.5°)."""
    one = r1.robot_from_dh([("R", 1, 0, 0, 0)], lower=[0.0], upper=[pi / 4])
    found = ik_by_priority(one, [(XY, [0.0, 1.0])], [0.1])
    assert found.q == pytest.approx([pi / 4], abs=1e-12)
    assert found.levels[0].status is LEAST
    assert found.levels[0].error_norm == pytest.approx(2 * sin(pi / 8), abs=1e-12)
    free = ik_by_priority(one, [(XY, [0.0, 1.0])], [0.1], limits=False).require()
    assert free.q == pytest.approx([pi / 2])
    assert not free.within_limits
    away = ik_by_priority(one, [(XY, [0.0, 1.0])], [0.0])  # from the other limit
    assert away.q == pytest.approx([pi / 4], abs=1e-12)


def test_joints_with_one_limit_or_with_no_room_between_two():
    """Two slides: x ≥ 0.5 alone, and y = 0.2 fixed."""
    cross = r1.robot_from_transforms(["Tx(q1)", "Ty(q2)"], lower=[0.5, 0.2], upper=[np.inf, 0.2])
    far = ik_by_priority(cross, [(XY, [7.0, 1.0])], [0.0, 0.0])
    assert far.q == pytest.approx([7.0, 0.2], abs=1e-9)
    near = ik_by_priority(cross, [(XY, [-3.0, 0.2])], [4.0, 0.2])
    assert near.q == pytest.approx([0.5, 0.2], abs=1e-9)
    assert [found.levels[0].status for found in (far, near)] == [LEAST, LEAST]
    below = r1.robot_from_transforms(["Tx(q1)"], lower=[-np.inf], upper=[0.5])
    assert ik_by_priority(below, [(r1.PositionTask("x"), [3.0])], [-9.0]).q == pytest.approx([0.5])
    assert ik_by_priority(below, [(r1.PositionTask("x"), [-8.0])], [0.4]).require().q == pytest.approx([-8.0])


def test_a_level_in_conflict_leaves_to_the_next_what_it_does_not_need():
    """Six links: y of the third cannot be 9, and is 3 with three of them upright; the others have one freedom left."""
    arm_6 = r1.textbook_robots.planar_arm("RRRRRR", [1.0] * 6)
    last = (r1.PositionTask("x", frame="link6"), [1.4])
    levels = [(XY, [2.0, 1.0]), (r1.PositionTask("y", frame="link4"), [9.0]), last]
    found = ik_by_priority(arm_6, levels, [0.1, 0.2, 0.3, 0.4, 0.5, 0.6], starts=3)
    assert statuses(found) == [REALISED, LEAST, REALISED]
    assert [level.freedom for level in found.levels] == [6, 4, 1]
    ends = tips([1] * 6, found.q)
    assert ends[2] == pytest.approx([0, 3], abs=1e-6)
    assert ends[5] == pytest.approx([2, 1], abs=1e-9)
    assert ends[4][0] == pytest.approx(1.4, abs=1e-9)


@pytest.mark.parametrize(
    ("levels", "options", "words"),
    [
        ([(XY, [1, 1])], {"limits": [1, 2]}, "limits must be True or False"),
        ([], {}, "levels must be a list of pairs"),
        ([XY], {}, "level 1 must be a pair"),
        ([(XY, [1, 1]), (XY, [0, 1])], {}, "the same task as one before it"),
        ([(XY, [1, 2, 3])], {}, "shape"),
        ([(r1.PositionTask("x", reference="tool"), [1])], {}, "tool"),
        ([(XY, [1, 1])], {"tolerance": 0}, "tolerance must be a positive number"),
        ([(XY, [1, 1])], {"starts": 0}, "starts must be an integer of at least 1"),
    ],
)
def test_misuse_says_what_would_be_right(levels, options, words):
    with pytest.raises(r1.Robotics1Error, match=words):
        ik_by_priority(THREE, levels, [0.1, 0.2, 0.3], **options)
