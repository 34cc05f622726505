"""Minimum time under the bounds of the joints: each as fast as it can, all in the time of the slowest, or in line."""

from dataclasses import dataclass, replace

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, one_of
from robotics1.trajectories.composition.joint_laws import JointLaws
from robotics1.trajectories.limits.demands import Demand
from robotics1.trajectories.limits.joint_move import SAME_DURATION, JointMove, LawKind
from robotics1.trajectories.limits.law_kinds import KINDS
from robotics1.trajectories.limits.motion_limits import MotionLimits
from robotics1.trajectories.protocols import TimingLaw
from robotics1.trajectories.quantities import joint_numbers, joint_rates

BOUNDS = ("velocity", "acceleration", "jerk", "deceleration")
COORDINATIONS = ("slowed", "straight", "independent")


@dataclass(frozen=True, eq=False)
class MinimumTime:
    """The fastest motion of some kind under bounds, and what decides its time.

    Attributes:
        duration: T [s].
        trajectory: q(t), one law for each joint.
        joint_durations: (n,) the least that each joint needs by itself [s].
        active: the bounds that the motion touches.
    """

    duration: float
    trajectory: JointLaws
    joint_durations: Array
    active: tuple[Demand, ...]

    @property
    def laws(self) -> tuple[TimingLaw, ...]:
        """The laws of the joints."""
        return self.trajectory.laws

    @property
    def slack(self) -> Array:
        """(n,) T less what each joint needs [s]: zero for the slowest."""
        return self.duration - self.joint_durations

    @property
    def unique(self) -> bool:
        """Whether every joint needs all the time; a joint with slack can move in many ways within T."""
        return bool((self.slack <= 1e-9 * self.duration).all())


def minimum_time(
    q0: npt.ArrayLike,
    q1: npt.ArrayLike,
    limits: MotionLimits,
    law: str = "trapezoidal",
    *,
    v0: npt.ArrayLike = 0.0,
    v1: npt.ArrayLike = 0.0,
    coordination: str = "slowed",
) -> MinimumTime:
    """Return the motion from (q0, v0) to (q1, v1) of the shortest duration, for one kind of timing law.

    From rest to rest over Δ: trapezoidal T = Δ/V + V/A if Δ ≥ V²/A, else 2√(Δ/A); double-S T = Δ/V + V/A + A/J if
    V ≥ A²/J and Δ ≥ V²/A + VA/J; cubic T = max(3Δ/2V, √(6Δ/A)); quintic T = max(15Δ/8V, √(10Δ/√3 A)). A start away
    from the goal brakes, turns and comes back. No motion under the same bounds is faster than the trapezoidal one; and
    none that begins and ends without acceleration, than the double-S.

    "slowed": all joints take the time T of the slowest; the others are stretched uniformly, or cruise more slowly if
    they have velocities at the ends. "straight": one law s(t) for all, q = q0 + s (q1 − q0), from rest to rest.
    "independent": each joint is as fast as it can, and then stays.

    Args:
        q0, q1: (n,) start and end [rad or m].
        limits: the bounds of the joints; the acceleration for trapezoidal and bang-bang, the jerk for double-S.
        law: "trapezoidal", "double-S", "bang-bang", "cubic", "quintic", "septic", "cosine" or "cycloidal".
        v0, v1: (n,) velocities at the start and at the end [rad/s or m/s], or one number for all.
        coordination: "slowed", "straight" or "independent".

    Raises:
        InputError: a velocity at an end is beyond its bound, the kind of law cannot keep such bounds, or shapes do not
            agree.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, chapter 3.
    """
    start = joint_numbers("q0", q0)
    n = len(start)
    if n == 0:
        raise InputError("q0 must have one number for each joint; it is empty")
    end = joint_numbers("q1", q1, n)
    if not isinstance(limits, MotionLimits):
        raise InputError(f"limits must be MotionLimits(velocity=..., acceleration=...); it is {limits!r}")
    kind = KINDS[one_of("law", law, tuple(KINDS))]
    one_of("coordination", coordination, COORDINATIONS)
    bounds = limits.of_joints(n)
    ends = [_inside(name, joint_rates(name, v, n), bounds["velocity"]) for name, v in (("v0", v0), ("v1", v1))]
    rows = np.array([start, end, *ends, *(bounds[name] for name in BOUNDS)]).T.tolist()
    moves = [JointMove(*row) for row in rows]
    durations = [kind.next_duration(move, 0.0) for move in moves]
    if coordination == "straight":
        laws = _in_line(kind, moves)
    elif coordination == "slowed":
        laws = _together(kind, moves, max(durations))
    else:
        laws = [kind.lasting(move, T) for move, T in zip(moves, durations, strict=True)]
    trajectory = JointLaws(tuple(laws))
    active = tuple(demand for demand in limits.demands(trajectory) if demand.active)
    return MinimumTime(trajectory.duration, trajectory, np.array(durations), active)


def _together(kind: LawKind, moves: list[JointMove], T: float) -> list[TimingLaw]:
    """Return laws of one duration: the least, from T upwards, that is possible for all joints."""
    while (longer := max(kind.next_duration(move, T) for move in moves)) > T * (1 + SAME_DURATION):
        T = longer
    return [kind.lasting(move, T) for move in moves]


def _in_line(kind: LawKind, moves: list[JointMove]) -> list[TimingLaw]:
    """Return q0 + s (q1 − q0) with one s(t) from 0 to 1, under the tightest of the bounds divided by |Δ|.

    A joint's law is that of the kind under the same share of all its bounds.
    """
    if not all(move.is_rest_to_rest for move in moves):
        raise InputError("a straight line in joint space is for motions from rest to rest; leave out v0 and v1")
    distances = [abs(move.q1 - move.q0) for move in moves]
    if not any(distances):
        return [kind.lasting(move, 0.0) for move in moves]
    tightest = {
        name: min(getattr(move, name) / distance for move, distance in zip(moves, distances, strict=True) if distance)
        for name in BOUNDS
    }
    T = kind.next_duration(JointMove(0.0, 1.0, 0.0, 0.0, **tightest), 0.0)
    return [
        kind.lasting(
            replace(move, **{name: distance * bound for name, bound in tightest.items()}) if distance else move, T
        )
        for move, distance in zip(moves, distances, strict=True)
    ]


def _inside(name: str, v: Array, bound: Array) -> Array:
    """Return the velocities at an end, if they are within the bounds."""
    beyond = np.flatnonzero(np.abs(v) > bound * (1 + SAME_DURATION))
    if beyond.size:
        j = int(beyond[0])
        raise InputError(f"{name} of joint {j} is {v[j]:g}, beyond its bound {bound[j]:g}; it must be within")
    return np.clip(v, -bound, bound)
