"""The largest speed, acceleration and normal acceleration of a motion: exact extrema, not samples."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve
from robotics1.curves.interpolants import Extreme, largest
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array, one_of
from robotics1.results import Frozen

Norm = Literal["velocity", "acceleration", "jerk", "tangential acceleration", "normal acceleration"]
NORMS: tuple[Norm, ...] = get_args(Norm)

ROUNDING = 1e-12  # of the acceleration: a part as small as this is none


@dataclass(frozen=True, eq=False)
class AccelerationSplit(Frozen):
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
    motion = as_curve("trajectory", trajectory, derivatives=2)
    v = np.asarray(motion.velocity(t, side=side))
    a = np.asarray(motion.acceleration(t, side=side))
    if not motion.shape:
        raise InputError("a timing law has no direction; split the acceleration of a motion along a path")
    speed = np.linalg.norm(v, axis=-1, keepdims=True)
    unit = v / np.where(speed > 0, speed, 1.0)
    along = np.sum(a * unit, axis=-1, keepdims=True) * unit
    tangential = np.where(speed > 0, along, a)
    return AccelerationSplit(tangential, a - tangential)


def peak_norm(trajectory: Any, quantity: Norm = "velocity", *, rows: slice | None = None) -> Extreme:
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

    motion = as_curve("trajectory", trajectory, derivatives=2)

    def square(t: Array, side: Side) -> Array:
        vector = _vector(motion, quantity, t, side).reshape(len(t), motion.dimension)[:, rows or slice(None)]
        return np.asarray(np.sum(vector**2, axis=1))

    parts = quantity.endswith(" acceleration")  # a part that vanishes is the rounding of the whole
    whole = peak_norm(motion, "acceleration", rows=rows).value if parts else 0.0
    found = largest(square, motion.ends, floor=(ROUNDING * whole) ** 2)
    return Extreme(float(np.sqrt(found.value)), found.time, resolved=found.resolved)


def _vector(motion: Curve, quantity: str, t: Array, side: Side) -> Array:
    kind, _, of = quantity.rpartition(" ")
    if kind:
        split = acceleration_split(motion, t, side=side)
        return split.normal if kind == "normal" else split.tangential
    return np.asarray(getattr(motion, of)(t, side=side))
