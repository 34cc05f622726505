"""What a first joint with limits, the base, makes of a section: each solution of the other two becomes an interval."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, tau
from typing import TYPE_CHECKING

import numpy as np

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.placed_section import in_section

if TYPE_CHECKING:
    from robotics1.workspaces.curved.curved_section import CurvedSection

SAME = 1e-6  # of solutions that are one
CELLS, FEWEST = 72, 24  # of the grid on a wall: in a turn, and in any range


@dataclass(frozen=True, eq=False)
class BaseRange:
    """A section, and the limits of the base [rad or sizes]; lengths are shares of the arm's size."""

    section: CurvedSection
    lower: float
    upper: float

    @property
    def length(self) -> float:
        """Upper − lower."""
        return self.upper - self.lower

    @property
    def turns(self) -> bool:
        """Whether the base turns the section, or else slides it."""
        return self.section.place.about_axis

    def coordinate(self, q: Array) -> Array:
        """Return w (k,) where the base is at 0, at q (k, 2) of the two joints."""
        p = self.section.arm.mapped.point(q)
        return np.arctan2(p[:, 1], p[:, 0]) if self.turns else p[:, 2]

    @cached_property
    def values_on_walls(self) -> list[Array]:
        """The values of each of the two joints at which the walls are known first."""
        domain, values = self.section.arm.domain, []
        for k in range(2):
            count = max(FEWEST, ceil(CELLS * domain.span[k] / tau)) if domain.revolute[k] else FEWEST
            values.append(np.linspace(domain.lower[k], domain.upper[k], count + 1))
        return values

    @cached_property
    def others_on_walls(self) -> list[Array]:
        """The solutions beside these values, for both walls."""
        return self.others(np.stack(np.meshgrid(*self.values_on_walls, indexing="ij"), axis=-1).reshape(-1, 2))

    def others(self, q: Array) -> list[Array]:
        """Return the other solutions (n, 2) at the places to which q (k, 2) lead."""
        section, domain = self.section, self.section.arm.domain
        z = section.arm.mapped.image(q)
        solved = section.solutions_each(z, section.counts(z))
        far = [np.abs(domain.difference(found, one)).max(axis=1) for one, found in zip(q, solved, strict=True)]
        return [found[apart > SAME] for apart, found in zip(far, solved, strict=True)]

    def offsets(self, q: Array, others: list[Array]) -> list[Array]:
        """Return w (n,) of other solutions, less that of q (k, 2)."""
        offsets = [self.coordinate(o) - w for w, o in zip(self.coordinate(q), others, strict=True)]
        return [offset % tau for offset in offsets] if self.turns else offsets

    def far(self, z: Array, w: Array, local: Array) -> Array:
        """Return how far a point (3,) is from places z (k, 2) with w between two (k, 2), or inf where these are NaN."""
        low, high = w.T
        if self.turns:
            within = (np.arctan2(local[1], local[0]) - low) % tau
            turn = np.where(within <= high - low, 0.0, np.minimum(tau - within, within - (high - low)))
            rho, h = in_section(local, True)
            between = 4 * rho * z[:, 0] * np.sin(turn / 2) ** 2 + (z[:, 0] - rho) ** 2 + (z[:, 1] - h) ** 2
        else:
            beyond = np.maximum(np.maximum(low - local[2], local[2] - high), 0.0)
            between = ((z - local[:2]) ** 2).sum(axis=1) + beyond**2
        return np.asarray(np.where(np.isnan(between), np.inf, np.sqrt(between)))
