"""Instants of a motion: inside it, and on which side of a switching time."""

import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, one_of, real_array


def times_inside(t: npt.ArrayLike, duration: float, side: str = "right") -> Array:
    """Return the times as an array, if they are in [0, T]; a relative excess of 1e-9 is rounding.

    Raises:
        InputError: one of them is not, or the side is neither "right" nor "left".
    """
    one_of("side", side, ("right", "left"))
    times = real_array("t", t, (None,) * dimensions("t", t), "seconds")
    if times.size and (times.min() < -1e-9 * duration or times.max() > (1 + 1e-9) * duration):
        raise InputError(f"t must be in [0, {duration:g}] s; it is {times.tolist()}")
    return times
