"""A grid over all that an arm may reach."""

import math

import numpy as np

from robotics1.errors import InputError
from robotics1.ik.pose_problem import pose_problem
from robotics1.ik.proof import motionless, reach_bound
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.tasks.position import AXES, PositionTask
from robotics1.tasks.task import FrameMap


def grid_over_reach(robot: Robot, form: FrameMap, letters: str, step: float) -> dict[str, Array]:
    """Return letter → values with a step [m], of a cube around what the lengths of the arm allow.

    The middle is a point on the first axis; a coordinate that no joint changes has its one value.

    Raises:
        InputError: a slide has no limits, so that the cube has no end.
    """
    problem = pose_problem(robot, PositionTask(letters, frame=form.frame, reference=form.reference))
    bound, still = reach_bound(problem), motionless(robot, problem.form)
    if not math.isfinite(bound.length):
        raise InputError("a slide without limits reaches without end: name the positions, as {'x': [0, 0.1], ...}")
    steps = step * np.arange(-math.ceil(bound.length / step), math.ceil(bound.length / step) + 1)
    return {
        letter: np.array([still.p[i]]) if still.rows[i] else bound.o[i] + steps
        for i, letter in ((AXES.index(letter), letter) for letter in letters)
    }
