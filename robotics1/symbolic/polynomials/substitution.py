"""A joint (or a named length) replaced by its value, in trigonometric polynomials."""

from dataclasses import dataclass

import sympy

from robotics1.caching import cached_property
from robotics1.symbolic.polynomials.laurent import Laurent


@dataclass(frozen=True, eq=False)
class Substitution:
    """φ = α(other angles), or a length = its value.

    Attributes:
        symbol: φ, or a length or prismatic joint.
        value: of an angle exp(i α), one term of modulus one; of a length the polynomial.
    """

    symbol: sympy.Symbol
    value: Laurent

    @cached_property
    def is_angle(self) -> bool:
        """Whether the symbol is an angle."""
        return self.symbol in self.value.frequencies.angles

    def __call__(self, f: Laurent) -> Laurent:
        """Return f with the symbol replaced."""
        if self.symbol not in f.symbols:
            return f
        pieces = self._by_power_of_angle(f) if self.is_angle else self._by_power_of_length(f)
        total = f.frequencies.constant(0)
        for power, piece in pieces.items():
            total = total + piece * self._power(power)
        return total

    def _by_power_of_angle(self, f: Laurent) -> dict[int, Laurent]:
        j = f.frequencies.angles.index(self.symbol)
        pieces: dict[int, Laurent] = {}
        for k, c in f.terms.items():
            pieces.setdefault(k[j], Laurent(f.frequencies, {})).terms[(*k[:j], 0, *k[j + 1 :])] = c
        return pieces

    def _by_power_of_length(self, f: Laurent) -> dict[int, Laurent]:
        ring = f.frequencies.ring
        i = ring.symbols.index(self.symbol)
        pieces: dict[int, Laurent] = {}
        for k, c in f.terms.items():
            for m, a in c.terms():
                terms = pieces.setdefault(m[i], Laurent(f.frequencies, {})).terms
                terms[k] = terms.get(k, ring.zero) + ring.from_dict({(*m[:i], 0, *m[i + 1 :]): a})
        return pieces

    def _power(self, power: int) -> Laurent:
        base = self.value if power >= 0 else self.value.conjugate
        found = self.value.frequencies.constant(1)
        for _ in range(abs(power)):
            found = found * base
        return found
