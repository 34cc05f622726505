"""Orientation in Robotics 1 exams of 2009 to 2013: the published answers, corrected where the print is wrong.

Formulas hold identically; printed numbers to the digits that are printed.
"""

from math import pi, sqrt

import numpy as np
import pytest
import sympy
from formula_values import same
from sympy import atan2, cos, sin

from robotics1 import cubic, subspaces
from robotics1.curves import frenet_frame, helix_path
from robotics1.orientation import (
    align_two_directions,
    angular_velocity,
    axis_angle_to_rotation,
    euler_formulas,
    euler_rates,
    euler_to_rotation,
    rotation_to_axis_angle,
    rotation_to_euler,
    skew,
)

a, b, g, s = sympy.symbols("a b g s", real=True)
PRINTED = 1e-4


def numbers(matrix, **values):
    return np.array(sympy.Matrix(matrix).subs({sympy.Symbol(k, real=True): v for k, v in values.items()}), float)


# --- 13.01.09, exercise 1: moving z, −y, x


def test_2013_01_09_1a_rotation_is_rz_a_ry_minus_b_rx_g():
    R = euler_to_rotation("Z-YX", (a, b, g))
    printed = [
        [cos(a) * cos(b), -sin(a) * cos(g) - cos(a) * sin(b) * sin(g), sin(a) * sin(g) - cos(a) * sin(b) * cos(g)],
        [sin(a) * cos(b), cos(a) * cos(g) - sin(a) * sin(b) * sin(g), -cos(a) * sin(g) - sin(a) * sin(b) * cos(g)],
        [sin(b), cos(b) * sin(g), cos(b) * cos(g)],
    ]
    assert same(R, sympy.Matrix(printed))
    sample = numbers(printed, a=0.4, b=0.7, g=-0.9)
    assert euler_to_rotation("Z-YX", [0.4, 0.7, -0.9]) == pytest.approx(sample, abs=1e-15)


def test_2013_01_09_1b_two_triples_and_at_r31_of_1_the_sum_and_at_minus_1_the_difference():
    found = rotation_to_euler("Z-YX", euler_to_rotation("Z-YX", [0.4, 0.7, -0.9]))
    assert found.solutions == pytest.approx(np.array([[0.4, 0.7, -0.9], [-2.741593, 2.441593, 2.241593]]), abs=1e-6)
    f = euler_formulas("Z-YX", angles=(a, b, g))
    c = sympy.sqrt(f.R[2, 1] ** 2 + f.R[2, 2] ** 2)
    assert [f.solutions[0, 1], f.solutions[1, 1]] == [atan2(f.R[2, 0], c), atan2(f.R[2, 0], -c)]
    up, down = f.singular
    assert (up.value, up.combination, up.combined) == (sympy.pi / 2, a + g, atan2(-f.R[0, 1], f.R[1, 1]))
    assert (down.value, down.combination, down.combined) == (-sympy.pi / 2, a - g, atan2(-f.R[0, 1], f.R[1, 1]))
    assert (up.rotation[2, 0], down.rotation[2, 0]) == (1, -1)


def test_2013_01_09_1b_numbers_of_the_singular_cases():
    for beta, sign in ((pi / 2, 1), (-pi / 2, -1)):
        found = rotation_to_euler("Z-YX", euler_to_rotation("Z-YX", [0.4, beta, -0.9]))
        assert found.singular
        assert found.combination == (1, 0, sign)
        assert found.combined == pytest.approx(0.4 - sign * 0.9, abs=1e-15)


def test_2013_01_09_1c_rate_map_det_cos_b_and_what_is_lost_at_half_pi():
    f = euler_formulas("Z-YX", angles=(a, b, g))
    assert sympy.Matrix([[0, sin(a), cos(a) * cos(b)], [0, -cos(a), sin(a) * cos(b)], [1, 0, sin(b)]]) == f.rate_map
    assert f.determinant == cos(b)
    assert [singular.value for singular in f.singular] == [sympy.pi / 2, -sympy.pi / 2]
    assert f.singular[0].lost == sympy.Matrix([cos(a), sin(a), 0])
    feasible = euler_rates("Z-YX", [0.4, pi / 2, -0.9], [0, 0, 1])
    assert feasible.feasible
    assert (feasible.rates[1], feasible.rates[0] + feasible.rates[2]) == pytest.approx((0, 1))
    assert not euler_rates("Z-YX", [0.4, pi / 2, -0.9], [np.cos(0.4), np.sin(0.4), 0]).feasible


# --- 12.06.11, exercise 1: Ṙ = S(ω) R = R S(Ω)


def test_2012_06_11_1_omega_is_r_times_the_body_omega():
    R = axis_angle_to_rotation([0, 0, 1], 0.3) @ axis_angle_to_rotation([1, 0, 0], 0.5)
    Omega = [0.2, -0.4, 0.7]
    omega = angular_velocity(R, R @ skew(Omega))
    assert omega == pytest.approx([0.393981, -0.59686, 0.422538], abs=1e-6)
    assert angular_velocity(R, skew(omega) @ R, reference="body") == pytest.approx(Omega, abs=1e-15)
    assert skew(R @ Omega) == pytest.approx(R @ skew(Omega) @ R.T, abs=1e-15)


# --- 12.04.26, exercise 2: from one moving z-x-y triple to another about one axis

R_i = euler_to_rotation("ZXY", [pi / 4, -pi / 2, 0])
R_f = euler_to_rotation("ZXY", [-pi / 2, 0, pi / 2])


def test_2012_04_26_2a_relative_rotation_is_2_5936_about_its_axis():
    h = sqrt(0.5)
    assert R_i == pytest.approx(np.array([[h, 0, -h], [h, 0, h], [0, -1, 0]]), abs=1e-15)
    assert R_f == pytest.approx(np.array([[0, 1, 0], [0, 0, -1], [-1, 0, 0]]), abs=1e-15)
    assert R_i.T @ R_f == pytest.approx(np.array([[0, h, -h], [1, 0, 0], [0, -h, -h]]), abs=1e-15)
    found = rotation_to_axis_angle(R_i.T @ R_f)
    assert found.angle == pytest.approx(2.5936, abs=PRINTED)
    assert found.axis == pytest.approx([-0.6786, -0.6786, 0.2811], abs=PRINTED)
    theta = cubic(0, found.angle, 1.5)
    assert theta(0.4) == pytest.approx(found.angle * (3 * (0.4 / 1.5) ** 2 - 2 * (0.4 / 1.5) ** 3))


def test_2012_04_26_2a_the_initial_orientation_is_singular_for_zxy():
    assert rotation_to_euler("ZXY", R_i).singular
    assert rotation_to_euler("ZXY", R_i).combined == pytest.approx(pi / 4)


def printed_rotation(theta):
    c, s = np.cos(theta), np.sin(theta)
    return [
        [0.2466 * c - 0.4798 * s + 0.4605, 0.4605 * (1 - c) + 0.2811 * s, -0.1907 - 0.5164 * c - 0.4798 * s],
        [0.5164 * c + 0.4798 * s + 0.1907, 0.1907 * (1 - c) - 0.6786 * s, 0.7861 * c - 0.4798 * s - 0.0790],
        [-0.4605 * (1 - c) - 0.2811 * s, -0.5395 * c - 0.4605, 0.1907 * (1 - c) - 0.6786 * s],
    ]


def test_2012_04_26_2b_rotation_and_angular_velocity_along_the_motion():
    motion = rotation_to_axis_angle(R_i.T @ R_f)
    R = sympy.Matrix(R_i) * axis_angle_to_rotation(motion.axis, "theta")
    assert numbers(R, theta=0.7) == pytest.approx(np.array(printed_rotation(0.7)), abs=2e-4)
    omega = numbers(angular_velocity(R, R.diff(sympy.Symbol("theta", real=True))), theta=0.7).ravel()
    assert omega == pytest.approx([-0.6786, -0.2811, 0.6786], abs=PRINTED)
    assert omega == pytest.approx(R_i @ motion.axis, abs=1e-12)


def test_2012_04_26_2c_largest_angular_velocity_is_3_theta_over_2_t_half_way():
    angle = rotation_to_axis_angle(R_i.T @ R_f).angle
    theta = cubic(0, angle, 1.5)
    t = np.linspace(0, 1.5, 301)
    speed = np.array([abs(theta.velocity(at)[0]) for at in t])
    assert speed.max() == pytest.approx(2.5936, abs=PRINTED)
    assert speed.max() == pytest.approx(3 * angle / (2 * 1.5))
    assert t[speed.argmax()] == pytest.approx(0.75)


# --- 10.06.15, exercise 2: moving y, x, z


def test_2010_06_15_2_rate_map_det_minus_cos_b_and_sin_a_0_cos_a_is_lost():
    f = euler_formulas("YXZ", angles=(a, b, g))
    assert sympy.Matrix([[0, cos(a), sin(a) * cos(b)], [1, 0, -sin(b)], [0, -sin(a), cos(a) * cos(b)]]) == f.rate_map
    assert f.determinant == -cos(b)
    assert {singular.value for singular in f.singular} == {sympy.pi / 2, -sympy.pi / 2}
    for singular in f.singular:
        assert singular.lost in (sympy.Matrix([sin(a), 0, cos(a)]), -sympy.Matrix([sin(a), 0, cos(a)]))
        spaces = subspaces(numbers(f.rate_map.subs(b, singular.value), a=0.3, g=0.1))
        assert not spaces.contains([np.sin(0.3), 0, np.cos(0.3)])


# --- 10.01.12, exercise 1b: a frame along a helix, x to its axis, z parallel to it


def test_2010_01_12_1b_frame_along_the_helix_turns_with_s_dot_about_z():
    R = sympy.Matrix([[-cos(s), sin(s), 0], [-sin(s), -cos(s), 0], [0, 0, 1]])
    frame = align_two_directions([0, 0, 1], [0, 0, 1], [1, 0, 0], [-np.cos(0.8), -np.sin(0.8), 0])
    assert frame.exact
    assert frame.rotation == pytest.approx(numbers(R, s=0.8), abs=1e-15)
    omega = angular_velocity(R, R.diff(s))  # for ṡ = 1
    assert omega == sympy.Matrix([0, 0, 1])
    assert 1 / sqrt(0.3**2 + 0.1**2) * float(omega.norm()) == pytest.approx(3.1623, abs=PRINTED)  # ṡ = V/√(R² + h²)


def test_2010_01_12_1b_frenet_frame_of_the_helix_and_curvature_3():
    helix = helix_path([0, 0, 0], [0.3, 0, 0], 2 * pi * 0.1, 1)
    length = sqrt(0.3**2 + 0.1**2)  # of arc for one radian
    found = frenet_frame(helix, 0.8 * length)
    assert found.curvature == pytest.approx(3.0)
    c, s, r, h = np.cos(0.8), np.sin(0.8), 0.3 / length, 0.1 / length
    assert found.rotation == pytest.approx(np.array([[-r * s, -c, h * s], [r * c, -s, -h * c], [h, 0, r]]), abs=1e-12)


# --- 09.11.10, test, exercise 1: fixed y, x, z


def test_2009_11_10_1a_fixed_axes_rotation_is_rz_g_rx_b_ry_a():
    R = euler_to_rotation("YXZ", (a, b, g), fixed=True)
    printed = [
        [cos(a) * cos(g) - sin(a) * sin(b) * sin(g), -cos(b) * sin(g), sin(a) * cos(g) + cos(a) * sin(b) * sin(g)],
        [cos(a) * sin(g) + sin(a) * sin(b) * cos(g), cos(b) * cos(g), sin(a) * sin(g) - cos(a) * sin(b) * cos(g)],
        [-sin(a) * cos(b), sin(b), cos(a) * cos(b)],
    ]
    assert same(R, sympy.Matrix(printed))


def test_2009_11_10_1b_both_triples_of_a_matrix_of_four_digits():
    R = [[0.7392, -0.6124, -0.2803], [0.5732, 0.3536, 0.7392], [-0.3536, -0.7071, 0.6124]]
    found = rotation_to_euler("YXZ", R, fixed=True)
    assert found.solutions == pytest.approx(
        np.array([[0.5236, -0.7854, 1.0472], [-2.618, -2.3562, -2.0944]]), abs=PRINTED
    )
    assert 1e-6 < found.correction < PRINTED


def test_2009_11_10_1c_indeterminate_at_r32_of_1_the_sum_and_of_minus_1_the_difference():
    f = euler_formulas("YXZ", angles=(a, b, g), fixed=True)
    up, down = f.singular
    assert (up.value, up.combination, up.combined) == (sympy.pi / 2, a + g, atan2(f.R[1, 0], f.R[0, 0]))
    assert (down.value, down.combination, down.combined) == (-sympy.pi / 2, a - g, atan2(-f.R[1, 0], f.R[0, 0]))
    assert (up.rotation[2, 1], down.rotation[2, 1]) == (1, -1)
    for singular in f.singular:
        assert singular.rotation[2, 0] == singular.rotation[2, 2] == 0
    assert same(up.rotation, sympy.Matrix([[cos(a + g), 0, sin(a + g)], [sin(a + g), 0, -cos(a + g)], [0, 1, 0]]))
