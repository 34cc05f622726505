"""What motions are made of, checked at the door: positions and rates of joints, durations, bounds.

Their magnitudes are limited, so that no power or quotient of them leaves the range of floating-point numbers.
"""

from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, per_joint, real_array, real_number

LARGEST = 1e30  # of any number; of durations and bounds the inverse is the smallest


def joint_numbers(name: str, value: npt.ArrayLike, n: int | None = None) -> Array:
    """Return one number for each joint, (n,); a single number is one joint's.

    Raises:
        InputError: it has another shape, or is not finite.
    """
    listed: Any = [value] if dimensions(name, value) == 0 else value
    return moderate(name, real_array(name, listed, (n,), "one number for each joint"))


def joint_rates(name: str, value: npt.ArrayLike, n: int) -> Array:
    """Return one number for each joint, (n,); a single number is for all.

    Raises:
        InputError: it has another shape, or is not finite.
    """
    return moderate(name, per_joint(name, value, n))


def positive_duration(name: str, value: Any) -> float:
    """Return a duration [s].

    Raises:
        InputError: it is not positive.
    """
    return float(moderate(name, np.array(real_number(name, value, positive=True)), smallest=1 / LARGEST))


def positive_bound(name: str, value: npt.ArrayLike | None, n: int | None = None) -> Array:
    """Return a bound as positive numbers, (n,), or as many as it has for n = None; infinite where there is none.

    Raises:
        InputError: it is not positive, or of another length.
    """
    if value is None:
        return np.full(n or 1, np.inf)
    what = f"the bound on the {name.replace('_', ' ')}"
    shape = () if dimensions(what, value) == 0 else (n,)
    raw = np.asarray(value)
    unbounded = np.isposinf(raw) if raw.dtype.kind == "f" else np.zeros(raw.shape, dtype=bool)
    finite = np.where(unbounded, 1.0, raw) if unbounded.any() else value
    bound = real_array(what, finite, shape, "one number for all, or one for each joint")
    if not (bound > 0).all() or bound.size == 0:
        raise InputError(f"{what} must be positive; it is {bound.tolist()}")
    moderate(what, bound, smallest=1 / LARGEST)
    bound[unbounded] = np.inf
    return bound if n is None else np.broadcast_to(bound, (n,)).copy()


def moderate(name: str, values: Array, *, smallest: float = 0.0) -> Array:
    """Return numbers, if none is larger than 1e30 in magnitude, or smaller than `smallest`; infinity counts as none.

    Raises:
        InputError: one is.
    """
    sizes = np.abs(values[np.isfinite(values)])
    if sizes.size and (sizes.max() > LARGEST or sizes.min() < smallest):
        raise InputError(f"{name} must not be larger than {LARGEST:g}, or unreasonably small; it is {values.tolist()}")
    return values
