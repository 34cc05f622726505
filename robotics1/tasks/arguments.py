"""A robot and a task as arguments: what is neither is refused with what would be right."""

from typing import Any

from robotics1.errors import InputError
from robotics1.robot.model import Robot


def require_robot(value: Any) -> Robot:
    """Return `value` if it is a robot.

    Raises:
        InputError: it is none.
    """
    if not isinstance(value, Robot):
        raise InputError(f"robot must be a robot, such as load_robot('planar_2r'); it is {value!r}")
    return value


def require_task(value: Any) -> Any:
    """Return `value` if it is a task.

    Raises:
        InputError: it is none, or a kind of task and no task itself: PoseTask without brackets.
    """
    if isinstance(value, type):
        raise InputError(f"task must be a task, such as {value.__name__}(); the brackets are missing")
    if not hasattr(value, "rows") or not callable(getattr(value, "jacobian", None)):
        raise InputError(f"task must be a task, such as PositionTask('xy'); it is {value!r}")
    return value
