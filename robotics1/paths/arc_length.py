"""A path by its arc length, and the same path over another range of its parameter."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Chebyshev

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.paths.course import chain_rule
from robotics1.paths.interpolants import interpolants
from robotics1.paths.path import Path
from robotics1.paths.points import size

NEWTON_STEPS = 50  # four are enough where |p'| varies little


@dataclass(frozen=True, eq=False)
class ArcLengthPath(Path):
    """The path p(σ(s)) of another path p(σ), with s = ∫₀^σ |p'| dσ: the unit of s is the length's.

    With g = |p'|²: dσ/ds = g^(−1/2), d²σ/ds² = −g'/(2g²), d³σ/ds³ = (g'² − g g''/2) g^(−7/2).

    Attributes:
        path: the path p(σ).
    """

    path: Path

    @cached_property
    def _pieces(self) -> tuple[list[Chebyshev], Array]:
        """s(σ) on each piece, from 0, and s where the pieces begin and end."""
        pieces, _ = interpolants(self.path.rate, self.path.ends)
        integrals = [piece.integ(lbnd=piece.domain[0]) for piece in pieces]
        steps = [integral(integral.domain[1]) for integral in integrals]
        return integrals, np.concatenate([[0.0], np.cumsum(steps)])

    @property
    def end(self) -> float:
        """The length."""
        return float(self._pieces[1][-1])

    @property
    def dimension(self) -> int:
        """The number of coordinates, n."""
        return self.path.dimension

    @property
    def is_unit_speed(self) -> bool:
        """Yes."""
        return True

    @cached_property
    def breaks(self) -> Array:
        """The breaks of the path, by arc length."""
        integrals, knots = self._pieces
        starts = np.array([integral.domain[0] for integral in integrals])
        return np.array([knots[np.argmin(np.abs(starts - place))] for place in self.path.breaks])

    def parameter(self, s: Array) -> Array:
        """Return σ(s), (k,): by Newton's method on s(σ), kept inside the piece."""
        integrals, knots = self._pieces
        number = np.clip(np.searchsorted(knots, s, side="right") - 1, 0, len(integrals) - 1)
        sigma = np.empty_like(s)
        for i in np.unique(number):
            here = number == i
            integral, (a, b) = integrals[i], integrals[i].domain
            rest = s[here] - knots[i]
            x = a + (b - a) * rest / (knots[i + 1] - knots[i])
            for _ in range(NEWTON_STEPS):
                step = (rest - integral(x)) / np.maximum(integral.deriv()(x), 1e-300)
                x, before = np.clip(x + step, a, b), x
                if np.abs(x - before).max() <= 1e-15 * (b - a):
                    break
            sigma[here] = x
        return sigma

    def _derivative(self, s: Array, order: int, side: str) -> Array:
        sigma = self.parameter(s)
        for place, at in zip(self.path.breaks, self.breaks, strict=True):
            sigma[s == at] = place  # so that the side counts
        if order == 0:
            return self.path.derivative(sigma, 0, side=side)
        if order > 3:
            raise InputError(f"derivatives by arc length are known up to the third; order is {order}")
        p = tuple(self.path.derivative(sigma, k, side=side) for k in range(1, order + 1))
        return chain_rule(self._rates(s, p), p)

    def _rates(self, s: Array, p: tuple[Array, ...]) -> tuple[Array, ...]:
        """Return dσ/ds and its derivatives, up to the order of those of p."""
        g = np.sum(p[0] ** 2, axis=1)
        self.path.refuse_standstill(s, np.sqrt(g))
        rates = [g**-0.5]
        if len(p) > 1:
            g1 = 2 * np.sum(p[0] * p[1], axis=1)
            rates.append(-g1 / (2 * g**2))
        if len(p) > 2:
            g2 = 2 * np.sum(p[1] ** 2 + p[0] * p[2], axis=1)
            rates.append((g1**2 - g * g2 / 2) * g**-3.5)
        return tuple(rates)


def by_arc_length(path: Path) -> Path:
    """Return the same path with s its arc length, so that |dp/ds| = 1; a path that has it already is returned as it is.

    Raises:
        InputError: it is no path.
    """
    if not isinstance(path, Path):
        raise InputError(f"path must be a path, such as line_path(...); it is {path!r}")
    return path if path.is_unit_speed else ArcLengthPath(path)


@dataclass(frozen=True, eq=False)
class StackedPath(Path):
    """Coordinates of several paths one above the other, (n₁ + n₂ + …), passed together: each from its start to its end.

    The k-th path is at s endₖ/end. `StackedPath((path,), 1.0)` is a path over [0, 1].

    Attributes:
        paths: such as that of a position and that of an angle.
        last: the end; by default that of the first path, whose parameter s then is.
    """

    paths: Sequence[Path]
    last: float | None = None

    def __post_init__(self) -> None:
        """Refuse what are no paths."""
        paths = tuple(self.paths) if isinstance(self.paths, Sequence) else ()
        if not paths or not all(isinstance(path, Path) for path in paths):
            raise InputError(f"paths must be one path or several, such as line_path(...); they are {self.paths!r}")
        object.__setattr__(self, "paths", paths)
        if self.last is not None:
            object.__setattr__(self, "last", size("last", self.last))

    @property
    def end(self) -> float:
        """The last s."""
        return self.paths[0].end if self.last is None else self.last

    @property
    def dimension(self) -> int:
        """The sum of the dimensions."""
        return sum(path.dimension for path in self.paths)

    @property
    def breaks(self) -> Array:
        """The breaks of all, in s."""
        return np.unique(np.concatenate([path.breaks * self.end / path.end for path in self.paths]))

    def _derivative(self, s: Array, order: int, side: str) -> Array:
        rates = [path.end / self.end for path in self.paths]
        columns = [
            rate**order * path.derivative(rate * s, order, side=side)
            for path, rate in zip(self.paths, rates, strict=True)
        ]
        return np.hstack(columns)
