"""Bounds on the joints of a motion."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.trajectories.limits.braking import growing_and_falling
from robotics1.trajectories.limits.demands import Demand
from robotics1.trajectories.peaks.extremes import extremes_of, peak_of
from robotics1.trajectories.quantities import positive_bound


@dataclass(frozen=True, eq=False)
class MotionLimits:
    """Bounds |q̇| ≤ V, |q̈| ≤ A, |d³q/dt³| ≤ J of each joint; None or infinity for no bound.

    Attributes:
        velocity: V [rad/s or m/s], (n,) or one number for all.
        acceleration: A [rad/s² or m/s²]; with a deceleration, the bound while the speed grows.
        jerk: J [rad/s³ or m/s³].
        deceleration: the bound on |q̈| while the speed falls, if it is another; for constant accelerations only.
    """

    velocity: npt.ArrayLike | None = None
    acceleration: npt.ArrayLike | None = None
    jerk: npt.ArrayLike | None = None
    deceleration: npt.ArrayLike | None = None

    def __post_init__(self) -> None:
        """Refuse bounds that are not positive."""
        for name in ("velocity", "acceleration", "jerk", "deceleration"):
            positive_bound(name, getattr(self, name))
        if self.deceleration is not None and self.acceleration is None:
            raise InputError("a bound on the deceleration needs one on the acceleration too")

    def of_joints(self, n: int) -> dict[str, Array]:
        """Return the bounds of n joints by name, (n,) each, infinity for none.

        Raises:
            InputError: they are for another number of joints.
        """
        bounds = {name: positive_bound(name, getattr(self, name), n) for name in ("velocity", "acceleration", "jerk")}
        return bounds | {"deceleration": positive_bound("deceleration", self._deceleration, n)}

    def demands(self, trajectory: Any) -> tuple[Demand, ...]:
        """Return the most that a motion asks of each bound, from its exact extremes.

        Raises:
            InputError: the bounds are for another number of joints, or the deceleration has one of its own and the
                accelerations are not constant between the switching times.
        """
        start = trajectory(0.0)
        if np.ndim(start) > 1 or hasattr(start, "rotation"):
            raise InputError("MotionLimits bound joints; NormLimits(rows=...) bounds the norms of a pose's motion")
        n = np.size(start)
        bounds = self.of_joints(n)
        found = []
        for order, quantity in enumerate(("velocity", "acceleration", "jerk"), start=1):
            if quantity == "acceleration" and self.deceleration is not None:
                found += growing_and_falling(trajectory, bounds)
                continue
            bounded = np.flatnonzero(np.isfinite(bounds[quantity]))
            times, values = extremes_of(trajectory, order) if bounded.size else (np.empty(0), np.empty(0))
            for j in bounded:
                peak = peak_of(times.reshape(2, n)[:, j], values.reshape(2, n)[:, j])
                found.append(Demand(int(j), quantity, peak.value, float(bounds[quantity][j]), peak.time))
        return tuple(found)

    @property
    def _deceleration(self) -> npt.ArrayLike | None:
        return self.acceleration if self.deceleration is None else self.deceleration
