"""The kinds of timing laws: for each the shortest durations of one joint, and its law."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf, sqrt
from typing import Protocol

from robotics1.curves.curve import Curve
from robotics1.errors import InputError
from robotics1.trajectories.elementary import cosine, cubic, cycloidal, quintic, septic
from robotics1.trajectories.limits import MotionLimits
from robotics1.trajectories.profiles import VelocityProfile, bang_bang_law, profile, steady
from robotics1.trajectories.ramps import ramp_under
from robotics1.trajectories.scaling import minimum_duration
from robotics1.trajectories.transfer import Transfer

SAME_DURATION = 1e-12  # relative


@dataclass(frozen=True)
class JointMove:
    """What one joint has to do, and its bounds.

    Attributes:
        q0, q1: start and end.
        v0, v1: the velocities there, within the bound.
        limits: of this joint, as numbers; infinity for none.
    """

    q0: float
    q1: float
    v0: float
    v1: float
    limits: MotionLimits

    @property
    def is_rest_to_rest(self) -> bool:
        """Whether it begins and ends at rest."""
        return self.v0 == self.v1 == 0

    @property
    def deceleration(self) -> float:
        """The bound while the speed falls."""
        return float(self.limits.acceleration if self.limits.deceleration is None else self.limits.deceleration)

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

    def lasting(self, move: JointMove, duration: float) -> Curve:
        """Return the law of one of those durations."""


@dataclass(frozen=True)
class RampsAndCruise:
    """Trapezoidal velocity, or double-S.

    From rest to rest a longer duration stretches the fastest law uniformly; else its cruise is slower.

    Attributes:
        name: of the kind.
        smooth: whether the jerk is bounded.
    """

    name: str
    smooth: bool

    def next_duration(self, move: JointMove, at_least: float) -> float:
        """Return the duration of the fastest law; if that is too short, the next that is possible."""
        transfer = self._transfer(move)
        if move.stays(at_least):
            return at_least
        fastest = self._fastest(move).duration
        if fastest >= at_least or move.is_rest_to_rest:
            return max(fastest, at_least)
        return transfer.next_duration(at_least)

    def lasting(self, move: JointMove, duration: float) -> Curve:
        """Return the fastest law, or a slower one."""
        fastest = self._fastest(move)
        if duration <= fastest.duration * (1 + SAME_DURATION):
            return fastest
        if not move.is_rest_to_rest:
            transfer = self._transfer(move)
            return profile(move.q0, move.v0, move.v1, transfer.ramp, transfer.lasting(duration))
        if fastest.duration == 0:
            return steady(move.q0, 0.0, duration)
        return fastest.stretched(duration / fastest.duration)

    def _fastest(self, move: JointMove) -> VelocityProfile:
        transfer = self._transfer(move)
        return profile(move.q0, move.v0, move.v1, transfer.ramp, transfer.fastest())

    def _transfer(self, move: JointMove) -> Transfer:
        _refuse_unbounded(self.name, move, smooth=self.smooth)
        ramp = ramp_under(move.limits.acceleration, move.limits.jerk, move.deceleration)
        return Transfer(move.q1 - move.q0, move.v0, move.v1, ramp, move.limits.velocity)


@dataclass(frozen=True)
class BangBang:
    """Acceleration A, then −A, or the reverse, without a cruise: of a longer duration A is smaller."""

    name: str = "bang_bang"

    def next_duration(self, move: JointMove, at_least: float) -> float:
        """Return the given duration or the least at which a bound is touched, whichever first keeps both bounds.

        With p the velocity at the switch and e = (v0² + v1²)/2: |q̈| = A where p² = e ± A Δ and T = |2p − v0 − v1|/A;
        p = ±V where T = Δ (2p − v0 − v1)/(p² − e).
        """
        if move.limits.velocity == inf or move.limits.jerk < inf:  # a bound on the velocity is enough
            _refuse_unbounded(self.name, move, smooth=False)
        if move.deceleration != move.limits.acceleration:
            raise InputError("a bang-bang law has one acceleration; 'trapezoidal' brakes with another")
        if move.stays(at_least):
            return at_least
        A, V = float(move.limits.acceleration), float(move.limits.velocity)
        v0, v1, distance = move.v0, move.v1, move.q1 - move.q0
        e = (v0**2 + v1**2) / 2
        squares = [e + A * distance, e - A * distance] if inf > A else []
        durations = [
            abs(2 * p - v0 - v1) / A for square in squares if square >= 0 for p in (sqrt(square), -sqrt(square))
        ]
        durations += [distance * (2 * p - v0 - v1) / (V**2 - e) for p in (V, -V) if e < V**2 < inf]
        durations += [2 * distance / (v0 + v1)] if v0 + v1 else []  # without a switch, as from V to V
        for T in sorted([at_least, *(T for T in durations if at_least < T)]):
            if T > 0 and self._keeps(move, T):
                return T
        raise InputError("no bang-bang law keeps the bounds; 'trapezoidal' does")

    def lasting(self, move: JointMove, duration: float) -> Curve:
        """Return the law of a duration."""
        if duration == 0:
            return steady(move.q0, move.v0, 0.0)
        return bang_bang_law(move.q0, move.q1 - move.q0, (move.v0, move.v1), duration)

    def _keeps(self, move: JointMove, T: float) -> bool:
        law = bang_bang_law(0.0, move.q1 - move.q0, (move.v0, move.v1), T)
        V, A = move.limits.velocity, move.limits.acceleration
        return bool(max(abs(law.peak(1).value) / V, abs(law.peak(2).value) / A) <= 1 + 1e-9)


@dataclass(frozen=True)
class Shape:
    """A polynomial or trigonometric law: its shape is that of its boundary values.

    Attributes:
        name: of the kind.
        motion: the motion of one joint, of (q0, q1, T, v0, v1) or (q0, q1, T).
        ends_move: whether it takes velocities at the ends.
    """

    name: str
    motion: Callable[..., Curve]
    ends_move: bool = True

    def next_duration(self, move: JointMove, at_least: float) -> float:
        """Return the least duration with which the exact extremes keep the bounds."""
        if move.deceleration != move.limits.acceleration:
            raise InputError(f"a {self.name} law has one bound on the acceleration; 'trapezoidal' brakes with another")
        if move.stays(at_least):
            return at_least
        limits = replace(move.limits, deceleration=None)
        return minimum_duration(self._of(move), limits, at_least=at_least)

    def lasting(self, move: JointMove, duration: float) -> Curve:
        """Return the law of a duration."""
        if duration == 0:
            return steady(move.q0, move.v0, 0.0)
        return self._of(move)(duration).joint()

    def _of(self, move: JointMove) -> Callable[[float], Curve]:
        if self.ends_move:
            return lambda T: self.motion(move.q0, move.q1, T, move.v0, move.v1)
        if move.is_rest_to_rest:
            return lambda T: self.motion(move.q0, move.q1, T)
        raise InputError(f"a {self.name} law begins and ends at rest; with velocities at the ends take 'cubic'")


def _refuse_unbounded(name: str, move: JointMove, *, smooth: bool) -> None:
    if smooth and move.limits.jerk == inf:
        raise InputError(f"a {name} law needs a bound on the jerk")
    if not smooth and move.limits.acceleration == inf:
        raise InputError(f"a {name} law needs a bound on the acceleration")
    if not smooth and move.limits.jerk < inf:
        raise InputError(f"the acceleration of a {name} law jumps, so that no jerk is its bound; 'double_s' has one")


KINDS: dict[str, LawKind] = {
    kind.name: kind
    for kind in (
        RampsAndCruise("trapezoidal", smooth=False),
        RampsAndCruise("double_s", smooth=True),
        BangBang(),
        Shape("cubic", cubic),
        Shape("quintic", quintic),
        Shape("septic", septic),
        Shape("cosine", cosine, ends_move=False),
        Shape("cycloidal", cycloidal, ends_move=False),
    )
}
