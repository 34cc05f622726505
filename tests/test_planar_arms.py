"""Planar arms by their joints and lengths: hand formulas, in numbers and symbols, with relative and absolute angles."""

from math import cos, pi, sin

import closed_forms as cf
import numpy as np
import pytest
import sympy
from arms import arm
from hypothesis import given, strategies as st

import robotics1 as r1
from robotics1.textbook_robots import planar_arm

PLANE = r1.PositionTask("xy")


def planar_pose(letters, lengths, q, absolute=False):
    """(x, y, φ), joint by joint."""
    p, phi, lengths, before = np.zeros(2), 0.0, list(lengths), ""
    across = False
    for letter, value in zip(letters, q, strict=True):
        if letter == "P":
            across = before == "P" and not across
            direction = phi + pi / 2 * across
            p = p + value * np.array([cos(direction), sin(direction)])
        else:
            phi = value if absolute else phi + value
            p = p + lengths.pop(0) * np.array([cos(phi), sin(phi)])
        before = letter
    return np.array([*p, phi])


def wrapped(x):
    return (x + pi) % (2 * pi) - pi


@st.composite
def arms_and_configurations(draw):
    letters = draw(st.text("RP", min_size=1, max_size=5))
    lengths = draw(st.lists(st.floats(-2, 2), min_size=letters.count("R"), max_size=letters.count("R")))
    return letters, lengths, draw(st.lists(st.floats(-3, 3), min_size=len(letters), max_size=len(letters)))


@given(drawn=arms_and_configurations(), absolute=st.booleans())
def test_forward_kinematics_is_that_of_the_hand_joint_by_joint(drawn, absolute):
    letters, lengths, q = drawn
    robot = planar_arm(letters, lengths, absolute=absolute)
    assert robot.joint_names == tuple(f"q{i + 1}" for i in range(len(letters)))
    found = r1.PlanarPoseTask().value(robot, q)
    wanted = planar_pose(letters, lengths, q, absolute)
    assert found[:2] == pytest.approx(wanted[:2], abs=1e-13)
    assert wrapped(found[2] - wanted[2]) == pytest.approx(0, abs=1e-13)


def test_prr_is_the_robot_of_the_exam_with_its_names_as_symbols():
    robot = planar_arm("PRR", lengths=["l2", "l3"], parameters={"l2": 0.5, "l3": 0.4})
    ours, exams = (r1.formulas(x, r1.PlanarPoseTask()) for x in (robot, arm("prr")))
    assert ours.value == exams.value
    assert str(ours.determinant) == "l2*cos(q2)"
    q = [0.1, 0.7, -1.2]
    assert r1.PlanarPoseTask().value(robot, q) == pytest.approx(cf.prr_pose(q, 0.5, 0.4))
    longer = robot.with_parameters({"l2": 0.9})
    assert longer.parameters == {"l2": 0.9, "l3": 0.4}
    assert r1.PlanarPoseTask().value(longer, q) == pytest.approx(cf.prr_pose(q, 0.9, 0.4))


def test_one_length_may_be_a_name_and_the_other_a_number():
    robot = planar_arm("PRR", lengths=["l1", 0.5], parameters={"l1": 1.0})
    q1, q2, q3, l1 = sympy.symbols("q1 q2 q3 l1", real=True)
    x, y = r1.formulas(robot, PLANE).value
    assert sympy.simplify(x - (q1 + l1 * sympy.cos(q2) + sympy.cos(q2 + q3) / 2)) == 0
    assert sympy.simplify(y - (l1 * sympy.sin(q2) + sympy.sin(q2 + q3) / 2)) == 0


def test_with_absolute_angles_the_jacobian_of_a_3r_has_one_link_a_column():
    robot = planar_arm("RRR", ["l1", "l2", "l3"], parameters={"l1": 1, "l2": 2, "l3": 0.5}, absolute=True)
    q1, q2, q3, l1, l2, l3 = sympy.symbols("q1 q2 q3 l1 l2 l3", real=True)
    wanted = sympy.Matrix(
        [
            [-l1 * sympy.sin(q1), -l2 * sympy.sin(q2), -l3 * sympy.sin(q3)],
            [l1 * sympy.cos(q1), l2 * sympy.cos(q2), l3 * sympy.cos(q3)],
        ]
    )
    assert r1.formulas(robot, PLANE).jacobian == wanted
    assert str(r1.formulas(robot, r1.PlanarPoseTask()).value[2]) == "q3"


def test_polar_arm_and_gantry():
    q1, q2 = sympy.symbols("q1 q2", real=True)
    polar = r1.formulas(planar_arm("RP", [0]), PLANE)
    assert list(polar.value) == [q2 * sympy.cos(q1), q2 * sympy.sin(q1)]
    assert list(r1.formulas(planar_arm("PP", []), PLANE).value) == [q1, q2]


def test_a_planar_arm_is_solved_as_any_other():
    robot = planar_arm("RR", [1.0, 0.5], lower=[-3, 0], upper=[3, 3])
    solutions = r1.ik_solutions(robot, PLANE, [0.9, 0.6])
    assert len(solutions) == 1  # the other has q2 < 0
    solutions = r1.ik_solutions(planar_arm("RR", [1.0, 0.5]), PLANE, [0.9, 0.6])
    absolute = r1.ik_solutions(planar_arm("RR", [1.0, 0.5], absolute=True), PLANE, [0.9, 0.6])
    assert wrapped(np.sort(absolute.q[:, 0]) - np.sort(solutions.q[:, 0])) == pytest.approx(np.zeros(2), abs=1e-9)


@pytest.mark.parametrize(
    ("arguments", "error", "words"),
    [
        (("PRX", [1]), r1.InputError, "letters R .revolute. and P .prismatic.*'PRX'"),
        (("", []), r1.InputError, "joints must be 1 to"),
        ((3, []), r1.InputError, "joints must be 1 to"),
        (("RR", [1]), r1.InputError, "one for each R of 'RR', 2 in all"),
        (("RR", "l1"), r1.InputError, "one for each R of 'RR', 2 in all"),
        (("RR", ["q1", 1]), r1.InputError, "length 1 cannot be called 'q1'"),
        (("RR", [1, None]), r1.InputError, "length 2 must be a finite number"),
        (("RR", [1, 1e200]), r1.InputError, "lengths must be at most"),
    ],
)
def test_what_is_no_planar_arm_is_refused(arguments, error, words):
    with pytest.raises(error, match=words):
        planar_arm(*arguments)


def test_a_parameter_that_no_length_has_is_refused():
    with pytest.raises(r1.UnknownNameError, match="no parameter of the planar arm named 'l3'; there is 'l1'"):
        planar_arm("RR", ["l1", 1], parameters={"l1": 1, "l3": 2})
    with pytest.raises(r1.UnknownNameError, match="no parameter of the planar arm named 'l3'"):
        planar_arm("RR", ["l1", 1], parameters={"l1": 1}).with_parameters({"l3": 2})
    with pytest.raises(r1.InputError, match="lower ≤ upper"):
        planar_arm("R", [1], lower=[1], upper=[0])


def test_a_length_without_a_value_is_one_metre_and_stays_a_name():
    robot = planar_arm("PRR", lengths=["l1", 0.5])
    assert robot.parameters == {"l1": 1.0}
    assert r1.forward_kinematics(robot, [0.2, 0.0, 0.0]).translation == pytest.approx([1.7, 0, 0], abs=1e-15)
    assert str(r1.formulas(robot, r1.PlanarPoseTask()).determinant) == "l1*cos(q2)"
