"""Ramps of velocity: from one velocity to another as quickly as the bounds allow."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import copysign, inf, sqrt
from typing import Protocol

from robotics1.errors import InputError


@dataclass(frozen=True)
class Phase:
    """A part of a profile with constant jerk; of constant acceleration if the jerk is zero.

    Attributes:
        duration: [s]; zero for a phase that the profile leaves out.
        acceleration: where it begins.
        jerk: throughout.
    """

    duration: float
    acceleration: float
    jerk: float = 0.0


class Ramp(Protocol):
    """How a velocity is changed under bounds; at rest in acceleration before and after."""

    def phases(self, v: float, w: float) -> tuple[Phase, ...]:
        """Return the phases from the velocity v to w."""


@dataclass(frozen=True)
class ConstantAcceleration:
    """Speed grows with the acceleration A and falls with the deceleration D; through zero it does both.

    Attributes:
        acceleration: A.
        deceleration: D.
    """

    acceleration: float
    deceleration: float

    def phases(self, v: float, w: float) -> tuple[Phase, ...]:
        """Return one phase of |w − v|/A or /D, or two if the velocity changes its sign and A ≠ D."""
        A, D = self.acceleration, self.deceleration
        if v * w < 0 and A != D:
            return (*self.phases(v, 0.0), *self.phases(0.0, w))
        a = A if abs(w) > abs(v) else D
        return (Phase(abs(w - v) / a, copysign(a, w - v)),)


@dataclass(frozen=True)
class BoundedJerk:
    """The acceleration rises with the jerk J, stays at A if it gets there, and falls to zero again.

    |w − v| ≥ A²/J: phases of A/J, |w − v|/A − A/J, A/J; else A is not reached: √(|w − v|/J), none, √(|w − v|/J).

    Attributes:
        acceleration: A, which may be infinite.
        jerk: J.
    """

    acceleration: float
    jerk: float

    def phases(self, v: float, w: float) -> tuple[Phase, ...]:
        """Return the three phases; the middle one may have no duration."""
        A, J, change = self.acceleration, copysign(self.jerk, w - v), abs(w - v)
        rise = min(A / self.jerk, sqrt(change / self.jerk))
        hold = change / A - rise if rise < sqrt(change / self.jerk) else 0.0
        return Phase(rise, 0.0, J), Phase(hold, J * rise), Phase(rise, J * rise, -J)


def time_and_distance(phases: Sequence[Phase], v: float) -> tuple[float, float]:
    """Return how long phases last that begin with the velocity v, and how far they go."""
    time = distance = 0.0
    for phase in phases:
        dt, a, j = phase.duration, phase.acceleration, phase.jerk
        distance += v * dt + a * dt**2 / 2 + j * dt**3 / 6
        v += a * dt + j * dt**2 / 2
        time += dt
    return time, distance


def ramp_under(acceleration: float, jerk: float, deceleration: float | None = None) -> Ramp:
    """Return the quickest ramp under bounds; infinity for no bound on one of acceleration and jerk.

    Raises:
        InputError: neither is bounded, or a bounded jerk is asked to brake with another acceleration.
    """
    if jerk == inf and acceleration == inf:
        raise InputError("velocities would jump: give a bound on the acceleration or on the jerk")
    if jerk == inf:
        return ConstantAcceleration(acceleration, acceleration if deceleration is None else deceleration)
    if deceleration not in (None, acceleration):
        raise InputError("with a bounded jerk, acceleration and deceleration have the same bound")
    return BoundedJerk(acceleration, jerk)
