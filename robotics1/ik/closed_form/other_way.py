"""What finds the solutions of an arm that has no closed formulas."""

import numpy as np

from robotics1.errors import Robotics1Error
from robotics1.ik.added_joints import way_to_all_solutions
from robotics1.ik.scaled_task import scaled_task
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

OPEN = 1.0  # m: the range of a slide without limits, which makes no difference to the method
POLYNOMIAL = (
    "its solutions are the real roots of a polynomial of degree 16 at most (Raghavan and Roth, 1993), "
    "all of which ik_solutions finds by {method}"
)


def other_way(robot: Robot, task: Task) -> str:
    """Return the method by which `ik_solutions` finds the numbers, in half a sentence."""
    method = method_of(robot, task)
    if method is None:
        return "ik_solutions finds the numbers, by a search"
    if is_general(method):
        return POLYNOMIAL.format(method=method)
    return f"ik_solutions finds the numbers, by {method}"


def method_of(robot: Robot, task: Task) -> str | None:
    """Return the name of the method of `ik_solutions` that finds all solutions; None where it searches."""
    slides = ~robot.revolute & ~(np.isfinite(robot.lower) & np.isfinite(robot.upper))
    box = {name: (-OPEN, OPEN) for name, is_open in zip(robot.joint_names, slides, strict=True) if is_open}
    try:
        problem = scaled_task(robot, task, box or None)
    except Robotics1Error:
        return None
    form = way_to_all_solutions(robot, task, problem.moving, problem.middle)
    return None if form is None else form.method


def is_general(method: str | None) -> bool:
    """Whether no three joints of six are special, so that formulas joint after joint are not to be expected."""
    return method == "elimination to an eigenvalue problem"
