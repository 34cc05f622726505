"""Formulas at one configuration: exact values, ranks, bases and pseudoinverses."""

from math import pi

import numpy as np
import pytest
import sympy
from arms import arm

import robotics1 as r1

q1, q2, q3, l1, l2, l3 = sympy.symbols("q1 q2 q3 l1 l2 l3", real=True)
c1, s1, c3, s3 = sympy.cos(q1), sympy.sin(q1), sympy.cos(q3), sympy.sin(q3)


def planar_2r():
    return r1.formulas(arm("planar_2r"), r1.PositionTask("xy"))


def prr():
    return r1.formulas(arm("prr"), r1.PlanarPoseTask())


def same(a, b):
    return sympy.simplify(sympy.Matrix(a) - sympy.Matrix(b)) == sympy.zeros(*sympy.Matrix(b).shape)


def test_the_stretched_2r_has_rank_one_and_its_bases_in_symbols():
    at = planar_2r().at(q2=0)
    assert same(at.jacobian, [[-(l1 + l2) * s1, -l2 * s1], [(l1 + l2) * c1, l2 * c1]])
    assert same(at.value, [(l1 + l2) * c1, (l1 + l2) * s1])
    assert at.rank == 1
    assert at.determinant == 0
    assert same(at.null, [-l2 / (l1 + l2), 1])
    assert same(at.left_null, [c1 / s1, 1])
    assert same(at.range, [-(l1 + l2) * s1, (l1 + l2) * c1])
    assert same(at.row, [-(l1 + l2) * s1, -l2 * s1])
    assert "rank 1 of 2" in at.explain()


def test_the_pseudoinverse_of_the_stretched_2r_is_that_of_a_matrix_of_rank_one():
    at = planar_2r().at(q1=0, q2=0)
    a, b = l1 + l2, l2  # J = (0, 1)ᵀ (a, b), so that J⁺ = (a, b)ᵀ (0, 1)/(a² + b²)
    assert same(at.pseudoinverse, sympy.Matrix([a, b]) * sympy.Matrix([[0, 1]]) / (a**2 + b**2))


def test_at_a_regular_configuration_the_pseudoinverse_is_the_inverse():
    at = planar_2r().at(q1=0, q2=pi / 2)
    assert same(at.jacobian, [[-l2, -l2], [l1, 0]])
    assert same(at.pseudoinverse, [[0, 1 / l1], [-1 / l2, -1 / l1]])
    assert at.determinant == l1 * l2
    assert at.null.shape == at.left_null.shape == (2, 0)


def test_the_prr_at_its_singularity_is_the_exams():
    at = prr().at(q2=sympy.pi / 2)
    assert (at.rank, at.determinant) == (2, 0)
    assert same(at.null, [-l2, -1, 1])
    assert same(at.left_null, [0, 1 / (l3 * s3), 1])


def test_a_redundant_jacobian_has_a_right_inverse():
    at = r1.formulas(arm("planar_3r"), r1.PositionTask("xy")).at([0, sympy.pi / 2, 0], l1=1, l2=1, l3=1)
    J = sympy.Matrix([[-2, -2, -1], [1, 0, 0]])
    assert at.jacobian == J
    assert at.pseudoinverse == J.T * (J * J.T).inv()
    assert at.null == sympy.Matrix([0, -sympy.Rational(1, 2), 1])


@pytest.mark.parametrize("q", [[0.3, -1.2, 0.5, 0.4, 0.7, 0.2], [0.3, -1.2, 0.5, pi / 4, 0, 0.2], [0, 0, 0, 0, 0, 0]])
def test_bases_of_a_six_axis_arm_span_what_numpy_finds(q):
    robot, task = arm("six_r"), r1.PoseTask()
    at = r1.formulas(robot, task).at(q)
    s = r1.subspaces(task.jacobian(robot, q))
    assert at.rank == s.rank
    for ours, theirs in ((at.null, s.null), (at.left_null, s.left_null), (at.range, s.range), (at.row, s.row)):
        numbers = np.array(ours.evalf(), dtype=float).reshape(ours.shape)
        assert numbers.shape == theirs.shape
        assert numbers - theirs @ (theirs.T @ numbers) == pytest.approx(np.zeros(numbers.shape), abs=1e-9)
        assert np.linalg.matrix_rank(numbers) == theirs.shape[1]


def test_the_value_of_a_pose_is_the_homogeneous_matrix():
    robot = arm("six_r")
    at = r1.formulas(robot, r1.PoseTask()).at([0.1, 0.2, 0.3, 0.4, 0.5, 0.6])
    expected = r1.forward_kinematics(robot, [0.1, 0.2, 0.3, 0.4, 0.5, 0.6]).homogeneous
    assert np.array(at.value.evalf(), dtype=float) == pytest.approx(expected, abs=1e-12)


def test_a_printed_multiple_of_pi_is_read_as_it_and_said():
    at = prr().at(q2=1.5708)
    assert at.given == ((q2, sympy.pi / 2),)
    assert at.rank == 2
    assert "q2 = 1.5708 is read as pi/2" in at.explain()
    assert prr().at(q2=1.5707).given == ((q2, sympy.Rational(15707, 10000)),)
    assert prr().at(q1=1.5708).given == ((q1, sympy.Rational(15708, 10000)),)  # a length
    assert prr().at(q2=0.5).read == ()


@pytest.mark.parametrize(
    ("given", "error", "words"),
    [
        ({"q9": 0}, r1.UnknownNameError, "there is "),
        ({"theta": 0}, r1.UnknownNameError, "'l2'"),
        ({"q1": "zero"}, r1.InputError, "q1"),
        ({"q1": float("nan")}, r1.InputError, "finite"),
        ({"q1": sympy.I}, r1.InputError, "real"),
        ({"q1": sympy.oo}, r1.InputError, "finite"),
    ],
)
def test_unknown_names_and_no_numbers_are_errors(given, error, words):
    with pytest.raises(error, match=words):
        prr().at(**given)


def test_q_and_names_are_not_given_twice_and_q_has_the_right_length():
    with pytest.raises(r1.InputError, match="twice"):
        prr().at([0, 0, 0], q1=1)
    with pytest.raises(r1.InputError, match="3 joints"):
        prr().at([0, 0])


def test_where_a_formula_has_no_value_there_is_an_error():
    wrist = r1.robot_from_dh([("R", 0, -pi / 2, 0, 0), ("R", 0, pi / 2, 0, 0), ("R", 0, 0, 0, 0)])
    f = r1.formulas(wrist, r1.OrientationTask(angles="ZYZ"))
    assert f.at(q2=pi / 3).rank == 3
    with pytest.raises(r1.TaskError, match="no value there"):
        f.at(q2=0)


def test_a_pseudoinverse_that_would_be_too_long_is_refused():
    rows = [("R", 0, pi / 2, "d1", 0), ("R", "a2", 0, 0, 0), ("R", "a3", 0, 0, 0)]
    rows += [("R", 0, pi / 2, "d4", 0), ("R", 0, -pi / 2, "d5", 0), ("R", 0, 0, "d6", 0)]
    lengths = dict.fromkeys(["d1", "a2", "a3", "d4", "d5", "d6"], 0.4)
    f = r1.formulas(r1.robot_from_dh(rows, parameters=lengths), r1.PoseTask())
    with pytest.raises(r1.FormulaError, match="too long"):
        _ = f.at(q5=0).pseudoinverse
