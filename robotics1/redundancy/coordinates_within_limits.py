"""Coordinates that are free while the joints stay within their limits: q = c + h sin x."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array

Mask = npt.NDArray[np.bool_]

EDGE = 1e-3  # of half the range: where a start at a limit is put, since dq/dx = 0 at the limit itself


@dataclass(frozen=True, eq=False)
class BoundedJoints:
    """q(x) within the limits for every x, with dq/dx = 0 where a joint is at one.

    With the middle c and half the range h of a joint: q = c + h sin(x/h), in units u, with max(h, u) for h below the
    line. With one limit only, q = lower + u (√(1 + x²) − 1), or the same downwards. Without a limit, q = u x.
    At a q that is best within the limits the slope along x vanishes: for a joint at a limit, since dq/dx does; if it
    would be better beyond, |e| is least there, and if it would be better inside, |e| is largest.

    Attributes:
        lower, upper: (n,) limits, ∓∞ for none.
        units: (n,) what a joint's motion is measured in: 1 rad, or the reach of the arm.

    Source: James, Roos, MINUIT, Computer Physics Communications 10, 1975 (the change of variables).
    """

    lower: Array
    upper: Array
    units: Array

    def q(self, x: Array) -> Array:
        """Return q (n,)."""
        both, one = self._kinds()
        c, h, rate = self._sine()
        bend = self.units * (np.hypot(1, x) - 1)
        alone = np.where(np.isfinite(self.lower), self.lower + bend, self.upper - bend)
        free = np.where(one, alone, self.units * x)
        return np.clip(np.where(both, c + h * np.sin(rate * x), free), self.lower, self.upper)

    def slope(self, x: Array) -> Array:
        """Return dq/dx (n,)."""
        both, one = self._kinds()
        _, h, rate = self._sine()
        alone = np.where(np.isfinite(self.lower), 1.0, -1.0) * self.units * (x / np.hypot(1, x))
        return np.where(both, h * rate * np.cos(rate * x), np.where(one, alone, self.units))

    def x(self, q: Array) -> Array:
        """Return the x (n,) of a start: of the q nearest to this one that is not quite at a limit."""
        both, one = self._kinds()
        c, h, rate = self._sine()
        q = np.clip(q, self.lower, self.upper)
        part = np.divide(q - c, h, out=np.zeros(len(q)), where=both & (h > 0))
        sine = np.arcsin(np.clip(part, EDGE - 1, 1 - EDGE)) / rate
        bend = np.maximum(np.where(np.isfinite(self.lower), q - self.lower, self.upper - q) / self.units, EDGE)
        alone = np.sqrt(np.where(one, bend, 1.0)) * np.sqrt(np.where(one, bend, 1.0) + 2)
        return np.where(both, sine, np.where(one, alone, q / self.units))

    def _kinds(self) -> tuple[Mask, Mask]:
        """Return which joints have two limits, and which have one."""
        low, high = np.isfinite(self.lower), np.isfinite(self.upper)
        return low & high, low ^ high

    def _sine(self) -> tuple[Array, Array, Array]:
        """Return the middle, half the range, and how fast the angle of the sine grows with x."""
        both, _ = self._kinds()
        low, high = (np.where(both, limit, 0.0) for limit in (self.lower, self.upper))
        h = 0.5 * (high - low)
        return low + h, h, self.units / np.maximum(h, self.units)
