from fractions import Fraction

import numpy as np
import pytest
import sympy

from robotics1 import InputError, cubic, quintic
from robotics1.trajectories import polynomial_formula, septic

q0, v0, a0, q1, v1, a1, T = sympy.symbols("q0 v0 a0 q1 v1 a1 T", real=True)
tau, t = sympy.symbols("tau t", real=True)


def same(a, b):
    return sympy.expand(a - b) == 0


def test_from_rest_at_zero_q_is_3_q1_minus_T_v1_tau2_and_so_on_as_written_on_paper():
    found = polynomial_formula((0, 0), (q1, v1), T)
    assert found.coefficients == (0, 0, 3 * q1 - T * v1, -2 * q1 + T * v1)
    assert found.formula == (3 * q1 - T * v1) * tau**2 + (-2 * q1 + T * v1) * tau**3  # collected, not expanded
    assert found.rate.formula == 2 * ((3 * q1 - T * v1) / T) * tau + 3 * ((-2 * q1 + T * v1) / T) * tau**2


def test_cubic_between_two_states_is_the_one_with_delta():
    delta = q1 - q0
    expected = q0 + v0 * T * tau + (3 * delta - (2 * v0 + v1) * T) * tau**2 + (-2 * delta + (v0 + v1) * T) * tau**3
    found = polynomial_formula((q0, v0), (q1, v1), T)
    assert same(found.formula, expected)
    assert len(found.coefficients) == 4


def test_a_name_is_a_real_symbol_and_that_of_the_duration_a_positive_one():
    lasting = sympy.Symbol("T", positive=True)
    assert polynomial_formula(("q0", "v0"), ("q1", 0), "T") == polynomial_formula((q0, v0), (q1, 0), lasting)


def test_rest_to_rest_polynomials_of_degree_3_5_and_7():
    assert polynomial_formula((0, 0), (1, 0), T).coefficients == (0, 0, 3, -2)
    assert polynomial_formula((0, 0, 0), (1, 0, 0), T).coefficients == (0, 0, 0, 10, -15, 6)
    assert polynomial_formula((0, 0, 0, 0), (1, 0, 0, 0), T).coefficients == (0, 0, 0, 0, 35, -84, 70, -20)


@pytest.mark.parametrize("first", range(1, 5))
@pytest.mark.parametrize("last", range(1, 5))
def test_values_and_derivatives_at_both_ends_are_the_given_ones(first, last):
    start, end = sympy.symbols(f"s0:{first}"), sympy.symbols(f"e0:{last}")
    found = polynomial_formula(start, end, T)
    assert len(found.coefficients) == first + last
    q = found.formula_t
    assert all(same(q.diff(t, k).subs(t, 0), value) for k, value in enumerate(start))
    assert all(same(q.diff(t, k).subs(t, T), value) for k, value in enumerate(end))


def test_the_rate_is_the_derivative_with_respect_to_t():
    found = polynomial_formula((q0, v0, a0), (q1, v1, a1), T)
    assert same(found.rate.formula, found.formula.diff(tau) / T)
    assert same(found.rate.formula_t, found.formula_t.diff(t))
    assert same(found.rate.rate.formula_t, found.formula_t.diff(t, 2))
    assert same(found.formula.subs(tau, t / T), found.formula_t)
    assert found.coefficients_t[:3] == (q0, v0, a0 / 2)


def test_numbers_give_the_coefficients_of_the_numeric_polynomials():
    rng = np.random.default_rng(7)
    for state, numeric in ((2, cubic), (3, quintic), (4, septic)):
        start, end, duration = rng.uniform(-3, 3, state), rng.uniform(-3, 3, state), rng.uniform(0.3, 3)
        if state == 4:
            start[3] = end[3] = 0
        rates = [rate for pair in zip(start, end, strict=True) for rate in pair][2:6]
        expected = numeric(start[:1], end[:1], duration, *rates)
        found = polynomial_formula(start.tolist(), end.tolist(), duration)
        assert np.array(found.coefficients, dtype=float) == pytest.approx(expected.coefficients[:, 0])
        assert np.array(found.rate.coefficients, dtype=float) == pytest.approx(expected.rate.coefficients[:, 0])
        assert np.array(found.coefficients_t, dtype=float) == pytest.approx(expected.coefficients_t[:, 0])


def test_the_degree_is_the_lowest():
    assert polynomial_formula((q0, v0), (q0 + v0 * T, v0), T).coefficients == (q0, T * v0)
    assert polynomial_formula((q0,), (q0,), T).coefficients == (q0,)
    assert polynomial_formula((q0,), (q0,), T).rate.coefficients == (0,)
    assert polynomial_formula((0,), (0,), 1).coefficients == (0,)


def test_fractions_stay_exact_and_functions_of_angles_stay_as_they_are():
    angle = sympy.Symbol("alpha", real=True)
    assert polynomial_formula((Fraction(1, 3), 0), (1, 0), 2).coefficients == (
        sympy.Rational(1, 3),
        0,
        2,
        -sympy.Rational(4, 3),
    )
    assert polynomial_formula((0, 0), (sympy.cos(angle + q0), 0), T).coefficients[2] == 3 * sympy.cos(angle + q0)


@pytest.mark.parametrize(
    ("start", "end", "duration", "says"),
    [
        ((), (1,), 1, "start must be a value and derivatives"),
        ((0,), "q1", 1, "end must be a value and derivatives"),
        (q0, (q1,), 1, "start must be a value and derivatives"),
        ((0,), np.array([1.0]), 1, "end must be a value and derivatives"),
        ((0,) * 13, (1,), 1, "at most 12"),
        (("q 0",), (1,), 1, r"start\[0\] must be a SymPy expression, a number or a name, not 'q 0'"),
        ((0, True), (1,), 1, r"start\[1\] must be a SymPy expression, a number or a name, not True"),
        ((0, "t"), (1,), 1, r"start\[1\] must not depend on t, the time of the polynomial"),
        ((0,), (None,), 1, r"end\[0\] must be a SymPy expression"),
        ((0,), (sympy.Matrix([1]),), 1, r"end\[0\] must be a SymPy expression"),
        ((0,), (sympy.MatrixSymbol("q", 2, 1),), 1, r"end\[0\] must be a SymPy expression"),
        ((float("nan"),), (1,), 1, r"start\[0\] must be real and finite"),
        ((0,), (1, sympy.oo * q0), 1, r"end\[1\] must be real and finite"),
        ((1j,), (1,), 1, "must be real and finite"),
        ((sympy.Symbol("z", imaginary=True),), (1,), 1, "must be real and finite"),
        ((sympy.Symbol("t"),), (1,), 1, "must not depend on t, the time"),
        ((0,), (1,), tau, "duration must not depend on tau"),
        ((0,), (1,), 0, "duration must be positive; it is 0"),
        ((0,), (1,), -0.5, "duration must be positive"),
        ((0,), (1,), sympy.Symbol("n", negative=True), "duration must be positive"),
        ((0,), (1,), "T/2", "duration must be a SymPy expression, a number or a name"),
        ((0,), (1,), float("inf"), "duration must be real and finite"),
    ],
)
def test_what_is_no_state_or_no_duration_is_an_input_error(start, end, duration, says):
    with pytest.raises(InputError, match=says):
        polynomial_formula(start, end, duration)
