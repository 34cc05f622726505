"""The boundary of what three joints reach where the first one has limits: walls at its ends, and swept curves."""

from dataclasses import dataclass

import numpy as np

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.curved.base_range import BaseRange, Candidate
from robotics1.workspaces.curved.end_walls import EndWalls
from robotics1.workspaces.curved.swept_curves import SweptCurves


@dataclass(frozen=True, eq=False)
class LimitedBoundary:
    """Where the boundary is, for a first joint with a range; lengths are shares of the arm's size."""

    range: BaseRange

    def distance(self, local: Array) -> float:
        """Return the distance of a point (3,) of the section's frame from the boundary."""
        best = np.inf
        for candidate in sorted(self._candidates(local), key=lambda one: one.least):
            if candidate.least >= best:
                break
            best = min(best, candidate.follow(best))
        return best

    def clearance(self, local: Array) -> float:
        """Return a length that the distance of a point (3,) is not below, but for what the grid does not show."""
        return max(0.0, min(self._walls.clearance(local), self._curves.clearance(local)))

    def _candidates(self, local: Array) -> list[Candidate]:
        return [*self._walls.candidates(local), *self._curves.candidates(local)]

    @cached_property
    def _walls(self) -> EndWalls:
        return EndWalls(self.range)

    @cached_property
    def _curves(self) -> SweptCurves:
        return SweptCurves(self.range)
