"""Paths made of polynomials: parabolic blends, and splines through points."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, one_of
from robotics1.paths.course import piece_at
from robotics1.paths.path import Path
from robotics1.paths.points import point, steps_between

END_KINDS = ("natural", "not-a-knot", "clamped", "periodic")


@dataclass(frozen=True, eq=False)
class PolynomialPath(Path):
    """p(s) = Σₖ cₖ (s − sᵢ)ᵏ between the knots sᵢ and sᵢ₊₁; s is not the arc length.

    Attributes:
        coefficients: (degree + 1, m, n) the cₖ of the m pieces, ascending.
        knots: (m + 1,) the sᵢ, from 0 to the end.
    """

    coefficients: Array
    knots: Array

    @property
    def end(self) -> float:
        """The last knot."""
        return float(self.knots[-1])

    @property
    def dimension(self) -> int:
        """The number of coordinates, n."""
        return int(self.coefficients.shape[2])

    @property
    def breaks(self) -> Array:
        """The inner knots."""
        return self.knots[1:-1]

    def _derivative(self, s: Array, order: int, side: str) -> Array:
        from numpy.polynomial import polynomial

        i = piece_at(self.knots[:-1], s, side)
        degree = len(self.coefficients) - 1
        c = polynomial.polyder(self.coefficients, order) if order <= degree else 0 * self.coefficients[:1]
        return np.asarray(polynomial.polyval((s - self.knots[i])[:, None], c[:, i], tensor=False))


def spline_path(
    points: npt.ArrayLike,
    *,
    knots: str | npt.ArrayLike = "chord",
    ends: str = "natural",
    start_tangent: npt.ArrayLike | None = None,
    end_tangent: npt.ArrayLike | None = None,
    start_second: npt.ArrayLike | None = None,
    end_second: npt.ArrayLike | None = None,
) -> PolynomialPath:
    """Return the cubic spline p(s) through the points: p, p' and p'' are continuous.

    s is near the arc length when the knots are those of the chords; `by_arc_length` makes it the arc length.

    Args:
        points: (m, n) in order, Cartesian [m] or joint values.
        knots: "chord" (sᵢ₊₁ − sᵢ = |pᵢ₊₁ − pᵢ|), "centripetal" (its root), "uniform" (1), or (m,) numbers from 0.
        ends: "natural" (p'' = 0), "not-a-knot" (p''' continuous at the first and last inner knot), "clamped" (p' = 0),
            or "periodic" (closed, p' and p'' continuous there too).
        start_tangent, end_tangent: (n,) p' there, in place of the condition that `ends` makes there.
        start_second, end_second: (n,) p'' there instead. With the law s = t these are velocities and accelerations.

    Raises:
        InputError: p' and p'' are both given at one end (`mixed_spline(...).as_path()` takes both), consecutive points
            are the same, knots do not ascend, or a periodic spline is not closed.

    Source: de Boor, A Practical Guide to Splines, 1978, chapter IV.
    """
    from scipy.interpolate import CubicSpline

    points = point("points", points, (None, None), "one point a row")
    steps = steps_between(points)
    parameters = _knots(knots, steps)
    one_of("ends", ends, END_KINDS)
    if ends == "periodic":
        if any(given is not None for given in (start_tangent, end_tangent, start_second, end_second)):
            raise InputError("a periodic spline has no ends, so no tangent and no p'' can be asked of them")
        if np.linalg.norm(points[-1] - points[0]) > 1e-9 * steps.sum():
            raise InputError("a periodic spline must end where it begins: repeat the first point as the last")
        condition: Any = "periodic"
        points[-1] = points[0]
    else:
        given = (("start", start_tangent, start_second), ("end", end_tangent, end_second))
        condition = tuple(_end(where, p1, p2, points.shape[1]) or ends for where, p1, p2 in given)
    spline = CubicSpline(parameters, points, bc_type=condition)
    return PolynomialPath(spline.c[::-1], parameters)


def _end(where: str, tangent: npt.ArrayLike | None, second: npt.ArrayLike | None, n: int) -> tuple[int, Array] | None:
    """Return which derivative is given at an end, and its value."""
    if tangent is not None and second is not None:
        raise InputError(
            f"{where}_tangent and {where}_second are one condition too many for a cubic; mixed_spline(...).as_path() "
            "with the degree 4 at the ends takes both"
        )
    order, name, value = (1, "tangent", tangent) if second is None else (2, "second", second)
    return None if value is None else (order, point(f"{where}_{name}", value, (n,), "a vector like the points"))


def _knots(knots: str | npt.ArrayLike, steps: Array) -> Array:
    if isinstance(knots, str):
        exponents = {"chord": 1.0, "centripetal": 0.5, "uniform": 0.0}
        if knots not in exponents:
            raise InputError(f"knots must be 'chord', 'centripetal', 'uniform' or numbers; it is {knots!r}")
        return np.concatenate([[0.0], np.cumsum(steps ** exponents[knots])])
    given = point("knots", knots, (len(steps) + 1,), "one for each point")
    if given[0] != 0 or (np.diff(given) <= 1e-12 * given[-1]).any():
        raise InputError(f"knots must ascend from 0; they are {given.tolist()}")
    return given
