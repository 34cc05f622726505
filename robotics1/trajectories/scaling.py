"""Uniform time scaling: a motion slowed down, or sped up, until it just touches its bounds."""

from dataclasses import dataclass
from typing import Any

from robotics1.curves.composition import stretched
from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve
from robotics1.errors import InputError
from robotics1.results import Frozen
from robotics1.trajectories.limits import Limits, LimitUse


@dataclass(frozen=True, eq=False)
class TimeScaling(Frozen):
    """A motion in the shortest time to which its bounds let it be scaled.

    Attributes:
        factor: k = T_new/T; above 1 the motion had to be slowed down.
        trajectory: q(t/k).
        active: the bounds that it touches; they decide k.
        uses: what the motion used of each bound before.
    """

    factor: float
    trajectory: Curve
    active: tuple[LimitUse, ...]
    uses: tuple[LimitUse, ...]

    @property
    def duration(self) -> float:
        """The new duration [s]."""
        return self.trajectory.duration


def scale_to_limits(trajectory: Any, limits: Limits, *, speed_up: bool = True) -> TimeScaling:
    """Return q(t/k) with the least k for which the bounds hold: q̇ is divided by k, q̈ by k².

    k = max over the bounds of max|q̇|/V, √(max|q̈|/A), ∛(max|d³q/dt³|/J), from the exact extremes. All velocities scale,
    those at the ends too; `minimum_duration` keeps those.

    Args:
        trajectory: any, in joint space or Cartesian.
        limits: MotionLimits of the joints, or NormLimits of a point's velocity and acceleration.
        speed_up: whether a motion that has time to spare is sped up to the bounds; else k ≥ 1.

    Raises:
        InputError: nothing moves, or no bound is given, so that every k will do.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 7.7.
    """
    if isinstance(limits, type) or not callable(getattr(limits, "uses", None)):
        raise InputError(f"limits must be MotionLimits(...) or NormLimits(...); it is {limits!r}")
    motion = as_curve("trajectory", trajectory)
    uses = limits.uses(motion)
    k = max((use.stretch for use in uses), default=0.0)
    if not speed_up:
        k = max(k, 1.0)
    if k == 0:
        raise InputError("every duration keeps the bounds: there is none, or nothing moves")
    scaled = stretched(motion, k)
    return TimeScaling(k, scaled, tuple(use for use in limits.uses(scaled) if use.active), uses)
