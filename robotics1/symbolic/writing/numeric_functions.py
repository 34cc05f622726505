"""Formulas as functions of numbers."""

from collections.abc import Callable, Sequence
from typing import Any

import sympy


def numpy_function(symbols: Sequence[sympy.Symbol], formula: Any) -> Callable[..., Any]:
    """Return a function of the symbols' values that evaluates an expression or a matrix with NumPy.

    The symbols get other names first: SymPy's `lambdify` takes a symbol named sin for the function.
    """
    plain = [sympy.Dummy(f"x{i}", real=symbol.is_real) for i, symbol in enumerate(symbols)]
    return sympy.lambdify(plain, formula.xreplace(dict(zip(symbols, plain, strict=True))), modules="numpy")  # type: ignore[no-any-return]
