"""The walls at both ends of a first joint's range: the surface p(x, y) that the two joints after it draw.

A point of the surface is on the boundary unless the interval of another solution goes over it. The nearest such point
is looked for on a grid. From the nearest ones a descent inside the limits leads to the least distance; where this is
behind another solution's interval, ever finer grids do.
"""

from dataclasses import dataclass
from functools import partial
from math import ceil, tau

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.curved.base_range import ALIKE, FINER, ROUNDS, BaseRange, Candidate, least_of

CELLS, FEWEST = 72, 24  # of the grid: in a turn, and in any range

Bools = npt.NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class EndWalls:
    """The walls of a range."""

    range: BaseRange

    def candidates(self, local: Array) -> list[Candidate]:
        """Return the parts of the walls that may be the nearest to a point (3,) of the section's frame."""
        q, p, shape = self._grid
        found = []
        for k, end in enumerate((self.range.lower, self.range.upper)):
            point = self._moved(local, end)
            far = np.where(self._open[:, k], np.linalg.norm(p - point, axis=1), np.inf)
            for i in least_of(far, far - self._chords, shape):
                at = self._descended(q[i], point)
                least = float(np.linalg.norm(self.range.section.mapped.point(at[None])[0] - point))
                found.append(Candidate(least, partial(self._followed_on_wall, q[i], at, point, k, least)))
        return found

    def clearance(self, local: Array) -> float:
        """Return what the distances of the open points of the grid, less their chords, are at least."""
        points = [self._moved(local, end) for end in (self.range.lower, self.range.upper)]
        far = np.stack([np.linalg.norm(self._grid[1] - point, axis=1) for point in points], axis=1)
        return float(np.where(self._open, far - self._chords[:, None], np.inf).min())

    @cached_property
    def _grid(self) -> tuple[Array, Array, tuple[int, int]]:
        """The joints' values (k, 2), the points (k, 3), and the numbers of values of each."""
        domain, values = self.range.section.domain, []
        for k in range(2):
            turns = domain.span[k] / tau if domain.revolute[k] else 1.0
            count = max(FEWEST, ceil(CELLS * turns) if domain.revolute[k] else FEWEST)
            values.append(np.linspace(domain.lower[k], domain.upper[k], count + 1))
        q = np.stack(np.meshgrid(*values, indexing="ij"), axis=-1).reshape(-1, 2)
        return q, self.range.section.mapped.point(q), (len(values[0]), len(values[1]))

    @cached_property
    def _chords(self) -> Array:
        """How far the points of the grid are from those beside them, at most: (k,)."""
        _, p, shape = self._grid
        grid, chords = p.reshape(*shape, 3), np.zeros(shape)
        for axis in (0, 1):
            far = np.linalg.norm(np.diff(grid, axis=axis), axis=-1)
            chords = np.maximum(chords, np.pad(far, [(0, int(axis == k)) for k in (0, 1)]))
            chords = np.maximum(chords, np.pad(far, [(int(axis == k), 0) for k in (0, 1)]))
        return np.asarray(chords.ravel())

    @cached_property
    def _open(self) -> Bools:
        """Which points of the grid are on the boundary, with the first joint at its lower and upper limit: (k, 2)."""
        return self._seen(self._grid[0])

    def _seen(self, q: Array) -> Bools:
        """Return at which ends of the range (k, 2) no other solution's interval goes over points of the surface."""
        length, around = self.range.length, self.range.turns
        seen = np.ones((len(q), 2), dtype=bool)
        others = self.range.others(q, self.range.section.mapped.image(q))
        for row, offset in zip(seen, self.range.offsets(q, others), strict=True):
            for k, end in enumerate((0.0, length)):
                within = (end - offset) % tau if around else end - offset
                low, high = (ALIKE, length + ALIKE) if k == 0 else (-ALIKE, length - ALIKE)
                alike = np.abs(np.mod(offset + 1.0, tau) - 1.0) < ALIKE if around else np.abs(offset) < ALIKE
                row[k] = not ((within > low) & (within < high) & ~alike).any()
        return seen

    def _moved(self, local: Array, value: float) -> Array:
        """Return a point (3,) as the two joints see it when the first one is at a value."""
        if not self.range.turns:
            return np.asarray(local - np.array([0.0, 0.0, value]))
        c, s = np.cos(value), np.sin(value)
        return np.array([c * local[0] + s * local[1], c * local[1] - s * local[0], local[2]])

    def _followed_on_wall(self, start: Array, at: Array, point: Array, end: int, least: float, best: float) -> float:
        """Return the least distance on the open part of the surface, near q = `start` that is open."""
        return least if self._seen(at[None])[0, end] else self._closer_on_wall(start, point, end, best)

    def _descended(self, q: Array, point: Array) -> Array:
        """Return where the distance from a point (3,) is least on the surface, down from q (2,)."""
        from scipy.optimize import minimize

        mapped, domain = self.range.section.mapped, self.range.section.domain

        def squared(q: Array) -> tuple[float, Array]:
            at = q[None]
            e = mapped.point(at)[0] - point
            J = np.array([mapped.point(at, order)[0] for order in ((1, 0), (0, 1))])
            return float(e @ e), 2 * J @ e

        low, high = np.where(domain.circular, -np.inf, domain.lower), np.where(domain.circular, np.inf, domain.upper)
        options = {"ftol": 1e-16, "gtol": 1e-12}
        end = minimize(
            squared, q, jac=True, method="L-BFGS-B", bounds=list(zip(low, high, strict=True)), options=options
        )
        return np.asarray(domain.wrapped(end.x))

    def _closer_on_wall(self, q: Array, point: Array, end: int, best: float) -> float:
        """Return the least distance on the open part of the surface, by ever finer grids around q (2,)."""
        domain, shape = self.range.section.domain, self._grid[2]
        step = domain.span / (np.array(shape) - 1) / FINER * 2
        side = np.arange(-FINER, FINER + 1)
        around = np.stack(np.meshgrid(side, side, indexing="ij"), axis=-1).reshape(-1, 2)
        least = np.inf
        for _ in range(ROUNDS):
            near = q + around * step
            near = np.where(domain.circular, near, np.clip(near, domain.lower, domain.upper))
            far = np.linalg.norm(self.range.section.mapped.point(near) - point, axis=1)
            closer = np.flatnonzero(far < least)
            if far.min() >= best:
                break
            seen = closer[self._seen(near[closer])[:, end]] if len(closer) else closer
            if len(seen):
                i = seen[np.argmin(far[seen])]
                q, least = near[i], float(far[i])
            step = step / 2
        return least
