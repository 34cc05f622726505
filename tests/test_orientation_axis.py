"""Axis and angle, unit quaternions, and the nearest rotation: against SciPy, hand formulas, special cases, misuse."""

from math import acos, cos, inf, nan, pi, sin, sqrt

import closed_forms as cf
import numpy as np
import pytest
import sympy
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

import robotics1 as r1
from robotics1 import InputError
from robotics1.orientation import (
    axis_angle_to_rotation,
    nearest_rotation,
    quaternion_to_rotation,
    rotation_to_axis_angle,
    rotation_to_quaternion,
)

entry = st.floats(-1, 1)
vectors = st.tuples(entry, entry, entry).map(np.array).filter(lambda v: np.linalg.norm(v) > 1e-3)
angles = st.floats(-7, 7)
MIRROR = np.diag([1.0, 1.0, -1.0])


def unit(v):
    return np.asarray(v) / np.linalg.norm(v)


# --- axis and angle


@given(vectors, angles)
def test_rodrigues_is_r_rt_plus_cos_1_minus_r_rt_plus_sin_skew(axis, angle):
    assert axis_angle_to_rotation(axis, angle) == pytest.approx(cf.rotation(unit(axis), angle), abs=1e-15)
    scipys = Rotation.from_rotvec(angle * unit(axis)).as_matrix()
    assert axis_angle_to_rotation(7 * axis, angle) == pytest.approx(scipys, abs=2e-15)


@given(vectors, st.floats(1e-3, pi - 1e-3))
def test_axis_and_angle_are_read_from_the_trace_and_the_skew_part(axis, angle):
    R = axis_angle_to_rotation(axis, angle)
    found = rotation_to_axis_angle(R)
    assert found.angle == pytest.approx(acos((np.trace(R) - 1) / 2), abs=1e-9)
    skew = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    assert found.axis == pytest.approx(skew / (2 * sin(angle)), abs=1e-11)
    (r, theta), (other, minus_theta) = found.solutions
    assert (theta, minus_theta) == (found.angle, -found.angle)
    assert np.array_equal(other, -r)
    for solution in found.solutions:
        assert axis_angle_to_rotation(*solution) == pytest.approx(R, abs=1e-14)
    assert found.explain().startswith("two solutions: (r, θ) and (−r, −θ)")


@pytest.mark.parametrize("angle", [1e-8, 1e-5, pi - 1e-5, pi - 1e-8, -1e-7, pi + 1e-7])
def test_small_angles_and_nearly_half_turns_are_exact(angle):
    axis = unit([1, -2, 2])
    R = axis_angle_to_rotation(axis, angle)
    (r, theta), _ = rotation_to_axis_angle(R).solutions
    assert axis_angle_to_rotation(r, theta) == pytest.approx(R, abs=1e-15)
    wanted = angle if 0 < angle < pi else -angle if angle < 0 else 2 * pi - angle
    assert theta == pytest.approx(wanted, abs=1e-14)


def test_of_no_rotation_the_axis_is_not_determined():
    found = rotation_to_axis_angle(np.eye(3))
    assert (found.angle, found.axis, found.solutions) == (0, None, ())
    assert "the axis is not determined" in found.explain()
    assert rotation_to_axis_angle(axis_angle_to_rotation([1, 1, 0], 1e-16)).axis is None
    assert rotation_to_axis_angle(axis_angle_to_rotation([1, 1, 0], 2 * pi)).axis is None


@pytest.mark.parametrize("axis", [[1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 3, -4], [1, -2, 2], [-1, 1e-4, 0]])
def test_half_a_turn_has_both_axes(axis):
    R = 2 * np.outer(unit(axis), unit(axis)) - np.eye(3)
    found = rotation_to_axis_angle(R)
    (r, theta), (other, again) = found.solutions
    assert theta == again == pi
    assert np.array_equal(other, -r)
    assert min(np.abs(r - unit(axis)).max(), np.abs(r + unit(axis)).max()) < 1e-14
    assert r[np.abs(r) > 1e-9][0] > 0
    assert found.explain().startswith("half a turn")


def test_a_printed_half_turn_is_half_a_turn():
    R = (2 * np.outer(unit([1, -2, 3]), unit([1, -2, 3])) - np.eye(3)).round(4)
    found = rotation_to_axis_angle(R)
    assert found.angle == pi
    assert 1e-6 < found.correction < 1e-4
    assert found.axis == pytest.approx(unit([1, -2, 3]), abs=1e-4)


@pytest.mark.parametrize("axis", [[1, -2, 2], [0, 0, 1], [0, -1, 0], [1, 1e-5, -1e-9], [-1, 1e-4, 0]])
@pytest.mark.parametrize("missing", [10.0**-k for k in range(3, 16)])
def test_nearly_half_a_turn_keeps_its_angle_and_one_axis(axis, missing):
    """θ = π − 1e-9 was reported as π, so that the rotation was off by 1e-9."""
    R = axis_angle_to_rotation(axis, pi - missing)
    found, quaternions = rotation_to_axis_angle(R), rotation_to_quaternion(R).solutions
    for r, theta in found.solutions:
        assert axis_angle_to_rotation(r, theta) == pytest.approx(R, abs=4e-15)
    for Q in quaternions:
        assert quaternion_to_rotation(Q) == pytest.approx(R, abs=4e-15)
    if missing > 1e-14:  # else it may be half a turn, to rounding
        assert found.angle == pytest.approx(pi - missing, abs=2e-15)
        assert [theta < 0 for _, theta in found.solutions] == [False, True]
        assert quaternions[0][0] > 0


@given(vectors, st.sampled_from([0, pi / 2, pi, -pi / 2, -pi]), st.floats(-16, -1), st.sampled_from([-1, 1]))
def test_axis_and_quaternion_give_the_rotation_back_near_every_special_angle(axis, special, exponent, sign):
    R = axis_angle_to_rotation(axis, special + sign * 10**exponent)
    for solution in rotation_to_axis_angle(R).solutions or (([0, 0, 1], 0.0),):
        assert axis_angle_to_rotation(*solution) == pytest.approx(R, abs=5e-15)
    for Q in rotation_to_quaternion(R).solutions:
        assert quaternion_to_rotation(Q) == pytest.approx(R, abs=5e-15)


def test_half_a_turn_made_of_other_turns_is_half_a_turn_to_rounding():
    rng = np.random.default_rng(4)
    for _ in range(50):
        A = axis_angle_to_rotation(rng.normal(size=3), rng.uniform(-3, 3))
        found = rotation_to_axis_angle(A @ axis_angle_to_rotation([0, 0, 1], pi) @ A.T)
        assert [angle for _, angle in found.solutions] == [pi, pi]


def test_rotation_by_a_symbol_is_a_matrix():
    theta = sympy.Symbol("theta", real=True)
    c, s = sympy.cos(theta), sympy.sin(theta)
    assert axis_angle_to_rotation([0, 0, 2], "theta") == sympy.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    R = axis_angle_to_rotation([1, 1, 0], theta)
    assert R[2, 2] == c
    assert sympy.simplify(R[0, 2] - s / sympy.sqrt(2)) == 0
    at = np.array(axis_angle_to_rotation(np.array([0.3, -0.2, 0.5]), theta).subs(theta, 0.7), float)
    assert at == pytest.approx(axis_angle_to_rotation([0.3, -0.2, 0.5], 0.7), abs=1e-15)
    x, y, z = r = sympy.symbols("x y z", real=True)
    general = axis_angle_to_rotation(r, theta).subs({x: 3, y: -4, z: 12, theta: sympy.pi / 2})
    assert general[2, 2] == sympy.Rational(144, 169)


@pytest.mark.parametrize("axis", [[0, 0, 0], [1, 2], None, [1, nan, 0], ["x y", 0, 1], [sympy.I, 0, 1]])
def test_an_axis_has_a_direction(axis):
    with pytest.raises(InputError, match="axis"):
        axis_angle_to_rotation(axis, 1.0)
    with pytest.raises(InputError, match="axis"):
        axis_angle_to_rotation(axis, "theta")


@pytest.mark.parametrize("angle", [nan, inf, None, [1, 2], "a b", 1j, sympy.nan])
def test_an_angle_is_a_number_or_an_expression(angle):
    with pytest.raises(InputError, match="angle"):
        axis_angle_to_rotation([0, 0, 1], angle)


# --- unit quaternions, scalar first


@given(vectors, angles)
def test_quaternion_is_cos_half_theta_and_sin_half_theta_r_of_both_signs(axis, angle):
    r = unit(axis)
    Q = np.array([cos(angle / 2), *(sin(angle / 2) * r)])
    R = axis_angle_to_rotation(axis, angle)
    assert quaternion_to_rotation(Q) == pytest.approx(R, abs=2e-15)
    assert quaternion_to_rotation(-Q) == pytest.approx(R, abs=2e-15)
    first, second = rotation_to_quaternion(R).solutions
    assert np.array_equal(first, -second)
    assert first[0] >= 0
    assert min(np.abs(first - Q).max(), np.abs(second - Q).max()) < 3e-9  # an η or |ε| below 1e-9 counts as zero


@given(vectors, angles, vectors)
def test_quaternion_rates_are_half_of_omega_times_Q_in_hamiltons_product(axis, angle, omega):
    """Q̇ = ½ (0, ω) ∘ Q in world axes, and ½ Q ∘ (0, ω) in the body's."""
    Q = np.array([cos(angle / 2), *(sin(angle / 2) * unit(axis))])

    def product(p, q):
        return np.array([p[0] * q[0] - p[1:] @ q[1:], *(p[0] * q[1:] + q[0] * p[1:] + np.cross(p[1:], q[1:]))])

    spatial = np.array([0, *omega])
    for reference, wanted in (("world", product(spatial, Q) / 2), ("body", product(Q, spatial) / 2)):
        E = r1.orientation.quaternion_rate_map(Q, reference=reference)
        assert E @ omega == pytest.approx(wanted, rel=1e-12, abs=1e-12 * np.abs(omega).max())
        assert 4 * E.T @ E == pytest.approx(np.eye(3), abs=1e-14)
        assert Q @ E == pytest.approx(np.zeros(3), abs=1e-15)


def test_quaternion_rates_make_the_rotation_turn_with_omega():
    """Ṙ = S(ω) R, by central differences along Q̇."""
    Q, omega, h = np.array([0.5, 0.1, -0.7, 0.5]), np.array([0.3, -1.2, 0.8]), 1e-5
    rate = r1.orientation.quaternion_rate_map(Q) @ omega
    ahead, behind = (quaternion_to_rotation((Q + x * rate) / np.linalg.norm(Q + x * rate)) for x in (h, -h))
    assert (ahead - behind) / (2 * h) == pytest.approx(r1.orientation.skew(omega) @ quaternion_to_rotation(Q), abs=1e-9)


def test_quaternion_rates_in_formulas():
    E = r1.orientation.quaternion_rate_map(["eta", "x", "y", "z"], reference="body")
    eta, x, y, z = (sympy.Symbol(name, real=True) for name in ("eta", "x", "y", "z"))
    assert E == sympy.Matrix([[-x, -y, -z], [eta, -z, y], [z, eta, -x], [-y, x, eta]]) / 2


@pytest.mark.parametrize("Q", [[1, 0, 0], [1, 1, 0, 0], "ab", [0, 0, 0, 0], [nan, 0, 0, 1]])
def test_rates_of_what_is_no_unit_quaternion_are_input_errors(Q):
    with pytest.raises(InputError, match="quaternion"):
        r1.orientation.quaternion_rate_map(Q)


def test_quaternions_of_the_identity_and_of_half_turns():
    assert rotation_to_quaternion(np.eye(3)).solutions.tolist() == [[1, 0, 0, 0], [-1, 0, 0, 0]]
    for k in range(3):
        R = 2 * np.outer(np.eye(3)[k], np.eye(3)[k]) - np.eye(3)
        assert rotation_to_quaternion(R).solutions[0].tolist() == [0, *np.eye(3)[k]]
    assert rotation_to_quaternion(axis_angle_to_rotation([0, -1, 1], pi)).solutions[0] == pytest.approx(
        [0, 0, sqrt(0.5), -sqrt(0.5)], abs=1e-15
    )


def test_quaternion_of_a_printed_matrix_tells_its_correction():
    R = axis_angle_to_rotation([1, 2, 3], 0.8)
    found = rotation_to_quaternion(R.round(4))
    assert 1e-6 < found.correction < 1e-4
    assert found.solutions[0] == pytest.approx([cos(0.4), *(sin(0.4) * unit([1, 2, 3]))], abs=1e-4)
    assert rotation_to_quaternion(R).correction < 1e-15


def test_rotation_of_a_symbolic_quaternion_is_the_textbooks():
    n, x, y, z = Q = sympy.symbols("n x y z", real=True)
    R = quaternion_to_rotation(Q)
    unit_length = {n**2: 1 - x**2 - y**2 - z**2}
    hand = [
        [2 * (n**2 + x**2) - 1, 2 * (x * y - n * z), 2 * (x * z + n * y)],
        [2 * (x * y + n * z), 2 * (n**2 + y**2) - 1, 2 * (y * z - n * x)],
        [2 * (x * z - n * y), 2 * (y * z + n * x), 2 * (n**2 + z**2) - 1],
    ]
    assert sympy.expand((R - sympy.Matrix(hand)).expand().subs(unit_length)) == sympy.zeros(3, 3)


def test_a_printed_quaternion_is_normalised():
    Q = np.array([0.5, 0.1, 0.7, 0.5])
    R = quaternion_to_rotation(Q / np.linalg.norm(Q) + 4e-4)
    assert R.T @ R == pytest.approx(np.eye(3), abs=1e-15)


@pytest.mark.parametrize(
    "Q", [[2, 0, 0, 0], [0, 0, 0, 0], [1, 0, 0, 0.1], [1, 0, 0], [nan, 0, 0, 1], [1e300] * 4, None]
)
def test_a_quaternion_has_four_entries_and_length_one(Q):
    with pytest.raises(InputError, match="quaternion"):
        quaternion_to_rotation(Q)


# --- the nearest rotation


@given(vectors, angles, st.integers(0, 2**31))
def test_nearest_rotation_is_no_farther_than_any_other(axis, angle, seed):
    R = axis_angle_to_rotation(axis, angle)
    rng = np.random.default_rng(seed)
    M = R + rng.uniform(-3e-4, 3e-4, (3, 3))
    near = nearest_rotation(M)
    assert near.rotation.T @ near.rotation == pytest.approx(np.eye(3), abs=1e-14)
    assert np.linalg.det(near.rotation) == pytest.approx(1, abs=1e-14)
    assert near.correction == pytest.approx(np.abs(near.rotation - M).max(), abs=0)
    distance = np.linalg.norm(near.rotation - M)
    assert distance <= np.linalg.norm(R - M)
    for step in 1e-4 * rng.standard_normal((5, 3)):
        assert distance <= np.linalg.norm(Rotation.from_rotvec(step).as_matrix() @ near.rotation - M)


def test_an_exact_rotation_is_not_corrected_and_four_digits_by_less_than_1e_4():
    R = axis_angle_to_rotation([3, 1, 2], 1.1)
    assert nearest_rotation(R).correction < 1e-15
    assert 1e-5 < nearest_rotation(R.round(4)).correction < 1e-4
    assert 1e-4 < nearest_rotation(R.round(3)).correction < 1e-3


def test_the_tolerance_is_the_largest_correction():
    R = axis_angle_to_rotation([3, 1, 2], 1.1).round(2)
    with pytest.raises(InputError, match="more than the tolerance 1e-03"):
        nearest_rotation(R)
    correction = nearest_rotation(R, tolerance=0.01).correction
    assert nearest_rotation(R, tolerance=correction).correction == correction
    with pytest.raises(InputError):
        nearest_rotation(R, tolerance=0.99 * correction)
    assert rotation_to_axis_angle(R, tolerance=0.01).correction == correction
    assert rotation_to_quaternion(R, tolerance=0.01).correction == correction


@pytest.mark.parametrize(
    ("M", "message"),
    [
        (MIRROR, "a reflection: its determinant is -1, and must be"),
        (-axis_angle_to_rotation([1, 2, 3], 0.7), "a reflection"),
        (2 * np.eye(3), r"their lengths are \(2, 2, 2\)"),
        (np.array([[1, 0.1, 0], [0, 1, 0], [0, 0, 1]]), r"x·y, y·z, z·x are \(0.1000, 0, 0\)"),
        (np.zeros((3, 3)), r"lengths are \(0, 0, 0\)"),
        (np.diag([1.0, 0.5, -1.0]), "no rotation: its determinant is -0.5"),
        (1e300 * np.eye(3), "between −1 and 1"),
        (np.eye(4), r"shape \(3, 3\)"),
        (np.full((3, 3), nan), "finite"),
        (None, "must have shape"),
        ("abc", "real numbers"),
    ],
)
def test_what_is_no_rotation_is_refused_with_the_reason(M, message):
    with pytest.raises(InputError, match=message):
        nearest_rotation(M)
    with pytest.raises(InputError, match=message):
        rotation_to_axis_angle(M)


@pytest.mark.parametrize("tolerance", [-1e-3, nan, None, "small"])
def test_a_tolerance_is_a_non_negative_number(tolerance):
    for function in (nearest_rotation, rotation_to_axis_angle, rotation_to_quaternion):
        with pytest.raises(InputError, match="tolerance"):
            function(np.eye(3), tolerance=tolerance)


def test_the_angle_is_atan2_of_the_skew_part_and_the_trace():
    for angle in (0.3, 1.9, 3.1):
        R = axis_angle_to_rotation([1, -2, 2], angle)
        formula = np.arctan2(np.linalg.norm(R - R.T) / np.sqrt(8), (np.trace(R) - 1) / 2)
        assert rotation_to_axis_angle(R).angle == pytest.approx(formula, abs=1e-14)
