"""Sequences of three angles: against SciPy, hand formulas, both solutions, the singular family, formulas, misuse."""

from itertools import product
from math import atan2, hypot, pi, sin

import numpy as np
import pytest
import sympy
from differences import turned
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation
from sweeps import core_first

from robotics1.orientation import euler_formulas, euler_to_rotation, rotation_to_euler

TWELVE = [a + b + c for a, b, c in product("XYZ", repeat=3) if a != b != c]
SIGNS = list(product(("", "-"), repeat=3))
EVERY = [("".join(map("".join, zip(signs, name, strict=True)))) for name in TWELVE for signs in SIGNS]
angle = st.floats(-pi, pi)
three = st.tuples(angle, angle, angle)


def plain(name):
    return name.replace("-", "")


def signs_of(name):
    return np.array([-1 if axis[0] == "-" else 1 for axis in name.replace("-", " -").replace("X", "X ").replace(
        "Y", "Y ").replace("Z", "Z ").split()])  # fmt: skip


def by_scipy(name, angles, fixed):
    """Lower case is about fixed axes in SciPy, upper case about moving ones."""
    letters = plain(name).lower() if fixed else plain(name)
    return Rotation.from_euler(letters, np.asarray(angles) * signs_of(name)).as_matrix()


def same_angles(found, wanted, atol):
    return np.abs(turned(np.asarray(found) - wanted)).max() <= atol


def singular_angle(name, offset):
    """A φ2 at which the first and the last axis are parallel: multiples of π of ZYZ, odd ones of π/2 of ZYX."""
    return offset * pi + (0 if plain(name)[0] == plain(name)[2] else pi / 2)


# --- forward


def test_there_are_twelve_sequences_and_ninety_six_with_signs():
    assert (len(TWELVE), len(EVERY)) == (12, 96)
    assert signs_of("-XY-Z").tolist() == [-1, 1, -1]


@pytest.mark.parametrize("fixed", [False, True])
def test_every_sequence_is_scipys(fixed):
    rng = np.random.default_rng(1)
    for name in EVERY:
        angles = rng.uniform(-7, 7, 3)
        assert euler_to_rotation(name, angles, fixed=fixed) == pytest.approx(by_scipy(name, angles, fixed), abs=1e-15)


@given(three)
def test_zyz_matrix_is_the_textbooks(angles):
    (s1, s2, s3), (c1, c2, c3) = np.sin(angles), np.cos(angles)
    R = [
        [c1 * c2 * c3 - s1 * s3, -c1 * c2 * s3 - s1 * c3, c1 * s2],
        [s1 * c2 * c3 + c1 * s3, -s1 * c2 * s3 + c1 * c3, s1 * s2],
        [-s2 * c3, s2 * s3, c2],
    ]
    assert euler_to_rotation("ZYZ", angles) == pytest.approx(np.array(R), abs=1e-15)


@given(three)
def test_fixed_axes_are_moving_axes_in_reverse_order(angles):
    for name in ("XYZ", "ZXZ", "-YZX"):
        backward = "".join(reversed(name)) if "-" not in name else "XZ-Y"
        moving = euler_to_rotation(backward, angles[::-1])
        assert euler_to_rotation(name, angles, fixed=True) == pytest.approx(moving, abs=1e-15)


@given(three)
def test_an_angle_about_a_negative_axis_is_minus_the_angle(angles):
    a, b, c = angles
    assert euler_to_rotation("Z-YX", angles) == pytest.approx(euler_to_rotation("ZYX", [a, -b, c]), abs=1e-15)
    assert euler_to_rotation("-ZY-X", angles) == pytest.approx(euler_to_rotation("ZYX", [-a, b, -c]), abs=1e-15)


# --- inverse: both solutions


@pytest.mark.parametrize("fixed", [False, True])
def test_every_sequence_has_both_solutions_and_one_is_the_angles_it_came_from(fixed):
    rng = np.random.default_rng(2)
    for name in EVERY:
        for _ in range(4):
            angles = rng.uniform(-pi, pi, 3)
            if abs(sin(angles[1] - singular_angle(name, 0))) < 1e-2:
                continue
            found = rotation_to_euler(name, by_scipy(name, angles, fixed), fixed=fixed)
            assert (found.solutions.shape, found.singular, found.combination) == ((2, 3), False, None)
            for solution in found.solutions:
                assert by_scipy(name, solution, fixed) == pytest.approx(found.rotation, abs=1e-14)
            assert sum(same_angles(solution, angles, 1e-11) for solution in found.solutions) == 1
            assert (np.abs(found.solutions) <= pi).all()


@pytest.mark.parametrize("name", EVERY)
def test_the_first_solution_has_cos_phi2_or_sin_phi2_positive(name):
    R = by_scipy("ZYX", [0.4, -0.8, 2.3], False)
    letters = plain(name)
    positive, other = rotation_to_euler(name, R).solutions[:, 1]
    f = np.sin if letters[0] == letters[2] else np.cos
    assert f(positive) > 0 > f(other)


@given(three)
def test_zyx_angles_are_atan2_r21_r11_and_its_like(angles):
    R = by_scipy("ZYX", angles, False)
    c = hypot(R[2, 1], R[2, 2])
    if c < 1e-3:
        return
    first = [atan2(R[1, 0], R[0, 0]), atan2(-R[2, 0], c), atan2(R[2, 1], R[2, 2])]
    second = [atan2(-R[1, 0], -R[0, 0]), atan2(-R[2, 0], -c), atan2(-R[2, 1], -R[2, 2])]
    found = rotation_to_euler("ZYX", R)
    assert same_angles(found.solutions, [first, second], 1e-11)
    assert found.explain() == "the angles are determined: there are two solutions"


@pytest.mark.parametrize("distance", [1e-3, 1e-6, 1e-8, 3e-9])
@pytest.mark.parametrize("name", ["ZYZ", "ZYX", "-XY-X", "Y-Z-X"])
def test_solutions_next_to_the_singularity_give_r_to_the_last_digit(name, distance):
    R = by_scipy(name, [0.7, singular_angle(name, 1) + distance, -1.1], False)
    found = rotation_to_euler(name, R)
    assert len(found.solutions) == 2
    for solution in found.solutions:
        assert by_scipy(name, solution, False) == pytest.approx(R, abs=2e-15)


def test_angles_of_half_a_turn_are_plus_pi():
    assert rotation_to_euler("XYZ", np.diag([1, -1, -1])).solutions[0].tolist() == [pi, 0, 0]
    assert rotation_to_euler("ZYX", np.diag([-1, -1, 1])).solutions[0].tolist() == [pi, 0, 0]


# --- inverse: the singular family


@pytest.mark.parametrize("fixed", [False, True])
@pytest.mark.parametrize("offset", [-1, 0, 1])
def test_a_singular_rotation_determines_the_sum_or_the_difference_of_every_sequence(fixed, offset):
    rng = np.random.default_rng(3)
    for name in EVERY:
        angles = np.array([rng.uniform(-3, 3), singular_angle(name, offset), rng.uniform(-3, 3)])
        found = rotation_to_euler(name, by_scipy(name, angles, fixed), fixed=fixed)
        assert found.singular
        assert found.solutions.shape == (1, 3)
        assert found.solutions[0, 2] == 0
        assert same_angles(found.solutions[0, 1], angles[1], 1e-14)
        assert same_angles(np.array(found.combination) @ angles, found.combined, 1e-14)
        assert same_angles(np.array(found.combination) @ found.solutions[0], found.combined, 1e-14)
        assert -pi < found.combined <= pi
        for first in (angles[0], 0.0, 2.0):
            (member,) = found.with_first(first)
            assert by_scipy(name, member, fixed) == pytest.approx(found.rotation, abs=1e-14)
            assert same_angles(member[0], first, 1e-15)
        assert same_angles(found.with_first(angles[0])[0], angles, 1e-14)


def test_the_other_combination_is_not_determined():
    """Whichever sign is reported, the members of the family differ in the other one."""
    for b, sign in ((0, 1), (pi, -1)):
        found = rotation_to_euler("ZYZ", by_scipy("ZYZ", [0.4, b, 0.3], False))
        assert found.combination == (1, 0, sign)
        assert found.combined == pytest.approx(0.4 + sign * 0.3, abs=1e-15)
        one, two = found.with_first(0)[0], found.with_first(1)[0]
        assert not same_angles(one[0] - sign * one[2], two[0] - sign * two[2], 1)


def test_the_singular_case_is_told_in_a_sentence():
    found = rotation_to_euler("ZYX", by_scipy("ZYX", [0.5, pi / 2, 0.2], False))
    assert found.explain() == (
        "singular: φ2 = π/2, and of the others only φ1 − φ3 = 0.3000 is determined: infinitely many solutions"
    )
    found = rotation_to_euler("ZYX", by_scipy("ZYX", [pi / 4, -pi / 2, pi / 4], False))
    assert "φ1 + φ3 = π/2 is determined" in found.explain()


def test_a_regular_rotation_has_few_solutions_of_a_given_first_angle():
    found = rotation_to_euler("ZYX", by_scipy("ZYX", [0.5, 0.6, 0.7], False))
    assert found.with_first(0.5) == pytest.approx(np.array([[0.5, 0.6, 0.7]]))
    assert found.with_first(0.5 - pi) == pytest.approx(np.array([[0.5 - pi, pi - 0.6, 0.7 - pi]]))
    assert found.with_first(0.4).shape == (0, 3)


def test_of_the_identity_zyz_determines_the_sum_and_zyx_everything():
    assert rotation_to_euler("ZYZ", np.eye(3)).combination == (1, 0, 1)
    assert rotation_to_euler("ZYX", np.eye(3)).solutions[0].tolist() == [0, 0, 0]


@pytest.mark.parametrize("digits", [4, 3])
def test_a_printed_matrix_is_projected_and_its_correction_told(digits):
    exact = by_scipy("ZYZ", [0.5, 1.2, -0.4], False)
    found = rotation_to_euler("ZYZ", exact.round(digits))
    assert 1e-7 < found.correction < 10.0**-digits
    assert found.solutions[0] == pytest.approx([0.5, 1.2, -0.4], abs=2 * 10.0**-digits)
    assert found.rotation.T @ found.rotation == pytest.approx(np.eye(3), abs=1e-14)


def test_a_printed_singular_matrix_is_singular():
    R = by_scipy("ZYX", [0.5, pi / 2, 0.2], False).round(4)
    found = rotation_to_euler("ZYX", R)
    assert found.singular
    assert found.combined == pytest.approx(0.3, abs=1e-4)
    R[0, 0] += 2e-5  # less than what the matrix is corrected by
    assert rotation_to_euler("ZYX", R).singular


# --- formulas


@pytest.mark.parametrize("fixed", [False, True])
@pytest.mark.parametrize("name", core_first(EVERY, EVERY[::16], 4))
def test_formulas_of_every_sequence_are_its_numbers(name, fixed):
    f = euler_formulas(name, fixed=fixed)
    angles = np.array([0.4, 0.7, -0.9])
    at = dict(zip(f.angles, angles, strict=True))
    R = by_scipy(name, angles, fixed)
    assert np.array(f.rotation.subs(at), float) == pytest.approx(R, abs=1e-15)
    entries = dict(zip(f.R, R.ravel(), strict=True))
    solutions = np.array(f.solutions.subs(entries), float)
    assert same_angles(solutions, rotation_to_euler(name, R, fixed=fixed).solutions, 1e-14)
    for singular in f.singular:
        phi = {f.angles[0]: 0.4, f.angles[1]: singular.value, f.angles[2]: -0.9}
        R = by_scipy(name, [0.4, float(singular.value), -0.9], fixed)
        assert np.array(singular.rotation.subs(phi), float) == pytest.approx(R, abs=1e-15)
        combined = float(singular.combined.subs(dict(zip(f.R, R.ravel(), strict=True))))
        assert same_angles(combined, float(singular.combination.subs(phi)), 1e-14)
        assert -sympy.pi < singular.value <= sympy.pi
        R = sympy.Matrix(f.rotation.subs(f.angles[1], singular.value))
        assert rotation_to_euler(name, np.array(R.subs(phi), float), fixed=fixed).singular


def test_named_angles_give_the_formula():
    a, b, g = sympy.symbols("alpha beta gamma", real=True)
    R = euler_to_rotation("ZYX", ("alpha", "beta", "gamma"))
    assert R == euler_to_rotation("ZYX", (a, b, g)) == euler_to_rotation("ZYX", sympy.Matrix([a, b, g]))
    assert R[2, :] == sympy.Matrix([[-sympy.sin(b), sympy.sin(g) * sympy.cos(b), sympy.cos(b) * sympy.cos(g)]])


def test_expressions_stay_exact_among_numbers():
    R = euler_to_rotation("ZYX", (sympy.pi / 4, 0, "c"))
    assert R[0, 0] == sympy.sqrt(2) / 2
    assert R[2, 2] == sympy.cos(sympy.Symbol("c", real=True))
    assert euler_to_rotation("XYZ", (sympy.pi, 0, 0)) == sympy.diag(1, -1, -1)


def test_z_minus_y_x_formulas_are_the_hand_ones():
    f = euler_formulas("Z-YX", angles=("a", "b", "g"))
    R = f.R
    c = sympy.sqrt(R[2, 1] ** 2 + R[2, 2] ** 2)
    rows = [[sympy.atan2(s * R[1, 0], s * R[0, 0]), sympy.atan2(R[2, 0], s * c), sympy.atan2(s * R[2, 1], s * R[2, 2])]
            for s in (1, -1)]  # fmt: skip
    assert f.solutions == sympy.Matrix(rows)
    assert [s.value for s in f.singular] == [sympy.pi / 2, -sympy.pi / 2]


def test_rotations_by_moving_axes_compose_from_left_to_right():
    """Rx(π/2) takes z to −y, and Rz(π/2) takes −y to x; the other way round z stays, and goes to −y."""
    R = euler_to_rotation("ZXZ", [pi / 2, pi / 2, 0])
    assert R[:, 2] == pytest.approx([1, 0, 0], abs=1e-15)
    fixed = euler_to_rotation("ZXZ", [pi / 2, pi / 2, 0], fixed=True)
    assert fixed[:, 2] == pytest.approx([0, -1, 0], abs=1e-15)


@given(
    st.sampled_from(EVERY),
    st.booleans(),
    angle,
    angle,
    st.integers(-1, 1),
    st.floats(-16, -1),
    st.sampled_from([-1, 1]),
)
def test_every_solution_gives_the_rotation_back_near_the_singularity_of_its_sequence(
    name, fixed, first, last, offset, exponent, sign
):
    middle = singular_angle(name, offset) + sign * 10**exponent
    R = euler_to_rotation(name, [first, middle, last], fixed=fixed)
    found = rotation_to_euler(name, R, fixed=fixed)
    assert not (found.singular and exponent > -14)
    for solution in found.solutions:
        assert euler_to_rotation(name, solution, fixed=fixed) == pytest.approx(R, abs=6e-15)


@pytest.mark.parametrize("letters", ["xyz", "zyx", "zxz", "xzx"])
def test_small_letters_mean_fixed_axes_as_in_scipy(letters):
    angles = [0.3, -1.1, 2.0]
    R = euler_to_rotation(letters, angles)
    assert R == pytest.approx(Rotation.from_euler(letters, angles).as_matrix(), abs=1e-15)
    assert np.array_equal(R, euler_to_rotation(letters.upper(), angles, fixed=True))
    assert rotation_to_euler(letters, R).sequence.fixed
