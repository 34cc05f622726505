"""Statics, bounds of joints and couplings as exams and textbooks ask them, with their printed answers."""

from math import pi

import numpy as np
import pytest
from dh_forms import dh_pose

import robotics1 as r1
from robotics1.singularities import Load, manipulability, static_torques, velocity_polytope

XY = r1.PositionTask("xy")


def rows(a):
    return np.array(sorted(np.round(a, 3).tolist()))


@pytest.mark.parametrize(
    ("q", "largest", "joints", "vertices"),
    [
        ([0.523599, 1.047198], 7, [1, 1.5], [(-6.5, 2.5981), (6.5, -2.5981), (-0.5, 2.5981), (0.5, -2.5981)]),
        (
            [0.523599, 2.748894],
            3.9425,
            [-1, 1.5],
            [(1.6305, -3.5895), (-1.6305, 3.5895), (-0.8474, -2.3591), (0.8474, 2.3591)],
        ),
        ([0.523599, 0], 8, [1, 1.5], [(-4, 6.9282), (4, -6.9282)]),
    ],
)
def test_the_feasible_velocities_of_a_2r_with_bounds_on_its_joint_speeds(q, largest, joints, vertices):
    found = velocity_polytope(r1.textbook_robots.planar_arm("RR", [3, 2]), XY, q, velocity=[1, 1.5])
    assert found.largest == pytest.approx(largest, abs=1e-4)
    assert rows(found.vertices) == pytest.approx(rows(vertices), abs=2e-3)
    assert rows(found.joints_at_largest) == pytest.approx(rows([joints, [-x for x in joints]]))


def test_a_force_on_the_tip_of_a_spatial_4r():
    table = [("R", 0, 1.570796, 0, 0), ("R", 0, 1.570796, 0, 0), ("R", 0, 1.570796, 1, 0), ("R", 1, 0, 0, 0)]
    robot = r1.robot_from_dh(table)
    found = static_torques(robot, [0, 3 * pi / 4, pi, pi], Load([1, 0, 0]))
    assert found.torque == pytest.approx([0, 2**0.5, 0, 0.5**0.5], abs=1e-6)
    assert len(robot.warnings) == 3


@pytest.mark.parametrize(("load", "tau"), [([10, 10, 10], [30, 20, 10, 20]), ([-10, 10, -10], [30, 20, 10, 0])])
def test_a_force_and_a_couple_at_the_tip_of_a_planar_4r(load, tau):
    robot = r1.textbook_robots.planar_arm("RRRR", [1, 1, 1, 1])
    fx, fy, m = load
    held = static_torques(robot, [0, 0, pi / 2, -pi / 2], Load([fx, fy, 0], [0, 0, m]))
    assert -held.torque == pytest.approx(tau)  # the book exerts them


PUMA = r1.robot_from_dh(
    [
        *(("R", 0, pi / 2, 0, 0), ("R", 0.4318, 0, 0, 0), ("R", 0.0203, -pi / 2, 0.15005, 0)),
        *(("R", 0, pi / 2, 0.4318, 0), ("R", 0, -pi / 2, 0, 0), ("R", 0, 0, 0, 0)),
    ]
)


def test_twenty_newtons_on_a_puma():
    q = [0, pi / 4, pi, 0, pi / 4, 0]
    along_y, along_x = (-static_torques(PUMA, q, Load(f)).torque for f in ([0, 20, 0], [20, 0, 0]))
    assert along_y == pytest.approx([11.926062971, 0, 0, 0, 0, 0], abs=1e-8)
    assert along_x == pytest.approx([3.001, 0.287085353, 6.393659515, 0, 0, 0], abs=1e-8)


def test_measures_of_a_puma_and_the_one_that_changes_with_joint_4():
    tasks, q = (r1.PoseTask(), r1.PositionTask(), r1.OrientationTask()), [0, pi / 4, -pi, 1, pi / 4, 0]
    measures = [manipulability(PUMA, task, q).measure for task in tasks]
    assert measures == pytest.approx([0.078617165, 0.111181461, 2.593569027], rel=1e-7)
    moved = [manipulability(PUMA, task, [0, pi / 4, -pi, 0.4, pi / 4, 0]).measure for task in tasks]
    assert [a == pytest.approx(b) for a, b in zip(moved, measures, strict=True)] == [True, True, False]


def test_the_torques_of_a_differential_shoulder_follow_from_those_of_its_motors():
    A = [[-0.02381, 0, 0, 0], [0, 0.017699, -0.017699, 0], [0, -0.029735, -0.029735, 0], [0, 0, 0, -0.055556]]
    joints_of_motors = r1.textbook_robots.JointMap(A, np.zeros(4))
    back = joints_of_motors.inverse
    expected = [[-42, 0, 0, 0], [0, 28.25, -28.25, 0], [0, -16.815476, -16.815476, 0], [0, 0, 0, -18]]
    assert np.array([back.torques(e) for e in np.eye(4)]).T == pytest.approx(np.array(expected), rel=1e-4)


def test_the_pose_of_a_cable_arm_with_printed_angles_is_that_of_exact_ones():
    table = [("R", 0, -1.570796, 0, 0), ("R", 0, 1.570796, 0, 0), ("R", 0.045, -1.570796, 0.55, 0)]
    table += [("R", -0.045, 1.570796, 0, 0)]
    base, tool, q = np.eye(4), np.eye(4), [0.3, 0.5, -0.7, 0.9]
    base[:3, 3], tool[2, 3] = [0.22, 0.14, 0.346], 0.35
    robot = r1.textbook_robots.place_robot(r1.robot_from_dh(table), base_placement=base, tool_placement=tool)
    T = r1.forward_kinematics(robot, q).homogeneous
    expected = [[0.158165, 0.314077, 0.93613, 0.829858], [-0.370247, 0.897755, -0.238646, 0.13229]]
    assert T[:2] == pytest.approx(np.array(expected), abs=1e-6)
    exact = [(kind, a, np.sign(alpha) * pi / 2, d, theta) for kind, a, alpha, d, theta in table]
    assert pytest.approx(dh_pose(exact, q, "standard", base, tool), abs=1e-14) == T


def test_the_angular_velocity_on_either_side_of_a_rotation():
    R = r1.orientation.euler_to_rotation("ZXZ", [0.3, 0.5, 0])
    Omega = np.array([0.2, -0.4, 0.7])
    omega = R @ Omega
    assert omega == pytest.approx([0.393981, -0.59686, 0.422538], abs=1e-6)
    body = r1.orientation.rotation_rates(R, Omega, reference="body").first
    assert r1.orientation.rotation_rates(R, omega).first == pytest.approx(body)
