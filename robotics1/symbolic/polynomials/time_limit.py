"""A limit to the time that exact computations take."""

import math
import time
from dataclasses import dataclass, field


class OutOfTime(Exception):  # noqa: N818
    """The time is over before the exact answer was there."""


@dataclass
class TimeLimit:
    """A number of seconds from now; `check` raises OutOfTime when they are over."""

    seconds: float
    started: float = field(default_factory=time.monotonic)

    @property
    def is_over(self) -> bool:
        """Whether the time is over."""
        return time.monotonic() - self.started > self.seconds

    def check(self) -> None:
        """Raise OutOfTime when the time is over."""
        if self.is_over:
            raise OutOfTime


UNLIMITED = TimeLimit(math.inf)
