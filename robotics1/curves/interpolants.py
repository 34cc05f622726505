"""Functions of one variable, smooth between known breaks, by Chebyshev interpolants that have converged.

A smooth function is its interpolant to rounding once the last coefficients are as small as rounding. Its integral,
its roots and its extremes are then those of polynomials: nothing is sampled, and nothing is missed between samples.

Source: Trefethen, Approximation Theory and Approximation Practice, 2013, chapters 3, 4 and 18.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.polynomial import Chebyshev, chebyshev

from robotics1.inputs import Array

DEGREES = (16, 64)  # tried in turn; then the interval is halved
CONVERGED = 1e-13  # the last coefficients, relative to the largest value of the function
PLATEAU = 1e4  # times that: coefficients that no longer fall below it are the rounding of the function's own values
SPLITS = 8  # times an interval is halved; 64 coefficients on 1/256 of it resolve all but noise
SAME = 1e-12  # relative: two values so near are equal, and the first counts

Function = Callable[[Array], Array]


@dataclass(frozen=True)
class Extreme:
    """An extreme value of a function, and the first place where it is taken.

    Attributes:
        value: the function there, with its sign; of a norm never negative.
        time: where; of a motion [s].
        joint: the number of the coordinate, from 0; None for a norm.
        resolved: whether the interpolants behind it have converged, so that no larger value is missed.
    """

    value: float
    time: float
    joint: int | None = None
    resolved: bool = True


def interpolants(f: Function, ends: Iterable[float], *, floor: float = 0.0) -> tuple[list[Chebyshev], bool]:
    """Return polynomials equal to f on the pieces of its domain, and whether all have converged.

    Args:
        f: (k,) → (k,), smooth inside each of the intervals; it is not called at their ends.
        ends: the ends of the intervals, ascending.
        floor: what is as small as this is rounding.
    """
    intervals = [(a, b) for a, b in pairwise(ends) if b > a]
    nodes = (1 + chebyshev.chebpts1(DEGREES[0])) / 2
    sizes = [np.abs(f(a + (b - a) * nodes)).max() for a, b in intervals]
    noise = max(CONVERGED * max(sizes, default=0.0), floor)
    found = [_resolve(f, a, b, noise, SPLITS) for a, b in intervals]
    return [piece for pieces, _ in found for piece in pieces], all(converged for _, converged in found)


def largest(f: Callable[..., Array], ends: Iterable[float], *, floor: float = 0.0) -> Extreme:
    """Return where f(x, side="right" or "left") is largest: at the ends of pieces, or where its derivative vanishes."""
    ends = [float(end) for end in ends]
    pieces, resolved = interpolants(lambda x: f(x, side="right"), ends, floor=floor)
    places = [("right", ends[0]), ("left", ends[-1])]
    for piece in pieces:
        a, b = piece.domain
        places += [("right", float(a)), *(("right", x) for x in roots(piece.deriv())), ("left", float(b))]
    places.sort(key=lambda place: place[1])
    values = np.array([float(f(np.array([x]), side=side)[0]) for side, x in places])
    first = _first_largest(values)
    return Extreme(float(values[first]), places[first][1], resolved=resolved)


def minimum_and_maximum(t: Array, x: Array) -> Array:
    """Return where the values x (k,) of the ascending t are least and largest, (2,), and these values, (2,)."""
    return np.array([t, x])[:, [_first_largest(-x), _first_largest(x)]]


def _first_largest(values: Array) -> int:
    return int(np.argmax(values >= values.max() - SAME * np.abs(values).max()))


def roots(piece: Chebyshev) -> list[float]:
    """Return the real roots of a polynomial inside its domain, ascending."""
    size = np.abs(piece.coef).max()
    if size == 0:
        return []
    a, b = piece.domain
    found = Chebyshev(_trimmed(piece.coef, 1e-15 * size), domain=piece.domain).roots()
    real = [float(z.real) for z in np.atleast_1d(found) if abs(z.imag) <= 1e-8 * (b - a)]
    return sorted(x for x in real if a <= x <= b)


def _resolve(f: Function, a: float, b: float, noise: float, splits: int) -> tuple[list[Chebyshev], bool]:
    middle, half = (a + b) / 2, (b - a) / 2
    c: Any = None
    tail = np.inf
    for degree in DEGREES:
        c = chebyshev.chebinterpolate(lambda x: f(middle + half * x), degree)
        tail, before = (np.abs(part).max() for part in (c[-degree // 4 :], c[-degree // 2 : -degree // 4]))
        flat = degree == DEGREES[-1] and before / 10 <= tail <= PLATEAU * noise
        if tail <= noise or flat:
            return [Chebyshev(_trimmed(c, max(noise / 10, tail * flat)), domain=[a, b])], True
    if splits == 0:
        return [Chebyshev(c, domain=[a, b])], bool(tail <= PLATEAU * noise)
    left, right = (_resolve(f, *half, noise, splits - 1) for half in ((a, middle), (middle, b)))
    return left[0] + right[0], left[1] and right[1]


def _trimmed(c: Any, tolerance: float) -> Array:
    return np.asarray(chebyshev.chebtrim(c, tolerance), dtype=float)
