"""A limit to the time that exact computations take."""

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, field

_deadline: ContextVar[float] = ContextVar("deadline", default=math.inf)  # of the limits that are kept [s]


class OutOfTime(Exception):  # noqa: N818
    """The time is over before the exact answer was there."""


@dataclass
class TimeLimit:
    """A number of seconds from now; `check` raises OutOfTime when they are over."""

    seconds: float
    started: float = field(default_factory=time.monotonic)

    @property
    def deadline(self) -> float:
        """When the time is over, on the clock of `time.monotonic` [s]."""
        return self.started + self.seconds

    @property
    def is_over(self) -> bool:
        """Whether the time is over."""
        return time.monotonic() > self.deadline

    def check(self) -> None:
        """Raise OutOfTime when the time is over."""
        if self.is_over:
            raise OutOfTime

    def part(self, fraction: float) -> "TimeLimit":
        """Return the limit that ends after a part of the time."""
        return TimeLimit(fraction * self.seconds, self.started)

    @contextmanager
    def kept(self) -> Iterator[None]:
        """Let `check_time` raise OutOfTime, inside the block and in this thread, when the time is over.

        Long computations consist of short steps, each of which calls `check_time`. Of two limits, one inside the
        other, the earlier counts.
        """
        token = _deadline.set(min(self.deadline, _deadline.get()))
        try:
            yield
        finally:
            _deadline.reset(token)


UNLIMITED = TimeLimit(math.inf)


def check_time() -> None:
    """Raise OutOfTime when the time of a limit that is kept is over."""
    deadline = _deadline.get()
    if deadline < math.inf and time.monotonic() > deadline:
        raise OutOfTime


def time_left() -> float:
    """Return the time until the limit that is kept is over [s]; infinite without one."""
    deadline = _deadline.get()
    return deadline - time.monotonic() if deadline < math.inf else math.inf
