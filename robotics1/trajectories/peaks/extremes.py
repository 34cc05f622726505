"""The extremes of a motion and of its derivatives: asked of the motion, or of interpolants."""

from functools import partial
from typing import Any

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number
from robotics1.paths.interpolants import largest
from robotics1.trajectories.protocols import Peak, Side, smooth_ends

SAME = 1e-12  # relative: magnitudes so near are equal, and the earlier instant counts


def extremes_of(motion: Any, order: int = 0) -> tuple[Array, Array]:
    """Return the times [s] and values of the minimum and maximum of a derivative of a motion.

    (2,) for a timing law, (2, n) for a trajectory. A motion with `extremes` of its own is asked; else the motion is
    replaced between its switching times by interpolants that agree with it to rounding, and theirs are taken.

    Raises:
        InputError: the motion oscillates so quickly that no interpolant agrees with it.
    """
    if hasattr(motion, "extremes"):
        times, values = motion.extremes(order)
        return times, values
    counting_number("order", order)
    quantity = (motion, motion.velocity, motion.acceleration, motion.jerk)[order]
    n = np.size(quantity(0.0))

    def column(t: Array, side: Side, j: int, sign: float) -> Array:
        values = quantity(t, side=side) if order else quantity(t)
        return sign * np.reshape(values, (len(t), n))[:, j]

    ends = smooth_ends(motion)
    found = [[largest(partial(column, j=j, sign=sign), ends) for j in range(n)] for sign in (-1.0, 1.0)]
    if not all(extreme.resolved for row in found for extreme in row):
        raise InputError("the motion oscillates too quickly for its extremes to be found")
    times = np.array([[extreme.at for extreme in row] for row in found])
    values = np.array([[extreme.value for extreme in row] for row in found]) * [[-1], [1]]
    return (times[:, 0], values[:, 0]) if np.ndim(motion(0.0)) == 0 else (times, values)


def peak_of(times: Array, values: Array) -> Peak:
    """Return the larger in magnitude of two extremes; of equal ones, the earlier."""
    (t0, t1), (x0, x1) = times, values
    near = abs(abs(x0) - abs(x1)) <= SAME * max(abs(x0), abs(x1))
    first = t0 <= t1 if near else abs(x0) > abs(x1)
    return Peak(float(x0), float(t0)) if first else Peak(float(x1), float(t1))


class LawWithExtremes:
    """A timing law that knows the extremes of its derivatives, and so its peaks."""

    def extremes(self, order: int = 0) -> tuple[Array, Array]:
        """Return the times (2,) [s] and values (2,) of the minimum and maximum of the derivative of this order."""
        raise NotImplementedError

    @property
    def peak_velocity(self) -> Peak:
        """Where |ṡ| is largest."""
        return peak_of(*self.extremes(1))

    @property
    def peak_acceleration(self) -> Peak:
        """Where |s̈| is largest."""
        return peak_of(*self.extremes(2))

    @property
    def peak_jerk(self) -> Peak:
        """Where |d³s/dt³| is largest, impulses at the switching times apart."""
        return peak_of(*self.extremes(3))
