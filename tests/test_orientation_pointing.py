"""Rotations that align one direction or two: the least turn, the family, opposite directions, misuse."""

from math import nan, pi

import numpy as np
import pytest
import sympy
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from robotics1 import InputError
from robotics1.orientation import align_direction, align_two_directions, axis_angle_to_rotation, rotation_to_axis_angle

entry = st.floats(-1, 1)
vectors = st.tuples(entry, entry, entry).map(np.array).filter(lambda v: np.linalg.norm(v) > 1e-3)
psi = st.floats(-pi, pi)


def unit(v):
    return np.asarray(v) / np.linalg.norm(v)


def is_rotation(R):
    return np.abs(R.T @ R - np.eye(3)).max() < 1e-14 and np.linalg.det(R) > 0


@given(vectors, vectors, psi)
def test_every_member_of_the_family_takes_a_to_d(a, d, turn):
    found = align_direction(a, d)
    for R in (found.rotation, found.at(turn), found.at(0)):
        assert is_rotation(R)
        assert R @ unit(a) == pytest.approx(unit(d), abs=1e-14)
    assert found.at(turn) == pytest.approx(axis_angle_to_rotation(d, turn) @ found.rotation, abs=1e-14)


@given(vectors, vectors, psi)
def test_every_rotation_that_takes_a_to_d_is_a_member_of_the_family(a, d, turn):
    found = align_direction(a, d)
    R = align_two_directions(a, d, np.cross(a, [0.3, 0.5, -0.8]) + 0.1 * a + 1e-2, axis_angle_to_rotation(
        d, turn) @ np.cross(d, [0.1, 0.9, 0.4]) + 1e-2).rotation  # fmt: skip
    further = R @ found.rotation.T  # about d, by some ψ
    theta = np.arctan2(unit(d) @ [further[2, 1] - further[1, 2], further[0, 2] - further[2, 0],
                                  further[1, 0] - further[0, 1]], np.trace(further) - 1)  # fmt: skip
    assert found.at(theta) == pytest.approx(R, abs=1e-10)


@given(vectors, vectors, psi)
def test_the_least_turn_is_about_a_cross_d_by_the_angle_between_them(a, d, turn):
    a, d = unit(a), unit(d)
    if np.linalg.norm(np.cross(a, d)) < 1e-6:
        return
    found = align_direction(a, d)
    assert found.axis == pytest.approx(unit(np.cross(a, d)), abs=1e-9)
    assert found.angle == pytest.approx(np.arctan2(np.linalg.norm(np.cross(a, d)), a @ d), abs=1e-14)
    assert axis_angle_to_rotation(found.axis, found.angle) == pytest.approx(found.rotation, abs=1e-9)
    assert found.unique
    other = rotation_to_axis_angle(found.at(turn))
    assert other.angle >= found.angle - 1e-9


@given(vectors, vectors, vectors, psi)
def test_from_a_start_the_nearest_member_is_told(a, d, axis, turn):
    start = axis_angle_to_rotation(axis, turn)
    found = align_direction(a, d, start=start)
    assert found.rotation @ unit(a) == pytest.approx(unit(d), abs=1e-14)
    moved = rotation_to_axis_angle(found.rotation @ start.T)
    assert moved.angle == pytest.approx(found.angle, abs=2e-9)
    for step in (0.1, -0.1):
        assert rotation_to_axis_angle(found.at(step) @ start.T).angle > found.angle - 1e-9


def test_aligned_directions_need_no_turn():
    found = align_direction([0, 0, 2], [0, 0, 5])
    assert (found.angle, found.axis, found.unique) == (0, None, True)
    assert np.array_equal(found.rotation, np.eye(3))
    assert found.explain() == "every R(d, ψ) R₀ aligns the axis; R₀ turns least, by 0"


@pytest.mark.parametrize("a", [[1, 0, 0], [0, -1, 0], [0, 0, 3], [1, 2, -3], [-1e-3, 1, 1]])
def test_opposite_directions_are_half_a_turn_about_any_normal(a):
    found = align_direction(a, -np.array(a))
    assert (found.angle, found.unique) == (pi, False)
    assert found.axis @ unit(a) == pytest.approx(0, abs=1e-15)
    assert found.rotation == pytest.approx(axis_angle_to_rotation(found.axis, pi), abs=1e-15)
    assert found.rotation @ unit(a) == pytest.approx(-unit(a), abs=1e-15)
    assert rotation_to_axis_angle(found.at(0.7)).angle == pytest.approx(pi)
    assert "any normal" in found.explain()


@pytest.mark.parametrize("off", [1e-4, 1e-7, 3e-9])
def test_nearly_opposite_directions_are_aligned_to_the_last_digit(off):
    a, d = unit([1, 2, 3]), unit(-np.array([1, 2, 3]) + off * np.array([3, 0, -1]))
    found = align_direction(a, d)
    assert is_rotation(found.rotation)
    assert found.rotation @ a == pytest.approx(d, abs=1e-15)
    assert found.unique


@pytest.mark.parametrize("off", [1e-4, 3e-9, 3e-10])
def test_nearly_equal_directions_are_aligned_to_the_last_digit(off):
    a, d = unit([1, 2, 3]), unit(np.array([1, 2, 3]) + off * np.array([3, 0, -1]))
    assert align_direction(a, d).rotation @ a == pytest.approx(d, abs=4e-16)


def test_the_family_has_a_formula():
    R = align_direction([0, 0, 1], [0, 0, 1]).at("psi")
    c, s = sympy.cos(sympy.Symbol("psi", real=True)), sympy.sin(sympy.Symbol("psi", real=True))
    assert sympy.Matrix([[c, -s, 0], [s, c, 0], [0, 0, 1]]) == sympy.nsimplify(R)


# --- two directions


@given(vectors, vectors, vectors, psi)
def test_two_directions_of_a_rotated_body_give_its_rotation(a1, a2, axis, turn):
    if np.linalg.norm(np.cross(unit(a1), unit(a2))) < 1e-2:
        return
    R = axis_angle_to_rotation(axis, turn)
    found = align_two_directions(a1, R @ a1, a2, 3 * R @ a2)
    assert found.rotation == pytest.approx(R, abs=1e-12)
    assert found.exact
    assert found.explain() == "one rotation aligns both axes"


def test_directions_at_another_angle_are_aligned_as_nearly_as_can_be():
    found = align_two_directions([1, 0, 0], [0, 0, 1], [0, 1, 0], [0, 1, 1])
    assert found.rotation @ [1, 0, 0] == pytest.approx([0, 0, 1], abs=1e-15)
    assert found.rotation @ [0, 1, 0] == pytest.approx([0, 1, 0], abs=1e-15)
    assert found.misalignment == pytest.approx(pi / 4)
    assert not found.exact
    assert "second is π/4 from its direction" in found.explain()


@given(vectors, vectors, vectors, vectors)
def test_with_the_first_exact_it_is_scipys_best_fit(a1, a2, d1, d2):
    if min(np.linalg.norm(np.cross(unit(u), unit(v))) for u, v in ((a1, a2), (d1, d2))) < 1e-2:
        return
    found = align_two_directions(a1, d1, a2, d2)
    best, _ = Rotation.align_vectors([unit(d1), unit(d2)], [unit(a1), unit(a2)], weights=[np.inf, 1])
    assert found.rotation == pytest.approx(best.as_matrix(), abs=1e-10)


def test_a_frame_with_x_along_one_direction_and_z_along_another():
    R = align_two_directions([1, 0, 0], [-1, -1, 0], [0, 0, 1], [0, 0, 1]).rotation
    h = np.sqrt(0.5)
    assert R == pytest.approx(np.array([[-h, h, 0], [-h, -h, 0], [0, 0, 1]]), abs=1e-15)


@pytest.mark.parametrize(
    "arguments",
    [
        ([0, 0, 0], [0, 0, 1]),
        ([0, 0, 1], [0, 0, 0]),
        ([0, 0], [0, 0, 1]),
        ([0, 0, nan], [0, 0, 1]),
        (None, [0, 0, 1]),
        ([0, 0, 1], [0, 0, 1], np.eye(3) * 2),
        ([0, 0, 1], [0, 0, 1], "here"),
    ],
)
def test_directions_and_a_start_are_needed(arguments):
    a, d, *start = arguments
    with pytest.raises(InputError):
        align_direction(a, d, start=start[0] if start else None)


def test_a_further_turn_is_a_number_or_an_expression():
    with pytest.raises(InputError, match="psi"):
        align_direction([0, 0, 1], [1, 0, 0]).at([1, 2])


@pytest.mark.parametrize(("a2", "d2"), [([2, 0, 0], [0, 1, 0]), ([0, 1, 0], [0, 0, -3]), ([-1, 0, 0], [0, 0, 1])])
def test_parallel_axes_or_directions_leave_the_turn_about_them_open(a2, d2):
    with pytest.raises(InputError, match="must not be parallel"):
        align_two_directions([1, 0, 0], [0, 0, 1], a2, d2)


@given(vectors, vectors, st.floats(-16, -1), st.sampled_from([0, pi / 2, pi]), st.sampled_from([-1, 1]))
def test_the_least_turn_is_the_rotation_itself_near_parallel_and_opposite_directions(a, b, exponent, special, sign):
    across = np.cross(a, b + 0.1)
    if np.linalg.norm(across) < 1e-3:
        return
    d = axis_angle_to_rotation(across, special + sign * 10**exponent) @ unit(a)
    found = align_direction(a, d)
    assert found.rotation @ unit(a) == pytest.approx(d, abs=5e-15)
    turn = np.eye(3) if found.axis is None else axis_angle_to_rotation(found.axis, found.angle)
    assert turn == pytest.approx(found.rotation, abs=1e-14)
