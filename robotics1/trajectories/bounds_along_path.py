"""From bounds on the motion of a point to bounds on the law that moves it along a path."""

from dataclasses import dataclass

import numpy as np

from robotics1.curves.curve import Curve, Side
from robotics1.curves.given import as_path
from robotics1.curves.interpolants import largest
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


def timing_bounds(path: Curve, velocity: float, acceleration: float) -> TimingBounds:
    """Return the largest ṡ and s̈ with |ṗ| ≤ V and |p̈| ≤ A wherever on the path they are used together.

    ṡ ≤ V/max |p'|. At that ṡ, |p' s̈ + p'' ṡ²| ≤ A bounds s̈ at each s, for both signs of s̈:
    |s̈| ≤ (√(A²g − (|p''|²g − c²) ṡ⁴) − |c| ṡ²)/g with g = |p'|², c = p'·p''. By the arc length it is √(A² − κ²V⁴).

    A law made of these two bounds may be slower than one that knows where the path bends.

    Args:
        path: in the plane, in space, or of joints.
        velocity: V [m/s], positive.
        acceleration: A [m/s²], positive.

    Raises:
        InputError: the normal acceleration κV² alone exceeds A somewhere; the message says up to which V it does not.
    """
    path = as_path("path", path)
    V, A = positive_number("velocity", velocity), positive_number("acceleration", acceleration)
    fastest = largest(path.speed, path.ends)
    path.refuse_standstill(np.array([fastest.time]), np.array([fastest.value]))
    v = V / fastest.value

    def normal(s: Array, side: Side) -> Array:
        g, c, bend = _products(path, s, side)
        return np.asarray((bend - c**2 / g) * v**4)  # the square of what is across the path

    worst = largest(normal, path.ends)
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

    floor = ROUNDING * A / fastest.value
    least = [largest(lambda s, side, sign=sign: -bound(s, side, sign), path.ends, floor=floor) for sign in (-1, 1)]
    tightest = max(least, key=lambda found: found.value)
    return TimingBounds(v, -tightest.value + 0.0, fastest.time, tightest.time)


def _products(path: Curve, s: Array, side: Side) -> tuple[Array, Array, Array]:
    """Return p'·p', p'·p'' and p''·p'', (k,) each."""
    d1, d2 = (path.derivative(s, order, side=side) for order in (1, 2))
    path.refuse_standstill(s, np.linalg.norm(d1, axis=1))
    return np.sum(d1 * d1, axis=1), np.sum(d1 * d2, axis=1), np.sum(d2 * d2, axis=1)
