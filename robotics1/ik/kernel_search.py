"""The search in the kernels, of many targets at once: for tasks whose error is made of rows of the pose error."""

from collections.abc import Callable, Iterator
from functools import partial
from itertools import count
from typing import Any

import numpy as np
import numpy.typing as npt
import pinocchio as pin
from numpy import empty, ndarray
from pinocchio import SE3

from robotics1.caching import cached_property
from robotics1.ik.goals import goals_of, numbered
from robotics1.ik.pose_problem import pose_problem
from robotics1.ik.proof import UnreachableProof
from robotics1.ik.result import IKResult, IKStatus
from robotics1.ik.search import SOON, Ends, Found, Search, Table
from robotics1.inputs import Array
from robotics1.kernels.chain import Indices
from robotics1.kernels.compilation import on_all_cores, threads
from robotics1.kernels.inverse import solve, solve_all
from robotics1.kernels.nearest_miss import nearest_misses
from robotics1.kernels.redundancy import all_nullspace_descents, nullspace_descent
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

CONVERGED = IKStatus.CONVERGED
new_tuple = tuple.__new__  # what IKResult(...) calls; by itself it takes a third of the time
GROUP = 64  # starts; the one nearest to the target is taken
FIRST_STARTS = 128 * GROUP  # of the table that every target begins with
LATER_STARTS = 256  # of each table after that, all of them tried
FINER = 1e-3  # tolerance on the turn where the task's error holds angles in its place
CHUNK = 4096  # targets that are searched for together


class KernelSearch(Search):
    """Damped least squares in the kernels: from q0, then from random starts near the target.

    Attributes:
        middle: (nq,) the middle of the joint ranges: the start of a target without q0, as far as one is needed.
        solve_one: (target, q0, from q0?, q) → the number of starts and |e|, of the first starts, written to q.
    """

    at_once = CHUNK
    enough = 0.92

    def __init__(self, robot: Robot, task: Task, *, prefer: str, seed: int, tolerance: float, time_limit: float):
        self.robot, self.task, self.seed, self.preferred = robot, task, seed, prefer
        self.problem, self.time_limit = pose_problem(robot, task), time_limit
        self.pose_error = self.problem.pose_error
        self.tolerance = tolerance * (FINER if self.pose_error.by_angles else 1.0)
        self.cores, self.middle = threads(), self.problem.middle
        self._constants = self.problem.arrays(self.tolerance)
        self._first_table = self.problem.table(np.random.default_rng((seed, 0)), FIRST_STARTS)
        self._soon: Table = (self._first_table[: SOON * GROUP], GROUP)
        self.solve_one: Callable[..., tuple[int, float]] = partial(solve, *self._constants, *self._soon)
        self._compile()

    @cached_property
    def proof(self) -> UnreachableProof:
        """What proves that a target is out of reach."""
        return UnreachableProof(self.problem)

    def _compile(self) -> None:
        """Solve for the pose of the first start, so that no time limit pays for the compilation."""
        T = np.eye(4)
        T[:3] = self._first_table[0, :12].reshape(3, 4)
        T[:3, 3] *= self.problem.unit
        goal = pin.SE3(T).homogeneous if self.pose_error.takes_poses else T
        solve(*self._constants, self._first_table[:1], 1, goal, self.middle, False, np.empty_like(self.middle))

    def goals(self, targets: list[Any], first: int | None) -> Array:
        """Return poses (k, 4, 4); of a batch, one that is a pose itself is left for the kernel to check."""
        if first is None:
            return np.array([self.goal(target) for target in targets])
        return goals_of(self.robot, self.pose_error, targets, first)

    def goal(self, target: Any) -> Array:
        """Return the pose (4, 4) of a target, checked."""
        return self.pose_error.goal(self.robot, target)

    def begin(self, found: Found, tables: Iterator[Table], seconds: float) -> None:
        """Try q0 and the first starts. A goal that the kernel refuses is one that the task has not checked yet."""
        starts = self._starts(found)
        ends = self._ends(found.goals, starts, self._soon, from_q0=found.starts is not None)
        found.q, found.tried, found.error = ends
        for refused in np.flatnonzero(found.tried < 0).tolist():
            with numbered(refused + (found.first or 0)):
                self.goal(found.targets[refused])

    def tables(self) -> Iterator[Table]:
        """Yield the rest of the first table, and then one table of random starts after the other."""
        yield self._first_table[SOON * GROUP :], GROUP
        for number in count(1):
            yield self.problem.table(np.random.default_rng((self.seed, number)), LATER_STARTS), 1

    def again(self, found: Found, left: Indices, starts: Table, seconds: float) -> Ends:
        """Return where further starts lead, for the targets that are left."""
        return self._ends(found.goals[left], self._starts(found)[left], starts, from_q0=False)

    def _starts(self, found: Found) -> Array:
        return np.tile(self.middle, (len(found.goals), 1)) if found.starts is None else found.starts

    def _ends(self, goals: Array, starts: Array, table: Table, *, from_q0: bool) -> Ends:
        """Return what the starts of a table lead to: q (k, nq), how many were tried, and |e|, (k,)."""
        k = len(goals)
        q, tried, errors = np.empty((k, self.robot.nq)), np.empty(k, dtype=np.int64), np.empty(k)
        if k == 1:  # spares a user of single targets the compilation of the other kernel
            tried[0], errors[0] = solve(*self._constants, *table, goals[0], starts[0], from_q0, q[0])
            return q, tried, errors

        def solve_some(some: slice) -> None:
            solve_all(*self._constants, *table, goals[some], starts[some], from_q0, q[some], tried[some], errors[some])

        on_all_cores(solve_some, k)
        return q, tried, errors

    def unreachable(self, goals: Array, seconds: float) -> npt.NDArray[np.bool_]:
        """Return which goals are seen to be out of reach, or have every joint box excluded in that time."""
        proven = self.proof.all_at_once(goals, self.tolerance, self.tolerance)
        exclude = self.proof.by_exclusion

        def prove(some: slice) -> None:
            for i in range(some.start, some.stop):
                if not proven[i]:
                    proven[i] = exclude(goals[i], self.tolerance, self.tolerance, seconds=seconds)

        if proven.size:
            on_all_cores(prove, len(goals))
        return proven

    def miss(self, found: Found, never: Indices, seconds: float) -> None:
        """Move what was found to where |e| is least around it.

        Where the task has an error of its own in place of the rotation vector, that is reported.
        """
        goals, q, errors = found.goals[never], found.q[never], found.error[never]

        def move(some: slice) -> None:
            nearest_misses(*self._constants, goals[some], q[some], errors[some])

        on_all_cores(move, len(never))
        found.q[never], found.error[never] = q, errors
        if self.pose_error.by_angles:  # which a singular orientation does not have
            return
        for i in never:
            error = self.task.error(self.robot, found.q[i], found.targets[i])
            found.error[i] = float(np.hypot.reduce(error))

    def prefer(self, found: Found) -> None:
        """Move the solutions of a redundant arm along the null space, near to q0 or to the middle of the ranges."""
        if self.preferred == "any":
            return
        k = len(found.goals)
        wished = self._starts(found) if self.preferred == "near" else np.tile(self.middle, (k, 1))
        goals, q, errors = found.goals, found.q, found.error
        if k == 1:
            if errors[0] <= self.tolerance:
                errors[0] = nullspace_descent(*self._constants, goals[0], wished[0], q[0], errors[0])
            return

        def move(some: slice) -> None:
            all_nullspace_descents(*self._constants, goals[some], wished[some], q[some], errors[some])

        on_all_cores(move, k)


class PoseSolver:
    """`KernelSearch.solve` with the usual case in front: a pose as target, q0 an array or None, a solution at once.

    Checks are left to the kernel, which refuses what is no pose or not finite: around a kernel of four microseconds
    every function call and every attribute counts.
    """

    __slots__ = ("carefully", "kernel", "middle", "number", "shape", "tolerance")

    def __init__(self, search: KernelSearch) -> None:
        self.carefully, self.kernel, self.tolerance = search.solve, search.solve_one, search.tolerance
        self.middle, self.shape, self.number = search.middle, search.middle.shape, search.middle.dtype

    def solve(self, target: Any, q0: Any) -> IKResult:
        """Return the answer for one target."""
        if type(target) is not SE3:
            return self.carefully(target, q0)
        if q0 is None:
            start, from_q0 = self.middle, False
        elif type(q0) is ndarray and q0.dtype is self.number and q0.shape == self.shape:
            start, from_q0 = (q0 if q0.flags.carray else q0.copy()), True  # one of a result is read-only
        else:
            return self.carefully(target, q0)
        q = empty(self.shape)
        tried, error = self.kernel(target.homogeneous, start, from_q0, q)
        if not error <= self.tolerance:
            return self.carefully(target, q0)
        q.setflags(False)  # type: ignore[call-arg]  # write=False, by name, takes twice as long
        return new_tuple(IKResult, (CONVERGED, q, error, tried))
