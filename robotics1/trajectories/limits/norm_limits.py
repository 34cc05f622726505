"""Bounds on the norms of a point's velocity and acceleration."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.errors import InputError
from robotics1.trajectories.limits.demands import Demand
from robotics1.trajectories.peaks.norm_peaks import peak_norm
from robotics1.trajectories.quantities import positive_bound


@dataclass(frozen=True)
class NormLimits:
    """Bounds on |ṗ|, |p̈|, |d³p/dt³| and on the normal acceleration κ|ṗ|² of a point's motion; None for no bound.

    Attributes:
        velocity: [m/s].
        acceleration: [m/s²].
        jerk: [m/s³].
        normal_acceleration: [m/s²], across the path.
        rows: which coordinates make the norm; slice(0, 3) is the linear part of a pose's motion. By default all.
    """

    velocity: float | None = None
    acceleration: float | None = None
    jerk: float | None = None
    normal_acceleration: float | None = None
    rows: slice | None = None

    def __post_init__(self) -> None:
        """Refuse bounds that are not positive."""
        for name in ("velocity", "acceleration", "jerk", "normal_acceleration"):
            positive_bound(name, getattr(self, name), 1)

    def demands(self, trajectory: Any) -> tuple[Demand, ...]:
        """Return the largest norms, from exact extremes.

        Raises:
            InputError: the motion turns too sharply, or oscillates too quickly, for them to be found.
        """
        found = []
        for name in ("velocity", "acceleration", "jerk", "normal_acceleration"):
            bound = float(positive_bound(name, getattr(self, name), 1)[0])
            if bound < np.inf:
                quantity = name.replace("_", " ")
                peak = peak_norm(trajectory, quantity, rows=self.rows)
                if not peak.resolved:
                    raise InputError(
                        "the motion turns too sharply, or oscillates too quickly, for its largest "
                        f"{quantity} to be found"
                    )
                found.append(Demand(None, quantity, peak.value, bound, peak.time))
        return tuple(found)
