"""Where `IKSolver` starts, what it prefers, and batches of targets."""

from math import cos, pi, sin

import numpy as np
import pinocchio as pin
import pytest
from arms import arm

from robotics1 import (
    FunctionTask,
    IKSolver,
    NotConverged,
    PoseTask,
    PositionTask,
    forward_kinematics,
    frame_jacobian,
    load_robot,
)
from robotics1.ik import IKStatus

XY = PositionTask("xy")


def reached(robot, task, target, q0, **options):
    """Return the answer for a target, which must be a success."""
    found = IKSolver(robot, task, **options)(target, q0)
    assert found.status is IKStatus.CONVERGED
    assert np.linalg.norm(task.error(robot, found.q, target)) <= 1e-6 + 1e-13
    assert robot.within_limits(found.q, tolerance=0.0)
    return found


# --- starts, seeds and preferences


def test_the_same_seed_gives_the_same_answer_and_another_seed_another(planar_2r):
    six_r, target = arm("six_r"), forward_kinematics(arm("six_r"), [0.3, -0.5, 0.7, 0.2, 0.4, -0.1])
    first, again = (IKSolver(six_r, PoseTask(), seed=7)(target) for _ in range(2))
    assert np.array_equal(first.q, again.q)
    assert (first.error_norm, first.starts) == (again.error_norm, again.starts)
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
    ur5, rng = load_robot("ur5", tool="tool0"), np.random.default_rng(4)
    for _ in range(50):
        q = rng.uniform(-pi, pi, 6)
        start = q + rng.uniform(-0.2, 0.2, 6)
        start[0] = turns * rng.uniform(pi, 2 * pi)  # so that half a turn around it reaches past the limit of ±2π
        found = reached(ur5, PoseTask(), forward_kinematics(ur5, q), start)
        away = found.q - start
        assert np.all(np.abs(away[[1, 3, 4, 5]]) <= pi + 1e-9)
        other = found.q[0] - 2 * pi * np.sign(away[0])
        assert abs(away[0]) <= pi + 1e-9 or abs(other) > 2 * pi


@pytest.mark.filterwarnings("ignore:q0 has the angle:robotics1.RobotWarning")  # here radians are meant
@pytest.mark.parametrize("around", [0.0, 20.0, -300.0])
def test_an_unlimited_joint_stays_within_half_a_turn_of_its_start(around):
    continuous, rng = arm("continuous"), np.random.default_rng(4)
    for _ in range(50):
        target = forward_kinematics(continuous, rng.uniform([-3, -1, -3], [3, 1, 3])).translation
        start = np.array([around, 0.0, -around])
        found = reached(continuous, PositionTask(), target, start)
        assert np.abs(found.q - start)[[0, 2]].max() <= pi + 1e-9


@pytest.mark.parametrize("far", [1e3, 1e6, 1e9, 1e12, 1e15, 1e18, 1e300])
@pytest.mark.parametrize("prefer", ["any", "near", "middle"])
def test_a_start_so_far_that_turns_are_rounded_gives_no_false_success(far, prefer):
    """Numbers next to 1e15 are 1/8 apart: no angle there is a solution."""
    continuous, task = arm("continuous"), PositionTask()
    target = forward_kinematics(continuous, [0.3, 0.2, 0.4]).translation
    solver = IKSolver(continuous, task, prefer=prefer, time_limit=0.01)
    batch = solver.solve_batch([target, target], np.array([far, 0, -far]))
    for found in (solver(target, np.array([far, 0, -far])), batch[0], batch[1]):
        e = np.linalg.norm(task.error(continuous, found.q, target))
        assert found.converged == (e <= 1e-6)
        assert found.error_norm == pytest.approx(e, rel=1e-6, abs=1e-12)


def turning(folder, lower, upper):
    """One joint with these limits that carries a tool at (1, 0, 0)."""
    path = folder / "turning.urdf"
    path.write_text(
        f"""<robot name="turning"><link name="base"/><link name="tool"/><link name="a"/>
        <joint name="q1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>
        <limit lower="{lower}" upper="{upper}" velocity="1" effort="1"/></joint>
        <joint name="tip" type="fixed"><parent link="a"/><child link="tool"/><origin xyz="1 0 0"/></joint></robot>""",
        encoding="utf-8",
    )
    return load_robot(path)


@pytest.mark.parametrize(("lower", "upper"), [(0, 7), (3, 12), (-20, -13), (-6.5, 6.5), (0, 2 * pi), (0.5, 6)])
@pytest.mark.parametrize("task", [XY, FunctionTask(lambda p, R, q: p[:2], 2)], ids=["compiled", "general"])
def test_limits_need_not_be_around_zero(tmp_path, task, lower, upper):
    robot = turning(tmp_path, lower, upper)
    solver = IKSolver(robot, task, time_limit=5)
    for angle in np.linspace(lower, upper, 9):
        found = solver([cos(angle), sin(angle)])
        assert found.converged
        assert lower <= found.q[0] <= upper
        assert sin(found.q[0] - angle) == pytest.approx(0, abs=2e-6)
    for angle in np.linspace(lower, upper, 3)[:2]:
        target = [2 * cos(angle), 2 * sin(angle)]
        missed = IKSolver(robot, task, time_limit=1.0)(target)
        assert not missed.converged
        assert lower <= missed.q[0] <= upper
        assert missed.error_norm == pytest.approx(np.linalg.norm(task.error(robot, missed.q, target)), abs=1e-12)
        assert missed.error_norm == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("start", [-6.1, -1.0, 0.0, 4.0, 6.1])
def test_a_function_of_whole_turns_is_solved_within_half_a_turn_of_the_start_too(tmp_path, start):
    robot = turning(tmp_path, -6.5, 6.5)
    found = reached(robot, FunctionTask(lambda p, R, q: p[:2], 2), [cos(start + 0.3), sin(start + 0.3)], [start])
    assert found.q[0] == pytest.approx(start + 0.3, abs=1e-5)


def test_a_start_outside_the_limits_is_moved_inside():
    elbow, outside = arm("elbow_limited"), np.array([5.0, -1.0])
    target = XY.value(elbow, [1.9, 0.4])
    assert np.array_equal(reached(elbow, XY, target, outside).q, reached(elbow, XY, target, [2.0, 0.3]).q)
    assert np.array_equal(outside, [5.0, -1.0])


def test_joints_that_do_not_move_the_frame_keep_their_value_in_q0():
    panda = load_robot("panda", tool="panda_link8")
    q0 = np.array([0.1, 0.2, -0.3, -1.5, 0.2, 1.4, 0.3, 0.031])
    target = forward_kinematics(panda, [0.4, 0.1, -0.2, -1.9, 0.1, 1.2, 0.6, 0.0])
    for prefer in ("any", "near"):
        assert reached(panda, PoseTask(), target, q0, prefer=prefer).q[7] == 0.031
    q0[7] = 0.9  # beyond its limit of 0.04
    assert reached(panda, PoseTask(), target, q0).q[7] == 0.04


def wished(prefer, redundant, q0):
    return q0 if prefer == "near" else 0.5 * (redundant.lower + redundant.upper)


@pytest.mark.parametrize("prefer", ["near", "middle"])
def test_a_preferred_solution_is_nearer_than_the_first_one_and_the_wish_has_no_part_along_its_null_space(
    prefer,
):
    """N (q_wished − q) = 0 with N = 1 − J⁺J, inside the limits; a few end where J is nearly singular."""
    redundant, rng = arm("redundant"), np.random.default_rng(6)
    solver, first = (IKSolver(redundant, PoseTask(), prefer=preferred) for preferred in (prefer, "any"))
    closer, parts = 0, []
    for q, q0 in rng.uniform(redundant.lower, redundant.upper, (120, 2, 7)):
        target, wished = (
            forward_kinematics(redundant, q),
            q0 if prefer == "near" else 0.5 * (redundant.lower + redundant.upper),
        )
        found, other = reached(redundant, PoseTask(), target, q0, prefer=prefer), first(target, q0)
        assert np.array_equal(found.q, solver(target, q0).q)
        away, away_first = np.linalg.norm(found.q - wished), np.linalg.norm(other.q - wished)
        assert away <= away_first + 1e-9
        closer += away < away_first - 1e-2
        if np.minimum(found.q - redundant.lower, redundant.upper - found.q).min() > 1e-6:
            J = frame_jacobian(redundant, found.q)
            parts.append(np.linalg.norm(wished - found.q - np.linalg.pinv(J) @ (J @ (wished - found.q))))
    assert closer > 60
    assert len(parts) > 40
    assert np.quantile(parts, 0.9) < 1e-7


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
        assert (batch.error_norm[i], batch.starts[i]) == (single.error_norm, single.starts)


def test_every_target_of_a_batch_has_its_own_status(planar_2r):
    batch = IKSolver(planar_2r, XY, time_limit=0.01).solve_batch(np.array([[1, 1], [0.1, 0], [3, 0], [2, 0]]))
    assert list(batch.status) == [
        IKStatus.CONVERGED,
        IKStatus.UNREACHABLE,
        IKStatus.UNREACHABLE,
        IKStatus.CONVERGED,
    ]
    assert batch.converged.tolist() == [True, False, False, True]
    assert batch.error_norm[1:3] == pytest.approx([0.3, 1.0], abs=1e-6)
    assert len(batch) == 4
    with pytest.raises(
        NotConverged, match="2 of 4 targets were not reached; the first is target 1: it is proven"
    ) as raised:
        batch.require()
    assert raised.value.result is batch
    reachable = IKSolver(planar_2r, XY).solve_batch([[1, 1], [0, 1]])
    assert reachable.require() is reachable


def test_progress_is_told_with_growing_numbers_that_end_at_all_of_them(planar_2r):
    told = []
    targets = [XY.value(planar_2r, q) for q in np.random.default_rng(20).uniform(-3, 3, (9000, 2))]
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
    rows = np.array([forward_kinematics(six_r, q).homogeneous for q in np.random.default_rng(2).uniform(-2, 2, (5, 6))])
    batch, listed = (IKSolver(six_r, PoseTask()).solve_batch(given) for given in (rows, [pin.SE3(T) for T in rows]))
    assert batch.converged.all()
    assert np.array_equal(batch.q, listed.q)


def test_the_solution_of_one_target_is_the_start_of_the_next_though_it_is_read_only():
    six_r, q = arm("six_r"), np.full(6, 0.3)
    solver = IKSolver(six_r, PoseTask())
    for _ in range(20):
        target = forward_kinematics(six_r, q + 0.05)
        found = solver(target, q)
        assert not found.q.flags.writeable
        assert found == solver(target, q.copy())
        assert found.starts == 1
        assert found.q == pytest.approx(q + 0.05, abs=1e-5)
        q = found.q
