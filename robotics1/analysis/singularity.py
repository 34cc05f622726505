"""Where the Jacobian of a task loses rank."""

from collections.abc import Mapping

import numpy as np

from robotics1.analysis.singular_branches import branches_of
from robotics1.analysis.singular_points import singular_points
from robotics1.analysis.singular_set import SingularSet
from robotics1.errors import TaskError
from robotics1.inputs import counting_number, one_of
from robotics1.robot.box import joint_box
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task


def find_singularities(
    robot: Robot,
    task: Task,
    *,
    method: str = "numeric",
    box: Mapping[str, tuple[float, float]] | None = None,
    samples: int = 200,
    seed: int = 0,
) -> SingularSet:
    """Return the singular set {q : rank J(q) < ρ} of a task, ρ being the rank of J almost everywhere.

    The numeric method knows J at any q, and nothing else of the robot: from random starts it moves to the set
    by Newton's method, measures the set's dimension there, sees which joints are constant and which are free,
    and joins what a walk on the set connects. It can miss a small branch, so `complete` is False.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        method: "numeric".
        box: joint name → (lower, upper), where to look; needed for prismatic joints without limits.
        samples: the number of starts.
        seed: of the random starts.

    Raises:
        InputError: an unlimited prismatic joint without a box, or a bad option.
        TaskError: the task does not fit the robot, or no joint moves it.
    """
    one_of("method", method, ("numeric",))
    count = counting_number("samples", samples, least=1)
    task.check(robot)
    where = joint_box(robot, box)
    rng = np.random.default_rng(counting_number("seed", seed))
    points = singular_points(robot, task, where, rng)
    if points.rank == 0:
        raise TaskError("no joint moves the task at all: its Jacobian is zero everywhere")
    return SingularSet(robot, task, points.rank, branches_of(points, count, rng), method, complete=False)
