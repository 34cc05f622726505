"""How numbers are written: as a person writes them on paper."""

from __future__ import annotations

from collections.abc import Iterable
from fractions import Fraction

import numpy as np
import numpy.typing as npt

DECIMALS = 4
SAME = 1e-7  # m, that nobody reads


def number(value: float, decimals: int = DECIMALS) -> str:
    """Return a number with fixed decimals, an integer without, and never a negative zero."""
    if abs(value - round(value)) < 0.5 * 10.0 ** -(decimals + 2):
        return str(round(value))
    return f"{value:.{decimals}f}"


def length(value: float, size: float = 1.0) -> str:
    """Return a length with four decimals, or with the digits that it has, six at most: 0.4250, 0.39225.

    What is less than 1e-9 of `size`, the largest length beside it, is rounding.
    """
    return number(value) if abs(value - round(value, DECIMALS)) < SAME * min(1.0, size) else f"{value:.6g}"


def vector(values: npt.ArrayLike) -> str:
    """Return (a, b, c) with four decimals."""
    return "(" + ", ".join(number(float(value)) for value in np.ravel(values)) + ")"


def pi_fraction(value: float) -> Fraction | None:
    """Return value/π when it is a fraction with a denominator of at most 12, to 1e-9."""
    fraction = Fraction(value / np.pi).limit_denominator(12)
    return fraction if abs(float(fraction) * np.pi - value) < 1e-9 else None


def joint_value(value: float) -> str:
    """Return a joint value: a simple multiple of π where it is one, else four decimals."""
    fraction = pi_fraction(value)
    if fraction is None or fraction == 0:
        return number(value)
    top = {1: "π", -1: "−π"}.get(fraction.numerator, f"{fraction.numerator}π".replace("-", "−"))
    return top if fraction.denominator == 1 else f"{top}/{fraction.denominator}"


def count(n: int, noun: str) -> str:
    """Return "1 iteration", "2 iterations"."""
    return f"{n} {noun}" if n == 1 else f"{n} {noun}s"


def enumeration(names: Iterable[str]) -> str:
    """Return "a", "a and b", "a, b and c"."""
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
