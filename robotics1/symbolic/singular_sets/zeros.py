"""The zeros of an irreducible trigonometric polynomial: values of a joint where it has them, else itself."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np
import sympy
from sympy.polys.domains import QQ_I

from robotics1.angles import twelfths_of_pi
from robotics1.caching import cached_property
from robotics1.symbolic.polynomials.evaluation import Evaluated, evaluated_factor
from robotics1.symbolic.polynomials.factoring import IrreducibleFactor, irreducible_factors
from robotics1.symbolic.polynomials.trig_polynomial import TrigPolynomial, TrigRing

ZERO = 1e-12  # of a polynomial in the lengths, beside the sum of its terms
ROUNDED = 1e-15  # of the same, where √2 and √3 are fractions to 1e-16: sin(q3) + 1 is that, and has a double zero


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
        values = self.value.conjugate, self.value
        terms = (c * values[power > 0] ** abs(power) for power, c in f.coefficients(self.symbol).items())
        return sum(terms, start=f.trig_ring.constant(0))


@dataclass(frozen=True, eq=False)
class Zero:
    """One way in which a polynomial vanishes.

    Attributes:
        equation: the polynomial that vanishes, real, in whole angles.
        substitution: the value of a joint that is equivalent, or None.
        part: the irreducible part that is equivalent, where no joint has a value.
        real: whether it happens at these lengths; known for lengths alone and for one joint, and assumed
            for several joints.
    """

    equation: TrigPolynomial
    substitution: Substitution | None = None
    part: IrreducibleFactor | None = None
    real: bool = True


def zeros(f: TrigPolynomial, parameters: Mapping[sympy.Symbol, float]) -> list[Zero]:
    """Return the ways in which f vanishes, each once; those that do not happen at the given lengths too."""
    _, parts = irreducible_factors(f)
    distinct = list({(str(part.numerator), part.degrees): part for part in parts}.values())
    values = [_values(part, parameters) for part in distinct]
    others = [part for part, found in zip(distinct, values, strict=True) if not found]
    implicit = [Zero(part.whole, part=part, real=_can_vanish(part, parameters)) for part in others]
    return [zero for found in values for zero in found] + [zero for zero in implicit if _is_worth_keeping(zero)]


def vanishing_lengths(f: TrigPolynomial, parameters: Mapping[sympy.Symbol, float]) -> Zero | None:
    """Return a factor of lengths alone that is zero at the given ones, such as a2 − a3, or None."""
    if not f.symbols & set(parameters):
        return None
    joints = set(f.trig_ring.q)
    return next((zero for zero in zeros(f, parameters) if zero.real and not zero.equation.symbols & joints), None)


def coincidences(
    F: TrigRing, parameters: Mapping[sympy.Symbol, float], lengths: Collection[sympy.Symbol]
) -> list[Zero]:
    """Return what holds between two of these lengths: one is as long as another before it, or its opposite."""
    found = []
    known: list[sympy.Symbol] = []
    for symbol in (s for s in F.ring.symbols if parameters.get(s) and s in lengths):
        value = parameters[symbol]
        twin = next((other for other in known if abs(abs(parameters[other]) - abs(value)) <= ZERO * abs(value)), None)
        if twin is None:
            known.append(symbol)
            continue
        replacement = F.ring(twin) if parameters[twin] * value > 0 else -F.ring(twin)
        equation = F.constant(F.ring(symbol) - replacement)
        found.append(Zero(equation, Substitution(symbol, F.constant(replacement))))
    return found


def _is_worth_keeping(zero: Zero) -> bool:
    """Whether the zero is worth keeping: that two lengths are equal is, that a length is not zero is not."""
    return zero.real or len(zero.equation.terms) > 1 or any(len(c) > 1 for c in zero.equation.terms.values())


def _can_vanish(part: IrreducibleFactor, parameters: Mapping[sympy.Symbol, float]) -> bool:
    numbers = evaluated_factor(part, parameters)
    joints = [i for i, symbol in enumerate(part.trig_ring.q) if symbol in part.symbols]
    at = np.zeros(len(part.trig_ring.q))
    if not joints:
        return abs(numbers(at)) <= ZERO * numbers.size
    return len(joints) > 1 or bool(numbers.zeros_in(joints[0], at))


def _values(part: IrreducibleFactor, parameters: Mapping[sympy.Symbol, float]) -> list[Zero]:
    """Return the values of one joint at which the part vanishes, when these are all its zeros; else nothing."""
    half = part.in_half_angles
    if len(half.terms) == 2:
        return _values_of_two_terms(half)
    if any(part.parity):
        return []
    f = part.in_angles
    if len(f.symbols) == 1 and f.angles:
        return _values_of_one_angle(f)
    joints = any(symbol in f.symbols for symbol in f.trig_ring.q)
    found = value_of_length(f) if joints or _can_vanish(part, parameters) else None
    return [] if found is None else [Zero(f, found)]


def _values_of_two_terms(half: TrigPolynomial) -> list[Zero]:
    """Solve c exp(i k·φ/2) + conj(c) exp(−i k·φ/2) = 0 for one angle: exp(i k·φ) = −conj(c)/c."""
    F = half.trig_ring
    k, c = max(half.terms.items())
    joints = [j for j, n in enumerate(k) if n and F.angles[j] in F.q]
    if not joints or half.symbols - set(F.angles):
        return []
    j = min(joints, key=lambda place: (abs(k[place]), -place))
    m = abs(k[j])
    if any(n % m for n in k):
        return []
    others = F.exponential({F.angles[i]: -n // k[j] for i, n in enumerate(k) if i != j})
    turns = _turns(F.constant(c), m)
    return [angle_zero(F.angles[j], (turn if k[j] > 0 else turn.conjugate) * others) for turn in turns]


def _turns(c: TrigPolynomial, m: int) -> list[TrigPolynomial]:
    """Return the m-th roots of −conj(c)/c in exact form, if they have one."""
    F = c.trig_ring
    number = Evaluated(c, {}).complex(np.zeros(len(F.q)))
    angle = float(np.angle(-number.conjugate() / number))
    found = []
    for n in range(m):
        k = twelfths_of_pi((angle + 2 * np.pi * n) / m)
        if k is not None and not c * F.turn(k * m) + c.conjugate:
            found.append(F.turn(k))
    (coefficient,) = c.terms.values()
    if not found and m == 1 and coefficient.is_ground:
        a = coefficient.LC
        return [F.constant(-QQ_I(a.x, -a.y) / a)]
    return found if len(found) == m else []


def _values_of_one_angle(f: TrigPolynomial) -> list[Zero]:
    """Solve a polynomial in one joint's angle, without lengths, if all zeros are multiples of π/12."""
    F = f.trig_ring
    (symbol,) = f.symbols
    if symbol not in F.q:
        return []
    numbers = Evaluated(f, {}).zeros_in(F.q.index(symbol), np.zeros(len(F.q)))
    turns = [twelfths_of_pi(value) for value in numbers]
    if any(k is None for k in turns):
        return []
    found = [angle_zero(symbol, F.turn(k)) for k in turns if k is not None]
    left = [zero.substitution(f) for zero in found if zero.substitution is not None]
    rounding = ROUNDED * Evaluated(f, {}).size
    return found if all(Evaluated(rest, {}).size <= rounding for rest in left) else []


def value_of_length(f: TrigPolynomial) -> Substitution | None:
    """Return the value of a prismatic joint ℓ, or of a length if f has no joint, at which f = a ℓ + rest = 0, a being
    a number.
    """
    F = f.trig_ring
    joints = [symbol for symbol in F.q if symbol in f.symbols]
    for symbol in joints or F.ring.symbols:
        if symbol not in F.ring.symbols:
            continue
        one = F.ring(symbol)
        slope = f.derivative(symbol)
        if set(slope.terms) == {F.zero} and slope.terms[F.zero].is_ground:
            a = slope.terms[F.zero].LC
            rest = f - F.constant(one * a)
            return Substitution(symbol, rest * F.constant(-1 / a))
    return None


def angle_zero(symbol: sympy.Symbol, turn: TrigPolynomial) -> Zero:
    """Return the zero φ = α with exp(i α) = turn, as 2 − 2 cos(φ − α) = 0."""
    F = turn.trig_ring
    difference = F.exponential({symbol: 1}) * turn.conjugate
    return Zero(F.constant(2) - difference - difference.conjugate, Substitution(symbol, turn))
