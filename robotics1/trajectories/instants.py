"""Instants of a motion: inside it, and on which side of a switching time."""

from collections.abc import Iterable

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, one_of, real_array

ONE_INSTANT = 1e-11  # of the duration: instants so near are one


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


def distinct_instants(instants: Iterable[float], duration: float) -> Array:
    """Return the instants inside (0, T), ascending, without those that are another one, or an end, but for rounding."""
    ordered = np.unique(np.array([*instants, duration], dtype=float))
    inside = np.diff(ordered, prepend=0.0) > ONE_INSTANT * duration
    return np.asarray(ordered[:-1][inside[:-1] & (duration - ordered[:-1] > ONE_INSTANT * duration)])
