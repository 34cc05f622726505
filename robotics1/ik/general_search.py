"""The robust search in Python, for any task: for the user's own function, and where the kernels do not serve."""

from collections.abc import Callable
from dataclasses import replace
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError, TaskError
from robotics1.ik.batch_starts import starts_of_all
from robotics1.ik.descent import Descent
from robotics1.ik.result import IKBatch, IKResult
from robotics1.ik.status import IKStatus
from robotics1.inputs import Array
from robotics1.robot.box import TURN, JointBox, joint_box
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
        if robot.nv == 0:
            raise TaskError("nothing moves this task: the robot has no joint")
        self.robot, self.task, self.tolerance = robot, task, tolerance
        self.seed, self.time_limit = seed, time_limit
        self.box = box_inside_limits(robot)

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
            np.array([answer.error for answer in answers]),
            np.array([answer.starts for answer in answers]),
        )

    def solve(self, target: Any, q0: npt.ArrayLike | None) -> IKResult:
        """Return the first solution, or the nearest miss when the time is over."""
        end = perf_counter() + self.time_limit
        descent = Descent(self.robot, self.task, self.task.target(target), self.box)
        rng = np.random.default_rng((self.seed, 0))
        start = self.box.random(rng, 1)[0] if q0 is None else self.box.nearest(self.robot.configuration(q0, "q0"))
        best, least, tried = start, np.inf, 0
        while True:
            q, _ = descent.descend(start)
            tried += 1
            error = self._error(q, target)
            if error < least:
                best, least = q, error
            if least <= self.tolerance:
                return self._wound(IKResult(IKStatus.CONVERGED, best, least, tried), target, q0)
            if perf_counter() > end:
                break
            start = self.box.random(rng, 1)[0]
        nearer = descent.nearest_miss(best)
        if self._error(nearer, target) < least:
            best, least = nearer, self._error(nearer, target)
        status = IKStatus.CONVERGED if least <= self.tolerance else IKStatus.NOT_FOUND
        return IKResult(status, best, least, tried)

    def _wound(self, found: IKResult, target: Any, q0: npt.ArrayLike | None) -> IKResult:
        """Return the solution with joints without limits within half a turn of q0, if that is one."""
        if q0 is None:
            return found
        turns = np.where(self.box.circular, np.round((self.robot.configuration(q0, "q0") - found.q) / TURN), 0.0)
        q = found.q + TURN * turns
        error = self._error(q, target)
        return found._replace(q=q, error=error) if error <= self.tolerance else found

    def _error(self, q: Array, target: Any) -> float:
        return float(np.hypot.reduce(self.task.error(self.robot, q, target)))


def box_inside_limits(robot: Robot) -> JointBox:
    """Return the box of the limits, in which just joints without limits are circles.

    A user's function may tell a joint's turns apart.
    """
    box = joint_box(robot, unlimited=2.0)
    limited = np.isfinite(robot.lower) & np.isfinite(robot.upper)
    return replace(
        box,
        lower=np.where(limited, robot.lower, box.lower),
        upper=np.where(limited, robot.upper, box.upper),
        circular=box.circular & ~limited,
    )
