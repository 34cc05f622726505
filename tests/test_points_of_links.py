"""A point of a link in numbers, as in formulas: `point=`."""

import numpy as np
import pinocchio as pin
import pytest
import sympy
from arms import ARMS, arm, random_q
from differences import along, derivative
from pages import data_behind

import robotics1 as r1

C = np.array([0.1, -0.2, 0.3])
SIX_R = arm("six_r")
KINDS = [name for name in ARMS if arm(name).nq == arm(name).nv and arm(name).tool is not None]


@pytest.mark.parametrize("name", KINDS)
def test_point_is_p_plus_r_c_and_moves_with_its_jacobian(name):
    robot = arm(name)
    q, qdot = random_q(robot, 1), np.random.default_rng(2).uniform(-1, 1, robot.nv)
    T, at = r1.forward_kinematics(robot, q), r1.forward_kinematics(robot, q, point=C)
    assert at.translation == pytest.approx(T.translation + T.rotation @ C, abs=1e-12)
    assert np.array_equal(at.rotation, T.rotation)
    J = r1.frame_jacobian(robot, q, point=C)
    slope = derivative(lambda x: r1.forward_kinematics(robot, x, point=C).translation, q)
    assert J[:3] == pytest.approx(slope, abs=1e-8)
    assert np.array_equal(J[3:], r1.frame_jacobian(robot, q)[3:])
    rate = along(lambda x: r1.frame_jacobian(robot, x, point=C), q, qdot)
    assert r1.frame_jacobian_rate(robot, q, qdot, point=C) == pytest.approx(rate, abs=1e-7)


def test_body_jacobian_is_at_the_point_and_space_jacobian_knows_no_point():
    q = random_q(SIX_R, 3)
    T, at = r1.forward_kinematics(SIX_R, q), r1.forward_kinematics(SIX_R, q, point=C)
    space = r1.frame_jacobian(SIX_R, q, kind="space")
    assert r1.frame_jacobian(SIX_R, q, kind="space", point=C) == pytest.approx(space, abs=1e-12)
    assert r1.frame_jacobian(SIX_R, q, kind="body", point=C) == pytest.approx(at.toActionMatrixInverse() @ space)
    mixed = r1.frame_jacobian(SIX_R, q, point=C, reference="tool")
    assert mixed == pytest.approx(r1.frame_jacobian(SIX_R, q, kind="body", point=C), abs=1e-12)
    qdot = np.linspace(-1, 1, 6)
    rate = along(lambda x: r1.frame_jacobian(SIX_R, x, point=C, reference="tool"), q, qdot)
    found = r1.frame_jacobian_rate(SIX_R, q, qdot, point=C, reference="tool")
    assert found == pytest.approx(rate, abs=1e-7)
    assert np.allclose(T.rotation, at.rotation)


TASKS = {
    "position": r1.PositionTask,
    "coordinates in the tool's axes": lambda **at: r1.PositionTask("xz", reference="tool", **at),
    "pose": r1.PoseTask,
    "pose by angles": lambda **at: r1.PoseTask("ZYZ", **at),
    "orientation": r1.OrientationTask,
    "pointing": lambda **at: r1.PointingTask("y", **at),
    "cylindrical": r1.tasks.CylindricalTask,
    "function": lambda **at: r1.FunctionTask(lambda p, R, q: [p @ p, p[0] + R[2, 1] * q[0]], 2, **at),
}


@pytest.mark.parametrize("kind", TASKS)
def test_a_task_at_a_point_is_that_of_a_robot_with_a_frame_there(kind):
    """The same robot with one more link, fixed at the point, made from text."""
    task, q = TASKS[kind](point=tuple(C)), random_q(SIX_R, 4)
    there, frame = SIX_R_WITH_LINK, TASKS[kind](frame="there")
    ours, theirs = task.value(SIX_R, q), frame.value(there, q)
    same = ours.isApprox(theirs, 1e-12) if isinstance(ours, pin.SE3) else np.allclose(ours, theirs, atol=1e-12)
    assert same
    assert task.jacobian(SIX_R, q) == pytest.approx(frame.jacobian(there, q), abs=1e-8)
    other = frame.value(there, random_q(SIX_R, 5))
    assert task.error(SIX_R, q, other) == pytest.approx(frame.error(there, q, other), abs=1e-12)


def with_link():
    text = SIX_R.urdf.replace(
        "</robot>",
        '<link name="there"/><joint name="to_there" type="fixed"><origin xyz="0.1 -0.2 0.3"/>'
        f'<parent link="{SIX_R.tool}"/><child link="there"/></joint></robot>',
    )
    return r1.load_robot(text, tool="there")


SIX_R_WITH_LINK = with_link()


@pytest.mark.parametrize("kind", ["pose", "position", "cylindrical"])
def test_inverse_kinematics_reaches_the_point(kind):
    task = TASKS[kind](point=tuple(C))
    target = task.value(SIX_R, random_q(SIX_R, 6))
    found = r1.solve_ik(SIX_R, task, target).require()
    assert task.error(SIX_R, found.q, target) == pytest.approx(np.zeros(task.rows), abs=1e-5)


def test_all_solutions_of_a_pose_at_a_point_are_those_of_the_frame():
    q = random_q(SIX_R, 7)
    at = r1.PoseTask(point=tuple(C))
    ours = r1.ik_solutions(SIX_R, at, at.value(SIX_R, q))
    theirs = r1.ik_solutions(SIX_R, r1.PoseTask(), r1.forward_kinematics(SIX_R, q))
    assert len(ours) == len(theirs)
    assert len(ours) > 1
    assert ours.complete == theirs.complete
    for solution in ours.q:
        assert np.abs(theirs.q - solution).max(axis=1).min() < 1e-7


def test_formulas_of_a_task_at_a_point_are_those_at_the_point_of_the_frame():
    robot = arm("prr")
    ours = r1.formulas(robot, r1.PlanarPoseTask(point=(0.5, 0.25, 0)))
    theirs = r1.formulas(robot, r1.PlanarPoseTask(), point=(0.5, 0.25, 0))
    assert sympy.simplify(ours.jacobian - theirs.jacobian) == sympy.zeros(3, 3)
    assert sympy.simplify(ours.determinant - theirs.determinant) == 0


@pytest.mark.parametrize("point", [(1, 2), "d", [1, 2, np.nan], [[1, 2, 3]]])
def test_what_is_no_point_is_refused(point):
    q = np.zeros(6)
    for call in (
        lambda: r1.forward_kinematics(SIX_R, q, point=point),
        lambda: r1.frame_jacobian(SIX_R, q, point=point),
        lambda: r1.frame_jacobian_rate(SIX_R, q, q, point=point),
        lambda: r1.PositionTask(point=point),
        lambda: r1.FunctionTask(lambda p, R, q: [p[0]], 1, point=point),
    ):
        with pytest.raises(r1.InputError, match="point must"):
            call()


# --- workspaces and pages of a task at a point beside its frame


def test_the_workspace_of_a_point_beyond_the_tool_is_that_of_an_arm_with_a_longer_link():
    task = r1.PositionTask("xy", point=[0.1, 0, 0])
    longer = r1.textbook_robots.planar_arm("RR", [1.0, 0.9])
    arm_ = r1.textbook_robots.planar_arm("RR", [1.0, 0.8])
    found = r1.workspaces.workspace(arm_, task)
    assert found.area == pytest.approx(4 * np.pi * 1.0 * 0.9)
    assert found.area == pytest.approx(r1.workspaces.workspace(longer, r1.PositionTask("xy")).area)
    assert r1.workspaces.extreme_reach(arm_, task).value == pytest.approx(1.9)


def test_a_point_beside_the_last_link_is_as_far_from_joint_2_as_by_hand():
    """At (−0.5, 0.4) of the tool, which is 0.8 from joint 2, a point is √(0.3² + 0.4²) = 0.5 from it."""
    arm_ = r1.textbook_robots.planar_arm("RR", [1.0, 0.8])
    task = r1.PositionTask("xy", point=[-0.5, 0.4, 0])
    assert r1.workspaces.extreme_reach(arm_, task).value == pytest.approx(1.5)
    assert r1.workspaces.workspace(arm_, task).area == pytest.approx(np.pi * (1.5**2 - 0.5**2))


def test_a_page_draws_the_jacobian_of_a_point_beside_the_tool():
    arm_ = r1.textbook_robots.planar_arm("RR", [1.0, 0.8])
    shown, plain = (
        data_behind(r1.view(arm_, [0.3, 0.5], task=task).html)["arms"][0]["task"]
        for task in (r1.PositionTask("xy", point=[0.1, 0.2, 0]), r1.PositionTask("xy"))
    )
    assert shown["name"] == plain["name"] == "PositionTask"
    moved = np.array(shown["frame"]["placement"]) - plain["frame"]["placement"]  # the rows of [R p]
    assert moved == pytest.approx([0, 0, 0, 0.1, 0, 0, 0, 0.2, 0, 0, 0, 0])


def test_a_function_of_ones_own_has_no_workspace_and_the_error_says_what_has_one():
    own = r1.FunctionTask(lambda p, R, q: [p[0], p[1]], 2, point=[0.1, 0, 0])
    with pytest.raises(r1.TaskError, match="with point= beside the tool; a function of your own cannot be read"):
        r1.workspaces.workspace(r1.textbook_robots.planar_arm("RR", [1.0, 0.8]), own)
