"""A motion in another time: q(t/k)."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, real_number
from robotics1.trajectories.instants import times_inside
from robotics1.trajectories.protocols import Side, require_motion, smooth_ends


@dataclass(frozen=True, eq=False)
class Stretched:
    """q(t/k): any motion, slower for k > 1. Velocities are divided by k, accelerations by k², jerks by k³.

    Attributes:
        motion: q(t).
        factor: k.
    """

    motion: Any
    factor: float

    @property
    def duration(self) -> float:
        """The motion's, times k [s]."""
        return float(self.motion.duration) * self.factor

    @property
    def switching_times(self) -> Array:
        """The motion's, times k [s]."""
        return self.factor * np.array(smooth_ends(self.motion))[1:-1]

    def __call__(self, t: npt.ArrayLike) -> Any:
        """Return q(t/k).

        Raises:
            InputError: a time is outside the motion.
        """
        return self.motion(self._before(t))

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return q̇(t/k)/k."""
        return self.motion.velocity(self._before(t), side=side) / self.factor

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return q̈(t/k)/k²."""
        return self.motion.acceleration(self._before(t), side=side) / self.factor**2

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return the third derivative of q at t/k, divided by k³."""
        return self.motion.jerk(self._before(t), side=side) / self.factor**3

    def _before(self, t: npt.ArrayLike) -> Any:
        times = times_inside(t, self.duration) / self.factor
        return times if times.ndim else float(times)


def stretched(motion: Any, factor: float) -> Any:
    """Return q(t/k): of the same kind for polynomials, splines and timing laws, `Stretched` for any other motion.

    Args:
        motion: a trajectory or a timing law.
        factor: k > 0; the motion is slower for k > 1.

    Raises:
        InputError: k is not positive.
    """
    k = real_number("factor", factor, positive=True)
    require_motion("motion", motion)
    return motion.stretched(k) if hasattr(motion, "stretched") else Stretched(motion, k)
