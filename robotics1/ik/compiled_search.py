"""The robust search in the kernels: for tasks whose error is made of rows of the pose error."""

from collections.abc import Callable
from functools import partial
from time import perf_counter
from typing import Any, cast

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.caching import cached_property
from robotics1.errors import InputError, TaskError
from robotics1.ik.batch_starts import starts_of_all
from robotics1.ik.descent import Descent
from robotics1.ik.pose_problem import pose_problem
from robotics1.ik.reach import ReachBound, reach_bound
from robotics1.ik.result import IKBatch, IKResult
from robotics1.ik.status import IKStatus
from robotics1.inputs import Array
from robotics1.kernels.compilation import on_all_cores, threads
from robotics1.kernels.inverse import solve, solve_all
from robotics1.kernels.redundancy import bring_all_near, bring_near
from robotics1.robot.model import Robot
from robotics1.tasks.task import FrameTask

GROUP = 64  # starts of which the one nearest to the target is taken
FIRST_STARTS = 128 * GROUP  # of the table that every target begins with
LATER_STARTS = 256  # of each table after that, all of them tried
FINER = 1e-3  # tolerance on the turn where a task tells it by angles
CHUNK = 4096  # targets between two calls of progress
Progress = Callable[[int, int], None]
Table = tuple[Array, int]  # starts with their poses, and how many of them share a group


class CompiledSearch:
    """Damped least squares in the kernels: from q0, then from random starts near the target, until one arrives."""

    def __init__(
        self, robot: Robot, task: FrameTask, *, prefer: str, seed: int, tolerance: float, time_limit: float
    ) -> None:
        self.robot, self.task, self.seed = robot, task, seed
        self.tolerance = tolerance * (FINER if task.tells_angles else 1.0)
        self.time_limit, self.prefer = time_limit, prefer
        self.problem = pose_problem(robot, task)
        self.middle = self.problem.middle
        constants = self.problem.arrays(self.tolerance)
        self.solve_one: Callable[..., tuple[int, float]] = partial(solve, *constants)
        self.solve_many: Callable[..., None] = partial(solve_all, *constants)
        self.bring_one: Callable[..., float] = partial(bring_near, *constants)
        self.bring_many: Callable[..., None] = partial(bring_all_near, *constants)
        self.first_table: Table = (self.problem.table(np.random.default_rng((seed, 0)), FIRST_STARTS), GROUP)

    @cached_property
    def reach(self) -> ReachBound:
        """What proves that a target is out of reach."""
        return reach_bound(self.problem)

    def quick_call(self) -> Callable[[Any, Any], IKResult]:
        """Return `solve` with the usual case in front: a pose as target, q0 an array or None, a solution at once.

        All names are bound here, once, and checks are left to the kernel, which refuses what is no pose or not finite:
        around a kernel of four microseconds every function call and every attribute counts.
        """
        if self.prefer != "any" or not self.task.takes_poses:
            return self.solve
        kernel, (table, group), middle, tolerance = self.solve_one, self.first_table, self.middle, self.tolerance
        SE3, ndarray, number, shape, empty = pin.SE3, np.ndarray, np.dtype(float), middle.shape, np.empty
        carefully, converged = self.solve, IKStatus.CONVERGED

        def call(target: Any, q0: Any) -> IKResult:
            if type(target) is not SE3:
                return carefully(target, q0)
            if q0 is None:
                start, first = middle, 0
            elif type(q0) is ndarray and q0.dtype is number and q0.shape == shape and q0.flags.carray:
                start, first = q0, -1
            else:
                return carefully(target, q0)
            q = empty(shape)
            tried, error = kernel(target.homogeneous, start, table, group, first, q)
            return IKResult(converged, q, error, tried) if error <= tolerance else carefully(target, q0)

        return call

    def solve(self, target: Any, q0: npt.ArrayLike | None) -> IKResult:
        """Return the answer for one target."""
        goal = self.task.goal(self.robot, target)
        start, first = (self.middle, 0) if q0 is None else (self.robot.configuration(q0, "q0"), -1)
        q = np.empty_like(start)
        tried, error = self.solve_one(goal, start, *self.first_table, first, q)
        status = IKStatus.CONVERGED if error <= self.tolerance else IKStatus.NOT_FOUND
        batch = IKBatch(q[None], np.array([status]), np.array([error]), np.array([tried]))
        self._go_on([target], goal[None], start[None], batch)
        batch.error[0] = self._brought_near(goal, start, batch.q[0], batch.error[0])
        return batch[0]

    def batch(self, targets: list[Any], q0: npt.ArrayLike | None, progress: Progress | None) -> IKBatch:
        """Return the answers for many targets."""
        k, nq = len(targets), self.robot.nq
        goals = np.array([self._numbered_goal(i, target) for i, target in enumerate(targets)])
        starts, first = (np.tile(self.middle, (k, 1)), 0) if q0 is None else (starts_of_all(self.robot, q0, k), -1)
        batch = IKBatch(np.empty((k, nq)), np.full(k, IKStatus.NOT_FOUND), np.empty(k), np.empty(k, dtype=np.int64))
        for i in range(0, k, CHUNK):
            some = np.arange(i, min(i + CHUNK, k))
            batch.q[some], batch.starts[some], batch.error[some] = self._round(
                goals[some], starts[some], self.first_table, first
            )
            done = len(some) + i - int(np.count_nonzero(batch.error[: i + len(some)] > self.tolerance))
            if progress is not None:
                progress(done, k)
        for refused in np.flatnonzero(batch.starts < 0).tolist():
            self._numbered_goal(refused, targets[refused], task_checks=True)
        self._go_on(targets, goals, starts, batch, progress)
        if self.prefer != "any":
            wished = starts if self.prefer == "near" else np.tile(self.middle, (k, 1))
            on_all_cores(lambda some: self.bring_many(goals[some], wished[some], batch.q[some], batch.error[some]), k)
        return batch

    def _brought_near(self, goal: Array, start: Array, q: Array, error: float) -> float:
        """Bring a solution q, in place, near to what is preferred, and return its |e|."""
        if self.prefer == "any" or error > self.tolerance:
            return error
        return self.bring_one(goal, start if self.prefer == "near" else self.middle, q, error)

    def _goal(self, target: Any) -> Array:
        """Return the pose (4, 4) of a target; one that is a pose itself is left for the kernel to check."""
        if self.task.takes_poses and type(target) is pin.SE3:
            return cast(Array, target.homogeneous)
        return self.task.goal(self.robot, target)

    def _numbered_goal(self, i: int, target: Any, *, task_checks: bool = False) -> Array:
        """Return the pose of target i of many; an error tells i."""
        try:
            return self.task.goal(self.robot, target) if task_checks else self._goal(target)
        except (InputError, TaskError) as error:
            raise type(error)(f"target {i} of the batch: {error}") from error

    def _round(
        self, goals: Array, starts: Array, table: Table, first: int
    ) -> tuple[Array, npt.NDArray[np.int64], Array]:
        """Return what the starts of a table lead to: q (k, nq), how many were tried, and |e|, (k,)."""
        k = len(goals)
        q, tried, errors = np.empty((k, self.robot.nq)), np.empty(k, dtype=np.int64), np.empty(k)
        if k == 1:  # spares a user of single targets the compilation of the other kernel
            tried[0], errors[0] = self.solve_one(goals[0], starts[0], *table, first, q[0])
            return q, tried, errors

        def solve_some(some: slice) -> None:
            self.solve_many(goals[some], starts[some], *table, first, q[some], tried[some], errors[some])

        on_all_cores(solve_some, k)
        return q, tried, errors

    def _go_on(
        self, targets: list[Any], goals: Array, starts: Array, batch: IKBatch, progress: Progress | None = None
    ) -> None:
        """Try further starts for what was not reached, until the time is over; then look around the nearest misses."""
        missed = np.flatnonzero(~(batch.error <= self.tolerance))  # NaN is a miss
        proven = np.array([self._out_of_reach(goals[i]) for i in missed], dtype=bool)
        batch.status[missed] = [IKStatus.UNREACHABLE if out else IKStatus.NOT_FOUND for out in proven]
        left, spent, number = missed[~proven], 0.0, 0
        while left.size and spent < self.time_limit:
            begin, share, number = perf_counter(), min(1.0, threads() / left.size), number + 1
            table: Table = (self.problem.table(np.random.default_rng((self.seed, number)), LATER_STARTS), 1)
            q, tried, errors = self._round(goals[left], starts[left], table, 0)
            batch.starts[left] += tried
            better = errors < batch.error[left]
            batch.q[left[better]], batch.error[left[better]] = q[better], errors[better]
            left = left[batch.error[left] > self.tolerance]
            spent += (perf_counter() - begin) * share
        never = missed[batch.error[missed] > self.tolerance]
        for number, i in enumerate(never, start=1 - len(never)):
            self._look_around(i, targets[i], batch)
            if progress is not None:
                progress(len(batch) + number, len(batch))
        batch.status[batch.error <= self.tolerance] = IKStatus.CONVERGED

    def _out_of_reach(self, goal: Array) -> bool:
        """Whether the goal is farther than the chain is long, by more than the tolerance."""
        return self.reach.excess(goal, self.problem.counted) > self.tolerance

    def _look_around(self, i: int, target: Any, batch: IKBatch) -> None:
        """Move the nearest miss of target i to where |e| is least around it, e being the task's own error."""
        if self.task.tells_angles:  # which a singular orientation does not have
            return
        descent = Descent(self.robot, self.task, self.task.target(target), self.problem.box)
        places = (batch.q[i], descent.nearest_miss(batch.q[i]))
        errors = [float(np.hypot.reduce(self.task.error(self.robot, q, target))) for q in places]
        nearest = int(np.argmin(errors))
        batch.q[i], batch.error[i] = places[nearest], errors[nearest]
