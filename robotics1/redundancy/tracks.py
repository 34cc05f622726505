"""What a level follows: its task, with a trajectory or a target at rest, and the gain of its error."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array, non_negative_numbers
from robotics1.robot.model import Robot
from robotics1.tasks.given import task_from
from robotics1.tasks.rows import unitless_factors
from robotics1.tasks.task import Task


@dataclass(frozen=True, eq=False)
class Track:
    """A level: its task, its trajectory or its target at rest, its gain, and factors that take the units out of J."""

    task: Task
    motion: Curve | None
    target: Any
    gain: Array
    scale: Array

    def error(self, robot: Robot, t: float, q: Array) -> Array:
        """Return r_d(t) − f(q), (m,)."""
        return self.task.error(robot, q, self.target if self.motion is None else self.motion(t))

    def asked(self, robot: Robot, t: float, q: Array, side: Side) -> Array:
        """Return ṙ_d + K e, (m,)."""
        ahead = 0.0 if self.motion is None else self.motion.velocity(t, side=side)
        return np.asarray(ahead + self.gain * self.error(robot, t, q))

    def sampled(self, times: Array, side: Side) -> list[tuple[Any, Array]]:
        """Return r_d and ṙ_d, (m,), at each of the times."""
        if self.motion is None:
            return [(self.target, np.zeros(self.task.rows))] * len(times)
        return list(zip(self.motion(times), self.motion.velocity(times, side=side), strict=True))


def tracks_of(robot: Robot, levels: Any) -> list[Track]:
    """Return the levels, checked."""
    if not isinstance(levels, Sequence) or isinstance(levels, str) or not levels:
        raise InputError(f"levels must be a list of (task, trajectory) or (task, trajectory, K); it is {levels!r}")
    found = []
    for number, level in enumerate(levels, 1):
        if not isinstance(level, Sequence) or len(level) not in (2, 3):
            raise InputError(f"level {number} must be (task, trajectory) or (task, trajectory, K); it is {level!r}")
        given, wanted, *gains = level
        task = task_from(given)
        task.check_integrable(robot)
        K = non_negative_numbers(f"the gain of level {number}", gains[0] if gains else 0.0, task.rows)
        moving = callable(wanted) or hasattr(wanted, "trajectory")
        motion = as_curve(f"the trajectory of level {number}", wanted, derivatives=1) if moving else None
        if motion is not None and motion.shape != (task.rows,):
            raise InputError(f"the trajectory of level {number} must have {task.rows} rows; it has {motion.shape}")
        found.append(Track(task, motion, None if moving else task.target(wanted), K, unitless_factors(robot, task)))
    return found
