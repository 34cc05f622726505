"""The largest speed, acceleration and normal acceleration of a motion: exact extrema, not samples."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, one_of
from robotics1.paths.interpolants import largest
from robotics1.trajectories.protocols import Peak, Side, require_motion, smooth_ends

NORMS = ("velocity", "acceleration", "jerk", "tangential acceleration", "normal acceleration")

ROUNDING = 1e-12  # of the acceleration: a part as small as this is none


@dataclass(frozen=True, eq=False)
class AccelerationSplit:
    """An acceleration as the sum of two, along the motion and across it: p̈ = a_t t + κ |ṗ|² n.

    Attributes:
        tangential: (n,) or (k, n), a_t t with a_t = d|ṗ|/dt: it changes the speed.
        normal: (n,) or (k, n), κ |ṗ|² n: it turns the velocity.
    """

    tangential: Array
    normal: Array


def acceleration_split(trajectory: Any, t: npt.ArrayLike, *, side: Side = "right") -> AccelerationSplit:
    """Return the tangential and the normal part of p̈ at the time t, or at (k,) times.

    At rest the acceleration is all tangential: κ |ṗ|² = 0.

    Args:
        trajectory: any with velocity and acceleration.
        t: [s].
        side: at a switching time, from which side: "right" or "left".

    Raises:
        InputError: a time is outside the trajectory.
    """
    require_motion("trajectory", trajectory, derivatives=2)
    v = np.asarray(trajectory.velocity(t, side=side))
    a = np.asarray(trajectory.acceleration(t, side=side))
    if np.ndim(trajectory.velocity(0.0)) == 0:
        raise InputError("a timing law has no direction; split the acceleration of a motion along a path")
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    unit = v / np.where(speed > 0, speed, 1.0)
    along = np.sum(a * unit, axis=-1, keepdims=True) * unit
    tangential = np.where(speed > 0, along, a)
    return AccelerationSplit(tangential, a - tangential)


@dataclass(frozen=True)
class NormPeak(Peak):
    """The largest norm, and the first instant at which it occurs.

    Attributes:
        value: never negative.
        time: when [s].
        resolved: whether the interpolants behind it have converged, so that no larger value is missed.
    """

    resolved: bool


def peak_norm(trajectory: Any, quantity: str = "velocity", *, rows: slice | None = None) -> NormPeak:
    """Return where |ṗ|, |p̈|, or another norm of a motion is largest over its whole duration.

    Between the switching times the square of the norm is a smooth function of t. It is replaced by Chebyshev
    interpolants that agree with it to rounding, and its largest value is at an end or where their derivative vanishes:
    for polynomial laws on lines, arcs and helices, where it is a polynomial, this is the closed form.

    Args:
        trajectory: a path with a timing law, a joint trajectory, or any other.
        quantity: "velocity", "acceleration", "jerk", "tangential acceleration" or "normal acceleration".
        rows: which coordinates count, as slice(0, 3) for the linear part of a pose's motion; by default all.

    Raises:
        InputError: the quantity is none of these, or rows is no slice.
    """
    one_of("quantity", quantity, NORMS)
    if rows is not None and not isinstance(rows, slice):
        raise InputError(f"rows must be a slice, such as slice(0, 3); it is {rows!r}")

    def square(t: Array, side: Side) -> Array:
        vector = _vector(trajectory, quantity, t, side).reshape(len(t), -1)[:, rows or slice(None)]
        return np.asarray(np.sum(vector**2, axis=1))

    ends = smooth_ends(trajectory)
    parts = quantity.endswith(" acceleration")  # a part that vanishes is the rounding of the whole
    whole = peak_norm(trajectory, "acceleration", rows=rows).value if parts else 0.0
    found = largest(square, ends, floor=(ROUNDING * whole) ** 2)
    return NormPeak(float(np.sqrt(found.value)), found.at, found.resolved)


def _vector(trajectory: Any, quantity: str, t: Array, side: Side) -> Array:
    kind, _, of = quantity.rpartition(" ")
    if kind:
        split = acceleration_split(trajectory, t, side=side)
        return split.normal if kind == "normal" else split.tangential
    return np.asarray(getattr(trajectory, of)(t, side=side))
