"""Every kind of joint against a product of matrices written here and against yourdfpy; locked joints, bases, tips."""

from math import inf, nan, pi

import numpy as np
import pinocchio as pin
import pytest
from hypothesis import given, strategies as st
from joint_kinds import KINDS, mimic, own_pose, urdf, values_of
from scipy.spatial.transform import Rotation

import robotics1 as r1
from robotics1 import InputError, RobotFileError, UnknownNameError, forward_kinematics, frame_jacobian, load_robot

BEYOND_YOURDFPY = ("floating", "planar", "mimic of mimic", "long axes")  # it takes 1 m along (0, -2, 0) as 2 m


@pytest.fixture
def load(tmp_path):
    def from_text(text, **options):
        path = tmp_path / "arm.urdf"
        path.write_text(text, encoding="utf-8")
        return load_robot(path, **options)

    return from_text


def somewhere(robot, seed):
    step = np.random.default_rng(seed).uniform(-1.4, 1.4, robot.nv)
    return pin.integrate(robot.model, pin.neutral(robot.model), step)


def pose(robot, q, frame=None):
    return forward_kinematics(robot, q, frame=frame).homogeneous


# --- every kind


@pytest.mark.parametrize(("text", "nq", "nv"), KINDS.values(), ids=KINDS)
def test_a_pose_is_the_product_of_origins_and_motions(load, text, nq, nv):
    robot = load(text)
    assert (robot.nq, robot.nv) == (nq, nv)
    for seed in range(4):
        q = somewhere(robot, seed)
        for link in robot.frame_names:
            assert pose(robot, q, link) == pytest.approx(own_pose(text, link, values_of(robot, q)), abs=1e-13)


@pytest.mark.parametrize(("text", "nq", "nv"), KINDS.values(), ids=KINDS)
def test_a_jacobian_is_the_derivative_of_the_pose(load, text, nq, nv):
    robot = load(text)
    q, h = somewhere(robot, 5), 4e-6  # truncation and rounding are about 2e-11
    J = frame_jacobian(robot, q)
    assert J.shape == (6, nv)
    R = forward_kinematics(robot, q).rotation
    for column, d in zip(J.T, np.eye(nv), strict=True):
        ahead, back = (forward_kinematics(robot, pin.integrate(robot.model, q, s * h * d)) for s in (1, -1))
        assert column[:3] == pytest.approx((ahead.translation - back.translation) / (2 * h), abs=1e-9)
        turn = pin.log3(ahead.rotation @ R.T) - pin.log3(back.rotation @ R.T)
        assert column[3:] == pytest.approx(turn / (2 * h), abs=1e-9)


@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind not in BEYOND_YOURDFPY])
def test_an_independent_parser_finds_the_same_pose(load, kind):
    import yourdfpy

    robot = load(KINDS[kind][0])
    other = yourdfpy.URDF.load(str(robot.path), load_meshes=False, load_collision_meshes=False)
    q = somewhere(robot, 3)
    other.update_cfg(dict(zip(robot.joint_names, q, strict=True)))
    for link in robot.frame_names:
        assert pose(robot, q, link) == pytest.approx(other.get_transform(link, "base"), abs=1e-13)


LIMITS = {
    "revolute": ([-1.5, -1.5], [2, 2], [3, 3], [4, 4]),
    "continuous": ([-inf, -inf], [inf, inf], [inf, inf], [inf, inf]),
    "mixed": ([-inf, -1.5, -1.5], [inf, 2, 2], [inf, 3, 3], [inf, 4, 4]),
    "fixed": ([], [], [], []),
    "leader after its follower": ([-1.5, -1.5], [2, 2], [3, 3], [4, 4]),
    "mimic of mimic": ([-0.65], [1.55 / 3], [1], [4]),  # the last follower is −3 a + 0.05, in [−1.5, 2]
}


@pytest.mark.parametrize(("kind", "limits"), LIMITS.items())
def test_limits_are_those_of_the_joints_with_a_coordinate(load, kind, limits):
    robot = load(KINDS[kind][0])
    found = robot.lower, robot.upper, robot.max_velocity, robot.max_effort
    assert [limit.tolist() for limit in found] == [pytest.approx(limit, abs=1e-15) for limit in limits]


PLANAR = '<robot name="p"><link name="base"/><link name="a"/><joint name="a" type="planar">{}{}</joint></robot>'
ENDS = '<parent link="base"/><child link="a"/>'


@pytest.mark.parametrize("axis", ['<axis xyz="0 0 1"/>', '<axis xyz="0 0 2"/>', ""])
def test_a_planar_joint_moves_in_its_xy_plane(load, axis):
    robot = load(PLANAR.format(ENDS, axis))
    T = forward_kinematics(robot, [0.3, -0.2, np.cos(0.7), np.sin(0.7)])
    assert T.translation == pytest.approx([0.3, -0.2, 0], abs=1e-15)
    assert pin.log3(T.rotation) == pytest.approx([0, 0, 0.7], abs=1e-14)


@pytest.mark.parametrize("axis", ["1 0 0", "0 1 0", "0 0 -1", "0.1 0 1"])
def test_a_planar_joint_in_another_plane_is_refused(load, axis):
    with pytest.raises(RobotFileError, match=f"planar about '{axis}'; only '0 0 1' can be read"):
        load(PLANAR.format(ENDS, f'<axis xyz="{axis}"/>'))


# --- followers


BRANCHES = {
    "one follower": (("a", "revolute", "base", mimic("z", -2, 0.3)), ("z", "revolute", "base")),
    "followers of two": (
        ("a", "revolute", "base", mimic("b")),
        ("b", "revolute", "base"),
        ("b1", "revolute", "b", mimic("c", 0.5)),
        ("c", "revolute", "base"),
        ("c1", "prismatic", "c", mimic("c2", 2)),
        ("c2", "revolute", "c"),
    ),
    "deep": (
        ("a", "fixed", "base"),
        ("a1", "revolute", "a"),
        ("a2", "revolute", "a1", mimic("y")),
        ("b", "fixed", "base"),
        ("x", "revolute", "b", mimic("y", -1)),
        ("y", "prismatic", "b"),
    ),
}


@pytest.mark.parametrize("joints", BRANCHES.values(), ids=BRANCHES)
def test_a_follower_whose_name_sorts_before_its_leader_in_another_branch_follows(load, joints):
    text = urdf(*joints)
    robot = load(text)
    assert set(robot.joint_names) == {joint[0] for joint in joints if joint[1] != "fixed" and "mimic" not in joint[-1]}
    q = somewhere(robot, 1)
    for name, *_ in joints:
        assert pose(robot, q, name) == pytest.approx(own_pose(text, name, values_of(robot, q)), abs=1e-13)


# --- locked joints

LOCKABLE = urdf(
    ("a", "revolute", "base"),
    ("b", "prismatic", "a", "<axis xyz='0 0 2'/>"),
    ("c", "continuous", "b", "<axis xyz='3 0 4'/>"),
    ("d", "revolute", "c", mimic("a", 0.5, 0.1)),
    ("e", "prismatic", "d", mimic("d", -1, 0.2)),
    ("f", "fixed", "e", mimic("a", 2, 1)),
    ("tool", "fixed", "f"),
)


@pytest.mark.parametrize("names", ["a", "b", "c", "ab", "ca", "abc"])
def test_a_locked_robot_is_the_free_one_at_these_values(load, names):
    free = load(LOCKABLE)
    values = dict(zip(free.joint_names, [0.4, -0.3, 2.1], strict=True))
    locked = load(LOCKABLE, locked={name: values[name] for name in names})
    assert locked.joint_names == tuple(name for name in "abc" if name not in names)
    q = [values[name] for name in locked.joint_names]
    for link in ("a", "b", "c", "d", "e", "f", "tool"):
        assert pose(locked, q, link) == pytest.approx(pose(free, list(values.values()), link), abs=1e-13)


@pytest.mark.parametrize("name", ["d", "tool", "f"])
def test_a_follower_and_a_fixed_joint_cannot_be_locked(load, name):
    with pytest.raises(InputError, match=f"joint '{name}' cannot be locked"):
        load(LOCKABLE, locked={name: 0.0})


def test_an_unknown_locked_joint_lists_the_moving_ones(load):
    with pytest.raises(UnknownNameError, match="no joint named 'x'") as caught:
        load(LOCKABLE, locked={"x": 0.0})
    assert set("abc") <= set(caught.value.candidates)


@pytest.mark.parametrize("value", [nan, inf, "up", None, [1, 2], 1e19])
def test_a_locked_value_is_a_finite_number(load, value):
    with pytest.raises(InputError, match="locked joint 'a'"):
        load(LOCKABLE, locked={"a": value})


MOBILE = urdf(
    ("chassis", "planar", "base", '<axis xyz="0 0 1"/>'),
    ("a", "revolute", "chassis"),
    ("carried", "floating", "a"),
    ("tool", "prismatic", "carried"),
)
NUMBER = st.floats(-10, 10)


@given(st.tuples(NUMBER, NUMBER, NUMBER), st.tuples(NUMBER, NUMBER, NUMBER), st.tuples(NUMBER, NUMBER, NUMBER))
def test_a_locked_planar_or_floating_joint_stands_where_it_is_put(planar, xyz, turn):
    R = Rotation.from_rotvec(turn)
    T_planar, T_floating = np.eye(4), np.eye(4)
    T_planar[:3, :3], T_planar[:2, 3] = Rotation.from_rotvec([0, 0, planar[2]]).as_matrix(), planar[:2]
    T_floating[:3, :3], T_floating[:3, 3] = R.as_matrix(), xyz
    moved = {"chassis": T_planar, "carried": T_floating, "a": 0.3, "tool": -0.2}
    for carried in (T_floating, pin.SE3(T_floating), [*xyz, *R.as_quat()]):
        robot = load_robot(MOBILE, locked={"chassis": planar, "carried": carried})
        assert robot.joint_names == ("a", "tool")
        for link in ("chassis", "a", "carried", "tool"):
            assert pose(robot, [0.3, -0.2], link) == pytest.approx(own_pose(MOBILE, link, moved), abs=1e-12)


def test_a_joint_of_several_degrees_of_freedom_locked_at_0_stands_where_it_is_drawn(load):
    robot, still = load(MOBILE, locked={"chassis": 0, "carried": 0.0}), load(MOBILE)
    q = pin.neutral(still.model)
    assert robot.nq == robot.nv == 2
    assert pose(robot, [0, 0]) == pytest.approx(pose(still, q), abs=1e-14)


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("chassis", 1.0, r"\[x, y, theta\] of a planar joint, or 0"),
        ("chassis", [1, 2], r"must have shape \(3,\)"),
        ("chassis", [1, nan, 2], "must be finite"),
        ("chassis", np.eye(4), r"must have shape \(3,\)"),
        ("carried", [0, 0, 0], r"\[x, y, z, qx, qy, qz, qw\] of a floating joint"),
        ("carried", [0, 0, 0, 0, 0, 0, 2], "must be a quaternion .x, y, z, w. of length 1; its length is 2"),
        ("carried", [0, 0, 0, 0, 0, 0, 0], "must be a quaternion .x, y, z, w. of length 1"),
        ("carried", 2 * np.eye(4), "must have the last row"),
        ("carried", np.diag([1, 1, -1, 1]), "is no rotation"),
        ("carried", "up", "must be an array of real numbers"),
        ("carried", [1e300, 0, 0, 0, 0, 0, 1], r"at most 1e\+18"),
        ("a", [0.1], "locked joint 'a'"),
        ("a", 1e300, r"at most 1e\+18"),
    ],
)
def test_a_locked_value_of_another_form_says_what_would_be_right(load, name, value, message):
    with pytest.raises(InputError, match=message):
        load(MOBILE, locked={name: value})


def test_an_unknown_locked_joint_lists_planar_and_floating_ones_too(load):
    with pytest.raises(UnknownNameError) as caught:
        load(MOBILE, locked={"x": 0})
    assert set(caught.value.candidates) == {"chassis", "a", "carried", "tool"}


# --- bases

TREE = urdf(
    ("stand", "fixed", "base"),
    ("table", "fixed", "stand"),
    ("a", "revolute", "stand"),
    ("b", "prismatic", "a"),
    ("tool", "fixed", "b"),
    ("other", "revolute", "base"),
)


def test_a_base_fixed_to_the_root_gives_the_world_its_axes(load):
    free, based = load(TREE, tool="tool"), load(TREE, base="table", tool="tool")
    assert based.joint_names == free.joint_names
    q = somewhere(free, 2)
    T_table = pose(free, q, "table")
    for link in ("base", "table", "stand", "tool", "other"):
        assert T_table @ pose(based, q, link) == pytest.approx(pose(free, q, link), abs=1e-13)


def test_the_root_as_base_changes_nothing(load):
    free, based = load(TREE, tool="tool"), load(TREE, base="base", tool="tool")
    q = somewhere(free, 2)
    assert pose(based, q) == pytest.approx(pose(free, q), abs=1e-14)


def test_of_a_moving_base_its_subtree_is_kept(load):
    free, based = load(TREE, tool="tool"), load(TREE, base="a")
    assert (based.joint_names, based.frame_names, based.tool) == (("b",), ("a", "b", "tool"), "tool")
    q = dict(zip(free.joint_names, somewhere(free, 2), strict=True))
    assert pose(free, list(q.values()), "a") @ pose(based, [q["b"]]) == pytest.approx(
        pose(free, list(q.values())), abs=1e-13
    )


def test_a_tool_beside_the_base_is_refused(load):
    with pytest.raises(InputError, match="'other' does not hang from the base 'a'"):
        load(TREE, base="a", tool="other")


def test_an_unknown_base_lists_the_links(load):
    with pytest.raises(UnknownNameError, match="no link named 'stnd'; did you mean 'stand'") as caught:
        load(TREE, base="stnd")
    assert "table" in caught.value.candidates


def test_a_follower_whose_leader_is_below_another_base_is_refused(load):
    text = urdf(("a", "revolute", "base"), ("b", "revolute", "a", mimic("a")), ("c", "revolute", "b"))
    assert load(text, base="b").joint_names == ("c",)
    with pytest.raises(InputError, match="joint 'b' mimics 'a', which does not hang from the base 'a'"):
        load(text, base="a")


# --- tips


def test_each_tip_can_be_the_tool_and_another_is_reached_by_its_name(load):
    q = [0.3, 0.2, 0.1]
    for tool in ("tool", "table", "other", "a"):
        robot = load(TREE, tool=tool)
        assert robot.tool == tool
        assert pose(robot, q) == pytest.approx(pose(robot, q, frame=tool), abs=0)


def test_without_a_tool_the_tip_with_the_usual_name_is_meant(load):
    assert load(TREE).tool == "tool"
    robot = load(TREE.replace('"tool"', '"hand"'))
    assert robot.tool is None
    with pytest.raises(InputError, match="the tips are 'other', 'hand', 'table'"):
        forward_kinematics(robot, [0, 0, 0])


def test_an_angle_and_a_whole_turn_more_are_one_place_of_a_continuous_joint(load):
    robot = load(KINDS["continuous"][0])
    assert pose(robot, [0.3, -1]) == pytest.approx(pose(robot, [0.3 + 2 * pi, -1 - 2 * pi]), abs=1e-14)


@pytest.mark.parametrize("kind", ["revolute", "continuous"])
def test_a_follower_with_the_same_limits_or_none_leaves_those_of_its_leader_alone(load, kind):
    robot = load(urdf(("a", "revolute", "base"), ("b", kind, "a", mimic("a")), ("tool", "fixed", "b")))
    assert (robot.lower.tolist(), robot.upper.tolist()) == ([-1.5], [2.0])


# --- joints of several coordinates beside what wants one number a joint


@pytest.fixture
def floating(load):
    return load(
        '<robot name="f"><link name="base"/><link name="body"/><link name="tool"/>'
        '<joint name="m" type="floating"><parent link="base"/><child link="body"/></joint>'
        '<joint name="end" type="fixed"><parent link="body"/><child link="tool"/><origin xyz="0.5 0 0"/></joint>'
        "</robot>"
    )


def test_a_floating_joint_has_three_rates_in_metres_and_three_in_radians(floating):
    assert floating.units.tolist() == [0.5, 0.5, 0.5, 1, 1, 1]
    panel = r1.plots.plot_ellipses(floating, "position:xy", floating.configuration("zero"))
    *_, velocity, force = (line.get_xydata() - [0.5, 0] for line in panel.lines)
    longest, shortest = np.hypot(0.5, 0.5), 0.5  # J J^T of a point at 0.5 m, slides in reaches: diag(0.25, 0.5)
    assert np.ptp(velocity, axis=0)[1] / np.ptp(velocity, axis=0)[0] == pytest.approx(longest / shortest)
    assert np.ptp(force, axis=0)[0] / np.ptp(force, axis=0)[1] == pytest.approx(longest / shortest)


def test_a_motion_of_one_number_a_joint_is_refused_by_pages_and_plots(floating):
    motion = r1.cubic(np.zeros(6), np.ones(6), 1.0)
    for draw in (r1.animate, lambda robot, motion: r1.plots.plot_trajectory(motion, robot=robot)):
        with pytest.raises(InputError, match="only arms of revolute and prismatic joints"):
            draw(floating, motion)
