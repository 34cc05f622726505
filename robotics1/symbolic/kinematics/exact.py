"""Numbers of a file, as the exact ones that are meant."""

from fractions import Fraction
from math import isqrt

import numpy as np

from robotics1.inputs import Array

CLEAN = 1e-5  # an angle this near to a multiple of π/12 is meant to be it: files write 1.5708 for π/2 [rad]
FINE = 10**8  # largest denominator of a half-angle tangent that stands for an angle: 1e-16
SHORT = 1000  # a length within 1e-12 of a fraction with a denominator up to this is that fraction


def exact_length(value: float, size: float = 1.0) -> Fraction:
    """Return a length [m] as a short fraction where it is one, else as its decimal digits; what is rounding beside the
    size of the arm [m], or beside 1 m, is left out.
    """
    short = Fraction(value).limit_denominator(SHORT)
    return short if abs(float(short) - value) <= 1e-12 * min(1.0, size) else Fraction(repr(float(value)))


def exact_turn(angle: float, tolerance: float = CLEAN) -> int | None:
    """Return k when the angle is k π/12 to the tolerance, else None [rad]."""
    k = round(angle * 12 / np.pi)
    return k if abs(k * np.pi / 12 - angle) <= tolerance else None


def exact_axis(axis: Array, *, rational: bool = False) -> tuple[tuple[Fraction, ...], int]:
    """Return (v, k) with v √k the unit axis exactly, k = 1, 2, 3 or 6; only 1 where it must be rational.

    An axis along small whole numbers, such as (1, 0, −1), is that; another is the rational point of the unit sphere
    next to it, to 1e-16: the stereographic image of rational coordinates.
    """
    largest = int(np.abs(axis).argmax())
    v = [Fraction(x / abs(axis[largest])).limit_denominator(12) for x in axis]
    length = sum((x * x for x in v), Fraction(0))
    if np.abs(np.array(v, dtype=float) / np.sqrt(float(length)) - axis).max() < 1e-9:
        for k in (1,) if rational else (1, 2, 3, 6):
            root = _rational_root(length * k)
            if root is not None:
                return tuple(x / root for x in v), k
    sign = 1 if axis[largest] > 0 else -1
    plane = [Fraction(x / (1 + abs(axis[largest]))).limit_denominator(FINE) for x in axis]
    plane[largest] = Fraction(0)
    square = sum((x * x for x in plane), Fraction(0))
    point = [2 * x / (1 + square) for x in plane]
    point[largest] = sign * (1 - square) / (1 + square)
    return tuple(point), 1


def _rational_root(x: Fraction) -> Fraction | None:
    p, q = isqrt(x.numerator), isqrt(x.denominator)
    return Fraction(p, q) if p * p == x.numerator and q * q == x.denominator else None
