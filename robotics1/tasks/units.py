"""Metres and radians made comparable: lengths divided by the reach of the arm."""

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task


def unitless_rows(robot: Robot, task: Task) -> Array:
    """Return (m,) factors for the rows of a task: 1/reach for those in metres, else 1."""
    return np.array([1 / robot.reach if unit == "m" else 1.0 for unit in task.row_units])


def unitless_jacobian(robot: Robot, task: Task, q: npt.ArrayLike) -> Array:
    """Return J(q), (m, nv), without units: rows in metres and prismatic speeds are divided by the reach."""
    return np.asarray(unitless_rows(robot, task)[:, None] * task.jacobian(robot, q) * robot.units)
