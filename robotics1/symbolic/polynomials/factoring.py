"""Irreducible factors of a trigonometric polynomial, such as sin(q3), sin(q2 + q3) or a2 cos(q2) + a3 cos(q2 + q3).

The numerator in half-angle tangents is factored over ℚ. There sin(φ) falls into two parts, t = 0 and t = ∞, which
are sin(φ/2) and cos(φ/2); parts of half angles are multiplied together again where whole angles are wanted.
"""

from dataclasses import dataclass
from functools import reduce
from itertools import combinations
from typing import Any

import sympy
from flint import fmpq, fmpq_mpoly

from robotics1.caching import cached_property
from robotics1.symbolic.polynomials.half_tangents import (
    Degrees,
    context,
    highest_multiples,
    in_half_angles,
    is_multiple,
    numerator,
)
from robotics1.symbolic.polynomials.time_limit import check_time_to_factor
from robotics1.symbolic.polynomials.trig_polynomial import TrigPolynomial, TrigRing, gaussian


@dataclass(frozen=True)
class IrreducibleFactor:
    """N(t) / Πⱼ (1 + tⱼ²)^(eⱼ/2): a real polynomial of the half angles, and of the angles when all eⱼ are even."""

    trig_ring: TrigRing
    numerator: fmpq_mpoly
    degrees: Degrees  # eⱼ

    def __reduce__(self) -> tuple[Any, ...]:
        numbers = {m: (int(a.p), int(a.q)) for m, a in self.numerator.to_dict().items()}
        return _part, (self.trig_ring, numbers, self.degrees)  # FLINT's polynomials cannot be pickled

    @property
    def parity(self) -> Degrees:
        """Where half angles are left."""
        return tuple(e % 2 for e in self.degrees)

    @cached_property
    def in_half_angles(self) -> TrigPolynomial:
        """The part, with multiples of φ/2 as exponents."""
        return in_half_angles(self.trig_ring, self.numerator, self.degrees)

    @property
    def whole(self) -> TrigPolynomial:
        """A polynomial in whole angles with the same zeros: the part, or its square if it has half angles."""
        return (self * self if any(self.parity) else self).in_angles

    @property
    def symbols(self) -> set[sympy.Symbol]:
        """The angles and lengths it depends on."""
        return self.in_half_angles.symbols

    def divides(self, f: TrigPolynomial) -> bool:
        """Return whether an irreducible part is a factor of f."""
        if not f or not self.symbols <= f.symbols:
            return not f
        if not self.numerator.is_constant():
            return is_multiple(self.trig_ring, numerator(f), self.numerator)
        lengths = len(self.trig_ring.ring.symbols)
        found = numerator(f).degrees()[lengths:]
        return all(2 * d - int(n) >= e for d, n, e in zip(highest_multiples(f), found, self.degrees, strict=True))

    @property
    def in_angles(self) -> TrigPolynomial:
        """The part, for even eⱼ."""
        terms = self.in_half_angles.terms
        return TrigPolynomial(self.trig_ring, {tuple(k // 2 for k in half): c for half, c in terms.items()})

    def __mul__(self, other: "IrreducibleFactor") -> "IrreducibleFactor":
        degrees = tuple(a + b for a, b in zip(self.degrees, other.degrees, strict=True))
        return IrreducibleFactor(self.trig_ring, self.numerator * other.numerator, degrees)


def _part(F: TrigRing, numbers: dict[tuple[int, ...], tuple[int, int]], degrees: Degrees) -> IrreducibleFactor:
    return IrreducibleFactor(F, context(F).from_dict({m: fmpq(*a) for m, a in numbers.items()}), degrees)


def factors(f: TrigPolynomial) -> tuple[TrigPolynomial, ...]:
    """Return factors whose product is f, each as often as it occurs: a number, those of lengths alone, and then the
    others, the shorter first. The number 1 is left out, unless f is 1.
    """
    F = f.trig_ring
    number, parts = irreducible_factors(f)
    found = [part.in_angles for part in in_whole_angles(parts)]
    found.sort(key=lambda factor: (len(factor.angles), len(factor.terms), sorted(factor.terms)))
    return tuple(found) if found and number == F.constant(1) else (number, *found)


def irreducible_factors(f: TrigPolynomial) -> tuple[TrigPolynomial, list[IrreducibleFactor]]:
    """Return the number and the irreducible parts whose product is f, each as often as it occurs."""
    F = f.trig_ring
    N = numerator(f)
    parts = parts_of(F, N)
    for j, dj in enumerate(highest_multiples(f)):
        parts += [at_infinity(F, j)] * (2 * dj - sum(part.degrees[j] for part in parts))
    return F.constant(gaussian(N.factor()[0])), parts


def parts_of(F: TrigRing, N: fmpq_mpoly) -> list[IrreducibleFactor]:
    """Return the irreducible factors of N(t), each as often as it occurs."""
    lengths = len(F.ring.symbols)
    check_time_to_factor(N)
    _, found = N.factor()
    return [
        IrreducibleFactor(F, n, tuple(map(int, n.degrees()[lengths:]))) for n, power in found for _ in range(int(power))
    ]


def at_infinity(F: TrigRing, j: int) -> IrreducibleFactor:
    """Return cos(φⱼ/2), which vanishes at tⱼ = ∞."""
    return IrreducibleFactor(F, context(F).constant(1), tuple(int(i == j) for i in range(len(F.angles))))


def in_whole_angles(parts: list[IrreducibleFactor]) -> list[IrreducibleFactor]:
    """Multiply parts of half angles together so that all are of whole angles, two by two where that is enough.

    Of those with the same half angles the two with the shortest product belong together: sin(φ/2) and cos(φ/2).
    """
    whole = [part for part in parts if not any(part.parity)]
    halves = [part for part in parts if any(part.parity)]
    while True:
        pairs = [(a, b) for a, b in combinations(range(len(halves)), 2) if halves[a].parity == halves[b].parity]
        if not pairs:
            break
        a, b = min(pairs, key=lambda pair: len((halves[pair[0]] * halves[pair[1]]).in_half_angles.terms))
        whole.append(halves[a] * halves[b])
        halves = [part for i, part in enumerate(halves) if i not in (a, b)]
    return [*whole, reduce(lambda a, b: a * b, halves)] if halves else whole
