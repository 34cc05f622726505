"""The values that two joints may have: a rectangle, a cylinder or a torus, and the grid on which it is looked at."""

from dataclasses import dataclass
from math import ceil, tau

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.curved.level_lines import Grid

INSIDE = 1e-7  # of a range: how far from a limit a sign is taken
OFF_CENTRE = 0.381966  # of a step, so that no grid line lies on a line of symmetry


@dataclass(frozen=True, eq=False)
class Domain:
    """Ranges of two joints.

    Attributes:
        lower, upper: (2,) the limits; of a circular joint they are a turn apart.
        circular: which joints turn without limits.
        revolute: which joints turn.
    """

    lower: Array
    upper: Array
    circular: tuple[bool, bool]
    revolute: tuple[bool, bool]

    @property
    def span(self) -> Array:
        """The lengths of the ranges."""
        return self.upper - self.lower

    def grid(self, cells: int) -> Grid:
        """Return the values of both joints at `cells` a turn, from just inside the limits."""
        x, y = (self._values(k, cells) for k in range(2))
        return x, y

    def _values(self, k: int, cells: int) -> Array:
        count = cells if not self.revolute[k] else max(16, ceil(cells * self.span[k] / tau))
        if self.circular[k]:
            return np.asarray(self.lower[k] + tau * (np.arange(count + 1) - OFF_CENTRE) / count)
        share = np.concatenate([[INSIDE], (np.arange(1, count + 1) - OFF_CENTRE) / count, [1 - INSIDE]])
        return np.asarray(self.lower[k] + share * self.span[k])

    def difference(self, a: Array, b: Array) -> Array:
        """Return a − b, the short way round."""
        d = np.asarray(a - b)
        turns = np.where(self.circular, tau, np.inf)
        return d - np.where(np.isfinite(turns), tau * np.round(d / tau), 0.0)

    def wrapped(self, q: Array) -> Array:
        """Return q with circular joints between their ends."""
        return np.where(self.circular, self.lower + (q - self.lower) % tau, q)

    def holds(self, q: Array, margin: float | Array = 1e-12) -> Array:
        """Return which of q (k, 2) are inside."""
        inside = (q >= self.lower - margin) & (q <= self.upper + margin)
        return np.asarray((inside | np.array(self.circular)).all(axis=-1))
