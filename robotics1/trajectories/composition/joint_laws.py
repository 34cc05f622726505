"""Joints that each have a timing law of their own."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number
from robotics1.trajectories.composition.stretching import stretched
from robotics1.trajectories.instants import distinct_instants, times_inside
from robotics1.trajectories.peaks.extremes import extremes_of
from robotics1.trajectories.protocols import Side, TimingLaw, require_law

SAME_DURATION = 1e-9  # relative


@dataclass(frozen=True, eq=False)
class JointLaws:
    """q(t) = (s₁(t), ..., sₙ(t)); a joint whose law ends before the last one's stays where it is.

    Attributes:
        laws: one for each joint.
    """

    laws: tuple[TimingLaw, ...]

    def __post_init__(self) -> None:
        """Refuse a joint that would have to stop at once."""
        laws = tuple(self.laws) if isinstance(self.laws, Sequence) else ()
        if not laws:
            raise InputError(f"laws must be one timing law for each joint; they are {self.laws!r}")
        object.__setattr__(self, "laws", tuple(require_law("a law", law) for law in laws))
        for i, law in enumerate(self.laws):
            v1 = law.velocity(law.duration, side="left")
            if self._stays(law) and abs(v1) > 1e-9 * np.abs(extremes_of(law, 1)[1]).max():
                raise InputError(
                    f"joint {i} arrives at {law.duration:g} s with the velocity {v1:g}, before the others, and cannot "
                    "stay; let all joints take the same time"
                )

    @cached_property
    def duration(self) -> float:
        """T [s], of the slowest joint."""
        return max(law.duration for law in self.laws)

    @cached_property
    def switching_times(self) -> Array:
        """The instants inside (0, T) at which a derivative of some joint jumps [s]."""
        ends = [law.duration for law in self.laws if self._stays(law)]
        return distinct_instants(np.concatenate([ends, *(law.switching_times for law in self.laws)]), self.duration)

    def __call__(self, t: npt.ArrayLike) -> Array:
        """Return q(t): (n,) for a number, (k, n) for (k,) times.

        Raises:
            InputError: a time is outside the motion.
        """
        times = times_inside(t, self.duration)
        return np.stack([law(np.minimum(times, law.duration)) for law in self.laws], axis=-1)

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return q̇(t), in the shape of q(t)."""
        return self._rates(t, side, lambda law: law.velocity)

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return q̈(t), in the shape of q(t)."""
        return self._rates(t, side, lambda law: law.acceleration)

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return the third derivative of q(t), in the shape of q(t)."""
        return self._rates(t, side, lambda law: law.jerk)

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return the times (2, n) [s] and values (2, n) of each joint's minimum and maximum.

        `order` 1, 2, 3 asks for those of the velocity, acceleration, jerk.
        """
        found = [extremes_of(law, order) for law in self.laws]
        times, values = (np.stack(parts, axis=-1) for parts in zip(*found, strict=True))
        if counting_number("order", order):  # the derivatives of a joint that stays are zero
            stays = np.array([law.duration if self._stays(law) else np.inf for law in self.laws])
            for row, beyond in enumerate((values[0] > 0, values[1] < 0)):
                found_at_rest = beyond & np.isfinite(stays)
                times[row, found_at_rest], values[row, found_at_rest] = stays[found_at_rest], 0.0
        return times, values

    def joint(self, index: int = 0) -> TimingLaw:
        """Return the law of one joint.

        Raises:
            InputError: there is no such joint.
        """
        if counting_number("index", index) >= len(self.laws):
            raise InputError(f"index must be below {len(self.laws)}, the number of joints; it is {index}")
        return self.laws[index]

    def stretched(self, factor: float) -> "JointLaws":
        """Return q(t/k), slower for k > 1.

        Raises:
            InputError: k is not positive.
        """
        return JointLaws(tuple(stretched(law, factor) for law in self.laws))

    def _stays(self, law: TimingLaw) -> bool:
        """Return whether a law ends before the last one."""
        return law.duration < self.duration * (1 - SAME_DURATION)

    def _rates(self, t: npt.ArrayLike, side: Side, rate: Callable[[TimingLaw], Any]) -> Array:
        times = times_inside(t, self.duration, side)
        columns = []
        for law in self.laws:
            values = rate(law)(np.minimum(times, law.duration), side=side)
            ended = times >= law.duration if side == "right" else times > law.duration
            columns.append(np.where(ended & self._stays(law), 0.0, values))
        return np.stack(columns, axis=-1)
