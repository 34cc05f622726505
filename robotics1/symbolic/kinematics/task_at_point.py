"""A task at a point beside its frame, as a task of a frame at that point: what reads frames alone can then read it."""

from dataclasses import replace
from typing import Any

from robotics1.robot.model import Robot
from robotics1.tasks.task import Task


def with_frame_at_point(robot: Robot, task: Task) -> tuple[Robot, Task]:
    """Return the robot with a frame at the point of the task, and the task on it; both as they are without a point.

    Raises:
        InputError: the task has no frame, and the robot several tips.
        UnknownNameError: there is no such frame.
    """
    one: Any = task
    if getattr(one, "point", None) is None:
        return robot, task
    from robotics1.symbolic.kinematics.points import with_point

    held, frame = with_point(robot, one.frame, one.point)
    return held, replace(one, frame=frame, point=None)
