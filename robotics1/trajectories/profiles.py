"""Velocity profiles of two ramps and a cruise between them: trapezoidal, bang-bang, double-S."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import copysign, hypot, inf

import numpy as np
import numpy.typing as npt

from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.curves.stack import JointTrajectory
from robotics1.errors import InputError
from robotics1.inputs import Array, moderate, positive_bound, real_number
from robotics1.trajectories.elementary import boundary
from robotics1.trajectories.ramps import ConstantAcceleration, Phase, Ramp, ramp_under
from robotics1.trajectories.transfer import Transfer

SAME_VELOCITY = 1e-14  # relative: a change of velocity that is rounding


@dataclass(frozen=True, eq=False)
class VelocityProfile(PiecewisePolynomial):
    """A timing law of phases with constant acceleration or jerk.

    Attributes:
        phases: from the first to the last, those without duration too: of a double-S there are seven.
        cruise_velocity: between the two ramps.
        cruise_time: how long it is kept [s]; zero if the ramps meet.
    """

    phases: tuple[Phase, ...] = ()
    cruise_velocity: float = 0.0
    cruise_time: float = 0.0

    def stretched(self, factor: float) -> VelocityProfile:
        """Return s(t/k), slower for k > 1.

        Raises:
            InputError: k is not positive.
        """
        slow, k = super().stretched(factor), float(factor)
        phases = tuple(Phase(k * p.duration, p.acceleration / k**2, p.jerk / k**3) for p in self.phases)
        return VelocityProfile(slow.c, slow.durations, phases, self.cruise_velocity / k, k * self.cruise_time)


def law_of_phases(
    start: float, v0: float, phases: Sequence[Phase], cruise: tuple[float, float] = (0.0, 0.0)
) -> VelocityProfile:
    """Return the law from s(0), ṡ(0) through phases, with this cruise velocity and time."""
    lasting = [([p.acceleration, p.jerk * p.duration], p.duration) for p in phases if p.duration > 0]
    if not lasting:
        law = PiecewisePolynomial.from_pieces([([start, v0], 0.0)])
    else:
        jumps = not any(p.jerk for p in phases)
        accelerations = PiecewisePolynomial.from_pieces([(c[: 2 - jumps], T) for c, T in lasting])
        law = accelerations.integral(v0).integral(start)
    return VelocityProfile(law.c, law.durations, tuple(phases), *cruise)


def profile(start: float, v0: float, v1: float, ramp: Ramp, cruise: tuple[float, float]) -> VelocityProfile:
    """Return the law that goes from v0 to the cruise velocity, keeps it for the cruise time, and goes to v1."""
    velocity, time = cruise
    return law_of_phases(start, v0, (*ramp.phases(v0, velocity), Phase(time, 0.0), *ramp.phases(velocity, v1)), cruise)


def steady(start: float, velocity: float, duration: float) -> VelocityProfile:
    """Return the law of constant velocity; of no duration, it is a state."""
    return law_of_phases(start, velocity, (Phase(duration, 0.0),), (velocity, duration))


def trapezoidal(
    q0: npt.ArrayLike,
    q1: npt.ArrayLike,
    duration: float,
    v0: npt.ArrayLike = 0.0,
    v1: npt.ArrayLike = 0.0,
    *,
    acceleration: npt.ArrayLike | None = None,
    velocity: npt.ArrayLike | None = None,
) -> JointTrajectory:
    """Return the motion of trapezoidal velocity in the duration T, from the acceleration A or the cruise velocity V.

    From rest to rest, with Δ = |q1 − q0| and ramps of duration Ts: Δ = V (T − Ts), V = A Ts. With A given,
    A ≥ 4Δ/T² and Ts = T/2 − √(T²/4 − Δ/A); with V given, Δ/T < V ≤ 2Δ/T. With Ts given, V = Δ/(T − Ts). If both are
    the limits of a joint, T follows from them: `minimum_time`.

    Args:
        q0, q1: (n,) start and end [rad or m].
        duration: T [s].
        v0, v1: (n,) velocities at the start and at the end [rad/s or m/s], or one number for all.
        acceleration: A > 0 [rad/s² or m/s²] of both ramps, (n,) or one number for all.
        velocity: |V| > 0 [rad/s or m/s], in the direction of q1 − q0; a joint that does not move has no use for it.

    Raises:
        InputError: not exactly one of the two is given, or Δ cannot be done in T with it; the message says what can.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 4.2.1.
    """
    ends = boundary(q0, q1, duration, v0=v0, v1=v1)
    if (acceleration is None) == (velocity is None):
        raise InputError("give either the acceleration or the cruise velocity; with a duration, the other follows")
    if acceleration is not None:
        return _each(
            lambda T, s0, d, v, w, A: _lasting(s0, Transfer(d, v, w, ramp_under(A, inf)), T),
            ends,
            acceleration=acceleration,
        )
    return _each(lambda T, s0, d, v, w, V: _cruising(s0, d, (v, w), copysign(V, d), T), ends, velocity=velocity)


def bang_bang(
    q0: npt.ArrayLike, q1: npt.ArrayLike, duration: float, v0: npt.ArrayLike = 0.0, v1: npt.ArrayLike = 0.0
) -> JointTrajectory:
    """Return the motion of acceleration +A, then −A, or the reverse, in the duration T: triangular velocity.

    From rest to rest A = 4Δ/T² and the peak velocity is 2Δ/T at T/2. In general, with Δ = q1 − q0, m = (v0 + v1)/2
    and h = (v1 − v0)/2, the velocity at the switch is Δ/T ± √((Δ/T − m)² + h²), with the sign of Δ/T − m.

    Args:
        q0, q1: (n,) start and end [rad or m].
        duration: T [s].
        v0, v1: (n,) velocities at the start and at the end [rad/s or m/s], or one number for all.

    Raises:
        InputError: shapes that do not agree, or a duration that is not positive.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 3.2.
    """
    ends = boundary(q0, q1, duration, v0=v0, v1=v1)
    return _each(lambda T, s0, d, v, w: bang_bang_law(s0, d, (v, w), T), ends)


def bang_bang_law(start: float, distance: float, ends: tuple[float, float], T: float) -> VelocityProfile:
    """Return the law of one joint with accelerations +A and −A that goes a distance in T, between two velocities."""
    v0, v1 = ends
    excess = distance / T - (v0 + v1) / 2
    peak = distance / T + copysign(hypot(excess, (v1 - v0) / 2), excess)
    change = abs(peak - v0) + abs(peak - v1)
    if change <= SAME_VELOCITY * (abs(v0) + abs(v1)):
        return steady(start, v0, T)
    ramp = ConstantAcceleration(change / T, change / T)
    return profile(start, v0, v1, ramp, (peak, 0.0))


def double_s(
    q0: npt.ArrayLike,
    q1: npt.ArrayLike,
    duration: float,
    v0: npt.ArrayLike = 0.0,
    v1: npt.ArrayLike = 0.0,
    *,
    acceleration: npt.ArrayLike = float("inf"),
    jerk: npt.ArrayLike,
) -> JointTrajectory:
    """Return the motion of seven phases with jerk J, 0, −J, 0, −J, 0, J in the duration T.

    Each ramp raises the acceleration to A, if there is time, keeps it, and lowers it to zero. The cruise velocity V
    follows from T: from rest to rest, with A reached, Δ = V (T − V/A − A/J). `minimum_time` takes V instead of T.

    Args:
        q0, q1: (n,) start and end [rad or m].
        duration: T [s].
        v0, v1: (n,) velocities at the start and at the end [rad/s or m/s], or one number for all.
        acceleration: A > 0 [rad/s² or m/s²], (n,) or one number for all; without it, only the jerk is bounded.
        jerk: J > 0 [rad/s³ or m/s³].

    Raises:
        InputError: Δ cannot be done in T with them; the message says what can.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 3.4.
    """
    return _each(
        lambda T, s0, d, v, w, A, J: _lasting(s0, Transfer(d, v, w, ramp_under(A, J)), T),
        boundary(q0, q1, duration, v0=v0, v1=v1),
        acceleration=acceleration,
        jerk=jerk,
    )


def cruise_profile(
    velocity: float, cruise_time: float, *, acceleration: float, jerk: float = float("inf"), start: float = 0.0
) -> VelocityProfile:
    """Return the rest-to-rest law that reaches a velocity V, keeps it for a time Tv, and stops.

    It goes V (Tv + V/A + A/J) in Tv + 2 (V/A + A/J), if V ≥ A²/J; without a bound on the jerk A/J is zero.

    Args:
        velocity: V, negative to go back.
        cruise_time: Tv ≥ 0 [s].
        acceleration: A > 0, of both ramps.
        jerk: J > 0.
        start: s(0).

    Raises:
        InputError: a number is not what it should be.
    """
    A, J = (
        float(positive_bound(name, bound, 1)[0]) for name, bound in (("acceleration", acceleration), ("jerk", jerk))
    )
    V, Tv = real_number("velocity", velocity), real_number("cruise_time", cruise_time, non_negative=True)
    moderate("velocity, cruise_time and start", np.array([V, Tv, real_number("start", start)]))
    return profile(float(start), 0.0, 0.0, ramp_under(A, J), (V, Tv))


def _lasting(start: float, transfer: Transfer, T: float) -> VelocityProfile:
    return profile(start, transfer.v0, transfer.v1, transfer.ramp, transfer.lasting(T))


def _cruising(start: float, distance: float, ends: tuple[float, float], V: float, T: float) -> VelocityProfile:
    """Return the law with the cruise velocity V, whose ramps of one acceleration A take V T − Δ out of V T.

    1/A = 2 (V T − Δ)/Σᵢ|V − vᵢ|(V − vᵢ), with vᵢ the velocities at the ends.
    """
    v0, v1 = ends
    changes = abs(V - v0) * (V - v0) + abs(V - v1) * (V - v1)
    if V in (inf, -inf):
        raise InputError("a cruise velocity must be finite")
    if distance == v0 == v1 == 0 or changes == V * T - distance == 0:
        return steady(start, v0, T)
    inverse = 2 * (V * T - distance) / changes if changes else -1.0
    rest = T - (abs(V - v0) + abs(V - v1)) * inverse
    if inverse <= 0 or rest < -1e-12 * T:
        more = f"; from rest to rest it is between {abs(distance) / T:g} and {2 * abs(distance) / T:g}"
        raise InputError(
            f"with the cruise velocity {V:g} the distance {distance:g} cannot take {T:g} s" + more * (v0 == v1 == 0)
        )
    return profile(start, v0, v1, ConstantAcceleration(1 / inverse, 1 / inverse), (V, max(0.0, rest)))


def _each(
    law: Callable[..., VelocityProfile], ends: tuple[float, list[Array]], **bounds: npt.ArrayLike | None
) -> JointTrajectory:
    """Return law(T, q0, Δ, v0, v1, bounds...) of each joint, the bounds being positive."""
    T, states = ends
    limits = [positive_bound(name, value, len(states[0])) for name, value in bounds.items()]
    columns = np.array([*states, *limits]).T.tolist()
    return JointTrajectory(tuple(law(T, *row) for row in columns))
