"""Numbers of a file, as the exact ones that are meant."""

from fractions import Fraction

import numpy as np

CLEAN = 1e-5  # an angle this near to a multiple of π/12 is meant to be it: files write 1.5708 for π/2 [rad]
SHORT = 1000  # a length within 1e-12 of a fraction with a denominator up to this is that fraction


def exact_length(value: float) -> Fraction:
    """Return a length [m] as a short fraction where it is one, else as its decimal digits."""
    short = Fraction(value).limit_denominator(SHORT)
    return short if abs(float(short) - value) <= 1e-12 else Fraction(repr(float(value)))


def exact_turn(angle: float) -> int | None:
    """Return k when the angle is k π/12 to 1e-5, else None [rad]."""
    k = round(angle * 12 / np.pi)
    return k if abs(k * np.pi / 12 - angle) <= CLEAN else None
