"""All solutions of a human-like arm at an arm angle: eight, each with the pose and the angle that were asked for."""

from math import pi

import numpy as np
import pytest
from arms import arm
from hypothesis import given, settings, strategies as st

from robotics1 import InputError, PoseTask, PositionTask, TaskError, ik_solutions, robot_from_dh
from robotics1.dh import dh_to_urdf
from robotics1.ik import IKStatus, arm_angle, solutions_at_arm_angle

H, POSE = pi / 2, PoseTask()
IIWA = [(-H, 0.34), (H, 0), (H, 0.4), (-H, 0), (-H, 0.4), (H, 0), (0, 0.126)]  # alpha, d of seven turning joints


def iiwa(elbow=0.0, **options):
    a = [0, 0, elbow, -elbow, 0, 0, 0]
    rows = [("R", a[i], alpha, d, 0) for i, (alpha, d) in enumerate(IIWA)]
    return robot_from_dh(rows, **options)


def swivel(robot, q):
    """The arm angle by the points on a picture: axes and origins of the joints in the world."""
    frames = [np.asarray(robot_frame) for robot_frame in joint_frames(robot, q)]
    S, W = frames[1][:3, 3], frames[5][:3, 3]
    axis4, origin4 = frames[3][:3, 2], frames[3][:3, 3]
    E = origin4 + ((S - origin4) @ axis4) * axis4
    along = (W - S) / np.linalg.norm(W - S)
    up, elbow = [0, 0, 1] - along[2] * along, (E - S) - ((E - S) @ along) * along
    return np.arctan2(elbow @ np.cross(along, up), elbow @ up)


def joint_frames(robot, q):
    """The frames whose z axes the joints turn about, by the rows of the table."""
    T, found = np.eye(4), []
    for (alpha, d), angle, a in zip(IIWA, q, robot_offsets(robot), strict=True):
        found.append(T)
        c, s, ca, sa = np.cos(angle), np.sin(angle), np.cos(alpha), np.sin(alpha)
        T = T @ np.array([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]])
    return found


def robot_offsets(robot):
    elbow = abs(robot.model.jointPlacements[4].translation[0])
    return [0, 0, elbow, -elbow, 0, 0, 0]


@given(st.integers(0, 10_000), st.sampled_from([0.0, 0.045]))
@settings(max_examples=20)
def test_eight_solutions_have_the_pose_and_the_arm_angle(seed, elbow):
    robot, q = iiwa(elbow), np.random.default_rng(seed).uniform(-2, 2, 7)
    target, angle = POSE.value(robot, q), arm_angle(robot, POSE, q)
    found = solutions_at_arm_angle(robot, POSE, target, angle)
    assert found.complete
    assert len(found) == 8
    assert np.abs(np.angle(np.exp(1j * (found.q - q)))).max(axis=1).min() < 1e-7
    for p in found.q:
        assert np.abs(POSE.error(robot, p, target)).max() < 1e-11
        assert np.angle(np.exp(1j * (arm_angle(robot, POSE, p) - angle))) == pytest.approx(0, abs=1e-11)


@given(st.integers(0, 10_000), st.sampled_from([0.0, 0.045]))
@settings(max_examples=20)
def test_the_arm_angle_turns_from_the_first_axis_to_the_elbow(seed, elbow):
    robot, q = iiwa(elbow), np.random.default_rng(seed).uniform(-2, 2, 7)
    assert arm_angle(robot, POSE, q) == pytest.approx(swivel(robot, q), abs=1e-9)


def test_a_file_stands_for_the_robot_a_short_form_for_the_task_and_names_for_q(tmp_path):
    robot, q = iiwa(), [0.3, 0.7, -0.4, 1.2, 0.5, -0.8, 0.2]
    file = tmp_path / "arm.urdf"
    dh_to_urdf([("R", 0, alpha, d, 0) for alpha, d in IIWA], file)
    angle, target = arm_angle(robot, POSE, q), POSE.value(robot, q)
    assert arm_angle(str(file), "pose", dict(zip(robot.joint_names, q, strict=True))) == pytest.approx(angle, abs=1e-9)
    assert len(solutions_at_arm_angle(str(file), "pose", target, angle)) == 8


def test_the_solutions_are_those_of_an_arm_whose_third_joint_is_locked():
    robot, q = iiwa(), np.array([0.3, 0.7, -0.4, 1.2, 0.5, -0.8, 0.2])
    target = POSE.value(robot, q)
    for p in ik_solutions(robot, POSE, target, locked={"q3": q[2]}).q:
        at = solutions_at_arm_angle(robot, POSE, target, arm_angle(robot, POSE, p))
        assert np.abs(np.angle(np.exp(1j * (at.q - p)))).max(axis=1).min() < 1e-8


def test_beyond_the_reach_there_is_none_and_limits_set_solutions_apart():
    robot = iiwa(lower=[-2.9, -2, -2.9, 0, -2.9, -2, -3], upper=[2.9, 2, 2.9, 2, 2.9, 2, 3])
    q = np.array([0.3, 0.7, -0.4, 1.2, 0.5, -0.8, 0.2])
    found = solutions_at_arm_angle(robot, POSE, POSE.value(robot, q), arm_angle(robot, POSE, q))
    assert len(found) + len(found.outside_limits) == 8
    assert (found.q[:, 3] >= 0).all()
    far = POSE.value(robot, q)
    far.translation = far.translation * 3
    none = solutions_at_arm_angle(robot, POSE, far, 0.3)
    assert (none.status, len(none)) == (IKStatus.UNREACHABLE, 0)
    assert none.error_norm > 0.1


def test_what_has_no_arm_angle_says_what_would():
    robot = iiwa()
    with pytest.raises(TaskError, match="straight"):
        arm_angle(robot, POSE, [0.3, 0.7, -0.4, 0, 0.5, -0.8, 0.2])
    above = [0.3, 0.6, 0.0, 1.2, 0.5, -0.8, 0.2]  # two equal links: the wrist is above the shoulder
    with pytest.raises(TaskError, match="first axis"):
        arm_angle(robot, POSE, above)
    with pytest.raises(TaskError, match="PoseTask"):
        arm_angle(robot, PositionTask(), [0.1] * 7)
    with pytest.raises(TaskError, match=r"seven turning joints.*locked"):
        arm_angle(arm("six_r"), POSE, [0.1] * 6)
    with pytest.raises(InputError):
        solutions_at_arm_angle(robot, POSE, POSE.value(robot, [0.1, 0.4, 0.2, 0.9, 0, 0.3, 0]), float("nan"))
