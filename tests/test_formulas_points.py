"""Formulas of chosen points, chosen rows and chosen axes."""

from math import pi

import numpy as np
import pinocchio as pin
import pytest
import sympy
from arms import arm, one_joint_file, random_q
from differences import derivative
from formula_values import number, real, same
from sympy import Matrix, cos, sin

from robotics1 import (
    FormulaError,
    FunctionTask,
    InputError,
    OrientationTask,
    PlanarPoseTask,
    PoseTask,
    PositionTask,
    UnknownNameError,
    formulas,
    forward_kinematics,
    frame_jacobian,
    load_robot,
    robot_from_dh,
)

H = pi / 2
q1, q2, q3 = real("q1:4")


def at_point(robot, q, frame, c, reference="world"):
    """The Jacobian of a point c of a frame, by hand: v + ω × R c."""
    J = frame_jacobian(robot, q, frame=frame)
    J = np.vstack([J[:3] + np.cross(J[3:].T, forward_kinematics(robot, q, frame=frame).rotation @ c).T, J[3:]])
    R = np.eye(3) if reference == "world" else forward_kinematics(robot, q, frame=reference).rotation
    return np.vstack([R.T @ J[:3], R.T @ J[3:]])


def test_a_point_d_to_the_side_of_a_2r_tip():
    l1, l2, d = real("l1 l2 d")
    f = formulas(load_robot("planar_2r"), PositionTask("xy"), point=(0, "d", 0))
    assert same(f.value, Matrix([l1 * cos(q1) + l2 * cos(q1 + q2) - d * sin(q1 + q2),
                                 l1 * sin(q1) + l2 * sin(q1 + q2) + d * cos(q1 + q2)]))  # fmt: skip
    assert same(f.jacobian, f.value.jacobian([q1, q2]))
    assert f.determinant == l1 * (d * cos(q2) + l2 * sin(q2))
    assert f.unvalued == ("d",)
    assert number(f.jacobian, f, [0.3, 0.7], d=0.2) == pytest.approx(
        at_point(load_robot("planar_2r"), [0.3, 0.7], "tool", [0, 0.2, 0])[:2], abs=1e-12
    )


def test_the_middle_of_a_link_is_a_polynomial_of_its_length():
    l1, l2 = real("l1 l2")
    f = formulas(load_robot("planar_2r"), PositionTask("xy", frame="link2"), point=(sympy.Symbol("l2") / 2, 0, 0))
    assert list(f.value) == [l1 * cos(q1) + l2 * cos(q1 + q2) / 2, l1 * sin(q1) + l2 * sin(q1 + q2) / 2]
    assert f.unvalued == ()


@pytest.mark.parametrize("name", ["spatial", "six_r", "anthropomorphic", "redundant"])
@pytest.mark.parametrize("reference", ["world", "tool"])
def test_the_pose_jacobian_of_a_point_in_numbers_is_v_plus_omega_cross_R_c(name, reference):
    robot, c = arm(name), [0.1, -0.2, 0.3]
    f = formulas(robot, PoseTask(reference=reference), point=c)
    q = random_q(robot, 7)
    wanted = at_point(robot, q, robot.tool, c, reference if reference == "world" else robot.tool)
    assert number(f.jacobian, f, q) == pytest.approx(wanted, abs=1e-9)
    if reference == "world":
        T = forward_kinematics(robot, q) * pin.SE3(np.eye(3), np.array(c))
        assert number(f.value, f, q) == pytest.approx(T.homogeneous, abs=1e-9)


def test_a_point_of_a_function_task_is_the_p_that_the_function_receives():
    robot = arm("anthropomorphic")
    f = formulas(robot, FunctionTask(lambda p, R, q: [p @ p], 1), point=(0.1, 0, "d"))
    q = [0.4, -0.3, 0.8]

    def squared(x):
        T = forward_kinematics(robot, x)
        p = T.translation + T.rotation @ [0.1, 0, 0.25]
        return [p @ p]

    assert number(f.jacobian, f, q, d=0.25) == pytest.approx(derivative(squared, q), abs=1e-9)


def test_the_point_leaves_the_robot_of_the_caller_as_it_was():
    robot = load_robot("planar_2r")
    before = robot.frame_names
    f = formulas(robot, PositionTask("xy"), point=(0, 0, "d"))
    assert robot.frame_names == before
    assert set(f.robot.frame_names) - set(before) == {"point"}
    assert f.task.frame == "point"
    assert "d" not in robot.parameters


def test_the_numbers_of_the_result_are_those_of_the_point():
    robot = arm("anthropomorphic")
    f = formulas(robot, PositionTask(), point=(0.1, -0.2, 0.3))
    q = [0.4, -0.3, 0.8]
    T = forward_kinematics(robot, q)
    assert f.task.value(f.robot, q) == pytest.approx(T.translation + T.rotation @ [0.1, -0.2, 0.3], abs=1e-12)
    longer = f.robot.with_parameters({"a2": 2.0})
    assert longer.parameters["a2"] == 2.0
    assert forward_kinematics(longer, q, frame="point").translation == pytest.approx(
        forward_kinematics(longer, q) * np.array([0.1, -0.2, 0.3]), abs=1e-12
    )
    with pytest.raises(UnknownNameError, match="no parameter of robot 'anthropomorphic' named 'a4'"):
        f.robot.with_parameters({"a4": 2.0})


def test_a_second_point_has_another_name():
    first = formulas(load_robot("planar_2r"), PositionTask("xy"), point=(0, 0.1, 0))
    second = formulas(first.robot, PositionTask("xy"), point=(0, 0.2, 0))
    assert second.task.frame == "point_"


@pytest.mark.parametrize(
    ("point", "message"),
    [
        ((0, 0), r"shape \(3,\)"),
        ("abc", r"shape \(3,\)"),
        ((0, 0, float("nan")), "finite"),
        ((0, 0, 1j), "real numbers"),
        ((0, 0, "q1"), "cannot depend on q1"),
        ((0, 0, "a b"), "a name in point must be a word"),
        ((0, 0, 1 / sympy.Symbol("a")), "polynomials of names"),
        ((0, 0, sympy.I), "real and finite"),
    ],
)
def test_what_is_no_point_is_an_input_error(point, message):
    with pytest.raises(InputError, match=message):
        formulas(load_robot("planar_2r"), PositionTask("xy"), point=point)


def test_a_point_that_is_a_cubic_of_its_names_is_a_formula_error():
    with pytest.raises(FormulaError, match="no polynomial of degree 2"):
        formulas(load_robot("planar_2r"), PositionTask("xy"), point=(sympy.Symbol("a") ** 3, 0, 0))


def test_rows_y_and_omega_z_of_a_pose():
    a2, a3 = real("a2 a3")
    rows = [("R", 0, H, "d1", 0), ("R", "a2", 0, 0, 0), ("R", "a3", 0, 0, 0)]
    robot = robot_from_dh(rows, parameters={"a2": 0.5, "a3": 0.4, "d1": 0.3})
    f = formulas(robot, PoseTask(), rows=("y", "ωz"))
    shoulder = a2 * cos(q2) + a3 * cos(q2 + q3)
    height = a2 * sin(q2) + a3 * sin(q2 + q3)
    wanted = Matrix([[cos(q1) * shoulder, -sin(q1) * height, -a3 * sin(q1) * sin(q2 + q3)], [1, 0, 0]])
    assert same(f.jacobian, wanted)
    assert f.row_names == ("y", "ωz")
    assert f.minors == {(0,): 0, (1,): a3 * sin(q1) * sin(q2 + q3), (2,): height * sin(q1)}
    assert f.value.shape == (4, 4)
    assert formulas(robot, PoseTask(), rows=["y", "wz"]).jacobian == f.jacobian


def test_rows_of_a_column_choose_its_values_too():
    f = formulas(load_robot("prr"), PlanarPoseTask(), rows=("phi", "x"))
    l2, l3 = real("l2 l3")
    assert list(f.value) == [q2 + q3, q1 + l2 * cos(q2) + l3 * cos(q2 + q3)]
    assert list(f.jacobian.row(0)) == [0, 1, 1]


def test_a_row_that_is_not_there_is_an_unknown_name_with_candidates():
    with pytest.raises(UnknownNameError, match="no row of the task named 'wx'") as error:
        formulas(load_robot("planar_2r"), PositionTask("xy"), rows=("x", "wx"))
    assert error.value.candidates == ("x", "y")


@pytest.mark.parametrize("rows", ["x", (), ("x", "x"), 5, (1,), {"x": 1}])
def test_what_are_no_rows_is_an_input_error(rows):
    with pytest.raises(InputError, match="row"):
        formulas(load_robot("planar_2r"), PositionTask("xy"), rows=rows)


@pytest.mark.parametrize("reference", ["link1", "link2", "link5", "q4"])
def test_a_pose_in_the_axes_of_a_link_on_the_way_is_pinocchios(reference):
    rows = [("R", 0.1, (-1) ** i * H, 0.2, 0) for i in range(6)]
    robot = robot_from_dh(rows)
    f = formulas(robot, PoseTask(reference=reference))
    q = np.random.default_rng(8).uniform(-2, 2, 6)
    assert number(f.jacobian, f, q) == pytest.approx(frame_jacobian(robot, q, reference=reference), abs=1e-9)
    T = forward_kinematics(robot, q)
    R = forward_kinematics(robot, q, frame=reference).rotation
    wanted = pin.SE3(R.T @ T.rotation, R.T @ T.translation).homogeneous
    assert number(f.value, f, q) == pytest.approx(wanted, abs=1e-9)


BRANCHES = """<robot name="branches"><link name="base"/><link name="trunk"/><link name="left"/><link name="right"/>
<joint name="q1" type="continuous"><parent link="base"/><child link="trunk"/><axis xyz="0 0 1"/></joint>
<joint name="q2" type="continuous"><origin xyz="0.3 0 0.1" rpy="1.5707963267948966 0 0"/><parent link="trunk"/>
<child link="left"/><axis xyz="0 0 1"/></joint>
<joint name="q3" type="continuous"><origin xyz="0 0.2 0" rpy="0 0.4 0"/><parent link="trunk"/><child link="right"/>
<axis xyz="1 0 0"/></joint></robot>"""


def test_axes_of_a_link_on_another_branch(tmp_path):
    """The left arm seen from the right one: they leave the trunk that they share."""
    (tmp_path / "branches.urdf").write_text(BRANCHES)
    robot = load_robot(tmp_path / "branches.urdf", tool="left")
    f = formulas(robot, PoseTask(reference="right"), point=(0.1, 0.2, 0.3))
    q = [0.4, -0.7, 1.2]
    J = at_point(robot, q, "left", [0.1, 0.2, 0.3], "right")
    assert number(f.jacobian, f, q) == pytest.approx(J, abs=1e-9)
    T, R = forward_kinematics(f.robot, q, frame="point"), forward_kinematics(robot, q, frame="right").rotation
    assert number(f.value, f, q)[:3] == pytest.approx(
        np.column_stack([R.T @ T.rotation, R.T @ T.translation]), abs=1e-9
    )


def test_a_frame_that_is_named_by_its_joint_is_the_link_that_moves():
    robot = load_robot("planar_2r")
    by_joint, by_link = (formulas(robot, OrientationTask(frame=frame)) for frame in ("q2", "link2"))
    assert by_joint.value == by_link.value


def test_a_link_that_does_not_move_has_a_jacobian_of_zeros():
    f = formulas(load_robot("planar_2r"), PositionTask("xy", frame="base"))
    assert f.jacobian == sympy.zeros(2, 2)
    assert f.determinant == 0


def test_a_parameter_that_is_called_like_a_joint_is_refused(tmp_path):
    with pytest.raises(FormulaError, match="a parameter 'q1', which in formulas is a joint"):
        formulas(load_robot(one_joint_file(tmp_path, "q1", "q1")), PositionTask("xy"))
