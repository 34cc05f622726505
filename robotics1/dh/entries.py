"""What a caller writes of joints: numbers or names, the values of the names, and limits."""

import keyword
import math
import re
from collections.abc import Mapping, Sequence
from typing import Any
from unicodedata import normalize

import numpy as np

from robotics1.angles import WIDE, warn_of_degrees
from robotics1.errors import InputError, shown
from robotics1.inputs import Array, real_number
from robotics1.names import refuse_no_number
from robotics1.robot.findings import LARGEST
from robotics1.robot.parameters import Parameters, with_values

Limits = Sequence[float | None] | Array | None


def number_or_name(where: str, value: Any) -> float | str:
    """Return a number, "name" or "-name".

    Raises:
        InputError: it is none of these.
    """
    if not isinstance(value, str):
        return real_number(where, value)
    sign, name = ("-", value.strip()[1:].strip()) if value.strip().startswith("-") else ("", value.strip())
    if not name.isidentifier() or normalize("NFKC", name) != name or name.startswith("__") or keyword.iskeyword(name):
        raise InputError(
            f"{where} must be a number, a name such as 'l2' or a negated name such as '-l2', not {shown(value)}; "
            f"a name has letters, digits and underscores, and numbers are not written as text"
        )
    if name == "pi":
        raise InputError(f"{where} cannot be called 'pi': write the number math.pi")
    if re.fullmatch(r"q\d+", name):
        raise InputError(
            f"{where} cannot be called {name!r}: the joint is added to it; write its constant part, such as 0"
        )
    refuse_no_number(where, name)
    return sign + name


def named_values(entries: Sequence[float | str], parameters: Mapping[str, float]) -> Parameters:
    """Return the values of the names in a DH table, in the order of its entries.

    Raises:
        InputError: a name has no value, or one that is no number.
        UnknownNameError: a parameter is not among the names.
    """
    names = dict.fromkeys(entry.removeprefix("-") for entry in entries if isinstance(entry, str))
    missing = [name for name in names if name not in parameters]
    if missing:
        raise InputError(f"no value for {', '.join(missing)}: give it, as in parameters={{{missing[0]!r}: 0.5}}")
    return with_values("the DH table", dict.fromkeys(names, math.nan), parameters)


def value_of(entry: float | str, parameters: Mapping[str, float]) -> float:
    """Return the number that a number, "name" or "-name" stands for."""
    if not isinstance(entry, str):
        return entry
    name = entry.removeprefix("-")
    return -parameters[name] if entry.startswith("-") else parameters[name]


def joint_limits(lower: Limits, upper: Limits, turns: Sequence[bool]) -> tuple[Array, Array]:
    """Return the limits of joints, (n,) each; None, for all or for one, means none, which is ∓∞.

    Args:
        lower, upper: as the caller writes them [rad or m].
        turns: (n,) which of the joints are revolute; of their limits that look like degrees there is a warning.

    Raises:
        InputError: there is not one number or None for each joint, or lower is above upper.
    """
    low, high = (
        _limits(name, value, len(turns), none)
        for name, value, none in (("lower", lower, -math.inf), ("upper", upper, math.inf))
    )
    for i, (a, b) in enumerate(zip(low, high, strict=True), 1):
        if a > b or a == math.inf or b == -math.inf:
            raise InputError(f"the limits of q{i} must have lower ≤ upper; they are {a:g} and {b:g}")
    every = np.stack([low, high])
    finite = np.abs(every[np.isfinite(every)])
    if finite.max(initial=0.0) > LARGEST:
        raise InputError(f"a limit is {finite.max():g}; at most {LARGEST:g} can be computed with")
    warn_of_degrees("a limit", np.where(np.abs(every) > WIDE, every, 0.0), np.array(turns))
    return low, high


def _limits(name: str, value: Limits, n: int, none: float) -> Array:
    if value is None:
        return np.full(n, none)
    try:
        limits = np.array([none if entry is None else float(entry) for entry in value])
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} must have one number or None for each of {n} joints, not {shown(value)}") from error
    if limits.shape != (n,) or np.isnan(limits).any():
        raise InputError(f"{name} must have one number or None for each of {n} joints; it is {limits.tolist()}")
    return limits
