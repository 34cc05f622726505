"""Numbers that are known to 1e-16, as those that are meant: √3/2 for 2984975067132296/3446752317066305."""

from collections.abc import Sequence
from fractions import Fraction

import sympy

LONG = 12  # characters of a rational number that no file has
SAME = 1e-14
SMALL = 100  # largest denominator of a square that is recognised
DIGITS = 17


def recognised(expressions: Sequence[sympy.Expr]) -> list[sympy.Expr]:
    """Return the expressions, of which only the ratios count, with their long rationals as square roots or decimals.

    All are divided by the largest long one.
    """
    if not any(_is_long(x) for expression in expressions for x in expression.atoms(sympy.Rational)):
        return list(expressions)
    expanded = [sympy.expand(expression) for expression in expressions]
    largest = max(abs(x) for expression in expanded for x in expression.atoms(sympy.Rational))
    scaled = [sympy.expand(expression / largest) for expression in expanded]
    return [
        x.xreplace({number: _meant(number) for number in x.atoms(sympy.Rational) if _is_long(number)}) for x in scaled
    ]


def _is_long(x: sympy.Rational) -> bool:
    return len(str(x)) > LONG


def _meant(x: sympy.Rational) -> sympy.Expr:
    square = Fraction(float(x) ** 2).limit_denominator(SMALL)
    if square and abs(float(square) / float(x) ** 2 - 1) < SAME:
        return sympy.sign(x) * sympy.sqrt(sympy.Rational(square.numerator, square.denominator))
    return sympy.Float(x, DIGITS)
