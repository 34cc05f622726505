"""Trigonometric polynomials, in the form in which sums of angles and cos² + sin² = 1 come by themselves.

A trigonometric polynomial is a Laurent polynomial in the exponentials zⱼ = exp(i φⱼ) of the angles,

f = Σₖ cₖ exp(i k·φ),  k ∈ ℤⁿ,

with coefficients cₖ that are polynomials in the lengths over ℚ(i). The form is unique, so f = 0 is seen at once.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import sympy
from sympy.polys.domains import QQ_I
from sympy.polys.rings import PolyElement, PolyRing

Exponents = tuple[int, ...]
ROOTS = {"√2": 2, "√3": 3}  # generators that stand for square roots


@dataclass(frozen=True)
class Frequencies:
    """What the trigonometric polynomials of a chain are made of.

    Attributes:
        angles: the symbols φ of the revolute joints and of angles that have names.
        ring: ℚ(i)[lengths, prismatic joints, √2, √3].
    """

    angles: tuple[sympy.Symbol, ...]
    ring: PolyRing

    def constant(self, value: Any) -> "Laurent":
        """Return a coefficient as a polynomial without angles."""
        coefficient = self.ring(value)
        return Laurent(self, {self.zero: coefficient} if coefficient else {})

    def exponential(self, multiples: Mapping[sympy.Symbol, int]) -> "Laurent":
        """Return exp(i k·φ)."""
        k = tuple(multiples.get(angle, 0) for angle in self.angles)
        return Laurent(self, {k: self.ring.one})

    @property
    def zero(self) -> Exponents:
        """The exponents k = 0."""
        return (0,) * len(self.angles)


@dataclass(frozen=True, eq=False)
class Laurent:
    """f = Σₖ cₖ exp(i k·φ), with the terms k → cₖ that do not vanish."""

    frequencies: Frequencies
    terms: dict[Exponents, PolyElement]

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __add__(self, other: "Laurent") -> "Laurent":
        terms = dict(self.terms)
        for k, c in other.terms.items():
            terms[k] = terms[k] + c if k in terms else c
        return Laurent(self.frequencies, {k: c for k, c in terms.items() if c})

    def __neg__(self) -> "Laurent":
        return Laurent(self.frequencies, {k: -c for k, c in self.terms.items()})

    def __sub__(self, other: "Laurent") -> "Laurent":
        return self + -other

    def __mul__(self, other: "Laurent") -> "Laurent":
        terms: dict[Exponents, PolyElement] = {}
        for k, c in self.terms.items():
            for m, d in other.terms.items():
                n = tuple(a + b for a, b in zip(k, m, strict=True))
                terms[n] = terms[n] + c * d if n in terms else c * d
        return Laurent(self.frequencies, {k: c for k, c in ((k, reduced(c)) for k, c in terms.items()) if c})

    def derivative(self, symbol: sympy.Symbol) -> "Laurent":
        """Return ∂f/∂symbol, for an angle or a generator of the ring."""
        if symbol in self.frequencies.angles:
            j = self.frequencies.angles.index(symbol)
            i = self.frequencies.ring(QQ_I(0, 1))
            return Laurent(self.frequencies, {k: i * k[j] * c for k, c in self.terms.items() if k[j]})
        generator = self.frequencies.ring(symbol)
        terms = {k: c.diff(generator) for k, c in self.terms.items()}
        return Laurent(self.frequencies, {k: c for k, c in terms.items() if c})


def reduced(c: PolyElement) -> PolyElement:
    """Return a coefficient with the squares of the generators √2 and √3 replaced by 2 and 3."""
    relations = [g**2 - ROOTS[str(s)] for g, s in zip(c.ring.gens, c.ring.symbols, strict=True) if str(s) in ROOTS]
    return c.rem(relations) if relations else c


def conjugate(c: PolyElement) -> PolyElement:
    """Return a coefficient with i replaced by −i."""
    return c.ring.from_dict({m: QQ_I(a.x, -a.y) for m, a in c.terms()})


def polynomial(c: PolyElement) -> sympy.Expr:
    """Return a coefficient in SymPy, with √2 and √3 as roots."""
    roots = {symbol: sympy.sqrt(ROOTS[str(symbol)]) for symbol in c.ring.symbols if str(symbol) in ROOTS}
    return c.as_expr().subs(roots) if roots else c.as_expr()
