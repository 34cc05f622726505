"""All solutions of arms with fewer joints than their task has rows: exact, verified, as many as brute force finds."""

from math import acos, atan2, cos, pi, sin

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from scipy.optimize import least_squares

import robotics1 as r1
from robotics1.ik import IKStatus

H = pi / 2
POSE, PLANAR = r1.PoseTask(), r1.PlanarPoseTask("xy")
SCARA = [("R", 0.4, 0, 0.3, 0), ("R", 0.3, pi, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0.1, 0)]
FIVE = [("R", 0, H, 0.3, 0), ("R", 0.4, 0, 0, 0), ("R", 0.3, 0, 0, 0), ("R", 0, H, 0, H), ("R", 0, 0, 0.1, 0)]


def difference(robot, p, q):
    d = np.subtract(p, q)
    return np.abs(np.where(robot.revolute, np.angle(np.exp(1j * d)), d)).max(axis=-1)


def by_brute_force(robot, task, target, rng, starts=25):
    """The solutions that descents from random starts lead to, each once."""
    found = []
    for _ in range(starts):
        start = rng.uniform(-1, 1, robot.nq) * np.where(robot.revolute, pi, 2.0)
        q = least_squares(lambda q: task.error(robot, q, target), start, xtol=1e-15, ftol=1e-15, gtol=1e-15).x
        if np.abs(task.error(robot, q, target)).max() < 1e-10:
            found += [q] if not any(difference(robot, p, q) < 1e-5 for p in found) else []
    return found


def assert_as_brute_force(robot, task, q, rng):
    """No solution is missed, q is there, and what is near the target but out of reach has none."""
    box = {name: (-9, 9) for name, turns in zip(robot.joint_names, robot.revolute, strict=True) if not turns}
    target = task.value(robot, q)
    found = r1.ik_solutions(robot, task, target, box=box)
    assert found.status is IKStatus.FINITE
    assert found.complete
    for p in found.q:
        assert np.abs(task.error(robot, p, target)).max() < 1e-11
    assert difference(robot, found.q, q).min() < 1e-7
    for p in by_brute_force(robot, task, target, rng):
        assert difference(robot, found.q, p).min() < 1e-5


@given(st.integers(0, 10_000))
@settings(max_examples=8)
def test_as_many_poses_of_arms_with_one_to_five_joints_as_brute_force_finds(seed):
    rng = np.random.default_rng(seed)
    kinds = ["R", *rng.choice(["R", "R", "P"], rng.integers(0, 5))]
    kinds = [kind if kinds[:i].count("P") < 1 else "R" for i, kind in enumerate(kinds)]
    robot = r1.robot_from_dh([(kind, *rng.uniform(0.2, 1.2, 3), rng.uniform(-1, 1)) for kind in kinds])
    assert_as_brute_force(robot, POSE, rng.uniform(-1, 1, robot.nq), rng)


@pytest.mark.parametrize("kinds", ["R", "P", "RR", "RP", "PR", "PP"])
def test_planar_poses_of_one_and_two_joints(kinds):
    robot = r1.planar_arm(kinds, lengths=[0.8, 0.5][: kinds.count("R")])
    assert_as_brute_force(robot, PLANAR, [0.7, -0.4][: len(kinds)], np.random.default_rng(0))


@pytest.mark.parametrize(("joints", "task"), [(1, "position"), (2, "position"), (1, "position:xy"), (2, "orientation")])
def test_points_and_orientations_of_one_and_two_joints(joints, task):
    robot = r1.robot_from_dh([("R", 0.5, 0.7, 0.2, 0.1)] * joints)
    task = r1.OrientationTask() if task == "orientation" else r1.PositionTask(task[9:] or "xyz")
    assert_as_brute_force(robot, task, [0.6, -1.1][:joints], np.random.default_rng(0))


def test_the_two_poses_of_a_scara_by_the_law_of_cosines():
    """c2 = (x² + y² − a1² − a2²)/(2 a1 a2), q1 = atan2(y, x) − atan2(a2 s2, a1 + a2 c2), q4 = q1 + q2 − ψ."""
    robot = r1.robot_from_dh(SCARA, lower=[None, None, 0, None], upper=[None, None, 0.2, None])
    q = [0.3, 0.7, 0.1, 0.4]
    T = r1.forward_kinematics(robot, q)
    x, y = T.translation[:2]
    psi = q[0] + q[1] - q[3]
    wanted = []
    for q2 in (acos((x * x + y * y - 0.25) / 0.24), -acos((x * x + y * y - 0.25) / 0.24)):
        q1 = atan2(y, x) - atan2(0.3 * sin(q2), 0.4 + 0.3 * cos(q2))
        wanted.append([q1, q2, 0.1, q1 + q2 - psi])
    found = r1.ik_solutions(robot, "pose", T)
    assert (found.status, found.complete, len(found)) == (IKStatus.FINITE, True, 2)
    assert all(difference(robot, found.q, p).min() < 1e-12 for p in wanted)


def test_a_tilted_tool_is_proven_out_of_reach_of_a_scara():
    robot = r1.robot_from_dh(SCARA, lower=[None, None, 0, None], upper=[None, None, 0.2, None])
    T = r1.forward_kinematics(robot, [0.3, 0.7, 0.1, 0.4]).homogeneous
    c, s = cos(0.01), sin(0.01)
    tilted = T @ np.array([[1, 0, 0, 0], [0, c, -s, 0], [0, s, c, 0], [0, 0, 0, 1]])
    found = r1.ik_solutions(robot, "pose", tilted)
    assert (found.status, found.complete, len(found)) == (IKStatus.UNREACHABLE, True, 0)
    assert found.error_norm == pytest.approx(0.01, abs=1e-4)


def test_the_four_poses_of_an_arm_with_five_joints_of_turn_and_pitch():
    robot = r1.robot_from_dh(FIVE)
    q = np.array([0.1, 0.5, -0.8, 0.4, 0.2])
    found = r1.ik_solutions(robot, "pose", r1.forward_kinematics(robot, q))
    assert (found.complete, len(found)) == (True, 4)
    assert difference(robot, found.q, q).min() < 1e-9


@pytest.mark.parametrize("rows", [[("R", 0.5, 0.3, 0.2, 0.1)], [("R", 1, 0, 0, 0)], [("R", 0, 0, 0.3, 0)]])
@pytest.mark.parametrize("task", ["pose", "orientation"])
def test_a_joint_that_turns_a_frame_has_one_solution_and_not_one_for_each_turn(rows, task):
    """Rows that never change do not hide that the others come back after a turn."""
    robot = r1.robot_from_dh(rows)
    T = r1.forward_kinematics(robot, [0.7])
    found = r1.ik_solutions(robot, task, T if task == "pose" else T.rotation)
    assert found.q == pytest.approx(np.array([[0.7]]), abs=1e-12)


def test_a_joint_whose_limits_are_one_value_stands_still():
    """A 3R arm whose second joint is fixed at 0.5 is a 2R arm with the link |(1, 0) + R(0.5) (1, 0)|."""
    rows = [("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0), ("R", 0.5, 0, 0, 0)]
    robot = r1.robot_from_dh(rows, lower=[-3, 0.5, -3], upper=[3, 0.5, 3])
    found = r1.ik_solutions(robot, "position:xy", [1.5, 1.0])
    a, b, distance = 2 * cos(0.25), 0.5, np.hypot(1.5, 1.0)
    bend = acos((distance**2 - a**2 - b**2) / (2 * a * b))  # q3 + 0.25, of the short link from the long one
    assert (found.complete, len(found), found.method) == (True, 2, "elimination to a polynomial")
    assert sorted(found.q[:, 2]) == pytest.approx([-bend - 0.25, bend - 0.25], abs=1e-9)
    assert found.q[:, 1] == pytest.approx([0.5, 0.5], abs=0)
