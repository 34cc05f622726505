"""Levels as the caller hands them in, the most important first: a task, and what is asked of it at a state, or what it
follows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array, moderate, non_negative_numbers, real_array
from robotics1.kinematics import velocity_of_joints
from robotics1.redundancy.hierarchy import Level
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import Robot
from robotics1.tasks.given import TaskLike, task_from
from robotics1.tasks.rows import unitless_factors, unitless_rows
from robotics1.tasks.task import Task
from robotics1.trajectories.following.task_rates import jacobian_rate


class LevelRows(NamedTuple):
    """J x + drift of one level, with x = q̇ or q̈.

    Attributes:
        J: (m, nv).
        drift: (m,) J̇ q̇; zero of velocities.
        scale: (m, nv) factors that take the units out of J.
        units: (m,) factors that take the units out of what is asked.
    """

    J: Array
    drift: Array
    scale: Array
    units: Array

    def equation(self, asked: Array) -> Level:
        """Return J x = asked − drift, as `by_levels` takes it."""
        return self.J, asked - self.drift, self.scale

    def size(self, *rates: Array) -> float:
        """Return the sum of the norms of rates, without units."""
        return float(sum(np.linalg.norm(self.units * rate) for rate in rates))


@dataclass(frozen=True, eq=False)
class AskedLevels:
    """The rates, or accelerations, that are asked of several tasks.

    Attributes:
        robot: whose joints make them.
        tasks: of each level.
        asked: of each level ṙ, or r̈, (m,).
        qdot: (nv,) q̇, where accelerations are asked.
    """

    robot: Robot
    tasks: tuple[Task, ...]
    asked: tuple[Array, ...]
    qdot: Array | None = None

    def rows(self, q: Array) -> list[LevelRows]:
        """Return the rows of each level at a configuration."""
        robot = self.robot
        return [
            LevelRows(
                task.jacobian(robot, q), self._drift(task, q), unitless_factors(robot, task), unitless_rows(robot, task)
            )
            for task in self.tasks
        ]

    def _drift(self, task: Task, q: Array) -> Array:
        if self.qdot is None:
            return np.zeros(task.rows)
        return np.asarray(jacobian_rate(self.robot, task, q, self.qdot) @ self.qdot)


def asked_levels(
    robot: RobotLike,
    levels: Sequence[tuple[TaskLike, npt.ArrayLike]],
    symbol: str,
    qdot: npt.ArrayLike | None = None,
) -> AskedLevels:
    """Return the levels, checked, and what is asked of them, which `symbol` names; with q̇ it is accelerations.

    Raises:
        InputError: as `level_pairs`, or a rate has not one number for each row of its task.
        TaskError: a task does not fit the robot.
    """
    robot, pairs = robot_from(robot), level_pairs(levels, symbol)
    for task, _ in pairs:
        task.check(robot)
    asked = [
        real_array(f"{symbol} of level {number}", rate, (task.rows,), "one number for each row of J")
        for number, (task, rate) in enumerate(pairs, 1)
    ]
    return AskedLevels(robot, tuple(task for task, _ in pairs), tuple(asked), _speed(robot, qdot))


def asked_of_one(
    robot: Robot, task: Task, name: str, asked: npt.ArrayLike, qdot: npt.ArrayLike | None = None
) -> AskedLevels:
    """Return the same of one task; `name` is that of the argument."""
    rate = real_array(name, asked, (task.rows,), "one number for each row of J")
    return AskedLevels(robot, (task,), (rate,), _speed(robot, qdot))


def _speed(robot: Robot, qdot: npt.ArrayLike | None) -> Array | None:
    return None if qdot is None else moderate("qdot", velocity_of_joints(robot, "qdot", qdot))


def level_pairs(levels: Any, symbol: str) -> list[tuple[Task, Any]]:
    """Return the task of each level, and what is asked of it, which `symbol` names.

    Raises:
        InputError: the levels are no pairs, there is none, or a task is asked twice.
    """
    if not isinstance(levels, Sequence) or isinstance(levels, str) or not levels:
        raise InputError(f"levels must be a list of pairs (task, {symbol}), the most important first; it is {levels!r}")
    pairs: list[tuple[Task, Any]] = []
    for number, level in enumerate(levels, 1):
        if not isinstance(level, Sequence) or isinstance(level, str) or len(level) != 2:
            raise InputError(f"level {number} must be a pair (task, {symbol}); it is {level!r}")
        task = task_from(level[0])
        if any(task == other for other, _ in pairs):
            raise InputError(f"level {number} has the same task as one before it, which decides it already: {task!r}")
        pairs.append((task, level[1]))
    return pairs


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
