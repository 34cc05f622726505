"""Angles: whole turns, the multiples of π/12 that files and tables write with few digits, and degrees by mistake."""

import re
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from math import pi
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import warn

TURN = 2 * pi
MEANT = 1e-5  # an angle this near to a multiple of π/12 is meant to be it: files write 1.5708 for π/2 [rad]
DECIMALS = 4  # of a number that was typed
WIDE = 40.0  # a limit beyond this may be in degrees; -10 and 10 are common, and mean none [rad]
FEWEST_COMPUTED = 30.0  # an iteration may end some turns away
FEWEST, MOST = 10.0, 720.0  # between these, whole angles and those far outside their limits are in degrees


def twelfths_of_pi(angle: float, tolerance: float = MEANT) -> int | None:
    """Return k where an angle is k π/12 to the tolerance [rad], else None."""
    k = round(angle * 12 / pi)
    return k if abs(k * pi / 12 - angle) <= tolerance else None


def clean_angle(angle: float, tolerance: float = 1e-14) -> float:
    """Return the multiple of π/12 that an angle is to the tolerance [rad], else the angle itself."""
    k = twelfths_of_pi(angle, tolerance)
    return angle if k is None else k * pi / 12


def without_turns(
    angle: npt.NDArray[Any] | float, period: npt.NDArray[Any] | float = TURN
) -> npt.NDArray[np.floating[Any]]:
    """Return angles, or differences of angles, less whole turns, or whole periods: those nearest to zero."""
    return np.asarray(angle - period * np.round(angle / period))


def looks_like_degrees(angle: float) -> bool:
    """Return whether an angle is a whole or half number from 10 to 720: more likely in degrees than in radians."""
    return FEWEST <= abs(angle) <= MOST and 2 * angle == round(2 * angle)


_iterating: ContextVar[bool] = ContextVar("_iterating", default=False)


@contextmanager
def angles_of_an_iteration() -> Iterator[None]:
    """Warn of no degrees inside: an iteration may pass through angles of any size."""
    token = _iterating.set(True)
    try:
        yield
    finally:
        _iterating.reset(token)


def warn_of_degrees(
    name: str,
    values: npt.NDArray[np.floating[Any]],
    turns: npt.NDArray[np.bool_] | bool = True,
    lower: npt.NDArray[np.floating[Any]] | float = -np.inf,
    upper: npt.NDArray[np.floating[Any]] | float = np.inf,
) -> None:
    """Warn of angles that were probably typed in degrees.

    These are whole or half numbers from 10 to 720, and others of this size that are more than a turn outside of their
    limits; from 30 on if they have more than four decimals, as a computed angle has.

    Args:
        name: what they are called.
        values: (..., n).
        turns: (n,) which of them are angles [rad]; the others are lengths.
        lower, upper: (n,) their limits; an angle between two limits is meant.
    """
    if max(map(abs, values.ravel().tolist()), default=0.0) < FEWEST:  # at each call: NumPy would take longer
        return
    if _iterating.get():
        return
    size = np.abs(values)
    halves = 2 * np.clip(values, -MOST, MOST)
    limited = np.isfinite(lower) & np.isfinite(upper)
    computed = values != np.round(np.clip(values, -MOST, MOST), DECIMALS)
    far = limited & ((values < lower - TURN) | (values > upper + TURN)) & ((size >= FEWEST_COMPUTED) | ~computed)
    typed = (size >= FEWEST) & (size <= MOST) & ((halves == np.round(halves)) | far) & turns
    typed &= ~((lower <= values) & (values <= upper) & limited)
    if typed.any():
        angle = float(values[typed][0])
        warn(
            f"{name} has the angle {angle:g}, which is {angle / TURN:.1f} turns: angles are in radians; "
            f"if degrees are meant, write radians({angle:g})"
        )


def printed_twelfths_of_pi(angle: float) -> int | None:
    """Return k where an angle is k π/12, k ≠ 0, rounded to the three or more decimals it is printed with, else None.

    So 1.5708 and 1.571 stand for π/2, but 1.5707 does not.
    """
    digits = repr(float(angle))
    k = twelfths_of_pi(angle, 1e-3)
    if not k or not re.fullmatch(r"-?\d*\.\d{3,12}", digits):
        return None
    return k if round(k * pi / 12, len(digits.partition(".")[2])) == angle else None
