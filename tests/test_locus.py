"""Zeros of trigonometric polynomials, values put in the place of joints, and the pieces where several vanish."""

from fractions import Fraction
from itertools import pairwise

import numpy as np
import pytest
import sympy
from hypothesis import given, strategies as st
from polynomials import VALUES, F, Q, a, b, c, equal, poly, q1, q2, q3, q4, random_q, sympy_of, value
from scipy.optimize import brentq
from sympy import cos, pi, sin

from robotics1.robot.box import JointBox
from robotics1.symbolic.polynomials.evaluation import Evaluated
from robotics1.symbolic.polynomials.factoring import irreducible_factors
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.symbolic.polynomials.trig_polynomial import gaussian
from robotics1.symbolic.singular_sets.common_zeros import CommonZeros
from robotics1.symbolic.singular_sets.emptiness import have_no_zero
from robotics1.symbolic.singular_sets.locus import Locus, Piece
from robotics1.symbolic.singular_sets.pieces import largest_pieces
from robotics1.symbolic.singular_sets.zeros import Substitution, zeros

BOX = JointBox(
    lower=np.array([-np.pi, -np.pi, -np.pi, -1]),
    upper=np.array([np.pi, np.pi, np.pi, 1]),
    circular=np.array([True, True, True, False]),
    unit=np.ones(4),
)


def turn(angle, k=0):
    """exp(i (angle + k π/12)), for a sum of joints."""
    return F.exponential({symbol: angle.coeff(symbol) for symbol in angle.free_symbols}) * F.turn(k)


def loci(*expressions, lengths=VALUES):
    return list(CommonZeros(lengths).common_zeros([poly(e) for e in expressions], Locus(F)))


def value_of(zero):
    """The (joint, value) of a zero that is one."""
    return zero.substitution.symbol, complex(value(zero.substitution.value, [0, 0, 0, 0]))


# --- numbers


@pytest.mark.parametrize(
    "f", [a * cos(q1 + 2 * q2) + q4 * sin(q3), q4**2 * sin(q1) - b * q4, a - b * cos(3 * q3)], ids=str
)
def test_values_and_gradients_are_sympys(f):
    rng = np.random.default_rng(0)
    for q in (random_q(rng) for _ in range(5)):
        at = {**dict(zip(Q, q, strict=True)), **VALUES}
        ours = Evaluated(poly(f), VALUES)
        assert ours(q) == pytest.approx(float(f.subs(at)), abs=1e-12)
        assert ours.gradient(q) == pytest.approx([float(f.diff(symbol).subs(at)) for symbol in Q], abs=1e-12)


@pytest.mark.parametrize(
    ("f", "i"),
    [
        (a + b * cos(2 * q1) + c * sin(q1), 0),
        (a * cos(q1 + q2) - c, 1),
        (a * sin(q3) ** 3 - c * cos(q3), 2),
        (q4**2 - a * q4 + c * cos(q1) ** 2 / 9, 3),
    ],
    ids=str,
)
def test_zeros_in_one_joint_are_the_changes_of_sign(f, i):
    q = np.array([0.3, -0.8, 0.5, 0.2])
    ours = Evaluated(poly(f), VALUES)
    found = ours.zeros_in(i, q)

    def along(x):
        return float(f.subs({**dict(zip(Q, [*q[:i], x, *q[i + 1 :]], strict=True)), **VALUES}))

    grid = np.linspace(-np.pi, np.pi, 181) + 0.003
    wanted = [brentq(along, x, y) for x, y in pairwise(grid) if along(x) * along(y) < 0]
    wanted = [np.angle(np.exp(1j * x)) for x in wanted] if i < 3 else wanted
    assert sorted(found) == pytest.approx(sorted(wanted), abs=1e-9)


def test_double_zeros_are_found_once():
    assert Evaluated(poly((1 - cos(q1)) * 3), VALUES).zeros_in(0, np.zeros(4)) == pytest.approx([0], abs=1e-6)
    assert Evaluated(poly(a + b * sin(q1)), {**VALUES, b: 0.5}).zeros_in(0, np.zeros(4)) == pytest.approx(
        [-np.pi / 2], abs=1e-6
    )


# --- substitution


@pytest.mark.parametrize(
    ("symbol", "value_expression", "angle"),
    [(q2, turn(q1, 6), q1 + pi / 2), (q1, turn(-q2 - q3, 2), pi / 6 - q2 - q3), (q3, turn(sympy.S.Zero, 12), pi)],
    ids=str,
)
def test_an_angle_put_in_the_place_of_a_joint_is_sympys_substitution(symbol, value_expression, angle):
    f = a * cos(q1 + q2) * sin(q2 + q3) + b * q4 * cos(q2) ** 2 - c * sin(2 * q1 - q3)
    assert equal(Substitution(symbol, value_expression)(poly(f)), poly(sympy.expand_trig(f.subs(symbol, angle))))


@pytest.mark.parametrize(("symbol", "expression"), [(q4, a * cos(q1) - b), (a, b + c), (b, sympy.S.Zero)])
def test_a_length_put_in_place_is_sympys_substitution(symbol, expression):
    f = q4**2 * a * cos(q1 + q2) - b * q4 + a**3
    assert equal(Substitution(symbol, poly(expression))(poly(f)), poly(sympy.expand(f.subs(symbol, expression))))


# --- zeros of one polynomial


@pytest.mark.parametrize(
    ("f", "wanted"),
    [
        (sin(q2), [0, pi]),
        (cos(q2), [-pi / 2, pi / 2]),
        (2 * cos(q2) - 1, [-pi / 3, pi / 3]),
        (cos(2 * q2), [-3 * pi / 4, -pi / 4, pi / 4, 3 * pi / 4]),
        (1 - cos(q2), [0]),
        (sin(q2) * cos(q2), [-pi / 2, 0, pi / 2, pi]),
        (sin(3 * q2), [-2 * pi / 3, -pi / 3, 0, pi / 3, 2 * pi / 3, pi]),
        (4 * sin(q2) ** 2 - 3, [-2 * pi / 3, -pi / 3, pi / 3, 2 * pi / 3]),
        (sin(q2) + cos(q2), [-pi / 4, 3 * pi / 4]),
    ],
    ids=str,
)
def test_zeros_of_one_angle_at_multiples_of_a_twelfth_of_pi_are_exact(f, wanted):
    found = [value_of(zero) for zero in zeros(poly(f), VALUES)]
    assert {symbol for symbol, _ in found} == {q2}
    assert sorted(np.angle([z * np.exp(-1e-9j) for _, z in found])) == pytest.approx(
        sorted(float(x) for x in wanted), abs=1e-8
    )
    assert all(not zero.substitution(poly(f)) for zero in zeros(poly(f), VALUES))


@pytest.mark.parametrize("f", [sin(q1 + q2), cos(q1) - cos(q2), cos(q1) + sin(q2), sin(q1 - q2 + 2 * q3)], ids=str)
def test_a_joint_that_is_another_up_to_a_constant_is_put_in_its_place(f):
    found = zeros(poly(f), VALUES)
    assert all(zero.substitution is not None for zero in found)
    assert len(found) == 2
    for zero in found:
        assert not zero.substitution(poly(f))
        assert not zero.substitution(zero.equation)


@pytest.mark.parametrize(("beside_one", "is_exact"), [(0, True), (-1, True), (1, True), (-100, False), (1000, False)])
def test_a_double_zero_is_exact_up_to_the_rounding_of_square_roots(beside_one, is_exact):
    """sin q1 + 1 + k 1e-16 is sin q1 + 1, with q1 = −π/2, where √2 · √2 is 2 to 1e-16 only; other numbers are meant."""
    number = 1 + sympy.Rational(beside_one, 10**16)
    found = zeros(poly(sin(q1)) + F.constant(gaussian(Fraction(int(number.p), int(number.q)))), VALUES)
    assert [zero.substitution is not None for zero in found] == [is_exact]
    assert not is_exact or value_of(found[0]) == (q1, pytest.approx(-1j, abs=1e-15))


def test_lengths_that_are_not_zero_say_nothing_and_equal_ones_are_told():
    assert zeros(poly(a * b * sin(q1)), VALUES)[0].substitution.symbol == q1
    assert len(zeros(poly(a * b * sin(q1)), VALUES)) == 2
    (condition,) = zeros(poly(a - b), VALUES)
    assert (condition.real, condition.substitution) == (False, None)
    assert zeros(poly(a - b), {**VALUES, b: 0.5})[0].real


def test_a_slide_is_solved_for_and_an_equation_in_one_joint_without_solution_is_told():
    (zero,) = zeros(poly(q4 + a * cos(q1)), VALUES)
    assert zero.substitution.symbol == q4
    assert equal(zero.substitution.value, poly(-a * cos(q1)))
    (never,) = zeros(poly(a + b * cos(q3)), VALUES)  # 0.5 + 0.4 cos
    (ever,) = zeros(poly(a + b * cos(q3)), {**VALUES, b: 0.6})
    assert (never.real, ever.real) == (False, True)


def test_every_zero_of_a_product_with_half_angles_is_real_in_whole_angles_and_vanishes_where_it_says():
    """(1 − cos q1) splits in halves; a sin q1 + b (1 − cos q1) = 2 sin(q1/2) (a cos(q1/2) + b sin(q1/2))."""
    f = poly(a * sin(q1) + b * (1 - cos(q1)))
    found = zeros(f, VALUES)
    wanted = sorted([0, float(-2 * sympy.atan2(a, b).subs(VALUES))])
    angles = []
    for zero in found:
        assert equal(zero.equation, zero.equation.conjugate)
        angles += Evaluated(zero.equation, VALUES).zeros_in(0, np.zeros(4))
    assert sorted(angles) == pytest.approx(wanted, abs=1e-6)


# --- common zeros


@pytest.mark.parametrize(
    ("expressions", "count", "dimension"),
    [
        ((sin(q2), sin(q3)), 4, 2),
        ((a * sin(q1), a * cos(q1)), 0, None),
        ((sin(q2) * cos(q3), cos(q2)), 4, 2),
        ((q4 * sin(q2), q4 * cos(q2)), 1, 3),
        ((a * cos(q2) + b * cos(q2 + q3), a * sin(q2) + b * sin(q2 + q3)), 0, None),
        ((a * cos(q2) + b * cos(q2 + q3), sin(q3)), 4, 2),
        ((a * cos(q2) + b * cos(q2 + q3),), 1, 3),
    ],
    ids=str,
)
def test_common_zeros_are_pieces_on_which_every_polynomial_vanishes(expressions, count, dimension):
    rng = np.random.default_rng(2)
    pieces, _ = largest_pieces(loci(*expressions), CommonZeros(VALUES), BOX, rng)
    real = [(sampler.piece, sampler.draw(rng)) for sampler in pieces]
    assert len(real) == count
    for piece, q in real:
        assert piece.dimension(q) == dimension
        assert piece.contains(q)
        assert [value(poly(e), q) for e in expressions] == pytest.approx([0] * len(expressions), abs=1e-11)
        assert not any(piece.locus.reduced(poly(e)) for e in expressions)


def test_a_piece_that_is_met_in_several_orders_is_told_once():
    """s1 s2 = s2 s3 = s3 s1 = 0: two of the three sines vanish, at four pairs of values each."""
    found = loci(sin(q1) * sin(q2), sin(q2) * sin(q3), sin(q3) * sin(q1))
    assert len(found) == len({locus.key for locus in found}) == 12


def test_common_zeros_hold_every_configuration_that_a_search_finds():
    """Newton from random starts on a c2 + b c23 = 0 and c sin q1 sin q3 = 0 ends on one of the pieces."""
    f, g = a * cos(q2) + b * cos(q2 + q3), c * sin(q1) * sin(q3)
    pieces = [Piece(locus, VALUES, {}) for locus in loci(f, g)]
    symbolic = sympy.Matrix([f, g]).subs(VALUES)
    both, slope = (sympy.lambdify(Q[:3], M, "numpy") for M in (symbolic, symbolic.jacobian(Q[:3])))
    rng = np.random.default_rng(3)
    for _ in range(30):
        q = random_q(rng)
        for _ in range(60):
            q[:3] -= np.linalg.lstsq(slope(*q[:3]), both(*q[:3])[:, 0], rcond=1e-10)[0]
        if np.abs(both(*q[:3])).max() < 1e-13:
            assert any(piece.contains(q) for piece in pieces), q


def test_the_time_limit_is_kept():
    with TimeLimit(-1).kept(), pytest.raises(OutOfTime):
        list(CommonZeros(VALUES).common_zeros([poly(sin(q1))], Locus(F)))


@pytest.mark.parametrize(
    ("g", "f", "yes"),
    [
        (sin(q1), sin(2 * q1), True),
        (sin(q1), cos(q1), False),
        (a * cos(q2) + b * cos(q2 + q3), (a * cos(q2) + b * cos(q2 + q3)) * sin(q3) * a, True),
        (a * cos(q2) + b * cos(q2 + q3), a * cos(q2) - b * cos(q2 + q3), False),
        (1 + cos(q1), (1 + cos(q1)) * cos(q1), True),
        (1 + cos(q1), sin(q1), True),  # cos(q1/2) divides both
        (sin(q1), 1 - cos(q1), False),
        (cos(q1), sympy.S.Zero, True),
        (a * cos(q2) + sympy.sqrt(3) * b * cos(q2 + q3), sympy.sqrt(3) * a * cos(q2) + 3 * b * cos(q2 + q3), True),
        (a * cos(q2) + sympy.sqrt(3) * b * cos(q2 + q3), a**2 * cos(q2) ** 2 - 3 * b**2 * cos(q2 + q3) ** 2, True),
        (a * cos(q2) + sympy.sqrt(2) * b * cos(q2 + q3), a**2 * cos(q2) ** 2 - 3 * b**2 * cos(q2 + q3) ** 2, False),
    ],
    ids=str,
)
def test_divides(g, f, yes):
    assert all(part.divides(poly(f)) for part in irreducible_factors(poly(g))[1]) is yes


def test_the_pieces_written_are_the_equations():
    (locus,) = loci(a * cos(q2) + b * cos(q2 + q3))
    assert sympy_of(locus.implicit[0].in_angles) in (a * cos(q2) + b * cos(q2 + q3), -a * cos(q2) - b * cos(q2 + q3))
    assert locus.joints == (1, 2)


# --- proofs that there is no zero


def proven_empty(*expressions, **known):
    equations = [Evaluated(poly(sympy.sympify(e)), VALUES) for e in expressions]
    joints = [i for i, symbol in enumerate(Q) if any(symbol in f.f.symbols for f in equations)]
    return have_no_zero(equations, BOX, np.zeros(4), joints, **known)


@given(st.fractions(-3, 3, max_denominator=20), st.fractions(-3, 3, max_denominator=20), st.integers(0, 9))
def test_u_cos_q1_plus_v_sin_2_q2_plus_w_q4_has_no_zero_where_the_constant_is_larger_than_all_of_it(u, v, tenths):
    u, v = (sympy.Rational(x.numerator, x.denominator) for x in (u, v))
    largest = abs(u) + abs(v) + sympy.Rational(tenths, 10)  # |q4| is at most 1
    moving = u * cos(q1) + v * sin(2 * q2) + sympy.Rational(tenths, 10) * q4
    assert proven_empty(moving - largest - sympy.Rational(1, 5))
    assert proven_empty(moving + largest + sympy.Rational(1, 5))
    assert not proven_empty(moving - largest)


def test_two_equations_that_hold_at_different_places_have_no_common_zero():
    assert proven_empty(cos(q1) - sympy.Rational(1, 2), sin(q1) - sympy.Rational(1, 2))
    assert proven_empty(sin(q1 + q2) - q4, cos(q1 + q2) - q4, q4 - sympy.Rational(1, 2))
    assert not proven_empty(cos(q1) - sympy.Rational(3, 5), sin(q1) - sympy.Rational(4, 5))


def test_beside_a_zero_that_is_known_there_is_no_other():
    touching = 2 - cos(q1) - cos(q2)
    assert not proven_empty(touching)
    assert proven_empty(touching, apart_from=np.zeros((1, 4)), beside=0.02)
    assert not proven_empty(2 - cos(2 * q1) - cos(q2), apart_from=np.zeros((1, 4)), beside=0.02)
