"""Trigonometric polynomials, in the form in which sums of angles and cos² + sin² = 1 come by themselves.

A trigonometric polynomial is a Laurent polynomial in the exponentials zⱼ = exp(i φⱼ) of the angles,

f = Σₖ cₖ exp(i k·φ),  k ∈ ℤⁿ,

with coefficients cₖ that are polynomials in the lengths over ℚ(i). The form is unique, so f = 0 is seen at once.

A joint with followers that turn by fractions of its angle q has φ = q/d, with d the common denominator: all of them
turn by whole multiples of φ.
"""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, reduce
from typing import Any

import numpy as np
import sympy
from sympy.polys.domains import QQ, QQ_I
from sympy.polys.rings import PolyElement, PolyRing

from robotics1.symbolic.polynomials.time_limit import check_time

Exponents = tuple[int, ...]
Matrix = np.ndarray[Any, Any]  # of trigonometric polynomials
ROOTS = {"√2": 2, "√3": 3}  # generators that stand for square roots


@dataclass(frozen=True)
class TrigRing:
    """What the trigonometric polynomials of a chain are made of.

    Attributes:
        angles: the symbols of the revolute joints and of angles that have names: d φ.
        ring: ℚ(i)[prismatic joints, lengths, √2, √3].
        q: the symbols of the joints, among both.
        turns: d, one for each angle: after so many turns of the joint its followers are back too; none where all are 1.
    """

    angles: tuple[sympy.Symbol, ...]
    ring: PolyRing
    q: tuple[sympy.Symbol, ...]
    turns: tuple[int, ...] = ()

    def __reduce__(self) -> tuple[Any, ...]:
        return _trig_ring, (self.angles, self.ring.symbols, self.q, self.turns)  # SymPy's rings cannot be pickled

    def turns_of(self, symbol: sympy.Symbol) -> int:
        """Return d of an angle; 1 of a length."""
        return self.turns[self.angles.index(symbol)] if self.turns and symbol in self.angles else 1

    def angle(self, multiples: Sequence[int]) -> sympy.Expr:
        """Return k·φ, of the symbols of the angles."""
        return sympy.Add(
            *(sympy.Rational(k, self.turns_of(s)) * s for k, s in zip(multiples, self.angles, strict=True))
        )

    def constant(self, value: Any) -> "TrigPolynomial":
        """Return a coefficient as a polynomial without angles."""
        coefficient = self.ring(value)
        return TrigPolynomial(self, {self.zero: coefficient} if coefficient else {})

    def exponential(self, multiples: Mapping[sympy.Symbol, int]) -> "TrigPolynomial":
        """Return exp(i k·φ), of angle → k."""
        k = tuple(multiples.get(angle, 0) for angle in self.angles)
        return TrigPolynomial(self, {k: self.ring.one})

    def root(self, k: int) -> PolyElement:
        """Return √k, for k = 1, 2, 3 or 6."""
        found = self.ring.one
        for name, square in ROOTS.items():
            if k % square == 0:
                found *= self.ring(sympy.Symbol(name))
        return found

    def turn(self, k: int) -> "TrigPolynomial":
        """Return exp(i k π/12)."""
        i = self.ring(QQ_I(0, 1))
        # exp(iπ/12) = exp(iπ/4) exp(−iπ/6); products reduce √2² and √3²
        step = self.constant(self.root(2) * (1 + i) / 2) * self.constant((self.root(3) - i) / 2)
        quarters, rest = divmod(k % 24, 6)
        return self.constant(i**quarters) * step**rest

    @property
    def zero(self) -> Exponents:
        """The exponents k = 0."""
        return (0,) * len(self.angles)


@dataclass(frozen=True, eq=False)
class TrigPolynomial:
    """f = Σₖ cₖ exp(i k·φ), with the terms k → cₖ that do not vanish."""

    trig_ring: TrigRing
    terms: dict[Exponents, PolyElement]

    def __reduce__(self) -> tuple[Any, ...]:
        numbers = {k: {m: _integers(a) for m, a in c.items()} for k, c in self.terms.items()}
        return _trig_polynomial, (self.trig_ring, numbers)

    @property
    def angles(self) -> tuple[int, ...]:
        """The places of the angles it depends on."""
        return tuple(j for j in range(len(self.trig_ring.angles)) if any(k[j] for k in self.terms))

    def __bool__(self) -> bool:
        return bool(self.terms)

    def __add__(self, other: "TrigPolynomial") -> "TrigPolynomial":
        terms = dict(self.terms)
        for k, c in other.terms.items():
            terms[k] = terms[k] + c if k in terms else c
        return TrigPolynomial(self.trig_ring, {k: c for k, c in terms.items() if c})

    def __neg__(self) -> "TrigPolynomial":
        return TrigPolynomial(self.trig_ring, {k: -c for k, c in self.terms.items()})

    def __sub__(self, other: "TrigPolynomial") -> "TrigPolynomial":
        return self + -other

    def __mul__(self, other: "TrigPolynomial") -> "TrigPolynomial":
        terms: dict[Exponents, PolyElement] = {}
        for k, c in self.terms.items():
            check_time()
            for m, d in other.terms.items():
                n = tuple(a + b for a, b in zip(k, m, strict=True))
                terms[n] = terms[n] + c * d if n in terms else c * d
        return TrigPolynomial(self.trig_ring, {k: c for k, c in ((k, reduced(c)) for k, c in terms.items()) if c})

    def __pow__(self, n: int) -> "TrigPolynomial":
        return reduce(TrigPolynomial.__mul__, [self] * n, self.trig_ring.constant(1))

    @property
    def conjugate(self) -> "TrigPolynomial":
        """The complex conjugate: f itself if it is real, the inverse if it is exp(i α)."""
        return TrigPolynomial(self.trig_ring, {tuple(-m for m in k): conjugate(c) for k, c in self.terms.items()})

    @property
    def symbols(self) -> set[sympy.Symbol]:
        """The angles and lengths it depends on."""
        F = self.trig_ring
        used = {F.ring.symbols[i] for c in self.terms.values() for m in c.itermonoms() for i, e in enumerate(m) if e}
        return {symbol for symbol in used if str(symbol) not in ROOTS} | {F.angles[j] for j in self.angles}

    @property
    def has_roots(self) -> bool:
        """Whether √2 or √3 is in a coefficient."""
        places = _root_places(self.trig_ring.ring)
        return any(m[place] for c in self.terms.values() for m in c.itermonoms() for place in places)

    @property
    def largest(self) -> float:
        """The largest modulus of a number in a coefficient."""
        return max((abs(x) for c in self.terms.values() for x in _in_numbers(c).values()), default=0.0)

    def without_rounding(self, least: float) -> "TrigPolynomial":
        """Return f without the coefficients whose modulus is at most `least`, √2 and √3 being numbers."""
        terms = {}
        places = _root_places(self.trig_ring.ring)
        for k, c in self.terms.items():
            small = {m for m, x in _in_numbers(c).items() if abs(x) <= least}
            kept = {m: a for m, a in c.terms() if _without_roots(m, places) not in small}
            if kept:
                terms[k] = self.trig_ring.ring.from_dict(kept)
        return TrigPolynomial(self.trig_ring, terms)

    def coefficients(self, symbol: sympy.Symbol) -> dict[int, "TrigPolynomial"]:
        """Return f as a polynomial in exp(i φ) of an angle φ, or in a generator of the ring: power → coefficient."""
        F = self.trig_ring
        j = [*F.angles, *F.ring.symbols].index(symbol)
        parts: dict[int, dict[Exponents, dict[Exponents, Any]]] = {}
        for k, c in self.terms.items():
            for m, a in c.terms():
                exponents = [*k, *m]
                power, exponents[j] = exponents[j], 0
                others = tuple(exponents[: len(k)]), tuple(exponents[len(k) :])
                parts.setdefault(power, {}).setdefault(others[0], {})[others[1]] = a
        return {
            power: TrigPolynomial(F, {k: F.ring.from_dict(c) for k, c in terms.items()})
            for power, terms in parts.items()
        }

    def derivative(self, symbol: sympy.Symbol) -> "TrigPolynomial":
        """Return ∂f/∂symbol, for an angle or a generator of the ring."""
        if symbol in self.trig_ring.angles:
            j = self.trig_ring.angles.index(symbol)
            i = self.trig_ring.ring(QQ_I(0, 1) / self.trig_ring.turns_of(symbol))
            return TrigPolynomial(self.trig_ring, {k: i * k[j] * c for k, c in self.terms.items() if k[j]})
        generator = self.trig_ring.ring(symbol)
        terms = {k: c.diff(generator) for k, c in self.terms.items()}
        return TrigPolynomial(self.trig_ring, {k: c for k, c in terms.items() if c})


def _trig_ring(
    angles: tuple[sympy.Symbol, ...],
    generators: tuple[sympy.Symbol, ...],
    q: tuple[sympy.Symbol, ...],
    turns: tuple[int, ...],
) -> TrigRing:
    return TrigRing(angles, PolyRing(generators, QQ_I), q, turns)


def _trig_polynomial(F: TrigRing, numbers: dict[Exponents, dict[Exponents, tuple[int, ...]]]) -> TrigPolynomial:
    def element(a: int, b: int, c: int, d: int) -> Any:
        return QQ_I(QQ(a, b), QQ(c, d))

    return TrigPolynomial(F, {k: F.ring.from_dict({m: element(*n) for m, n in c.items()}) for k, c in numbers.items()})


def _in_numbers(c: PolyElement) -> dict[Exponents, complex]:
    """Return the coefficients of a polynomial in the lengths, √2 and √3 being numbers."""
    places = _root_places(c.ring)
    found: dict[Exponents, complex] = {}
    for m, a in c.terms():
        x = complex(float(a.x), float(a.y))
        for place in places:
            x *= ROOTS[str(c.ring.symbols[place])] ** (m[place] / 2)
        key = _without_roots(m, places)
        found[key] = found.get(key, 0.0) + x
    return found


def _without_roots(m: Exponents, places: Collection[int]) -> Exponents:
    return tuple(0 if i in places else e for i, e in enumerate(m))


def _integers(a: Any) -> tuple[int, int, int, int]:
    """Return the numerators and denominators of the real and the imaginary part of an element of ℚ(i)."""
    return int(a.x.numerator), int(a.x.denominator), int(a.y.numerator), int(a.y.denominator)


def gaussian(value: Any) -> Any:
    """Return a rational number of any kind, with p and q or numerator and denominator, as an element of ℚ(i)."""
    p, q = (value.p, value.q) if hasattr(value, "p") else (value.numerator, value.denominator)
    return QQ_I(int(p), 0) / int(q)


def reduced(c: PolyElement) -> PolyElement:
    """Return a coefficient with the squares of the generators √2 and √3 replaced by 2 and 3."""
    places = _root_places(c.ring)
    if all(m[place] < 2 for m in c.itermonoms() for place in places):
        return c
    return c.rem([c.ring.gens[place] ** 2 - square for place, square in places.items()])


@cache
def _root_places(ring: PolyRing) -> dict[int, int]:
    """Return the place of each generator that stands for a root → its square."""
    return {place: ROOTS[str(s)] for place, s in enumerate(ring.symbols) if str(s) in ROOTS}


def conjugate(c: PolyElement) -> PolyElement:
    """Return a coefficient with i replaced by −i."""
    return c.ring.from_dict({m: QQ_I(a.x, -a.y) for m, a in c.terms()})


def polynomial(c: PolyElement) -> sympy.Expr:
    """Return a coefficient in SymPy, with √2 and √3 as roots."""
    roots = {symbol: sympy.sqrt(ROOTS[str(symbol)]) for symbol in c.ring.symbols if str(symbol) in ROOTS}
    return c.as_expr().subs(roots) if roots else c.as_expr()
