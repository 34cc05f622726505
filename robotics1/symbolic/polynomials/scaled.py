"""Numbers of any size, m 2ᵉ: a coefficient may be a quotient of whole numbers of thousands of digits."""

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

BITS = 64  # that are kept of a quotient
LARGEST = 900  # the largest exponent, of either sign, of numbers that are left as they are
NOTHING = -5000  # an exponent that makes zero of every double


class Scaled(NamedTuple):
    """The number m 2ᵉ, |m| being about one."""

    m: complex
    e: int

    def times(self, x: float, power: int) -> "Scaled":
        """Return the product with x to a power that is not negative."""
        fraction, e = math.frexp(x)
        return _normal(self.m * fraction**power, self.e + e * power)

    def turned(self, angle: float) -> "Scaled":
        """Return the product with exp(i angle)."""
        return Scaled(self.m * complex(math.cos(angle), math.sin(angle)), self.e)


def scaled(a: Any) -> Scaled:
    """Return an element of ℚ(i)."""
    (x, e), (y, f) = _fraction(a.x), _fraction(a.y)
    most = max(e, f)
    return _normal(complex(math.ldexp(x, max(e - most, NOTHING)), math.ldexp(y, max(f - most, NOTHING))), most)


def in_doubles(numbers: Sequence[Scaled]) -> npt.NDArray[np.complex128]:
    """Return the numbers; all divided by one power of two if the largest of them is beyond what a double can hold."""
    largest = max((number.e for number in numbers if number.m), default=0)
    shift = largest if abs(largest) > LARGEST else 0

    def double(m: float, e: int) -> float:
        return math.ldexp(m, max(e - shift, NOTHING))

    return np.array([complex(double(n.m.real, n.e), double(n.m.imag, n.e)) for n in numbers], dtype=complex)


def _fraction(x: Any) -> tuple[float, int]:
    """Return m and e of a rational number, rounded once."""
    p, q = int(x.numerator), int(x.denominator)
    if p == 0:
        return 0.0, NOTHING
    shift = BITS + q.bit_length() - p.bit_length()
    if abs(shift) <= LARGEST:
        return math.frexp(p / q)
    quotient = (p << shift) // q if shift >= 0 else p // (q << -shift)
    m, e = math.frexp(quotient)
    return m, e - shift


def _normal(m: complex, e: int) -> Scaled:
    shift = math.frexp(max(abs(m.real), abs(m.imag)))[1]
    return Scaled(complex(math.ldexp(m.real, -shift), math.ldexp(m.imag, -shift)), e + shift)
