"""The robust search in Python, for any task: for the user's own function, and where the kernels do not serve."""

from collections.abc import Callable
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.ik.batch_starts import starts_of_all
from robotics1.ik.descent import Descent
from robotics1.ik.result import IKBatch, IKResult
from robotics1.ik.status import IKStatus
from robotics1.inputs import Array
from robotics1.robot.box import joint_box
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task


class GeneralSearch:
    """Descents by damped least squares, from q0 and from random starts, on the task's own error and Jacobian."""

    def __init__(
        self, robot: Robot, task: Task, *, prefer: str, seed: int, tolerance: float, time_limit: float
    ) -> None:
        if prefer != "any":
            raise InputError(f"prefer={prefer!r} needs a task on one frame, such as PoseTask; this one takes 'any'")
        task.check_integrable(robot)
        self.robot, self.task, self.tolerance = robot, task, tolerance
        self.seed, self.time_limit = seed, time_limit
        self.box = joint_box(robot, unlimited=2.0)

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
            except InputError as error:
                raise InputError(f"target {i} of the batch: {error}") from error
            if progress is not None:
                progress(i + 1, k)
        return IKBatch(
            np.array([answer.q for answer in answers]),
            np.array([answer.status for answer in answers]),
            np.array([answer.error for answer in answers]),
            np.array([answer.starts for answer in answers]),
        )

    def solve(self, target: Any, q0: npt.ArrayLike | None) -> IKResult:
        """Return the first solution, or the nearest miss when the time is over."""
        end = perf_counter() + self.time_limit
        descent = Descent(self.robot, self.task, self.task.target(target), self.box)
        rng = np.random.default_rng(self.seed)
        start = self.box.random(rng, 1)[0] if q0 is None else self.box.nearest(self.robot.configuration(q0))
        best, least, tried = start, np.inf, 0
        while True:
            q, _ = descent.descend(start)
            tried += 1
            error = self._error(q, target)
            if error < least:
                best, least = q, error
            if least <= self.tolerance:
                return IKResult(IKStatus.CONVERGED, best, least, tried)
            if perf_counter() > end:
                break
            start = self.box.random(rng, 1)[0]
        nearer = descent.nearest_miss(best)
        if self._error(nearer, target) < least:
            best, least = nearer, self._error(nearer, target)
        status = IKStatus.CONVERGED if least <= self.tolerance else IKStatus.NOT_FOUND
        return IKResult(status, best, least, tried)

    def _error(self, q: Array, target: Any) -> float:
        return float(np.linalg.norm(self.task.error(self.robot, q, target)))
