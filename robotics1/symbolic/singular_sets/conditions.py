"""The equations of a piece, as they are written: values of joints in closed form, and polynomials that vanish."""

from collections.abc import Mapping

import numpy as np
import sympy

from robotics1.angles import twelfths_of_pi
from robotics1.orientation.expressions import both_angles
from robotics1.symbolic.polynomials.evaluation import Evaluated
from robotics1.symbolic.polynomials.factoring import IrreducibleFactor, factors
from robotics1.symbolic.polynomials.trig_polynomial import TrigPolynomial, polynomial
from robotics1.symbolic.singular_sets.locus import Locus, Piece
from robotics1.symbolic.singular_sets.zeros import Substitution
from robotics1.symbolic.writing.sums_of_angles import Groups, recognised, written, written_in_halves, written_product

ROUNDING = 1e-13  # of an angle [rad]


def conditions(piece: Piece, groups: Groups) -> tuple[sympy.Eq, ...]:
    """Return the equations of a piece: joints that have a value, then polynomials that vanish."""
    q = piece.locus.trig_ring.q
    values = [_value(s, groups) for s in piece.locus.substitutions if s.symbol in q]
    implicit = [equation for part in piece.locus.implicit for equation in _equations(piece, part, groups)]
    return (*sorted(values, key=lambda equation: str(equation.lhs)), *implicit)


def relations_of_lengths(locus: Locus, groups: Groups) -> tuple[sympy.Eq, ...]:
    """Return the lengths that have a value on a locus, such as a3 = a2."""
    return tuple(_value(s, groups) for s in locus.substitutions if s.symbol not in locus.trig_ring.q)


def _value(substitution: Substitution, groups: Groups) -> sympy.Eq:
    """Return joint = value; of angles with what is added on either side: q3 = q1, 2 q2 + q3 = π."""
    symbol, value = substitution.symbol, substitution.value
    if not substitution.is_angle:
        return sympy.Eq(symbol, written(value, groups))
    ((k, _),) = value.terms.items()
    F = value.trig_ring
    turns = F.turns_of(symbol)
    added, taken = F.angle([max(n, 0) for n in k]), F.angle([min(n, 0) for n in k])
    return sympy.Eq(symbol - turns * taken, turns * (added + _angle_of_turn(value)))


def _equations(piece: Piece, part: IrreducibleFactor, groups: Groups) -> tuple[sympy.Eq, ...]:
    """Return part = 0; or the value of its only joint, in closed form where it has a short one."""
    (expression,) = recognised([_expression(part, groups).as_content_primitive()[1]])
    plain = sympy.Eq(-expression if expression.could_extract_minus_sign() else expression, 0)
    joints = [i for i, symbol in enumerate(part.trig_ring.q) if symbol in part.symbols]
    pinned = piece.pinned.get(joints[0]) if len(joints) == 1 else None
    if pinned is None:
        return (plain,)
    symbol = part.trig_ring.q[joints[0]]
    turns = part.trig_ring.turns_of(symbol)  # the joint is at d φ if others follow it by fractions of its angle
    root = _root_of(part, symbol, pinned / turns, piece.parameters)
    return (plain, sympy.Eq(symbol, sympy.Float(pinned))) if root is None else (sympy.Eq(symbol, turns * root),)


def _expression(part: IrreducibleFactor, groups: Groups) -> sympy.Expr:
    """Return the part in SymPy, in half angles where it has some."""
    if not any(part.parity):
        return written_product(factors(part.in_angles), groups)
    return written_in_halves(part.in_half_angles, groups)


def _angle_of_turn(turn: TrigPolynomial) -> sympy.Expr:
    """Return α of exp(i α), a constant times exponentials of other angles, which are left out."""
    ((_, c),) = turn.terms.items()
    number = Evaluated(turn.trig_ring.constant(c), {}).complex(np.zeros(len(turn.trig_ring.q)))
    k = twelfths_of_pi(float(np.angle(number)), ROUNDING)
    if k is None:
        return sympy.Float(np.angle(number))
    return sympy.Rational(k if k != -12 else 12, 12) * sympy.pi


def _root_of(
    part: IrreducibleFactor, symbol: sympy.Symbol, value: float, parameters: Mapping[sympy.Symbol, float]
) -> sympy.Expr | None:
    """Return the solution φ, or ℓ, of part = 0 for its only joint that has the given value, or None if there is no
    short one.

    A cos φ + B sin φ + C = 0 has the solutions φ = atan2(B, A) ± acos(−C / √(A² + B²)), A cos φ/2 + B sin φ/2 = 0
    has φ = 2 atan2(−A, B), and a ℓ + b = 0 has −b/a.
    """
    F = part.trig_ring
    if any(part.parity):
        return _from_half_angle(part.in_half_angles)
    g = part.in_angles
    if symbol not in F.angles:
        slope = g.derivative(symbol)
        if symbol in slope.symbols:
            return None
        rest = sympy.expand(polynomial(g.terms[F.zero])).coeff(symbol, 0)
        return -rest / polynomial(slope.terms[F.zero])
    j = F.angles.index(symbol)
    one = tuple(int(i == j) for i in range(len(F.angles)))
    if set(g.terms) - {F.zero, one, tuple(-k for k in one)}:
        return _from_cosine(g, j, value, parameters)
    c = g.terms[one]
    A, B = sympy.expand(2 * polynomial(c)).as_real_imag()
    B = -B
    C = polynomial(g.terms[F.zero]) if F.zero in g.terms else sympy.S.Zero
    return _nearest(both_angles(*recognised([B, A, -C])), value, parameters)


def _from_half_angle(half: TrigPolynomial) -> sympy.Expr | None:
    """Return 2 atan2(−A, B) of A cos φ/2 + B sin φ/2 = 0."""
    if len(half.terms) != 2:
        return None
    A, B = sympy.expand(2 * polynomial(max(half.terms.items())[1])).as_real_imag()
    A, B = recognised([A, B])
    return 2 * sympy.atan2(-A, -B)


def _from_cosine(
    g: TrigPolynomial, j: int, value: float, parameters: Mapping[sympy.Symbol, float]
) -> sympy.Expr | None:
    """Return ± acos of a root of a polynomial of degree two in cos φ: c₀ + 2 c₁ cos φ + 2 c₂ (2 cos² φ − 1) = 0."""
    c = {k[j]: polynomial(coefficient) for k, coefficient in g.terms.items()}
    if len(g.angles) > 1 or max(c) > 2 or any(c[k] != c.get(-k) for k in c):
        return None
    cosine = sympy.Symbol("c")
    quadratic = c.get(0, 0) + 2 * c.get(1, 0) * cosine + 2 * c[2] * (2 * cosine**2 - 1)
    solutions = [sign * sympy.acos(root) for root in sympy.roots(quadratic, cosine) for sign in (1, -1)]
    return _nearest(solutions, value, parameters)


def _nearest(solutions: list[sympy.Expr], value: float, parameters: Mapping[sympy.Symbol, float]) -> sympy.Expr:
    """Return the solution that is the angle, up to whole turns."""
    numbers = [complex(x.subs(parameters)) for x in solutions]
    return solutions[int(np.argmin([abs(np.exp(1j * x) - np.exp(1j * value)) for x in numbers]))]
