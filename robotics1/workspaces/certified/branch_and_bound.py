"""The largest value of an objective over a box of configurations, between two numbers: branch and bound.

Source: Horst, Tuy, Global Optimization, 3rd edition, 1996, chapter IV; Hansen, Walster, Global Optimization Using
Interval Analysis, 2004, section 12.5 (the monotonicity test).
"""

from collections.abc import Callable
from dataclasses import dataclass
from time import monotonic
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.workspaces.certified.extremes import ends_of
from robotics1.workspaces.certified.objective import Objective

AT_ONCE = 1024  # boxes that are halved together
MOST = 2_000_000  # boxes that are kept
ROUNDING = 1e-12  # of the values of a bound, relative


@dataclass(frozen=True, eq=False)
class Enclosure:
    """What is known of the largest value of an objective.

    Attributes:
        bound: no configuration has more.
        value: the largest value found.
        q: (n,) a configuration that has it.
        boxes: how many boxes were looked at.
    """

    bound: float
    value: float
    q: Array
    boxes: int


class _Boxes:
    """Boxes of configurations, by their middles and half sides (k, n), and what F is at most in each."""

    def __init__(self, middle: Array, half: Array, bound: Array) -> None:
        self.middle, self.half, self.bound = middle, half, bound

    def take(self, some: npt.NDArray[Any]) -> "_Boxes":
        """Return some of them."""
        return _Boxes(self.middle[some], self.half[some], self.bound[some])

    def with_others(self, other: "_Boxes") -> "_Boxes":
        """Return both."""
        return _Boxes(
            np.concatenate([self.middle, other.middle]),
            np.concatenate([self.half, other.half]),
            np.concatenate([self.bound, other.bound]),
        )

    def highest(self) -> tuple["_Boxes", "_Boxes"]:
        """Return those with the highest bounds, and the others."""
        if len(self.bound) <= AT_ONCE:
            return self, self.take(np.zeros(0, dtype=int))
        order = np.argpartition(self.bound, -AT_ONCE)
        return self.take(order[-AT_ONCE:]), self.take(order[:-AT_ONCE])


def enclosed(
    objective: Objective, free: npt.NDArray[np.bool_], q: Array, enough: Callable[[float], float], seconds: float
) -> Enclosure:
    """Return the largest value between two numbers.

    The box with the highest bound is halved across the side that has most to do with it, until no box has a bound that
    is more than enough. In a box where F only rises, or only falls, along a side, an end of that side counts alone.

    Args:
        objective: F.
        free: (n,) the coordinates on which it depends.
        q: (n,) a good configuration.
        enough: the bound at which a box is not halved, of the largest value found.
        seconds: after which the search ends as it stands.
    """
    chain, end = objective.chain, monotonic() + seconds
    best, settled, count = float(objective.value(q[None])[0]), -np.inf, 0
    new = _Boxes(
        np.where(free, (chain.lower + chain.upper) / 2, q)[None],
        np.where(free, (chain.upper - chain.lower) / 2, 0.0)[None],
        np.array([np.inf]),
    )
    waiting = new.take(np.zeros(0, dtype=int))
    while len(new.bound):
        found = objective.bounds(new.middle, new.half)
        count += len(new.bound)
        top = int(np.argmax(found.value))
        if found.value[top] > best:
            best, q = _climbed(objective, new.middle[top])
        new.bound = np.minimum(new.bound, found.bound + ROUNDING * np.abs(found.bound))
        divided = (new.bound > enough(best)) & new.half.any(axis=1)
        settled = max(settled, float(new.bound[~divided].max(initial=-np.inf)))
        waiting = waiting.with_others(_halved(new.take(divided), found.slope[divided], found.spread[divided]))
        if monotonic() > end or len(waiting.bound) > MOST:
            settled = max(settled, float(waiting.bound.max(initial=-np.inf)))
            break
        new, waiting = waiting.highest()
    return Enclosure(max(settled, best), best, q, count)


def _halved(boxes: _Boxes, slope: Array, spread: Array) -> _Boxes:
    """Return both halves of boxes; sides along which F is monotonic shrink to one end."""
    sure = slope != 0
    middle = np.where(sure, boxes.middle + np.sign(slope) * boxes.half, boxes.middle)
    half = np.where(sure, 0.0, boxes.half)
    across = np.argmax(np.where(half > 0, spread, -1.0), axis=1)
    k = np.arange(len(half))
    step = np.zeros_like(half)
    half[k, across] /= 2
    step[k, across] = half[k, across]
    return _Boxes(np.concatenate([middle - step, middle + step]), np.concatenate([half, half]), np.tile(boxes.bound, 2))


def _climbed(objective: Objective, q: Array) -> tuple[float, Array]:
    """Return the value and the configuration to which a climb from q leads."""
    _, ends = ends_of(objective.chain, objective.measure, q[None], largest=objective.sign > 0)
    values = objective.value(np.vstack([q, ends]))
    best = int(np.argmax(values))
    return float(values[best]), (q, ends[0])[best]
