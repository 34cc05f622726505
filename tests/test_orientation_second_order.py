"""Rotations to second order, completed from some entries, and recognised as sequences."""

import re
from itertools import product
from math import pi, sqrt

import numpy as np
import pinocchio as pin
import pytest
import sympy
from hypothesis import given, settings, strategies as st

import robotics1 as r1
from robotics1.orientation import (
    angular_acceleration,
    complete_rotation,
    euler_accelerations,
    euler_rate_map,
    euler_rate_map_derivative,
    euler_to_rotation,
    recognise_sequence,
    rotation_rates,
    skew,
)

SEQUENCES = [("ZYZ", False), ("ZYX", False), ("XYZ", True), ("Z-YX", False), ("YXZ", True), ("XZX", False)]
PHI, DOT, DDOT = np.array([0.4, 0.7, -0.9]), np.array([0.3, -0.5, 0.8]), np.array([1.0, 0.2, -0.6])


def differences(f, h=1e-4):
    """The first and the second derivative at 0, by central differences of fourth order."""
    a, b, c, d, e = (np.asarray(f(k * h)) for k in (-2, -1, 0, 1, 2))
    return (a - 8 * b + 8 * d - e) / (12 * h), (-a + 16 * b - 30 * c + 16 * d - e) / (12 * h**2)


@pytest.mark.parametrize(("sequence", "fixed"), SEQUENCES)
@pytest.mark.parametrize("reference", ["world", "body"])
def test_the_derivatives_of_a_rotation_are_those_of_its_angular_motion(sequence, fixed, reference):
    def R(t):
        return euler_to_rotation(sequence, PHI + t * DOT + t**2 / 2 * DDOT, fixed=fixed)

    T = euler_rate_map(sequence, PHI, fixed=fixed, reference=reference)
    T_dot = euler_rate_map_derivative(sequence, PHI, DOT, fixed=fixed, reference=reference)
    omega, omega_dot = T @ DOT, T @ DDOT + T_dot @ DOT
    first, second = differences(R)
    found = rotation_rates(R(0), omega, omega_dot, reference=reference)
    assert found.first == pytest.approx(first, abs=1e-9)
    assert found.second == pytest.approx(second, abs=1e-6)
    assert angular_acceleration(R(0), found.first, found.second, reference=reference) == pytest.approx(omega_dot)
    back = euler_accelerations(sequence, PHI, DOT, omega_dot, fixed=fixed, reference=reference)
    assert back.accelerations == pytest.approx(DDOT)
    assert not back.singular
    assert back.drift == pytest.approx(T_dot @ DOT)


def test_the_derivative_of_the_rate_map_is_its_derivative_in_symbols():
    t = sympy.Symbol("t", real=True)
    phi = [sympy.Function(name)(t) for name in "abc"]
    T = euler_rate_map("ZYX", sympy.Matrix(phi))
    expected = T.diff(t)
    found = euler_rate_map_derivative("ZYX", sympy.Matrix(phi), sympy.Matrix(phi).diff(t))
    assert (found - expected).applyfunc(sympy.simplify) == sympy.zeros(3, 3)


def test_in_symbols_r_ddot_is_s_of_omega_dot_plus_s_of_omega_squared_times_r():
    R = sympy.Matrix(euler_to_rotation("ZYX", ["a", 0, 0]))
    w, u = sympy.symbols("w u", real=True)
    found = rotation_rates(R, [0, 0, w], [0, 0, u])
    a = sympy.Symbol("a", real=True)
    assert (found.second - (R.diff(a) * u + R.diff(a, 2) * w**2)).applyfunc(sympy.simplify) == sympy.zeros(3, 3)
    assert rotation_rates(R, ["x", "y", "z"]).second is None
    S = skew(["x", "y", "z"])
    assert rotation_rates(R, ["x", "y", "z"], reference="body").first == R * S
    rates = rotation_rates(R, [0, 0, w], [0, 0, u])
    assert angular_acceleration(R, rates.first, rates.second) == sympy.Matrix([0, 0, u])


def test_at_a_singular_orientation_the_lost_acceleration_is_said():
    found = euler_accelerations("ZYZ", [0.3, 0, 0.2], [0, 0, 0], [1, 0, 0])
    assert found.singular
    assert not found.solved.feasible
    assert "no φ̈ produces this ω̇" in found.explain()
    moving = euler_accelerations("ZYZ", [0.3, 0, 0.2], [1, 1, 0], [0, 0, 0])
    T_dot = euler_rate_map_derivative("ZYZ", [0.3, 0, 0.2], [1, 1, 0])
    assert moving.drift == pytest.approx(T_dot @ [1, 1, 0])


def test_what_is_no_derivative_of_a_rotation_is_refused():
    with pytest.raises(r1.InputError, match="skew"):
        angular_acceleration(np.eye(3), np.zeros((3, 3)), np.eye(3))
    with pytest.raises(r1.InputError, match="omega must have shape"):
        rotation_rates(np.eye(3), [1, 2])
    with pytest.raises(r1.InputError, match="reference"):
        rotation_rates(np.eye(3), [1, 2, 3], reference="tool")
    with pytest.raises(r1.InputError, match="no rotation"):
        rotation_rates(2 * np.eye(3), [1, 2, 3])


# --- unknown entries


def hidden(R, places):
    return [[None if (i, j) in places else float(R[i, j]) for j in range(3)] for i in range(3)]


@given(st.integers(0, 10**6), st.integers(2, 6))
@settings(max_examples=15)
def test_a_rotation_is_among_those_that_complete_it_and_all_have_its_entries(seed, unknown):
    rng = np.random.default_rng(seed)
    R = pin.exp3(rng.uniform(-1.5, 1.5, 3))
    places = {tuple(p) for p in rng.permutation([(i, j) for i in range(3) for j in range(3)])[:unknown].tolist()}
    found = complete_rotation(hidden(R, places))
    assert found.dimension == 0
    assert min(np.abs(x - R).max() for x in found.rotations) < 1e-7
    for x in found.rotations:
        assert x.T @ x == pytest.approx(np.eye(3), abs=1e-12)
        assert np.linalg.det(x) > 0
        given_ = [(i, j) for i in range(3) for j in range(3) if (i, j) not in places]
        assert [x[p] for p in given_] == pytest.approx([R[p] for p in given_], abs=1e-9)
    assert found.correction < 1e-9


@given(st.integers(0, 10**6), st.integers(3, 6))
@settings(max_examples=10)
def test_all_rotations_with_given_entries_are_those_that_newton_finds_from_everywhere(seed, number):
    """The roots by eigenvalues, against SciPy's root finder on rotation vectors from 60 starts."""
    from scipy.optimize import least_squares

    rng = np.random.default_rng(seed)
    R = pin.exp3(rng.uniform(-1.5, 1.5, 3))
    everywhere = [(i, j) for i in range(3) for j in range(3)]
    places = [everywhere[i] for i in rng.permutation(9)[:number]]
    lines = {frozenset(p for p in everywhere if p[k] == i) for k in (0, 1) for i in range(3)}
    if number == 3 and frozenset(places) in lines:
        return  # a full row leaves a turn about it
    found = complete_rotation(hidden(R, set(everywhere) - set(places)))
    assert found.complete
    assert found.dimension == 0
    for start in rng.uniform(-3, 3, (60, 3)):
        end = least_squares(
            lambda w: [pin.exp3(w)[p] - R[p] for p in places], start, xtol=1e-15, ftol=1e-15, gtol=1e-15
        )
        if end.cost < 1e-24:
            assert min(np.abs(x - pin.exp3(end.x)).max() for x in found.rotations) < 1e-5


def test_a_block_of_four_entries_leaves_the_signs_of_the_others():
    R = pin.exp3(np.array([0.3, -0.7, 1.1]))
    found = complete_rotation(hidden(R, {(0, 2), (1, 2), (2, 0), (2, 1), (2, 2)}))
    S = np.diag([1.0, 1, -1])
    assert len(found.rotations) == 2
    assert sorted(x.round(9).tolist() for x in found.rotations) == sorted(x.round(9).tolist() for x in (R, S @ R @ S))


def test_three_entries_of_the_diagonal_leave_eight_rotations():
    R = pin.exp3(np.array([0.3, -0.7, 1.1]))
    places = {(i, j) for i in range(3) for j in range(3) if i != j}
    found = complete_rotation(hidden(R, places))
    signs = [np.diag(s) for s in product([1, -1], repeat=3) if np.prod(s) == 1]
    expected = [S @ X @ S for S in signs for X in (R, R.T)]
    assert sorted(x.round(7).tolist() for x in found.rotations) == sorted(x.round(7).tolist() for x in expected)


def test_a_full_row_has_zeros_beside_its_one():
    found = complete_rotation([[1, None, None], [None, 0.6, None], [None, None, "c"]])
    assert found.names == ("c",)
    assert found.values.ravel() == pytest.approx([0.6, 0.6])
    assert sorted(found.rotations[:, 1, 2].tolist()) == pytest.approx([-0.8, 0.8])


def test_printed_entries_are_corrected_by_their_rounding():
    found = complete_rotation([[0.7071, None, 0.7071], [None, -1, None], [None, None, None]])
    assert found.rotations[:, 0, 0] == pytest.approx([sqrt(0.5)] * 2, abs=1e-4)
    assert 0 < found.correction < 5e-5
    assert found.rotations[:, 0, 1] == pytest.approx([0, 0], abs=1e-5)


def test_one_name_twice_is_one_number():
    found = complete_rotation([["a", 0, None], [0, "a", None], [None, None, None]])
    assert sorted(found.values.ravel().tolist()) == pytest.approx([-1, 1])
    assert "2 rotations" in found.explain()


def test_too_few_entries_leave_a_family_and_contradictory_ones_nothing():
    free = complete_rotation([[0.5, None, None], [None, None, None], [None, None, None]])
    assert free.dimension == 2
    assert not free.complete
    assert free.rotations[:, 0, 0] == pytest.approx(np.full(len(free.rotations), 0.5))
    assert "a family of 2 parameters" in free.explain()
    assert complete_rotation([[None] * 3] * 3).dimension == 3
    assert complete_rotation([[0.6, 0.0, None], [0.0, 0.9, None], [None, None, -0.9]]).complete  # and there is none
    assert not len(complete_rotation([[0.6, 0.0, None], [0.0, 0.9, None], [None, None, -0.9]]).rotations)
    none = complete_rotation([[0.9, 0.9, None], [None] * 3, [None] * 3])
    assert len(none.rotations) == 0
    with pytest.raises(r1.NotConverged, match="no rotation"):
        none.require()


@pytest.mark.parametrize("M", [[[1, 2]], 3, [[2, None, None]] * 3, [[1j, 0, 0]] * 3, [[None] * 4] * 3])
def test_what_is_no_matrix_with_unknown_entries_is_refused(M):
    with pytest.raises(r1.InputError, match="M"):
        complete_rotation(M)


# --- products of rotations

a, b, c = sympy.symbols("a b c", real=True)
H = sympy.pi / 2


def turn(axis, x):
    return sympy.Matrix(euler_to_rotation({"x": "XYX", "y": "YXY", "z": "ZXZ"}[axis], sympy.Matrix([x, 0, 0])))


def value(found, angles):
    R = sympy.eye(3)
    for letter, angle in zip(re.findall("-?[XYZ]", found.sequence), found.angles, strict=True):
        R = R * turn(letter[-1].lower(), -angle if letter[0] == "-" else angle)
    return np.array((found.left * R * found.right).subs(angles).evalf(), dtype=float)


@pytest.mark.parametrize(
    ("R", "sequence", "angles", "constants"),
    [
        (lambda: turn("z", a) * turn("x", -H) * turn("z", b) * turn("x", H) * turn("z", c), "ZYZ", (a, b, c), (0, 0)),
        (lambda: turn("z", a) * turn("x", H) * turn("y", b), "Z", (a + b,), (0, 1)),
        (lambda: turn("x", sympy.pi / 4) * turn("z", a) * turn("y", b), "ZY", (a, b), (1, 0)),
        (lambda: turn("x", a) * turn("y", -b) * turn("x", c) * turn("z", sympy.pi / 3), "X-YX", (a, b, c), (0, 1)),
        (lambda: turn("y", b) * turn("x", a) * turn("z", c), "YXZ", (b, a, c), (0, 0)),
        (lambda: turn("x", c), "X", (c,), (0, 0)),
    ],
)
def test_a_product_of_rotations_is_a_sequence_between_constants(R, sequence, angles, constants):
    M = R().applyfunc(sympy.expand)
    found = recognise_sequence(M)
    assert (found.sequence, found.angles) == (sequence, angles)
    assert (found.left != sympy.eye(3), found.right != sympy.eye(3)) == tuple(map(bool, constants))
    numbers = {a: 0.3, b: -0.7, c: 1.1}
    assert value(found, numbers) == pytest.approx(np.array(M.subs(numbers).evalf(), dtype=float), abs=1e-12)
    assert found.explain().startswith("R = ")


def test_the_wrist_of_a_dh_arm_is_recognised_from_its_formulas():
    rows = [("R", 0, -pi / 2, 0, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, 0, 0, 0)]
    R = r1.formulas(r1.robot_from_dh(rows), r1.OrientationTask()).value
    q1, q2, q3 = sympy.symbols("q1:4", real=True)
    found = recognise_sequence(R)
    assert (found.sequence, found.angles) == ("ZYZ", (q1, q2, q3))


@pytest.mark.parametrize(
    ("R", "error", "words"),
    [
        (lambda: turn("z", a) * turn("x", sympy.pi / 4) * turn("z", b), r1.FormulaError, "perpendicular"),
        (lambda: turn("z", a) * turn("x", a), r1.FormulaError, "turn by a or"),
        (lambda: turn("z", 2 * a), r1.FormulaError, "turn by a or"),
        (lambda: sympy.Matrix([[a, 0, 0], [0, 1, 0], [0, 0, 1]]), r1.FormulaError, "no constant rotation"),
        (lambda: np.eye(3), r1.InputError, "numbers alone"),
    ],
)
def test_what_is_no_sequence_says_why(R, error, words):
    with pytest.raises(error, match=words):
        recognise_sequence(R())
