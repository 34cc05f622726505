"""What one joint has to do under its bounds, and what a kind of timing law answers."""

from dataclasses import dataclass
from typing import Protocol

from robotics1.trajectories.protocols import TimingLaw

SAME_DURATION = 1e-12  # relative


@dataclass(frozen=True)
class JointMove:
    """What one joint has to do, and its bounds; infinity for none.

    Attributes:
        q0, q1: start and end.
        v0, v1: the velocities there, within the bound.
        velocity, acceleration, jerk, deceleration: the bounds.
    """

    q0: float
    q1: float
    v0: float
    v1: float
    velocity: float
    acceleration: float
    jerk: float
    deceleration: float

    @property
    def is_rest_to_rest(self) -> bool:
        """Whether it begins and ends at rest."""
        return self.v0 == self.v1 == 0

    def stays(self, duration: float) -> bool:
        """Return whether start and end are one state that can be kept for the duration."""
        return self.q0 == self.q1 and self.v0 == self.v1 and (duration == 0 or self.v0 == 0)


class LawKind(Protocol):
    """A kind of timing law."""

    def next_duration(self, move: JointMove, at_least: float) -> float:
        """Return the shortest duration, not below the given one, in which the move keeps its bounds.

        Raises:
            InputError: there is none, or this kind cannot keep such bounds.
        """

    def lasting(self, move: JointMove, duration: float) -> TimingLaw:
        """Return the law of one of those durations."""
