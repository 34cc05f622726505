"""Steps that cannot be interrupted are not begun when they would last longer than the time that is left."""

from flint import fmpq_mpoly

from robotics1.symbolic.polynomials.time_limit import OutOfTime, time_left

SHORT = 100  # terms of a polynomial that is factored at once
SECONDS = 3e-9  # to factor a polynomial, for the square of its terms and each bit of its coefficients
DIVISOR = 6  # times as long takes the greatest common divisor of two


def check_time_to_factor(N: fmpq_mpoly) -> None:
    """Raise OutOfTime when there is a limit, and factoring the polynomial would probably last beyond it."""
    _check(len(N), N, SECONDS)


def check_time_to_divide(f: fmpq_mpoly, g: fmpq_mpoly) -> None:
    """Raise OutOfTime as above, for a common divisor or a remainder of two polynomials."""
    longer = f if len(f) >= len(g) else g
    _check(len(longer), longer, DIVISOR * SECONDS)


def _check(terms: int, N: fmpq_mpoly, seconds: float) -> None:
    if terms <= SHORT:
        return
    left = time_left()
    if left < terms**2 * _bits(N) * seconds:
        raise OutOfTime


def _bits(N: fmpq_mpoly) -> int:
    return max(int(c.p).bit_length() + int(c.q).bit_length() for c in N.coeffs())
