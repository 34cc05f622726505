"""Whether curves of solutions are all: the joints that move along one are a linkage, whose curves can be counted.

A joint about a line through the end turns alone, two joints about one line turn against each other: one curve. Four
joints whose axes are parallel, or go through one point, are a planar or a spherical four-bar linkage. Two neighbouring
links span a diagonal d, and so do the two others. Each pair allows an interval of d, and has two postures, which meet
where d is at an end of the interval. So d runs from end to end of what both intervals share. If one pair ends it at
both sides, the other never changes its posture, and there are two curves, else one (Grashof's rule).
"""

from collections.abc import Sequence

import numpy as np

from robotics1.ik.family_curve import FamilyCurve
from robotics1.ik.joint_chain import FixedChain
from robotics1.inputs import Array

SAME = 1e-5  # of directions, and of lengths beside the arm's: parallel, through one point, equally long
STANDS = 1e-3  # by which a joint that stands may turn along a curve, where the target is near a joint axis [rad]
REGULAR = 1e-4  # σ beside σ₁ of the directions across a curve, below which another may cross it


def are_all(curves: Sequence[FamilyCurve], chain: FixedChain) -> bool:
    """Whether curves of solutions are proven to be all.

    Args:
        curves: one or more through each place where other joints stand. These places are finitely many, and all known.
        chain: the joints that move the task.
    """
    if not all(curve.closed and curve.regularity > REGULAR for curve in curves):
        return False
    lines = [curve.line[:, list(chain.coordinate)] for curve in curves]
    moves = [np.ptp(np.unwrap(line, axis=0), axis=0) > STANDS for line in lines]
    for line, moved in zip(lines, moves, strict=True):
        apart = [np.angle(np.exp(1j * (other[0] - line[0]))) for other in lines]
        alike = [
            bool((moved == others).all() and np.abs(d[~moved]).max(initial=0.0) < STANDS)
            for d, others in zip(apart, moves, strict=True)
        ]
        twists = chain.poses_and_jacobians(line[:1])[1][0].T[moved]
        lengths = np.repeat([chain.length or 1.0, 1.0], 3)
        if np.array(chain.prismatic)[moved].any() or sum(alike) != count_of_curves(twists / lengths):
            return False
    return True


def count_of_curves(twists: Array) -> int | None:
    """Return how many closed curves the turning joints of a linkage describe; None if this is not known.

    Args:
        twists: (k, 6) ω of each axis, one after the other, and before it v, at which the axis moves the end; lengths
            beside that of the arm.

    Returns:
        None if it is none of these, or if all links can lie in one line: curves cross there.
    """
    v, z = twists[:, :3], twists[:, 3:]
    if len(z) not in (1, 2, 4):
        return None
    if np.abs(np.cross(z, z[0])).max() < SAME:
        v = v * np.sign(z @ z[0])[:, None]  # v = z × (p − o): it differs by the distance of the axes
        sides = np.linalg.norm(v - np.roll(v, -1, axis=0), axis=1)
        if len(z) == 4:
            return _curves_of_four_bars(sides, np.inf)
        return 1 if sides.max() < SAME else None
    if len(z) == 4 and _meet(v, z):
        cosines = (z * np.roll(z, -1, axis=0)).sum(axis=1)
        return _curves_of_four_bars(np.arccos(np.clip(cosines, -1, 1)), np.pi)
    return None


def _meet(v: Array, z: Array) -> bool:
    """Whether axes go through one point, which is r beside the end: v = −z × r."""
    crossed = -np.cross(z[:, None], np.eye(3)).transpose(0, 2, 1).reshape(-1, 3)
    r = np.linalg.lstsq(crossed, v.ravel(), rcond=None)[0]
    return bool(np.abs(crossed @ r - v.ravel()).max() < SAME)


def _curves_of_four_bars(sides: Array, half_turn: float) -> int | None:
    """Return the number of curves of a four-bar linkage: 2 or 1; None where both pairs end d.

    Args:
        sides: (4,) lengths in a plane, or arcs on a sphere [rad], one after the other.
        half_turn: the longest arc; ∞ in a plane.
    """
    a, b, c, d = (float(side) for side in sides)
    low = abs(a - b) - abs(c - d)
    high = min(a + b, 2 * half_turn - a - b) - min(c + d, 2 * half_turn - c - d)
    if min(abs(low), abs(high)) < SAME * max(sides):
        return None
    return 2 if (low > 0) == (high < 0) else 1
