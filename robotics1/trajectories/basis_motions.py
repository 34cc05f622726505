"""A motion that is a sum of given functions of time, through given values of its derivatives."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.caching import cached_property
from robotics1.curves.symbolic_path import FormulaPath, formula_of, formula_path
from robotics1.errors import InputError
from robotics1.inputs import by_name, counting_number


@dataclass(frozen=True)
class BasisMotion:
    """q(t) = Σᵢ cᵢ φᵢ(t), in SymPy.

    Attributes:
        basis: (m,) the functions φᵢ of the real symbol t.
        coefficients: `sympy.Matrix` (m, n), cᵢ of each joint.
        duration: T, an expression.
        values: of the names, as they were given.
    """

    basis: tuple[Any, ...]
    coefficients: Any
    duration: Any
    values: Mapping[str, float]

    @cached_property
    def formula(self) -> Any:
        """q(t), a `sympy.Matrix` (n, 1)."""
        import sympy

        return (sympy.Matrix([self.basis]) * self.coefficients).T

    @cached_property
    def curve(self) -> FormulaPath:
        """q(t) as a motion, 0 ≤ t ≤ T.

        Raises:
            InputError: a name has no value.
        """
        import sympy

        known = {sympy.Symbol(name, real=True): value for name, value in self.values.items()}
        end = self.duration.xreplace({key: sympy.sympify(value) for key, value in known.items()})
        if end.free_symbols:
            raise InputError(f"the duration has no number; give the value of {sorted(map(str, end.free_symbols))[0]}")
        used = {symbol.name for symbol in self.formula.free_symbols}
        return formula_path(
            list(self.formula), "t", float(end), values={k: x for k, x in self.values.items() if k in used}
        )


def motion_in_basis(
    basis: Sequence[Any],
    conditions: Sequence[tuple[Any, int, Any]],
    duration: Any,
    *,
    values: Mapping[str, float] | None = None,
) -> BasisMotion:
    """Return the motion Σ cᵢ φᵢ(t) of given functions that meets as many conditions: its coefficients are exact.

        motion_in_basis(["1", "t", "sin(pi*t/T)"], [(0, 0, "q0"), ("T", 0, "q1"), (0, 1, 0)], "T").formula

    Args:
        basis: (m,) functions of t: texts, SymPy expressions, or numbers.
        conditions: (m,) of (instant, order, value): the derivative of the order, 0 of q itself, is the value there; a
            number, a name or an expression, or one for each joint.
        duration: T, a number or a name.
        values: of the names, for the motion in numbers.

    Raises:
        InputError: something is no expression, there are not as many conditions as functions, they do not determine the
            coefficients, or they are of different numbers of joints.
    """
    import sympy

    t = sympy.Symbol("t", real=True)
    if isinstance(basis, str) or not isinstance(basis, Sequence) or not basis:
        raise InputError(f"basis must be functions of t, as ['1', 't', 'cos(pi*t/T)']; it is {basis!r}")
    if not isinstance(conditions, Sequence) or len(conditions) != len(basis):
        raise InputError(
            f"{len(basis)} functions need as many conditions (instant, order, value); they are {conditions!r}"
        )
    functions = tuple(_real(formula_of(phi)) for phi in basis)
    rows, wanted = [], []
    for given in conditions:
        if not isinstance(given, tuple | list) or len(given) != 3:
            raise InputError(f"a condition must be (instant, order, value), as ('T', 1, 0); it is {given!r}")
        instant, order = _real(formula_of(given[0])), counting_number("order", given[1])
        rows.append([phi.diff(t, order).subs(t, instant) if order else phi.subs(t, instant) for phi in functions])
        several = isinstance(given[2], Sequence | np.ndarray) and not isinstance(given[2], str)
        wanted.append([_real(formula_of(x)) for x in (given[2] if several else [given[2]])])
    n = max(map(len, wanted))
    if any(len(row) not in (1, n) for row in wanted):
        raise InputError("the values of all conditions must be one number, or one for each joint")
    A = sympy.Matrix(rows)
    b = sympy.Matrix([row * n if len(row) == 1 else row for row in wanted])
    if A.has(sympy.zoo, sympy.nan) or sympy.simplify(A.det()) == 0:
        raise InputError("the conditions do not determine the coefficients: their matrix is singular")
    coefficients = A.LUsolve(b).applyfunc(sympy.simplify)
    known = by_name("values", values, "{'T': 2.0}")
    return BasisMotion(functions, coefficients, _real(formula_of(duration)), known)


def _real(expression: Any) -> Any:
    """Return an expression whose symbols are real, and whose decimals are fractions."""
    import sympy

    names = {symbol: sympy.Symbol(symbol.name, real=True) for symbol in expression.free_symbols}
    return sympy.nsimplify(expression.xreplace(names), rational=True)
