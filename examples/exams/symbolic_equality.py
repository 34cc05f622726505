"""Whether a published formula and a computed one are the same for every value of their symbols."""

import re
from collections.abc import Sequence
from typing import Any

import sympy
from sympy.core.relational import Relational
from sympy.matrices.expressions import MatrixExpr


def formula_of(text: str) -> Any:
    """Return a formula in SymPy's spelling, as "l2*cos(q2)", with every symbol real.

    All multiples of a vector are "MatMul(nu, Matrix([l2, 1, -1]))", a condition is "Ne(rdot2, 0)", and a set of values
    "Contains((q2, q3), FiniteSet((0, pi), (pi, 0)))".
    """
    names = {name for name in re.findall(r"[A-Za-z]\w*", text) if not hasattr(sympy, name)}
    return sympy.sympify(text, locals={name: sympy.Symbol(name, real=True) for name in names})


def are_equal(printed: Any, computed: Any) -> bool:
    """Return whether two formulas say the same.

    Matrices are equal entry by entry, and memberships with equal sets. All multiples of a vector are those of another
    one that differs by a number, and so is what a condition compares with zero.
    """
    match printed, computed:
        case sympy.MatMul(), sympy.MatMul():
            (_, (v,)), (_, (w,)) = printed.as_coeff_matrices(), computed.as_coeff_matrices()
            return bool(v.shape == w.shape) and _differ_by_a_number(list(v), list(w))
        case sympy.MatrixBase(), sympy.MatrixBase():
            return bool(printed.shape == computed.shape) and all(map(_vanishes, printed - computed))
        case Relational(), Relational():
            sides = [[condition.lhs - condition.rhs] for condition in (printed, computed)]
            return printed.func is computed.func and _differ_by_a_number(*sides)
        case sympy.Expr(), sympy.Expr() if not isinstance(printed, MatrixExpr) and not isinstance(computed, MatrixExpr):
            return _vanishes(printed - computed)
    return bool(printed == computed)


def _differ_by_a_number(v: Sequence[Any], w: Sequence[Any]) -> bool:
    ratio = next((sympy.simplify(a / b) for a, b in zip(v, w, strict=True) if not _vanishes(b)), sympy.S.Zero)
    return bool(ratio.is_number and ratio != 0) and all(_vanishes(a - ratio * b) for a, b in zip(v, w, strict=True))


def _vanishes(expression: Any) -> bool:
    return bool(sympy.simplify(expression) == 0)
