"""Questions of examinations of 2010 to 2012 on workspaces, on what joint motions cross, and on encoders."""

from math import pi

import numpy as np
import pytest
import sympy
from formula_values import real

import robotics1 as r1
from robotics1.workspaces import dexterous_workspace, is_reached, workspace, workspace_formulas

H = pi / 2
XY, XYZ = r1.PositionTask("xy"), r1.PositionTask()


def links(*lengths):
    return r1.textbook_robots.planar_arm("R" * len(lengths), list(lengths))


def test_2012_01_11_1a_a_planar_3r_reaches_from_its_inner_to_its_outer_radius():
    ws = workspace(links(1, 0.5, 0.25), XY)
    assert (ws.r_min, ws.r_max) == pytest.approx((0.25, 1.75))
    l1, l2, l3 = real("l1 l2 l3")
    found = workspace_formulas(links("l1", "l2", "l3"), XY)
    book = sympy.Max(abs(l1 - l2) - l3, abs(l2 - l3) - l1, abs(l1 - l3) - l2, 0)
    for lengths in ((1, 0.5, 0.25), (0.25, 0.5, 1), (0.5, 0.4, 0.3), (0.1, 0.9, 0.2)):
        at = dict(zip((l1, l2, l3), lengths, strict=True))
        assert float((found.r_min - book).subs(at)) == pytest.approx(0, abs=1e-12)


def test_2012_01_11_1b_a_planar_3r_has_every_orientation_between_two_radii():
    assert dexterous_workspace(links(1, 0.5, 0.25), XY).radii == pytest.approx(np.array([[0.75, 1.25]]))


# --- 2011.02.25, b: a motion of the joints

ARM = r1.robot_from_dh([("R", 0, H, 0.5, 0), ("R", 1.5, 0, 0, 0), ("R", 1, 0, 0, 0)])
START, HALF, OTHER_ELBOW = [H, pi / 4, pi / 4], [pi / 4, -pi / 6, pi / 3], [pi / 4, 0.2937, -pi / 3]


def test_2011_02_25_b_the_tip_of_a_joint_motion_stays_in_the_workspace():
    ws, motion = workspace(ARM, XYZ), r1.trajectories.cosine(START, HALF, 1.0)
    tip = r1.trajectories.TaskTrajectory(ARM, XYZ, motion)
    assert all(is_reached(ws, tip(t)).inside for t in np.linspace(0, 1, 11))


def test_2011_02_25_b_only_with_the_other_elbow_is_a_singularity_crossed_on_the_way_and_on_the_way_back():
    ways = []
    for goal in (HALF, OTHER_ELBOW):
        there, back = r1.trajectories.cosine(START, goal, 1.0), r1.trajectories.cosine(goal, START, 1.0)
        q = np.concatenate([motion(np.linspace(0, 1, 200)) for motion in (there, back)])
        signs = np.sign(np.linalg.det(XYZ.jacobian(ARM, q)))
        ways.append(int((signs[1:] != signs[:-1]).sum()))
    assert ways == [0, 2]


# --- 2010.02.11, b: two straight lines of the joints, without the obstacles of the question


def test_2010_02_11_b_a_line_of_the_joints_crosses_the_stretched_arm_and_the_other_way_round_the_folded_one():
    start, goal = np.array([-2.159827, -2.619278]), np.array([1.181036, 0.863212])
    line, other = (r1.cubic(start, end, 1.0, v0=end - start, v1=end - start) for end in (goal, goal - [0, 2 * pi]))
    s = r1.trajectories.time_of(line.joint(1), 0)
    assert (s, line(s)[0]) == pytest.approx((0.7521, 0.3529), abs=1e-4)
    assert r1.subspaces(XY.jacobian(links(0.6, 0.5), line(s))).rank == 1
    assert other(0.75) == pytest.approx([0.3458, -4.7198], abs=1e-4)
    assert r1.subspaces(XY.jacobian(links(0.6, 0.5), other(r1.trajectories.time_of(other.joint(1), -pi)))).rank == 1


# --- 2012.06.11, 3: the smallest motion that the encoders of two motors must feel


def test_2012_06_11_3_pulses_of_encoders_behind_gears_for_a_tenth_of_a_millimetre():
    arm, task, gear = links(1, 0.5), r1.PositionTask("xy", reference="link1"), np.array([100, 80])
    assert task.jacobian(arm, [0.3, H]) == pytest.approx(np.array([[-0.5, -0.5], [1, 0]]), abs=1e-12)
    along, across = (gear * r1.joint_velocity(arm, task, dp, [0.3, H]).qdot for dp in ([1e-4, 0], [0, 1e-4]))
    assert along == pytest.approx([0, -0.016], abs=1e-9)
    assert across == pytest.approx([0.01, -0.008], abs=1e-9)
    pulses = 2 * pi / np.array([along[1], *across])
    assert np.abs(pulses) == pytest.approx([392.7, 628.3, 785.4], abs=0.05)
