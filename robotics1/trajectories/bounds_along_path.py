"""From bounds on the motion of a point to bounds on the law that moves it along a path."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_path
from robotics1.curves.interpolants import largest
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array, positive_number

ROUNDING = 1e-13  # relative to A: what is left of a bound that vanishes


@dataclass(frozen=True)
class TimingBounds:
    """Bounds of s(t) with which |ṗ| ≤ V and |p̈| ≤ A hold all along a path.

    Attributes:
        velocity: the largest ṡ.
        acceleration: the largest |s̈|, at any ṡ up to that.
        fastest_at: the parameter where |p'| is largest and so bounds ṡ.
        tightest_at: the parameter where s̈ is bounded.
    """

    velocity: float
    acceleration: float
    fastest_at: float
    tightest_at: float


def timing_bounds(
    path: Curve,
    velocity: float | None = None,
    acceleration: float | None = None,
    *,
    tangential: float | None = None,
    normal: float | None = None,
) -> TimingBounds:
    """Return the largest ṡ and s̈ with |ṗ| ≤ V and |p̈| ≤ A wherever on the path they are used together.

    ṡ ≤ V/max |p'|. At that ṡ, |p' s̈ + p'' ṡ²| ≤ A bounds s̈ at each s, for both signs of s̈:
    |s̈| ≤ (√(A²g − (|p''|²g − c²) ṡ⁴) − |c| ṡ²)/g with g = |p'|², c = p'·p''. By the arc length it is √(A² − κ²V⁴).
    In place of A, the tangential and the normal part may have bounds of their own: ṡ² √(|p''|² − c²/g) ≤ A_n, by the
    arc length κ ṡ² ≤ A_n, bounds ṡ, and |s̈| ≤ (A_t √g − |c| ṡ²)/g, by the arc length A_t.

    A law made of these two bounds may be slower than one that knows where the path bends.

    Args:
        path: in the plane, in space, or of joints.
        velocity: V [m/s], positive; it may be left out where the normal acceleration is bounded.
        acceleration: A [m/s²], positive, of the whole vector.
        tangential, normal: A_t and A_n [m/s²], positive, both in place of A.

    Raises:
        InputError: the bounds are not A, or A_t and A_n; the normal acceleration κV² alone exceeds A somewhere (the
            message says up to which V it does not); a straight path has no bound on ṡ; or no s̈ is left of A_t.
    """
    path = as_path("path", path)
    if acceleration is None:
        return _of_parts(path, velocity, tangential, normal)
    if tangential is not None or normal is not None:
        raise InputError("give the bound on the whole acceleration, or those on its tangential and normal part")
    V, A = positive_number("velocity", velocity), positive_number("acceleration", acceleration)
    fastest = largest(path.speed, path.ends)
    path.refuse_standstill(np.array([fastest.time]), np.array([fastest.value]))
    v = V / fastest.value
    worst = largest(lambda s, side: _across(path, s, side) ** 2 * v**4, path.ends)
    if worst.value > A**2 * (1 + 1e-12):
        raise InputError(
            f"at the velocity {V:g} the normal acceleration is {np.sqrt(worst.value):.6g} at s = {worst.time:.6g}, "
            f"more than {A:g}: the velocity must be at most {V * np.sqrt(A) / worst.value**0.25:.6g}"
        )

    def bound(s: Array, side: Side, sign: int) -> Array:
        g, c, bend = _products(path, s, side)
        left = A**2 * g - (bend * g - c**2) * v**4
        root = np.sqrt(np.where(left > ROUNDING * A**2 * g, left, 0.0))  # the root of rounding is no smooth function
        return np.asarray((root + sign * c * v**2) / g)

    return _least(path, bound, v, fastest.time, ROUNDING * A / fastest.value)


def _of_parts(path: Curve, velocity: float | None, tangential: float | None, normal: float | None) -> TimingBounds:
    """Return the bounds of ṡ and s̈ under bounds on the tangential and the normal acceleration."""
    if tangential is None or normal is None:
        raise InputError("give acceleration=, or tangential= and normal=")
    At, An = positive_number("tangential", tangential), positive_number("normal", normal)
    sharpest = largest(lambda s, side: _across(path, s, side), path.ends)
    v, at = np.inf, 0.0
    if sharpest.value > ROUNDING * An:
        v, at = float(np.sqrt(An / sharpest.value)), sharpest.time
    if velocity is not None:
        fastest = largest(path.speed, path.ends)
        if positive_number("velocity", velocity) / fastest.value < v:
            v, at = float(velocity) / fastest.value, fastest.time
    if v == np.inf:
        raise InputError("the path is straight, so that the normal acceleration bounds no velocity: give velocity=")

    def bound(s: Array, side: Side, sign: int) -> Array:
        g, c, _ = _products(path, s, side)
        return np.asarray((At * np.sqrt(g) + sign * c * v**2) / g)

    found = _least(path, bound, v, at, ROUNDING * At)
    if found.acceleration <= 0:
        raise InputError(
            f"at s = {found.tightest_at:.6g} ṡ = {v:.6g} alone needs the tangential acceleration {At:g}: lower the "
            "velocity, or make the path one of its arc length, by_arc_length(path)"
        )
    return found


def _least(path: Curve, bound: Any, v: float, fastest_at: float, floor: float) -> TimingBounds:
    """Return the bounds with the least of the bounds on s̈ of both signs."""
    least = [largest(lambda s, side, sign=sign: -bound(s, side, sign), path.ends, floor=floor) for sign in (-1, 1)]
    tightest = max(least, key=lambda found: found.value)
    return TimingBounds(v, -tightest.value + 0.0, fastest_at, tightest.time)


def _across(path: Curve, s: Array, side: Side) -> Array:
    """Return √(|p''|² − c²/g), (k,): the normal acceleration at ṡ = 1."""
    g, c, bend = _products(path, s, side)
    return np.sqrt(np.maximum(bend - c**2 / g, 0.0))


def _products(path: Curve, s: Array, side: Side) -> tuple[Array, Array, Array]:
    """Return p'·p', p'·p'' and p''·p'', (k,) each."""
    d1, d2 = (path.derivative(s, order, side=side) for order in (1, 2))
    path.refuse_standstill(s, np.linalg.norm(d1, axis=1))
    return np.sum(d1 * d1, axis=1), np.sum(d1 * d2, axis=1), np.sum(d2 * d2, axis=1)
