"""Trigonometric polynomials written as a person writes them.

Angles of joints with parallel axes are added up, cos(q2 + q3); those of others stand beside each other,
cos(q1) cos(q2 + q3). What all terms share stands in front. Numbers that are known to 1e-16 are written as those that
are meant: √3/2 for 2984975067132296/3446752317066305.
"""

from collections.abc import Sequence
from fractions import Fraction
from typing import Any, NamedTuple

import sympy
from sympy.polys.domains import QQ_I
from sympy.polys.monomials import monomial_min
from sympy.polys.rings import PolyElement

from robotics1.symbolic.polynomials.trig_polynomial import Exponents, TrigPolynomial, polynomial

LONGEST_DENOMINATOR = 10**12
LONG = 12  # characters of a rational number that no file has
SAME = 1e-14
SMALL = 100  # largest denominator of a square that is recognised
DIGITS = 17

Groups = tuple[tuple[int, ...], ...]  # the places of angles that are added up


class Wave(NamedTuple):
    """cos(m·φ) or sin(m·φ), with the first multiple that is not zero positive."""

    multiples: tuple[int, ...]
    sine: bool


def written_in_halves(f: TrigPolynomial, groups: Groups) -> sympy.Expr:
    """Return a real polynomial with multiples of φ/2 as exponents in SymPy."""
    halves = {angle: angle / 2 for angle in f.trig_ring.angles}
    return written(f, groups).subs(halves, simultaneous=True)


def written(f: TrigPolynomial, groups: Groups) -> sympy.Expr:
    """Return a real trigonometric polynomial in SymPy, angles added up within the groups."""
    terms = _in_waves(f, groups)
    if not terms:
        return sympy.S.Zero
    waves = [set(key) for key in terms]
    shared = set.intersection(*waves)
    shared_powers = monomial_min(*(m for c in terms.values() for m in c.itermonoms()))
    lengths = f.trig_ring.ring.from_dict({shared_powers: f.trig_ring.ring.domain.one})
    total = sympy.Add(
        *(
            polynomial(c.quo(lengths)) * sympy.Mul(*(_wave(wave, f) for wave in key if wave not in shared))
            for key, c in sorted(terms.items(), key=lambda item: str(item[0]), reverse=True)
        )
    )
    front = [polynomial(lengths), *(_wave(wave, f) for wave in shared)]
    if total.is_Add and total.could_extract_minus_sign():
        return sympy.Mul(-1, *front, -total)
    return sympy.Mul(*front, total)


def _in_waves(f: TrigPolynomial, groups: Groups) -> dict[tuple[Wave, ...], PolyElement]:
    """Return f as a sum of products of waves, one of each group at most; one group after the other."""
    zero = f.trig_ring.ring.zero
    terms: dict[tuple[tuple[Wave, ...], Exponents], PolyElement] = {((), k): c for k, c in f.terms.items()}
    for group in groups:
        changed: dict[tuple[tuple[Wave, ...], Exponents], PolyElement] = {}
        for (waves, k), c in terms.items():
            m = tuple(value if j in group else 0 for j, value in enumerate(k))
            rest = tuple(0 if j in group else value for j, value in enumerate(k))
            for wave, factor in _exponential(m):
                key = ((*waves, *wave), rest)
                changed[key] = changed.get(key, zero) + (c if factor is None else c.mul_ground(factor))
        terms = {key: c for key, c in changed.items() if c}
    return {waves: c for (waves, _), c in terms.items()}


def _exponential(m: Exponents) -> list[tuple[tuple[Wave, ...], Any]]:
    """Return exp(i m·φ) as cos ± i sin, each wave with its factor; None is 1."""
    first = next((value for value in m if value), 0)
    if first == 0:
        return [((), None)]
    positive = m if first > 0 else tuple(-value for value in m)
    return [((Wave(positive, False),), None), ((Wave(positive, True),), QQ_I(0, 1 if first > 0 else -1))]


def _wave(wave: Wave, f: TrigPolynomial) -> sympy.Expr:
    angle = f.trig_ring.angle(wave.multiples)
    return sympy.sin(angle) if wave.sine else sympy.cos(angle)


def written_product(factors: tuple[TrigPolynomial, ...], groups: Groups) -> sympy.Expr:
    """Return a product of trigonometric polynomials in SymPy: one number in front, and each factor without its own."""
    number: sympy.Expr = sympy.S.One
    parts = []
    for factor in factors:
        content, part = written(factor, groups).as_content_primitive()
        if part.could_extract_minus_sign():
            content, part = -content, -part
        number *= content
        parts.append(part)
    return number * sympy.Mul(*parts)


def without_long_fractions(e: sympy.Expr) -> sympy.Expr:
    """Return an expression with floats for the fractions that nobody reads."""
    long = [x for x in e.atoms(sympy.Rational) if x.q > LONGEST_DENOMINATOR]
    return e.xreplace({x: sympy.Float(float(x)) for x in long})


def recognised(expressions: Sequence[sympy.Expr]) -> list[sympy.Expr]:
    """Return the expressions, whose ratios alone count, with their long rationals as square roots or decimals.

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
