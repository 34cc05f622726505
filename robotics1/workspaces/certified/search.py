"""The largest value of an objective between two numbers, by whichever bound is near enough first, or is the best.

In this order: the lengths of the links, pivots that promise as much as was found, boxes of configurations, the other
pivots, and the support function.
"""

import itertools
from dataclasses import dataclass, replace
from time import monotonic

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.certified.at_pivots import Pivot, best_pivots
from robotics1.workspaces.certified.branch_and_bound import Enclosure, enclosed
from robotics1.workspaces.certified.extremes import free_coordinates
from robotics1.workspaces.certified.objective import Objective
from robotics1.workspaces.certified.support_function import farthest_of, support_function
from robotics1.workspaces.chain import Chain

DEPTH, FEW = 2, 3  # how often an arm is divided at a pivot, and coordinates for which boxes do as well
FINENESS = (16, 32, 64, 128)  # cells of the support function along a side: each takes four times as long


@dataclass(frozen=True, eq=False)
class Search:
    """What is sought, and how exactly.

    Attributes:
        objective: F.
        tolerance: between bound and value [m].
        end: when the search ends as it stands, in seconds of the monotonic clock.
        depth: how often the arm may still be divided at a pivot.
    """

    objective: Objective
    tolerance: float
    end: float
    depth: int = DEPTH

    @property
    def left(self) -> float:
        """The seconds that are left."""
        return self.end - monotonic()

    def enough(self, F: float) -> float:
        """Return the bound that is near enough to a value of F."""
        objective = self.objective
        return objective.wanted(objective.meant(F) + objective.sign * self.tolerance)

    def run(self, value: float, q: Array) -> tuple[Enclosure, str]:
        """Return bounds on the objective, and whence they are.

        Args:
            value: the best distance or coordinate that was found.
            q: (n,) where.
        """
        objective = self.objective
        own, limit = float(objective.value(q[None])[0]), self._limit()
        if abs(limit - value) <= self.tolerance:
            return Enclosure(objective.wanted(limit), own, q, 0), "lengths"
        free = free_coordinates(objective.chain, objective.measure)
        divided = bool(self.depth) and np.count_nonzero(free) > FEW
        near = value + objective.sign * self.tolerance / 2
        pivots = best_pivots(objective, near, monotonic() + self.left / 2) if divided else []
        boxes = 0
        for pivot in pivots:
            if abs(pivot.hoped - value) <= self.tolerance / 2:
                bound, more = self._at_pivot(pivot)
                boxes += more
                if bound <= self.enough(own):
                    return Enclosure(max(bound, own), own, q, boxes), "pivots"
        everywhere = objective.measure.direction is not None or objective.sign > 0
        found = enclosed(objective, free, q, self.enough, self.left / 2 if everywhere or pivots else self.left)
        bounds = {"boxes": found.bound}
        if found.bound > self.enough(found.value):
            better = [pivot for pivot in pivots if self.objective.wanted(pivot.hoped) < found.bound]
            tried = [self._at_pivot(pivot) for pivot in better]
            boxes += sum(more for _, more in tried)
            bounds["pivots"] = min((bound for bound, _ in tried), default=np.inf)
        if everywhere and min(bounds.values()) > self.enough(found.value):
            first = int(np.argmax(objective.chain.A @ free != 0))
            bounds["support function"] = self._by_support(first, self.enough(found.value))
            bounds["lengths"] = objective.wanted(limit)
        least = min(bounds, key=lambda name: bounds[name])
        return replace(found, bound=max(bounds[least], found.value), boxes=found.boxes + boxes), least

    def _limit(self) -> float:
        """Return what the lengths of the links allow at most, or at least; infinite where they say nothing."""
        measure, sign = self.objective.measure, self.objective.sign
        if measure.direction is not None:
            return sign * np.inf
        return _longest(self.objective.chain, measure.centre) if sign > 0 else 0.0

    def _at_pivot(self, pivot: Pivot) -> tuple[float, int]:
        """Return what the objective is at most, by the extremes of both parts of the arm, and the boxes looked at."""
        half, boxes = self.left / 2, []

        def prove(part: Objective, value: float, q: Array) -> float:
            found, _ = Search(part, self.tolerance / 4, monotonic() + half / 2, self.depth - 1).run(value, q)
            boxes.append(found.boxes)
            return part.meant(found.bound)

        return self.objective.wanted(pivot.bound(prove)), sum(boxes)

    def _by_support(self, first: int, enough: float) -> float:
        """Return what the objective is at most, by the support function of the joints from the first one on.

        Its grid is made finer as long as there is time, and the bound is more than enough.
        """
        objective, least = self.objective, np.inf
        measure = objective.measure
        kept = np.linalg.svd(measure.P)
        rows = kept.Vh[kept.S > 0.5]
        for cells in FINENESS:
            h = support_function(objective.chain, first, cells, self.left) if least > enough else None
            if h is None:
                break
            if measure.direction is not None:
                n = objective.sign * measure.direction
                least = min(least, float(h(n[None])[0] - n @ measure.centre))
            else:
                least = min(least, objective.wanted(farthest_of(h, measure.centre, rows, cells)))
        return least


def _longest(chain: Chain, centre: Array) -> float:
    """Return the length of the way from a point along the joints to the tip, with all slides at their ends."""
    axes = chain.axes
    places = [centre, *(axis.point for axis in axes if axis.revolute), chain.tip]
    most = np.abs(chain.A) @ np.maximum(np.abs(chain.lower), np.abs(chain.upper))
    slides = sum(float(length) for length, axis in zip(most, axes, strict=True) if not axis.revolute)
    return slides + sum(float(np.linalg.norm(b - a)) for a, b in itertools.pairwise(places))
