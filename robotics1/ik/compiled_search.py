"""The robust search in the kernels: for tasks whose error is made of rows of the pose error."""

from collections.abc import Callable, Iterator
from functools import partial
from itertools import count
from time import perf_counter
from typing import Any, cast

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.caching import cached_property
from robotics1.errors import InputError, TaskError
from robotics1.ik.batch_starts import starts_of_all
from robotics1.ik.pose_problem import pose_problem
from robotics1.ik.proof import UnreachableProof
from robotics1.ik.result import IKBatch, IKResult, IKStatus
from robotics1.inputs import Array
from robotics1.kernels.chain import Indices
from robotics1.kernels.compilation import on_all_cores, threads
from robotics1.kernels.inverse import solve, solve_all
from robotics1.kernels.nearest_miss import nearest_misses
from robotics1.kernels.redundancy import bring_all_near, bring_near
from robotics1.robot.model import Robot
from robotics1.tasks.task import FrameMap, PoseError, Task

GROUP = 64  # starts of which the one nearest to the target is taken
FIRST_STARTS = 128 * GROUP  # of the table that every target begins with
SOON = 8  # groups of them that are tried before anything is proven
LATER_STARTS = 256  # of each table after that, all of them tried
SHORT = 0.05  # of the time limit, that the starts between two looks at the clock take
ENOUGH = 0.92  # of the time limit, after which no further starts are tried
PROVING = 0.2  # of the time limit, that a proof may take
FINER = 1e-3  # tolerance on the turn where a task tells it by angles
CHUNK = 4096  # targets between two calls of progress
Progress = Callable[[int, int], None]
Table = tuple[Array, int]  # starts with their poses, and how many of them share a group


class CompiledSearch:
    """Damped least squares in the kernels: from q0, then from random starts near the target, until one arrives."""

    def __init__(
        self,
        robot: Robot,
        task: Task,
        form: FrameMap,
        pose_error: PoseError,
        *,
        prefer: str,
        seed: int,
        tolerance: float,
        time_limit: float,
    ) -> None:
        self.robot, self.task, self.form, self.pose_error, self.seed = robot, task, form, pose_error, seed
        self.tolerance = tolerance * (FINER if pose_error.by_angles else 1.0)
        self.time_limit, self.prefer = time_limit, prefer
        self.problem = pose_problem(robot, task)
        self.middle = self.problem.middle
        constants = self.problem.arrays(self.tolerance)
        self.solve_one: Callable[..., tuple[int, float]] = partial(solve, *constants)
        self.solve_many: Callable[..., None] = partial(solve_all, *constants)
        self.bring_one: Callable[..., float] = partial(bring_near, *constants)
        self.bring_many: Callable[..., None] = partial(bring_all_near, *constants)
        self.move_to_misses: Callable[..., None] = partial(nearest_misses, *constants)
        self.first_table = self.problem.table(np.random.default_rng((seed, 0)), FIRST_STARTS)
        self.soon: Table = (self.first_table[: SOON * GROUP], GROUP)
        self._compile()

    @cached_property
    def proof(self) -> UnreachableProof:
        """What proves that a target is out of reach."""
        return UnreachableProof(self.robot, self.form, self.problem)

    def _compile(self) -> None:
        """Solve for the pose of the first start, so that no time limit pays for the compilation."""
        T = np.eye(4)
        T[:3] = self.first_table[0, :12].reshape(3, 4)
        T[:3, 3] *= self.problem.unit
        goal = pin.SE3(T).homogeneous if self.pose_error.takes_poses else T
        self.solve_one(goal, self.middle, self.first_table[:1], 1, 0, np.empty_like(self.middle))

    def quick_call(self) -> Callable[[Any, Any], IKResult]:
        """Return `solve` with the usual case in front: a pose as target, q0 an array or None, a solution at once.

        All names are bound here, once, and checks are left to the kernel, which refuses what is no pose or not finite:
        around a kernel of four microseconds every function call and every attribute counts.
        """
        if self.prefer != "any" or not self.pose_error.takes_poses:
            return self.solve
        kernel, (table, group), middle, tolerance = self.solve_one, self.soon, self.middle, self.tolerance
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
        begin = perf_counter()
        goal = self.pose_error.goal(self.robot, target)
        start, first = (self.middle, 0) if q0 is None else (self.robot.configuration(q0, "q0"), -1)
        q = np.empty_like(start)
        tried, error = self.solve_one(goal, start, *self.soon, first, q)
        status = IKStatus.CONVERGED if error <= self.tolerance else IKStatus.NOT_FOUND
        batch = IKBatch(q[None], np.array([status]), np.array([error]), np.array([tried]))
        self._go_on([target], goal[None], start[None], batch, perf_counter() - begin)
        batch.error_norm[0] = self._brought_near(goal, start, batch.q[0], batch.error_norm[0])
        return batch[0]

    def batch(self, targets: list[Any], q0: npt.ArrayLike | None, progress: Progress | None) -> IKBatch:
        """Return the answers for many targets."""
        k, nq = len(targets), self.robot.nq
        goals = np.array([self._numbered_goal(i, target) for i, target in enumerate(targets)])
        starts, first = (np.tile(self.middle, (k, 1)), 0) if q0 is None else (starts_of_all(self.robot, q0, k), -1)
        batch = IKBatch(np.empty((k, nq)), np.full(k, IKStatus.NOT_FOUND), np.empty(k), np.empty(k, dtype=np.int64))
        for i in range(0, k, CHUNK):
            some = np.arange(i, min(i + CHUNK, k))
            batch.q[some], batch.starts[some], batch.error_norm[some] = self._round(
                goals[some], starts[some], self.soon, first
            )
            done = len(some) + i - int(np.count_nonzero(batch.error_norm[: i + len(some)] > self.tolerance))
            if progress is not None:
                progress(done, k)
        for refused in np.flatnonzero(batch.starts < 0).tolist():
            self._numbered_goal(refused, targets[refused], task_checks=True)
        self._go_on(targets, goals, starts, batch, progress=progress)
        if self.prefer != "any":
            wished = starts if self.prefer == "near" else np.tile(self.middle, (k, 1))
            on_all_cores(
                lambda some: self.bring_many(goals[some], wished[some], batch.q[some], batch.error_norm[some]), k
            )
        return batch

    def _brought_near(self, goal: Array, start: Array, q: Array, error: float) -> float:
        """Bring a solution q, in place, near to what is preferred, and return its |e|."""
        if self.prefer == "any" or error > self.tolerance:
            return error
        return self.bring_one(goal, start if self.prefer == "near" else self.middle, q, error)

    def _goal(self, target: Any) -> Array:
        """Return the pose (4, 4) of a target; one that is a pose itself is left for the kernel to check."""
        if self.pose_error.takes_poses and type(target) is pin.SE3:
            return cast(Array, target.homogeneous)
        return self.pose_error.goal(self.robot, target)

    def _numbered_goal(self, i: int, target: Any, *, task_checks: bool = False) -> Array:
        """Return the pose of target i of many; an error tells i."""
        try:
            return self.pose_error.goal(self.robot, target) if task_checks else self._goal(target)
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
        self,
        targets: list[Any],
        goals: Array,
        starts: Array,
        batch: IKBatch,
        spent: float = 0.0,
        progress: Progress | None = None,
    ) -> None:
        """Go on with what was not reached: prove it out of reach, or try further starts until the time is over."""
        missed = np.flatnonzero(~(batch.error_norm <= self.tolerance))  # NaN is a miss
        if not missed.size:
            batch.status[:] = IKStatus.CONVERGED
            return
        proven = np.array([self.proof.at_once(goals[i], self.tolerance, self.tolerance) for i in missed], dtype=bool)
        batch.status[missed] = [IKStatus.UNREACHABLE if out else IKStatus.NOT_FOUND for out in proven]
        self._restart(missed[~proven], goals, starts, batch, spent)
        never = missed[batch.error_norm[missed] > self.tolerance]
        for i in range(0, len(never), CHUNK):
            self._move_to_misses(never[i : i + CHUNK], targets, goals, batch)
            if progress is not None:
                progress(len(batch) - len(never) + min(i + CHUNK, len(never)), len(batch))
        batch.status[batch.error_norm <= self.tolerance] = IKStatus.CONVERGED

    def _restart(self, left: Indices, goals: Array, starts: Array, batch: IKBatch, spent: float) -> None:
        """Try further starts for the targets that are left, until the time is over: `spent` seconds a target are.

        First comes a short attempt to prove that there is no solution, then starts near the targets, a longer attempt,
        and starts anywhere.
        """
        left, size = self._not_excluded(left, goals, batch, seconds=0.0), SOON
        for table, group in self._further_starts():
            at = 0
            while at * group < len(table):
                if not left.size or spent >= ENOUGH * self.time_limit:
                    return
                begin, share = perf_counter(), min(1.0, threads() / left.size)
                some = (table[at * group : (at + size) * group], group)
                q, tried, errors = self._round(goals[left], starts[left], some, 0)
                at += size
                batch.starts[left] += tried
                better = errors < batch.error_norm[left]
                batch.q[left[better]], batch.error_norm[left[better]] = q[better], errors[better]
                left = left[batch.error_norm[left] > self.tolerance]
                seconds = (perf_counter() - begin) * share
                spent += seconds
                size = int(np.clip(size * SHORT * self.time_limit / seconds, 1, LATER_STARTS))
            if group == GROUP and left.size:
                begin, share = perf_counter(), min(1.0, threads() / left.size)
                left = self._not_excluded(left, goals, batch, seconds=PROVING * self.time_limit)
                spent += (perf_counter() - begin) * share

    def _further_starts(self) -> Iterator[Table]:
        """Yield the rest of the first table, and then one table of random starts after the other."""
        yield self.first_table[SOON * GROUP :], GROUP
        for number in count(1):
            yield self.problem.table(np.random.default_rng((self.seed, number)), LATER_STARTS), 1

    def _not_excluded(self, left: Indices, goals: Array, batch: IKBatch, *, seconds: float) -> Indices:
        """Return the targets of which it cannot be proven in the time that every joint box is without a solution."""
        proven = np.zeros(len(left), dtype=bool)
        exclude = self.proof.by_exclusion

        def prove(some: slice) -> None:
            for i in range(some.start, some.stop):
                proven[i] = exclude(goals[left[i]], self.tolerance, self.tolerance, seconds=seconds)

        if left.size:
            on_all_cores(prove, len(left))
        batch.status[left[proven]] = IKStatus.UNREACHABLE
        return left[~proven]

    def _move_to_misses(self, never: Indices, targets: list[Any], goals: Array, batch: IKBatch) -> None:
        """Move what was found for targets that are not reached to where |e| is least around it.

        Where the task has an error of its own in place of the rotation vector, that is reported.
        """
        q, errors = batch.q[never], batch.error_norm[never]
        on_all_cores(lambda some: self.move_to_misses(goals[never[some]], q[some], errors[some]), len(never))
        batch.q[never], batch.error_norm[never] = q, errors
        if self.pose_error.by_angles:  # which a singular orientation does not have
            return
        for i in never:
            batch.error_norm[i] = float(np.hypot.reduce(self.task.error(self.robot, batch.q[i], targets[i])))
