"""The kinds of timing laws: for each the shortest durations of one joint, and its law."""

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, sqrt
from typing import Any

from robotics1.errors import InputError
from robotics1.trajectories.laws.given_duration import bang_bang_law
from robotics1.trajectories.laws.profiles import ProfileLaw, profile, steady
from robotics1.trajectories.laws.ramps import ramp_under
from robotics1.trajectories.laws.transfer import Transfer
from robotics1.trajectories.laws.trigonometric import cosine, cycloidal
from robotics1.trajectories.limits.joint_move import SAME_DURATION, JointMove, LawKind
from robotics1.trajectories.limits.minimum_duration import shortest_duration
from robotics1.trajectories.limits.motion_limits import MotionLimits
from robotics1.trajectories.polynomials.polynomial import cubic, quintic, septic
from robotics1.trajectories.protocols import TimingLaw, Trajectory


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

    def lasting(self, move: JointMove, duration: float) -> TimingLaw:
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

    def _fastest(self, move: JointMove) -> ProfileLaw:
        transfer = self._transfer(move)
        return profile(move.q0, move.v0, move.v1, transfer.ramp, transfer.fastest())

    def _transfer(self, move: JointMove) -> Transfer:
        _refuse_unbounded(self.name, move, smooth=self.smooth)
        ramp = ramp_under(move.acceleration, move.jerk, move.deceleration)
        return Transfer(move.q1 - move.q0, move.v0, move.v1, ramp, move.velocity)


@dataclass(frozen=True)
class BangBang:
    """Acceleration A, then −A, or the reverse, without a cruise: of a longer duration A is smaller."""

    name: str = "bang-bang"

    def next_duration(self, move: JointMove, at_least: float) -> float:
        """Return the given duration or the least at which a bound is touched, whichever first keeps both bounds.

        With p the velocity at the switch and e = (v0² + v1²)/2: |q̈| = A where p² = e ± A Δ and T = |2p − v0 − v1|/A;
        p = ±V where T = Δ (2p − v0 − v1)/(p² − e).
        """
        _refuse_unbounded(self.name, move, smooth=False)
        if move.deceleration != move.acceleration:
            raise InputError("a bang-bang law has one acceleration; 'trapezoidal' brakes with another")
        if move.stays(at_least):
            return at_least
        A, V, v0, v1, distance = move.acceleration, move.velocity, move.v0, move.v1, move.q1 - move.q0
        e = (v0**2 + v1**2) / 2
        squares = [e + A * distance, e - A * distance]
        durations = [
            abs(2 * p - v0 - v1) / A for square in squares if square >= 0 for p in (sqrt(square), -sqrt(square))
        ]
        durations += [distance * (2 * p - v0 - v1) / (V**2 - e) for p in (V, -V) if e < V**2 < inf]
        durations += [2 * distance / (v0 + v1)] if v0 + v1 else []  # without a switch, as from V to V
        for T in sorted([at_least, *(T for T in durations if at_least < T)]):
            if T > 0 and self._keeps(move, T):
                return T
        raise InputError("no bang-bang law keeps the bounds; 'trapezoidal' does")

    def lasting(self, move: JointMove, duration: float) -> TimingLaw:
        """Return the law of a duration."""
        if duration == 0:
            return steady(move.q0, move.v0, 0.0)
        return bang_bang_law(move.q0, move.q1 - move.q0, (move.v0, move.v1), duration)

    def _keeps(self, move: JointMove, T: float) -> bool:
        law = bang_bang_law(0.0, move.q1 - move.q0, (move.v0, move.v1), T)
        peaks = abs(law.peak_velocity.value) / move.velocity, abs(law.peak_acceleration.value) / move.acceleration
        return max(peaks) <= 1 + 1e-9


@dataclass(frozen=True)
class Shape:
    """A polynomial or trigonometric law: its shape is that of its boundary values.

    Attributes:
        name: of the kind.
        motion: the motion of one joint, of (q0, q1, T, v0, v1) or (q0, q1, T).
        ends_move: whether it takes velocities at the ends.
    """

    name: str
    motion: Callable[..., Trajectory]
    ends_move: bool = True

    def next_duration(self, move: JointMove, at_least: float) -> float:
        """Return the least duration with which the exact extremes keep the bounds."""
        if move.deceleration != move.acceleration:
            raise InputError(f"a {self.name} law has one bound on the acceleration; 'trapezoidal' brakes with another")
        if move.stays(at_least):
            return at_least
        limits = MotionLimits(move.velocity, move.acceleration, move.jerk)
        return shortest_duration(self._of(move), limits, at_least=at_least)

    def lasting(self, move: JointMove, duration: float) -> TimingLaw:
        """Return the law of a duration."""
        if duration == 0:
            return steady(move.q0, move.v0, 0.0)
        law: TimingLaw = self._of(move)(duration).joint()
        return law

    def _of(self, move: JointMove) -> Callable[[float], Any]:
        if self.ends_move:
            return lambda T: self.motion(move.q0, move.q1, T, move.v0, move.v1)
        if move.is_rest_to_rest:
            return lambda T: self.motion(move.q0, move.q1, T)
        raise InputError(f"a {self.name} law begins and ends at rest; with velocities at the ends take 'cubic'")


def _refuse_unbounded(name: str, move: JointMove, *, smooth: bool) -> None:
    if smooth and move.jerk == inf:
        raise InputError(f"a {name} law needs a bound on the jerk")
    if not smooth and move.acceleration == inf:
        raise InputError(f"a {name} law needs a bound on the acceleration")
    if not smooth and move.jerk < inf:
        raise InputError(f"the acceleration of a {name} law jumps, so that no jerk is its bound; 'double-S' has one")


KINDS: dict[str, LawKind] = {
    kind.name: kind
    for kind in (
        RampsAndCruise("trapezoidal", smooth=False),
        RampsAndCruise("double-S", smooth=True),
        BangBang(),
        Shape("cubic", cubic),
        Shape("quintic", quintic),
        Shape("septic", septic),
        Shape("cosine", cosine, ends_move=False),
        Shape("cycloidal", cycloidal, ends_move=False),
    )
}
