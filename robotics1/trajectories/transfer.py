"""Which cruise velocity takes a joint from (s0, v0) to (s1, v1): in the shortest time, or in a given one."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf, nextafter

from robotics1.errors import InputError
from robotics1.trajectories.ramps import Ramp, time_and_distance

NEAR = 1e-11  # relative: a distance missed by less is reached


@dataclass(frozen=True)
class Transfer:
    """The distance Δ, from the velocity v0 to v1, by a ramp to a cruise velocity, a cruise and a second ramp.

    Attributes:
        distance: Δ = s1 − s0.
        v0, v1: the velocities at the ends, within ±V.
        ramp: how velocities are changed.
        max_velocity: V, which may be infinite.
    """

    distance: float
    v0: float
    v1: float
    ramp: Ramp
    max_velocity: float = inf

    def fastest(self) -> tuple[float, float]:
        """Return the cruise velocity and cruise time of the shortest duration.

        If Δ is not less than the distance of a ramp straight from v0 to v1, the cruise velocity is above both; else
        the mirror image. Where the two ramps over V are too short, V is kept for the rest; else they meet where their
        distance is Δ. It increases with the cruise velocity, or is a convex function if v0 and v1 are both negative:
        there is one such velocity.
        """
        slowest = max(self.v0, self.v1)
        straight = self._ramps(slowest)[1]
        if abs(straight - self.distance) <= NEAR * abs(self.distance):
            return slowest, 0.0  # where both velocities are negative, a turn before it would have the same Δ
        if straight > self.distance:
            velocity, time = self._mirrored().fastest()
            return -velocity, time
        missing = self.distance - self._ramps(self.max_velocity)[1] if self.max_velocity < inf else -inf
        if missing >= 0:
            return self.max_velocity, missing / self.max_velocity
        velocity = _crossing(lambda v: self._ramps(v)[1] - self.distance, slowest, self.max_velocity)
        if abs(self._ramps(velocity)[1] - self.distance) <= NEAR * abs(self.distance):
            return velocity, 0.0
        while self._ramps(velocity)[1] > self.distance:  # by a rounding of the velocity, Δ being so small
            velocity = nextafter(velocity, slowest)
        missing = self.distance - self._ramps(velocity)[1]
        return velocity, missing / velocity if velocity > 0 else 0.0

    def lasting(self, duration: float) -> tuple[float, float]:
        """Return the cruise velocity and cruise time of a given duration T.

        The distance in T increases with the cruise velocity, at a rate of at least the cruise time.

        Raises:
            InputError: no cruise velocity gives Δ in T.
        """
        least, most = -self._mirrored()._most(duration), self._most(duration)
        near = NEAR * (abs(self.distance) + abs(least) + abs(most))
        velocity, rest = self._cruise(duration)
        if least - near <= self.distance <= most + near and rest >= -NEAR * duration:
            return velocity, max(0.0, rest)
        raise InputError(
            f"a distance of {self.distance:g} cannot take {duration:g} s under these bounds: it can be {least:g} to "
            f"{most:g} then; the next possible duration is {self.next_duration(duration):.9g} s"
        )

    def next_duration(self, duration: float) -> float:
        """Return the shortest duration, not below the given one, in which Δ can be done.

        With velocities at the ends some durations are impossible: to come later, one has to stop and turn.
        """
        T = max(duration, self._ramps(max(self.v0, self.v1))[0])
        for way in (self, self._mirrored()):
            if way._most(T) < way.distance - NEAR * (abs(way.distance) + abs(way._most(T))):
                T = way._duration_of_most(T)
        if self._cruise(T)[1] < -NEAR * T:
            T = _crossing(lambda t: self._cruise(t)[1], T, inf)
        return duration if duration == T else self.next_duration(T)

    def _cruise(self, duration: float) -> tuple[float, float]:
        """Return the cruise velocity of a duration T, or the nearest there is, and the time that its ramps leave."""
        low, high = -self._mirrored()._fastest_cruise(duration), self._fastest_cruise(duration)
        if self._reach(low, duration) >= self.distance:
            velocity = low
        elif self._reach(high, duration) <= self.distance:
            velocity = high
        else:
            velocity = _crossing(lambda v: self._reach(v, duration) - self.distance, low, high)
        return velocity, duration - self._ramps(velocity)[0]

    def _mirrored(self) -> "Transfer":
        return replace(self, distance=-self.distance, v0=-self.v0, v1=-self.v1)

    def _ramps(self, cruise: float) -> tuple[float, float]:
        """Return how long the two ramps over a cruise velocity last, and how far they go."""
        up, down = self.ramp.phases(self.v0, cruise), self.ramp.phases(cruise, self.v1)
        (t0, d0), (t1, d1) = time_and_distance(up, self.v0), time_and_distance(down, cruise)
        return t0 + t1, d0 + d1

    def _reach(self, cruise: float, duration: float) -> float:
        """Return the distance in T over a cruise velocity."""
        time, distance = self._ramps(cruise)
        return distance + cruise * (duration - time)

    def _fastest_cruise(self, duration: float) -> float:
        """Return the greatest cruise velocity whose ramps fit into T."""
        slowest = max(self.v0, self.v1)
        if (spare := duration - self._ramps(slowest)[0]) <= 0:
            if spare < -NEAR * duration:
                raise InputError(
                    f"{duration:g} s are too short for a ramp from the velocity {self.v0:g} to {self.v1:g}"
                )
            return slowest
        if self.max_velocity < inf and self._ramps(self.max_velocity)[0] <= duration:
            return self.max_velocity
        return _crossing(lambda v: self._ramps(v)[0] - duration, slowest, self.max_velocity)

    def _most(self, duration: float) -> float:
        """Return the greatest distance in T."""
        return self._reach(self._fastest_cruise(duration), duration)

    def _duration_of_most(self, duration: float) -> float:
        """Return the duration, above the given one, in which the greatest distance is Δ."""
        return _crossing(lambda T: self._most(T) - self.distance, duration, inf)


def _crossing(f: Callable[[float], float], low: float, high: float) -> float:
    """Return where f becomes positive, to rounding; an infinite end is looked for in doubled steps."""
    from scipy.optimize import brentq

    if high == inf:
        step = max(1.0, abs(low))
        while f(low + step) <= 0:
            step *= 2
        high = low + step
    return float(brentq(f, low, high, xtol=1e-300, rtol=1e-15, maxiter=10_000))
