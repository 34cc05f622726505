"""Factors of trigonometric polynomials, half-angle tangents, and exact axes and rotations."""

from fractions import Fraction
from functools import reduce

import numpy as np
import pytest
import sympy
from arms import ARMS, arm
from polynomials import F, a, b, c, equal, poly, q1, q2, q3, q4, random_q, sympy_of, value
from sympy import cos, sin, sqrt

from robotics1.angles import twelfths_of_pi, without_turns
from robotics1.symbolic.kinematics.chain import chain_to
from robotics1.symbolic.kinematics.exact import exact_axis, exact_length
from robotics1.symbolic.polynomials.factoring import factors, in_whole_angles, irreducible_factors
from robotics1.symbolic.polynomials.half_tangents import from_numerator, highest_multiples, in_half_angles, numerator

IRREDUCIBLE = [
    sin(q1),
    cos(q1),
    sin(q2 + q3),
    cos(q1 + q2 + q3),
    a + b * cos(q3),
    a * cos(q2) + b * cos(q2 + q3),
    a * cos(q1) + b * sin(q2),
    a * cos(q2) + b * cos(q2 + q3) + c * sin(q1 + q2 + q3),
    a - b,
    a + q4,
    q4 * cos(q1) + b * sin(q1),
    a**2 + b**2 + 2 * a * b * cos(q2),
]
PRODUCTS = [
    (sin(q1), sin(q1)),
    (sin(q2), cos(q2)),
    (a, b, sin(q3), a * cos(q2) + b * cos(q2 + q3)),
    (sin(q2 + q3), a + b * cos(q3), a - b),
    (q4, q4, sin(q2)),
    (cos(q1), cos(q2), cos(q3)),
    (a + b * cos(q3), a - b * cos(q3)),
    (a * cos(q2) + b * cos(q2 + q3), a * cos(q1) + b * sin(q2)),
    (sin(q1 + q2), sin(q1 - q2)),
]


def up_to_sign_and_number(expression):
    """One form of all the multiples of a polynomial by a number."""
    f = poly(expression)
    k = max(f.terms)
    lead = max(f.terms[k].terms())[1]
    return frozenset((n, frozenset((m, x / lead) for m, x in p.terms())) for n, p in f.terms.items())


@pytest.mark.parametrize("parts", PRODUCTS, ids=str)
def test_the_factors_of_a_product_are_its_parts_and_their_product_is_f(parts):
    f = poly(sympy.Mul(*parts, evaluate=False).doit())
    found = factors(f)
    assert equal(reduce(lambda x, y: x * y, found), f)
    bare = sorted(map(str, (up_to_sign_and_number(sympy_of(g)) for g in found if g.symbols)))
    assert bare == sorted(map(str, map(up_to_sign_and_number, parts)))


@pytest.mark.parametrize("f", IRREDUCIBLE, ids=str)
def test_irreducible_polynomials_are_one_factor(f):
    assert len([g for g in factors(poly(f)) if g.symbols]) == 1


@pytest.mark.parametrize(
    ("f", "count"),
    [
        (cos(2 * q1), 1),  # cos² − sin²: over the rationals cos 2q is as prime as x² − 2
        (sin(2 * q1), 2),  # 2 sin cos
        (1 - cos(q1) ** 2, 2),  # sin²
        (1 - cos(q1), 2),  # 2 sin²(q/2), of two half angles that are one whole factor
        (cos(q1) - cos(q2), 2),  # −2 sin((q1 + q2)/2) sin((q1 − q2)/2)
        (sin(q1) + sin(q2), 2),
    ],
)
def test_parts_of_half_angles_multiply_to_the_polynomial(f, count):
    number, parts = irreducible_factors(poly(f))
    halves = reduce(lambda x, y: x * y, [part.in_half_angles for part in parts]) * number
    doubled = {tuple(2 * m for m in k): x for k, x in poly(f).terms.items()}
    assert {k: x for k, x in halves.terms.items() if x} == doubled
    whole = in_whole_angles(parts)
    assert not any(any(part.parity) for part in whole)
    assert equal(reduce(lambda x, y: x * y, [part.in_angles for part in whole]) * number, poly(f))
    assert (len(whole) if count == 1 else len(parts)) >= count


@pytest.mark.parametrize(
    "f", [*IRREDUCIBLE, *(sympy.Mul(*parts) for parts in PRODUCTS), cos(3 * q1) * sin(q2)], ids=str
)
def test_half_angle_tangents_lead_back_to_f_and_have_its_values(f):
    """N(t) = f Π (1 + t²)^d at t = tan(φ/2), d being the highest multiple of each angle."""
    f = poly(f)
    d = highest_multiples(f)
    assert equal(from_numerator(F, numerator(f), d), f)
    q = random_q(np.random.default_rng(1))
    t = np.tan(q[:3] / 2)
    lengths = [Fraction(q[3]).limit_denominator(10**6), Fraction(1, 2), Fraction(2, 5), Fraction(3, 10), 0, 0]
    q[3] = float(lengths[0])
    tangents = [Fraction(x) for x in t]
    total = sum(
        Fraction(int(x.p), int(x.q))
        * np.prod([Fraction(base) ** int(m) for base, m in zip([*lengths, *tangents], k, strict=True)])
        for k, x in numerator(f).to_dict().items()
    )
    assert float(total) == pytest.approx(value(f, q).real * np.prod((1 + t**2) ** d), rel=1e-9, abs=1e-9)


def test_the_tangent_of_a_half_angle_is_sine_over_cosine():
    """t/(1 + t²)^(1/2) = sin(φ/2), with exponents that count half angles."""
    t = numerator(poly(sin(q1)))  # 2 t
    sine = in_half_angles(F, t, (1, 0, 0))
    assert value(sine, [0.7, 0, 0, 0]) == pytest.approx(2 * np.sin(0.7))


def test_equal_polynomials_have_equal_terms_however_they_are_written():
    assert equal(poly(cos(q1) ** 2 + sin(q1) ** 2), poly(1))
    assert equal(poly(cos(q1 + q2)), poly(cos(q1) * cos(q2) - sin(q1) * sin(q2)))
    assert equal(poly(sqrt(2) ** 2 * cos(q1)), poly(2 * cos(q1)))
    assert equal(poly(cos(q1 + sympy.pi / 6)), poly(sqrt(3) / 2 * cos(q1) - sin(q1) / 2))
    assert not equal(poly(cos(q1)), poly(cos(q2)))


# --- exact numbers


@pytest.mark.parametrize("k", range(-12, 13))
def test_a_twelfth_of_half_a_turn_is_told_within_1e_5(k):
    angle = k * np.pi / 12
    assert twelfths_of_pi(angle) == twelfths_of_pi(angle + 9e-6) == twelfths_of_pi(round(angle, 5)) == k
    assert twelfths_of_pi(angle + 1.1e-5) is None
    turn = F.turn(k)
    assert value(turn, [0, 0, 0, 0]) == pytest.approx(np.exp(1j * angle))
    assert equal(turn * F.turn(-k), F.constant(1))


def test_angles_without_turns_are_the_nearest_to_zero_and_keep_the_digits_of_small_ones():
    angles = np.array([1e-17, 1.5 * np.pi, -7.0, 2 * np.pi + 0.25])
    assert without_turns(angles) == pytest.approx([1e-17, -np.pi / 2, 2 * np.pi - 7, 0.25], rel=1e-14, abs=0)
    assert without_turns(np.array([7.0, 9.0]), np.array([2 * np.pi, 4 * np.pi])) == pytest.approx(
        [7 - 2 * np.pi, 9 - 4 * np.pi]
    )


@pytest.mark.parametrize("name", ["q2", "a"])
def test_a_polynomial_is_the_sum_of_its_coefficients_times_powers_of_one_symbol(name):
    """Σ c_k exp(i k φ), or Σ c_k aᵏ."""
    symbol = {"q2": q2, "a": a}[name]
    f = poly((2 * cos(q1 + 2 * q2) + a * sin(q2 - q3) - b) * (a**2 * cos(q2) + c))
    parts = f.coefficients(symbol)
    assert not any(symbol in part.symbols for part in parts.values())
    power = F.exponential({symbol: 1}) if name == "q2" else F.constant(F.ring(symbol))
    total = sum((part * (power if k > 0 else power.conjugate) ** abs(k) for k, part in parts.items()), F.constant(0))
    assert equal(total, f)


@pytest.mark.parametrize(("x", "exact"), [(0.1, "1/10"), (1 / 3, "1/3"), (0.0203, "0.0203"), (-0.39225, "-0.39225")])
def test_a_length_is_the_short_fraction_or_the_decimal_that_was_meant(x, exact):
    assert exact_length(x) == Fraction(exact)


@pytest.mark.parametrize(
    ("axis", "root"),
    [
        ((0, 0, 1), 1),
        ((0, -1, 0), 1),
        ((1, 0, -1), 2),
        ((1, 1, 1), 3),
        ((2, 1, 1), 6),
        ((3, 0, 4), 1),
        ((2, -1, 2), 1),
        ((0.48, 0.6, 0.64), 1),
        ((1, 2, 0), 1),
        ((0.3, -0.2, 0.7), 1),
        ((1e-7, 0, 1), 1),
    ],
)
def test_an_exact_axis_has_length_one_exactly_and_is_the_axis_to_1e_15(axis, root):
    unit = np.array(axis, dtype=float) / np.linalg.norm(axis)
    v, k = exact_axis(unit)
    assert k == root
    assert k * sum(x * x for x in v) == 1
    assert np.array(v, dtype=float) * np.sqrt(k) == pytest.approx(unit, abs=1e-15)


@pytest.mark.parametrize("name", [name for name in ARMS if name != "two_tips"])
def test_rotations_of_every_test_arm_are_orthogonal_exactly(name):
    """R Rᵀ = 1 in symbols, of arms with turns of any angle about any axis, to the tool and to every joint."""
    robot = arm(name)
    chain = chain_to(robot, robot.tool)
    one, nothing = chain.trig_ring.constant(1), chain.trig_ring.constant(0)
    motions = [chain.motion(joint)[0] for joint in chain.joints]
    for R in [*motions, *(chain.turn(chain.joints[:k]) for k in (1, 2, 3))]:
        product = R @ R.T
        assert all(equal(product[i, j], one if i == j else nothing) for i in range(3) for j in range(3))
