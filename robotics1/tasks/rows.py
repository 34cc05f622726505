"""The rows of a task: S of ṙ = S V where it is the same everywhere, and J without units."""

from __future__ import annotations

import numpy as np

from robotics1.inputs import Array
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.tasks.task import Task


def constant_rows(task: Task) -> Array | None:
    """Return S, (m, 6), of a task ṙ = S V on one frame whose S is the same at every pose, else None."""
    form = task.frame_map()
    if form is None or form.S is None or not form.constant_rows:
        return None
    return np.asarray(form.S(np.zeros(3), np.eye(3)), dtype=float)


def unitless_rows(robot: Robot, task: Task) -> Array:
    """Return (m,) factors for the rows of a task: 1/reach for those in metres, else 1."""
    return np.array([1 / robot.reach if unit == "m" else 1.0 for unit in task.row_units])


def unitless_factors(robot: Robot, task: Task) -> Array:
    """Return (m, nv) factors that take the units out of J: of rows in metres, and of joints that slide."""
    return np.asarray(unitless_rows(robot, task)[:, None] * robot.units)


def unitless_jacobian(robot: Robot, task: Task, q: ConfigurationLike) -> Array:
    """Return J(q), (m, nv), without units: rows in metres and prismatic speeds are divided by the reach."""
    return np.asarray(unitless_factors(robot, task) * task.jacobian(robot, q))
