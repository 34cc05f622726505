"""Facts of Robotics 1 exams of 2009 to 2013 about redundancy and kinematic control, in the calls of their own topic.

`test_exams_paths.py` has those that are one call to the resolved rates.
"""

from math import atan, pi, tan

import numpy as np
import pytest
import sympy

import robotics1 as r1
from robotics1.control import cartesian_law, joint_law, largest_gains
from robotics1.redundancy import redundancy_formulas

PRP = r1.textbook_robots.robot_from_formula(["q3*sin(q2)", "q1 - q3*cos(q2)", "q2 - pi/2"], joints="PRP")
q1, q2, q3 = sympy.symbols("q1 q2 q3", real=True)


def test_2009_06_10_c_a_velocity_of_a_planar_prp_arm_that_only_turns():
    """q̇ = (q3/sin q2, −1, q3 cos q2/sin q2): joint 1 exceeds V1 where q3 > V1 |sin q2|."""
    J = r1.formulas(PRP, PRP.task)
    assert sympy.simplify(abs(J.determinant) - abs(sympy.sin(q2))) == 0
    qdot = redundancy_formulas(PRP, PRP.task).pseudoinverse * sympy.Matrix([0, 0, -1])
    wanted = sympy.Matrix([q3 / sympy.sin(q2), -1, q3 * sympy.cos(q2) / sympy.sin(q2)])
    assert sympy.simplify(qdot - wanted) == sympy.zeros(3, 1)


def test_2009_06_10_c_b_gains_that_reduce_the_error_as_fast_as_the_rates_allow():
    wanted = r1.cubic([1.5, 1.5, -pi / 4], [1.5, 2.5, -pi / 4], 1.0, v0=[0, 1, 0], v1=[0, 1, 0])
    q0 = [1.2, pi / 2, 1.0]
    K = largest_gains(PRP, PRP.task, wanted, q0, limits=[5, pi, 4])
    now = cartesian_law(PRP, PRP.task, wanted, K).command(q0)
    assert now.error == pytest.approx([0.5, 0.3, -pi / 4])
    assert K == pytest.approx([8, 2.8614, 4], abs=1e-4)
    assert now.joints == pytest.approx([5, -pi, 4])


def test_2012_02_09_3b_laws_in_cartesian_and_in_joint_space():
    arm, xyz = r1.robot_from_dh([("R", 0, pi / 2, 1, 0), ("R", 0, pi / 2, 0, 0), ("P", 0, 0, 0, 0)]), r1.PositionTask()
    path = r1.line_path([1, 1, 1], [-1, 1, 3])
    motion = r1.curves.PathTrajectory(path, r1.cubic(0, path.end, path.end, v0=1, v1=1))
    q0 = [pi / 3, pi / 2, 1]
    cartesian = cartesian_law(arm, xyz, motion, 1.0)
    assert cartesian.command(q0).joints == pytest.approx([0.246347, 0.707107, 0.012472], abs=1e-6)
    assert cartesian.decay(q0)(2.0) == pytest.approx(np.exp(-2.0) * np.array([0.5, 0.133975, 0]), abs=1e-6)
    along = r1.follow_trajectory(arm, xyz, motion, [pi / 4, pi / 2, np.sqrt(2)])
    joint = joint_law(arm, along, 1.0).command(q0)
    assert joint.joints == pytest.approx([0.091754, 0.5, -0.085786], abs=1e-6)


def test_2012_07_05_2_sliders_that_tilt_a_bar_with_their_mean_in_the_middle():
    """α = atan((q1 − q2)/(D − 2 d)), β = q3: q1 = H/2 + (D − 2 d) tan α/2, q2 = H/2 − (D − 2 d) tan α/2."""
    D, H, d, alpha, beta = 10.0, 5.0, 0.75, 0.3, 0.2
    arm = r1.textbook_robots.robot_from_formula(
        ["atan((q1 - q2)/8.5)", "q3"], joints="PPR", lower=[0, 0, -pi], upper=[H, H, pi]
    )
    best = r1.ik.self_motion(arm, arm.task, [alpha, beta], criterion="middle", starts=5).best
    half = (D - 2 * d) * tan(alpha) / 2
    assert best == pytest.approx([H / 2 + half, H / 2 - half, beta], abs=1e-5)
    assert arm.task.value(arm, [H, 0, 0])[0] == pytest.approx(0.5317, abs=1e-4)
    assert atan(H / (D - 2 * d)) == pytest.approx(0.5317, abs=1e-4)


def test_craig_constant_tool_velocity_of_a_planar_3r_arm_for_five_seconds():
    """L = (4, 3, 2) from (10°, 20°, 30°) with (ẋ, ẏ, ω) = (0.2, −0.3, −0.2)."""
    arm, task = r1.textbook_robots.planar_arm("RRR", [4.0, 3.0, 2.0]), r1.PlanarPoseTask()
    q0, v = np.deg2rad([10.0, 20, 30]), np.array([0.2, -0.3, -0.2])
    start = task.value(arm, q0)
    wanted = r1.cubic(start, start + 5 * v, 5.0, v0=v, v1=v)
    run = r1.control.simulate_law(cartesian_law(arm, task, wanted, 1.0), q0, samples=3)
    assert run.qdot[0] == pytest.approx([-0.129228441, 0.28667597, -0.35744753], abs=1e-8)
    assert np.rad2deg(run.q[-1]) == pytest.approx([13.296567351, 14.78789044, -25.380237305], abs=1e-5)
