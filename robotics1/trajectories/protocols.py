"""What a timing law and a trajectory are: any object with these methods serves."""

from dataclasses import dataclass
from typing import Any, Literal, Protocol

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array

Side = Literal["right", "left"]


@dataclass(frozen=True)
class Peak:
    """The largest magnitude of a quantity, and the first instant at which it occurs.

    Attributes:
        value: with its sign.
        time: when [s].
    """

    value: float
    time: float


class TimingLaw(Protocol):
    """A scalar motion s(t), 0 ≤ t ≤ T, with three derivatives: a number for a number, (k,) for (k,) times.

    At a switching time a derivative jumps; `side` says from which side its value is taken there, "right" if nothing
    is said. At t = T, where there is no right side, it is the left one, and at t = 0 the right one.
    """

    @property
    def duration(self) -> float:
        """T [s]."""

    @property
    def start(self) -> float:
        """s(0)."""

    @property
    def end(self) -> float:
        """s(T)."""

    @property
    def switching_times(self) -> Array:
        """The instants inside (0, T) at which a derivative jumps [s]."""

    @property
    def peak_velocity(self) -> Peak:
        """Where |ṡ| is largest."""

    @property
    def peak_acceleration(self) -> Peak:
        """Where |s̈| is largest."""

    @property
    def peak_jerk(self) -> Peak:
        """Where |d³s/dt³| is largest, impulses at the switching times apart."""

    def __call__(self, t: npt.ArrayLike) -> Any:
        """Return s(t)."""

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return ṡ(t)."""

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return s̈(t)."""

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return d³s/dt³."""


class Trajectory(Protocol):
    """A motion of n coordinates, 0 ≤ t ≤ T, with three derivatives: (n,) for a number, (k, n) for (k,) times."""

    @property
    def duration(self) -> float:
        """T [s]."""

    def __call__(self, t: npt.ArrayLike) -> Array:
        """Return q(t)."""

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return q̇(t)."""

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return q̈(t)."""

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return the third derivative of q(t)."""


def require_motion(name: str, value: Any, *, derivatives: int = 3) -> Any:
    """Return `value` if it is a trajectory or a timing law, with at least so many derivatives.

    Raises:
        InputError: it lacks what these have.
    """
    methods = ("__call__", "velocity", "acceleration", "jerk")[: derivatives + 1]
    timed = isinstance(getattr(value, "duration", None), int | float)
    if isinstance(value, type) or not timed or not all(callable(getattr(value, f, None)) for f in methods):
        raise InputError(
            f"{name} must be a motion, such as cubic(q0, q1, T), with a duration and {derivatives} derivatives; "
            f"it is {value!r}"
        )
    return value


def require_law(name: str, value: Any) -> Any:
    """Return the timing law of `value`, a law or a motion of one joint.

    Raises:
        InputError: it is neither: no motion, or one of several joints, or a pose's.
    """
    start = require_motion(name, value)(0.0)
    if np.ndim(start) == 0 and not hasattr(start, "rotation"):
        return value
    if np.shape(start) != (1,):
        raise InputError(
            f"{name} must be a timing law s(t), such as cubic(0, L, T).joint(), or of one joint; it is {value!r}"
        )
    return value.joint() if hasattr(value, "joint") else OneJoint(value)


@dataclass(frozen=True, eq=False)
class OneJoint:
    """The timing law of a motion that has one joint and cannot give the law itself.

    Attributes:
        motion: q(t), (1,) for a number.
    """

    motion: Any

    @property
    def duration(self) -> float:
        """T [s]."""
        return float(self.motion.duration)

    @property
    def start(self) -> float:
        """s(0)."""
        return float(self(0.0))

    @property
    def end(self) -> float:
        """s(T)."""
        return float(self(self.duration))

    @property
    def switching_times(self) -> Array:
        """Those of the motion [s]."""
        return np.array(smooth_ends(self.motion)[1:-1])

    def __call__(self, t: npt.ArrayLike) -> Any:
        """Return s(t)."""
        return self.motion(t)[..., 0]

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return ṡ(t)."""
        return self.motion.velocity(t, side=side)[..., 0]

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return s̈(t)."""
        return self.motion.acceleration(t, side=side)[..., 0]

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Any:
        """Return d³s/dt³."""
        return self.motion.jerk(t, side=side)[..., 0]


def number_of_joints(name: str, value: Any, n: int | None = None) -> int:
    """Return n of a trajectory of joints that lasts longer than 0 s, with at least the velocity.

    Raises:
        InputError: it is none, or of another number of joints than a given n.
    """
    start = require_motion(name, value, derivatives=1)(0.0)
    if not isinstance(start, np.ndarray) or start.ndim != 1 or value.duration <= 0:
        raise InputError(f"{name} must be of joints, (n,) numbers at a time, and last longer than 0 s; it is {value!r}")
    if n not in (None, len(start)):
        raise InputError(f"{name} is of {len(start)} joints; the robot has {n}")
    return len(start)


def smooth_ends(trajectory: Any) -> list[float]:
    """Return 0, the switching times of a trajectory or a timing law if it tells them, and its duration.

    Raises:
        InputError: it is no motion with at least two derivatives.
    """
    require_motion("trajectory", trajectory, derivatives=2)
    return [0.0, *np.asarray(getattr(trajectory, "switching_times", ())).tolist(), float(trajectory.duration)]
