"""Velocity profiles: a ramp from v0 to a cruise velocity, the cruise, a ramp to v1."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from robotics1.inputs import real_number
from robotics1.trajectories.laws.ramps import Phase, Ramp
from robotics1.trajectories.polynomials.piecewise import PiecewiseTrajectory
from robotics1.trajectories.polynomials.polynomial import PolynomialTrajectory
from robotics1.trajectories.polynomials.polynomial_law import PolynomialLaw


@dataclass(frozen=True, eq=False)
class ProfileLaw(PolynomialLaw):
    """A timing law of phases with constant acceleration or jerk.

    Attributes:
        phases: from the first to the last, those without duration too: of a double-S there are seven.
        cruise_velocity: between the two ramps.
        cruise_time: how long it is kept [s]; zero if the ramps meet.
    """

    phases: tuple[Phase, ...] = ()
    cruise_velocity: float = 0.0
    cruise_time: float = 0.0

    def stretched(self, factor: float) -> "ProfileLaw":
        """Return s(t/k), slower for k > 1.

        Raises:
            InputError: k is not positive.
        """
        k = real_number("factor", factor, positive=True)
        phases = tuple(Phase(k * p.duration, p.acceleration / k**2, p.jerk / k**3) for p in self.phases)
        return replace(
            self,
            motion=self.motion.stretched(k),
            phases=phases,
            cruise_velocity=self.cruise_velocity / k,
            cruise_time=k * self.cruise_time,
        )


def law_of_phases(start: float, v0: float, phases: Sequence[Phase]) -> PiecewiseTrajectory:
    """Return the motion of one joint from s(0), ṡ(0) through phases; those without duration are left out."""
    pieces, s, v = [], start, v0
    for phase in phases:
        dt, a, j = phase.duration, phase.acceleration, phase.jerk
        if dt > 0:
            c = np.array([s, v * dt, a * dt**2 / 2, j * dt**3 / 6])
            pieces.append(PolynomialTrajectory(c[: 4 if j else 3, None], dt))
            s, v = float(c.sum()), v + a * dt + j * dt**2 / 2
    if not pieces:
        pieces.append(PolynomialTrajectory(np.array([[start], [v0]]), 0.0))
    return PiecewiseTrajectory(tuple(pieces))


def profile(start: float, v0: float, v1: float, ramp: Ramp, cruise: tuple[float, float]) -> ProfileLaw:
    """Return the law that goes from v0 to the cruise velocity, keeps it for the cruise time, and goes to v1."""
    velocity, time = cruise
    phases = (*ramp.phases(v0, velocity), Phase(time, 0.0), *ramp.phases(velocity, v1))
    return ProfileLaw(law_of_phases(start, v0, phases), 0, phases, velocity, time)


def steady(start: float, velocity: float, duration: float) -> ProfileLaw:
    """Return the law of constant velocity; of no duration, it is a state."""
    phases = (Phase(duration, 0.0),)
    return ProfileLaw(law_of_phases(start, velocity, phases), 0, phases, velocity, duration)
