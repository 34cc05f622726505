"""Motions from accelerations, or jerks, that are constant on intervals."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.errors import InputError
from robotics1.inputs import dimensions, joint_numbers, joint_rates, moderate, positive_numbers, real_array


def motion_of_accelerations(
    q0: npt.ArrayLike, durations: npt.ArrayLike, accelerations: npt.ArrayLike, *, v0: npt.ArrayLike = 0.0
) -> PiecewisePolynomial:
    """Return the motion with a constant acceleration on each interval: q̇ = q̇ᵢ + aᵢ (t − tᵢ), a parabola each.

    Args:
        q0: (n,) the start [rad or m].
        durations: (m,) of the intervals, positive [s].
        accelerations: (m, n), or (m,) of one joint [rad/s² or m/s²].
        v0: (n,) the velocity at the start [rad/s or m/s], or one number for all.

    Raises:
        InputError: shapes do not agree, or a duration is not positive.
    """
    return _integrated(q0, durations, accelerations, "accelerations", [v0])


def motion_of_jerks(
    q0: npt.ArrayLike,
    durations: npt.ArrayLike,
    jerks: npt.ArrayLike,
    *,
    v0: npt.ArrayLike = 0.0,
    a0: npt.ArrayLike = 0.0,
) -> PiecewisePolynomial:
    """Return the motion with a constant jerk on each interval, a cubic each, with continuous accelerations.

    Args:
        q0: (n,) the start [rad or m].
        durations: (m,) of the intervals, positive [s].
        jerks: (m, n), or (m,) of one joint [rad/s³ or m/s³].
        v0: (n,) the velocity at the start [rad/s or m/s], or one number for all.
        a0: (n,) the acceleration there [rad/s² or m/s²], or one number for all.

    Raises:
        InputError: shapes do not agree, or a duration is not positive.
    """
    return _integrated(q0, durations, jerks, "jerks", [v0, a0])


def _integrated(
    q0: npt.ArrayLike, durations: npt.ArrayLike, constants: npt.ArrayLike, name: str, rates: list[npt.ArrayLike]
) -> PiecewisePolynomial:
    """Return the polynomials whose highest derivative is constant on each interval."""
    start = joint_numbers("q0", q0)
    shape = (None,) * min(1, dimensions("durations", durations))
    n, m = len(start), int(np.size(real_array("durations", durations, shape, "one for each interval")))
    if not m:
        raise InputError("durations must be those of one interval at least; there is none")
    T = positive_numbers("durations", durations, m)
    several: Any = constants
    listed: Any = [[x] for x in several] if n == 1 and dimensions(name, constants) == 1 else constants
    values = moderate(name, real_array(name, listed, (m, n), "one row for each interval, one column for each joint"))
    state = [start, *(joint_rates(f"the rate {i} at the start", v, n) for i, v in enumerate(rates, 1))]
    motion = PiecewisePolynomial(values[None], T)
    for rate in reversed(state):
        motion = motion.integral(rate)
    return motion
