"""A path p(s) in Rⁿ: Cartesian points, or joint values."""

from abc import abstractmethod
from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.paths.course import Course
from robotics1.paths.interpolants import Largest, interpolants, largest

STANDSTILL = 1e-12  # |p'| relative to the length over the end: slower is no motion


class Path(Course):
    """p(s) ∈ Rⁿ, 0 ≤ s ≤ end: (n,) for a number, (k, n) for (k,) parameters; with p', p'', p''' and more.

    Where `is_unit_speed` is true, s is the arc length: |p'| = 1 and end is the length.
    """

    @property
    @abstractmethod
    def dimension(self) -> int:
        """The number of coordinates, n."""

    @property
    def is_unit_speed(self) -> bool:
        """Whether s is the arc length."""
        return False

    @cached_property
    def length(self) -> float:
        """∫ |p'| ds, the arc length."""
        if self.is_unit_speed:
            return self.end
        pieces, _ = interpolants(self.rate, self.ends)
        return float(sum(piece.integ(lbnd=piece.domain[0])(piece.domain[1]) for piece in pieces))

    def curvature(self, s: npt.ArrayLike, *, side: str = "right") -> Any:
        """Return κ = |p'' − (p''·t) t| / |p'|², with the tangent t = p'/|p'|: 1/m of a Cartesian path.

        Raises:
            InputError: the path has no tangent there, p' = 0.
        """
        parameters, alone = self._parameters(s, side)
        d1, d2 = (self._derivative(parameters, order, side) for order in (1, 2))
        speed = np.linalg.norm(d1, axis=1)
        self.refuse_standstill(parameters, speed)
        bend = across(d2, d1 / speed[:, None])
        kappa = np.linalg.norm(bend, axis=1) / speed**2
        return float(kappa[0]) if alone else kappa

    @property
    def ends(self) -> list[float]:
        """0, the breaks, and the end."""
        return [0.0, *self.breaks.tolist(), self.end]

    def rate(self, s: Array, *, side: str = "right") -> Array:
        """Return |p'(s)|, (k,)."""
        return np.asarray(np.linalg.norm(self._derivative(s, 1, side), axis=1))

    def largest(self, f: Callable[..., Array], *, floor: float = 0.0) -> Largest:
        """Return where f(s, side=) of s (k,) is largest along the path; what is as small as `floor` is rounding."""
        return largest(f, self.ends, floor=floor)

    def refuse_standstill(self, s: Array, speed: Array) -> None:
        """Raise InputError where |p'| vanishes."""
        still = speed <= STANDSTILL * self.length / self.end
        if still.any():
            raise InputError(f"the path has no tangent at s = {s[still][0]:.6g}: p' vanishes there")

    def _value(self, s: Array, side: str) -> Array:
        return self._derivative(s, 0, side)


def across(v: Array, unit: Array) -> Array:
    """Return the part of v normal to a unit vector, row by row: v − (v·u) u, (k, n)."""
    return np.asarray(v - np.sum(v * unit, axis=1, keepdims=True) * unit)
