"""The configurations that a search goes through: a box of joint values, in which whole turns are closed circles."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from math import lcm

import numpy as np
import numpy.typing as npt

from robotics1.angles import TURN, without_turns
from robotics1.errors import InputError, UnknownNameError
from robotics1.inputs import Array, by_name, real_array
from robotics1.results import Frozen
from robotics1.robot.joints import Joint
from robotics1.robot.model import Robot

MOST_TURNS = 12  # of a leader, and so the largest denominator of a multiplier that counts as a fraction
SAME = 1e-12  # difference of a multiplier and the fraction that it is


@dataclass(frozen=True, eq=False)
class JointBox(Frozen):
    """lower ≤ q ≤ upper. A revolute joint that can turn by a whole period is a circle: its value is in the period below
    upper.

    Attributes:
        lower, upper: (n,) [rad or m]; of circles −π and π, or half a period, or what is next to it inside the limits.
        circular: (n,) True where q and q + period are the same place.
        unit: (n,) what counts as one in distances: 1 rad, or the arm's reach [m].
        period: (n,) what a circle is long [rad]: 2π, or as many turns as bring a follower back too.
    """

    lower: Array
    upper: Array
    circular: npt.NDArray[np.bool_]
    unit: Array
    period: Array | float = TURN

    def random(self, rng: np.random.Generator, count: int) -> Array:
        """Return `count` configurations, (count, n), uniform in the box."""
        if np.isfinite(self.upper - self.lower).all():
            return rng.uniform(self.lower, self.upper, (count, len(self.lower)))
        return 2 * rng.uniform(0.5 * self.lower, 0.5 * self.upper, (count, len(self.lower)))

    def nearest(self, q: Array) -> Array:
        """Return q with circular joints turned into (upper − period, upper] and the others moved into their limits."""
        turned = self.upper - (self.upper - q) % self.period
        turned = np.where(turned < self.upper - self.period + 1e-9, self.upper, turned)  # −π, but for rounding, is π
        return np.where(self.circular, turned, np.clip(q, self.lower, self.upper))

    def contains(self, q: Array, tolerance: float = 1e-9) -> bool:
        """Return whether q lies in the box, to a tolerance in units."""
        inside = (q >= self.lower - tolerance * self.unit) & (q <= self.upper + tolerance * self.unit)
        return bool((inside | self.circular).all())

    def widened(self, margin: float) -> JointBox:
        """Return the box with each limit moved out by a margin, in units; circles stay circles."""
        out = np.where(self.circular, 0.0, margin * self.unit)
        return replace(self, lower=self.lower - out, upper=self.upper + out)

    def difference(self, a: Array, b: Array) -> Array:
        """Return a − b in units, the short way round the circles."""
        d = a - b
        return np.where(self.circular, without_turns(d, self.period), d) / self.unit


def joint_box(
    robot: Robot,
    box: Mapping[str, tuple[float, float]] | None = None,
    *,
    unlimited: float | None = None,
    turns: npt.ArrayLike = 1.0,
) -> JointBox:
    """Return the box of the robot's limits, narrowed by `box`: joint name → (lower, upper) [rad or m].

    Args:
        robot: an arm of revolute and prismatic joints.
        box: joint name → (lower, upper).
        unlimited: how far a prismatic joint without limits goes to both sides, in reaches; None refuses it.
        turns: (n,) how many turns of a joint are a circle: more than one where a follower turns by a fraction of its
            angle. A joint that no turns bring back, ∞, without limits, is searched for two turns to both sides.

    Raises:
        UnknownNameError: no such joint.
        InputError: a prismatic joint has no limits, or an interval is empty or outside the limits.
    """
    robot.require_single_coordinates("can be searched")
    lower, upper = intervals(robot, box)
    given = np.isin(robot.joint_names, list(box or {}))
    if unlimited is not None:
        lower = np.where(robot.revolute | np.isfinite(lower), lower, -unlimited * robot.reach)
        upper = np.where(robot.revolute | np.isfinite(upper), upper, unlimited * robot.reach)
    never = robot.revolute & ~np.isfinite(turns)
    low, high = within_two_turns(lower, upper)
    lower = np.where(never & ~np.isfinite(lower), low, lower)
    upper = np.where(never & ~np.isfinite(upper), high, upper)
    period = TURN * np.where(robot.revolute & ~never, turns, 1.0)
    circular = robot.revolute & ~never & (upper - lower >= period - 1e-9)
    turned = circular & ~given
    lower[turned] = np.maximum(lower, np.minimum(-period / 2, upper - period))[turned]
    upper[turned] = (lower + period)[turned]
    refuse_open_ranges(robot, lower, upper)
    return JointBox(lower, upper, circular, robot.units, period)


def within_two_turns(lower: Array, upper: Array) -> tuple[Array, Array]:
    """Return the part of [lower, upper], (n,) each, within two turns of zero; of what ends before, or begins behind
    zero, up to four turns.
    """
    return (
        np.maximum(lower, np.minimum(-2 * TURN, upper - 4 * TURN)),
        np.minimum(upper, np.maximum(2 * TURN, lower + 4 * TURN)),
    )


def nearest_turn(q: Array, around: Array, lower: Array, upper: Array, period: Array | float = TURN) -> Array:
    """Return q moved by whole periods as near to `around` as [lower, upper] allows; all are (n,), or numbers."""
    periods = np.round((around - q) / period)
    least, most = np.ceil((lower - q) / period - 1e-9), np.floor((upper - q) / period + 1e-9)
    return np.asarray(q + period * np.clip(periods, least, most))


def refuse_open_ranges(robot: Robot, lower: Array, upper: Array) -> None:
    """Raise InputError if one of the intervals [lower, upper], (n,), does not end: nobody can search through it."""
    for name, low, high in zip(robot.joint_names, lower, upper, strict=True):
        refuse_open_range(name, low, high)


def refuse_open_range(name: str, lower: float, upper: float) -> None:
    """Raise InputError if the interval of a joint does not end."""
    if not (np.isfinite(lower) and np.isfinite(upper)):
        raise InputError(f"joint {name!r} has no limits: say where to search, as in box={{{name!r}: (-1, 1)}}")


def intervals(robot: Robot, box: Mapping[str, tuple[float, float]] | None = None) -> tuple[Array, Array]:
    """Return the limits of the joints, (n,) and (n,), narrowed by a box; they may be infinite.

    Raises:
        UnknownNameError: no such joint.
        InputError: an interval is empty or outside the limits.
    """
    lower, upper = robot.lower.copy(), robot.upper.copy()
    for name, interval in by_name("box", box, "{'q1': (-1, 1)}").items():
        if name not in robot.joint_names:
            raise UnknownNameError("joint named", name, robot.joint_names)
        i = robot.joint_names.index(name)
        low, high = real_array(f"the interval of {name!r}", interval, (2,), "lower and upper")
        if low > high or low < robot.lower[i] - 1e-9 or high > robot.upper[i] + 1e-9:
            turns = robot.revolute[i] and max(abs(low), abs(high)) > max(TURN, abs(robot.lower[i]), abs(robot.upper[i]))
            raise InputError(
                f"the interval of {name!r} must lie in its limits [{robot.lower[i]:g}, {robot.upper[i]:g}]; "
                f"it is [{low:g}, {high:g}]{'; angles are in radians' * bool(turns)}"
            )
        lower[i], upper[i] = low, high
    return lower, upper


# --- whole turns


def fraction_of(multiplier: float) -> Fraction | None:
    """Return a multiplier as a fraction with a denominator up to 12, or None if it is none: 0.3333 is not 1/3."""
    fraction = Fraction(multiplier).limit_denominator(MOST_TURNS)
    return fraction if abs(float(fraction) - multiplier) <= SAME else None


def turns_of_followers(robot: Robot, frames: Iterable[str | None]) -> Array:
    """Return after how many turns of each joint, (nq,), all joints on the ways to the frames are back.

    Two turns of a leader bring a follower with multiplier 0.5 back. It is 1 for a joint without followers, and for one
    that slides; ∞ where 12 turns are not enough, as with a follower that slides.

    Raises:
        UnknownNameError: there is no such frame.
    """
    turns = np.ones(robot.nq)
    for frame in frames:
        for joint in robot.joints_to(frame) if robot.nq == robot.nv else ():
            if joint.kind == "fixed":
                continue
            i = robot.joint_names.index(joint.leader)
            if robot.revolute[i]:
                turns[i] = _turns_together(turns[i], joint)
    return turns


def _turns_together(turns: float, joint: Joint) -> float:
    """Return after how many turns of its leader a joint is back, with those before it."""
    fraction = fraction_of(joint.multiplier)
    if np.isinf(turns) or fraction is None or (joint.kind == "prismatic" and joint.multiplier != 0):
        return np.inf
    common = lcm(int(turns), fraction.denominator)
    return common if common <= MOST_TURNS else np.inf
