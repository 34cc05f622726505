"""The task that a caller hands in: a task, or its short form such as "position:xy"."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

from robotics1.errors import InputError
from robotics1.inputs import a_task, is_a_robot, is_a_task
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import Robot
from robotics1.tasks.planar_pose import PlanarPoseTask
from robotics1.tasks.pointing import PointingTask
from robotics1.tasks.pose import OrientationTask, PoseTask
from robotics1.tasks.position import PositionTask
from robotics1.tasks.task import FrameTask, Task

TaskLike: TypeAlias = Task | str
KINDS = ("position", "planar", "planar-pose", "orientation", "pose", "pointing")
SHORT_FORMS = ("position[:xyz]", "planar-pose[:xy]", "orientation", "pose", "pointing[:z]")


def task_from(value: TaskLike) -> Task:
    """Return the task that is meant: itself, or that of a short form; see `short_form`.

    Raises:
        InputError: it is neither; the message says what would be right.
    """
    if isinstance(value, str):
        return short_form(value)
    a_task(value)
    return value


def robot_and_task(robot: RobotLike, task: TaskLike) -> tuple[Robot, Task]:
    """Return the robot and the task that are meant; see `robot_from` and `task_from`.

    Raises:
        Robotics1Error: one of them cannot be read, or they are swapped.
    """
    refuse_swapped(robot, task)
    return robot_from(robot), task_from(task)


def refuse_swapped(robot: Any, task: Any) -> None:
    """Refuse a task in the place of the robot, and a robot in that of the task.

    Raises:
        InputError: they are swapped.
    """
    if is_a_task(robot) or is_a_robot(task) or (isinstance(robot, str) and robot.partition(":")[0] in KINDS):
        raise InputError("the robot comes first, then the task; here they are swapped")


def short_form(text: str, frame: str | None = None, angles: str | None = None) -> FrameTask:
    """Return the task of a short form, on a frame; of orientation and pose also by angles.

    ===============  =======================  ==================================
    short form       task                     with an option
    ===============  =======================  ==================================
    "position"       `PositionTask("xyz")`    "position:xy": some coordinates
    "planar-pose"    `PlanarPoseTask("xy")`   "planar-pose:xz": another plane
    "orientation"    `OrientationTask()`
    "pose"           `PoseTask()`
    "pointing"       `PointingTask("z")`      "pointing:-x": another axis
    ===============  =======================  ==================================

    "planar" is "planar-pose".

    Raises:
        InputError: it is none of these, or has no angles.
    """
    kind, _, option = text.strip().partition(":")
    kind = {"planar": "planar-pose", "planar_pose": "planar-pose"}.get(kind, kind)
    kinds: dict[str, Callable[[], FrameTask]] = {
        "position": lambda: PositionTask(option or "xyz", frame=frame),
        "planar-pose": lambda: PlanarPoseTask(option or "xy", frame=frame),
        "orientation": lambda: OrientationTask(angles, frame=frame),
        "pose": lambda: PoseTask(angles, frame=frame),
        "pointing": lambda: PointingTask(option or "z", frame=frame),
    }
    with_angles = ("orientation", "pose")
    if kind not in kinds or (option and kind in with_angles):
        raise InputError(f"there is no task {text[:100]!r}; there is {', '.join(SHORT_FORMS)}")
    if angles is not None and kind not in with_angles:
        raise InputError(f"task {text!r} has no angles; orientation and pose have")
    return kinds[kind]()
