"""Proofs by bisection that equations have no common zero."""

from collections.abc import Collection, Sequence

import numpy as np

from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.symbolic.polynomials.evaluation import Evaluated
from robotics1.symbolic.polynomials.time_limit import check_time

MOST_BOXES = 20_000  # that may hold a zero at one time
MOST_JOINTS = 4  # that are cut


def have_no_zero(
    equations: Sequence[Evaluated],
    box: JointBox,
    fixed: Array,
    joints: Collection[int],
    apart_from: Array | None = None,
    beside: float = 0.0,
) -> bool:
    """Return whether it is proven that the equations have no common zero in the box.

    A part of the box is dropped where one of the equations is farther from zero at the centre than it can change
    inside; what is left is cut in two (Moore, Kearfott and Cloud 2009, Introduction to Interval Analysis).

    Args:
        equations: functions of q (n,).
        box: where q may lie.
        fixed: (n,) q of the joints that are not cut.
        joints: those that are cut; the equations must not depend on others, but for the fixed ones.
        apart_from: zeros that are known, (k, n): what is within `beside` of one, in units, is left out.
        beside: see `apart_from`.

    Raises:
        OutOfTime: the time of a limit that is kept is over.
    """
    cut = np.isin(np.arange(len(fixed)), list(joints))
    half = np.where(cut, (box.upper - box.lower) / 2, 0.0)
    if cut.sum() > MOST_JOINTS or not np.isfinite(half).all():
        return False
    centres = np.where(cut, (box.lower + box.upper) / 2, fixed)[None]
    known = np.empty((0, len(fixed))) if apart_from is None else apart_from
    while len(centres) <= MOST_BOXES:
        check_time()
        possible = np.all([f.least_in_boxes(centres, half) <= 0 for f in equations], axis=0)
        for zero in known:
            inside = (np.abs(box.difference(centres, zero)) + half / box.unit <= beside) | ~cut
            possible &= ~inside.all(axis=1)
        centres = centres[possible]
        if not len(centres):
            return True
        if (half <= 1e-6 * box.unit).all():
            return False
        widest = int(np.argmax(half / box.unit))
        half[widest] /= 2
        step = np.where(np.arange(len(half)) == widest, half, 0.0)
        centres = np.concatenate([centres - step, centres + step])
    return False
