"""What a teacher writes in the file: numbers such as "0.7*pi" or "l2/2", and formulas such as "l2*cos(q2)"."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import numpy.typing as npt
import sympy

from robotics1.curves.formula_text import expression_of
from robotics1.errors import InputError

MOST = 400  # entries of a list


def number_of(value: Any, names: Mapping[str, float]) -> float:
    """Return a number, or a text of numbers, pi, functions and the names of lengths and data.

    Raises:
        InputError: it is none, or has another name in it.
    """
    if isinstance(value, bool) or not isinstance(value, int | float | str):
        raise InputError(f"a number, or a text such as '0.7*pi', is wanted; it is {value!r}")
    if not isinstance(value, str):
        return float(value)
    formula = expression_of(value)
    unknown = sorted(str(symbol) for symbol in formula.free_symbols if str(symbol) not in names)
    if unknown:
        known = f"known are {', '.join(names)}" if names else "only numbers can stand here"
        raise InputError(f"{value!r} has the name {unknown[0]!r}; {known}")
    found = complex(formula.subs({symbol: names[str(symbol)] for symbol in formula.free_symbols}).evalf())
    if found.imag or not np.isfinite(found.real):
        raise InputError(f"{value!r} is no real number")
    return found.real


def numbers_of(value: Any, names: Mapping[str, float]) -> npt.NDArray[np.float64]:
    """Return a list of numbers.

    Raises:
        InputError: it is no list, or one of its entries is no number.
    """
    if not isinstance(value, list) or not 0 < len(value) <= MOST:
        raise InputError(f"a list of numbers is wanted, such as [1, '0.7*pi']; it is {value!r}")
    return np.array([number_of(entry, names) for entry in value])


def formula_of(value: Any) -> Any:
    """Return a formula: of a text an expression, of a list of texts a column, of a list of lists a matrix.

    Raises:
        InputError: it is none of these.
    """
    if isinstance(value, str):
        return with_real_symbols(expression_of(value))
    if isinstance(value, list) and 0 < len(value) <= MOST:
        rows = [entry if isinstance(entry, list) else [entry] for entry in value]
        flat = not any(isinstance(entry, list) for row in rows for entry in row)
        if flat and rows[0] and len({len(row) for row in rows}) == 1:
            return sympy.Matrix([[formula_of(str(entry)) for entry in row] for row in rows])
    raise InputError(f"a formula is a text, a list of texts, or rows of the same length; it is {value!r}")


def conditions_of(text: Any) -> tuple[sympy.Eq, ...]:
    """Return equations such as "q2 = pi/2, q3 = 0".

    Raises:
        InputError: it is no such text.
    """
    if not isinstance(text, str) or not text.strip():
        raise InputError(f"equations are wanted, such as 'q2 = pi/2, q3 = 0'; it is {text!r}")
    found = []
    for part in text.split(", "):
        left, sign, right = part.partition("=")
        if not sign:
            raise InputError(f"{part!r} is no equation; write it like 'q2 = pi/2'")
        found.append(sympy.Eq(formula_of(left), formula_of(right), evaluate=False))
    return tuple(found)


def with_real_symbols(formula: Any) -> Any:
    """Return a formula whose symbols are real, as those of `formulas` are."""
    return formula.xreplace({symbol: sympy.Symbol(symbol.name, real=True) for symbol in formula.free_symbols})
