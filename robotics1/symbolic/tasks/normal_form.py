"""Expressions brought back to trigonometric polynomials, where they are some.

A task is an expression in p, R and q. Its polynomial parts have one form only, in which cos² + sin² = 1 and
the sums of angles are done; roots, quotients and arcs are kept around them.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from typing import Any

import sympy

from robotics1.caching import cached_property
from robotics1.symbolic.kinematics.exact import exact_length
from robotics1.symbolic.polynomials.factoring import factors
from robotics1.symbolic.polynomials.trig_polynomial import ROOTS, TrigPolynomial, gaussian
from robotics1.symbolic.writing.sums_of_angles import written_product
from robotics1.symbolic.writing.term_budget import MOST_TERMS, Entry, TermBudget

HIGHEST_POWER = 12


class NotPolynomialError(Exception):
    """An expression is no trigonometric polynomial, or too long a one."""


@dataclass(frozen=True, eq=False)
class NormalForm:
    """The reading of expressions in given symbols.

    Attributes:
        budget: how polynomials are written.
        known: symbol → the entry it stands for.
        angle: the angle of a sine and a cosine.
    """

    budget: TermBudget
    known: Mapping[sympy.Symbol, Entry]
    angle: Callable[[Any, Any], sympy.Expr] = sympy.atan2
    _read: dict[sympy.Expr, TrigPolynomial | None] = field(default_factory=dict)
    _bases: dict[sympy.Expr, sympy.Expr] = field(default_factory=dict)
    _factors: dict[sympy.Expr, sympy.Expr] = field(default_factory=dict)

    def polynomial(self, expression: sympy.Expr) -> TrigPolynomial | None:
        """Return an expression as a trigonometric polynomial, or None if it is none or too long."""
        if expression not in self._read:
            try:
                self._read[expression] = self._polynomial(expression)
            except NotPolynomialError:
                self._read[expression] = None
        return self._read[expression]

    def _polynomial(self, e: sympy.Expr) -> TrigPolynomial:
        F = self.budget.trig_ring
        if e.is_Float or e.is_Rational:
            return F.constant(gaussian(exact_length(float(e)) if e.is_Float else e))
        if e.is_Symbol:
            return self._symbol(e)
        if e.is_Add:
            return reduce(TrigPolynomial.__add__, map(self._part, e.args))
        if e.is_Mul:
            return reduce(self._product, map(self._part, e.args))
        if e.is_Pow:
            return self._power(*e.args)
        return self._wave(e)

    def _wave(self, e: sympy.Expr) -> TrigPolynomial:
        """Return a sine or a cosine."""
        if e.func not in (sympy.sin, sympy.cos):
            raise NotPolynomialError
        F = self.budget.trig_ring
        turn, half = self._turn(e.args[0]), F.ring.domain(1, 0) / 2
        if e.func is sympy.cos:
            return (turn + turn.conjugate) * F.constant(half)
        return (turn - turn.conjugate) * F.constant(half * F.ring.domain(0, -1))

    def _part(self, e: sympy.Expr) -> TrigPolynomial:
        found = self.polynomial(e)
        if found is None:
            raise NotPolynomialError
        return found

    def _symbol(self, symbol: sympy.Symbol) -> TrigPolynomial:
        entry = self.known.get(symbol)
        ring = self.budget.trig_ring.ring
        if entry is None and symbol in ring.symbols:
            return self.budget.trig_ring.constant(ring(symbol))
        if not isinstance(entry, TrigPolynomial):
            raise NotPolynomialError
        return entry

    def _power(self, base: sympy.Expr, exponent: sympy.Expr) -> TrigPolynomial:
        F = self.budget.trig_ring
        if base.is_Integer and exponent == sympy.Rational(1, 2) and base in ROOTS.values():
            return F.constant(F.root(int(base)))
        if not exponent.is_Integer or not 0 <= exponent <= HIGHEST_POWER:
            raise NotPolynomialError
        return reduce(self._product, [self._part(base)] * int(exponent), F.constant(1))

    def _product(self, a: TrigPolynomial, b: TrigPolynomial) -> TrigPolynomial:
        product = self.budget.total([(a, b)])
        if not isinstance(product, TrigPolynomial):
            raise NotPolynomialError
        return product

    def _turn(self, angle: sympy.Expr) -> TrigPolynomial:
        """Return exp(i angle) of whole multiples of angles and a multiple of π/12."""
        F = self.budget.trig_ring
        multiples, rest = {}, sympy.expand(angle)
        for symbol in F.angles:
            multiple = rest.coeff(symbol)
            multiples[symbol], rest = multiple * F.turns_of(symbol), rest - multiple * symbol
        twelfths = rest * 12 / sympy.pi
        if not twelfths.is_Integer or not all(multiple.is_Integer for multiple in multiples.values()):
            raise NotPolynomialError
        return F.exponential({symbol: int(multiple) for symbol, multiple in multiples.items()}) * F.turn(int(twelfths))

    def entry(self, e: sympy.Expr) -> Entry:
        """Return an expression as a polynomial if it is one, else written."""
        found = self.polynomial(e)
        return self.written(e) if found is None else found

    def written(self, e: sympy.Expr) -> sympy.Expr:
        """Return an expression with its polynomial parts in their one form."""
        found = self.polynomial(e)
        if found is not None:
            return self.budget.written(found)
        if e.is_Symbol:
            return self.known.get(e, e)
        if e.is_Pow:
            return self._base(e.base) ** self.written(e.exp)
        if e.is_Add or e.is_Mul:
            return self._with_parts_together(e)
        arguments = map(self.written, e.args)
        return self.angle(*arguments) if e.func is sympy.atan2 else e.func(*arguments)

    def _with_parts_together(self, e: sympy.Expr) -> sympy.Expr:
        """Return a sum or a product with the polynomials among its parts made one."""
        read = [part for part in e.args if self.polynomial(part) is not None]
        rest = [part for part in e.args if self.polynomial(part) is None]
        together = self.polynomial(e.func(*read))
        if together is None:
            return e.func(*map(self.written, e.args))
        if e.is_Mul:
            return self.times(together, rest)
        return self.budget.written(together) + sympy.Add(*map(self.written, rest))

    def times(self, f: Entry, parts: Sequence[sympy.Expr]) -> sympy.Expr:
        """Return the product of a polynomial and of expressions that are none: as factors if that is shorter."""
        plain = sympy.Mul(self.budget.written(f), *map(self.written, parts))
        if not isinstance(f, TrigPolynomial) or not parts:
            return plain
        return _shortest(plain, sympy.Mul(self.factored(f), *map(self._in_factors, parts)))

    def factored(self, f: TrigPolynomial) -> sympy.Expr:
        """Return a polynomial as the product of its factors, if it is short."""
        if len(f.terms) > MOST_TERMS:
            return self.budget.written(f)
        return written_product(factors(f), self.budget.groups) if f else sympy.S.Zero

    def _in_factors(self, e: sympy.Expr) -> sympy.Expr:
        """Return a root or a quotient of a polynomial as that of its factors."""
        base = self.polynomial(e.base) if e.is_Pow else None
        if base is None:
            return self.written(e)
        if e not in self._factors:
            self._factors[e] = self.factored(base) ** self.written(e.exp)
        return self._factors[e]

    def _base(self, e: sympy.Expr) -> sympy.Expr:
        """Return what a root is taken of, or is divided by, in its shortest form."""
        found = self.polynomial(e)
        if found is None:
            return self.written(e)
        if e not in self._bases:
            plain = e.xreplace(self._written_symbols)
            self._bases[e] = _shortest(plain, self.budget.written(found), self.factored(found))
        return self._bases[e]

    @cached_property
    def _written_symbols(self) -> dict[sympy.Symbol, sympy.Expr]:
        return {symbol: self.budget.written(entry) for symbol, entry in self.known.items()}


def _shortest(*forms: sympy.Expr) -> sympy.Expr:
    return min(forms, key=sympy.count_ops)
