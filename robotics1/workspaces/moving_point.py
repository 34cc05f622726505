"""The point whose workspace is asked for, and the joints that move it."""

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.kinematics import forward_kinematics
from robotics1.robot.model import Robot
from robotics1.tasks.rows import constant_rows
from robotics1.tasks.task import Task
from robotics1.workspaces.axes import (
    CLOSED,
    STRAIGHT,
    Axis,
    axes_to,
    require_moving,
    without_held,
    without_joints_at,
)


class MovingPoint(NamedTuple):
    """What the workspace is one of.

    Attributes:
        rows: (m, 3) the rows of the task: r = rows P.
        tip: (3,) the point P at q = 0, or at the value of joints that have no room to move.
        axes: the joints that move it.
        neutral: (nq,) the values of the other joints [rad or m]; 0, or the limit nearest to it.
        held: the names of the joints without room.
    """

    rows: Array
    tip: Array
    axes: list[Axis]
    neutral: Array
    held: list[str]


def moving_point(robot: Robot, task: Task, box: Mapping[str, tuple[float, float]] | None) -> MovingPoint:
    """Return the point whose position a task is.

    Raises:
        TaskError: the task is no position, or no joint moves it.
    """
    robot.require_single_coordinates("have a workspace")
    rows, frame = position_rows(task)
    tip = np.array(forward_kinematics(robot, np.zeros(robot.nq), frame=frame).translation)
    axes = without_joints_at(tip, axes_to(robot, frame, box), STRAIGHT * robot.reach)
    require_moving(axes, robot)
    return point_moved_by(robot, axes, tip, rows)


def point_moved_by(robot: Robot, axes: Sequence[Axis], tip: Array, rows: Array) -> MovingPoint:
    """Return what moves a tip (3,) whose coordinates along the rows (m, 3) are the task."""
    lower, upper = robot.lower.copy(), robot.upper.copy()
    for axis in axes:
        lower[axis.number], upper[axis.number] = axis.lower, axis.upper
    moving, at_tip = without_held(axes, tip, STRAIGHT * robot.reach)
    held = [axis.name for axis in axes if axis.upper - axis.lower < CLOSED]
    return MovingPoint(rows, at_tip, moving, np.clip(np.zeros(robot.nq), lower, upper), held)


def position_rows(task: Task) -> tuple[Array, str | None]:
    """Return the directions whose coordinates the task is, (m, 3), and its frame."""
    form, S = task.frame_map(), constant_rows(task)
    if form is not None and S is not None and form.reference == "world" and len(S) in (2, 3):
        n = S[:, :3]
        if not S[:, 3:].any() and np.allclose(n @ n.T, np.eye(len(S))):
            return n, form.frame
    raise TaskError(
        "a workspace is one of two or three coordinates of a point in world axes: use PositionTask('xy') of an "
        "arm in a plane, or PositionTask() of an arm in space, with point= beside the tool; a function of your own "
        "cannot be read"
    )
