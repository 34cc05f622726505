"""What a data sheet is about: a robot, its task, and the posture at which numbers are given."""

from dataclasses import dataclass, field

import numpy as np

from robotics1.inputs import Array
from robotics1.results import Frozen
from robotics1.robot.box import joint_box
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task, unitless_jacobian

DRAWN = 200  # configurations; one of them becomes the posture
UNLIMITED = 1.0  # m, how far a slide without limits goes here


@dataclass(frozen=True, eq=False)
class Asked(Frozen):
    """What the sections answer about.

    Attributes:
        robot: the arm.
        task: whose Jacobian, singularities and inverse kinematics; None if nothing moves.
        q: (nq,) the posture at which numbers are given.
    """

    robot: Robot
    task: Task | None
    q: Array

    @property
    def frame(self) -> str | None:
        """The frame that the task is about."""
        form = None if self.task is None else self.task.frame_map()
        return None if form is None else form.frame

    def require_task(self) -> Task:
        """Return the task.

        Raises:
            TaskError: nothing moves.
        """
        from robotics1.errors import TaskError

        if self.task is None:
            raise TaskError("no joint with one coordinate moves the tool, so that there is no task")
        return self.task


@dataclass(frozen=True)
class Answer:
    """What a section says.

    Attributes:
        html: its text.
        fact: the same in one sentence, for the table at the top; "" if it has none.
    """

    html: str = field(repr=False)
    fact: str = ""


def good_posture(robot: Robot, task: Task | None) -> Array:
    """Return a configuration far from singular: of 200 random ones that with the largest σ_min/σ_max, rounded."""
    box = joint_box(robot, unlimited=UNLIMITED)
    if task is None or robot.nv == 0:
        return box.nearest(np.zeros(robot.nq))
    drawn = box.nearest(np.round(box.random(np.random.default_rng(0), DRAWN), 2))
    sigmas = [np.linalg.svd(unitless_jacobian(robot, task, q), compute_uv=False) for q in drawn]
    return np.asarray(drawn[int(np.argmax([s[-1] / max(s[0], 1e-300) for s in sigmas]))])
