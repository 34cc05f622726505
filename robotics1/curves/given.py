"""What is handed in as a curve: a curve, a result that has a trajectory, or a motion of the user's own class."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.curves.curve import Curve
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError, shown
from robotics1.inputs import Array, answer_of


class Motion(Protocol):
    """A motion of n coordinates, 0 ≤ t ≤ T: (n,) for a number, (k, n) for (k,) times. Every `Curve` is one.

    A motion of the user's own class has these and, where they are asked, `acceleration`, `jerk` and `breakpoints`.
    """

    @property
    def duration(self) -> float:
        """T [s]."""

    def __call__(self, t: npt.ArrayLike) -> Any:
        """Return q(t)."""

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return q̇(t)."""


@dataclass(frozen=True, eq=False)
class ForeignMotion(Curve):
    """A motion of the user's own class, with a duration, derivatives, and breakpoints if it has some.

    Attributes:
        motion: it takes (k,) times, and the derivatives take `side`.
    """

    motion: Any

    @cached_property
    def of_points(self) -> bool:
        """Whether the values are numbers or points."""
        start = answer_of("the motion", self.motion, 0.0)
        return isinstance(start, np.ndarray | float | int) and np.ndim(start) < 2

    @property
    def end(self) -> float:
        """The duration [s]."""
        return float(self.motion.duration)

    @cached_property
    def shape(self) -> tuple[int, ...]:
        """That of the velocity."""
        return np.shape(answer_of("the motion's velocity", self.motion.velocity, 0.0))

    @property
    def breakpoints(self) -> Array:
        """Those of the motion, if it has some."""
        return np.asarray(getattr(self.motion, "breakpoints", ()), dtype=float)

    def _value(self, t: Array, side: Side) -> Any:
        return answer_of("the motion", self.motion, t)

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        if order == 0:
            return np.asarray(answer_of("the motion", self.motion, t))
        if order > 3:
            raise InputError(f"derivatives are known up to the third; order is {order}")
        name = ("velocity", "acceleration", "jerk")[order - 1]
        rate = partial(getattr(self.motion, name), side=side)
        return np.asarray(answer_of(f"the motion's {name}", rate, t))


def as_curve(name: str, value: Any, *, derivatives: int = 3) -> Curve:
    """Return the curve that `value` is, or that a result has as its trajectory, or that of the user's own motion.

    Raises:
        InputError: it is none, or has fewer derivatives.
    """
    if not isinstance(value, Curve | type):
        value = getattr(value, "trajectory", value)
    if isinstance(value, Curve):
        return value
    methods = ("__call__", "velocity", "acceleration", "jerk")[: derivatives + 1]
    timed = isinstance(getattr(value, "duration", None), int | float)
    if isinstance(value, type) or not timed or not all(callable(getattr(value, f, None)) for f in methods):
        raise InputError(
            f"{name} must be a motion, such as cubic(q0, q1, T), with a duration and {derivatives} derivatives; "
            f"it is {shown(value)}"
        )
    return ForeignMotion(value)


def as_path(name: str, value: Any, dimensions: tuple[int, ...] = ()) -> Curve:
    """Return a curve of points in Rⁿ, which may be the trajectory of a result.

    Raises:
        InputError: it is none, or of another number of coordinates than those allowed.
    """
    found = as_curve(name, value) if isinstance(value, Curve) or hasattr(value, "trajectory") else None
    if found is None or not found.of_points or len(found.shape) != 1 or not found.end:
        raise InputError(f"{name} must be a path of points, such as line_path(...); it is {shown(value)}")
    if dimensions and found.dimension not in dimensions:
        allowed = " or ".join(map(str, dimensions))
        raise InputError(f"{name} must be a path of {allowed} coordinates; it has {found.dimension}")
    return found


def as_law(name: str, value: Any) -> Curve:
    """Return the timing law of a curve of numbers, or of one coordinate.

    Raises:
        InputError: it is neither: no motion, or one of several joints, or of poses.
    """
    curve = as_curve(name, value)
    if not curve.of_points or curve.shape not in ((), (1,)):
        raise InputError(
            f"{name} must be a timing law s(t), such as cubic(0, L, T), of one joint; it is {shown(value)}"
        )
    return curve.joint() if curve.shape else curve


def joint_motion(name: str, value: Any, n: int | None = None, *, derivatives: int = 1) -> Curve:
    """Return a motion of joints, (n,) numbers at a time, that lasts longer than 0 s.

    Raises:
        InputError: it is none, or of another number of joints than a given n.
    """
    curve = as_curve(name, value, derivatives=derivatives)
    if not curve.of_points or len(curve.shape) != 1 or curve.end <= 0:
        raise InputError(
            f"{name} must be of joints, (n,) numbers at a time, and last longer than 0 s; it is {shown(value)}"
        )
    if n not in (None, curve.dimension):
        raise InputError(f"{name} is of {curve.dimension} joints; the robot has {n}")
    return curve
