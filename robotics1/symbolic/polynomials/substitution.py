"""A joint (or a named length) replaced by its value, in trigonometric polynomials."""

from dataclasses import dataclass

import sympy

from robotics1.caching import cached_property
from robotics1.symbolic.polynomials.trig_polynomial import TrigPolynomial


@dataclass(frozen=True, eq=False)
class Substitution:
    """φ = α(other angles), or a length = its value.

    Attributes:
        symbol: φ, or a length or prismatic joint.
        value: of an angle exp(i α), one term of modulus one; of a length the polynomial.
    """

    symbol: sympy.Symbol
    value: TrigPolynomial

    @cached_property
    def is_angle(self) -> bool:
        """Whether the symbol is an angle."""
        return self.symbol in self.value.trig_ring.angles

    def __call__(self, f: TrigPolynomial) -> TrigPolynomial:
        """Return f with the symbol replaced."""
        if self.symbol not in f.symbols:
            return f
        pieces = self._by_power_of_angle(f) if self.is_angle else self._by_power_of_length(f)
        total = f.trig_ring.constant(0)
        for power, piece in pieces.items():
            total = total + piece * self._power(power)
        return total

    def _by_power_of_angle(self, f: TrigPolynomial) -> dict[int, TrigPolynomial]:
        j = f.trig_ring.angles.index(self.symbol)
        pieces: dict[int, TrigPolynomial] = {}
        for k, c in f.terms.items():
            pieces.setdefault(k[j], TrigPolynomial(f.trig_ring, {})).terms[(*k[:j], 0, *k[j + 1 :])] = c
        return pieces

    def _by_power_of_length(self, f: TrigPolynomial) -> dict[int, TrigPolynomial]:
        ring = f.trig_ring.ring
        i = ring.symbols.index(self.symbol)
        pieces: dict[int, TrigPolynomial] = {}
        for k, c in f.terms.items():
            for m, a in c.terms():
                terms = pieces.setdefault(m[i], TrigPolynomial(f.trig_ring, {})).terms
                terms[k] = terms.get(k, ring.zero) + ring.from_dict({(*m[:i], 0, *m[i + 1 :]): a})
        return pieces

    def _power(self, power: int) -> TrigPolynomial:
        base = self.value if power >= 0 else self.value.conjugate
        found = self.value.trig_ring.constant(1)
        for _ in range(abs(power)):
            found = found * base
        return found
