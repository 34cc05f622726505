"""When a law takes a value: t(s), the inverse of s(t)."""

from typing import Any

import numpy as np

from robotics1.curves.given import as_law
from robotics1.curves.interpolants import interpolants
from robotics1.errors import InputError
from robotics1.inputs import Array, real_number

NEAR = 1e-9  # of the largest |s|: what counts as the value
FLAT = 1e-3  # of an interval: how far beside an end a multiple root is found
REAL = 1e-6  # the imaginary part of a root, in units of its interval, that is rounding


def time_of(law: Any, value: float, *, after: float = 0.0) -> float:
    """Return the first instant t ≥ `after` at which a timing law takes a value, s(t) = value.

    The law is replaced by interpolants that agree with it to rounding, and its instants are their roots.

    Args:
        law: s(t), or the motion of one joint; `trajectory.joint(i)` is that of one of several.
        value: of s.
        after: where the search begins [s].

    Raises:
        InputError: the law never takes the value then, or it is no timing law.
    """
    s = as_law("law", law)
    wanted, begin = real_number("value", value), real_number("after", after)
    instants = _instants(s, wanted)
    slack = 1e-12 * max(s.end, 1e-300)
    found = instants[instants >= begin - slack]
    if not len(found):
        (_, _), (low, high) = s.extremes(0)
        later = f" after t = {begin:g}" if begin > 0 else ""
        raise InputError(f"the law never takes the value {wanted:g}{later}; it is between {low:g} and {high:g}")
    return float(max(found[0], 0.0))


def _instants(s: Any, value: float) -> Array:
    """Return the instants at which s(t) = value, ascending."""
    if s.end == 0:
        return np.zeros(1) if abs(float(s(0.0)) - value) <= NEAR * max(1.0, abs(value)) else np.empty(0)
    pieces, _ = interpolants(lambda t: np.asarray(s(t)), s.ends)
    found: list[float] = []
    size = max([abs(value), *(np.abs(piece.coef).max() for piece in pieces)])
    for piece in pieces:
        a, b = piece.domain
        shifted, tolerance = piece - value, 1e-12 * max(size, 1e-300)
        crossings, turns = shifted.roots(), shifted.deriv().roots()
        at_rest = [t for t in (a, b) if abs(shifted(t)) <= tolerance]
        touches = [t for roots in (crossings, turns) for t in _real(roots, a, b, REAL) if abs(shifted(t)) <= tolerance]
        inside = [
            t
            for t in (*_real(crossings, a, b, 1e-12), *touches)
            if not any(abs(t - e) <= FLAT * (b - a) and abs(shifted((t + e) / 2)) <= tolerance for e in at_rest)
        ]  # at an end with rest the roots are multiple, and the end is exact
        found += [*at_rest, *inside]
    return np.array(sorted(found))


def _real(roots: Any, a: float, b: float, imaginary: float) -> list[float]:
    """Return the real parts in [a, b] of the roots with an imaginary part that is rounding."""
    real = roots[np.abs(np.imag(roots)) <= imaginary * (b - a)].real
    return list(map(float, real[(real >= a) & (real <= b)]))
