"""a sin θ + b cos θ = c, of numbers and of symbols."""

import math
import pickle

import pytest
import sympy
from hypothesis import given, strategies as st

from robotics1 import InputError
from robotics1.ik import solve_trig

numbers = st.floats(-5, 5).map(lambda x: round(x, 3))
a, b, c = sympy.symbols("a b c", real=True)


@given(numbers, numbers, numbers)
def test_every_solution_satisfies_the_equation_and_there_are_two_where_c2_is_less_than_a2_plus_b2(a, b, c):
    found = solve_trig(a, b, c)
    for theta in found.solutions:
        assert -math.pi < theta <= math.pi
        assert a * math.sin(theta) + b * math.cos(theta) == pytest.approx(c, abs=1e-6)
    gap = a * a + b * b - c * c
    if gap > 1e-9:
        assert len(found) == 2
        assert found.exists_if == sympy.true
    elif gap < -1e-9:
        assert len(found) == 0
        assert found.exists_if == sympy.false


@given(numbers, numbers, st.floats(-3, 3))
def test_the_angle_that_made_c_is_among_the_solutions(a, b, theta):
    found = solve_trig(a, b, a * math.sin(theta) + b * math.cos(theta))
    if a == b == 0:
        assert found.any_angle_if == sympy.true
    else:
        assert min(abs(math.remainder(theta - other, 2 * math.pi)) for other in found.solutions) < 1e-5


def test_without_a_and_b_every_angle_is_a_solution_of_c_0_and_none_of_another_c():
    assert solve_trig(0, 0, 0).any_angle_if == sympy.true
    assert "every angle" in solve_trig(0, 0, 0).explain()
    assert solve_trig(0, 0, 1).exists_if == sympy.false
    assert "no solution" in solve_trig(0, 0, 1).explain()


def test_at_the_boundary_the_two_solutions_are_one():
    found = solve_trig(3, 4, 5)
    assert found.solutions == (pytest.approx(math.atan2(3, 4)),)
    assert found.double_if == sympy.true
    assert solve_trig(0, 2, -2).solutions == (pytest.approx(math.pi),)


@pytest.mark.parametrize("values", [(0.3, -0.8, 0.5), (-1, 0.2, 0.7), (0.0, 2.0, 0.5), (1.5, 0.0, -0.3), (1, -2, 0)])
def test_formulas_and_numbers_agree(values):
    found, theirs = solve_trig(a, b, c), solve_trig(*values)
    at = dict(zip((a, b, c), values, strict=True))
    ours = sorted(float(angle.subs(at)) % (2 * math.pi) for angle in found.solutions)
    assert ours == pytest.approx(sorted(angle % (2 * math.pi) for angle in theirs.solutions))
    assert found.exists_if.subs(at) == sympy.true
    assert found.exists_if.subs({a: 1, b: 1, c: 2}) == sympy.false
    assert found.any_angle_if.subs({a: 0, b: 0, c: 0}) == sympy.true


def test_special_cases_have_the_forms_of_a_textbook():
    assert solve_trig(0, "b", "c").solutions == (sympy.acos(c / b), -sympy.acos(c / b))
    assert solve_trig("a", 0, "c").solutions == (sympy.asin(c / a), sympy.pi - sympy.asin(c / a))
    assert solve_trig("a", "b", 0).solutions == (sympy.atan2(-b, a), sympy.atan2(b, -a))
    assert solve_trig("a", "b", "c").exists_if == sympy.Le(c**2, a**2 + b**2)


def test_what_is_neither_a_number_nor_a_formula_is_refused():
    for bad in (math.nan, math.inf, None, "no word", 1j):
        with pytest.raises(InputError):
            solve_trig(1, bad, 0)


def test_solutions_can_be_pickled():
    again = pickle.loads(pickle.dumps(solve_trig("a", 1, "c")))
    assert again.solutions == solve_trig("a", 1, "c").solutions
