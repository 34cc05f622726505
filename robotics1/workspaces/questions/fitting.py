"""The largest circle that fits into the section of a workspace.

Source: the pole of inaccessibility; Garcia-Castellanos and Lombardo, Scottish Geographical Journal 123, 2007. Here
cells are halved where they may hold a better centre: the distance changes at most as fast as the place.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array, real_number
from robotics1.results import Frozen
from robotics1.workspaces.result import Workspace, check_workspace

MOST_CELLS = 4000


@dataclass(frozen=True, eq=False)
class FittingCircle(Frozen):
    """A circle in the section; of an arm that turns fully about its first axis it is the section of a ball.

    Attributes:
        center: (2,) in the section's coordinates [m].
        radius: [m].
        bound: no circle that fits has a radius above it [m].
        coordinates: the names of the section's coordinates.
    """

    center: Array
    radius: float
    bound: float
    coordinates: tuple[str, str]

    def explain(self) -> str:
        """Return the circle in a sentence."""
        x, y = self.center
        return (
            f"A circle of radius {self.radius:.6g} m about ({', '.join(self.coordinates)}) = ({x:.6g}, {y:.6g}) m "
            f"fits; none with a radius above {self.bound:.6g} m does."
        )


def largest_circle(ws: Workspace, *, tolerance: float = 1e-3) -> FittingCircle:
    """Return the largest circle inside the section, max over z of the distance from the boundary.

    Args:
        ws: what `workspace(robot, task)` returns.
        tolerance: of the radius, as a share of the largest possible one.

    Raises:
        InputError: ws is no workspace, or the tolerance is not between 0 and 1.
    """
    check_workspace(ws)
    if not 0 < real_number("tolerance", tolerance) < 1:
        raise InputError(f"tolerance must be between 0 and 1, not {tolerance!r}")
    search = _Search(ws)
    while search.cells and len(search.cells) < MOST_CELLS and search.bound > (1 + tolerance) * search.best:
        search.halve()
    return FittingCircle(search.centre, search.best, max(search.bound, search.best), ws.coordinates)


class _Search:
    """Cells by the largest radius that a circle with its centre in them may have."""

    def __init__(self, ws: Workspace) -> None:
        self.section = ws.section
        self.cells: list[tuple[float, float, float, float]] = []
        ends = np.vstack([line for region in ws.regions for line in region.outline])
        low, high = ends.min(axis=0), ends.max(axis=0)
        self.best, self.centre = 0.0, (low + high) / 2
        half = max(float((high - low).min()), 0.02 * float((high - low).max())) / 2
        for x in np.arange(low[0] + half, high[0] + half, 2 * half):
            for y in np.arange(low[1] + half, high[1] + half, 2 * half):
                self.add(float(x), float(y), half)
        for region in ws.regions:
            self.add(float(region.point[0]), float(region.point[1]), 0.0)

    @property
    def bound(self) -> float:
        """No circle is larger."""
        return -self.cells[0][0]

    def add(self, x: float, y: float, half: float) -> None:
        """Put a square cell into the queue."""
        depth = self.section.depth(np.array([x, y]))
        if depth > self.best:
            self.best, self.centre = depth, np.array([x, y])
        heapq.heappush(self.cells, (-(depth + half * 2**0.5), x, y, half))

    def halve(self) -> None:
        """Replace the most hopeful cell by its quarters."""
        _, x, y, half = heapq.heappop(self.cells)
        for i, j in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
            self.add(x + i * half / 2, y + j * half / 2, half / 2)
