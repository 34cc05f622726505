from math import inf, nan, pi

import numpy as np
import pinocchio as pin
import pytest
from arms import ARMS, NAMED, ROBOTS, arm

from robotics1 import InputError, RobotFileError, UnknownNameError, forward_kinematics, load_robot

XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'


def written(folder, text, name="arm.urdf"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


# --- names and paths


@pytest.mark.parametrize(
    ("name", "joints", "parameters"),
    [
        ("prr", ("q1", "q2", "q3"), {"l2": 0.6, "l3": 0.4}),
        ("cylindrical", ("q1", "q2", "q3"), {}),
        ("planar_2r", ("q1", "q2"), {"l1": 1.2, "l2": 0.8}),
    ],
)
def test_named_robots_have_their_joints_tool_and_default_lengths(name, joints, parameters):
    robot = load_robot(name)
    assert robot.name == name
    assert robot.joint_names == joints
    assert robot.tool == "tool"
    assert dict(robot.parameters) == parameters
    assert isinstance(robot.model, pin.Model)
    assert robot.warnings == ()


def test_a_path_as_text_and_as_path_give_the_same_robot():
    path = ROBOTS / "spatial.urdf"
    q = [0.1, 0.2, 0.3, 0.4, 0.5]
    a, b = forward_kinematics(load_robot(path), q), forward_kinematics(load_robot(str(path)), q)
    assert np.array_equal(a.homogeneous, b.homogeneous)


def test_a_source_with_a_suffix_is_a_path_even_with_the_name_of_a_robot(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(RobotFileError, match=r"prr\.urdf: there is no such file") as caught:
        load_robot("prr.urdf")
    assert str(caught.value.path) == "prr.urdf"


def test_a_file_without_suffix_needs_a_separator_or_a_path(tmp_path, monkeypatch):
    (tmp_path / "prr").write_text((ROBOTS / "one_joint.urdf").read_text(encoding="utf-8"), encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    assert load_robot("prr").nv == 3
    assert load_robot("./prr").nv == 1


@pytest.mark.parametrize(("name", "hint"), [("pr", "did you mean 'prr'"), ("", "there is 'cylindrical'")])
def test_an_unknown_name_lists_the_robots(name, hint):
    with pytest.raises(UnknownNameError, match=hint) as caught:
        load_robot(name)
    assert set(NAMED) <= set(caught.value.candidates)


# --- parameters


def test_parameters_set_the_lengths():
    robot = load_robot("planar_2r", parameters={"l1": 0.3})
    assert dict(robot.parameters) == {"l1": 0.3, "l2": 0.8}
    assert forward_kinematics(robot, [0, 0]).translation == pytest.approx([1.1, 0, 0], abs=1e-15)


def test_parameters_keep_every_digit():
    length = 0.1 + 0.2
    robot = load_robot("planar_2r", parameters={"l1": length, "l2": 1e-7})
    assert forward_kinematics(robot, [0, 0], frame="link2").translation[0] == length


def test_parameters_cannot_be_changed_afterwards():
    with pytest.raises(TypeError):
        arm("prr").parameters["l2"] = 2.0


def test_an_unknown_parameter_lists_those_that_exist():
    with pytest.raises(UnknownNameError, match=r"parameter of prr\.urdf\.xacro named 'l4'") as caught:
        load_robot("prr", parameters={"l4": 1.0})
    assert caught.value.candidates == ("l2", "l3")


@pytest.mark.parametrize("value", [nan, inf, -inf, "long", None, [1.0]])
def test_a_parameter_that_is_no_finite_number_is_an_input_error(value):
    with pytest.raises(InputError, match="parameter 'l2' must be a finite number"):
        load_robot("prr", parameters={"l2": value})


@pytest.mark.parametrize(
    ("default", "message", "element"),
    [
        ("", "parameter 'l2' has no default: give it a value", "l2"),
        (' default=""', "joint 'q3' needs 3 numbers in xyz of its <origin>, not ' 0 0'", "q3"),
    ],
)
def test_a_length_without_a_number_as_its_default_must_be_given(tmp_path, default, message, element):
    text = (ROBOTS / "planar_3r.urdf.xacro").read_text(encoding="utf-8").replace(' default="0.4"', default)
    path = written(tmp_path, text, "arm.urdf.xacro")
    with pytest.raises(RobotFileError, match=message) as caught:
        load_robot(path)
    assert (caught.value.path, caught.value.element) == (path, element)
    assert load_robot(path, parameters={"l2": 1}).parameters["l2"] == 1.0


@pytest.mark.parametrize("source", [None, 3, b"prr", ["prr"]])
def test_what_is_neither_a_name_nor_a_path_is_an_input_error(source):
    with pytest.raises(InputError, match="by a name or a path"):
        load_robot(source)


def test_a_plain_urdf_has_no_parameters():
    with pytest.raises(InputError, match="has no parameters"):
        load_robot("cylindrical", parameters={"l2": 1.0})


# --- files that are no robots


@pytest.mark.parametrize(
    ("text", "line"),
    [("<robot>\n<link>\n</robot>", 3), ("", 1), ("<robot name='a'>\n<link name=a/>\n</robot>", 2), ("not xml", 1)],
)
@pytest.mark.parametrize("name", ["arm.urdf", "arm.urdf.xacro"])
def test_ill_formed_xml_is_reported_with_path_and_line(tmp_path, text, line, name):
    path = written(tmp_path, text, name)
    with pytest.raises(RobotFileError, match="not well-formed XML") as caught:
        load_robot(path)
    assert (caught.value.path, caught.value.line) == (path, line)
    assert str(caught.value).startswith(f"{path}:{line}: ")


@pytest.mark.parametrize("text", ["<foo/>", "<robot name='x'/>", "<robot name='x'><joint name='q1'/></robot>"])
def test_xml_that_is_no_robot_is_a_robot_file_error(tmp_path, text):
    path = written(tmp_path, text)
    with pytest.raises(RobotFileError) as caught:
        load_robot(path)
    assert caught.value.path == path


def test_a_folder_is_no_robot(tmp_path):
    with pytest.raises(RobotFileError):
        load_robot(tmp_path)


def test_an_undefined_xacro_name_is_a_robot_file_error(tmp_path):
    text = f'<robot name="x" {XACRO}><link name="a${{nothing}}"/></robot>'
    with pytest.raises(RobotFileError, match="nothing"):
        load_robot(written(tmp_path, text, "arm.xacro"))


# --- joints


@pytest.mark.parametrize("name", ARMS)
def test_every_arm_has_one_number_a_joint(name):
    robot = arm(name)
    assert robot.nq == robot.nv == len(robot.joint_names) == len(robot.revolute)
    assert robot.lower.shape == robot.upper.shape == robot.max_velocity.shape == robot.max_effort.shape == (robot.nv,)
    assert (robot.lower < robot.upper).all()


def test_continuous_joints_are_revolute_without_limits():
    robot = arm("continuous")
    assert robot.lower.tolist() == [-inf, -1, -inf]
    assert robot.upper.tolist() == [inf, 1, inf]
    assert robot.revolute.tolist() == [True, False, True]


def test_continuous_joints_without_a_limit_element_have_no_limit_of_velocity_or_effort():
    robot = arm("continuous")
    assert robot.max_velocity.tolist() == [inf, 3, inf]
    assert robot.max_effort.tolist() == [inf, 50, inf]


def test_continuous_joints_keep_their_limit_of_velocity_and_effort(tmp_path):
    text = (ROBOTS / "one_joint.urdf").read_text(encoding="utf-8").replace('"revolute"', '"continuous"')
    robot = load_robot(written(tmp_path, text))
    assert (robot.lower[0], robot.upper[0]) == (-inf, inf)
    assert (robot.max_velocity[0], robot.max_effort[0]) == (3, 50)


def test_a_whole_turn_of_a_continuous_joint_is_no_motion():
    robot = arm("continuous")
    a, b = (forward_kinematics(robot, [q1, 0.4, 1.0]) for q1 in (0.3, 0.3 + 2 * pi))
    assert a.homogeneous == pytest.approx(b.homogeneous, abs=1e-14)


@pytest.mark.parametrize("name", NAMED)
def test_named_robots_turn_at_least_once(name):
    robot = load_robot(name)
    assert (robot.lower[robot.revolute] <= -pi).all()
    assert (robot.upper[robot.revolute] >= pi).all()


def test_cylindrical_slides_travel_at_least_4_m():
    robot = load_robot("cylindrical")
    assert robot.revolute.tolist() == [False, True, False]
    assert (robot.lower[[0, 2]] <= -4).all()
    assert (robot.upper[[0, 2]] >= 4).all()


def test_spatial_limits_are_those_of_its_file(spatial):
    assert spatial.lower == pytest.approx([-3, -0.5, -2.5, -pi, -2])
    assert spatial.upper == pytest.approx([3, 1, 2.5, pi, 2.8])
    assert spatial.max_velocity.tolist() == [2, 1, 3, 3, 4]
    assert spatial.max_effort.tolist() == [50, 100, 30, 20, 10]


@pytest.mark.parametrize(
    ("q", "inside"),
    [([2, pi, -pi], True), ([2.001, 0, 0], False), ([0, 0, -3.2], False), ([2 + 1e-10, 0, 0], True)],
)
def test_within_limits_includes_the_limits(prr, q, inside):
    assert prr.within_limits(q) is inside


@pytest.mark.parametrize(("name", "reach"), [("planar_2r", 2.0), ("planar_3r", 1.2), ("prr", 3.0), ("six_r", 1.35)])
def test_reach_is_the_sum_of_the_lengths_and_the_travel(name, reach):
    assert arm(name).reach == pytest.approx(reach, rel=1e-14)


# --- tools and tips


def test_the_only_tip_is_the_tool(spatial):
    assert spatial.tool == "gripper"


def test_a_named_link_is_the_tool(prr):
    robot = load_robot("prr", tool="link3")
    assert forward_kinematics(robot, [1, 2, 3]) == forward_kinematics(prr, [1, 2, 3], frame="link3")


def test_an_unknown_tool_is_refused_when_loading():
    with pytest.raises(UnknownNameError, match="did you mean 'tool'") as caught:
        load_robot("prr", tool="tol")
    assert "link3" in caught.value.candidates


def test_several_tips_load_and_the_first_use_of_the_tool_lists_them():
    robot = arm("two_tips")
    assert robot.tool is None
    with pytest.raises(InputError, match="'gripper', 'camera'"):
        forward_kinematics(robot, [0, 0])
    assert forward_kinematics(robot, [0, 0], frame="camera").translation == pytest.approx([0.6, 0, 0.2], abs=1e-15)


@pytest.mark.parametrize("usual", ["tool0", "tool"])
def test_among_several_tips_the_one_with_a_usual_name_is_the_tool(tmp_path, usual):
    text = (ROBOTS / "two_tips.urdf").read_text(encoding="utf-8").replace('"camera"', f'"{usual}"')
    assert load_robot(written(tmp_path, text)).tool == usual


def test_a_usual_name_that_is_no_tip_is_not_the_tool(tmp_path):
    text = (ROBOTS / "two_tips.urdf").read_text(encoding="utf-8").replace('"link1"', '"tool"')
    assert load_robot(written(tmp_path, text)).tool is None
