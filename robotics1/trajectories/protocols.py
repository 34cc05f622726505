"""What a timing law and a trajectory are: any object with these methods serves."""

from dataclasses import dataclass
from typing import Any, Literal, Protocol

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


def require_motion(name: str, value: Any) -> Any:
    """Return `value` if it is a trajectory or a timing law.

    Raises:
        InputError: it lacks what these have.
    """
    needed = ("__call__", "velocity", "acceleration", "jerk")
    if (
        isinstance(value, type)
        or not hasattr(value, "duration")
        or not all(callable(getattr(value, f, None)) for f in needed)
    ):
        raise InputError(f"{name} must be a motion, such as cubic(q0, q1, T), with its derivatives; it is {value!r}")
    return value
