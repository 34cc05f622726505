"""Whatever is handed to the functions of orientation: a finite answer or one of our errors, nothing else."""

from math import nan

import numpy as np
import pytest
import sympy
from arms import arm
from hypothesis import HealthCheck, given, settings, strategies as st
from test_misuse import JUNK, LISTS, NUMBERS, answer, forms

import robotics1 as r1

SYMBOLIC = st.sampled_from(["a", sympy.Symbol("x"), sympy.pi, sympy.I, sympy.oo, sympy.nan, sympy.true, sympy.eye(3)])
MATRICES = st.lists(st.lists(NUMBERS | SYMBOLIC, min_size=3, max_size=3), min_size=3, max_size=3)
ANY = st.one_of(JUNK, SYMBOLIC, LISTS, st.lists(NUMBERS | SYMBOLIC, min_size=3, max_size=4), MATRICES)
NAMES = st.text("XYZ-", max_size=7) | JUNK
property_of_junk = settings(max_examples=300, suppress_health_check=list(HealthCheck))


def finite(value):
    return isinstance(value, sympy.MatrixBase) or bool(np.isfinite(value).all())


@pytest.mark.parametrize("argument", ["angles", "R", "axis", "vector", "quaternion"])
def test_junk_for_a_value_is_refused_or_gives_a_finite_answer(argument):
    calls = {
        "angles": [
            lambda x: r1.orientation.euler_to_rotation("Z-YX", x),
            lambda x: r1.orientation.euler_rate_map("ZYZ", x, fixed=True),
            lambda x: r1.orientation.euler_rates("ZYZ", x, [1, 2, 3]).rates,
            lambda x: r1.orientation.euler_rates("ZYZ", [0, 0, 0], x).rates,
        ],
        "R": [
            lambda x: r1.orientation.nearest_rotation(x).rotation,
            lambda x: r1.orientation.rotation_to_euler("ZYZ", x).solutions,
            lambda x: r1.orientation.rotation_to_axis_angle(x).angle,
            lambda x: r1.orientation.rotation_to_quaternion(x).solutions,
            lambda x: r1.orientation.angular_velocity(x, np.zeros((3, 3))),
            lambda x: r1.orientation.angular_velocity(np.eye(3), x),
            r1.orientation.vee,
            lambda x: r1.orientation.align_direction([1, 0, 0], [0, 1, 0], start=x).rotation,
        ],
        "axis": [
            lambda x: r1.orientation.axis_angle_to_rotation(x, 1),
            lambda x: r1.orientation.axis_angle_to_rotation(x, "theta"),
            lambda x: r1.orientation.axis_angle_to_rotation([0, 0, 1], x),
        ],
        "vector": [
            r1.orientation.skew,
            lambda x: r1.orientation.align_direction(x, [0, 0, 1]).rotation,
            lambda x: r1.orientation.align_direction([0, 0, 1], x).at(1),
            lambda x: r1.orientation.align_direction([0, 0, 1], [1, 0, 0]).at(x),
            lambda x: r1.orientation.align_two_directions([1, 0, 0], x, [0, 1, 0], [0, 0, 1]).rotation,
            lambda x: r1.orientation.align_two_directions([1, 0, 0], [0, 1, 0], x, [0, 0, 1]).rotation,
        ],
        "quaternion": [r1.orientation.quaternion_to_rotation],
    }[argument]

    @property_of_junk
    @given(ANY)
    def refused_or_finite(junk):
        for call in calls:
            found = answer(call, junk)
            assert found is None or finite(found), (junk, found)

    refused_or_finite()


@property_of_junk
@given(NAMES, JUNK)
def test_junk_for_a_sequence_is_refused_or_serves_every_function(name, fixed):
    R = answer(r1.orientation.euler_to_rotation, name, [0.1, 0.2, 0.3], fixed=fixed)
    assert R is None or (isinstance(name, str) and isinstance(fixed, bool))
    for moving in (True, False):
        R = answer(r1.orientation.euler_to_rotation, name, [0.1, 0.2, 0.3], fixed=moving)
        if R is None:
            assert answer(r1.PoseTask, name) is None or name is None
        else:
            assert [0.1, 0.2, 0.3] == pytest.approx(
                r1.orientation.rotation_to_euler(name, R, fixed=moving).solutions[0]
            )
            assert r1.orientation.euler_formulas(name, fixed=moving).determinant != 0


@property_of_junk
@given(ANY)
def test_junk_for_a_task_or_its_target_is_refused_or_finite(junk):
    robot, q = arm("six_r"), np.full(6, 0.3)
    for task in (r1.PoseTask("ZYZ"), r1.OrientationTask("X-YZ", True), r1.PointingTask("x")):
        e = answer(task.error, robot, q, junk)
        assert e is None or (e.shape == (task.rows,) and finite(e))
    task = answer(r1.PointingTask, junk)
    assert task is None or np.linalg.norm(task.value(robot, q)) == pytest.approx(1)


@given(forms(3))
def test_every_form_of_three_numbers_gives_the_float64_answer(values):
    plain, formed = values
    assert np.array_equal(
        r1.orientation.euler_to_rotation("XYX", formed), r1.orientation.euler_to_rotation("XYX", plain)
    )
    assert np.array_equal(
        r1.orientation.euler_rates("XYX", formed, formed).rates, r1.orientation.euler_rates("XYX", plain, plain).rates
    )
    if plain.any():
        a, b = (r1.orientation.align_direction(x, [0, 0, 1]).rotation for x in (formed, plain))
        assert np.array_equal(a, b)


# --- what the message says


@pytest.mark.parametrize("name", ["", "ZY", "ZYXZ", "zYx", "zzx", "ZXX", "Z-ZX", "--ZYX", "ZYX-", "ABC", 3, None])
def test_a_sequence_is_three_axes_all_in_capitals_or_all_in_small_letters(name):
    for call in (
        lambda: r1.orientation.euler_to_rotation(name, [0, 0, 0]),
        lambda: r1.orientation.rotation_to_euler(name, np.eye(3)),
    ):
        with pytest.raises(r1.InputError, match="sequence"):
            call()


@pytest.mark.parametrize("fixed", [None, 1, "moving"])
def test_fixed_is_true_or_false(fixed):
    with pytest.raises(r1.InputError, match="fixed must be True"):
        r1.orientation.euler_to_rotation("XYZ", [0, 0, 0], fixed=fixed)


@pytest.mark.parametrize("angles", [[1, 2], 1.0, [1, nan, 2], [1, 2, 3j], None, "abc", [[1], [2, 3]], ["a", "b c", "d"],
                                    [sympy.I, 0, 0], [sympy.oo, "a", 0], [sympy.nan, 0, 0], ["a", nan, 0],
                                    ["a", None, 0], [sympy.true, 0, 0], sympy.eye(3)])  # fmt: skip
def test_angles_are_three_numbers_names_or_expressions(angles):
    with pytest.raises(r1.InputError, match="angles"):
        r1.orientation.euler_to_rotation("XYZ", angles)


@pytest.mark.parametrize("angles", [("a", "a", "b"), ("a", "b"), (1, 2, 3), ("a", "b", 3), ("a", "b", "c d")])
def test_formulas_want_three_names(angles):
    with pytest.raises(r1.InputError, match="angles"):
        r1.orientation.euler_formulas("XYZ", angles=angles)


def test_a_first_angle_is_a_number():
    with pytest.raises(r1.InputError, match="first"):
        r1.orientation.rotation_to_euler("ZYZ", np.eye(3)).with_first("all")


def test_a_target_printed_with_four_digits_is_refused_and_the_error_names_the_remedy():
    """A task cannot say that it was asked of another rotation, so the projection is the caller's."""
    printed = np.array([[0.7392, -0.6124, -0.2803], [0.5732, 0.3536, 0.7392], [-0.3536, -0.7071, 0.6124]])
    robot = r1.load_robot("prr")
    with pytest.raises(r1.InputError, match=r"nearest_rotation\(R\)\.rotation is exact"):
        r1.OrientationTask().error(robot, [0, 0, 0], printed)
    r1.OrientationTask().error(robot, [0, 0, 0], r1.orientation.nearest_rotation(printed).rotation)
    with pytest.raises(r1.InputError, match=r"right-handed$"):
        r1.OrientationTask().error(robot, [0, 0, 0], 2 * np.eye(3))
