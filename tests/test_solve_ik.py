"""What `IKSolver` promises: targets at limits and singularities, nearest misses, proofs, starts, batches."""

from itertools import product
from math import cos, hypot, pi, sin, sqrt

import numpy as np
import pinocchio as pin
import pytest
from arms import arm
from dh_arms import P, R, dh
from scipy.optimize import brentq

from robotics1 import (
    FunctionTask,
    IKSolver,
    IKStatus,
    NotConverged,
    PoseTask,
    PositionTask,
    forward_kinematics,
    frame_jacobian,
    load_robot,
    solve_ik,
)
from robotics1.ik.pose_problem import pose_problem
from robotics1.ik.reach import reach_bound

XY = PositionTask("xy")
L1, L2 = 1.2, 0.8
ANGLES = (0.0, 0.7, pi / 2, 2.5, pi, -3.0)
ROBOTS = {"ur5": "tool0", "panda": "panda_link8"}


def robot(name):
    return load_robot(name, tool=ROBOTS[name]) if name in ROBOTS else arm(name)


def polar(r, angle):
    return np.array([r * cos(angle), r * sin(angle)])


def reached(robot, task, target, q0=None, **options):
    """Assert that a target is reached, as Pinocchio sees it, inside the limits; return the answer."""
    found = solve_ik(robot, task, target, q0, **options)
    assert found.status is IKStatus.CONVERGED
    assert robot.within_limits(found.q, tolerance=0.0)
    assert np.linalg.norm(task.error(robot, found.q, target)) <= options.get("tolerance", 1e-6) + 1e-13
    return found


# --- stretched, and beyond


@pytest.mark.parametrize("angle", ANGLES)
def test_the_2r_arm_reaches_l1_plus_l2_stretched_and_l1_minus_l2_folded(planar_2r, angle):
    assert reached(planar_2r, XY, polar(L1 + L2, angle)).q[1] == pytest.approx(0, abs=3e-3)
    assert abs(reached(planar_2r, XY, polar(L1 - L2, angle)).q[1]) == pytest.approx(pi, abs=3e-3)


@pytest.mark.parametrize("angle", ANGLES)
@pytest.mark.parametrize("beyond", [1e-3, 0.5, 100.0])
def test_beyond_l1_plus_l2_the_2r_arm_is_stretched_towards_the_target(planar_2r, angle, beyond):
    target = polar(L1 + L2 + beyond, angle)
    missed = solve_ik(planar_2r, XY, target)
    assert missed.status is IKStatus.UNREACHABLE
    assert missed.error == pytest.approx(beyond, rel=1e-8, abs=1e-8)
    assert np.linalg.norm(XY.error(planar_2r, missed.q, target)) == pytest.approx(missed.error, abs=1e-12)
    assert polar(1, missed.q[0]) == pytest.approx(polar(1, angle), abs=5e-3)
    assert missed.q[1] == pytest.approx(0, abs=5e-3)


@pytest.mark.parametrize("angle", ANGLES[:3])
@pytest.mark.parametrize("distance", [0.05, 0.1, L1 - L2 - 1e-3])
def test_in_the_hole_of_the_annulus_nothing_is_found_and_the_2r_arm_folds_towards_the_target(
    planar_2r, angle, distance
):
    missed = solve_ik(planar_2r, XY, polar(distance, angle), time_limit=0.01)
    assert missed.status is IKStatus.NOT_FOUND
    assert missed.error == pytest.approx(L1 - L2 - distance, abs=1e-6)
    assert polar(1, missed.q[0]) == pytest.approx(polar(1, angle), abs=2e-3)
    assert abs(missed.q[1]) == pytest.approx(pi, abs=2e-3)


def test_beyond_a_limit_of_the_elbow_nothing_is_found_and_the_elbow_is_at_its_limit():
    """|p|² = l1² + l2² + 2 l1 l2 cos q2 is greatest at the lower limit, q2 = 0.3."""
    elbow, l1, l2, limit = arm("elbow_limited"), 0.7, 0.4, 0.3
    farthest = sqrt(l1**2 + l2**2 + 2 * l1 * l2 * cos(limit))
    for angle in (-1.0, 0.2, 1.5):
        assert reached(elbow, XY, polar(farthest, angle)).q[1] == pytest.approx(limit, abs=2e-5)
        missed = solve_ik(elbow, XY, polar(farthest + 5e-3, angle), time_limit=0.01)
        assert missed.status is IKStatus.NOT_FOUND
        assert missed.error == pytest.approx(5e-3, abs=1e-8)
        assert missed.q[1] == pytest.approx(limit, abs=1e-6)


@pytest.mark.parametrize(
    ("name", "q"),
    [
        ("ur5", [0.3, -pi / 2, 0, -pi / 2, 0.4, 0]),
        ("ur5", [0.3, -pi / 2, 0, 0.5, 1.2, 0.7]),
        ("redundant", [0.3, 0, 0, 0, 0, 0, 0]),
        ("redundant", [0.3, 0.9, 0.2, 0, 0.4, 0.8, 1]),
        ("panda", [0.3, 0.2, 0.1, -0.0698, 0.4, 1.0, 0.2, 0]),
        ("panda", [0.3, 0.2, 0.1, -0.0698, 0.4, 0.0, 0.2, 0]),
    ],
)
def test_stretched_arms_reach_their_pose_and_position(name, q):
    stretched = robot(name)
    for task in (PoseTask(), PositionTask()):
        reached(stretched, task, task.value(stretched, q))


@pytest.mark.parametrize("beyond", [1e-3, 1.0])
def test_a_stretched_7r_arm_is_0_946_long_above_its_shoulder_and_a_farther_target_is_proven_out_of_reach(beyond):
    redundant, shoulder = arm("redundant"), np.array([0, 0, 0.36])
    direction = np.array([0.48, 0.6, 0.64])
    missed = solve_ik(redundant, PositionTask(), shoulder + (0.42 + 0.4 + 0.126 + beyond) * direction)
    assert missed.status is IKStatus.UNREACHABLE
    assert missed.error == pytest.approx(beyond, abs=1e-6)


# --- the bound on the reach


@pytest.mark.parametrize(
    ("name", "o", "length"),
    [
        ("planar_2r", (0, 0, 0), L1 + L2),
        ("prr", (0, 0, 0), 2 + 0.6 + 0.4),  # the travel of the slide, and both links
        ("cylindrical", (0, 0, 0), 4 + 4),  # both travels
        ("anthropomorphic", (0, 0, 0.4), 0.5 + 0.35),
        ("redundant", (0, 0, 0.36), 0.42 + 0.4 + 0.126),
    ],
)
def test_the_bound_is_the_sum_of_links_and_travels_from_the_first_axis(name, o, length):
    bound = reach_bound(pose_problem(arm(name), PositionTask()))
    assert bound.o == pytest.approx(np.array(o), abs=1e-6)
    assert bound.length == pytest.approx(length, abs=1e-7)


@pytest.mark.parametrize("name", ["spatial", "six_r", "redundant", "continuous", "elbow_limited", "ur5", "panda"])
def test_no_configuration_is_beyond_the_bound(name):
    some, rng = robot(name), np.random.default_rng(1)
    bound = reach_bound(pose_problem(some, PoseTask()))
    for q in rng.uniform(np.maximum(some.lower, -7), np.minimum(some.upper, 7), (500, some.nq)):
        T = forward_kinematics(some, q)
        assert np.linalg.norm(T.translation - bound.o) <= bound.length + 1e-12
        assert bound.excess(T.homogeneous, np.ones(6)) <= 1e-12
        if bound.hand is not None:
            assert np.linalg.norm(T.act(bound.hand) - bound.o) <= bound.length_to_hand + 1e-12


def test_a_prismatic_joint_without_limits_has_no_bound_and_goes_as_far_as_it_must():
    slide = dh(R("a", pi / 2, 0.2), P(0), a=0.3)
    assert np.isinf(reach_bound(pose_problem(slide, PositionTask())).length)
    target = forward_kinematics(slide, [0.4, 2]).translation
    found = reached(slide, PositionTask(), target)
    assert forward_kinematics(slide, found.q).translation == pytest.approx(target, abs=1e-6)
    assert abs(found.q[1]) == pytest.approx(2, abs=0.7)


# --- at the limits, and at singularities


@pytest.mark.parametrize("name", ["elbow_limited", "prr", "cylindrical", "spatial", "six_r", "redundant", "ur5"])
def test_targets_with_joints_exactly_at_their_limits_are_reached(name):
    limited, rng = robot(name), np.random.default_rng(3)
    lower, upper = limited.lower, limited.upper
    every = list(product([0, 0.5, 1], repeat=limited.nq))
    corners = np.array(every if len(every) < 60 else rng.choice(every, 60))
    configurations = [lower + corner * (upper - lower) for corner in corners]
    for task in (PoseTask(), PositionTask()):
        targets = [task.value(limited, q) for q in configurations]
        batch = IKSolver(limited, task).solve_batch(targets)
        assert batch.converged.all()
        assert np.all((batch.q >= lower) & (batch.q <= upper))


def at_the_shoulder_singularities(ur5, q):
    """The q2 ∈ (−2.9, −0.1) with det J = 0: q3 and q5 are regular there, so the wrist is above the shoulder."""

    def determinant(q2):
        return float(np.linalg.det(frame_jacobian(ur5, [q[0], q2, *q[2:]])))

    if determinant(-2.9) * determinant(-0.1) < 0:
        yield [q[0], brentq(determinant, -2.9, -0.1, xtol=1e-15), *q[2:]]


def singular_configurations(ur5):
    rng = np.random.default_rng(5)
    for _ in range(40):
        q = rng.uniform(-3, 3, 6)
        yield [*q[:4], 0.0, q[5]]  # wrist
        yield [*q[:4], pi, q[5]]
        yield [*q[:2], 0.0, *q[3:]]  # elbow
        yield [*q[:2], 0.0, q[3], 0.0, q[5]]
        q[2], q[4] = rng.uniform(0.8, 1.2), rng.uniform(0.5, 1.5)
        yield from at_the_shoulder_singularities(ur5, q)


def test_targets_exactly_at_singular_configurations_are_reached():
    ur5 = robot("ur5")
    configurations = list(singular_configurations(ur5))
    for q in configurations:
        sigma = np.linalg.svd(frame_jacobian(ur5, q), compute_uv=False)
        assert sigma[-1] < 1e-10 * sigma[0]
    batch = IKSolver(ur5, PoseTask()).solve_batch([forward_kinematics(ur5, q) for q in configurations])
    assert len(configurations) > 170
    assert batch.converged.all()


def test_from_a_stretched_start_an_arm_moves_to_any_target_along_its_radius(planar_2r):
    """At q2 = 0, Jᵀe = 0 for targets on the line through the arm: the start itself leads nowhere."""
    for r in (0.5, 1.0, 1.9, L1 + L2):
        reached(planar_2r, XY, polar(r, 0.4), [0.4, 0.0])


# --- starts, seeds and preferences


def test_the_same_seed_gives_the_same_answer_and_another_seed_another(planar_2r):
    six_r, target = arm("six_r"), forward_kinematics(arm("six_r"), [0.3, -0.5, 0.7, 0.2, 0.4, -0.1])
    first, again = (IKSolver(six_r, PoseTask(), seed=7)(target) for _ in range(2))
    assert np.array_equal(first.q, again.q)
    assert (first.error, first.starts) == (again.error, again.starts)
    others = [IKSolver(six_r, PoseTask(), seed=seed)(target).q for seed in range(5)]
    assert max(np.abs(q - first.q).max() for q in others) > 0.1


def test_solving_twice_with_one_solver_gives_the_same():
    solver, target = IKSolver(arm("redundant"), PoseTask()), forward_kinematics(arm("redundant"), np.full(7, 0.4))
    assert np.array_equal(solver(target).q, solver(target).q)


def test_at_a_solution_the_answer_is_that_solution():
    redundant, q0 = arm("redundant"), np.linspace(-1, 1, 7)
    found = reached(redundant, PoseTask(), forward_kinematics(redundant, q0), q0)
    assert found.q == pytest.approx(q0, abs=1e-14)
    assert found.starts == 1


@pytest.mark.parametrize("turns", [-1, 1])
def test_joints_of_two_turns_stay_within_half_a_turn_of_their_start(turns):
    ur5, rng = robot("ur5"), np.random.default_rng(4)
    for _ in range(50):
        q = rng.uniform(-pi, pi, 6)
        start = q + rng.uniform(-0.2, 0.2, 6)
        start[0] = turns * rng.uniform(pi, 2 * pi)  # so that half a turn around it reaches past the limit of ±2π
        found = reached(ur5, PoseTask(), forward_kinematics(ur5, q), start)
        away = found.q - start
        assert np.all(np.abs(away[[1, 3, 4, 5]]) <= pi + 1e-9)
        other = found.q[0] - 2 * pi * np.sign(away[0])
        assert abs(away[0]) <= pi + 1e-9 or abs(other) > 2 * pi


@pytest.mark.parametrize("around", [0.0, 20.0, -300.0])
def test_an_unlimited_joint_stays_within_half_a_turn_of_its_start(around):
    continuous, rng = arm("continuous"), np.random.default_rng(4)
    for _ in range(50):
        target = forward_kinematics(continuous, rng.uniform([-3, -1, -3], [3, 1, 3])).translation
        start = np.array([around, 0.0, -around])
        found = reached(continuous, PositionTask(), target, start)
        assert np.abs(found.q - start)[[0, 2]].max() <= pi + 1e-9


def test_a_start_outside_the_limits_is_moved_inside():
    elbow, outside = arm("elbow_limited"), np.array([5.0, -1.0])
    target = XY.value(elbow, [1.9, 0.4])
    assert np.array_equal(reached(elbow, XY, target, outside).q, reached(elbow, XY, target, [2.0, 0.3]).q)
    assert np.array_equal(outside, [5.0, -1.0])


def test_joints_that_do_not_move_the_frame_keep_their_value_in_q0():
    panda = robot("panda")
    q0 = np.array([0.1, 0.2, -0.3, -1.5, 0.2, 1.4, 0.3, 0.031])
    target = forward_kinematics(panda, [0.4, 0.1, -0.2, -1.9, 0.1, 1.2, 0.6, 0.0])
    for prefer in ("any", "near"):
        assert reached(panda, PoseTask(), target, q0, prefer=prefer).q[7] == 0.031
    q0[7] = 0.9  # beyond its limit of 0.04
    assert reached(panda, PoseTask(), target, q0).q[7] == 0.04


def wished(prefer, redundant, q0):
    return q0 if prefer == "near" else 0.5 * (redundant.lower + redundant.upper)


@pytest.mark.parametrize("prefer", ["near", "middle"])
def test_a_preferred_solution_is_not_farther_from_what_is_preferred_than_the_first_one(prefer):
    redundant, rng = arm("redundant"), np.random.default_rng(6)
    solver, first = IKSolver(redundant, PoseTask(), prefer=prefer), IKSolver(redundant, PoseTask())
    closer = 0
    for q, q0 in rng.uniform(redundant.lower, redundant.upper, (100, 2, 7)):
        target, wish = forward_kinematics(redundant, q), wished(prefer, redundant, q0)
        d, d_first = (np.linalg.norm(found.q - wish) for found in (solver(target, q0), first(target, q0)))
        assert d <= d_first + 1e-4
        closer += d < d_first - 1e-2
    assert closer > 50


# --- answers


def test_require_returns_a_solution_and_raises_with_the_reason_otherwise(planar_2r):
    found = solve_ik(planar_2r, XY, [1, 1])
    assert found.require() is found
    with pytest.raises(NotConverged, match=r"farther than the arm is long.*\|e\| = 0\.5.*starts") as raised:
        solve_ik(planar_2r, XY, [2.5, 0]).require()
    assert raised.value.result.status is IKStatus.UNREACHABLE
    with pytest.raises(NotConverged, match=r"no start led to the target within the time limit.*\|e\| = 0\.3"):
        solve_ik(planar_2r, XY, [0.1, 0], time_limit=0.01).require()


def test_a_function_of_the_user_is_solved_by_the_general_search(planar_2r):
    """|p|² = l1² + l2² + 2 l1 l2 cos q2, and the direction of the first link."""
    task = FunctionTask(lambda p, R, q: [hypot(p[0], p[1]), sin(q[0])], 2)
    found = reached(planar_2r, task, [1.5, 0.6])
    assert abs(cos(found.q[1])) == pytest.approx(abs((1.5**2 - L1**2 - L2**2) / (2 * L1 * L2)), abs=1e-5)
    assert sin(found.q[0]) == pytest.approx(0.6, abs=1e-6)
    missed = solve_ik(planar_2r, task, [2.5, 0.6], time_limit=0.05)
    assert missed.status is IKStatus.NOT_FOUND
    assert missed.error == pytest.approx(0.5, abs=1e-6)


def test_both_searches_agree_on_what_is_reached_and_on_the_nearest_miss(planar_2r):
    same = FunctionTask(lambda p, R, q: p[:2], 2)
    for target in ([1.2, 0.5], [0.1, 0.05], [2.2, 1.0], [-0.4, 0]):
        one, other = (solve_ik(planar_2r, task, target, time_limit=0.05) for task in (XY, same))
        assert one.converged == other.converged
        if not one.converged:
            assert one.error == pytest.approx(other.error, abs=1e-6)


# --- batches


@pytest.mark.parametrize("prefer", ["any", "near"])
@pytest.mark.parametrize("given", ["no start", "one start", "a start each"])
def test_a_batch_is_what_single_targets_give(prefer, given):
    redundant, rng = arm("redundant"), np.random.default_rng(8)
    targets = [forward_kinematics(redundant, q) for q in rng.uniform(redundant.lower, redundant.upper, (60, 7))]
    starts = rng.uniform(redundant.lower, redundant.upper, (60, 7))
    q0 = {"no start": None, "one start": starts[0], "a start each": starts}[given]
    solver = IKSolver(redundant, PoseTask(), prefer=prefer)
    batch = solver.solve_batch(targets, q0)
    for i, target in enumerate(targets):
        single = solver(target, q0 if q0 is None or q0.ndim == 1 else q0[i])
        assert batch[i].status is single.status is IKStatus.CONVERGED
        assert np.array_equal(batch.q[i], single.q)
        assert (batch.error[i], batch.starts[i]) == (single.error, single.starts)


def test_every_target_of_a_batch_has_its_own_status(planar_2r):
    batch = IKSolver(planar_2r, XY, time_limit=0.01).solve_batch(np.array([[1, 1], [0.1, 0], [3, 0], [2, 0]]))
    assert list(batch.status) == [
        IKStatus.CONVERGED,
        IKStatus.NOT_FOUND,
        IKStatus.UNREACHABLE,
        IKStatus.CONVERGED,
    ]
    assert batch.converged.tolist() == [True, False, False, True]
    assert batch.error[1:3] == pytest.approx([0.3, 1.0], abs=1e-6)
    assert len(batch) == 4
    with pytest.raises(NotConverged, match="2 of 4 targets were not reached; the first is target 1: no") as raised:
        batch.require()
    assert raised.value.result is batch
    reachable = IKSolver(planar_2r, XY).solve_batch([[1, 1], [0, 1]])
    assert reachable.require() is reachable


def test_progress_is_told_with_growing_numbers_that_end_at_all_of_them(planar_2r):
    rng, told = np.random.default_rng(0), []
    targets = [polar(r, angle) for r, angle in zip(rng.uniform(0.5, 1.9, 9000), rng.uniform(-3, 3, 9000), strict=True)]
    batch = IKSolver(planar_2r, XY).solve_batch(targets, progress=lambda done, all_: told.append((done, all_)))
    assert batch.converged.all()
    assert len(told) > 1
    assert [done for done, _ in told] == sorted({done for done, _ in told})
    assert told[-1] == (9000, 9000)
    assert {all_ for _, all_ in told} == {9000}


def test_the_general_search_tells_its_progress_target_by_target(planar_2r):
    told = []
    task = FunctionTask(lambda p, R, q: p[:2], 2)
    batch = IKSolver(planar_2r, task).solve_batch([[1, 1], [0, 1], [1, 0]], progress=lambda *count: told.append(count))
    assert told == [(1, 3), (2, 3), (3, 3)]
    assert batch.converged.all()


def test_targets_may_be_an_array_of_them():
    six_r = arm("six_r")
    rows = np.array([forward_kinematics(six_r, q).homogeneous for q in np.random.default_rng(0).uniform(-2, 2, (5, 6))])
    batch, listed = (IKSolver(six_r, PoseTask()).solve_batch(given) for given in (rows, [pin.SE3(T) for T in rows]))
    assert batch.converged.all()
    assert np.array_equal(batch.q, listed.q)
