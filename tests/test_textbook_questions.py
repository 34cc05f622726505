"""Questions of other courses and textbooks, each answered by a few public calls; values are the published ones.

Those on statics, inverse kinematics, control, redundancy and workspaces stand with others of their topic;
docs/exam_questions.md lists all.
"""

from math import hypot, pi

import numpy as np
import pytest
import sympy
from formula_values import real, same

import robotics1 as r1
from robotics1 import singularities, trajectories, workspaces
from robotics1.orientation import align_two_directions
from robotics1.rigid_motions import adjoint, pose_exp, pose_log, robot_from_screws, screws

H = pi / 2
XY, XYZ = r1.PositionTask("xy"), r1.PositionTask()
Z = [0, 0, 1]


# --- forward kinematics and Jacobians of arms given by screws or by a table

SCARA = robot_from_screws(
    [[1, 0, 0, 0], [0, 1, 0, 2], [0, 0, 1, 1], [0, 0, 0, 1]],
    space=[(Z, [0, 0, 0]), (Z, [1, 0, 0]), (Z, [2, 0, 0]), ([0, 0, 0], Z)],
)
RRP = robot_from_screws(
    [[-1, 0, 0, 0], [0, 0, 1, 3], [0, 1, 0, 2], [0, 0, 0, 1]],
    space=[(Z, [0, 0, 0]), ([1, 0, 0], [0, 2, 0]), ([0, 0, 0], [0, 1, 0])],
)
RPRR = r1.robot_from_dh([("R", 0, H, 100, 0), ("P", 0, H, 0, H), ("R", 60, H, 0, 0), ("R", 0, H, 0, 0)])
AT = [3 * pi / 4, 200, pi / 4, -pi / 3]


def test_a_scara_of_screws_is_at_its_pose_and_has_its_body_screws():
    """Lynch and Park, exercise 4.2: from y = 2 the arm turns by 0, π/2, −π/2 and rises by 1."""
    T = r1.forward_kinematics(SCARA, [0, H, -H, 1])
    assert T.rotation == pytest.approx(np.eye(3), abs=1e-12)
    assert T.translation == pytest.approx([-1, 1, 2])
    wanted = [[Z, [-2, 0, 0]], [Z, [-1, 0, 0]], [Z, [0, 0, 0]], [[0, 0, 0], Z]]
    assert screws(SCARA, kind="body") == pytest.approx(np.array(wanted), abs=1e-12)


def test_an_rprr_arm_with_a_turned_slide_has_its_pose():
    T = r1.forward_kinematics(RPRR, AT)
    R = [
        [0.862372436, -0.5, -0.079459311],
        [-0.362372436, -0.5, -0.786566092],
        [0.353553391, 0.707106781, -0.612372436],
    ]
    assert T.rotation == pytest.approx(np.array(R), abs=1e-8)
    assert T.translation == pytest.approx([171.421356237, 171.421356237, 142.426406871])


def test_an_rprr_arm_has_its_geometric_jacobian_and_the_twist_of_joint_1_alone():
    J = r1.frame_jacobian(RPRR, AT)
    a, h, d = 171.421356237, 0.5**0.5, 42.426406871
    linear, angular = [[-a, h, 30, 0], [a, h, 30, 0], [0, 0, -d, 0]], [[0, 0, -h, -0.5], [0, 0, h, -0.5], [1, 0, 0, h]]
    assert pytest.approx(np.array(linear + angular), abs=1e-8) == J
    twist = J @ [0.0025 * pi, 0, 0, 0]
    assert twist == pytest.approx([-1.346340184, 1.346340184, 0, 0, 0, 0.007853982], abs=1e-8)


def test_an_rrp_arm_of_screws_has_its_pose_space_and_body_jacobian():
    """Lynch and Park, exercise 5.7, at (90°, 90°, 1)."""
    q = [H, H, 1]
    T = [[0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 1, 6], [0, 0, 0, 1]]
    assert r1.forward_kinematics(RRP, q).homogeneous == pytest.approx(np.array(T), abs=1e-12)
    space, body = (r1.frame_jacobian(RRP, q, kind=kind, angular_first=True) for kind in ("space", "body"))
    assert space.T == pytest.approx(np.array([[0, 0, 1, 0, 0, 0], [0, 1, 0, -2, 0, 0], [0, 0, 0, 0, 0, 1]]), abs=1e-12)
    assert body.T == pytest.approx(np.array([[0, 0, 1, 0, 0, 0], [-1, 0, 0, 0, 4, 0], [0, 0, 0, 0, 0, 1]]), abs=1e-12)


# --- control and statics of a planar arm that moves its tool steadily


def test_craigs_planar_3r_has_its_determinants_and_torques_at_both_ends():
    """L = (4, 3, 2): det J = l1 l2 s2; the force (1, 2) and the moment 3 need JᵀF."""
    arm, task = r1.textbook_robots.planar_arm("RRR", [4.0, 3.0, 2.0]), r1.PlanarPoseTask()
    ends = np.deg2rad([[10, 20, 30], [13.296567351, 14.78789044, -25.380237305]])
    J = task.jacobian(arm, ends)
    assert np.linalg.det(J) == pytest.approx([4.10424172, 3.06289695])
    assert singularities.exerting_torque(J[0], [1, 2, 3]) == pytest.approx([14.147970929, 6.964101615, 3.267949192])
    det = r1.formulas(arm, task).determinant
    assert same(det, 12 * sympy.sin(real("q2")))


UR5 = robot_from_screws(
    [[-1, 0, 0, 0.817], [0, 0, 1, 0.191], [0, 1, 0, -0.006], [0, 0, 0, 1]],
    space=[(Z, [0, 0, 0])]
    + [([0, 1, 0], [-0.089, 0, x]) for x in (0, 0.425, 0.817)]
    + [([0, 0, -1], [-0.109, 0.817, 0]), ([0, 1, 0], [0.006, 0, 0.817])],
)


def test_the_body_twist_iteration_of_a_ur5_has_its_table():
    """Three steps of q ← q + J_b⁻¹ log(T⁻¹ T_d), with a tolerance of ω and another of v."""
    T_d = [[0, 1, 0, -0.5], [0, 0, -1, 0.1], [-1, 0, 0, 0.1], [0, 0, 0, 1]]
    run = r1.iterate_ik(
        UR5, "pose", T_d, [6, -2.5, 4.5, -5, 3.5, 1.5], error="body", tolerance={"rad": 1e-3, "m": 1e-4}
    )
    assert run[1].q == pytest.approx([6.153570397, -2.462008604, 4.522023417, -5.137100164, 3.274424008, 1.640567144])
    assert run[3].q == pytest.approx([6.140404523, -2.479509792, 4.543550646, -5.20563307, 3.284371759, 1.570796656])
    assert run.error_norms["rad"] == pytest.approx([0.22301678, 0.010742381, 0.000765604, 1.683e-6], abs=1e-9)
    assert run.error_norms["m"] == pytest.approx([0.091968642, 0.013515977, 0.000265228, 6.94e-7], abs=1e-9)


# --- frames


def test_relative_pose_and_a_motion_in_body_and_in_space_axes():
    """Lynch and Park, exercise 3.16d: T_sa T moves {a} in its own axes, T T_sa in those of {s}."""
    a = np.array([[0, -1, 0, 3], [0, 0, -1, 0], [1, 0, 0, 0], [0, 0, 0, 1.0]])
    b = np.array([[1, 0, 0, 0], [0, 0, 1, 2], [0, -1, 0, 0], [0, 0, 0, 1.0]])
    assert pytest.approx(a @ [[0, -1, 0, 0], [-1, 0, 0, 3], [0, 0, -1, -2], [0, 0, 0, 1]]) == b
    in_body = np.array([[0, 0, -1, 1], [0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 1]])
    in_space = np.array([[0, -1, 0, 3], [1, 0, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]])
    twist = pose_log(b)  # a motion along it in the axes of {a} is one along Ad_a of it in those of {s}
    assert (pose_exp(adjoint(a) @ twist).homogeneous @ a) == pytest.approx(in_body, abs=1e-12)
    assert (a @ pose_exp(np.linalg.solve(adjoint(a), twist)).homogeneous) == pytest.approx(in_space, abs=1e-12)


def test_a_frame_taught_by_three_points_has_x_along_the_second_and_y_towards_the_third():
    origin, on_x, on_y = np.array([[0.25, 0.25, 0.15], [0.4526, 0.3357, 0.15], [0.0942, 0.6184, 0.15]])
    R = align_two_directions([1, 0, 0], on_x - origin, [0, 1, 0], on_y - origin).rotation
    wanted = [[0.920992346, -0.389580671, 0], [0.389580671, 0.920992346, 0], [0, 0, 1]]
    assert pytest.approx(np.array(wanted), abs=1e-9) == R


# --- manipulability


def test_a_planar_2r_is_isotropic_with_links_in_the_ratio_of_the_square_root_of_two():
    """J Jᵀ is a multiple of the identity at l1/l2 = √2 and θ2 = ±135°; the circle has the radius l2 = 1."""
    l1, c = real("l1 c")
    J = r1.formulas(r1.textbook_robots.planar_arm("RR", ["l1", 1]), XY).at(q1=0, q2=sympy.acos(c)).jacobian
    M = J * J.T
    assert {l1: sympy.sqrt(2), c: -sympy.sqrt(2) / 2} in sympy.solve([M[0, 1], M[0, 0] - M[1, 1]], [l1, c], dict=True)
    arm = r1.textbook_robots.planar_arm("RR", [2**0.5, 1])
    circles = [singularities.manipulability(arm, XY, [0.3, side * 3 * pi / 4]) for side in (1, -1)]
    assert [circle.condition for circle in circles] == pytest.approx([1, 1])
    assert circles[0].velocity_ellipsoid.lengths == pytest.approx([1, 1])


# --- singularities


def test_the_pose_of_a_planar_4r_is_singular_where_its_four_axes_are_in_one_plane():
    """Lynch and Park, exercise 5.3e: sin θ2 = sin θ3 = 0; θ1 and θ4 are free."""
    arm, task = r1.textbook_robots.planar_arm("RRRR", [1, 1, 1, 1]), r1.PlanarPoseTask()
    found = r1.find_singularities(arm, task)
    assert {branch.free_joints for branch in found.branches} == {("q1", "q4")}
    angles = {tuple(round(float(np.cos(branch.q[i])), 9) for i in (1, 2)) for branch in found.branches}
    assert angles == {(1, 1), (1, -1), (-1, 1), (-1, -1)}
    assert found.complete
    ranks = [r1.subspaces(task.jacobian(arm, q)).rank for q in ([0.3, 0, 0, 0.7], [0.3, 0, 0.5, 0])]
    assert ranks == [2, 3]


def test_the_determinant_of_an_orthogonal_3r_arm_has_two_factors():
    """a3 (a2 + a3 c3) (a1 s3 − d2 c2 c3 + a2 c2 s3): the first vanishes nowhere with a2 = 2, a3 = 1.5."""
    arm = r1.robot_from_dh([("R", 1, -H, 0, 0), ("R", 2, H, 1, 0), ("R", 1.5, 0, 0, 0)])
    det, (q2, q3) = r1.formulas(arm, XYZ).determinant, real("q2 q3")
    c2, c3, s3 = sympy.cos(q2), sympy.cos(q3), sympy.sin(q3)
    wanted = sympy.Rational(3, 2) * (2 + sympy.Rational(3, 2) * c3) * (s3 - c2 * c3 + 2 * c2 * s3)
    assert same(det**2, wanted**2)
    assert abs(np.linalg.det(XYZ.jacobian(arm, [0.2, 0.5, 1.0]))) == pytest.approx(7.774690738)
    (branch,) = r1.find_singularities(arm, XYZ).branches  # (1 + 2 c2) s3 − c2 c3 = 0: the other factor vanishes nowhere
    angles = r1.ik.solve_trig(1 + 2 * np.cos(0.5), -np.cos(0.5), 0).solutions
    assert sorted(angles) == pytest.approx([-2.833230383, 0.30836227])
    assert all(branch.contains(np.array([0.2, 0.5, float(angle)])) for angle in angles)


# --- motions


def test_a_clamped_cubic_spline_has_its_velocities_and_accelerations_at_the_knots():
    """Biagiotti and Melchiorri, section 4.4."""
    t = [0, 5, 7, 8, 10, 15, 18]
    spline = trajectories.cubic_spline(t, [3, -2, -5, 0, 6, 12, 8], v0=2, v1=-3)
    v = [2, -3.430333475, 3.10493373, 5.150365549, 1.887939248, 0.008511391, -3]
    a = [-1.42786661, -0.74426678, 7.279533984, -3.188670346, -0.073755955, -0.678015188, -1.327659073]
    assert spline.velocity(t).ravel() == pytest.approx(v, abs=1e-8)
    assert spline.acceleration(t).ravel() == pytest.approx(a, abs=1e-8)
    assert abs(spline.peak(2).value) == pytest.approx(7.279533984)


def test_a_polynomial_in_time_has_its_state_at_the_end():
    motion = r1.curves.formula_path(["30 + t**2 - 6*t**3"], "t", 3)
    state = [motion(3), motion.velocity(3), motion.acceleration(3)]
    assert np.ravel(state) == pytest.approx([-123, -156, -106])


# --- workspace


@pytest.mark.parametrize(("upper_arm", "straight"), [(0.54, 1.249039631077), (0.71, 1.417956275772)])
def test_a_cobot_reaches_with_its_arm_straight_less_than_it_can(upper_arm, straight):
    """Its maker's figure is hypot(a + 0.54 + 0.16, 0.15); the largest distance is a + hypot(0.7, 0.15) [m]."""
    rows = [("R", 0, 0, 0, 0), ("R", 0, -H, 0, -H), ("R", upper_arm, pi, 0, 0), ("R", 0, -H, -0.54, 0)]
    arm = r1.robot_from_dh([*rows, ("R", 0, H, 0.15, 0), ("R", 0, -H, -0.16, 0)], convention="modified")
    in_line = XYZ.value(arm, [0, 0, H, 0, 0, 0])
    assert np.linalg.norm(in_line) == pytest.approx(straight)
    assert workspaces.extreme_reach(arm, XYZ).value == pytest.approx(upper_arm + hypot(0.7, 0.15))


def test_a_scara_with_limits_has_its_inner_radius_and_its_area():
    arm = r1.robot_from_dh(
        [("R", 0.4, 0, 0, 0), ("R", 0.3, 0, 0, 0)], upper=np.radians([130, 145]), lower=np.radians([-130, -145])
    )
    ws = workspaces.workspace(arm, XY)
    assert (ws.r_min, ws.r_max, ws.area) == pytest.approx((0.231091993, 0.7, 1.24234452))
