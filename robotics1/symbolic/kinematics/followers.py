"""Which joints that follow another have formulas: those that turn by a fraction of an angle, or slide with a slide."""

from collections.abc import Sequence

import numpy as np

from robotics1.errors import FormulaError
from robotics1.robot.followers import MOST_TURNS, fraction_of, turns_of_followers
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.parameters import JointNumbers


def turns_of_leaders(robot: Robot, links: Sequence[str], joints: Sequence[JointNumbers]) -> tuple[int, ...]:
    """Return after how many turns of each joint, (nq,), its followers on the ways to the links are back too.

    Raises:
        FormulaError: one of the joints follows in another way, or there are more than 12 turns.
    """
    for joint in joints:
        if joint.kind != "fixed":
            _check(robot, joint)
    turns = turns_of_followers(robot, links)
    for name, number in zip(robot.joint_names, turns, strict=True):
        if not np.isfinite(number):
            raise FormulaError(f"the joints that follow {name!r} are not back together after {MOST_TURNS} turns of it")
    return tuple(map(int, turns))


def _check(robot: Robot, joint: JointNumbers) -> None:
    turns = robot.revolute[robot.joint_names.index(joint.leader)]
    if joint.kind == "prismatic" and turns:
        raise FormulaError(f"joint {joint.name!r} slides by {joint.multiplier:g} times the angle of {joint.leader!r}")
    if joint.kind == "revolute" and not turns:
        raise FormulaError(f"joint {joint.name!r} turns by {joint.multiplier:g} times the length of {joint.leader!r}")
    if joint.kind == "revolute" and fraction_of(joint.multiplier) is None:
        raise FormulaError(
            f"joint {joint.name!r} turns by {joint.multiplier:.15g} times the angle of {joint.leader!r}, which is no "
            f"fraction with a denominator up to {MOST_TURNS}, to twelve digits; formulas are written for those"
        )
