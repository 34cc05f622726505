"""Numbers given with few digits: what their rounding may hide, and the singularity it may hide.

1.5708 stands for any number within half a unit of its last digit, 0.00005. So π/2 is among them, where a Jacobian may
be singular, while at 1.5708 itself σ_min is about 4e-6, and its inverse asks for joint velocities of 10⁵.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

FEWEST = 2  # decimals: a number with fewer, such as 1 or 0.5, is a choice, not a rounded one
MOST = 12  # significant digits: a number with more was computed, not printed


def half_units(numbers: npt.ArrayLike, fewest: int = FEWEST) -> npt.NDArray[np.floating[Any]]:
    """Return half a unit of the last printed digit of each number, in their shape: 5e-5 of 1.5708; 0 where it is exact.

    The digits are those of the shortest decimal that gives the number back. A number of more than 12 significant digits
    was computed: it is exact, but for its rounding. So are 1 and 0.5, unless others have more decimals: then theirs are
    zeros that were left out, as in (1.5708, 0.5).
    """
    values = np.asarray(numbers)
    texts = [_written(x) for x in (values if values.dtype.kind == "f" else values.astype(float)).flat]
    decimals = np.array([len(text.partition(".")[2]) for text in texts], dtype=int)
    printed = np.array([_is_printed(text) for text in texts], dtype=bool)
    rounded = printed & (decimals >= fewest)
    if not rounded.any():
        return np.zeros(values.shape)
    decimals = np.where(decimals < fewest, decimals[rounded].max(), decimals)
    return np.where(printed, 0.5 * 10.0**-decimals, 0.0).reshape(values.shape)


def shared_half_units(numbers: npt.ArrayLike) -> npt.NDArray[np.floating[Any]]:
    """Return half a unit of the last digit of numbers rounded at the same place: 5e-5 for each of (0.7071, 0.5).

    With fewer than three decimals, as (0.5, 0.25), they are a choice, and exact.
    """
    half = half_units(numbers, 3)
    return np.where(half > 0, half[half > 0].min(initial=np.inf), 0.0)


def all_printed(numbers: npt.ArrayLike) -> bool:
    """Whether every number has at most 12 significant digits."""
    return all(_is_printed(_written(x)) for x in np.ravel(np.asarray(numbers, dtype=float)))


def _written(x: np.floating) -> str:
    return np.format_float_positional(x, unique=True, trim="-")


def _is_printed(text: str) -> bool:
    return len(text.strip("-").replace(".", "").strip("0")) <= MOST
