"""Levels as the caller hands them in: pairs of a task and what is asked of it, the most important first."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import Robot
from robotics1.tasks.given import TaskLike, task_from
from robotics1.tasks.task import Task


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


def checked_levels(
    robot: RobotLike, levels: Sequence[tuple[TaskLike, npt.ArrayLike]], symbol: str
) -> tuple[Robot, list[Task], list[Array]]:
    """Return the robot, and the tasks and the rates of the levels.

    Raises:
        InputError: as `level_pairs`, or a rate has not one number for each row of its task.
        TaskError: a task does not fit the robot.
    """
    robot, pairs = robot_from(robot), level_pairs(levels, symbol)
    for task, _ in pairs:
        task.check(robot)
    rates = [
        real_array(f"{symbol} of level {number}", rate, (task.rows,), "one number for each row of J")
        for number, (task, rate) in enumerate(pairs, 1)
    ]
    return robot, [task for task, _ in pairs], rates
