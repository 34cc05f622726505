"""What a first joint with limits makes of a section: each solution of the two joints after it becomes an interval.

At a place of the section a solution leads to an interval of the first joint's coordinate w, an angle or a height; what
is reached there is the union of these.
"""

from collections.abc import Callable
from dataclasses import dataclass
from math import tau
from typing import TYPE_CHECKING

import numpy as np

from robotics1.inputs import Array

if TYPE_CHECKING:
    from robotics1.workspaces.curved.curved_section import CurvedSection

SAME = 1e-6  # of solutions that are one
ALIKE = 1e-9  # of ends of intervals, and of distances
FINER, ROUNDS = 4, 30  # samples to each side of the best one, and how often their step is halved


@dataclass(frozen=True)
class Candidate:
    """A part of the boundary.

    Attributes:
        least: how near it is at least, and is where nothing goes over it.
        follow: what returns how near it is; infinite, or more than is right, if no nearer than the best one so far.
    """

    least: float
    follow: Callable[[float], float]


@dataclass(frozen=True, eq=False)
class BaseRange:
    """A section, and the limits of the joint before it [rad or sizes]; lengths are shares of the arm's size."""

    section: "CurvedSection"
    lower: float
    upper: float

    @property
    def length(self) -> float:
        """The length of the range."""
        return self.upper - self.lower

    @property
    def turns(self) -> bool:
        """Whether the joint turns the section, or else slides it."""
        return self.section.mapped.about_axis

    def coordinate(self, p: Array) -> Array:
        """Return w (k,) of points (k, 3): what the first joint adds to."""
        return np.arctan2(p[:, 1], p[:, 0]) if self.section.mapped.about_axis else p[:, 2]

    def whole(self, q: Array) -> Array:
        """Return the intervals of w (k, 2) to which the first joint leads the solutions q (k, 2)."""
        own = self.coordinate(self.section.mapped.point(q))
        return np.column_stack([own + self.lower, own + self.upper])

    def others(self, q: Array, z: Array) -> list[Array]:
        """Return the solutions (n, 2) at z (k, 2) without those of q (k, 2)."""
        section, found = self.section, []
        for one, all_of in zip(q, section.solutions_each(z, section.counts(z)), strict=True):
            found.append(all_of[np.abs(section.domain.difference(all_of, one)).max(axis=1) > SAME])
        return found

    def offsets(self, q: Array, others: list[Array]) -> list[Array]:
        """Return w (n,) of other solutions, less that of q (k, 2)."""
        own = self.coordinate(self.section.mapped.point(q))
        offsets = [self.coordinate(self.section.mapped.point(o)) - w for w, o in zip(own, others, strict=True)]
        return [offset % tau for offset in offsets] if self.section.mapped.about_axis else offsets


def least_of(far: Array, promised: Array, shape: tuple[int, int]) -> list[int]:
    """Return the places of local minima on a grid that may lead to the least of all, the most promising first."""
    padded = np.pad(far.reshape(shape), 1, constant_values=np.inf)
    n, m = shape
    around = [padded[i : i + n, j : j + m] for i in range(3) for j in range(3)]
    lowest = np.isfinite(far) & (far <= np.min(around, axis=0).ravel())
    chosen = np.flatnonzero(lowest & (promised < far.min(initial=np.inf)))
    return [int(i) for i in chosen[np.argsort(promised[chosen])]]
