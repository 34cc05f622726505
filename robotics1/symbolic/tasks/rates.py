"""The time derivative of a Jacobian, and what it adds to the acceleration: r̈ = J q̈ + J̇ q̇.

Sums of angles stay together, and so do their rates: of l2 cos(q1 + q2) comes −l2 (q̇1 + q̇2) sin(q1 + q2).
"""

from collections import defaultdict
from collections.abc import Callable
from functools import cache

import sympy

Symbols = tuple[sympy.Symbol, ...]


def rate_of(J: sympy.Matrix, q: Symbols, qdot: Symbols) -> sympy.Matrix:
    """Return dJ/dt, for constant q̇."""
    rates = J.applyfunc(_derivation(q, qdot)).replace(sympy.sign, lambda x: x / sympy.Abs(x))
    return rates.replace(lambda e: e.is_Mul, _signs_in_front)  # sign(x) is written so that it cancels with |x|


def velocity_product_of(J: sympy.Matrix, q: Symbols, qdot: Symbols) -> sympy.Matrix:
    """Return J̇ q̇, (m, 1): the rate of J q̇ for constant q̇."""
    velocity = sympy.Matrix([_collected(J.row(i), qdot) for i in range(J.rows)])
    return rate_of(velocity, q, qdot)


def _derivation(q: Symbols, qdot: Symbols) -> Callable[[sympy.Expr], sympy.Expr]:
    """Return d/dt by the rules of the sum, the product and the chain.

    SymPy's own `diff` gives the same, and takes ten times as long on the products of a long arm.
    """
    rates = dict(zip(q, qdot, strict=True))

    @cache
    def rate(e: sympy.Expr) -> sympy.Expr:
        if not e.args:
            return rates.get(e, sympy.S.Zero)
        if e.is_Add:
            return sympy.Add(*map(rate, e.args))
        if e.is_Mul:
            parts = [(i, rate(part)) for i, part in enumerate(e.args)]
            return sympy.Add(*(sympy.Mul(*e.args[:i], d, *e.args[i + 1 :]) for i, d in parts if d != 0))
        if e.func in (sympy.sin, sympy.cos):
            return e.fdiff() * rate(e.args[0])
        if e.is_Pow and e.exp.is_number:
            return e.exp * e.base ** (e.exp - 1) * rate(e.base)
        return sympy.Add(*(e.diff(x) * w for x, w in rates.items()))

    return rate


def _collected(row: sympy.Matrix, qdot: Symbols) -> sympy.Expr:
    """Return a row of J times q̇, each term once, with the sum of the rates it belongs to."""
    rates: dict[sympy.Expr, sympy.Expr] = defaultdict(lambda: sympy.S.Zero)
    for entry, rate in zip(row, qdot, strict=True):
        for term in sympy.Add.make_args(entry.expand(deep=False)):
            number, rest = term.as_coeff_Mul()
            rates[rest] += number * rate
    return sympy.Add(*(term * sympy.factor_terms(rate) for term, rate in rates.items()))


def _signs_in_front(product: sympy.Expr) -> sympy.Expr:
    """Return a product with −(a + b) for the factors −a − b."""
    negative = [part for part in product.args if part.is_Add and part.could_extract_minus_sign()]
    others = [part for part in product.args if part not in negative]
    return sympy.Mul((-1) ** len(negative), *others, *(-part for part in negative))
