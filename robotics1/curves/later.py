"""A motion that begins at another instant than 0, as it is asked for: by the time on the clock."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve
from robotics1.curves.interpolants import Extreme
from robotics1.curves.named_derivatives import NamedDerivatives, Side
from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, real_array, real_number
from robotics1.results import Frozen


@dataclass(frozen=True, eq=False)
class LaterMotion(NamedDerivatives, Frozen):
    """x(t), start ≤ t ≤ end, of a curve with its own time t − start.

    Where a motion is asked for, this is one too: the curve, which begins at 0.

    Attributes:
        trajectory: the curve, from 0.
        start: t₀, when it begins [s].
    """

    trajectory: Curve
    start: float

    @property
    def duration(self) -> float:
        """T [s]."""
        return self.trajectory.end

    @property
    def end(self) -> float:
        """When it ends, t₀ + T [s]."""
        return self.start + self.trajectory.end

    @property
    def breakpoints(self) -> Array:
        """When a derivative may jump [s]."""
        return self.start + self.trajectory.breakpoints

    def __call__(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return the value at the instant t, or values for (k,) instants.

        Raises:
            InputError: an instant is outside [start, end].
        """
        return self.trajectory(self._own(t), side=side)

    def derivative(self, t: npt.ArrayLike, order: int = 1, *, side: Side = "right") -> Any:
        """Return the derivative of an order at the instant t. Raises as a call."""
        return self.trajectory.derivative(self._own(t), order, side=side)

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return the instants and values of each coordinate's minimum and maximum, as a curve does."""
        times, values = self.trajectory.extremes(order)
        return self.start + times, values

    def peak(self, order: int = 1) -> Extreme:
        """Return the largest value of a derivative in magnitude, and its instant."""
        found = self.trajectory.peak(order)
        return Extreme(found.value, self.start + found.time, found.joint, found.resolved)

    def _own(self, t: npt.ArrayLike) -> Array:
        dims = min(dimensions("the instant", t), 1)
        instants = real_array("the instant", t, (None,) * dims, "one number or several")
        slack = 1e-9 * max(1.0, abs(self.start), abs(self.end))
        if instants.size and (instants.min() < self.start - slack or instants.max() > self.end + slack):
            raise InputError(f"the instant must be in [{self.start:.10g}, {self.end:.10g}]; it is {instants.tolist()}")
        return np.asarray(np.clip(instants - self.start, 0.0, self.trajectory.end))


def starting_at(motion: Any, start: float) -> LaterMotion:
    """Return a motion that begins at t₀ instead of 0: x(t − t₀).

    Args:
        motion: any motion, which begins at 0.
        start: t₀ [s].

    Raises:
        InputError: it is no motion, or t₀ no number.
    """
    return LaterMotion(as_curve("motion", motion), real_number("start", start))
