"""What a caller hands in, checked once at the door: arrays of the right size, numbers that are numbers."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError, Robotics1Error, shown

Array = npt.NDArray[np.floating[Any]]
Choice = TypeVar("Choice", bound=str)


def real_array(name: str, value: npt.ArrayLike, shape: tuple[int | None, ...], meaning: str = "") -> Array:
    """Return `value` as a new float array of the given shape (None: any size) with finite entries.

    Raises:
        InputError: it is not numeric, has another shape, or holds NaN or infinity.
    """
    try:
        raw = np.asarray(value)
        if np.iscomplexobj(raw) or raw.dtype.kind in "USMm":
            raise TypeError
        array = np.array(raw, dtype=float)
    except (TypeError, ValueError, OverflowError) as error:
        wanted = _shape_told(shape, meaning)
        raise InputError(f"{name} must be an array of real numbers of shape {wanted}, not {shown(value)}") from error
    if array.ndim != len(shape) or any(n is not None and n != m for n, m in zip(shape, array.shape, strict=True)):
        raise InputError(f"{name} must have shape {_shape_told(shape, meaning)}; it has shape {array.shape}")
    if not np.isfinite(array).all():
        raise InputError(f"{name} must be finite; it is {shown(array.tolist())}")
    return array


def _shape_told(shape: tuple[int | None, ...], meaning: str) -> str:
    wanted = f"({', '.join('any' if n is None else str(n) for n in shape)}{',' if len(shape) == 1 else ''})"
    return wanted + (f", {meaning}" if meaning else "")


def real_number(name: str, value: Any, *, positive: bool = False, non_negative: bool = False) -> float:
    """Return `value` as a finite float.

    Raises:
        InputError: it is no number, not finite, or has the wrong sign.
    """
    kind = "a positive" if positive else "a non-negative" if non_negative else "a finite"
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError) as error:
        raise InputError(f"{name} must be {kind} number, not {shown(value)}") from error
    if not math.isfinite(number) or (positive and number <= 0) or (non_negative and number < 0):
        raise InputError(f"{name} must be {kind} number; it is {number}")
    return number


def counting_number(name: str, value: Any, *, least: int = 0, most: int | None = None) -> int:
    """Return `value` as an integer not below `least` and not above `most`.

    Raises:
        InputError: it is no integer, too small, or too large.
    """
    if isinstance(value, bool) or not isinstance(value, int | np.integer) or value < least:
        raise InputError(f"{name} must be an integer of at least {least}; it is {shown(value)}")
    if most is not None and value > most:
        raise InputError(f"{name} must be an integer of at most {most}; it is larger")
    return int(value)


def by_name(name: str, value: Any, example: str) -> dict[str, Any]:
    """Return a mapping from names as a dict; None is an empty one.

    Raises:
        InputError: it is no mapping.
    """
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise InputError(f"{name} must be a mapping such as {example}; it is {shown(value)}")
    for key in value:
        text(f"a name in {name}", key)
    return dict(value)


def text(name: str, value: Any) -> str:
    """Return `value` if it is a text.

    Raises:
        InputError: it is none.
    """
    if not isinstance(value, str):
        raise InputError(f"{name} must be a text, not {shown(value)}")
    return value


def dimensions(name: str, value: npt.ArrayLike) -> int:
    """Return the number of dimensions of an array.

    Raises:
        InputError: its rows differ in length, so that it is no array.
    """
    try:
        return np.ndim(value)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} must be an array of numbers; it is {shown(value)}") from error


def per_joint(name: str, value: npt.ArrayLike, n: int) -> Array:
    """Return `value` as (n,): one number for all joints, or one for each.

    Raises:
        InputError: it is neither.
    """
    if dimensions(name, value) == 0:
        return np.full(n, real_number(name, value))
    return real_array(name, value, (n,), "one number for each joint")


def one_of(name: str, value: str, choices: Sequence[Choice]) -> Choice:
    """Return `value` if it is among the choices; else raise InputError."""
    if not isinstance(value, str) or value not in choices:
        raise InputError(f"{name} must be one of {', '.join(map(repr, choices))}; it is {shown(value)}")
    return choices[choices.index(value)]


def a_robot(value: Any) -> None:
    """Refuse what is no robot: a name, a class, a task in its place.

    Raises:
        InputError: the message says what would be right.
    """
    if is_a_robot(value):
        return
    if is_a_task(value):
        raise InputError("the robot comes first, then the task; here a task stands in the place of the robot")
    raise InputError(
        f"the robot must be a Robot, not {_kind(value)}; load_robot() returns one, and a name or a path stands for it"
    )


def a_task(value: Any) -> None:
    """Refuse what is no task: a text, a class without its brackets, a robot in its place.

    Raises:
        InputError: the message says what would be right.
    """
    if is_a_task(value):
        return
    if isinstance(value, type) and hasattr(value, "check_integrable"):
        raise InputError(f"the task must be made first: write {value.__name__}(...) with brackets")
    if is_a_robot(value):
        raise InputError("the robot comes first, then the task; here a robot stands in the place of the task")
    hint = "such as PositionTask('xy'), PlanarPoseTask() or PoseTask(), or a short form such as 'position:xy'"
    raise InputError(f"the task must be a task {hint}, not {_kind(value)}")


def answer_of(name: str, function: Callable[..., Any], *arguments: Any) -> Any:
    """Return what a function of the user's own returns; InputError where it fails, but for this package's errors."""
    try:
        return function(*arguments)
    except Robotics1Error:
        raise
    except Exception as error:
        given = ", ".join(str(x.tolist()) if isinstance(x, np.ndarray) else repr(x) for x in arguments)
        raise InputError(f"{name} failed at {given}: {error!r}") from error


def true_or_false(name: str, value: Any) -> bool:
    """Return an option that is True or False; anything else is an InputError."""
    if not isinstance(value, bool | np.bool_):
        raise InputError(f"{name} must be True or False, not {shown(value)}")
    return bool(value)


def is_a_robot(value: Any) -> bool:
    """Whether a value is a robot."""
    return hasattr(type(value), "frame_id")  # robots are made of what is checked here, so that their class is unknown


def is_a_task(value: Any) -> bool:
    """Whether a value is a task that has been made."""
    return hasattr(value, "check_integrable") and hasattr(value, "jacobian") and not isinstance(value, type)


def _kind(value: Any) -> str:
    if isinstance(value, str):
        return repr(value)
    return f"the class {value.__name__}" if isinstance(value, type) else f"a {type(value).__name__}"


# --- magnitudes of motions and paths, so that no power or quotient of them leaves the range of floating-point numbers

LARGEST = 1e30  # of any number; of durations, bounds and lengths the inverse is the smallest


def moderate(name: str, values: Array, *, smallest: float = 0.0) -> Array:
    """Return numbers, if none is larger than 1e30 in magnitude, or smaller than `smallest`; infinity is let pass.

    Raises:
        InputError: one is.
    """
    sizes = np.abs(values[np.isfinite(values)])
    if sizes.size and (sizes.max() > LARGEST or sizes.min() < smallest):
        raise InputError(
            f"{name} must not be larger than {LARGEST:g}, or unreasonably small; it is {shown(values.tolist())}"
        )
    return values


def moderate_array(
    name: str, value: npt.ArrayLike, shape: tuple[int | None, ...] = (None,), meaning: str = "a point"
) -> Array:
    """Return a point or a vector, or several as rows, of a size whose squares can be computed with.

    Raises:
        InputError: it is none of this shape, not finite, or larger than 1e30.
    """
    return moderate(name, real_array(name, value, shape, meaning))


def positive_number(name: str, value: Any) -> float:
    """Return a duration, a length or a rate from 1e-30 to 1e30.

    Raises:
        InputError: it is no positive number, or too large or small.
    """
    return float(moderate(name, np.array(real_number(name, value, positive=True)), smallest=1 / LARGEST))


def positive_numbers(name: str, value: npt.ArrayLike, n: int) -> Array:
    """Return positive numbers from 1e-30, (n,); a single number is for all.

    Raises:
        InputError: one is not positive, or their number is wrong.
    """
    array = moderate(name, per_joint(name, value, n))
    if (array < 1 / LARGEST).any():
        raise InputError(f"{name} must be positive; it is {shown(array.tolist())}")
    return array


def non_negative_numbers(name: str, value: npt.ArrayLike, n: int) -> Array:
    """Return numbers that are not negative, (n,); a single number is for all.

    Raises:
        InputError: one is negative, or their number is wrong.
    """
    array = per_joint(name, value, n)
    if (array < 0).any():
        raise InputError(f"{name} must not be negative; it is {shown(array.tolist())}")
    return array


def joint_numbers(name: str, value: npt.ArrayLike, n: int | None = None) -> Array:
    """Return one number for each joint, (n,); a single number is one joint's.

    Raises:
        InputError: it has another shape, or is not finite.
    """
    listed: Any = [value] if dimensions(name, value) == 0 else value
    return moderate_array(name, listed, (n,), "one number for each joint")


def joint_rates(name: str, value: npt.ArrayLike, n: int) -> Array:
    """Return one number for each joint, (n,); a single number is for all.

    Raises:
        InputError: it has another shape, or is not finite.
    """
    return moderate(name, per_joint(name, value, n))


def without_infinity(value: npt.ArrayLike, instead: float) -> tuple[npt.ArrayLike, npt.NDArray[np.bool_]]:
    """Return numbers with another one in place of each +∞, and where these were; what is no number stays."""
    raw = np.asarray(value)
    unbounded = np.isposinf(raw) if raw.dtype.kind == "f" else np.zeros(raw.shape, dtype=bool)
    return (np.where(unbounded, instead, raw) if unbounded.any() else value), unbounded


def positive_bound(name: str, value: npt.ArrayLike | None, n: int | None = None) -> Array:
    """Return a bound as positive numbers, (n,), or as many as it has for n = None; infinite where there is none.

    Raises:
        InputError: it is not positive, or of another length.
    """
    if value is None:
        return np.full(n or 1, np.inf)
    what = f"the bound on the {name.replace('_', ' ')}"
    shape = () if dimensions(what, value) == 0 else (n,)
    finite, unbounded = without_infinity(value, 1.0)
    bound = real_array(what, finite, shape, "one number for all, or one for each joint")
    if not (bound > 0).all() or bound.size == 0:
        raise InputError(f"{what} must be positive; it is {shown(bound.tolist())}")
    moderate(what, bound, smallest=1 / LARGEST)
    bound[unbounded] = np.inf
    return bound if n is None else np.broadcast_to(bound, (n,)).copy()
