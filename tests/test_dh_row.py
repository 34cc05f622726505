"""The row of a DH table that a homogeneous matrix is."""

from math import atan2, pi

import numpy as np
import pinocchio as pin
import pytest
import sympy
from dh_forms import modified_matrix, standard_matrix
from hypothesis import given, strategies as st

import robotics1 as r1

dh_row = r1.textbook_robots.dh_row
angles, lengths = st.floats(-3, 3), st.floats(-2, 2)


@given(lengths, angles, lengths, angles)
def test_a_standard_matrix_gives_its_parameters_back(a, alpha, d, theta):
    row = dh_row(standard_matrix(a, alpha, d, theta)).standard
    assert row == pytest.approx((a, alpha, d, theta), abs=1e-6)
    assert standard_matrix(*row) == pytest.approx(standard_matrix(a, alpha, d, theta), abs=1e-6)


@given(lengths, angles, lengths, angles)
def test_a_modified_matrix_gives_its_parameters_back(a, alpha, d, theta):
    row = dh_row(modified_matrix(a, alpha, d, theta)).modified
    assert row == pytest.approx((a, alpha, d, theta), abs=1e-6)


def test_a_shift_along_x_is_a_row_of_both_conventions():
    found = dh_row(pin.SE3(np.eye(3), np.array([0.3, 0.0, 0.0])))
    assert found.standard == found.modified == (0.3, 0, 0, 0)
    assert found.reasons == ()
    assert "the standard row is a = 0.3000, α = 0, d = 0, θ = 0" in found.explain()


def test_what_is_no_row_says_which_condition_fails():
    tilted = dh_row(pin.SE3(pin.rpy.rpyToMatrix(0.1, 0.2, 0.3), np.zeros(3)))
    assert tilted.standard is None
    assert tilted.modified is None
    assert "R31 = -0.1987 is not zero" in tilted.explain()
    assert "R13 = " in tilted.explain()
    with pytest.raises(r1.NotConverged, match="R31"):
        tilted.require()
    shifted = dh_row(pin.SE3(np.eye(3), np.array([0.0, 0.2, 0.1])))
    assert shifted.standard is None
    assert "does not meet" in shifted.explain()
    assert dh_row(np.eye(4)).require().standard == (0, 0, 0, 0)


def test_a_matrix_of_symbols_gives_a_row_of_symbols():
    q, a, d = sympy.symbols("q a d", real=True)
    c, s = sympy.cos(q), sympy.sin(q)
    found = dh_row(sympy.Matrix([[c, 0, s, a * c], [s, 0, -c, a * s], [0, 1, 0, d], [0, 0, 0, 1]]))
    assert found.standard == (a, sympy.pi / 2, d, q)
    assert found.modified is None
    assert "R13 = sin(q)" in found.explain()
    craig = sympy.Matrix([[c, -s, 0, a], [0, 0, 1, d], [-s, -c, 0, 0], [0, 0, 0, 1]])
    assert dh_row(craig).modified == (a, -sympy.pi / 2, d, q)


def test_what_is_no_homogeneous_matrix_is_refused():
    with pytest.raises(r1.InputError, match="no rotation"):
        dh_row(np.ones((4, 4)) * np.array([[1], [1], [1], [0]]) + np.diag([0, 0, 0, 1]))
    with pytest.raises(r1.InputError, match="shape"):
        dh_row(np.eye(3))
    with pytest.raises(r1.InputError, match="homogeneous"):
        dh_row(sympy.diag(sympy.Symbol("k", real=True), 1, 1, 1))


# --- maps of joint coordinates


joint_map = r1.textbook_robots.joint_map


def test_dh_angles_of_a_planar_arm_become_absolute_ones():
    absolute = joint_map(["q1", "q1 + q2", "q1 + q2 + q3"])
    relative_arm = r1.textbook_robots.planar_arm("RRR", [1, 0.7, 0.5])
    absolute_arm = r1.textbook_robots.planar_arm("RRR", [1, 0.7, 0.5], absolute=True)
    q, qdot = np.array([0.3, -0.8, 1.1]), np.array([0.2, 0.4, -0.3])
    theta = absolute(q)
    expected = r1.forward_kinematics(relative_arm, q).homogeneous
    assert r1.forward_kinematics(absolute_arm, theta).homogeneous == pytest.approx(expected, abs=1e-14)
    J, Ja = (r1.frame_jacobian(arm, x) for arm, x in ((relative_arm, q), (absolute_arm, theta)))
    assert Ja @ absolute.rates(qdot) == pytest.approx(J @ qdot)
    f = np.arange(1.0, 7)
    assert absolute.torques(Ja.T @ f) == pytest.approx(J.T @ f)
    assert absolute.inverse(theta) == pytest.approx(q)
    assert absolute.inverse.matrix == pytest.approx(np.linalg.inv(absolute.matrix))


def test_couplings_and_offsets_are_read_from_the_formulas():
    found = joint_map(["k*(q1 - pi/2)", "q2 - 0.5*q1"], values={"k": 100})
    assert found.matrix.tolist() == [[100, 0], [-0.5, 1]]
    assert found.offset == pytest.approx([-50 * pi, 0])
    assert joint_map(["q1"], joints=2).matrix.tolist() == [[1, 0]]
    assert atan2(*found([pi / 2, pi / 4])) == 0


@pytest.mark.parametrize(
    ("formulas", "options", "words"),
    [
        (["q1*q2"], {}, "sum of numbers"),
        (["sin(q1)"], {}, "sum of numbers"),
        (["k*q1"], {}, "'k' is neither a joint, q1 to q1, nor"),
        (["q3"], {"joints": 2}, "q1 to q2"),
        ("q1", {}, "one for each"),
        ([], {}, "one for each"),
        (["0.3"], {}, "q1"),
    ],
)
def test_what_is_no_linear_map_is_refused(formulas, options, words):
    with pytest.raises(r1.InputError, match=words):
        joint_map(formulas, **options)


def test_a_map_without_inverse_and_unknown_values_are_errors():
    with pytest.raises(r1.InputError, match="no inverse"):
        _ = joint_map(["q1 + q2", "2*q1 + 2*q2"]).inverse
    with pytest.raises(r1.UnknownNameError):
        joint_map(["q1"], values={"k": 1})
