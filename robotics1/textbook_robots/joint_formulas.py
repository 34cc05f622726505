"""What a caller writes in the coordinates of joints: a letter for each joint, and formulas in q1, q2, ..."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from robotics1.curves.symbolic_path import formula_of
from robotics1.errors import InputError, UnknownNameError
from robotics1.inputs import by_name, real_number
from robotics1.robot.checking import MOST_DEGREES


def joint_letters(joints: Any) -> str:
    """Return the letters of joints, "R" and "P".

    Raises:
        InputError: there is another letter, none, or too many.
    """
    if not isinstance(joints, str) or not joints or not set(joints) <= set("RP") or len(joints) > MOST_DEGREES:
        raise InputError(
            f"joints must be 1 to {MOST_DEGREES} letters R (revolute) and P (prismatic), as 'RPP'; it is {joints!r}"
        )
    return joints


def joint_symbols(n: int) -> tuple[Any, ...]:
    """Return the symbols q1, ..., qn of SymPy."""
    import sympy

    return tuple(sympy.symbols(f"q1:{n + 1}", real=True))


def listed_formulas(formulas: Any, example: str) -> list[Any]:
    """Return formulas as expressions.

    Raises:
        InputError: they are no list, there is none, or one is no formula.
    """
    entries = [] if isinstance(formulas, str) or not np.iterable(formulas) else list(map(formula_of, formulas))
    if not entries:
        raise InputError(f"formulas must be one for each row, as {example}; they are {formulas!r}")
    return entries


def in_joints(entries: Sequence[Any], n: int, values: Mapping[str, float] | None) -> list[Any]:
    """Return expressions in the symbols q1, ..., qn, with the values of the other names in their places.

    Raises:
        InputError: a name is no joint and has no value.
        UnknownNameError: a value is of no name in them.
    """
    import sympy

    joints = {symbol.name: symbol for symbol in joint_symbols(n)}
    used = {symbol for entry in entries for symbol in entry.free_symbols}
    names = sorted({symbol.name for symbol in used} - set(joints))
    given = by_name("values", values, "{'l1': 0.5}")
    for name in given:
        if name not in names:
            raise UnknownNameError("name with a value in the formulas:", name, names)
    missing = [name for name in names if name not in given]
    if missing:
        raise InputError(
            f"{missing[0]!r} is neither a joint, q1 to q{n}, nor has it a value; give it, as "
            f"values={{{missing[0]!r}: 0.5}}"
        )
    exact = {name: sympy.sympify(real_number(f"the value of {name!r}", value)) for name, value in given.items()}
    known = {symbol: {**joints, **exact}[symbol.name] for symbol in used}
    return [entry.xreplace(known) for entry in entries]
