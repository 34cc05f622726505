"""After how many turns of a joint the joints that follow it are back too: two of one with multiplier 0.5."""

from collections.abc import Iterable
from fractions import Fraction
from math import lcm

import numpy as np

from robotics1.inputs import Array
from robotics1.robot.model import Robot

MOST_TURNS = 12  # of a leader, and so the largest denominator of a multiplier that counts as a fraction
SAME = 1e-12  # difference of a multiplier and the fraction that it is


def fraction_of(multiplier: float) -> Fraction | None:
    """Return a multiplier as a fraction with a denominator up to 12, or None if it is none: 0.3333 is not 1/3."""
    fraction = Fraction(multiplier).limit_denominator(MOST_TURNS)
    return fraction if abs(float(fraction) - multiplier) <= SAME else None


def turns_of_followers(robot: Robot, frames: Iterable[str | None]) -> Array:
    """Return after how many turns of each joint, (nq,), all joints on the ways to the frames are back.

    It is 1 for a joint without followers, and for one that slides; ∞ where 12 turns are not enough, as with a follower
    that slides. Raises UnknownNameError for an unknown frame.
    """
    turns = np.ones(robot.nq)
    if robot.nq != robot.nv:
        return turns
    model, zero = robot.model, np.zeros(robot.nq)
    for frame in frames:
        for number in list(model.supports[model.frames[robot.frame_id(frame)].parentJoint])[1:]:
            joint = model.joints[number]
            motion = joint.createData()
            joint.calc(motion, zero)
            speed = np.asarray(motion.S).ravel()
            if robot.revolute[joint.idx_q]:
                turns[joint.idx_q] = _common(turns[joint.idx_q], speed)
    return turns


def _common(turns: float, speed: Array) -> float:
    """Return after how many turns a joint that moves by the twist `speed` per radian is back, with those before it."""
    fraction = fraction_of(float(np.linalg.norm(speed)))
    if np.isinf(turns) or fraction is None or speed[:3].any():
        return np.inf
    common = lcm(int(turns), fraction.denominator)
    return common if common <= MOST_TURNS else np.inf
