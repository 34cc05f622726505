"""How long work in chunks will take, by the pace of its first chunks: it is said before hours are spent unasked."""

from collections.abc import Callable
from time import monotonic

from robotics1.errors import warn

LONG = 3600.0  # s: a caller is warned of work that takes longer
AFTER = 1.0  # s after the first chunk, which may have waited for a compiler, at which a pace is known
ADVICE = "give it to a cluster (executor=, --scheduler), or keep what is done (checkpoint=) and go on another time"
UNITS = (("year", 365.25 * 86400), ("day", 86400.0), ("hour", 3600.0))

Progress = Callable[[int, int], None]


class Pace:
    """A progress function: it passes on what is done, and warns once if the rest will take longer than an hour."""

    def __init__(self, items: str, advice: str, progress: Progress | None) -> None:
        """Begin.

        Args:
            items: what is counted, such as "configurations".
            advice: what can be done about it, after "ask for".
            progress: the caller's own function.
        """
        self.items, self.advice, self.progress = items, advice, progress
        self._first: tuple[float, int] | None = None
        self._known = False

    def __call__(self, done: int, total: int) -> None:
        """Take note of the items done, of all."""
        if self.progress is not None:
            self.progress(done, total)
        now = monotonic()
        if self._first is None:
            self._first = now, done
        begun, before = self._first
        if not self._known and done > before and now - begun > AFTER:
            self._known = True
            rate = (done - before) / (now - begun)
            if total - done > LONG * rate:
                warn(
                    f"{total:.3g} {self.items} will take about {_words((total - done) / rate)} at the present "
                    f"{rate:.2g} a second: ask for {self.advice}"
                )


def _words(seconds: float) -> str:
    """Return a time in years, days or hours, such as "29 years"."""
    name, unit = next(((name, unit) for name, unit in UNITS if seconds >= unit), UNITS[-1])
    number = f"{seconds / unit:,.0f}"
    return f"{number} {name}{'' if number == '1' else 's'}"
