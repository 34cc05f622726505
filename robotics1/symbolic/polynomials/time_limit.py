"""A limit to the time that exact computations take.

Steps that cannot be interrupted are not begun when they would last longer than the time that is left.
"""

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from flint import fmpq_mpoly

SHORT = 100  # terms of a polynomial that is factored at once
SECONDS = 3e-9  # to factor a polynomial, for the square of its terms and each bit of its coefficients
DIVISOR = 6  # times as long takes the greatest common divisor of two

_deadline: ContextVar[float] = ContextVar("deadline", default=math.inf)  # of the limits that are kept [s]


class OutOfTime(Exception):  # noqa: N818
    """The time is over before the exact answer was there."""


@dataclass
class TimeLimit:
    """A number of seconds from now."""

    seconds: float
    started: float = field(default_factory=time.monotonic)

    @property
    def deadline(self) -> float:
        """When the time is over, on the clock of `time.monotonic` [s]."""
        return self.started + self.seconds

    def part(self, fraction: float) -> "TimeLimit":
        """Return the limit that ends after a part of the time."""
        return TimeLimit(fraction * self.seconds, self.started)

    @contextmanager
    def kept(self) -> Iterator[None]:
        """Let `check_time` raise OutOfTime, inside the block and in this thread, when the time is over.

        Long computations consist of short steps; each step calls `check_time`. Of two limits, one inside the
        other, the earlier counts.
        """
        token = _deadline.set(min(self.deadline, _deadline.get()))
        try:
            yield
        finally:
            _deadline.reset(token)


def check_time() -> None:
    """Raise OutOfTime when the time of a limit that is kept is over."""
    deadline = _deadline.get()
    if deadline < math.inf and time.monotonic() > deadline:
        raise OutOfTime


def check_time_to_factor(N: "fmpq_mpoly", times: float = 1.0) -> None:
    """Raise OutOfTime when the time is over, or factoring the polynomial would probably last beyond it.

    `times` is how much longer the step takes than to factor.
    """
    check_time()
    deadline = _deadline.get()
    if len(N) <= SHORT or deadline == math.inf:
        return
    bits = max(int(c.p).bit_length() + int(c.q).bit_length() for c in N.coeffs())
    if deadline - time.monotonic() < len(N) ** 2 * bits * SECONDS * times:
        raise OutOfTime


def check_time_to_divide(f: "fmpq_mpoly", g: "fmpq_mpoly") -> None:
    """Raise OutOfTime as above, for a common divisor or a remainder of two polynomials."""
    check_time_to_factor(max(f, g, key=len), DIVISOR)
