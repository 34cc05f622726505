"""Facts of Robotics 1 exams of 2009 to 2013 about Cartesian paths and differential kinematics.

Topics: traj-cartesian and diff-kin-higher; and of redundancy and kin-control what is one call to the same functions.
"""

from math import cos, pi, sin, sqrt

import numpy as np
import pytest

import robotics1 as r1

PRINTED = 1e-3
up = pi / 2


# --- traj-cartesian


HELIX = r1.curves.formula_path(["R*cos(s)", "R*sin(s)", "h*s"], "s", 11.9, values={"R": 0.3, "h": 0.1})


def test_2010_01_12_a_1a_helix_under_bounds_on_speed_and_acceleration():
    bounds = r1.trajectories.timing_bounds(HELIX, 1.0, 5.0)
    v, a, T = bounds.velocity, bounds.acceleration, 4.0
    law = r1.trajectories.cruise_profile(v, T - 2 * v / a, acceleration=a)
    motion = r1.curves.PathTrajectory(HELIX, law)
    assert (v, a) == pytest.approx((1 / sqrt(0.3**2 + 0.1**2), sqrt((25 - (0.3 / 0.1) ** 2) / 0.1)))
    assert (v, a, law.breakpoints[0]) == pytest.approx((3.1623, 12.6491, 0.25), abs=PRINTED)
    assert law(law.end) == pytest.approx(11.8585, abs=PRINTED)
    assert motion(T) == pytest.approx([0.2279, -0.1951, 1.1859], abs=PRINTED)
    peaks = [r1.trajectories.peak_norm(motion, quantity).value for quantity in ("velocity", "acceleration")]
    assert peaks == pytest.approx([1.0, 5.0])


def test_2010_01_12_b_1_frame_that_looks_at_the_axis_of_the_helix_turns_with_sdot():
    bounds = r1.trajectories.timing_bounds(HELIX, 1.0, 5.0)
    law = r1.trajectories.cruise_profile(bounds.velocity, 3.5, acceleration=bounds.acceleration)
    towards_axis = r1.curves.turn_path([[-1, 0, 0], [0, -1, 0], [0, 0, 1]], [0, 0, 1], HELIX.end)
    motion = r1.curves.PathTrajectory(r1.curves.PosePath(HELIX, towards_axis), law)
    assert r1.trajectories.peak_norm(motion, rows=slice(3, 6)).value == pytest.approx(3.1623, abs=PRINTED)
    T = motion(1.3)
    assert T.rotation[:, 0] == pytest.approx(-T.translation * [1, 1, 0] / 0.3)
    assert motion(4.0).translation[2] == pytest.approx(1.1859, abs=PRINTED)


T_A = np.array([[1, 0, 0, 1], [0, 0, -1, 1], [0, 1, 0, 1], [0, 0, 0, 1]])
T_B = np.array([[0, -1, 0, 1], [1, 0, 0, 0], [0, 0, 1, -0.5], [0, 0, 0, 1]])


def pose_motion():
    path = r1.curves.pose_line(T_A, T_B)
    return r1.curves.PathTrajectory(path, r1.cubic(0, path.end, 2.0).joint())


def test_2009_07_10_2a_straight_line_and_reorientation_about_a_fixed_axis():
    path = r1.curves.pose_line(T_A, T_B)
    assert path.end == pytest.approx(1.802776, abs=1e-6)
    assert path.orientation.angle == pytest.approx(2.0944, abs=1e-4)
    assert T_A[:3, :3].T @ path.orientation.axis == pytest.approx(np.array([-1, 1, 1]) / sqrt(3))
    R_AB = T_A[:3, :3].T @ path(path.end).rotation
    assert R_AB == pytest.approx(np.array([[0, -1, 0], [0, 0, 1], [-1, 0, 0]]), abs=1e-12)
    motion, tau = pose_motion(), 0.35
    assert motion.law(2 * tau) == pytest.approx(path.end * (3 * tau**2 - 2 * tau**3))
    assert not motion.velocity(np.array([0.0, 2.0])).any()


def test_2009_07_10_2b_twist_in_the_middle_of_the_motion():
    """The printed velocities are those of T = 1: twice too large for T = 2."""
    twist = pose_motion().velocity(1.0)
    assert twist[:3] == pytest.approx([0, -0.75, -1.125], abs=PRINTED)
    assert twist[3:] == pytest.approx([-0.9069, -0.9069, 0.9069], abs=PRINTED)
    assert T_A[:3, :3].T @ twist[3:] == pytest.approx([-0.9069, 0.9069, 0.9069], abs=PRINTED)


# --- diff-kin-higher


SHOULDER = r1.robot_from_dh(
    [("R", "L1", up, "D", 0), ("R", "L2", 0, 0, 0), ("R", "L3", 0, 0, 0)],
    parameters={"D": 0.5, "L1": 0.1, "L2": 0.4, "L3": 0.3},
)


@pytest.mark.parametrize(("A", "w"), [(2.0, 1.5), (-1.0, 0.7)])
def test_2011_02_03_4_accelerations_for_a_tip_acceleration_along_y_of_the_last_frame(A, w):
    q, qdot, xyz = [0, pi / 4, -pi / 4], [w, 0, 0], r1.PositionTask("xyz")
    acc = r1.forward_kinematics(SHOULDER, q).rotation @ [0, A, 0]
    found = r1.joint_acceleration(SHOULDER, xyz, acc, q, qdot)
    reach = 0.1 + 0.4 * sqrt(2) / 2 + 0.3
    second = -sqrt(2) / 0.4 * reach * w**2
    assert acc == pytest.approx([0, 0, A])
    assert found.drift == pytest.approx([-reach * w**2, 0, 0], abs=1e-10)
    assert found.qddot == pytest.approx([0, second, A / 0.3 + (1 / 0.3 + sqrt(2) / 0.4) * reach * w**2], abs=1e-9)


def test_2011_02_03_4_in_numbers_and_the_acceleration_for_which_joint_2_alone_accelerates():
    q, qdot, xyz = [0, pi / 4, -pi / 4], [1.5, 0, 0], r1.PositionTask("xyz")
    both = r1.joint_acceleration(SHOULDER, xyz, [0, 0, 2], q, qdot).qddot
    assert both == pytest.approx([0, -5.431981, 17.219968], abs=1e-6)
    none = r1.joint_acceleration(SHOULDER, xyz, [0, 0, 0], q, qdot).qddot  # q̈3 is linear in A
    single = 2 * none[2] / (none[2] - both[2])
    assert single == pytest.approx(-3.16599, abs=1e-5)
    only = r1.joint_acceleration(SHOULDER, xyz, [0, 0, single], q, qdot).qddot
    assert only == pytest.approx([0, only[1], 0], abs=1e-9)


# --- redundancy


def planar(*lengths):
    return r1.robot_from_dh([("R", length, 0, 0, 0) for length in lengths])


def test_2013_01_09_2c_least_norm_velocity_of_a_planar_4r():
    """The printed norm is that of the first three components; of the vector it is 1.4322."""
    found = r1.joint_velocity(planar(1, 1, 1, 1), r1.PositionTask("xy"), [1, 0], [0, 0, -pi / 4, pi / 2])
    assert found.qdot == pytest.approx([0.1752, 0.1239, 0.0726, -1.4142], abs=PRINTED)
    assert np.linalg.norm(found.qdot) == pytest.approx(1.4322, abs=PRINTED)


THREE = [("R", 0.2, up, 0, 0), ("R", 0.5, 0, 0, 0), ("R", 0.5, 0, 0, 0)]


def test_2012_09_10_5_velocities_for_an_angular_velocity_of_a_3r_whose_jacobian_is_singular():
    arm, q, omega = r1.robot_from_dh(THREE), [0, pi / 4, -pi / 4], [0, -3, 0.949169]
    found = r1.joint_velocity(arm, r1.OrientationTask(), omega, q)
    assert found.qdot == pytest.approx([0.9492, 1.5, 1.5], abs=PRINTED)
    assert (np.linalg.norm(found.qdot), found.rank) == (pytest.approx(2.324, abs=PRINTED), 2)
    null = r1.subspaces(r1.OrientationTask().jacobian(arm, q)).null[:, 0]
    assert null / null[1] == pytest.approx([0, 1, -1], abs=1e-9)
    given = [0.9492, -2.8284, 5.8284]
    kept = r1.joint_velocity(arm, r1.OrientationTask(), omega, q, null_velocity=given)
    assert kept.qdot == pytest.approx(given, abs=PRINTED)
    assert (found.qdot - given) @ [0, 1, -1] / 2 == pytest.approx(4.3284, abs=PRINTED)


SCARA = [("R", 1, 0, 0, 0), ("R", 1, 0, 0, 0), ("P", 0, 0, 0, 0), ("R", 0, 0, 0, 0)]


def test_2011_09_12_b_twist_of_a_scara_in_a_singular_configuration():
    arm, q, twist = r1.robot_from_dh(SCARA), [pi / 4, 0, 1, 0], [1, -1, 1, 0, 0, -1]
    found = r1.joint_velocity(arm, r1.PoseTask(), twist, q)
    assert (found.rank, found.feasible) == (3, True)
    assert found.qdot == pytest.approx([-0.5404, -0.3333, 1, -0.1262], abs=PRINTED)
    assert np.linalg.norm(found.qdot) == pytest.approx(1.1913, abs=PRINTED)
    null = r1.subspaces(r1.PoseTask().jacobian(arm, q)).null[:, 0]
    assert null * np.sign(null[0]) == pytest.approx([0.4082, -0.8165, 0, 0.4082], abs=PRINTED)
    other = r1.joint_velocity(arm, r1.PoseTask(), twist, q, null_velocity=null * np.sign(null[0]))
    assert other.qdot == pytest.approx([-0.1322, -1.1498, 1, 0.282], abs=PRINTED)
    assert np.linalg.norm(other.qdot) == pytest.approx(1.5553, abs=PRINTED)


def test_2009_12_17_3_twist_of_a_spatial_4r_has_one_solution():
    rows = [("R", 0, up, 0, 0), ("R", 0, up, 0, 0), ("R", 0, up, 1, 0), ("R", 1, 0, 0, 0)]
    arm, q, twist = r1.robot_from_dh(rows), [0, 2.356194, 3.141593, 3.141593], [0, 0, -1, 0, -0.707107, 0]  # as printed
    found = r1.joint_velocity(arm, r1.PoseTask(), twist, q)
    assert found.qdot == pytest.approx([0, -0.707107, 0, 1.414214], abs=1e-6)
    assert np.linalg.norm(found.qdot) == pytest.approx(1.5811, abs=PRINTED)
    assert (found.rank, found.feasible) == (4, True)


# --- kin-control


def test_2012_02_09_3b_initial_velocities_of_a_cartesian_and_a_joint_tracking_law():
    arm = r1.robot_from_dh([("R", 0, up, 1, 0), ("R", 0, up, 0, 0), ("P", 0, 0, 0, 0)])
    q0, xyz = np.array([pi / 3, pi / 2, 1]), r1.PositionTask("xyz")
    path = r1.line_path([1, 1, 1], [-1, 1, 3])
    motion = r1.curves.PathTrajectory(path, r1.cubic(0, path.end, path.end, v0=1, v1=1).joint())
    assert motion.duration == pytest.approx(2.828427, abs=1e-6)
    run = r1.follow_trajectory(arm, xyz, motion, q0, gain=1.0)
    assert run.errors[0] == pytest.approx([0.5, 0.133975, 0], abs=1e-6)
    assert run.velocity(0.0) == pytest.approx([0.246347, 0.707107, 0.012472], abs=1e-6)
    e = xyz.error(arm, run(1.7), motion(1.7))
    assert e == pytest.approx(np.exp(-1.7) * np.array([0.5, 0.133975, 0]), abs=1e-6)  # what starts at zero stays
    on_path = [pi / 4, pi / 2, sqrt(2)]
    assert r1.forward_kinematics(arm, on_path).translation == pytest.approx(motion(0.0))
    second = r1.joint_velocity(arm, xyz, motion.velocity(0.0), on_path).qdot + (on_path - q0)
    assert second == pytest.approx([0.091754, 0.5, -0.085786], abs=1e-6)


def test_2010_06_15_1b_acceleration_law_of_one_row_of_a_planar_rp_arm():
    arm = r1.robot_from_dh([("R", 0, up, 0, up), ("P", 0, 0, 0, 0)])
    q, qdot, y = np.array([0.4, 0.9]), [0.3, -0.2], r1.PositionTask("y")
    J = y.jacobian(arm, q)
    asked = 0.2 + 4 * (0.1 - J @ qdot) + 4 * y.error(arm, q, [0.5])
    found = r1.joint_acceleration(arm, y, asked, q, qdot)
    assert np.array([[0.9 * cos(0.4), sin(0.4)]]) == pytest.approx(J)
    assert found.qddot == pytest.approx([0.649232, 0.30499], abs=1e-6)
    rate = r1.trajectories.jacobian_rate(arm, y, q, qdot)
    assert rate == pytest.approx(np.array([[-0.2 * cos(0.4) - 0.9 * sin(0.4) * 0.3, cos(0.4) * 0.3]]), abs=1e-11)


def test_2010_01_12_b_2b_acceleration_law_of_a_cylindrical_arm():
    arm = r1.robot_from_dh([("R", 0, 0, 0, 0), ("P", 0, up, 0, up), ("P", 0, 0, 0, 0)])
    q, qdot, xyz = np.array([0.5, 0.2, 0.8]), np.array([0.4, -0.1, 0.3]), r1.PositionTask("xyz")
    p = r1.forward_kinematics(arm, q).translation
    rdot = xyz.jacobian(arm, q) @ qdot
    asked = [0, 0.3, 0.1] + 4 * ([0.1, 0, -0.2] - rdot) + 4 * ([0.7, 0.5, 0.3] - p)
    found = r1.joint_acceleration(arm, xyz, asked, q, qdot)
    assert found.qddot == pytest.approx([-1.294652, 0.1, -0.361057], abs=1e-6)
    s, c = sin(0.5), cos(0.5)
    expected = [-2 * 0.3 * 0.4 * s - 0.8 * 0.16 * c, 2 * 0.3 * 0.4 * c - 0.8 * 0.16 * s, 0]
    assert found.drift == pytest.approx(expected, abs=1e-11)
