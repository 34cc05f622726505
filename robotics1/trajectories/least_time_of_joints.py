"""Minimum time under the bounds of the joints: each as fast as it can, all in the time of the slowest, or in line."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import inf
from typing import Literal

import numpy as np
import numpy.typing as npt

from robotics1.curves.curve import Curve
from robotics1.curves.stack import JointTrajectory
from robotics1.errors import InputError
from robotics1.inputs import LARGEST, Array, joint_numbers, joint_rates, one_of
from robotics1.results import Frozen
from robotics1.trajectories.law_kinds import KINDS, SAME_DURATION, JointMove, LawKind
from robotics1.trajectories.limits import BOUNDS, LimitUse, MotionLimits

Coordination = Literal["synchronized", "straight", "independent"]
Law = Literal["trapezoidal", "double_s", "bang_bang", "cubic", "quintic", "septic", "cosine", "cycloidal"]
COORDINATIONS = ("synchronized", "straight", "independent")


@dataclass(frozen=True, eq=False)
class MinimumTime(Frozen):
    """The fastest motion of some kind under bounds, and what decides its time.

    Attributes:
        duration: T [s].
        trajectory: q(t), one law for each joint.
        joint_durations: (n,) the least that each joint needs by itself [s].
        active: the bounds that the motion touches.
    """

    duration: float
    trajectory: JointTrajectory
    joint_durations: Array
    active: tuple[LimitUse, ...]

    @property
    def laws(self) -> tuple[Curve, ...]:
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
    law: Law = "trapezoidal",
    *,
    v0: npt.ArrayLike = 0.0,
    v1: npt.ArrayLike = 0.0,
    coordination: Coordination = "synchronized",
) -> MinimumTime:
    """Return the motion from (q0, v0) to (q1, v1) of the shortest duration, for one kind of timing law.

    From rest to rest over Δ: trapezoidal T = Δ/V + V/A if Δ ≥ V²/A, else 2√(Δ/A); double-S T = Δ/V + V/A + A/J if
    V ≥ A²/J and Δ ≥ V²/A + VA/J; cubic T = max(3Δ/2V, √(6Δ/A)); quintic T = max(15Δ/8V, √(10Δ/√3 A)). A start away
    from the goal brakes, turns and comes back. No motion under the same bounds is faster than the trapezoidal one; and
    none that begins and ends without acceleration, than the double-S.

    "synchronized": all joints take the time T of the slowest; the others are stretched uniformly, or cruise more slowly
    if they have velocities at the ends. "straight": one law s(t) for all, q = q0 + s (q1 − q0), from rest to rest.
    "independent": each joint is as fast as it can, and then stays.

    Args:
        q0, q1: (n,) start and end [rad or m].
        limits: the bounds of the joints; the acceleration for trapezoidal and bang-bang, the jerk for double-S.
        law: "trapezoidal", "double_s", "bang_bang", "cubic", "quintic", "septic", "cosine" or "cycloidal".
        v0, v1: (n,) velocities at the start and at the end [rad/s or m/s], or one number for all.
        coordination: "synchronized", "straight" or "independent".

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
    ends = [_inside(name, joint_rates(name, v, n), bounds.velocity) for name, v in (("v0", v0), ("v1", v1))]
    states = np.array([start, end, *ends]).T.tolist()
    moves = [JointMove(q, r, v, w, bounds.of_joint(j)) for j, (q, r, v, w) in enumerate(states)]
    durations = [kind.next_duration(move, 0.0) for move in moves]
    if coordination == "straight":
        laws = _in_line(kind, moves)
    elif coordination == "synchronized":
        laws = _together(kind, moves, max(durations))
    else:
        laws = [kind.lasting(move, T) for move, T in zip(moves, durations, strict=True)]
    trajectory = JointTrajectory(tuple(laws))
    active = tuple(use for use in limits.uses(trajectory) if use.active)
    return MinimumTime(trajectory.duration, trajectory, np.array(durations), active)


def _together(kind: LawKind, moves: list[JointMove], T: float) -> list[Curve]:
    """Return laws of one duration: the least, from T upwards, that is possible for all joints."""
    while (longer := max(kind.next_duration(move, T) for move in moves)) > T * (1 + SAME_DURATION):
        T = longer
    return [kind.lasting(move, T) for move in moves]


def _in_line(kind: LawKind, moves: list[JointMove]) -> list[Curve]:
    """Return q0 + s (q1 − q0) with one s(t) from 0 to 1, under the tightest of the bounds divided by |Δ|.

    A joint's law is that of the kind under the same share of all its bounds.
    """
    if not all(move.is_rest_to_rest for move in moves):
        raise InputError("a straight line in joint space is for motions from rest to rest; leave out v0 and v1")
    distances = [abs(move.q1 - move.q0) for move in moves]
    if not any(distances):
        return [kind.lasting(move, 0.0) for move in moves]
    tightest = _each_bound(
        lambda *bounds: min(bound / distance for bound, distance in zip(bounds, distances, strict=True) if distance),
        *(move.limits for move in moves),
    )
    T = kind.next_duration(JointMove(0.0, 1.0, 0.0, 0.0, tightest), 0.0)
    shares = [
        replace(move, limits=_each_bound(lambda bound, distance=distance: distance * bound, tightest))
        if distance
        else move
        for move, distance in zip(moves, distances, strict=True)
    ]
    return [kind.lasting(move, T) for move in shares]


def _each_bound(of: Callable[..., float], *limits: MotionLimits) -> MotionLimits:
    """Return the limits whose bounds are made of the same bound of others, within the range of bounds."""
    columns = [[getattr(one, name) for one in limits] for name in BOUNDS]
    bounds = [None if None in column else of(*column) for column in columns]
    return MotionLimits(*(x if x in (None, inf) else min(max(x, 1 / LARGEST), LARGEST) for x in bounds))


def _inside(name: str, v: Array, bound: Array) -> Array:
    """Return the velocities at an end, if they are within the bounds."""
    beyond = np.flatnonzero(np.abs(v) > bound * (1 + SAME_DURATION))
    if beyond.size:
        j = int(beyond[0])
        raise InputError(f"{name} of joint {j} is {v[j]:g}, beyond its bound {bound[j]:g}; it must be within")
    return np.clip(v, -bound, bound)
