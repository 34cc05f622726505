"""Angle rates and angular velocity: against differences, hand formulas, the lost direction, and skew matrices."""

from itertools import product
from math import cos, nan, pi, sin, tan

import numpy as np
import pytest
import sympy
from differences import derivative
from formula_values import same
from hypothesis import given, strategies as st
from sweeps import core_first

from robotics1 import InputError, subspaces
from robotics1.orientation import (
    angular_velocity,
    axis_angle_to_rotation,
    euler_accelerations,
    euler_formulas,
    euler_rate_map,
    euler_rates,
    euler_to_rotation,
    skew,
    vee,
)

TWELVE = [a + b + c for a, b, c in product("XYZ", repeat=3) if a != b != c]
SOME = [*TWELVE, "Z-YX", "-ZY-Z", "-X-Y-Z", "Y-XY", "XZ-X"]
angle = st.floats(-3, 3)
three = st.tuples(angle, angle, angle).map(np.array)


def measured(name, fixed, angles, reference):
    """The columns of T from (∂R/∂φᵢ) Rᵀ = [ω]×, by differences; in body axes from Rᵀ ∂R/∂φᵢ."""
    R = euler_to_rotation(name, angles, fixed=fixed)
    columns = []
    for flat in derivative(lambda x: euler_to_rotation(name, x, fixed=fixed).ravel(), angles).T:
        W = flat.reshape(3, 3) @ R.T if reference == "world" else R.T @ flat.reshape(3, 3)
        columns.append([W[2, 1], W[0, 2], W[1, 0]])
    return np.array(columns).T


@pytest.mark.parametrize("reference", ["world", "body"])
@pytest.mark.parametrize("fixed", [False, True])
@pytest.mark.parametrize("name", SOME)
def test_rate_map_is_the_derivative_of_the_rotation(name, fixed, reference):
    angles = np.random.default_rng(len(name)).uniform(-3, 3, 3)
    T = euler_rate_map(name, angles, fixed=fixed, reference=reference)
    assert measured(name, fixed, angles, reference) == pytest.approx(T, abs=1e-10)


@given(three)
def test_zyz_rate_map_is_the_printed_one(angles):
    (s1, s2), (c1, c2) = np.sin(angles[:2]), np.cos(angles[:2])
    T = [[0, -s1, c1 * s2], [0, c1, s1 * s2], [1, 0, c2]]
    assert euler_rate_map("ZYZ", angles) == pytest.approx(np.array(T), abs=1e-15)


@given(three)
def test_roll_pitch_yaw_body_rates_are_p_minus_sin_theta_r_and_so_on(angles):
    """Aerospace: Ω = (φ̇ − sin θ ψ̇, cos φ θ̇ + sin φ cos θ ψ̇, −sin φ θ̇ + cos φ cos θ ψ̇), φ = (roll, pitch, yaw)."""
    phi, theta, _ = angles
    T = [[1, 0, -sin(theta)], [0, cos(phi), sin(phi) * cos(theta)], [0, -sin(phi), cos(phi) * cos(theta)]]
    found = euler_rate_map("XYZ", angles, fixed=True, reference="body")
    assert found == pytest.approx(np.array(T), abs=1e-15)


@pytest.mark.parametrize("fixed", [False, True])
@pytest.mark.parametrize("name", core_first(SOME, SOME[::4], 4))
def test_determinant_and_lost_direction_are_those_of_the_matrix(name, fixed):
    f = euler_formulas(name, fixed=fixed)
    at = dict(zip(f.angles, (0.4, 0.7, -0.9), strict=True))
    T = euler_rate_map(name, [0.4, 0.7, -0.9], fixed=fixed)
    assert np.array(f.rate_map.subs(at), float) == pytest.approx(T, abs=1e-15)
    assert float(f.determinant.subs(at)) == pytest.approx(np.linalg.det(T), abs=1e-15)
    assert np.array(f.inverse_rate_map.subs(at), float) == pytest.approx(np.linalg.inv(T), abs=1e-14)
    body = euler_rate_map(name, [0.4, 0.7, -0.9], fixed=fixed, reference="body")
    assert np.array(f.body_rate_map.subs(at), float) == pytest.approx(body, abs=1e-15)
    for singular in f.singular:
        at[f.angles[1]] = singular.value
        spaces = subspaces(np.array(f.rate_map.subs(at), float))
        lost = np.array(singular.lost.subs(at), float).ravel()
        assert spaces.rank == 2
        assert abs(spaces.left_null[:, 0] @ lost) == pytest.approx(1, abs=1e-14)


def test_determinants_are_minus_sin_b_minus_cos_b_and_plus_cos_b():
    b = sympy.Symbol("b", real=True)

    def det(name, **options):
        return euler_formulas(name, angles=("a", "b", "c"), **options).determinant

    assert det("ZYZ") == -sympy.sin(b)
    assert det("ZYX") == -sympy.cos(b)
    assert det("XYZ") == sympy.cos(b)
    assert det("Z-YX") == sympy.cos(b)
    assert det("XYZ", fixed=True) == sympy.cos(b)
    assert det("ZYX", fixed=True) == -sympy.cos(b)
    assert det("ZYZ", fixed=True) == sympy.sin(b)


@pytest.mark.parametrize("reference", ["world", "body"])
@pytest.mark.parametrize("name", SOME)
def test_rates_produce_the_angular_velocity(name, reference):
    rng = np.random.default_rng(5)
    angles, omega = np.array([0.3, 0.8, -2]), rng.uniform(-2, 2, 3)
    found = euler_rates(name, angles, omega, reference=reference)
    T = euler_rate_map(name, angles, reference=reference)
    assert T @ found.rates == pytest.approx(omega, abs=1e-14)
    assert found.determinant == pytest.approx(np.linalg.det(T), abs=1e-15)
    assert (found.singular, found.feasible, found.lost, found.null) == (False, True, None, None)
    assert found.explain().startswith("det T = ")


def test_zyx_rates_grow_with_tan_theta():
    found = euler_rates("ZYX", [0.4, 1.3, 0.2], [1, 0, 0])
    assert found.rates == pytest.approx([cos(0.4) * tan(1.3), -sin(0.4), cos(0.4) / cos(1.3)], abs=1e-14)


@pytest.mark.parametrize("fixed", [False, True])
@pytest.mark.parametrize("reference", ["world", "body"])
@pytest.mark.parametrize("name", SOME)
def test_at_a_singularity_the_part_of_omega_along_the_lost_direction_is_not_produced(name, reference, fixed):
    b = 0 if name[-1] == name.lstrip("-")[0] else pi / 2
    angles, omega = [0.4, b, -0.9], np.array([1.0, 2.0, -3.0])
    found = euler_rates(name, angles, omega, fixed=fixed, reference=reference)
    T = euler_rate_map(name, angles, fixed=fixed, reference=reference)
    spaces = subspaces(T)
    assert (found.singular, found.feasible) == (True, False)
    assert abs(spaces.left_null[:, 0] @ found.lost) == pytest.approx(1, abs=1e-14)
    assert T @ found.rates + found.unproduced == pytest.approx(omega, abs=1e-14)
    assert found.unproduced == pytest.approx(spaces.unrealisable(omega), abs=1e-14)
    assert T @ found.null == pytest.approx(np.zeros(3), abs=1e-15)
    assert found.null @ found.rates == pytest.approx(0, abs=1e-14)
    assert "no φ̇ produces this ω" in found.explain()
    produced = euler_rates(name, angles, T @ [1, 2, 3], fixed=fixed, reference=reference)
    assert produced.feasible
    assert T @ produced.rates == pytest.approx(T @ [1, 2, 3], abs=1e-14)
    assert not euler_rates(name, angles, found.lost, fixed=fixed, reference=reference).feasible


@pytest.mark.parametrize("name", SOME)
def test_printed_digits_of_a_singular_angle_are_said_to_be_so_and_the_answer_there_is_that_of_the_exact_one(name):
    b, printed = (pi, 3.1416) if name[-1] == name.lstrip("-")[0] else (pi / 2, 1.5708)
    T, omega = euler_rate_map(name, [0.4, b, -0.9]), [1.0, 2.0, -3.0]
    found, exact = euler_rates(name, [0.4, printed, -0.9], omega), euler_rates(name, [0.4, b, -0.9], omega)
    assert (found.singular, found.near, exact.near) == (False, (b, 5e-5), None)
    assert found.at_singularity.rates == pytest.approx(exact.rates)
    assert found.at_singularity.unproduced == pytest.approx(exact.unproduced)
    assert found.explain().startswith("T is nearly singular: φ2 is within 5e-05 of π")
    rounded = euler_rates(name, [0.4, printed, -0.9], np.round(T @ [0.3, 0.2, 0.1], 4)).at_singularity
    assert rounded.feasible
    assert rounded.rates @ exact.null == pytest.approx(0, abs=1e-12)
    assert T @ rounded.rates == pytest.approx(T @ [0.3, 0.2, 0.1], abs=2e-4)


def test_digits_that_stand_for_no_singular_angle_leave_one_answer():
    assert euler_rates("ZYX", [0.4, 1.5706, -0.9], [1, 2, 3]).at_singularity is None
    assert euler_rates("ZYZ", [0.4, 0.001, -0.9], [1, 2, 3]).at_singularity is None


@pytest.mark.parametrize("name", ["ZYX", "YXZ", "ZYZ"])
def test_accelerations_at_printed_digits_have_the_drift_of_the_singular_angle(name):
    b, printed = (pi, 3.1416) if name == "ZYZ" else (pi / 2, 1.5708)
    rates, wanted = [0.3, -0.2, 0.5], [1.0, 2.0, -3.0]
    there = euler_accelerations(name, [0.4, printed, -0.9], rates, wanted).solved.at_singularity
    exact = euler_accelerations(name, [0.4, b, -0.9], rates, wanted)
    assert there.rates == pytest.approx(exact.accelerations)
    assert there.unproduced == pytest.approx(exact.solved.unproduced)


def test_a_symbolic_rate_map_is_a_matrix_of_the_same_code():
    a, b, c = sympy.symbols("a b c", real=True)
    T = euler_rate_map("ZYX", (a, b, c))
    hand = [[0, -sympy.sin(a), sympy.cos(a) * sympy.cos(b)], [0, sympy.cos(a), sympy.sin(a) * sympy.cos(b)],
            [1, 0, -sympy.sin(b)]]  # fmt: skip
    assert sympy.Matrix(hand) == T
    assert same(T.det(), euler_formulas("ZYX", angles=(a, b, c)).determinant)


x, y = sympy.symbols("x y", real=True)


@pytest.mark.parametrize(
    "zero",
    [
        sympy.sin(x) ** 2 + sympy.cos(x) ** 2 - 1,
        1 / (1 + x**2) + x**2 / (1 + x**2) - 1,
        1e-16 * sympy.sin(x) + sympy.Float(0.1) * sympy.cos(y) - sympy.cos(y) / 10,
    ],
)
@pytest.mark.parametrize("place", [(0, 1), (1, 1)])
def test_vee_takes_a_matrix_that_is_skew_but_for_what_is_zero_or_rounding(zero, place):
    S = skew((x, y, 3))
    S[place] += zero
    assert vee(S) == sympy.Matrix([x, y, 3])


@pytest.mark.parametrize("difference", [sympy.sin(x) - 1e-6 * sympy.cos(x), sympy.sin(x) ** 2 - 1])
@pytest.mark.parametrize("place", [(0, 1), (1, 1)])
def test_vee_refuses_a_matrix_that_is_not_skew(difference, place):
    S = skew((x, y, 3))
    S[place] += difference
    with pytest.raises(InputError, match="skew"):
        vee(S)


# --- skew matrices and the angular velocity of R(t)


@given(three, three)
def test_skew_is_the_cross_product_and_vee_its_inverse(v, w):
    assert skew(v) @ w == pytest.approx(np.cross(v, w), abs=1e-14)
    assert vee(skew(v)) == pytest.approx(v, abs=0)
    assert skew(v) == pytest.approx(-skew(v).T, abs=0)


def test_skew_and_vee_take_expressions():
    x, y, z = sympy.symbols("x y z", real=True)
    S = skew((x, y, z))
    assert sympy.Matrix([[0, -z, y], [z, 0, -x], [-y, x, 0]]) == S
    assert vee(S) == sympy.Matrix([x, y, z])
    assert skew(("x", 0, "z"))[0, 1] == -z


@given(three, three)
def test_r_skew_omega_r_transposed_is_skew_r_omega(angles, v):
    R = euler_to_rotation("XYZ", angles)
    assert vee(R @ skew(v) @ R.T) == pytest.approx(R @ v, abs=1e-14)


def test_angular_velocity_of_r_of_t_is_t_phi_dot_in_both_axes():
    t = sympy.Symbol("t", real=True)
    R = euler_to_rotation("ZYX", (t, t, 2 * t))
    for reference in ("world", "body"):
        omega = angular_velocity(R, R.diff(t), reference=reference)
        wanted = euler_rate_map("ZYX", (t, t, 2 * t), reference=reference) * sympy.Matrix([1, 1, 2])
        assert same(omega, wanted)
        number = angular_velocity(np.array(R.subs(t, 0.3), float), np.array(R.diff(t).subs(t, 0.3), float),
                                  reference=reference)  # fmt: skip
        assert number == pytest.approx(np.array(wanted.subs(t, 0.3), float).ravel(), abs=1e-14)


def test_angular_velocity_of_printed_numbers():
    """R of four digits, and Ṙ = [ω]× R of four digits."""
    omega = np.array([0.5, -1.0, 0.25])
    R = euler_to_rotation("ZYZ", [0.1, 0.7, 0.4])
    assert angular_velocity(R.round(4), (skew(omega) @ R).round(4)) == pytest.approx(omega, abs=2e-4)


@pytest.mark.parametrize("S", [np.eye(3), np.zeros((2, 2)), None, [["a", 0, 0], [0, 0, 0], [0, 0, 0]]])
def test_vee_wants_a_skew_symmetric_matrix(S):
    with pytest.raises(InputError, match="skew-symmetric"):
        vee(S)


@pytest.mark.parametrize(
    ("R", "R_dot"), [(np.eye(3), np.eye(3)), (2 * np.eye(3), np.zeros((3, 3))), (np.eye(3), [1, 2, 3])]
)
def test_angular_velocity_wants_a_rotation_and_its_derivative(R, R_dot):
    with pytest.raises(InputError, match=r"R_dot|R is no rotation"):
        angular_velocity(R, R_dot)


def test_a_formula_that_is_no_derivative_is_refused():
    t = sympy.Symbol("t", real=True)
    R = axis_angle_to_rotation([0, 0, 1], t)
    with pytest.raises(InputError, match="Rᵀ R_dot must be skew-symmetric"):
        angular_velocity(R, R, reference="body")


@pytest.mark.parametrize("arguments", [("ZZX", [0, 0, 0], [0, 0, 0]), ("ZYX", [0, 0], [0, 0, 0]),
                                       ("ZYX", [0, 0, 0], [0, nan, 0]), ("ZYX", "abc", [0, 0, 0])])  # fmt: skip
def test_rates_want_a_sequence_three_angles_and_omega(arguments):
    with pytest.raises(InputError):
        euler_rates(*arguments)


def test_references_are_world_or_body():
    for call in (lambda: euler_rate_map("ZYX", [0, 0, 0], reference="tool"),
                 lambda: euler_rates("ZYX", [0, 0, 0], [0, 0, 0], reference=None),
                 lambda: angular_velocity(np.eye(3), np.zeros((3, 3)), reference="base")):  # fmt: skip
        with pytest.raises(InputError, match="reference"):
            call()
