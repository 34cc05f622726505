"""The nearest miss of a target out of reach: a stationary point of |e|² inside the limits, as SciPy finds it."""

from time import perf_counter, sleep

import numpy as np
import pinocchio as pin
import pytest
from arms import arm
from drawn_arms import drawn_arm
from scipy.optimize import least_squares

from robotics1 import (
    FunctionTask,
    IKSolver,
    PointingTask,
    PoseTask,
    PositionTask,
    forward_kinematics,
    ik_solutions,
    load_robot,
    robot_from_dh,
)
from robotics1.ik import IKStatus

XY, XYZ = PositionTask("xy"), PositionTask()


def far_targets(robot, task, count, seed):
    """Poses of the robot, moved away from it."""
    rng = np.random.default_rng(seed)
    lower, upper = np.maximum(robot.lower, -3), np.minimum(robot.upper, 3)
    poses = [forward_kinematics(robot, rng.uniform(lower, upper)) for _ in range(count)]
    moved = [pin.SE3(T.rotation, T.translation * rng.uniform(1.5, 4)) for T in poses]
    if task.frame_map().pose_error.takes_poses:
        return moved
    return [T.rotation[:, 2] if isinstance(task, PointingTask) else T.translation[: task.rows] for T in moved]


def least_error(robot, task, target, q):
    """|e| of SciPy's bounded least squares from q."""
    inside = np.clip(q, robot.lower + 1e-12, robot.upper - 1e-12)
    found = least_squares(
        lambda x: task.error(robot, x, target), inside, bounds=(robot.lower, robot.upper), x_scale=robot.units,
        xtol=1e-14, ftol=1e-14, gtol=1e-14,
    )  # fmt: skip
    return float(np.linalg.norm(found.fun))


@pytest.mark.parametrize("task", [XYZ, PositionTask("xy"), PoseTask(), PointingTask()], ids=lambda t: type(t).__name__)
@pytest.mark.parametrize("name", ["spatial", "six_r", "redundant", "prr", "elbow_limited", "panda"])
def test_scipy_finds_no_nearer_miss_from_there(name, task):
    robot = load_robot("panda", tool="panda_link8") if name == "panda" else arm(name)
    targets = far_targets(robot, task, 8, 1)
    batch = IKSolver(robot, task, time_limit=1e-3).solve_batch(targets)
    for i in np.flatnonzero(~batch.converged):
        assert batch.error_norm[i] == pytest.approx(
            np.linalg.norm(task.error(robot, batch.q[i], targets[i])), abs=1e-12
        )
        assert robot.within_limits(batch.q[i], tolerance=0.0)
        assert batch.error_norm[i] <= least_error(robot, task, targets[i], batch.q[i]) + 1e-7


@pytest.mark.parametrize("seed", range(12))
def test_nor_does_it_of_drawn_arms_with_followers(seed):
    robot = drawn_arm(seed)
    targets = far_targets(robot, XYZ, 5, seed)
    batch = IKSolver(robot, XYZ, time_limit=1e-3, tolerance=1e-6 * robot.reach).solve_batch(targets)
    for i in np.flatnonzero(~batch.converged):
        assert robot.within_limits(batch.q[i], tolerance=0.0)
        assert batch.error_norm[i] <= least_error(robot, XYZ, targets[i], batch.q[i]) + 1e-7 * robot.reach


def test_a_batch_out_of_reach_takes_few_starts_and_little_time():
    ur5 = load_robot("ur5", tool="tool0")
    solver = IKSolver(ur5, XYZ)
    directions = np.random.default_rng(0).standard_normal((1000, 3))
    targets = 3 * directions / np.linalg.norm(directions, axis=1)[:, None]
    solver.solve_batch(targets[:2])
    begin = perf_counter()
    batch = solver.solve_batch(targets)
    assert perf_counter() - begin < 20  # a quarter of a second on one core; the bound is for machines that are busy
    assert set(batch.status) == {IKStatus.UNREACHABLE}
    assert batch.starts.max() < 10


# --- time limits and numbers of any size


@pytest.mark.parametrize("task", [XYZ, FunctionTask(lambda p, R, q: p, 3)], ids=["compiled", "general"])
@pytest.mark.parametrize("limit", [0.3, 1.0])
def test_the_time_limit_is_kept_for_an_arm_of_forty_joints(task, limit):
    from robotics1 import robot_from_dh

    snake = robot_from_dh(
        [("R", 0.1, np.pi / 2 * (-1) ** i, 0, 0) for i in range(40)], lower=[-0.3] * 40, upper=[0.3] * 40
    )
    solver = IKSolver(snake, task, time_limit=limit)
    solver([3.0, 0.2, 0.1])
    begin = perf_counter()
    missed = solver([-3.6, 0.5, 0.0])
    assert perf_counter() - begin <= 1.2 * limit + 0.2
    assert not missed.converged


def test_the_time_limit_is_kept_where_an_evaluation_of_the_function_takes_long(planar_2r):
    def slow(p, R, q):
        sleep(0.02)
        return p[:2]

    task = FunctionTask(slow, 2)
    for limit, targets in ((0.5, [[3, 0]]), (0.25, [[3, 0], [0, 3]])):
        begin = perf_counter()
        solver = IKSolver(planar_2r, task, time_limit=limit)
        answer = solver.solve_batch(targets)
        assert perf_counter() - begin <= 1.2 * 0.5 + 0.2
        assert not np.any(answer.converged)


@pytest.mark.parametrize("far", [1e10, 1e100, 1e200, 1e300, 1e-300])
@pytest.mark.parametrize(
    "task", [PositionTask("xy"), FunctionTask(lambda p, R, q: p[:2], 2)], ids=["compiled", "general"]
)
def test_targets_and_starts_of_any_size_end_in_an_answer(planar_2r, task, far):
    solver = IKSolver(planar_2r, task, time_limit=0.05)
    for target, q0 in (([far, far], None), ([1, 1], [far, -far]), ([1, 1], [1e308, -1e308])):
        found = solver(target, q0)
        assert found.converged == (found.error_norm <= 1e-6)
        assert found.error_norm == pytest.approx(
            np.hypot.reduce(task.error(planar_2r, found.q, target)), rel=1e-9, abs=1e-12
        )


@pytest.mark.parametrize("size", [1e-300, 1e-12, 1e12])
def test_arms_of_any_size_have_their_solutions(size):
    robot = robot_from_dh([("R", size, 0, 0, 0), ("R", 0.8 * size, 0, 0, 0)])
    usual = robot_from_dh([("R", 1, 0, 0, 0), ("R", 0.8, 0, 0, 0)])
    found = ik_solutions(robot, XY, [size, 0.6 * size], starts=10)
    assert found.q == pytest.approx(ik_solutions(usual, XY, [1, 0.6], starts=10).q, abs=1e-9)
    assert len(found) == 2
