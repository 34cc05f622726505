"""Bounds on a motion, what a motion uses of them, and where it leaves the limits of a robot."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve, joint_motion
from robotics1.errors import InputError
from robotics1.inputs import positive_bound
from robotics1.robot.given import RobotLike, robot_from
from robotics1.trajectories.norms import Norm, peak_norm

ORDERS = {"position": 0, "velocity": 1, "acceleration": 2, "jerk": 3, "deceleration": 2, "normal acceleration": 2}
BOUNDS = ("velocity", "acceleration", "jerk", "deceleration")
TOUCHED = 1e-6  # relative: a bound so nearly reached is active
ROUNDING = 1e-9  # of the limit, or of the joint's own largest value: a smaller excess is rounding


@dataclass(frozen=True)
class LimitUse:
    """The most that a motion uses of one limit.

    Attributes:
        joint: its number, from 0, or its name, of a robot; None for the norm of a vector.
        quantity: "position", "velocity", "acceleration", "jerk", "deceleration" or "normal acceleration".
        value: what the motion reaches, with its sign; a norm has none.
        limit: what it should not pass.
        time: the first instant [s].
    """

    joint: int | str | None
    quantity: str
    value: float
    limit: float
    time: float

    @property
    def stretch(self) -> float:
        """k: the motion just touches the limit if it takes k times as long; (|value|/limit)^(1/order)."""
        return float((abs(self.value) / self.limit) ** (1 / ORDERS[self.quantity]))

    @property
    def active(self) -> bool:
        """Whether the limit is touched, to a relative 1e-6, or passed."""
        return abs(self.value) >= (1 - TOUCHED) * abs(self.limit)

    def __str__(self) -> str:
        if isinstance(self.joint, str):
            return (
                f"the {self.quantity} of {self.joint} is {self.value:.4g} at t = {self.time:.4g} s, "
                f"beyond its limit {self.limit:.4g}"
            )
        whose = "the norm of the" if self.joint is None else f"joint {self.joint}'s"
        return f"{whose} {self.quantity} is {self.value:.6g} at t = {self.time:.4g} s, its limit {self.limit:g}"


class Limits(Protocol):
    """Bounds that a motion can be held against: MotionLimits or NormLimits."""

    def uses(self, trajectory: Any) -> tuple[LimitUse, ...]:
        """Return the most that a motion uses of each bound, from its exact extremes."""


@dataclass(frozen=True, eq=False)
class MotionLimits:
    """Bounds |q̇| ≤ V, |q̈| ≤ A, |d³q/dt³| ≤ J of each joint; None or infinity for no bound.

    Attributes:
        velocity: V [rad/s or m/s], (n,) or one number for all.
        acceleration: A [rad/s² or m/s²]; with a deceleration, the bound while the speed grows.
        jerk: J [rad/s³ or m/s³].
        deceleration: the bound on |q̈| while the speed falls, if it is another; for constant accelerations only.
    """

    velocity: Any = None
    acceleration: Any = None
    jerk: Any = None
    deceleration: Any = None

    def __post_init__(self) -> None:
        """Refuse bounds that are not positive."""
        for name in BOUNDS:
            positive_bound(name, getattr(self, name))
        if self.deceleration is not None and self.acceleration is None:
            raise InputError("a bound on the deceleration needs one on the acceleration too")

    def of_joints(self, n: int) -> MotionLimits:
        """Return the bounds of n joints, (n,) each, infinity for none; a deceleration only if it has its own bound.

        Raises:
            InputError: they are for another number of joints.
        """
        V, A, J, D = (positive_bound(name, getattr(self, name), n) for name in BOUNDS)
        return MotionLimits(V, A, J, None if self.deceleration is None else D)

    def of_joint(self, j: int) -> MotionLimits:
        """Return the bounds of one joint as numbers, of those that `of_joints` returned."""
        return MotionLimits(*(None if x is None else float(x[j]) for x in (getattr(self, name) for name in BOUNDS)))

    def uses(self, trajectory: Any) -> tuple[LimitUse, ...]:
        """Return the most that a motion uses of each bound, from its exact extremes.

        Raises:
            InputError: the bounds are for another number of joints, or the deceleration has one of its own and the
                accelerations are not constant between the breakpoints.
        """
        motion = as_curve("trajectory", trajectory)
        if not motion.of_points:
            raise InputError("MotionLimits bound joints; NormLimits(rows=...) bounds the norms of a pose's motion")
        bounds = self.of_joints(motion.dimension)
        found: list[LimitUse] = []
        for order, quantity in enumerate(BOUNDS[:3], start=1):
            if quantity == "acceleration" and self.deceleration is not None:
                found += _growing_and_falling(motion, bounds)
                continue
            bound = getattr(bounds, quantity)
            if np.isfinite(bound).any():
                peaks = motion.peaks(order)
                found += [
                    LimitUse(j, quantity, peak.value, float(bound[j]), peak.time)
                    for j, peak in enumerate(peaks)
                    if np.isfinite(bound[j])
                ]
        return tuple(found)


@dataclass(frozen=True)
class NormLimits:
    """Bounds on |ṗ|, |p̈|, |d³p/dt³| and on the normal acceleration κ|ṗ|² of a point's motion; None for no bound.

    Attributes:
        velocity: [m/s].
        acceleration: [m/s²].
        jerk: [m/s³].
        normal_acceleration: [m/s²], across the path.
        rows: which coordinates make the norm; slice(0, 3) is the linear part of a pose's motion. By default all.
    """

    velocity: float | None = None
    acceleration: float | None = None
    jerk: float | None = None
    normal_acceleration: float | None = None
    rows: slice | None = None

    def __post_init__(self) -> None:
        """Refuse bounds that are not positive."""
        for name in ("velocity", "acceleration", "jerk", "normal_acceleration"):
            positive_bound(name, getattr(self, name), 1)

    def uses(self, trajectory: Any) -> tuple[LimitUse, ...]:
        """Return the largest norms, from exact extremes.

        Raises:
            InputError: the motion turns too sharply, or oscillates too quickly, for them to be found.
        """
        found = []
        quantities: tuple[Norm, ...] = ("velocity", "acceleration", "jerk", "normal acceleration")
        for quantity in quantities:
            name = quantity.replace(" ", "_")
            bound = float(positive_bound(name, getattr(self, name), 1)[0])
            if bound < np.inf:
                peak = peak_norm(trajectory, quantity, rows=self.rows)
                if not peak.resolved:
                    raise InputError(
                        "the motion turns too sharply, or oscillates too quickly, for its largest "
                        f"{quantity} to be found"
                    )
                found.append(LimitUse(None, quantity, peak.value, bound, peak.time))
        return tuple(found)


def limit_violations(robot: RobotLike, trajectory: Any, limits: MotionLimits | None = None) -> tuple[LimitUse, ...]:
    """Return where q(t) leaves [lower, upper] or a derivative exceeds its limit, from the exact extremes.

    Args:
        robot: its joints' limits of position and velocity count.
        trajectory: of its joints.
        limits: more limits, on velocity, acceleration and jerk; of two on the velocity the smaller counts.

    Raises:
        InputError: the trajectory or the limits are of another number of joints.
    """
    robot = robot_from(robot)
    motion = joint_motion("trajectory", trajectory, robot.nv)
    if limits is not None and not isinstance(limits, MotionLimits):
        raise InputError(f"limits must be MotionLimits(acceleration=..., jerk=...); it is {limits!r}")
    more = (limits or MotionLimits()).of_joints(robot.nv)
    velocity = np.minimum(robot.max_velocity, more.velocity)
    bounds = [("position", robot.lower, robot.upper), ("velocity", -velocity, velocity)]
    bounds += [("acceleration", -more.acceleration, more.acceleration), ("jerk", -more.jerk, more.jerk)]
    found = []
    for order, (quantity, lower, upper) in enumerate(bounds):
        if not np.isfinite([lower, upper]).any():
            continue
        times, values = motion.extremes(order)
        for i, name in enumerate(robot.joint_names):
            for row, limit, sign in ((0, float(lower[i]), -1), (1, float(upper[i]), 1)):
                value, rounding = float(values[row, i]), ROUNDING * max(abs(limit), np.abs(values[:, i]).max())
                if np.isfinite(limit) and sign * (value - limit) > rounding:
                    found.append(LimitUse(name, quantity, value, limit, float(times[row, i])))
    return tuple(found)


# --- accelerations that make the speed grow, and those that make it fall


def _growing_and_falling(motion: Curve, bounds: MotionLimits) -> Iterator[LimitUse]:
    """Yield what constant accelerations use of A where the speed grows, and of D where it falls.

    Raises:
        InputError: the accelerations are not constant between the breakpoints.
    """
    ends = np.array(motion.ends)
    starts, durations = ends[:-1], np.diff(ends)
    early, late = starts + durations / 4, starts + durations * 3 / 4
    shape = (len(starts), motion.dimension)
    a, last = (np.reshape(motion.acceleration(t), shape) for t in (early, late))
    if np.abs(a - last).max(initial=0.0) > 1e-9 * np.abs(a).max(initial=0.0):
        raise InputError("a bound of its own on the deceleration is for constant accelerations: trapezoidal velocities")
    v = np.reshape(motion.velocity(early), shape) - a * durations[:, None] / 4
    for j in range(motion.dimension):
        for quantity, sign in (("acceleration", 1), ("deceleration", -1)):
            during = [_where(sign, *phase) for phase in zip(v[:, j], a[:, j], starts, ends[1:], strict=True)]
            size = np.where([t is None for t in during], 0.0, np.abs(a[:, j]))
            i = int(np.argmax(size))
            if size[i] > 0:
                yield LimitUse(j, quantity, float(a[i, j]), float(getattr(bounds, quantity)[j]), float(during[i] or 0))


def _where(sign: int, v: float, a: float, start: float, end: float) -> float | None:
    """Return the first instant of a phase at which the speed grows (sign 1) or falls (sign −1), if there is one.

    Where the velocity comes to zero at an end, but for rounding, it does not change its sign.
    """
    turn = start - v / a if v * a < 0 else start  # until then the speed falls
    rounding = 1e-9 * end
    if sign < 0:
        return start if turn > start + rounding else None
    return turn if turn < end - rounding else None
