"""First and second order kinematics of trees with followers of every form: products of matrices, and differences."""

import subprocess
import sys

import numpy as np
import pytest
from differences import along, twist
from hypothesis import given, reject, settings, strategies as st
from mimic_arms import pose, text_of, trees

import robotics1 as r1

FOLLOWING_2R = """<robot name="m"><link name="base"/><link name="a"/><link name="b"/><link name="c"/><link name="tool"/>
<joint name="j1" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>{limit}</joint>
<joint name="j2" type="revolute"><parent link="a"/><child link="b"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
{limit}</joint>
<joint name="j3" type="revolute"><parent link="b"/><child link="c"/><origin xyz="1 0 0"/><axis xyz="0 0 1"/>
<mimic joint="j1" multiplier="-1"/>{limit}</joint>
<joint name="end" type="fixed"><parent link="{last}"/><child link="tool"/><origin xyz="1 0 0"/></joint></robot>"""


def load(folder, text):
    file = folder / "tree.urdf"
    file.write_text(text)
    try:
        return r1.load_robot(file, tool="tool")
    except r1.RobotFileError:  # branches whose joints follow each other both ways are refused
        reject()


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("trees")


def state(robot, seed):
    rng = np.random.default_rng(seed)
    return rng.uniform(-1.5, 1.5, robot.nv), rng.uniform(-1.5, 1.5, robot.nv)


def following_2r(folder, last="c"):
    limit = '<limit lower="-3" upper="3" velocity="1" effort="1"/>'
    return load(folder, FOLLOWING_2R.format(limit=limit, last=last))


# --- J̇ of a frame


def test_jacobian_rate_with_a_mimicking_joint_is_the_difference_quotient(folder):
    robot, q, qdot = following_2r(folder), np.array([0.3, 0.8]), np.array([1, 0.5])
    rate = r1.frame_jacobian_rate(robot, q, qdot)
    assert rate[:2, 1] == pytest.approx([-1.0287, -1.6955], abs=5e-5)
    assert rate == pytest.approx(along(lambda x: r1.frame_jacobian(robot, x), q, qdot), abs=1e-9)
    # the third link stands at q1 + q2 − q1 = q2: the tool is at e(q1) + e(q1 + q2) + e(q2)
    a, b, w = 0.3 + 0.8, 0.8, 1.5
    by_hand = [-np.cos(a) * w - np.cos(b) * 0.5, -np.sin(a) * w - np.sin(b) * 0.5]
    assert rate[:2, 1] == pytest.approx(by_hand, abs=1e-14)


def test_a_follower_beside_the_chain_changes_no_jacobian_rate(folder):
    robot, q, qdot = following_2r(folder, last="b"), np.array([0.3, 0.8]), np.array([1, 0.5])
    a, w = 1.1, 1.5
    c1, s1 = np.cos(0.3), np.sin(0.3)
    expected = [[-c1 - np.cos(a) * w, -np.cos(a) * w], [-s1 - np.sin(a) * w, -np.sin(a) * w]]
    assert r1.frame_jacobian_rate(robot, q, qdot)[:2] == pytest.approx(np.array(expected), abs=1e-14)


@given(trees(), st.integers(0, 99))
@settings(max_examples=40)
def test_forward_kinematics_and_jacobian_of_a_tree_are_the_product_of_matrices(folder, joints, seed):
    robot = load(folder, text_of(joints))
    q, _ = state(robot, seed)
    for link in ("tool", len(joints) // 2):
        frame = link if link == "tool" else f"link{link}"

        def T(x, link=link):
            return pose(joints, dict(zip(robot.joint_names, x, strict=True)), link)

        assert r1.forward_kinematics(robot, q, frame=frame).homogeneous == pytest.approx(T(q), abs=1e-12)
        assert r1.frame_jacobian(robot, q, frame=frame) == pytest.approx(twist(T, q), abs=1e-8)


@given(trees(), st.integers(0, 99), st.sampled_from(["world", "tool", "link0", "base"]))
@settings(max_examples=50)
def test_jacobian_rate_of_a_tree_with_followers_is_the_difference_quotient_in_any_axes(folder, joints, seed, axes):
    robot = load(folder, text_of(joints))
    q, qdot = state(robot, seed)
    for frame in ("tool", "link0"):
        rate = r1.frame_jacobian_rate(robot, q, qdot, frame=frame, reference=axes)
        expected = along(lambda x, frame=frame: r1.frame_jacobian(robot, x, frame=frame, reference=axes), q, qdot)
        assert rate.shape == (6, robot.nv)
        assert rate == pytest.approx(expected, abs=1e-7)


# --- tasks


def task_of(kind, reference):
    return {
        "position": r1.PositionTask("xz", reference=reference),
        "pose": r1.PoseTask(reference=reference),
        "orientation": r1.OrientationTask(reference=reference),
        "pointing": r1.PointingTask("x", reference=reference),
        "function": r1.FunctionTask(lambda p, R, q: [p @ p, R[0, 1] * p[2]], 2),
    }[kind]


TASKS = st.sampled_from(["position", "pose", "orientation", "pointing", "function"])


@given(trees(), st.integers(0, 99), TASKS, st.sampled_from(["world", "tool", "link0"]))
@settings(max_examples=40)
def test_second_order_of_a_task_with_followers_is_the_difference_of_the_first(folder, joints, seed, kind, axes):
    robot, task = load(folder, text_of(joints)), task_of(kind, axes)
    q, qdot = state(robot, seed)
    J = task.jacobian(robot, q)
    expected = along(lambda x: task.jacobian(robot, x), q, qdot)
    scale = 1 + np.abs(expected).max()
    assert r1.trajectories.jacobian_rate(robot, task, q, qdot) == pytest.approx(expected, abs=1e-7 * scale)
    qddot = np.linspace(-1, 1, robot.nv)
    asked = J @ qddot + expected @ qdot
    found = r1.joint_acceleration(robot, task, asked, q, qdot)
    assert found.drift == pytest.approx(expected @ qdot, abs=1e-6 * scale)
    if found.singular_values[found.rank - 1 :][:1] > 1e-3:
        assert J @ found.qddot + expected @ qdot == pytest.approx(asked, abs=1e-5 * scale)


def test_a_task_trajectory_of_an_arm_with_followers_is_differentiated(folder):
    robot = following_2r(folder)
    motion, h, t = r1.cubic([0.1, 0.2], [0.9, -0.7], 2.0), 1e-3, 0.7
    seen = r1.trajectories.TaskTrajectory(robot, r1.PositionTask("xy"), motion)
    for f, g in ((seen, seen.velocity), (seen.velocity, seen.acceleration)):
        expected = (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h)
        assert g(t) == pytest.approx(expected, abs=1e-8)


def test_an_arm_with_followers_follows_by_accelerations_as_by_velocities(folder):
    robot, task, q0 = following_2r(folder), r1.PositionTask("xy"), np.array([0.3, 0.8])
    start = task.value(robot, q0)
    path = r1.line_path(start, start + np.array([-0.3, 0.1]))
    motion = r1.curves.PathTrajectory(path, r1.cubic(0, path.end, 1.0).joint())
    by_velocity = r1.follow_trajectory(robot, task, motion, q0)
    by_acceleration = r1.trajectories.follow_trajectory_by_acceleration(robot, task, motion, (q0, np.zeros(2)))
    assert by_acceleration(0.8) == pytest.approx(by_velocity(0.8), abs=1e-6)
    assert by_acceleration.status is r1.trajectories.FollowingStatus.FOLLOWS


@given(trees(most=3, chain=True), st.integers(0, 99))
@settings(max_examples=8)
def test_formulas_of_the_jacobian_rate_with_followers_are_the_numbers(folder, joints, seed):
    joints = tuple(joint._replace(multiplier=round(joint.multiplier) or 1.0) for joint in joints)
    robot, task = load(folder, text_of(joints)), r1.PositionTask("xyz")
    try:
        found = r1.formulas(robot, task)
        written = found.jacobian_rate, found.velocity_product
    except r1.FormulaError:
        return  # no formula is a right answer for a follower of another kind than its leader
    q, qdot = state(robot, seed)
    at = dict(zip([*found.q, *found.qdot], [*q, *qdot], strict=True))
    rate = r1.frame_jacobian_rate(robot, q, qdot)[:3]
    assert np.array(written[0].evalf(subs=at), dtype=float) == pytest.approx(rate, abs=1e-8)
    assert np.array(written[1].evalf(subs=at), dtype=float).ravel() == pytest.approx(rate @ qdot, abs=1e-8)


# --- no joints


def test_jacobian_rate_of_a_robot_without_joints_is_6_by_0_and_the_interpreter_lives(tmp_path):
    file = tmp_path / "still.urdf"
    file.write_text('<robot name="still"><link name="base"/></robot>')
    code = f"""
import robotics1 as r1
robot = r1.load_robot({str(file)!r})
for reference in ("world", "tool", "base"):
    print(r1.frame_jacobian_rate(robot, [], [], reference=reference).shape)
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False, timeout=60)
    assert run.returncode == 0, run.stderr
    assert run.stdout.split("\n")[:3] == ["(6, 0)"] * 3
