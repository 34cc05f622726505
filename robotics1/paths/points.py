"""Points, vectors and lengths of paths, checked: of a size whose squares can be computed with."""

from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array, real_number

LARGEST = 1e30  # of a coordinate; and its inverse the smallest of a length
SAME_POINT = 1e-12  # relative to the coordinates: points so near are the same


def moderate(name: str, values: Array) -> Array:
    """Return numbers, if none is larger than 1e30 in magnitude.

    Raises:
        InputError: one is.
    """
    if values.size and float(np.abs(values).max()) > LARGEST:
        raise InputError(f"{name} must not be larger than {LARGEST:g}; it is {values.tolist()}")
    return values


def point(name: str, value: npt.ArrayLike, shape: tuple[int | None, ...] = (None,), meaning: str = "a point") -> Array:
    """Return a point or a vector, or several as rows.

    Raises:
        InputError: it is none of this shape, not finite, or too large.
    """
    return moderate(name, real_array(name, value, shape, meaning))


def size(name: str, value: Any) -> float:
    """Return a positive number from 1e-30 to 1e30.

    Raises:
        InputError: it is none.
    """
    number = real_number(name, value, positive=True)
    if not 1 / LARGEST <= number <= LARGEST:
        raise InputError(f"{name} must be from {1 / LARGEST:g} to {LARGEST:g}; it is {number:g}")
    return number


def distance(name: str, p: Array, other: str, q: Array) -> float:
    """Return |q − p|.

    Raises:
        InputError: the points are the same, or nearer than 1e-30.
    """
    length = float(np.linalg.norm(q - p))
    if length <= max(SAME_POINT * float(np.abs([p, q]).max(initial=0.0)), 1 / LARGEST):
        raise InputError(f"{name} and {other} must be different points; both are {p.tolist()}")
    return length


def steps_between(points: Array) -> Array:
    """Return |pᵢ₊₁ − pᵢ|, (m − 1,).

    Raises:
        InputError: there are fewer than two points, or two consecutive ones are the same.
    """
    if len(points) < 2 or not points.shape[1]:
        raise InputError(f"points must be two at least, with coordinates; they have the shape {points.shape}")
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    still = np.flatnonzero(steps <= max(SAME_POINT * float(np.abs(points).max()), 1 / LARGEST))
    if still.size:
        i = int(still[0])
        raise InputError(f"consecutive points must differ; points {i} and {i + 1} are both {points[i].tolist()}")
    return np.asarray(steps)
