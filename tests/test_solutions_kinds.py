"""All solutions where the search once lost some: wide boxes, rows that count turns, fingers, followers, no joints."""

from math import pi

import closed_forms as cf
import numpy as np
import pytest
from arms import arm
from differences import same_rows
from drawn_arms import drawn_arm
from hypothesis import given, settings, strategies as st
from sweeps import some_of

from robotics1 import (
    FunctionTask,
    InputError,
    PlanarPoseTask,
    PoseTask,
    PositionTask,
    ik_solutions,
    load_robot,
    robot_from_dh,
    solve_ik,
)
from robotics1.ik import IKStatus

H = pi / 2
XYZ, XY = PositionTask(), PositionTask("xy")
CARTESIAN = [("P", 0, -H, 0, 0), ("P", 0, -H, 0, -H), ("P", 0, 0, 0, 0)]
RPR = [("R", 1, -H, 0, 0), ("P", 0, H, 0, 0), ("R", 1, 0, 0, 0)]
SUM = FunctionTask(lambda p, R, q: [p[0], p[1], q[0] + q[2]], 3)
SUM_IN_RADIANS = FunctionTask(lambda p, R, q: [p[0], p[1], q[0] + q[2]], 3, units=("m", "m", "rad"))
AZIMUTH = FunctionTask(lambda p, R, q: [p[0], p[1], np.arctan2(R[1, 0], R[0, 0])], 3)


def assert_no_contradiction(found):
    """What is nearest to the target is a solution where there is one, and none where there is none."""
    assert (len(found) > 0) == (found.status in (IKStatus.FINITE, IKStatus.BOUNDARY, IKStatus.INFINITE))
    assert found.complete or found.status is not IKStatus.UNREACHABLE
    assert found.within_limits.all()
    assert found.within_limits.shape == (len(found),)


# --- boxes


@pytest.mark.parametrize("size", [1e-3, 1e-2, 1.0, 60.0, 100.0, 1e4])
@pytest.mark.parametrize("part", [(0.05, 0.02, 0.015), (0.9, -0.8, 1.0), (0.0, 0.0, 0.0)])
def test_a_cartesian_robot_has_one_solution_in_a_box_of_any_size(size, part):
    """p = (q3, q2, q1)."""
    robot, target = robot_from_dh(CARTESIAN), size * np.array(part)
    found = ik_solutions(robot, XYZ, target, box=dict.fromkeys(robot.joint_names, (-size, size)), starts=8)
    assert found.status is IKStatus.FINITE
    assert found.q == pytest.approx(target[None, ::-1], abs=1e-12 * size)
    assert found.error_norm <= 1e-12 * size
    assert_no_contradiction(found)
    above, box = target + np.array([0, 0, 2 * size]), dict.fromkeys(robot.joint_names, (-size, size))
    outside = ik_solutions(robot, XYZ, above, box=box, starts=4)
    assert outside.status is IKStatus.UNREACHABLE
    assert outside.error_norm == pytest.approx(size * (1 + part[2]), rel=1e-9)
    assert_no_contradiction(outside)


@pytest.mark.parametrize("size", [1e-2, 1.0, 1e4])
@pytest.mark.parametrize("r", [1e-2, 0.3, 1.0])
def test_a_polar_robot_reaches_a_point_forwards_and_backwards_in_a_box_of_any_size(size, r):
    robot = robot_from_dh([("R", 0, H, 0, 0), ("P", 0, 0, 0, 0)])
    angle = 0.7
    target = r * size * np.array([np.sin(angle), -np.cos(angle)])
    found = ik_solutions(robot, XY, target, box={robot.joint_names[1]: (-size, size)}, starts=20)
    assert found.status is IKStatus.FINITE
    same_rows(found.q / [1, size], [[angle, r], [angle - pi, -r]], np.array([True, False]), atol=1e-7)


def test_a_near_target_in_a_wide_box_keeps_its_digits():
    """Links of a metre, a slide of ±10⁴ m, a target five metres away: x = q1 + l2 c2 + ... as in a box of ±10 m."""
    robot = robot_from_dh([("P", 0, H, 0, 0), ("R", 0, -H, 0, H), ("R", 1, 0, 0, 0), ("R", 0.5, 0, 0, 0)])
    slide = robot.joint_names[0]
    q = np.array([5.0, 0.3, 0.4, -0.7])
    task = PoseTask()
    near, wide = (
        ik_solutions(robot, task, task.value(robot, q), box={slide: (-far, far)}, starts=15) for far in (10.0, 1e4)
    )
    assert near.status is wide.status is IKStatus.FINITE
    same_rows(wide.q, near.q, robot.revolute, atol=1e-7)
    for p in wide.q:
        assert np.linalg.norm(task.error(robot, p, task.value(robot, q))) < 1e-9


# --- rows that are angles, and rows that count turns

TARGETS = [(-2.16506351, -1.25, -2.61799388), (1.2, 0.4, 3.1), (0.3, -1.5, 0.0)]


@pytest.mark.parametrize("target", TARGETS)
@pytest.mark.parametrize("task", [SUM, SUM_IN_RADIANS, AZIMUTH], ids=["q1 + q3", "in radians", "atan2"])
def test_an_angle_row_of_a_function_has_the_solutions_of_the_planar_pose(task, target):
    robot = robot_from_dh(RPR)
    box = {robot.joint_names[1]: (-6, 6)}
    planar = ik_solutions(robot, PlanarPoseTask("xy"), target, box=box, starts=15)
    found = ik_solutions(robot, task, target, box=box, starts=15)
    assert len(planar) == 2
    assert found.status is IKStatus.FINITE
    same_rows(found.q, planar.q, robot.revolute, atol=1e-7)
    for q in found.q:  # joints without limits are turned until the row itself has the target's value
        assert np.linalg.norm(task.error(robot, q, target)) < 1e-8


def test_so_it_is_within_limits_of_half_a_turn():
    robot = robot_from_dh(RPR, lower=[-pi, -6, -pi], upper=[pi, 6, pi])
    found = ik_solutions(robot, SUM, TARGETS[0], starts=20)
    assert len(found) == 2
    assert_no_contradiction(found)


@pytest.mark.parametrize("turns", [-1.9, -0.4, 0.3, 1.2])
def test_a_row_that_counts_turns_has_the_solution_with_as_many(turns):
    """r = q1 + 0.1 x with two turns to both sides: one q1 for each target."""
    robot = robot_from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0)], lower=[-4 * pi] * 2, upper=[4 * pi] * 2)
    task = FunctionTask(lambda p, R, q: [q[0] + 0.1 * p[0], q[1]], 2)
    target = [2 * pi * turns, 1.0]
    found = ik_solutions(robot, task, target, starts=15)
    assert found.status is IKStatus.FINITE
    assert len(found) == 1
    assert np.linalg.norm(task.error(robot, found.q[0], target)) < 1e-8
    assert solve_ik(robot, task, target, time_limit=2).q == pytest.approx(found.q[0], abs=1e-5)
    beyond = ik_solutions(robot, task, [2 * pi * 2.3, 1.0], starts=5)
    assert beyond.status is IKStatus.NOT_FOUND
    assert beyond.error_norm > 0.1


def test_a_function_task_takes_one_unit_a_row_and_wraps_radians():
    task = FunctionTask(lambda p, R, q: [p[0], q[0] + q[1]], 2, units=("m", "rad"))
    robot = robot_from_dh([("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0)])
    assert task.row_units == ("m", "rad")
    assert task.error(robot, [3, 3], [0, 0])[1] == pytest.approx(2 * pi - 6)
    for units in (("m",), "mm", ("m", "deg"), 3):
        with pytest.raises(InputError, match="units must hold 'm', 'rad' or '1' for each of the 2 rows"):
            FunctionTask(lambda p, R, q: p[:2], 2, units=units)


def test_the_jacobian_of_a_row_in_radians_is_smooth_where_atan2_jumps():
    robot = robot_from_dh([("R", 1, 0, 0, 0)])
    task = FunctionTask(lambda p, R, q: [np.arctan2(p[1], p[0])], 1, units=("rad",))
    assert task.jacobian(robot, [pi]) == pytest.approx(np.array([[1.0]]), abs=1e-9)


@pytest.mark.parametrize("factor", [1e-6, 1.0, 1e6])
def test_the_unit_that_a_function_counts_in_does_not_matter(factor):
    """Kilometres or micrometres: thresholds are relative to what the row changes by."""
    robot, p = arm("planar_2r"), [0.5, 1.1]
    found = ik_solutions(robot, FunctionTask(lambda x, R, q: factor * x[:2], 2), factor * np.array(p), starts=10)
    same_rows(found.q, cf.two_link_solutions(p, 1.2, 0.8), np.array([True, True]), atol=1e-7)


# --- joints that do not move the task


def test_a_finger_beside_the_tool_leaves_the_two_postures_of_a_planar_2r(tmp_path):
    path = tmp_path / "gripper.urdf"
    path.write_text(
        """<robot name="gripper"><link name="base"/><link name="a"/><link name="b"/><link name="tool"/>
        <link name="finger"/>
        <joint name="q1" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/></joint>
        <joint name="q2" type="continuous"><parent link="a"/><child link="b"/><origin xyz="1.2 0 0"/>
        <axis xyz="0 0 1"/></joint>
        <joint name="tip" type="fixed"><parent link="b"/><child link="tool"/><origin xyz="0.8 0 0"/></joint>
        <joint name="jaw" type="prismatic"><parent link="b"/><child link="finger"/><axis xyz="0 1 0"/>
        <limit lower="0" upper="0.04" velocity="1" effort="1"/></joint></robot>""",
        encoding="utf-8",
    )
    robot = load_robot(path, tool="tool")
    found = ik_solutions(robot, XY, [0.5, 1.1], starts=20)
    assert (found.status, found.free_joints, found.dimension) == (IKStatus.FINITE, ("jaw",), 0)
    same_rows(found.q[:, :2], cf.two_link_solutions([0.5, 1.1], 1.2, 0.8), np.array([True, True]), atol=1e-8)
    assert found.q[:, 2] == pytest.approx([0.02, 0.02])


def test_the_roll_of_a_scara_is_free_for_a_point():
    robot = robot_from_dh([("R", 1, 0, 0, 0), ("R", 0.8, pi, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0, 0)])
    third, roll = robot.joint_names[2:]
    found = ik_solutions(robot, XYZ, [0.5, 1.1, -0.3], box={third: (-1, 1)}, starts=20)
    assert (found.status, len(found), found.free_joints) == (IKStatus.FINITE, 2, (roll,))


def test_a_task_that_no_joint_moves_has_every_q_for_a_solution_or_none():
    robot = robot_from_dh([("P", 0, 0, 0.1, 0)], lower=[-1], upper=[1])
    found = ik_solutions(robot, XY, [0, 0])
    assert (found.status, found.dimension, found.free_joints) == (IKStatus.INFINITE, 1, robot.joint_names)
    assert len(found) >= 2
    assert np.abs(found.q).max() <= 1
    never = ik_solutions(robot, XY, [0.1, 0])
    assert (never.status, len(never)) == (IKStatus.UNREACHABLE, 0)
    assert never.error_norm == pytest.approx(0.1)


def test_a_robot_without_joints_has_the_one_configuration_or_none(tmp_path):
    path = tmp_path / "post.urdf"
    path.write_text(
        """<robot name="post"><link name="base"/><link name="tool"/><joint name="j" type="fixed">
        <parent link="base"/><child link="tool"/><origin xyz="0.8 0 0"/></joint></robot>""",
        encoding="utf-8",
    )
    robot = load_robot(path)
    first_row = FunctionTask(lambda p, R, q: p[:1], 1)
    for task, target in ((XYZ, [0.8, 0, 0]), (first_row, [0.8]), (PoseTask(), PoseTask().value(robot, []))):
        found = ik_solutions(robot, task, target)
        assert (found.status, found.q.shape, found.complete) == (IKStatus.FINITE, (1, 0), True)
    for task, target in ((XYZ, [0.9, 0, 0]), (first_row, [0.7])):
        found = ik_solutions(robot, task, target)
        assert (found.status, found.q.shape) == (IKStatus.UNREACHABLE, (0, 0))
        assert found.error_norm == pytest.approx(0.1)


def test_a_joint_whose_follower_turns_half_as_far_goes_round_in_two_turns(tmp_path):
    """q1 and q1 + 2π are two places: φ of the tool is 1.5 q1."""
    path = tmp_path / "follower.urdf"
    path.write_text(
        """<robot name="follower"><link name="base"/><link name="a"/><link name="tool"/>
        <joint name="q1" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/></joint>
        <joint name="q2" type="continuous"><parent link="a"/><child link="tool"/><axis xyz="0 0 1"/>
        <mimic joint="q1" multiplier="0.5"/></joint></robot>""",
        encoding="utf-8",
    )
    robot = load_robot(path, tool="tool")
    task = FunctionTask(lambda p, R, q: [R[0, 0], R[1, 0]], 2)  # the direction of the tool's x axis
    for wanted in (task, PlanarPoseTask("xy")):
        target = [np.cos(1.2), np.sin(1.2)] if wanted is task else [0, 0, 1.2]
        found = ik_solutions(robot, wanted, target, starts=40)
        angles = 1.5 * found.q[:, 0]
        assert np.exp(1j * angles) == pytest.approx(np.full(len(found), np.exp(1.2j)), abs=1e-6)
        assert len({round(float(q) % (4 * pi), 4) for q in found.q[:, 0]}) >= 1


# --- drawn arms


def assert_found(seed):
    """The q that made a target is among finitely many solutions, and each one is verified."""
    robot = drawn_arm(seed, joints=1 + seed % 3)
    rng = np.random.default_rng(seed)
    q = rng.uniform(robot.lower, robot.upper)
    target = XYZ.value(robot, q)
    found = ik_solutions(robot, XYZ, target, starts=25)
    assert_no_contradiction(found)
    assert len(found)
    assert "finger" in found.free_joints
    for p in found.q:
        assert np.linalg.norm(XYZ.error(robot, p, target)) <= 1e-8 * robot.reach
    if found.status is not IKStatus.INFINITE:
        moving = ~np.isin(robot.joint_names, found.free_joints)
        apart = np.where(
            robot.revolute, np.abs(np.exp(1j * found.q) - np.exp(1j * q)), np.abs(found.q - q) / robot.reach
        )
        assert apart[:, moving].max(axis=1, initial=0.0).min() < 1e-4


@given(st.integers(0, 10_000))
@settings(max_examples=8)
def test_the_configuration_that_made_a_point_is_among_finitely_many_solutions_of_drawn_arms(seed):
    assert_found(seed)


@pytest.mark.parametrize("seed", some_of(range(20_000, 20_200), 10))
def test_so_it_is_of_many_drawn_arms(seed):
    assert_found(seed)
