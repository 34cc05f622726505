"""A formula as it is read: decimals of five digits, and lengths in metres as the file has them.

SymPy multiplies fractions out: −26673 (8500 cos q2 + 7845 cos(q2 + q3)) sin q3 / 3200000000 is read as
−0.16671 (0.425 cos q2 + 0.39225 cos(q2 + q3)) sin q3. It is the same to five digits; to compute, take the formula.
"""

from typing import Any

import sympy

from robotics1.symbolic.writing.decimals import SAME, Lengths, scale_to_lengths
from robotics1.symbolic.writing.printing import with_decimals


def readable(formula: Any, lengths: Lengths) -> Any:
    """Return a formula with decimals for long fractions, and factors whose coefficients are lengths.

    Args:
        formula: an expression, a matrix, or an equation; one with 0 on the right loses its constant factor.
        lengths: those of the arm.
    """
    if isinstance(formula, sympy.MatrixBase):
        return formula.applyfunc(lambda entry: readable(entry, lengths))
    if isinstance(formula, sympy.Equality):
        left = _parts(formula.lhs, lengths)[1] if formula.rhs == 0 else [readable(formula.lhs, lengths)]
        return sympy.Eq(sympy.Mul(*left), readable(formula.rhs, lengths), evaluate=False)
    if not isinstance(formula, sympy.Expr) or formula.is_Add:
        return _whole(with_decimals(formula))
    constant, factors = _parts(formula, lengths)
    # SymPy would multiply a whole number into the only sum
    return _whole(sympy.Mul(constant, *factors, evaluate=len(factors) != 1 or constant == 1))


def _parts(e: sympy.Expr, lengths: Lengths) -> tuple[sympy.Expr, list[sympy.Expr]]:
    """Return a constant and the other factors of an expression, whose sums have lengths for coefficients."""
    constant, factors = sympy.S.One, []
    for factor in sympy.Mul.make_args(e):
        base, power = factor.as_base_exp()
        if factor.is_number:
            constant *= factor
        elif base.is_Add and power.is_Integer:
            scale, scaled = _with_lengths(base, lengths)
            constant /= scale**power
            factors.append(scaled**power)
        else:
            factors.append(with_decimals(factor))
    return _whole(with_decimals(constant)), factors


def _whole(formula: Any) -> Any:
    """Return a formula with 1 for 1.0."""
    floats = {x for x in formula.atoms(sympy.Float) if abs(x - round(x)) <= SAME * abs(x)}
    return formula.xreplace({x: sympy.Integer(round(x)) for x in floats}) if floats else formula


def _with_lengths(total: sympy.Add, lengths: Lengths) -> tuple[sympy.Expr, sympy.Expr]:
    """Return k, and k times a sum with large whole coefficients, which are lengths then; else 1 and the sum."""
    k = scale_to_lengths([total], lengths)
    if k is None:
        return sympy.S.One, with_decimals(total)
    largest = max((term.as_coeff_Mul()[0] for term in total.args), key=abs)
    k = k if largest > 0 else -k
    return k, sympy.Add(*(with_decimals(k * term) for term in total.args))


def readable_vector(column: sympy.Matrix, lengths: Lengths) -> sympy.Matrix:
    """Return a vector of a basis, whose length is free, with lengths for large whole coefficients."""
    expanded = column.applyfunc(sympy.expand)
    k = scale_to_lengths(list(expanded), lengths)
    if k is None:
        return _whole(with_decimals(column))
    return _whole(expanded.applyfunc(lambda entry: with_decimals(sympy.expand(k * entry))))
