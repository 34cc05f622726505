"""Curves of one frequency: lines, circles, ellipses, helices, and the motions of one sine."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from robotics1.curves.curve import Curve
from robotics1.curves.interpolants import minimum_and_maximum
from robotics1.curves.named_derivatives import Side
from robotics1.inputs import Array, counting_number, real_number


@dataclass(frozen=True, eq=False)
class HarmonicCurve(Curve):
    """p(s) = c + a cos ωs + b sin ωs + h ωs, 0 ≤ s ≤ end.

    A line has a = b = 0; a circle a ⊥ b of equal length; an ellipse of any length; a helix h normal to both. But for
    the ellipse |p'| is constant, and ω = 1/√(|a|² + |h|²) makes s the arc length.

    Attributes:
        c: (n,) the centre [m]; of a line its start.
        a: (n,) from the centre to where s = 0.
        b: (n,) from the centre to a quarter of a turn later.
        h: (n,) rise per radian; of a line its direction.
        omega: ω, radians per unit of s.
        end: the last s.
        is_unit_speed: whether s is the arc length.
    """

    c: Array
    a: Array
    b: Array
    h: Array
    omega: float
    end: float = 0.0
    is_unit_speed: bool = False

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        for name in ("c", "a", "b", "h"):
            object.__setattr__(self, name, np.array(getattr(self, name), dtype=float))
        super().__post_init__()

    @property
    def shape(self) -> tuple[int, ...]:
        """(n,)."""
        return self.c.shape

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return the parameters and values of each coordinate's minimum and maximum, as every curve does.

        Exact: (a cos u + b sin u + h u)' = R cos(u − α) + h with R² = a² + b² vanishes where u = α ± arccos(−h/R).
        """
        order = counting_number("order", order)
        turn = self.omega * self.end
        times, values = np.empty((2, 2, self.dimension))
        for j in range(self.dimension):
            s = np.array([0.0, *_stationary(self.a[j], self.b[j], self.h[j], order, turn), turn]) / self.omega
            s[-1] = self.end
            times[:, j], values[:, j] = minimum_and_maximum(s, self._derivative(s, order, "right")[:, j])
        return times, values

    def stretched(self, factor: float) -> HarmonicCurve:
        """Return p(s/k).

        Raises:
            InputError: k is not positive.
        """
        k = real_number("factor", factor, positive=True)
        return replace(self, omega=self.omega / k, end=self.end * k, is_unit_speed=self.is_unit_speed and k == 1)

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        u = self.omega * t[:, None]
        quarter = order * np.pi / 2  # each derivative turns the cosine by a quarter
        wave = self.a * np.cos(u + quarter) + self.b * np.sin(u + quarter)
        straight = self.c + self.h * u if order == 0 else self.h if order == 1 else 0.0
        return np.asarray(self.omega**order * wave + straight * (self.omega if order == 1 else 1.0))


def _stationary(a: float, b: float, h: float, order: int, last: float) -> Array:
    """Return the u inside (0, last) at which the derivative of order r + 1 of a cos u + b sin u + h u vanishes."""
    size, rise = np.hypot(a, b), h if order == 0 else 0.0
    if size == 0 or abs(rise) > size:
        return np.empty(0)
    alpha = (np.arctan2(b, a) - (order + 1) * np.pi / 2) % (2 * np.pi)  # size cos(u − α) + rise = 0
    angle = np.arccos(-rise / size)
    turns = 2 * np.pi * np.arange(-1.0, np.ceil(last / (2 * np.pi)) + 1)
    u = np.sort(np.concatenate([alpha + angle + turns, alpha - angle + turns]))
    return np.asarray(u[(u > 0) & (u < last)])
