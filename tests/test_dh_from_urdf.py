from math import pi

import numpy as np
import pytest
from arms import ARMS, arm, random_q
from dh_forms import conventions, dh_pose, dh_rows, homogeneous, placements, rotation, seeds
from hypothesis import given, settings, strategies as st

from robotics1 import InputError, UnknownNameError, forward_kinematics, load_robot, robot_from_dh
from robotics1.dh import DHTable, dh_to_urdf, urdf_to_dh

TOOLS = {"two_tips": "camera"}  # which frame, where there is no tool


def pose(robot, q, frame=None):
    return forward_kinematics(robot, q, frame=frame).homogeneous


def assert_same_kinematics(robot, table, seed, tool=None):
    """The book's matrices, the table's product and the robot built again agree with the robot."""
    again = robot_from_dh(table.rows, **table.options)
    for q in np.random.default_rng(seed).uniform(-3, 3, (3, robot.nv)):
        T = pose(robot, q, tool)
        base, end = table.base_placement.homogeneous, table.tool_placement.homogeneous
        assert dh_pose(table.rows, q, table.convention, base, end) == pytest.approx(T, abs=1e-12)
        assert table.pose(q).homogeneous == pytest.approx(T, abs=1e-12)
        assert pose(again, q) == pytest.approx(T, abs=1e-12)
    assert table.residual < 1e-12


def chain(joints, tool=((0, 0, 0), (0, 0, 0))):
    """The URDF of a serial chain: joints (type, xyz, rpy, axis), each behind a fixed link turned by rpy."""

    def text(values):
        return " ".join(map(repr, values))

    parts, last = ['<robot name="chain"><link name="b"/>'], "b"
    for i, (kind, xyz, rpy, axis) in enumerate(joints):
        parts.append(
            f'<joint name="f{i}" type="fixed"><parent link="{last}"/><child link="f{i}"/>'
            f'<origin xyz="{text(xyz)}" rpy="{text(rpy)}"/></joint><link name="f{i}"/>'
            f'<joint name="j{i}" type="{kind}"><parent link="f{i}"/><child link="l{i}"/><axis xyz="{text(axis)}"/>'
            f'<limit lower="-4" upper="4" velocity="1" effort="1"/></joint><link name="l{i}"/>'
        )
        last = f"l{i}"
    parts.append(
        f'<joint name="t" type="fixed"><parent link="{last}"/><child link="tip"/>'
        f'<origin xyz="{text(tool[0])}" rpy="{text(tool[1])}"/></joint><link name="tip"/></robot>'
    )
    return "".join(parts)


# --- round trips


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_every_arm_has_a_table_with_its_kinematics(name, convention):
    robot, tool = arm(name), TOOLS.get(name)
    if robot.nq != robot.nv or any("Mimic" in joint.shortname() for joint in robot.model.joints):
        pytest.skip("not a chain of revolute and prismatic joints")
    table = urdf_to_dh(robot, tool=tool, convention=convention)
    again = robot_from_dh(table.rows, **table.options)
    joints = [robot.joint_names.index(joint) for joint in table.joint_names]
    for seed in range(5):
        q = random_q(robot, seed)
        T = pose(robot, q, tool)
        assert table.pose(q[joints]).homogeneous == pytest.approx(T, abs=1e-12)
        assert pose(again, q[joints]) == pytest.approx(T, abs=1e-12)
    assert table.residual < 1e-13
    assert again.lower == pytest.approx(robot.lower[joints])
    assert again.upper == pytest.approx(robot.upper[joints])


@given(dh_rows, conventions, conventions, placements, placements, seeds)
@settings(max_examples=150)
def test_a_table_of_either_convention_comes_back_with_the_same_kinematics(rows, first, second, base, tool, seed):
    robot = robot_from_dh(rows, convention=first, base_placement=base, tool_placement=tool)
    assert_same_kinematics(robot, urdf_to_dh(robot, convention=second), seed)


numbers = st.sampled_from([0.0, 0.0, 0.3, -0.5]) | st.floats(-1, 1).map(lambda x: round(x, 3))
turns = st.sampled_from([0.0, pi / 2, -pi / 2, pi, 0.5])
axes = st.sampled_from([(0, 0, 1), (0, 0, -1), (1, 0, 0), (0, -1, 0), (-1, 0, 0), (0, 0.6, 0.8), (0.48, 0.6, -0.64)])
triple = st.tuples(numbers, numbers, numbers)
turned = st.tuples(turns, turns, turns)
joints = st.tuples(st.sampled_from(["revolute", "prismatic", "continuous"]), triple, turned, axes)


@given(st.lists(joints, min_size=1, max_size=7), st.tuples(triple, turned), conventions, seeds)
@settings(max_examples=150)
def test_any_chain_of_fixed_and_moving_joints_has_a_table(tmp_path_factory, chained, tool, convention, seed):
    path = tmp_path_factory.mktemp("chain") / "arm.urdf"
    path.write_text(chain(chained, tool), encoding="utf-8")
    robot = load_robot(path)
    table = urdf_to_dh(robot, convention=convention)
    assert table.joint_names == robot.joint_names
    assert_same_kinematics(robot, table, seed)


def test_the_written_file_of_a_found_table_has_its_kinematics(tmp_path):
    robot = arm("spatial")
    table = urdf_to_dh(robot)
    again = load_robot(dh_to_urdf(table, tmp_path / "arm.urdf"))
    q = random_q(robot, 3)
    assert pose(again, q) == pytest.approx(pose(robot, q), abs=1e-12)


# --- the tables of the books

up = pi / 2


@pytest.mark.parametrize(
    ("name", "rows"),
    [
        ("planar_2r", [("R", 1.2, 0, 0, 0), ("R", 0.8, 0, 0, 0)]),
        ("planar_3r", [("R", 0.5, 0, 0, 0), ("R", 0.4, 0, 0, 0), ("R", 0.3, 0, 0, 0)]),
        ("anthropomorphic", [("R", 0, up, 0.4, 0), ("R", 0.5, 0, 0, 0), ("R", 0.35, -up, 0, 0)]),
        ("prr", [("P", 0, -up, 0, 0), ("R", 0.6, 0, 0, -up), ("R", 0.4, 0, 0, 0)]),
        ("cylindrical", [("P", 0, 0, 0, 0), ("R", 0, up, 0, up), ("P", 0, -up, 0, 0)]),
    ],
)
def test_simple_arms_have_the_table_of_the_book(name, rows):
    assert [tuple(row) for row in urdf_to_dh(arm(name)).rows] == rows


def test_s_r_s_arm_has_zero_a_right_twists_and_its_lengths_as_d():
    table = urdf_to_dh(arm("redundant"))
    assert [row.a for row in table.rows] == [0] * 7
    assert [row.d for row in table.rows] == [0.36, 0, 0.42, 0, 0.4, 0, 0.126]
    assert [abs(row.alpha) for row in table.rows] == [up] * 6 + [0]
    assert [row.theta for row in table.rows] == [0] * 7
    assert table.base_placement.isIdentity(0)
    assert table.tool_placement.isIdentity(0)


def test_modified_planar_arm_has_l1_in_its_second_row_and_l2_in_its_tool():
    table = urdf_to_dh(arm("planar_2r"), convention="modified")
    assert [tuple(row) for row in table.rows] == [("R", 0, 0, 0, 0), ("R", 1.2, 0, 0, 0)]
    assert table.tool_placement.translation.tolist() == [0.8, 0, 0]


UR5 = [
    ("R", 0, up, 0.089159, 0),
    ("R", -0.425, 0, 0, 0),
    ("R", -0.39225, 0, 0, 0),
    ("R", 0, up, 0.10915, 0),
    ("R", 0, -up, 0.09465, 0),
    ("R", 0, 0, 0.0823, 0),
]


@pytest.mark.parametrize("convention", ["standard", "modified"])
def test_the_makers_table_of_the_ur5_comes_back_as_it_is(convention):
    table = urdf_to_dh(robot_from_dh(UR5, convention=convention), convention=convention)
    if convention == "standard":
        assert [tuple(row) for row in table.rows] == UR5
        assert table.tool_placement.isIdentity(1e-14)
    assert_same_kinematics(robot_from_dh(UR5, convention=convention), table, 7)


def industrial(name):
    try:
        return load_robot(name)
    except UnknownNameError:
        pytest.skip("example-robot-data is not installed")


def test_the_panda_has_its_makers_lengths_and_right_twists():
    table = urdf_to_dh(industrial("panda"), tool="panda_link8")
    assert [row.a for row in table.rows] == pytest.approx([0, 0, 0.0825, -0.0825, 0, 0.088, 0], abs=1e-9)
    assert [row.d for row in table.rows] == pytest.approx([0.333, 0, 0.316, 0, 0.384, 0, 0.107], abs=1e-9)
    assert [row.alpha / up for row in table.rows] == pytest.approx([-1, 1, 1, -1, 1, 1, 0], abs=1e-9)
    assert table.residual < 1e-13


def test_the_ur5_of_the_file_has_its_makers_lengths():
    table = urdf_to_dh(industrial("ur5"), tool="tool0")
    assert [abs(row.a) for row in table.rows] == pytest.approx([abs(row[1]) for row in UR5], abs=1e-9)
    assert [abs(row.d) for row in table.rows] == pytest.approx([abs(row[3]) for row in UR5], abs=1e-4)
    assert table.residual < 1e-12


def test_a_tool_that_looks_down_has_the_twist_plus_pi():
    rows = [("R", 0.4, 0, 0, 0), ("R", -0.3, pi, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0.2, 0)]
    assert [tuple(row) for row in urdf_to_dh(robot_from_dh(rows)).rows] == rows


def test_a_shifted_base_stays_a_shift_and_is_not_told_as_a_turn():
    base = homogeneous(np.eye(3), [0.22, 0.14, 0.346])
    rows = [("R", 0, -up, 0, 0), ("R", 0, up, 0, 0), ("R", 0.045, -up, 0.55, 0), ("R", -0.045, up, 0, 0)]
    for convention in ("standard", "modified"):
        robot = robot_from_dh(rows, base_placement=base)
        table = urdf_to_dh(robot, convention=convention)
        assert table.base_placement.homogeneous == pytest.approx(homogeneous(np.eye(3), [0.22, 0.14, 0]), abs=0)
        assert [row.theta for row in table.rows[:-1]] == [0, 0, 0]
        assert table.rows[0].d == 0.346


@given(dh_rows, conventions)
def test_theta_is_at_most_a_right_angle_before_the_last_row(rows, convention):
    table = urdf_to_dh(robot_from_dh(rows), convention=convention)
    assert all(abs(row.theta) <= up for row in table.rows[:-1])


# --- axes that are nearly parallel


def nearly_parallel(tmp_path, tilt):
    path = tmp_path / "arm.urdf"
    path.write_text(
        chain([("revolute", (0, 0, 0), (0, 0, 0), (0, 0, 1)), ("revolute", (0, 0.5, 0), (tilt, 0, 0), (0, 0, 1))]),
        encoding="utf-8",
    )
    return load_robot(path)


def test_a_rounding_in_the_file_does_not_send_the_common_normal_far_away(tmp_path):
    table = urdf_to_dh(nearly_parallel(tmp_path, 1.8e-9))
    assert [row.d for row in table.rows] == [0, 0]
    assert table.rows[0].a == 0.5
    assert 1e-10 < table.residual < 4e-9


def test_a_tilt_is_kept_where_the_common_normal_is_not_a_thousand_arms_away(tmp_path):
    table = urdf_to_dh(nearly_parallel(tmp_path, 3.7e-3))
    assert abs(table.rows[0].d) == pytest.approx(0.5 / np.tan(3.7e-3), rel=1e-9)
    assert table.residual < 1e-11


@pytest.mark.parametrize("tilt", [3.7e-6, 7e-5, -4e-4])
def test_a_smaller_tilt_is_the_files_rounding_unless_the_tolerance_keeps_it_and_the_residual_says_so(tmp_path, tilt):
    robot = nearly_parallel(tmp_path, tilt)
    meant = urdf_to_dh(robot)
    assert [row.d for row in meant.rows] == [0, 0]
    assert meant.rows[0].a == pytest.approx(0.5, abs=1e-6)
    assert 0.1 * abs(tilt) < meant.residual < 3 * abs(tilt)
    exact = urdf_to_dh(robot, tolerance=1e-8)
    assert abs(exact.rows[0].d) == pytest.approx(0.5 / abs(tilt), rel=1e-6)
    assert exact.residual < 1e-9


def test_the_table_of_a_file_with_rounded_angles_has_no_length_beyond_the_arm():
    table = urdf_to_dh(industrial("so100"), tool="jaw")
    assert max(abs(x) for row in table.rows for x in (row.a, row.d)) < 0.2
    assert table.residual < 1e-4


# --- the unit of length


def scaled(chained, tool, unit):
    def longer(xyz):
        return tuple(unit * x for x in xyz)

    return chain([(kind, longer(xyz), rpy, axis) for kind, xyz, rpy, axis in chained], (longer(tool[0]), tool[1]))


@given(st.lists(joints, min_size=1, max_size=5), st.tuples(triple, turned), conventions, st.integers(-12, 9))
@settings(max_examples=60)
def test_the_table_does_not_depend_on_the_unit_of_length(chained, tool, convention, power):
    unit = 10.0**power
    one, other = (urdf_to_dh(load_robot(scaled(chained, tool, x)), convention=convention) for x in (1.0, unit))
    for row, again in zip(one.rows, other.rows, strict=True):
        assert again.type == row.type
        assert [again.a / unit, again.d / unit] == pytest.approx([row.a, row.d], abs=1e-12)
        assert [again.alpha, again.theta] == pytest.approx([row.alpha, row.theta], abs=1e-12)
    for T, U in ((one.base_placement, other.base_placement), (one.tool_placement, other.tool_placement)):
        assert U.translation / unit == pytest.approx(T.translation, abs=1e-12)
        assert U.rotation == pytest.approx(T.rotation, abs=1e-12)


@pytest.mark.parametrize("power", [-9, -3, 3, 9])
def test_a_written_table_comes_back_in_any_unit_of_length(power):
    rows = [(kind, a * 10.0**power, alpha, d * 10.0**power, theta) for kind, a, alpha, d, theta in UR5]
    table = urdf_to_dh(robot_from_dh(rows))
    for row, again in zip(rows, table.rows, strict=True):
        assert list(again[1:]) == pytest.approx(list(row[1:]), rel=1e-13, abs=0)
    shown = [row[2] for row in table.written_rows()[1]]
    assert [float(a) for a in shown] == pytest.approx([row[1] for row in rows], rel=1e-5)


def test_a_nearly_upright_tool_costs_nothing():
    tilted = homogeneous(rotation(0, 3e-9, 0), [0.3, 0, 0])
    robot = robot_from_dh([("R", 0.5, 0, 0, 0), ("R", 0, 0, 0, 0)], base_placement=tilted, tool_placement=tilted)
    table = urdf_to_dh(robot)
    assert max(abs(row.d) for row in table.rows) < 1e-8
    assert_same_kinematics(robot, table, 0)


# --- what is refused


@pytest.mark.parametrize("kind", ["floating", "planar"])
def test_a_joint_with_several_coordinates_is_refused_by_name(tmp_path, kind):
    path = tmp_path / "arm.urdf"
    text = chain([("revolute", (0, 0, 0), (0, 0, 0), (0, 0, 1))] * 2)
    path.write_text(text.replace('"j1" type="revolute"', f'"j1" type="{kind}"'), encoding="utf-8")
    with pytest.raises(InputError, match=r"joint 'j1' \(.*\) has no row in a DH table"):
        urdf_to_dh(load_robot(path))


def test_a_joint_that_follows_another_is_refused_by_name(tmp_path):
    path = tmp_path / "arm.urdf"
    before, after = chain([("revolute", (0.5, 0, 0), (0, 0, 0), (0, 0, 1))] * 2).split('<child link="l1"/>')
    path.write_text(f'{before}<child link="l1"/><mimic joint="j0" multiplier="-1"/>{after}', encoding="utf-8")
    with pytest.raises(InputError, match=r"joint 'j1' \(.*\) has no row in a DH table"):
        urdf_to_dh(load_robot(path))


def test_a_joint_beside_the_chain_is_left_out(tmp_path):
    text = chain([("revolute", (0, 0, 0.3), (0, 0, 0), (0, 0, 1)), ("prismatic", (0.2, 0, 0), (up, 0, 0), (0, 0, 1))])
    finger = (
        '<joint name="finger" type="revolute"><parent link="l0"/><child link="finger"/><axis xyz="1 0 0"/>'
        '<limit lower="-1" upper="2" velocity="1" effort="1"/></joint><link name="finger"/></robot>'
    )
    path = tmp_path / "arm.urdf"
    path.write_text(text.replace("</robot>", finger), encoding="utf-8")
    robot = load_robot(path, tool="tip")
    table = urdf_to_dh(robot)
    assert table.joint_names == ("j0", "j1")
    q = dict(zip(robot.joint_names, [0.0] * 3, strict=True)) | {"j0": 0.4, "j1": -0.6, "finger": 1.2}
    T = pose(robot, [q[name] for name in robot.joint_names])
    assert table.pose([0.4, -0.6]).homogeneous == pytest.approx(T, abs=1e-15)
    assert urdf_to_dh(robot, tool="finger").joint_names == ("j0", "finger")


def test_a_frame_that_no_joint_moves_has_no_table():
    with pytest.raises(InputError, match="no joint moves 'base'"):
        urdf_to_dh(arm("prr"), tool="base")


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"tool": "tol"}, UnknownNameError, "did you mean 'tool'"),
        ({"convention": "craig"}, InputError, "convention must be one of"),
        ({"tolerance": -1}, InputError, "tolerance must be a non-negative number"),
    ],
)
def test_wrong_options_say_what_would_be_right(options, error, message):
    with pytest.raises(error, match=message):
        urdf_to_dh(arm("prr"), **options)


def test_several_tips_want_a_tool():
    with pytest.raises(InputError, match="name the tool"):
        urdf_to_dh(arm("two_tips"))


# --- how it is printed


def test_the_table_is_printed_as_on_paper():
    rows = [("R", 0, up, "L1", 0), ("R", "-L2", 0, 0, 0.1), ("P", 1, -2 * pi / 3, -0.5, up)]
    table = DHTable(rows, parameters={"L1": 0.5, "L2": 0.4}, base_placement=homogeneous(np.eye(3), [0, 0, 2]))
    assert str(table).splitlines() == [
        "standard DH table",
        "i  type  a    α      d            θ",
        "1  R     0    π/2    L1           q1",
        "2  R     -L2  0      0            q2 + 0.1000",
        "3  P     1    −2π/3  q3 − 0.5000  π/2",
        "base: p = (0, 0, 2), rpy = (0, 0, 0)",
        "L1 = 0.5",
        "L2 = 0.4",
    ]


def test_a_modified_table_says_whose_a_and_alpha_it_shows():
    lines = str(urdf_to_dh(arm("planar_2r"), convention="modified")).splitlines()
    assert lines[:2] == ["modified DH table", "i  type  aᵢ₋₁    αᵢ₋₁  d  θ"]
    assert lines[3] == "2  R     1.2000  0     0  q2"
    assert lines[4] == "tool: p = (0.8000, 0, 0), rpy = (0, 0, 0)"


@pytest.mark.parametrize("ypr", [(0, 0, pi), (0, pi, 0), (pi, 0, 0)])
@pytest.mark.parametrize("last", [(0.2, 0.0), (0.0, 0.0), (0.2, pi / 2), (0.0, -pi / 2)])
def test_a_half_turn_of_the_tool_is_in_the_last_row(ypr, last):
    a, alpha = last
    rows = [("R", 0, pi / 2, 0.3, 0), ("P", 0.4, 0, 0, 0), ("R", a, alpha, 0.1, 0.2)]
    robot = robot_from_dh(rows, tool_placement=homogeneous(rotation(*ypr), np.zeros(3)))
    table = urdf_to_dh(robot)
    assert_same_kinematics(robot, table, 3)
    assert table.tool_placement.homogeneous == pytest.approx(np.eye(4), abs=1e-12)


@pytest.mark.parametrize("a", [0.2, 0.0])
def test_a_half_turn_of_the_tool_about_z_is_in_the_last_row_of_a_modified_table(a):
    rows = [("R", 0, pi / 2, 0.3, 0), ("R", a, 0.3, 0.1, 0.2)]
    half = homogeneous(rotation(pi, 0, 0), np.zeros(3))
    robot = robot_from_dh(rows, convention="modified", tool_placement=half)
    table = urdf_to_dh(robot, convention="modified")
    assert_same_kinematics(robot, table, 3)
    assert table.tool_placement.homogeneous == pytest.approx(np.eye(4), abs=1e-12)


@pytest.mark.parametrize("convention", ["standard", "modified"])
@pytest.mark.parametrize(
    ("lower", "upper"), [([4, 4], [5, 5]), ([-9, -20], [-5, -10]), ([7, 0], [7, 1]), ([-4, 3.5], [None, None])]
)
def test_an_arm_whose_limits_are_far_from_zero_has_its_table(convention, lower, upper):
    robot = robot_from_dh([("R", 1, 0.3, 0.2, 0), ("P", 0.1, 0.4, 0, 0.5)], lower=lower, upper=upper)
    read = load_robot(robot.urdf)
    table = urdf_to_dh(read, convention=convention)
    assert table.residual < 1e-12
    assert (table.lower.tolist(), table.upper.tolist()) == (read.lower.tolist(), read.upper.tolist())
