from math import pi

import numpy as np
import pinocchio as pin
import pytest
import sympy
from arms import arm, one_joint_file
from dh_arms import puma, stanford, ur5
from formula_values import number, real
from sympy import cos, sin

from robotics1 import (
    FormulaError,
    FunctionTask,
    OrientationTask,
    PlanarPoseTask,
    PoseTask,
    PositionTask,
    TaskError,
    formulas,
    frame_jacobian,
    load_robot,
    robot_from_dh,
)

H = pi / 2
q1, q2, q3, q4, q5 = real("q1:6")


def test_prr_planar_pose_is_q1_l2_c2_l3_c23_and_q2_plus_q3():
    l2, l3 = real("l2 l3")
    f = formulas(load_robot("prr"), PlanarPoseTask("xy"))
    assert list(f.value) == [q1 + l2 * cos(q2) + l3 * cos(q2 + q3), l2 * sin(q2) + l3 * sin(q2 + q3), q2 + q3]
    assert f.jacobian == sympy.Matrix(
        [
            [1, -l2 * sin(q2) - l3 * sin(q2 + q3), -l3 * sin(q2 + q3)],
            [0, l2 * cos(q2) + l3 * cos(q2 + q3), l3 * cos(q2 + q3)],
            [0, 1, 1],
        ]
    )
    assert f.determinant == l2 * cos(q2)
    assert f.minors == {(): l2 * cos(q2)}


def test_prr_position_minors_are_l2_l3_s3_and_l3_c23_and_l2_c2_plus_l3_c23():
    l2, l3 = real("l2 l3")
    f = formulas(load_robot("prr"), PositionTask("xy"))
    assert f.minors == {
        (0,): l2 * l3 * sin(q3),
        (1,): l3 * cos(q2 + q3),
        (2,): l2 * cos(q2) + l3 * cos(q2 + q3),
    }
    with pytest.raises(TaskError, match="2 × 3: it has minors"):
        _ = f.determinant


def test_cylindrical_determinant_is_minus_q3():
    f = formulas(load_robot("cylindrical"), PositionTask("xyz"))
    assert list(f.value) == [q3 * cos(q2), q3 * sin(q2), q1]
    assert f.determinant == -q3


def test_planar_3r_determinant_is_l1_l2_s2():
    l1, l2, l3 = real("l1 l2 l3")
    rows = [("R", name, 0, 0, 0) for name in ("l1", "l2", "l3")]
    robot = robot_from_dh(rows, parameters={"l1": 0.5, "l2": 0.4, "l3": 0.3})
    f = formulas(robot, PlanarPoseTask())
    assert f.value[0] == l1 * cos(q1) + l2 * cos(q1 + q2) + l3 * cos(q1 + q2 + q3)
    assert f.determinant == l1 * l2 * sin(q2)


def test_anthropomorphic_determinant_is_a2_a3_s3_times_the_shoulder():
    a2, a3, d1 = real("a2 a3 d1")
    rows = [("R", 0, H, "d1", 0), ("R", "a2", 0, 0, 0), ("R", "a3", 0, 0, 0)]
    f = formulas(robot_from_dh(rows, parameters={"a2": 0.5, "a3": 0.4, "d1": 0.3}), PositionTask())
    assert f.value[0] == cos(q1) * (a2 * cos(q2) + a3 * cos(q2 + q3))
    assert f.value[2] == d1 + a2 * sin(q2) + a3 * sin(q2 + q3)
    assert f.determinant == -a2 * a3 * sin(q3) * (a2 * cos(q2) + a3 * cos(q2 + q3))


def test_ur5_determinant_with_symbolic_lengths_has_s3_and_s5_in_front():
    a2, a3, d5 = real("a2 a3 d5")
    f = formulas(ur5(), PoseTask())
    rest = a2 * cos(q2) + a3 * cos(q2 + q3) + d5 * sin(q2 + q3 + q4)
    assert f.determinant == a2 * a3 * sin(q3) * sin(q5) * rest


def test_puma_determinant_is_elbow_times_shoulder_times_wrist():
    a2, a3, d4 = real("a2 a3 d4")
    f = formulas(puma(), PoseTask())
    elbow = a3 * sin(q3) + d4 * cos(q3)
    shoulder = a2 * cos(q2) + a3 * cos(q2 + q3) - d4 * sin(q2 + q3)
    assert f.determinant == a2 * elbow * shoulder * sin(q5)


def test_stanford_determinant_is_q3_squared_s2_s5():
    f = formulas(stanford(), PoseTask())
    assert f.determinant == q3**2 * sin(q2) * sin(q5)


def test_a_named_twist_is_an_angle_in_the_formulas():
    """One joint and a twist α: the tool's z axis is (s1 sin α, −c1 sin α, cos α)."""
    alpha = sympy.Symbol("alpha", real=True)
    robot = robot_from_dh([("R", 0, "alpha", 0, 0)], parameters={"alpha": 0.7})
    R = formulas(robot, OrientationTask()).value
    assert list(R[:, 2]) == [sin(alpha) * sin(q1), -sin(alpha) * cos(q1), cos(alpha)]


def test_rotations_by_thirds_and_quarters_are_exact():
    """θ offset π/6 and twist π/4: the tool's x axis at q = 0 is (√3/2, 1/2, 0), its z axis has z = √2/2."""
    R = formulas(robot_from_dh([("R", 0, pi / 4, 0, pi / 6)]), OrientationTask()).value.subs(q1, 0)
    assert [sympy.nsimplify(entry) for entry in R[:, 0]] == [sympy.sqrt(3) / 2, sympy.Rational(1, 2), 0]
    assert sympy.simplify(R[2, 2] - sympy.sqrt(2) / 2) == 0


@pytest.mark.parametrize("k", range(-23, 24, 2))
def test_a_turn_by_k_twelfths_of_pi_is_exact(k):
    robot = robot_from_dh([("R", 0, 0, 0, k * pi / 12)])
    x = formulas(robot, OrientationTask()).value[:, 0].subs(q1, 0)
    wanted = sympy.Matrix([cos(k * sympy.pi / 12), sin(k * sympy.pi / 12), 0])
    assert [sympy.simplify(entry) for entry in x - wanted] == [
        0,
        0,
        0,
    ]


@pytest.mark.parametrize("name", ["spatial", "six_r", "vertical_2r", "one_joint", "anthropomorphic"])
@pytest.mark.parametrize("reference", ["world", "tool"])
def test_the_pose_jacobian_of_every_test_arm_is_pinocchios(name, reference):
    robot = arm(name)
    f = formulas(robot, PoseTask(reference=reference))
    q = np.random.default_rng(3).uniform(-2, 2, robot.nq)
    assert number(f.jacobian, f, q) == pytest.approx(frame_jacobian(robot, q, reference=reference), abs=1e-9)


def test_the_jacobian_of_a_position_is_the_derivative_of_its_value():
    f = formulas(arm("spatial"), PositionTask())
    difference = f.value.jacobian(sympy.Matrix(f.q)) - f.jacobian
    assert np.abs(number(difference, f, np.random.default_rng(4).uniform(-2, 2, 5))).max() < 1e-14


def test_angles_that_are_rounded_in_the_file_are_made_exact_and_that_is_said(tmp_path):
    path = tmp_path / "rounded.urdf"
    path.write_text(
        """<robot name="rounded"><link name="base"/><link name="a"/><link name="tool"/>
        <joint name="q1" type="revolute"><origin rpy="1.5708 0 0"/><parent link="base"/><child link="a"/>
        <axis xyz="0 0 1"/><limit lower="-3" upper="3" velocity="1" effort="1"/></joint>
        <joint name="tip" type="fixed"><origin xyz="0.5 0 0"/><parent link="a"/><child link="tool"/></joint></robot>"""
    )
    f = formulas(load_robot(path), PositionTask("xz"))
    assert list(f.value) == [cos(q1) / 2, sin(q1) / 2]
    assert f.cleaned == pytest.approx(1.5708 - H, abs=1e-12)


@pytest.mark.parametrize("name", ["value", "jacobian", "determinant", "jacobian_rate", "velocity_product"])
def test_a_formula_that_differs_from_pinocchio_is_an_error_and_no_answer(name):
    """The user's function gives x of a number longer by 1e-6 than x of a formula."""
    longer = FunctionTask(lambda p, R, q: [p[0] * (1 + 1e-6 * isinstance(p[0], float)), p[1]], 2)
    with pytest.raises(FormulaError, match=r"the formula of .* differs from Pinocchio by"):
        getattr(formulas(load_robot("planar_2r"), longer), name)


@pytest.mark.parametrize("n", [4, 6, 11])
def test_the_angle_of_a_planar_nr_is_the_sum_of_its_joints_whole_turns_apart(n):
    """Where it is tried, the sum leaves (−π, π], in which Pinocchio's angle lies."""
    f = formulas(robot_from_dh([("R", 0.3, 0, 0, 0)] * n), PlanarPoseTask())
    assert f.value[2] == sum(f.q)
    assert max(abs(sum(point.q)) for point in f._trials.points) > pi


def test_what_formulas_cannot_tell_is_a_typed_error():
    with pytest.raises(FormulaError, match="for tasks on a frame and for FunctionTask, not for 7"):
        formulas(load_robot("planar_2r"), 7)
    with pytest.raises(TaskError, match="leaves the xy plane"):
        formulas(load_robot("cylindrical"), PlanarPoseTask())
    long = robot_from_dh([("R", 0.1, 0, 0, 0)] * 40)
    with pytest.raises(FormulaError, match="40 joints lead to 'tool'"):
        formulas(long, PositionTask("xy"))


def test_a_number_that_is_no_polynomial_of_the_parameters_is_named(tmp_path):
    with pytest.raises(FormulaError, match="xyz of joint 'tip' is no polynomial of degree 2"):
        formulas(load_robot(one_joint_file(tmp_path, "l", "1/l")), PositionTask("xy"))


def test_the_value_of_a_pose_is_its_homogeneous_matrix(planar_2r):
    T = formulas(planar_2r, PoseTask()).value
    assert T.shape == (4, 4)
    assert T[0, 0] == cos(q1 + q2)
    assert list(T[3, :]) == [0, 0, 0, 1]
    assert isinstance(PoseTask().value(planar_2r, [0, 0]), pin.SE3)


def test_gram_determinant_of_a_wide_jacobian_is_the_sum_of_the_squares_of_the_minors():
    f = formulas(load_robot("prr"), PositionTask("xy"))
    assert sympy.simplify(f.gram_determinant - sum(minor**2 for minor in f.minors.values())) == 0
    assert formulas(load_robot("prr"), PlanarPoseTask("xy")).gram_determinant == real("l2") ** 2 * cos(q2) ** 2
