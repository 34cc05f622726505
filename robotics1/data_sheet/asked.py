"""What a data sheet is about: a robot, its task, and the posture at which numbers are given."""

from dataclasses import dataclass, field

import numpy as np

from robotics1.data_sheet.markup import note
from robotics1.inputs import Array
from robotics1.notation import number
from robotics1.results import Frozen
from robotics1.robot.box import joint_box
from robotics1.robot.model import Robot
from robotics1.tasks.rows import unitless_jacobian
from robotics1.tasks.task import Task

DRAWN = 200  # configurations; one of them becomes the posture
UNLIMITED = 1.0  # reaches, how far a slide without limits goes here to both sides
CLEAR = 0.15  # of the range of a joint, to which a posture keeps away from its ends


@dataclass(frozen=True, eq=False)
class Asked(Frozen):
    """What the sections answer about.

    Attributes:
        robot: the arm.
        task: whose Jacobian, singularities and inverse kinematics; None if nothing moves.
        q: (nq,) the posture at which numbers are given.
        title: of the sheet; "" for the robot's name.
    """

    robot: Robot
    task: Task | None
    q: Array
    title: str = ""

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
    """Return a configuration far from singular: of 200 random ones that with the largest σ_min/σ_max, rounded.

    It also keeps away from the ends of the joints' ranges, where an arm is folded.
    """
    box = joint_box(robot, unlimited=UNLIMITED)
    if task is None or robot.nv == 0:
        return box.nearest(np.zeros(robot.nq))
    fractions = np.random.default_rng(0).uniform(CLEAR, 1 - CLEAR, (DRAWN, robot.nq))
    drawn = box.nearest(np.round((1 - fractions) * box.lower + fractions * box.upper, 2))
    sigmas = [np.linalg.svd(unitless_jacobian(robot, task, q), compute_uv=False) for q in drawn]
    return np.asarray(drawn[int(np.argmax([s[-1] / max(s[0], 1e-300) for s in sigmas]))])


def open_slides(asked: Asked) -> dict[str, tuple[float, float]] | None:
    """Return the range in which slides without limits are looked for [m]; None if there is no such slide."""
    robot = asked.robot
    box = joint_box(robot, unlimited=UNLIMITED)
    open_ones = ~robot.revolute & ~(np.isfinite(robot.lower) & np.isfinite(robot.upper))
    ranges = zip(robot.joint_names, box.lower, box.upper, open_ones, strict=True)
    return {name: (low, high) for name, low, high, is_open in ranges if is_open} or None


def open_note(asked: Asked) -> str:
    """Return a remark about the slides without limits; "" if there are none."""
    slides = open_slides(asked) or {}
    ranges = [f"{name} from {number(low)} to {number(high)} m" for name, (low, high) in slides.items()]
    return note(f"Slides without limits are looked at in a range: {', '.join(ranges)}.") if ranges else ""
