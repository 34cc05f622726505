"""A formula as it is read: decimals of five digits, and lengths in metres as the file has them.

SymPy multiplies fractions out: −26673 (8500 cos q2 + 7845 cos(q2 + q3)) sin q3 / 3200000000 is read as
−0.16671 (0.425 cos q2 + 0.39225 cos(q2 + q3)) sin q3. It is the same to five digits; to compute, take the formula.
"""

from typing import Any

import sympy

from robotics1.robot.box import MOST_TURNS
from robotics1.symbolic.writing.decimals import SAME, Lengths, scale_to_lengths, terms_of
from robotics1.symbolic.writing.printing import DIGITS, with_decimals


def readable(formula: Any, lengths: Lengths) -> Any:
    """Return a formula with decimals for long fractions and lengths, and factors whose coefficients are lengths.

    Args:
        formula: an expression, a matrix, or an equation; one with 0 on the right loses its constant factor.
        lengths: those of the arm.
    """
    if isinstance(formula, sympy.MatrixBase):
        return formula.applyfunc(lambda entry: readable(entry, lengths))
    if isinstance(formula, sympy.Equality):
        left = _parts(formula.lhs, lengths)[1] if formula.rhs == 0 else [readable(formula.lhs, lengths)]
        return sympy.Eq(sympy.Mul(*left), readable(formula.rhs, lengths), evaluate=False)
    if isinstance(formula, sympy.core.relational.Relational | sympy.And | sympy.Function) and not _is_wave(formula):
        return formula.func(*(readable(part, lengths) for part in formula.args))
    if not isinstance(formula, sympy.Expr) or formula.is_Atom or _is_wave(formula):
        return _decimals(formula, lengths)
    if formula.is_Add:
        return _alike(sympy.Add(*(readable(term, lengths) for term in formula.args)))
    constant, factors = _parts(formula, lengths)
    # SymPy would multiply a whole number into the only sum
    return sympy.Mul(constant, *factors, evaluate=len(factors) != 1 or constant == 1)


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
            factors.append(readable(base, lengths) ** power)
    return _number(constant, lengths), factors


def _is_wave(formula: Any) -> bool:
    return isinstance(formula, sympy.sin | sympy.cos)


def _decimals(formula: Any, lengths: Lengths) -> Any:
    """Return a formula with decimals for long fractions and for lengths, and 1 for 1.0; waves of 5 q2/12 stay."""
    waves = formula.atoms(sympy.sin, sympy.cos)
    known = {wave: sympy.Dummy() for wave in waves if all(x.q <= MOST_TURNS for x in wave.atoms(sympy.Rational))}
    outside = formula.xreplace(known)
    fractions = {x for x in outside.atoms(sympy.Rational) if not x.is_Integer and abs(float(x)) in lengths}
    shown = _whole(with_decimals(outside.xreplace({x: sympy.Float(x, DIGITS) for x in fractions})))
    return shown.xreplace({dummy: wave for wave, dummy in known.items()})


def _number(x: sympy.Expr, lengths: Lengths) -> sympy.Expr:
    """Return a number as a short exact one, such as √3/2, or as one decimal."""
    shown = _decimals(x, lengths)
    return shown if x.is_Rational or x.has(sympy.pi) or not shown.has(sympy.Float) else sympy.Float(x.evalf(), DIGITS)


def _alike(total: sympy.Expr) -> sympy.Expr:
    """Return a sum in which, where one coefficient is a decimal, no other is a fraction."""
    terms = [term.as_coeff_Mul() for term in sympy.Add.make_args(total)]
    if not any(coefficient.is_Float for coefficient, _ in terms):
        return total
    fractions = {x: sympy.Float(x, DIGITS) for x, rest in terms if x.is_Rational and not x.is_Integer}
    return sympy.Add(
        *(fractions.get(x, x) * rest if rest == 1 or not rest.is_number else x * rest for x, rest in terms)
    )


def _whole(formula: Any) -> Any:
    """Return a formula with 1 for 1.0."""
    floats = {x for x in formula.atoms(sympy.Float) if abs(x - round(x)) <= SAME * abs(x)}
    return formula.xreplace({x: sympy.Integer(round(x)) for x in floats}) if floats else formula


def _with_lengths(total: sympy.Add, lengths: Lengths) -> tuple[sympy.Expr, sympy.Expr]:
    """Return k, and k times a sum with whole coefficients, which are lengths then; else 1 and the sum."""
    k = scale_to_lengths([total], lengths)
    if k is None:
        return sympy.S.One, readable(total, lengths)
    largest = max((term.coefficient for term in terms_of(total)), key=abs)
    k = k if largest > 0 else -k
    return k, _scaled(k, total, lengths)


def _scaled(k: sympy.Rational, total: sympy.Expr, lengths: Lengths) -> sympy.Expr:
    terms = [_number(k * number, lengths) * _decimals(rest, lengths) for number, rest in terms_of(total)]
    return _alike(sympy.Add(*terms))


def readable_vector(column: sympy.Matrix, lengths: Lengths) -> sympy.Matrix:
    """Return a vector of a basis, whose length is free, with lengths for its whole coefficients."""
    expanded = column.applyfunc(sympy.expand)
    k = scale_to_lengths(list(expanded), lengths)
    if k is None:
        return column.applyfunc(lambda entry: _decimals(entry, lengths))
    return expanded.applyfunc(lambda entry: _scaled(k, entry, lengths))
