"""Numbers from trigonometric polynomials."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mpmath
import numpy as np
import numpy.typing as npt
import sympy

from robotics1.angles import without_turns
from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.symbolic.polynomials.factoring import IrreducibleFactor
from robotics1.symbolic.polynomials.trig_polynomial import ROOTS, TrigPolynomial

VANISHES = 1e-12  # of a polynomial, beside its largest coefficient
LARGEST = 900  # the largest exponent, of either sign, of numbers that are left as they are
WIDE = mpmath.MPContext()  # numbers with 64 bits and an exponent of any size
WIDE.prec = 64
MOST_MULTIPLE = 4  # order of a zero that is found to rounding


@dataclass(frozen=True, eq=False)
class Evaluated:
    """f(q) as a function of numbers, with the parameters at given values.

    Where a coefficient is too large or too small for a double, all are divided by one power of two: the zeros stay.

    Attributes:
        f: a real trigonometric polynomial.
        parameters: the value of each named length and angle.
        unit: what the multiples of angles are multiples of: 1, or 1/2 of a polynomial in half angles.
    """

    f: TrigPolynomial
    parameters: Mapping[sympy.Symbol, float]
    unit: float = 1.0

    @cached_property
    def q(self) -> tuple[sympy.Symbol, ...]:
        """The symbols of the joints."""
        return self.f.trig_ring.q

    @cached_property
    def _table(self) -> tuple[Any, Array, Array]:
        """The terms: complex amplitudes (k,), multiples of the joint angles (k, n), powers of prismatic ones."""
        F = self.f.trig_ring
        amplitudes, multiples, powers = [], [], []
        for k, c in self.f.terms.items():
            for m, a in c.terms():
                value = _number(a)
                power, multiple = np.zeros(len(self.q)), np.zeros(len(self.q))
                for symbol, e in zip(F.ring.symbols, m, strict=True):
                    if symbol in self.q:
                        power[self.q.index(symbol)] = e
                    elif e:
                        value *= self._value_of(symbol) ** int(e)
                for symbol, e in zip(F.angles, k, strict=True):
                    if symbol in self.q:
                        multiple[self.q.index(symbol)] = e * self.unit / F.turns_of(symbol)
                    elif e:
                        value *= WIDE.expj(e * self.unit * self.parameters[symbol])
                amplitudes.append(value)
                multiples.append(multiple)
                powers.append(power)
        n = len(self.q)
        return _in_doubles(amplitudes), np.reshape(multiples, (-1, n)), np.reshape(powers, (-1, n))

    def _value_of(self, symbol: sympy.Symbol) -> mpmath.mpf:
        square = ROOTS.get(str(symbol))
        return WIDE.mpf(self.parameters[symbol]) if square is None else WIDE.sqrt(square)

    def __call__(self, q: Array) -> float:
        """Return f(q)."""
        return float(np.sum(self._waves(q)).real)

    def at_many(self, q: Array) -> Array:
        """Return f at each row of q (k, n), (k,)."""
        amplitudes, multiples, powers = self._table
        waves = np.exp(1j * q @ multiples.T) * np.prod(q[:, None, :] ** powers, axis=2)
        return np.asarray((waves @ amplitudes).real)

    @property
    def amplitudes(self) -> Array:
        """The terms at q = 0 (prismatic joints at one), (k,) complex."""
        return np.asarray(self._table[0])

    @cached_property
    def size(self) -> float:
        """Σ |cₖ|: what rounding is small beside (prismatic joints at one)."""
        return float(np.abs(self._table[0]).sum()) if self.f.terms else 0.0

    def complex(self, q: Array) -> complex:
        """Return f(q) of a polynomial that is not real, such as exp(i α)."""
        return complex(np.sum(self._waves(q)))

    def gradient(self, q: Array) -> Array:
        """Return ∂f/∂q, (n,)."""
        return np.asarray(self.gradients(q[None])[0])

    def gradients(self, q: Array) -> Array:
        """Return ∂f/∂q at each row of q (k, n), (k, n)."""
        amplitudes, multiples, powers = self._table
        waves = amplitudes * np.exp(1j * q @ multiples.T)
        slopes = (waves * np.prod(q[:, None, :] ** powers, axis=2) @ (1j * multiples)).real
        for i in np.flatnonzero(powers.any(axis=0)):
            lower = powers - (powers[:, [i]] > 0) * (np.arange(q.shape[1]) == i)
            slopes[:, i] += (waves * powers[:, i] * np.prod(q[:, None, :] ** lower, axis=2)).sum(axis=1).real
        return np.asarray(slopes)

    def least_in_boxes(self, centres: Array, half: Array) -> Array:
        """Return a lower bound of |f| in each box |q − c| ≤ half (n,), for the centres c (k, n): (k,), negative where
        there may be a zero.

        |f(q)| ≥ |f(c)| − Σ |∂f/∂qᵢ| hᵢ − ½ Σₖ |aₖ| (Σᵢ sₖᵢ hᵢ)² (Taylor), sₖᵢ being the largest relative slope of
        term k.
        """
        amplitudes, multiples, powers = self._table
        largest = np.maximum(np.abs(centres).max(axis=0) + half, np.finfo(float).tiny)
        sizes = np.abs(amplitudes) * np.prod(largest**powers, axis=1)
        steps = (np.abs(multiples) + powers / largest) @ half
        rounding = 1e-14 * float(sizes.sum())
        linear = np.abs(self.gradients(centres)) @ half
        return np.asarray(np.abs(self.at_many(centres)) - linear - 0.5 * float(sizes @ steps**2) - rounding)

    def zeros_in(self, i: int, q: Array) -> list[float]:
        """Return the values of joint i at which f vanishes, the other joints being as in q; multiple zeros too.

        A zero of order m is a simple one of the (m − 1)-th derivative, and is found there to rounding; rounding of the
        coefficients leaves m values of f itself around it, or none.
        """
        amplitudes, multiples, powers = self._table
        at = q.copy()
        at[i] = 0.0
        others = np.prod(np.where(np.arange(len(q)) == i, 1.0, at**powers), axis=1)
        weights = amplitudes * np.exp(1j * multiples @ at) * others
        turns = bool(multiples[:, i].any())
        unit = self.unit / self.f.trig_ring.turns_of(self.q[i])
        degrees = np.rint(multiples[:, i] / unit) if turns else powers[:, i]
        lowest = int(degrees.min())
        c = np.zeros(int(degrees.max()) - lowest + 1, dtype=complex)
        np.add.at(c, (degrees - lowest).astype(int), weights)
        if np.abs(c).max(initial=0.0) <= 1e-13 * max(self.size, 1e-300):
            return []
        found: list[tuple[float, float]] = []
        for place, within in _candidates(c, turns, self.unit):
            at[i] = value = self.unit / unit * place if turns else place
            near = [(value - y) * unit / self.unit if turns else value - y for y, _ in found]
            apart = np.abs(np.exp(1j * np.array(near)) - 1) if turns else np.abs(near)
            known = any(gap <= max(reach, within) for gap, (_, reach) in zip(apart, found, strict=True))
            if abs(self(at)) <= VANISHES * np.abs(c).max() and not known:
                found.append((value, within))
        return [value for value, _ in found]

    def _waves(self, q: Array) -> Array:
        amplitudes, multiples, powers = self._table
        if not len(amplitudes):
            return np.zeros(1)
        waves = amplitudes * np.exp(1j * multiples @ q)
        return np.asarray(waves * np.prod(q**powers, axis=1) if powers.any() else waves)


def _candidates(c: Array, turns: bool, unit: float) -> Iterator[tuple[float, float]]:
    """Yield where a polynomial or one of its derivatives vanishes, the highest first: the value of the joint, and how
    far from it the polynomial itself is zero to rounding.
    """
    for order in range(min(MOST_MULTIPLE, len(c) - 1), 0, -1):
        within = max(VANISHES ** (1 / order), 1e-6)
        for z in np.roots(np.polynomial.polynomial.polyder(c, order - 1)[::-1]):
            if turns and abs(abs(z) - 1) < 1e-6:
                yield float(without_turns(np.angle(z) / unit)), within
            elif not turns and abs(z.imag) < 1e-6 * max(1.0, abs(z)):
                yield float(z.real), within


def evaluated_factor(part: IrreducibleFactor, parameters: Mapping[sympy.Symbol, float]) -> Evaluated:
    """Return an irreducible part as a function of numbers, in half angles where it has some."""
    if any(part.parity):
        return Evaluated(part.in_half_angles, parameters, unit=0.5)
    return Evaluated(part.in_angles, parameters)


def _number(a: Any) -> mpmath.mpc:
    """Return an element of ℚ(i), which may be a quotient of whole numbers of thousands of digits."""
    return WIDE.mpc(*(WIDE.mpf(int(x.numerator)) / int(x.denominator) for x in (a.x, a.y)))


def _in_doubles(numbers: Sequence[mpmath.mpc]) -> npt.NDArray[np.complex128]:
    """Return the numbers; all divided by one power of two if the largest of them is beyond what a double can hold."""
    largest = max((int(WIDE.mag(number)) for number in numbers if number), default=0)
    shift = largest if abs(largest) > LARGEST else 0
    return np.array([complex(WIDE.ldexp(n.real, -shift), WIDE.ldexp(n.imag, -shift)) for n in numbers], dtype=complex)
