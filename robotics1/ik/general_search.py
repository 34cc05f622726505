"""The robust search in Python, for any task: for the user's own function, and where the kernels do not serve."""

from collections.abc import Callable
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError, TaskError
from robotics1.ik.batch_starts import starts_of_all
from robotics1.ik.descent import Descent, OutOfTime, until
from robotics1.ik.result import IKBatch, IKResult, IKStatus
from robotics1.ik.scaled_task import scaled_task
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

SEARCHING = 0.6  # of the time limit; the rest is for the nearest miss
GRACE, LONGER = 0.05, 0.1  # seconds, or of the time limit, that the nearest miss may take longer ...
QUICK = 1e-3  # ... where an evaluation takes less than that [s]
GROUP = 8  # random starts of which the one with the least error is taken
PREPARING = 0.2  # of the time limit, that a look at the task may take


class GeneralSearch:
    """Descents by damped least squares, from q0 and from random starts, on the task's own error and Jacobian."""

    def __init__(
        self, robot: Robot, task: Task, *, prefer: str, seed: int, tolerance: float, time_limit: float
    ) -> None:
        if prefer != "any":
            raise InputError(f"prefer={prefer!r} needs a task on one frame, such as PoseTask; this one takes 'any'")
        task.check_integrable(robot)
        if robot.nv == 0:
            raise TaskError("nothing moves this task: the robot has no joint")
        import scipy.optimize  # noqa: F401  (now, and not while the time runs)

        self.robot, self.task, self.tolerance = robot, task, tolerance
        self.seed, self.time_limit = seed, time_limit
        self.problem = scaled_task(robot, task, open_ranges=True, seconds=PREPARING * time_limit)
        begin = perf_counter()
        task.value(robot, self.problem.middle)
        self.quick = perf_counter() - begin < QUICK

    def quick_call(self) -> Callable[[Any, Any], IKResult]:
        """Return `solve`; there is nothing quicker."""
        return self.solve

    def batch(
        self, targets: list[Any], q0: npt.ArrayLike | None, progress: Callable[[int, int], None] | None
    ) -> IKBatch:
        """Return the answers for many targets, one after the other."""
        k = len(targets)
        starts = [None] * k if q0 is None else starts_of_all(self.robot, q0, k)
        answers = []
        for i, target in enumerate(targets):
            try:
                answers.append(self.solve(target, starts[i]))
            except (InputError, TaskError) as error:
                raise type(error)(f"target {i} of the batch: {error}") from error
            if progress is not None:
                progress(i + 1, k)
        return IKBatch(
            np.array([answer.q for answer in answers]),
            np.array([answer.status for answer in answers]),
            np.array([answer.error_norm for answer in answers]),
            np.array([answer.starts for answer in answers]),
        )

    def solve(self, target: Any, q0: npt.ArrayLike | None) -> IKResult:
        """Return the first solution, or the nearest miss when the time is over."""
        begin, box = perf_counter(), self.problem.box
        searching = until(begin + SEARCHING * self.time_limit)
        goal, around = self.task.target(target), None if q0 is None else self.robot.configuration(q0, "q0")
        rng = np.random.default_rng((self.seed, 0))
        descent = Descent(self.problem, goal, searching)
        start = self._start(descent, rng) if around is None else box.nearest(around)
        best, least, tried = start, np.inf, 0
        while True:
            q, error = self._answer(descent, start, around)
            tried += 1
            if error < least:
                best, least = q, error
            if least <= self.tolerance:
                return IKResult(IKStatus.CONVERGED, best, least, tried)
            try:
                searching()
            except OutOfTime:
                break
            start = self._start(descent, rng)
        grace = max(GRACE, LONGER * self.time_limit) if self.quick else 0.0
        last = Descent(self.problem, goal, until(begin + self.time_limit + grace), descent.known)
        q = self._wound(last, last.nearest_miss(best), None)
        error = self._error(last, q)
        if error < least:
            best, least = q, error
        status = IKStatus.CONVERGED if least <= self.tolerance else IKStatus.NOT_FOUND
        return IKResult(status, best, least, tried)

    def _start(self, descent: Descent, rng: np.random.Generator) -> Array:
        """Return the best of some random starts, of a slow function the first one."""
        starts = self.problem.random(rng, GROUP)
        best, least = starts[0], np.inf
        for q in starts if self.quick else ():
            error = float(np.hypot.reduce(descent.problem.error(q, descent.target)))
            if error < least:
                best, least = q, error
        return np.asarray(best)

    def _answer(self, descent: Descent, start: Array, around: Array | None) -> tuple[Array, float]:
        """Return where a descent ends, turned until its value is the target's, and |e| in the task's units."""
        q, _ = descent.descend(start)
        q = self._wound(descent, q, around)
        return q, self._error(descent, q)

    def _wound(self, descent: Descent, q: Array, around: Array | None) -> Array:
        """Return q with joints turned as the target counts turns, and the others to within half a turn of `around`."""
        problem, turns = self.problem, self.problem.turns
        try:
            wound = turns.wound(q, descent.task_error(q), problem.lower, problem.upper)
        except OutOfTime:  # before the task was evaluated once
            return q
        q = q if wound is None else wound
        if around is None:
            return q
        near = turns.near(q, around, problem.lower, problem.upper)
        return near if self._error(descent, near) <= max(self.tolerance, self._error(descent, q)) else q

    def _error(self, descent: Descent, q: Array) -> float:
        """Return |r_d − f(q)|, whatever the clock says."""
        error = descent.known.get(q.tobytes())
        if error is None:
            error = self.task.error(self.robot, q, descent.target)
        return float(np.hypot.reduce(error))
