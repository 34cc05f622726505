"""Equations that hold one unknown joint, and their solutions."""

from collections.abc import Collection
from dataclasses import dataclass
from typing import Any, NamedTuple

import sympy
from sympy.polys.domains import QQ_I

from robotics1.ik.closed_form.trig_equation import existence
from robotics1.orientation.expressions import angle_of, both_angles
from robotics1.symbolic.polynomials.trig_polynomial import TrigPolynomial

SMALL = 1e-9  # a coefficient that may be rounding
ROUNDING = 1e-13  # of the largest coefficient


@dataclass(frozen=True, eq=False)
class OneUnknown:
    """An equation in one unknown joint q.

    Attributes:
        q: its symbol.
        is_angle: whether it turns.
        coefficients: A, B and C of A cos q + B sin q + C = 0; or C₀, C₁ and C₂ of C₀ + C₁ q + C₂ q² = 0.
        terms: how many the equation has.
    """

    q: sympy.Symbol
    is_angle: bool
    coefficients: tuple[TrigPolynomial, ...]
    terms: int

    @property
    def is_linear(self) -> bool:
        """Whether a prismatic joint has one solution."""
        return not self.is_angle and not self.coefficients[2]


class JointFormula(NamedTuple):
    """The solutions of a joint, in the target's symbols and in the joints before it.

    Attributes:
        q: its symbol.
        options: one or two formulas.
        exists_if, double_if, free_if: when there are any, when the two are one, and when q is not determined.
    """

    q: sympy.Symbol
    options: tuple[sympy.Expr, ...]
    exists_if: Any
    double_if: Any
    free_if: Any


def read(
    f: TrigPolynomial, angles: Collection[int], lengths: Collection[int], nothing: Collection[int]
) -> OneUnknown | None:
    """Return an equation in one unknown; None if it has another number of them, or says nothing.

    Args:
        f: what vanishes.
        angles: the places of unknown angles.
        lengths: the places, in the ring, of unknown prismatic joints.
        nothing: the places of entries of the pose that are not known.
    """
    if not f.terms:
        return None
    if any(abs(complex(float(a.x), float(a.y))) < SMALL for c in f.terms.values() for a in c.itercoeffs()):
        f = f.without_rounding(ROUNDING * f.largest)
    slides: set[int] = set()
    for c in f.terms.values():
        for m in c.itermonoms():
            if any(m[place] for place in nothing):
                return None
            slides.update(place for place in lengths if m[place])
    F = f.trig_ring
    unknown = [F.angles[j] for j in f.angles if j in angles] + [F.ring.symbols[place] for place in slides]
    if len(unknown) != 1:
        return None
    (q,), zero, number = unknown, F.constant(0), sum(len(c) for c in f.terms.values())
    parts = f.coefficients(q)
    if slides:
        return OneUnknown(q, False, tuple(parts.get(k, zero) for k in range(3)), number) if max(parts) <= 2 else None
    if F.turns_of(q) != 1 or max(parts) != 1:
        return None
    first, i = parts[1], F.constant(F.ring(QQ_I(0, 1)))
    A, B = first + first.conjugate, (first - first.conjugate) * i
    return OneUnknown(q, True, (A, B, parts.get(0, zero)), number)


def solve_one(equation: OneUnknown, write: Any) -> JointFormula:
    """Return the solutions of one equation; `write` makes an expression of a polynomial."""
    if equation.is_angle:
        A, B, C = map(write, equation.coefficients)
        a, b, c = _lowest(B, A, -C)
        square = a**2 + b**2
        double = sympy.false if c == 0 else sympy.Eq(c**2, square)
        if a == 0 or b == 0:
            double = sympy.false if c == 0 else sympy.Eq(sympy.Abs(c / (a + b)), 1)
        free = _vanishes(a, b) if c == 0 or a == 0 or b == 0 else _vanishes(square)
        return JointFormula(equation.q, tuple(both_angles(a, b, c)), existence(a, b, c), double, free)
    C0, C1, C2 = map(write, equation.coefficients)
    if C2 == 0:
        return JointFormula(equation.q, (_quotient(-C0, C1),), sympy.true, sympy.false, _vanishes(C1))
    square = sympy.factor_terms(C1**2 / 4 - C0 * C2) / C2**2 if C1 != 0 else _quotient(-C0, C2)
    middle, root = _quotient(-C1, 2 * C2), sympy.sqrt(square)
    options = middle + root, middle - root
    return JointFormula(equation.q, options, sympy.Ge(square, 0), sympy.Eq(square, 0), _vanishes(C2))


def solve_pair(one: OneUnknown, other: OneUnknown, write: Any) -> JointFormula:
    """Return the solution of two independent equations A cos + B sin + C = 0 in the same angle."""
    a1, b1, c1 = map(write, one.coefficients)
    a2, b2, c2 = map(write, other.coefficients)
    sine, cosine = a2 * c1 - a1 * c2, b1 * c2 - b2 * c1
    sign = turned(one, other)
    if sign:  # the determinant is ±(a² + b²)
        alone = a1 + b1 if a1 == 0 or b1 == 0 else None
        if alone is not None and alone.is_Symbol:
            sine, cosine = sine / alone**2, cosine / alone**2
        sine, cosine = sign * sine, sign * cosine
        A, B, _ = one.coefficients
        free = _vanishes(write(A * A + B * B) if alone is None else alone)
    else:
        det = a1 * b2 - a2 * b1
        sine, cosine = sine / det, cosine / det
        free = _vanishes(det)
    angle = angle_of(sympy.factor_terms(sine), sympy.factor_terms(cosine))
    return JointFormula(one.q, (angle,), sympy.true, sympy.false, free)


def turned(one: OneUnknown, other: OneUnknown) -> int:
    """Return ±1 where the coefficients (A, B) of one equation are those of the other, turned by ±π/2; else 0."""
    (A1, B1, _), (A2, B2, _) = one.coefficients, other.coefficients
    if not (A2 + B1) and not (B2 - A1):
        return 1
    return -1 if not (A2 - B1) and not (B2 + A1) else 0


def _lowest(*values: sympy.Expr) -> list[sympy.Expr]:
    """Return the values without the numbers and the symbols that all of them have as a factor."""
    factors = [set(sympy.Mul.make_args(value)) for value in values if value != 0]
    shared = set.intersection(*factors) if factors else set()
    divisor = sympy.Mul(*shared)
    return [value / divisor for value in values] if divisor != 0 else list(values)


def _quotient(a: sympy.Expr, b: sympy.Expr) -> sympy.Expr:
    return sympy.expand(a / b) if b.is_number else a / b


def _vanishes(*values: sympy.Expr) -> Any:
    """Return the condition that all values are zero; false if one never is."""
    return sympy.And(*(sympy.false if _is_never_zero(v) else sympy.Eq(v, 0) for v in values if v != 0))


def _is_never_zero(e: sympy.Expr) -> bool:
    """Whether the number in a sum is larger than its sines and cosines can be together."""
    number, waves = e.as_coeff_Add()
    terms = [term.as_coeff_Mul() for term in sympy.Add.make_args(waves)] if waves != 0 else []
    if not all(isinstance(wave, sympy.sin | sympy.cos) for _, wave in terms):
        return False
    return bool(abs(number) > sum(abs(size) for size, _ in terms) * (1 + SMALL))
