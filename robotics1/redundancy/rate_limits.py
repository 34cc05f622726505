"""The limits of joint rates and accelerations at one state, as the caller gives them."""

from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, moderate, per_joint, real_number, without_infinity
from robotics1.redundancy.given_levels import AskedLevels
from robotics1.robot.model import Robot

AT_LIMIT = 1e-9  # of the room between the limits


def at_limits(x: Array, low: Array, high: Array) -> npt.NDArray[np.bool_]:
    """Return whether each joint is at a limit, (nv,)."""
    room = AT_LIMIT * np.where(np.isfinite(high - low), high - low, 0.0)
    return (np.abs(x - low) <= room) | (np.abs(x - high) <= room)


def limits_of(
    robot: Robot, high: npt.ArrayLike, low: npt.ArrayLike | None, name: str = "limits"
) -> tuple[Array, Array]:
    """Return the limits, (nv,) each.

    Raises:
        InputError: a shape is wrong, or zero is not within them.
    """
    upper = _bound(robot, name, high)
    lower = -upper
    if low is not None:
        dimensions("lower", low)
        raw = np.asarray(low)
        lower = -_bound(robot, "lower", -raw.astype(float) if raw.dtype.kind in "fiu" else low)
    if (upper < 0).any() or (lower > 0).any():
        raise InputError(f"{name} must leave zero between them; they are from {lower.tolist()} to {upper.tolist()}")
    return lower, upper


def acceleration_limits(
    levels: AskedLevels,
    limits: npt.ArrayLike,
    lower: npt.ArrayLike | None,
    max_velocity: npt.ArrayLike | None,
    step: float | None,
) -> tuple[Array, Array]:
    """Return the limits of q̈, (nv,) each, that leave |q̇ + q̈ h| ≤ V as far as those of q̈ alone allow.

    Raises:
        InputError: a shape is wrong, or only one of max_velocity and step is given.
    """
    low, high = limits_of(levels.robot, limits, lower)
    if (max_velocity is None) != (step is None):
        raise InputError("max_velocity= and step= belong together: |q̇ + q̈ h| ≤ V holds after the step h")
    if max_velocity is None or levels.qdot is None:
        return low, high
    h = real_number("step", step, positive=True)
    ends = limits_of(levels.robot, max_velocity, None, "max_velocity")
    least, most = (np.clip((end - levels.qdot) / h, low, high) for end in ends)
    return least, most


def _bound(robot: Robot, name: str, value: Any) -> Array:
    """Return one bound for each joint, (nv,); infinity is none."""
    dimensions(name, value)
    finite, unlimited = without_infinity(value, 0.0)
    return np.where(unlimited, np.inf, moderate(name, per_joint(name, finite, robot.nv)))
