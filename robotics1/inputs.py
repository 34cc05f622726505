"""What a caller hands in, checked once at the door: arrays of the right size, numbers that are numbers."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError

Array = npt.NDArray[np.floating[Any]]


def real_array(name: str, value: npt.ArrayLike, shape: tuple[int | None, ...], meaning: str = "") -> Array:
    """Return `value` as a new float array of the given shape (None: any size) with finite entries.

    Raises:
        InputError: it is not numeric, has another shape, or holds NaN or infinity.
    """
    wanted = f"({', '.join('any' if n is None else str(n) for n in shape)}{',' if len(shape) == 1 else ''})"
    wanted += f", {meaning}" if meaning else ""
    try:
        raw = np.asarray(value)
        if np.iscomplexobj(raw) or raw.dtype.kind in "USMm":
            raise TypeError
        array = np.array(raw, dtype=float)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} must be an array of real numbers of shape {wanted}, not {value!r}") from error
    if array.ndim != len(shape) or any(n is not None and n != m for n, m in zip(shape, array.shape, strict=True)):
        raise InputError(f"{name} must have shape {wanted}; it has shape {array.shape}")
    if not np.isfinite(array).all():
        raise InputError(f"{name} must be finite; it is {array.tolist()}")
    return array


def real_number(name: str, value: Any, *, positive: bool = False, non_negative: bool = False) -> float:
    """Return `value` as a finite float.

    Raises:
        InputError: it is no number, not finite, or has the wrong sign.
    """
    kind = "a positive" if positive else "a non-negative" if non_negative else "a finite"
    try:
        number = float(value)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} must be {kind} number, not {value!r}") from error
    if not math.isfinite(number) or (positive and number <= 0) or (non_negative and number < 0):
        raise InputError(f"{name} must be {kind} number; it is {number}")
    return number


def counting_number(name: str, value: Any, *, least: int = 0) -> int:
    """Return `value` as an integer not below `least`.

    Raises:
        InputError: it is no integer, or too small.
    """
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < least:
        raise InputError(f"{name} must be an integer of at least {least}; it is {value!r}")
    return int(value)


def per_joint(name: str, value: npt.ArrayLike, n: int) -> Array:
    """Return `value` as (n,): one number for all joints, or one for each.

    Raises:
        InputError: it is neither.
    """
    if np.ndim(value) == 0:
        return np.full(n, real_number(name, value))
    return real_array(name, value, (n,), "one number for each joint")


def one_of(name: str, value: str, choices: Sequence[str]) -> str:
    """Return `value` if it is among the choices.

    Raises:
        InputError: it is not.
    """
    if value not in choices:
        raise InputError(f"{name} must be one of {', '.join(map(repr, choices))}; it is {value!r}")
    return value
