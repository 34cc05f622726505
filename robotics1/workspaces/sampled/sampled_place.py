"""Questions about a point, answered by samples: a point is reached where a configuration is found that reaches it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.chain import Chain
from robotics1.workspaces.placed_section import PlacedSection
from robotics1.workspaces.sampled.sampled_section import SampledSection, descend, sampled_section, shown

CELLS_IN_SPACE = 48  # along the longest side, where the first joint has limits
DRAWN = 40_000  # random configurations from which a point is looked for
WIDER = 2  # cells around reached ones in which a point is looked for
NEAREST = 12  # of them, those whose points are nearest


@dataclass(frozen=True, eq=False)
class SampledPlace(PlacedSection):
    """A sampled section.

    Attributes:
        section: the cells.
        whole: all joints that move the point, in the section's frame.
        seed: of the random configurations.
    """

    section: SampledSection
    whole: Chain
    seed: int

    def contains(self, p: npt.ArrayLike) -> bool:
        """Return whether a configuration was found that reaches a point (m,)."""
        return bool(self.reaches(self.place.local(p)[None])[0])

    def configurations(self, p: npt.ArrayLike) -> Array:
        """Return the configuration (1, nq) that was found for a point (m,), or (0, nq)."""
        q, found = self._found(self.place.local(p)[None])
        values = np.tile(self.place.neutral, (int(found.sum()), 1))
        values[:, self.whole.numbers] = q[found]
        return values

    def reaches(self, points: Array) -> npt.NDArray[np.bool_]:
        """Return at which points (k, 3) of the section's frame a configuration was found."""
        return self._found(points)[1]

    def _found(self, points: Array) -> tuple[Array, npt.NDArray[np.bool_]]:
        """Return the joints' values (k, n), and at which points (k, 3) they were found."""
        tree, q = self._nearest
        wanted = points[:, : len(self.place.rows)]
        near = np.reshape(tree.query(wanted, NEAREST)[1], (len(points), NEAREST))
        found, possible = np.zeros(len(points), dtype=bool), self._near_reached_cells(points)
        ends = np.zeros((len(points), q.shape[1]))
        for column in near.T:
            left = np.flatnonzero(~found & possible)
            if not len(left):
                break
            ends[left], found[left] = descend(self.whole, False, q[column[left]], wanted[left], self.section.side)
        return ends, found

    def _near_reached_cells(self, points: Array) -> npt.NDArray[np.bool_]:
        """Return which points (k, 3) are at most two cells away from a reached one in the section."""
        section = self.section
        near: Any = self._wide
        z = shown(points, 2, section.about_axis)
        cell = np.floor((z - section.corner) / section.side).astype(int) + WIDER
        within = ((cell >= 0) & (cell < near.shape)).all(axis=1)
        cell = np.where(within[:, None], cell, 0)
        return np.asarray(within & near[tuple(cell.T)])

    @cached_property
    def _wide(self) -> npt.NDArray[Any]:
        from scipy.ndimage import binary_dilation

        return np.asarray(binary_dilation(np.pad(self.section.reached, WIDER), np.ones((3, 3)), iterations=WIDER))

    @cached_property
    def _nearest(self) -> tuple[Any, Array]:
        from scipy.spatial import cKDTree

        q = self.whole.drawn(np.random.default_rng(self.seed), DRAWN)
        return cKDTree(self.whole.point(q)[:, : len(self.place.rows)]), q

    def distance(self, p: npt.ArrayLike) -> float:
        """Return the distance of a point (m,) from the boundary [m], to about the side of a cell."""
        return self._from_boundary(p)[0]

    def clearance(self, p: npt.ArrayLike) -> float:
        """Return a length [m] that the distance is not below: the distance without the side of a cell."""
        far, side = self._from_boundary(p)
        return max(far - side, 0.0)

    def _from_boundary(self, p: npt.ArrayLike) -> tuple[float, float]:
        """Return the distance of a point (m,), and the side of the cells, which bounds its error [m]."""
        local, inside = self.place.local(p), self.contains(p)
        if self.place.limited:
            return _far(self._in_space, local, inside), self._in_space.side
        return _far(self.section, self.place.coordinates(p), inside), self.section.side

    @cached_property
    def _in_space(self) -> SampledSection:
        """Cells in space, for a first joint with limits."""
        return sampled_section(self.whole, False, CELLS_IN_SPACE, self.seed, coordinates=3)

    def contains_each(self, points: Array) -> npt.NDArray[np.bool_]:
        """Return at which points (k, m) a configuration was found."""
        return self.reaches(np.array([self.place.local(p) for p in points]).reshape(-1, 3))

    def _extent(self) -> tuple[Array, tuple[float, float]]:
        own = self.whole.point(self.whole.drawn(np.random.default_rng(self.seed), DRAWN))[:, 2]
        return self.section.middle(np.argwhere(self.section.reached)), (float(own.min()), float(own.max()))

    def depth(self, place: Array) -> float:
        """Return the distance of a place (2,) of the section from its boundary [m]; negative outside."""
        cell = np.floor((place - self.section.corner) / self.section.side).astype(int)
        within = (cell >= 0).all() and (cell < self.section.reached.shape).all()
        inside = bool(within and self.section.reached[tuple(cell)])
        return _far(self.section, place, inside) * (1 if inside else -1)


def _far(section: SampledSection, z: Array, inside: bool) -> float:
    """Return how far a place is from the nearest cell that is not as it is, to about half a side."""
    from scipy.ndimage import maximum_filter

    padded = np.pad(section.reached, 1)
    if section.about_axis and section.corner[0] == 0:
        padded[0] = padded[1]  # the axis is no boundary
    other = np.argwhere(maximum_filter(padded, 3) & ~padded if inside else padded) - 1
    nearest = float(np.linalg.norm(section.middle(other) - z, axis=1).min(initial=np.inf))
    return max(nearest - section.side / 2, 0.0)
