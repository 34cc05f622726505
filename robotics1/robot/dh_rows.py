"""The rows of a DH table as a caller writes them, checked, and the names in them held against their values."""

import keyword
import math
import re
from collections.abc import Mapping, Sequence
from typing import Any
from unicodedata import normalize

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError, UnknownNameError
from robotics1.inputs import Array, one_of, real_number
from robotics1.robot.dh_table import CONVENTIONS, DHRow, DHTable
from robotics1.robot.parameters import Parameters
from robotics1.robot.placements import homogeneous

Limits = Sequence[float | None] | npt.NDArray[np.floating[Any]] | None


def checked_table(
    rows: Sequence[Sequence[Any]],
    parameters: Mapping[str, float] | None,
    convention: str,
    base_placement: Any,
    tool_placement: Any,
    lower: Limits,
    upper: Limits,
) -> DHTable:
    """Return the table of the arguments of `robot_from_dh`; the errors are its errors."""
    one_of("convention", convention, CONVENTIONS)
    checked = _rows(rows)
    low, high = _limits("lower", lower, len(checked), -math.inf), _limits("upper", upper, len(checked), math.inf)
    for i, (a, b) in enumerate(zip(low, high, strict=True), 1):
        if a > b or a == math.inf or b == -math.inf:
            raise InputError(f"the limits of q{i} must have lower ≤ upper; they are {a:g} and {b:g}")
    return DHTable(
        checked,
        convention,
        homogeneous("base_placement", base_placement),
        homogeneous("tool_placement", tool_placement),
        low,
        high,
        Parameters(_values(checked, parameters or {})),
        tuple(f"q{i}" for i in range(1, len(checked) + 1)),
    )


def _rows(rows: Sequence[Sequence[Any]]) -> tuple[DHRow, ...]:
    try:
        listed = [(row,) if isinstance(row, str) else tuple(row) for row in rows]
    except TypeError as error:
        raise InputError(f"rows must be a list of (type, a, alpha, d, theta), not {rows!r}") from error
    if not listed:
        raise InputError("a DH table needs at least one row (type, a, alpha, d, theta)")
    return tuple(_row(i, row) for i, row in enumerate(listed, 1))


def _row(i: int, row: tuple[Any, ...]) -> DHRow:
    if len(row) != len(DHRow._fields):
        raise InputError(f"row {i} must be (type, a, alpha, d, theta); it is {row!r}")
    if not isinstance(row[0], str) or row[0] not in ("R", "P"):
        raise InputError(f"the type of row {i} must be 'R' (revolute) or 'P' (prismatic); it is {row[0]!r}")
    entries = [_entry(f"{name} of row {i}", value) for name, value in zip(DHRow._fields[1:], row[1:], strict=True)]
    return DHRow(str(row[0]), *entries)


def _entry(where: str, value: Any) -> float | str:
    """Return a number, "name" or "-name"."""
    if not isinstance(value, str):
        return real_number(where, value)
    sign, name = ("-", value.strip()[1:].strip()) if value.strip().startswith("-") else ("", value.strip())
    if not name.isidentifier() or normalize("NFKC", name) != name or name.startswith("__") or keyword.iskeyword(name):
        raise InputError(
            f"{where} must be a number, a name such as 'l2' or a negated name such as '-l2', not {value!r}; "
            f"a name has letters, digits and underscores, and numbers are not written as text"
        )
    if name == "pi" or re.fullmatch(r"q\d+", name):
        raise InputError(f"{where} cannot be called {name!r}: q1, q2, ... are the joints and pi is the number math.pi")
    return sign + name


def _values(rows: tuple[DHRow, ...], parameters: Mapping[str, float]) -> dict[str, float]:
    """Return name → value, in the order of the rows."""
    entries = [entry for row in rows for entry in row[1:] if isinstance(entry, str)]
    names = list(dict.fromkeys(entry.removeprefix("-") for entry in entries))
    missing = [name for name in names if name not in parameters]
    if missing:
        raise InputError(f"no value for {', '.join(missing)}: give it, as in parameters={{{missing[0]!r}: 0.5}}")
    for name in parameters:
        if name not in names:
            raise UnknownNameError("parameter of the DH table named", name, names)
    return {name: real_number(f"parameter {name!r}", parameters[name]) for name in names}


def _limits(name: str, value: Limits, n: int, none: float) -> Array:
    """Return limits (n,), with `none`, an infinity, for each None."""
    if value is None:
        return np.full(n, none)
    try:
        limits = np.array([none if entry is None else float(entry) for entry in value])
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} must have one number or None for each of {n} joints, not {value!r}") from error
    if limits.shape != (n,) or np.isnan(limits).any():
        raise InputError(f"{name} must have one number or None for each of {n} joints; it is {limits.tolist()}")
    return limits
