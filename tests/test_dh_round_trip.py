"""A DH table made a robot, and the robot's table: the rows come back as they were, and no half turn is left over."""

from math import pi

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import assume, given, settings, strategies as st

import robotics1 as r1

LENGTHS = st.sampled_from([0.0, 0.3, -0.4]) | st.floats(-1, 1).map(lambda x: round(x, 3) + 0.0)
TURNS = st.sampled_from([0.0, pi / 2, -pi / 2, pi, pi / 4, -3 * pi / 4, pi / 6]) | st.floats(-3.1, 3.1).map(
    lambda x: round(x, 3)
)
RIGHT = st.sampled_from([0.0, pi / 2, -pi / 2, pi / 4, -pi / 3]) | st.floats(-1.5, 1.5).map(
    lambda x: round(x, 3)
)  # |θ| ≤ π/2
KIND = st.sampled_from("RP")
CONVENTIONS = st.sampled_from(["standard", "modified"])
ROW = st.tuples(KIND, LENGTHS, TURNS, LENGTHS, TURNS)
CANONICAL = st.tuples(KIND, LENGTHS, TURNS, LENGTHS, RIGHT)
PLACEMENTS = st.none() | st.tuples(st.lists(st.floats(-2, 2), min_size=6, max_size=6)).map(
    lambda drawn: pin.SE3(pin.exp3(np.array(drawn[0][:3])), np.array(drawn[0][3:]))
)


def table_of(rows, **options):
    robot = r1.robot_from_dh(rows, **options)
    return r1.dh.urdf_to_dh(robot, convention=options.get("convention", "standard"))


def same_rows(found, rows):
    for one, two in zip(found, rows, strict=True):
        assert one[0] == two[0]
        assert one[1:] == pytest.approx(two[1:], abs=1e-12)


def matrix(T):
    return np.eye(4) if T is None else T.homogeneous


@given(st.lists(CANONICAL, max_size=5), ROW, CONVENTIONS, PLACEMENTS)
@settings(max_examples=60)
def test_rows_come_back_as_they_were_where_theta_is_at_most_a_right_angle_before_the_last(rows, last, convention, tool):
    assume(tool is None or abs(tool.rotation[0, 0] - 1) > 1e-6)  # a screw along x belongs to the last row
    rows = [*rows, last]
    table = table_of(rows, convention=convention, tool_placement=tool)
    same_rows(table.rows, rows)
    assert matrix(table.base_placement) == pytest.approx(np.eye(4), abs=1e-12)
    assert matrix(table.tool_placement) == pytest.approx(matrix(tool), abs=1e-12)


@given(st.lists(ROW, min_size=1, max_size=6), CONVENTIONS)
@settings(max_examples=60)
def test_the_table_of_a_table_without_tool_placement_has_none(rows, convention):
    table = table_of(rows, convention=convention)
    assert matrix(table.tool_placement) == pytest.approx(np.eye(4), abs=1e-9)
    assert table.residual < 1e-11
    q = np.linspace(-1, 1, len(rows))
    robot = r1.robot_from_dh(rows, convention=convention)
    assert table.pose(q).homogeneous == pytest.approx(r1.forward_kinematics(robot, q).homogeneous, abs=1e-11)


@given(st.lists(ROW, min_size=1, max_size=5), CONVENTIONS, PLACEMENTS, PLACEMENTS)
def test_a_second_round_trip_changes_nothing(rows, convention, base, tool):
    first = table_of(rows, convention=convention, base_placement=base, tool_placement=tool)
    again = r1.dh.urdf_to_dh(r1.robot_from_dh(first.rows, **first.options), convention=convention)
    same_rows(again.rows, first.rows)
    assert matrix(again.base_placement) == pytest.approx(matrix(first.base_placement), abs=1e-11)
    assert matrix(again.tool_placement) == pytest.approx(matrix(first.tool_placement), abs=1e-11)


@pytest.mark.parametrize("theta", [3 * pi / 4, -3 * pi / 4, pi, 2.0, -2.0, pi / 2, -pi / 2])
@pytest.mark.parametrize("alpha", [pi / 4, -pi / 4, 0.0, pi, pi / 2])
@pytest.mark.parametrize("a", [0.3, -0.3, 0.0])
def test_a_row_of_any_angle_is_its_own_table(a, alpha, theta):
    rows = [("R", a, alpha, 0.1, theta)]
    table = table_of(rows)
    same_rows(table.rows, rows)
    assert matrix(table.tool_placement) == pytest.approx(np.eye(4), abs=1e-14)


def test_a_written_file_has_the_table_that_it_was_written_from(tmp_path):
    rows = [("R", 0.3, pi / 4, 0.1, pi / 4), ("P", -0.2, -pi / 2, 0.3, -pi / 3), ("R", 0.3, pi / 4, 0.1, 3 * pi / 4)]
    robot = r1.load_robot(r1.dh.dh_to_urdf(rows, tmp_path / "arm.urdf"))
    same_rows(r1.dh.urdf_to_dh(robot).rows, rows)


def test_a_tool_turned_by_a_half_turn_in_a_file_of_other_frames_is_reached_by_the_last_row():
    text = """<robot name="a"><link name="base"/><link name="arm"/><link name="tool"/>
    <joint name="j" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/></joint>
    <joint name="f" type="fixed"><parent link="arm"/><child link="tool"/>
    <origin xyz="-0.4 0 0" rpy="-1.5707963267948966 0 3.141592653589793"/></joint></robot>"""
    table = r1.dh.urdf_to_dh(r1.load_robot(text))
    assert matrix(table.tool_placement) == pytest.approx(np.eye(4), abs=1e-14)
    assert table.residual < 1e-14


@given(st.lists(ROW, min_size=1, max_size=5), CONVENTIONS, PLACEMENTS, st.floats(0.1, 3))
@settings(max_examples=30)
def test_a_table_is_a_robot_with_its_convention_placements_and_limits(rows, convention, tool, reach):
    robot = r1.robot_from_dh(
        rows, convention=convention, tool_placement=tool, lower=[-reach] * len(rows), upper=[reach] * len(rows)
    )
    again = r1.robot_from_dh(r1.dh.urdf_to_dh(robot, convention=convention))
    q = np.linspace(-0.1, 0.1, len(rows))
    T = r1.forward_kinematics(robot, q).homogeneous
    assert r1.forward_kinematics(again, q).homogeneous == pytest.approx(T, abs=1e-9)
    assert (again.lower.tolist(), again.upper.tolist()) == (robot.lower.tolist(), robot.upper.tolist())


@given(st.sampled_from(["1.5708", "1.57", "1.570796", "-0.7854"]), st.floats(-2, 2))
@settings(max_examples=20)
def test_a_table_of_rounded_angles_is_the_robot_of_its_file(angle, q):
    """T of the table is T of the file to 1e-12, and not that of the multiple of π/12 that the file rounds."""
    text = f"""<robot name="r"><link name="a"/><link name="b"/><link name="c"/>
    <joint name="q1" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint>
    <joint name="q2" type="continuous"><parent link="b"/><child link="c"/><origin xyz="1 0 0" rpy="{angle} 0 0"/>
    <axis xyz="0 0 1"/></joint></robot>"""
    robot = r1.load_robot(text)
    table = r1.dh.urdf_to_dh(robot)
    again = r1.robot_from_dh(table)
    found = r1.forward_kinematics(again, [0.3, q]).homogeneous
    for T in (table.pose([0.3, q]), r1.forward_kinematics(robot, [0.3, q])):
        assert found == pytest.approx(T.homogeneous, abs=1e-12)


@pytest.mark.parametrize("option", [{"convention": "modified"}, {"lower": [0]}, {"tool_placement": np.eye(4)}])
def test_a_table_holds_its_options(option):
    with pytest.raises(r1.InputError, match="a DHTable holds its options"):
        r1.robot_from_dh(r1.dh.DHTable([("R", 1, 0, 0, 0)]), **option)
