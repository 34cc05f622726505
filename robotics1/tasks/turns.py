"""After how many turns of a joint a task is back: more than one where others turn by fractions of its angle."""

from robotics1.inputs import Array
from robotics1.robot.mimic import turns_of_followers
from robotics1.robot.model import Robot
from robotics1.tasks.function import FunctionTask
from robotics1.tasks.task import FrameTask, Task


def turns_of(robot: Robot, task: Task) -> Array:
    """Return after how many turns of each joint, (nq,), all joints that matter to the task are back; ∞ if never."""
    if not isinstance(task, FrameTask | FunctionTask):
        return turns_of_followers(robot, [frame.name for frame in robot.model.frames])
    reference = getattr(task, "reference", "world")
    axes = [] if reference == "world" else [None if reference == "tool" else reference]
    return turns_of_followers(robot, [task.frame, *axes])
