"""The search in Python, of one target at a time: for tasks that the kernels do not know, as functions of the user."""

from collections.abc import Iterator
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError, TaskError
from robotics1.ik.descent import OutOfTime, TaskDescent
from robotics1.ik.scaled_task import scaled_task
from robotics1.ik.search import Ends, Found, Search, Table
from robotics1.inputs import Array
from robotics1.kernels.chain import Indices
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

GRACE, LONGER = 0.05, 0.1  # seconds, or of the time limit, that the nearest miss may take longer ...
QUICK = 1e-3  # ... where an evaluation takes less than that [s]
GROUP = 8  # random starts; the one with the least error is taken
PREPARING = 0.2  # of the time limit, that a look at the task may take


class PythonSearch(Search):
    """Damped least squares on the task's own error and Jacobian; a goal is the `TaskDescent` to a target.

    Attributes:
        quick: whether the task is evaluated so fast that the best of some starts is worth its price.
    """

    at_once = cores = 1
    enough = 0.6  # the rest of the time is for the nearest miss

    def __init__(self, robot: Robot, task: Task, *, prefer: str, seed: int, tolerance: float, time_limit: float):
        if prefer != "any":
            raise InputError(f"prefer={prefer!r} needs a task on one frame, such as PoseTask; this one takes 'any'")
        task.check_integrable(robot)
        if robot.nv == 0:
            raise TaskError("nothing moves this task: the robot has no joint")
        import scipy.optimize  # noqa: F401  (now, and not while the time runs)

        self.robot, self.task, self.tolerance, self.time_limit = robot, task, tolerance, time_limit
        self.seed, self.grace = seed, max(GRACE, LONGER * time_limit)
        self.problem = scaled_task(robot, task, open_ranges=True, seconds=PREPARING * time_limit)
        begin = perf_counter()
        task.value(robot, self.problem.middle)
        self.quick = perf_counter() - begin < QUICK

    def goals(self, targets: list[Any], first: int | None) -> npt.NDArray[Any]:
        """Return the descents to the targets."""
        goals = np.empty(len(targets), dtype=object)
        goals[:] = [TaskDescent(self.problem, self.task.target(target)) for target in targets]
        return goals

    def tables(self) -> Iterator[Table]:
        """Yield groups of random starts."""
        rng = np.random.default_rng((self.seed, 0))
        while True:
            yield self.problem.random(rng, GROUP), GROUP

    def begin(self, found: Found, tables: Iterator[Table], seconds: float) -> None:
        """Descend from q0, or from the best of the first random starts."""
        around = None if found.starts is None else found.starts[0]
        starts = next(tables) if around is None else (self.problem.box.nearest(around)[None], 1)
        found.q, found.tried, found.error = self.again(found, np.arange(1), starts, seconds)

    def again(self, found: Found, left: Indices, starts: Table, seconds: float) -> Ends:
        """Return where the best of some starts leads."""
        descent = found.goals[left[0]].until(perf_counter() + seconds)
        around = None if found.starts is None else found.starts[left[0]]
        q, _ = descent.descend(self._best(descent, starts[0]))
        q = self._wound(descent, q, around)
        return q[None], np.ones(1, dtype=np.int64), np.array([descent.error_norm(q)])

    def miss(self, found: Found, never: Indices, seconds: float) -> None:
        """Move what was found to where |e| is least around it; that may take a little longer than the time."""
        grace = self.grace if self.quick else 0.0
        for i in never:
            descent = found.goals[i].until(perf_counter() + seconds + grace)
            q = self._wound(descent, descent.nearest_miss(found.q[i]), None)
            error = descent.error_norm(q)
            if error < found.error[i]:
                found.q[i], found.error[i] = q, error

    def _best(self, descent: TaskDescent, starts: Array) -> Array:
        """Return the best of some random starts, of a slow function the first one."""
        if not self.quick or len(starts) == 1:
            return np.asarray(starts[0])
        errors = [float(np.hypot.reduce(self.problem.error(q, descent.target))) for q in starts]
        return np.asarray(starts[int(np.nanargmin(errors))])

    def _wound(self, descent: TaskDescent, q: Array, around: Array | None) -> Array:
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
        return near if descent.error_norm(near) <= max(self.tolerance, descent.error_norm(q)) else q
