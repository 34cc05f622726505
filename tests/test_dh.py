import xml.etree.ElementTree as ET
from itertools import pairwise
from math import inf, nan, pi

import numpy as np
import pinocchio as pin
import pytest
from dh_forms import conventions, dh_pose, dh_rows, homogeneous, placements, rotation, seeds
from hypothesis import given, settings, strategies as st

from robotics1 import (
    InputError,
    PositionTask,
    UnknownNameError,
    formulas,
    forward_kinematics,
    load_robot,
    robot_from_dh,
)
from robotics1.dh import DHTable, dh_to_urdf

POLAR = [("R", 0, pi / 2, "l1", 0), ("R", "-l2", -pi / 3, 0.2, "beta"), ("P", 0.1, "beta", "l1", -0.4)]
VALUES = {"l1": 0.5, "l2": 0.3, "beta": 0.1 + 0.2}
NUMBERS = [("R", 0, pi / 2, 0.5, 0), ("R", -0.3, -pi / 3, 0.2, 0.1 + 0.2), ("P", 0.1, 0.1 + 0.2, 0.5, -0.4)]
TURNED = homogeneous(rotation(0.4, -1.1, 2.0), [0.1, -0.2, 0.3])


def random_q(rows, seed):
    return np.random.default_rng(seed).uniform(-3, 3, len(rows))


def pose(robot, q, frame=None):
    return forward_kinematics(robot, q, frame=frame).homogeneous


# --- forward kinematics


@given(dh_rows, conventions, placements, placements, seeds)
@settings(max_examples=100)
def test_pose_is_the_product_of_the_books_matrices(rows, convention, base, tool, seed):
    q = random_q(rows, seed)
    robot = robot_from_dh(rows, convention=convention, base_placement=base, tool_placement=tool)
    assert pose(robot, q) == pytest.approx(dh_pose(rows, q, convention, base, tool), abs=5e-14)


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_link_i_is_frame_i_of_the_table(convention):
    q = [0.3, -0.8, 0.6]
    robot = robot_from_dh(NUMBERS, convention=convention, base_placement=TURNED, tool_placement=TURNED)
    for i in range(4):
        expected = dh_pose(NUMBERS[:i], q[:i], convention, TURNED)
        assert pose(robot, q, f"link{i}") == pytest.approx(expected, abs=1e-15)


def test_joints_are_q1_q2_and_links_lead_from_base_to_tool():
    robot = robot_from_dh(NUMBERS)
    assert robot.joint_names == ("q1", "q2", "q3")
    assert (robot.frame_names[0], robot.tool) == ("base", "tool")
    assert {"link1", "link2", "link3"} <= set(robot.frame_names)
    assert robot.revolute.tolist() == [True, True, False]
    assert robot.warnings == ()


def test_a_pin_se3_and_its_matrix_are_the_same_placement():
    T = pin.SE3(TURNED[:3, :3], TURNED[:3, 3])
    a = robot_from_dh(NUMBERS, base_placement=T, tool_placement=T)
    b = robot_from_dh(NUMBERS, base_placement=TURNED, tool_placement=TURNED.tolist())
    assert np.array_equal(pose(a, [1, 2, 3]), pose(b, [1, 2, 3]))


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize("alpha", [pi / 2, -pi / 2, pi, -pi])
def test_right_angles_leave_no_more_than_one_rounding(convention, alpha):
    robot = robot_from_dh([("R", 0.3, alpha, 0, 0), ("R", 0, 0, 0.2, 0)], convention=convention)
    R = forward_kinematics(robot, [0, 0]).rotation
    assert R == pytest.approx(np.round(R), abs=2.3e-16)


# --- names


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_names_and_negated_names_stand_for_their_values(convention):
    robot = robot_from_dh(POLAR, parameters=VALUES, convention=convention)
    q = [0.3, -0.8, 0.6]
    assert pose(robot, q) == pytest.approx(dh_pose(NUMBERS, q, convention), abs=1e-15)
    assert dict(robot.parameters) == VALUES


@given(st.floats(-1e6, 1e6))
def test_a_named_length_keeps_every_digit(length):
    robot = robot_from_dh([("R", "-a", 0, 0, 0)], parameters={"a": length})
    assert pose(robot, [0])[0, 3] == -length


def test_each_name_stands_alone_in_the_placement_of_one_joint():
    for convention in ("standard", "modified"):
        robot = robot_from_dh(POLAR, parameters=VALUES, convention=convention)
        placements = robot.placements
        assert placements["q1"] == (({}, {}, {("l1",): 1.0}), ({}, {}, {}))
        assert placements["x2"] == (({("l2",): -1.0}, {}, {}), ({(): -1.0471975511965976}, {}, {}))
        assert placements["q2"] == (({}, {}, {(): 0.2}), ({}, {}, {("beta",): 1.0}))
        assert placements["x3"] == (({(): 0.1}, {}, {}), ({("beta",): 1.0}, {}, {}))


@pytest.mark.parametrize("name", ["α", "l_2", "e", "gamma", "L1", "lower"])
def test_names_are_identifiers_greek_letters_and_names_of_functions_included(name):
    robot = robot_from_dh([("R", name, 0, f" - {name} ", 0)], parameters={name: 0.25})
    assert dict(robot.parameters) == {name: 0.25}
    assert pose(robot, [0])[:3, 3].tolist() == [0.25, 0, -0.25]


@pytest.mark.parametrize("name", ["q1", "q17", "pi", "-q2"])
def test_joints_and_pi_are_no_names(name):
    with pytest.raises(InputError, match="cannot be called"):
        robot_from_dh([("R", 0, 0, name, 0)], parameters={name: 1})


@pytest.mark.parametrize(
    "entry", ["", "-", "0.5", "pi/2", "2*l", "l1+l2", "--l", "lambda", "a b", "l'", "$(x)", "__l", "aᵢ"]
)
def test_an_entry_that_is_no_number_and_no_name_says_what_would_be(entry):
    with pytest.raises(InputError, match=r"a of row 2 must be a number, a name such as 'l2' or a negated name"):
        robot_from_dh([("R", 0, 0, 0, 0), ("R", entry, 0, 0, 0)], parameters={entry: 1})


def test_names_without_a_value_are_listed():
    with pytest.raises(InputError, match=r"no value for l2, beta: give it, as in parameters=\{'l2': 0.5\}"):
        robot_from_dh(POLAR, parameters={"l1": 1})


def test_a_value_that_no_row_uses_is_an_unknown_name():
    with pytest.raises(UnknownNameError, match="parameter of the DH table named 'l22'; did you mean 'l2'"):
        robot_from_dh(POLAR, parameters={**VALUES, "l22": 1})


@pytest.mark.parametrize("value", [nan, inf, "long", None, [1.0]])
def test_a_value_that_is_no_finite_number_is_an_input_error(value):
    with pytest.raises(InputError, match="parameter 'l2' must be a finite number"):
        robot_from_dh(POLAR, parameters={**VALUES, "l2": value})


# --- misuse


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([], "at least one row"),
        (3, r"rows must be a list of \(type, a, alpha, d, theta\)"),
        (["R0000"], r"row 1 must be \(type, a, alpha, d, theta\)"),
        ([("R", 0, 0, 0)], r"row 1 must be \(type, a, alpha, d, theta\)"),
        ([("R", 0, 0, 0, 0), ("X", 0, 0, 0, 0)], r"type of row 2 must be 'R' \(revolute\) or 'P' \(prismatic\)"),
        ([(0, 0, 0, 0, "R")], "type of row 1"),
        ([("R", nan, 0, 0, 0)], "a of row 1 must be a finite number"),
        ([("R", 0, 0, inf, 0)], "d of row 1 must be a finite number"),
        ([("R", 0, None, 0, 0)], "alpha of row 1 must be a finite number"),
        ([("R", 0, 0, 0, [1, 2])], "theta of row 1 must be a finite number"),
    ],
)
def test_a_wrong_row_is_an_input_error_that_says_which(rows, message, tmp_path):
    with pytest.raises(InputError, match=message):
        robot_from_dh(rows)
    with pytest.raises(InputError, match=message):
        dh_to_urdf(rows, tmp_path / "arm.urdf")
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"convention": "craig"}, "convention must be one of 'standard', 'modified'"),
        ({"base_placement": np.eye(3)}, r"base_placement must have shape \(4, 4"),
        ({"tool_placement": np.diag([1, 1, -1, 1])}, "tool_placement's rotation is no rotation"),
        ({"tool_placement": np.diag([1, 1, 1, 2])}, r"tool_placement must have the last row \(0, 0, 0, 1\)"),
        ({"base_placement": np.full((4, 4), nan)}, "base_placement must be finite"),
        ({"lower": [0, 0]}, "lower must have one number or None for each of 3 joints"),
        ({"upper": 1.0}, "upper must have one number or None for each of 3 joints"),
        ({"upper": [0, nan, 0]}, "upper must have one number or None for each of 3 joints"),
        ({"lower": [0, 0, 1], "upper": [0, 0, 0.5]}, "limits of q3 must have lower ≤ upper; they are 1 and 0.5"),
        ({"lower": [inf, 0, 0]}, "limits of q1"),
    ],
)
def test_a_wrong_option_is_an_input_error(options, message):
    with pytest.raises(InputError, match=message):
        robot_from_dh(NUMBERS, **options)


def test_arguments_are_not_changed():
    rows, base, lower = [list(row) for row in POLAR], TURNED.copy(), [None, -1, 0]
    robot_from_dh(rows, parameters=VALUES, base_placement=base, lower=lower)
    assert rows == [list(row) for row in POLAR]
    assert np.array_equal(base, TURNED)
    assert lower == [None, -1, 0]


# --- limits


def test_joints_without_limits_are_unbounded():
    robot = robot_from_dh(NUMBERS)
    assert robot.lower.tolist() == [-inf] * 3
    assert robot.upper.tolist() == [inf] * 3
    assert robot.max_velocity.tolist() == robot.max_effort.tolist() == [inf] * 3


def test_limits_are_those_given_one_by_one():
    robot = robot_from_dh(NUMBERS, lower=[-1, None, -inf], upper=(1, 0.1 + 0.2, 5000))
    assert robot.lower.tolist() == [-1, -inf, -inf]
    assert robot.upper.tolist() == [1, 0.1 + 0.2, 5000]


# --- the file


def yourdfpy_pose(path, q):
    import yourdfpy

    urdf = yourdfpy.URDF.load(str(path), load_meshes=False, build_scene_graph=True)
    urdf.update_cfg(dict(zip(urdf.actuated_joint_names, q, strict=True)))
    return urdf.get_transform("tool", "base")


@given(dh_rows, conventions, placements, seeds)
@settings(max_examples=15)
def test_yourdfpy_finds_the_same_pose_in_the_written_file(tmp_path_factory, rows, convention, tool, seed):
    q = random_q(rows, seed)
    path = tmp_path_factory.mktemp("dh") / "arm.urdf"
    dh_to_urdf(DHTable(rows, convention=convention, tool_placement=tool), path)
    assert yourdfpy_pose(path, q) == pytest.approx(dh_pose(rows, q, convention, None, tool), abs=5e-14)


def test_the_file_is_a_plain_urdf_with_the_values_and_loads_as_the_same_robot(tmp_path):
    table = DHTable(POLAR, parameters=VALUES, base_placement=TURNED, lower=[-1, None, 0])
    path = dh_to_urdf(table, str(tmp_path / "arm.urdf"))
    assert path == tmp_path / "arm.urdf"
    assert [entry.name for entry in tmp_path.iterdir()] == ["arm.urdf"]
    text = path.read_text(encoding="utf-8")
    assert "xacro" not in text
    assert "$" not in text
    a, b = load_robot(path), robot_from_dh(POLAR, parameters=VALUES, base_placement=TURNED)
    assert np.array_equal(pose(a, [1, 2, 3]), pose(b, [1, 2, 3]))
    assert (a.tool, a.joint_names) == ("tool", ("q1", "q2", "q3"))
    assert dict(a.parameters) == {}


def test_the_file_says_continuous_without_limits_and_1000_where_one_is_missing(tmp_path):
    path = dh_to_urdf(DHTable(NUMBERS, lower=[None] * 3, upper=[None, 2, None]), tmp_path / "arm.urdf")
    joints = [joint for joint in ET.parse(path).getroot().iter("joint") if joint.get("type") != "fixed"]
    assert [joint.get("type") for joint in joints] == ["continuous", "revolute", "prismatic"]
    limits = [(limit.get("lower"), limit.get("upper")) for joint in joints for limit in joint.iter("limit")]
    assert limits == [("-1000.0", "2.0"), ("-1000.0", "1000.0")]
    robot = load_robot(path)
    assert robot.lower.tolist() == [-inf, -1000, -1000]
    assert robot.max_velocity.tolist() == [inf] * 3


@pytest.mark.parametrize(("lower", "upper", "written"), [(5000, None, (5000, 6000)), (None, -5000, (-6000, -5000))])
def test_limits_beyond_1000_stay_in_order(tmp_path, lower, upper, written):
    robot = load_robot(dh_to_urdf(DHTable([("P", 0, 0, 0, 0)], lower=[lower], upper=[upper]), tmp_path / "arm.urdf"))
    assert (robot.lower[0], robot.upper[0]) == written


def test_the_file_is_replaced_as_a_whole(tmp_path):
    path = dh_to_urdf(NUMBERS, tmp_path / "arm.urdf")
    before = path.read_text(encoding="utf-8")
    with pytest.raises(InputError):
        dh_to_urdf(POLAR, path)
    assert path.read_text(encoding="utf-8") == before
    dh_to_urdf(NUMBERS[:1], path)
    assert load_robot(path).nv == 1


def test_a_folder_that_is_not_there_is_an_input_error(tmp_path):
    with pytest.raises(InputError, match="there is no folder"):
        dh_to_urdf(NUMBERS, tmp_path / "nowhere" / "arm.urdf")
    with pytest.raises(InputError, match="it is a folder"):
        dh_to_urdf(NUMBERS, tmp_path)


def test_more_joints_than_can_be_computed_with_are_refused():
    with pytest.raises(InputError, match="at most 128"):
        robot_from_dh([("R", 0.1, 0, 0, 0)] * 129)


# --- what it looks like


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_rods_lead_from_joint_to_joint(convention):
    rows = [("R", 0.3, pi / 2, 0.4, 0), ("R", -0.5, 0.3, -0.2, 0.5)]
    tool = homogeneous(np.eye(3), [0.1, 0.2, -0.3])
    robot = robot_from_dh(rows, convention=convention, base_placement=TURNED, tool_placement=tool)
    q = np.array([0.4, -0.7])
    visuals = pin.buildGeomFromUrdfString(robot.model, robot.urdf, pin.GeometryType.VISUAL)
    data = visuals.createData()
    pin.forwardKinematics(robot.model, robot.data, q)
    pin.updateGeometryPlacements(robot.model, robot.data, visuals, data)
    rods = []
    for shape, T in zip(visuals.geometryObjects, data.oMg, strict=True):
        if hasattr(shape.geometry, "halfLength"):
            half = np.array([0, 0, shape.geometry.halfLength])
            rods.append([T.act(-half), T.act(half)])
    half = "z" if convention == "standard" else "x"
    corners = ["base", "link0", f"link1_{half}", "link1", f"link2_{half}", "link2", "tool"]
    points = [forward_kinematics(robot, q, frame=frame).translation for frame in corners]
    for start, end in pairwise(points):
        assert any(
            np.allclose(rod, [start, end], atol=1e-5) or np.allclose(rod, [end, start], atol=1e-5) for rod in rods
        )


def test_every_joint_is_visible_and_a_slide_reaches_its_sleeve(tmp_path):
    rows = [("R", 0, 0, 0, 0), ("P", 0, 0, 0.2, 0)]
    root = ET.parse(dh_to_urdf(DHTable(rows, lower=[None, -0.3], upper=[None, 0.7]), tmp_path / "arm.urdf")).getroot()
    shapes = {link.get("name"): [s.find("geometry")[0] for s in link.iter("visual")] for link in root.iter("link")}
    assert [s.tag for s in shapes["link1_z"]] == ["cylinder"]
    assert [s.tag for s in shapes["link1"]] == ["box"]
    assert [float(s.get("length")) for s in shapes["link2_z"]] == [1.0]  # 0.2 + 0.7 behind its frame, 0.1 before it
    assert [o.get("xyz") for o in root.iterfind("link[@name='link2_z']/visual/origin")] == ["0 0 -0.4"]
    assert [s.tag for s in shapes["tool"]] == ["sphere"]


@pytest.mark.parametrize(("typed", "meant"), [(1.5708, pi / 2), (-0.785, -pi / 4), (3.14159, pi), (2.0944, 2 * pi / 3)])
def test_an_angle_printed_with_three_decimals_or_more_is_the_multiple_of_pi_that_it_rounds(typed, meant):
    rows, exact = [("R", 0.2, typed, 0, typed), ("R", "l", 0, 0, 0)], [("R", 0.2, meant, 0, meant), ("R", "l", 0, 0, 0)]
    robot = robot_from_dh(rows, parameters={"l": 0.3})
    q = [0.3, -0.4]
    expected = forward_kinematics(robot_from_dh(exact, parameters={"l": 0.3}), q).homogeneous
    assert forward_kinematics(robot, q).homogeneous == pytest.approx(expected, abs=1e-15)
    assert f"alpha of row 1 is {typed}, which is read as" in robot.warnings[0]
    assert robot.with_parameters({"l": 0.5}).warnings == robot.warnings
    assert formulas(robot, PositionTask()).cleaned == 0


@pytest.mark.parametrize("angle", [1.5707, 1.57, 1.58, 0.5, 1.570801, pi / 2, 0.0001])
def test_an_angle_that_rounds_no_multiple_of_pi_stays(angle):
    robot = robot_from_dh([("R", 0.2, angle, 0, angle)])
    assert robot.warnings == ()
    assert robot.joints[2].rpy[0] == angle
