"""Exam questions of 2010 to 2012 about timing, joint motions and splines, each in a few public calls.

Printed numbers hold to the digits that are printed.
"""

from math import pi, sqrt

import numpy as np
import pytest

import robotics1 as r1

PRINTED = 1e-3


# --- 2012.01.11, exercise 2: a planar 3R arm between two poses in the least time


@pytest.fixture(scope="module")
def moves():
    """The fastest motion to each of the inverse solutions of the second pose, each joint at its own least time."""
    arm = r1.robot_from_dh([("R", 1, 0, 0, 0), ("R", 0.5, 0, 0, 0), ("R", 0.25, 0, 0, 0)])
    solutions = r1.ik_solutions(arm, r1.PlanarPoseTask(), [1.25, 0.5, 0])
    limits = r1.MotionLimits(np.radians([90, 120, 60]), np.radians([150, 160, 240]))
    q = sorted(solutions.q.tolist())
    return q, [r1.minimum_time([0, 0, 0], goal, limits, coordination="independent") for goal in q]


def test_2012_01_11_2a_the_better_of_two_inverse_solutions_takes_1_5_s(moves):
    q, (first, second) = moves
    assert q == [pytest.approx([0, pi / 2, -pi / 2], abs=1e-6), pytest.approx([0.927295, -pi / 2, 0.643501], abs=1e-6)]
    assert first.joint_durations == pytest.approx([0, 1.5, 1.75], abs=PRINTED)
    assert second.joint_durations == pytest.approx([1.1903, 1.5, 0.8645], abs=PRINTED)
    assert min(first.duration, second.duration) == second.duration == pytest.approx(1.5, abs=PRINTED)


def test_2012_01_11_2b_peak_speeds_and_switching_times_of_each_joint(moves):
    laws = moves[1][1].laws
    assert [np.degrees(law.peak(1).value) for law in laws] == pytest.approx([89.27, -120, 60], abs=0.01)
    switches = [t for law in laws for t in (*law.breakpoints, law.duration)]
    assert switches == pytest.approx([0.5951, 1.1903, 0.75, 1.5, 0.25, 0.6145, 0.8645], abs=PRINTED)
    assert [law.cruise_time for law in laws] == pytest.approx([0, 0, 0.3645], abs=PRINTED)  # two triangles, a trapezoid
    fastest = {use.joint for use in moves[1][1].active if use.quantity == "velocity"}
    assert fastest == {1, 2}  # of joint 1 at the tip of the triangle: V²/A is Δ


def test_2012_01_11_2c_the_motion_is_not_unique_where_joints_have_slack(moves):
    answer = moves[1][1]
    assert not answer.unique
    assert answer.slack == pytest.approx([0.3097, 0, 0.6355], abs=PRINTED)


# --- 2011.02.25: a periodic motion of a 3R arm

START, HALF = np.array([pi / 2, pi / 4, pi / 4]), np.array([pi / 4, -pi / 6, pi / 3])


def test_2011_02_25_a_cosine_motion_there_and_back():
    """q = q_start + A (1 − cos 2πt/T), T = 2: in T/2 a cosine law from q_start to q_half, and back."""
    there, back = r1.trajectories.cosine(START, HALF, 1.0), r1.trajectories.cosine(HALF, START, 1.0)
    assert (HALF - START) / 2 == pytest.approx([-0.392699, -0.654498, 0.1309], abs=1e-6)
    assert [abs(peak.value) for peak in there.peaks(1)] == pytest.approx([1.2337, 2.0562, 0.4112], abs=PRINTED)
    assert there.acceleration(0) == pytest.approx([-3.8758, -6.4596, 1.2919], abs=PRINTED)
    for rate in ("velocity", "acceleration", "jerk"):  # smooth where it turns, and where it begins again
        assert getattr(there, rate)(1.0) == pytest.approx(getattr(back, rate)(0.0), abs=1e-9)
        assert getattr(back, rate)(1.0) == pytest.approx(getattr(there, rate)(0.0), abs=1e-9)


LAW = r1.cubic(0, 1, 2).joint()  # λ = 3τ² − 2τ³, T = 2
RETRACED = r1.curves.PathTrajectory(  # q(λ) = q_start + A (1 − cos 2πλ)
    r1.curves.formula_path(
        [f"q{i} + (h{i} - q{i})/2*(1 - cos(2*pi*s))" for i in range(3)],
        "s",
        1.0,
        values={f"q{i}": q for i, q in enumerate(START)} | {f"h{i}": q for i, q in enumerate(HALF)},
    ),
    LAW,
)


def test_2011_02_25_c_the_same_path_retraced_with_a_cubic_law():
    peaks = [[abs(peak.value) for peak in RETRACED.peaks(order)] for order in (1, 2)]
    assert peaks[0] == pytest.approx([1.6522, 2.7537, 0.5507], abs=PRINTED)
    assert peaks[1] == pytest.approx([8.7205, 14.5342, 2.9068], abs=PRINTED)
    assert RETRACED.acceleration([0, 2]) == pytest.approx(np.zeros((2, 3)), abs=1e-9)
    assert RETRACED.velocity(1) == pytest.approx([0] * 3, abs=1e-9)
    assert RETRACED.acceleration(1) == pytest.approx([8.7205, 14.5342, -2.9068], abs=PRINTED)


def test_2011_02_25_c_velocity_and_acceleration_of_the_retraced_path_are_its_formulas():
    """q̈ = 2π A sin(2πλ) λ̈ + 4π² A cos(2πλ) λ̇²: the printed minus sign is an erratum."""
    A, (lam, rate, second) = (HALF - START) / 2, (LAW.derivative(0.3, order) for order in range(3))
    assert RETRACED.velocity(0.3) == pytest.approx(2 * pi * A * np.sin(2 * pi * lam) * rate)
    wanted = 2 * pi * np.sin(2 * pi * lam) * second + 4 * pi**2 * np.cos(2 * pi * lam) * rate**2
    assert RETRACED.acceleration(0.3) == pytest.approx(A * wanted)


# --- 2010.09.15: seven phases


def test_2010_09_15_i_displacement_of_seven_phases_with_a_given_cruise_time():
    v, a, j, Tv = 3, 5, 12, 2
    law = r1.trajectories.cruise_profile(v, Tv, acceleration=a, jerk=j)
    assert law(law.end) == pytest.approx(v * (Tv + v / a + a / j))
    assert (law(law.end), law.duration) == pytest.approx((9.05, 4.0333), abs=PRINTED)
    Ts, Ta = (phase.duration for phase in law.phases[:2])
    assert (Ts, Ta) == pytest.approx((0.41667, 0.18333), abs=1e-5)


def test_2010_09_15_ii_minimum_time_of_seven_phases():
    v, a, j, dq = 2, 4, 10, 3
    law = r1.minimum_time(0, dq, r1.MotionLimits(v, a, j), "double_s").laws[0]
    assert law.duration == pytest.approx(dq / v + v / a + a / j)
    assert law.duration == pytest.approx(2.4)
    Ts, Ta, _, Tv = (phase.duration for phase in law.phases[:4])
    assert (Ts, Ta, Tv) == pytest.approx((0.4, 0.1, 0.6))
    low = r1.minimum_time(0, dq, r1.MotionLimits(1.5, a, j), "double_s")  # v < a²/j: a is not reached
    assert low.duration == pytest.approx(dq / 1.5 + 2 * sqrt(1.5 / j))
    near = r1.minimum_time(0, 1.5, r1.MotionLimits(v, a, j), "double_s")  # dq < v (v/a + a/j): v is not reached
    assert near.laws[0].cruise_time == 0


# --- 2010.02.11: a joint path through a via point

IN, MID, FIN = np.array([-2.159827, -2.619278]), np.array([0, -3.141593]), np.array([1.181036, -5.419973])


def in_powers_of_s(spline):
    """The coefficients of both halves in s."""
    first, second = (piece.coefficients_t for piece in spline.pieces)
    shift = np.array([[1, -0.5, 0.25], [0, 1, -1], [0, 0, 1]])  # (s − ½)ᵏ in powers of s
    return first, shift[:, : len(second)] @ second


def test_2010_02_11_c_quadratic_then_linear_with_continuous_tangent():
    path = r1.trajectories.polynomial_spline([0, 0.5, 1], [IN, MID, FIN], (2, 1), (), continuity=1)
    first, second = in_powers_of_s(path)
    assert first == pytest.approx(np.array([IN, 6 * MID - 4 * IN - 2 * FIN, 4 * FIN - 8 * MID + 4 * IN]))
    assert second[:2] == pytest.approx(np.array([2 * MID - FIN, 2 * (FIN - MID)]))
    assert path.velocity(0.5) == pytest.approx([2.362071, -4.556762], abs=1e-5)
    assert path(1.0) == pytest.approx([1.181, -5.42], abs=PRINTED)  # not wrapped: the second joint turned on
    arm = r1.robot_from_dh([("R", 0.6, 0, 0, 0), ("R", 0.5, 0, 0, 0)])
    assert r1.forward_kinematics(arm, MID).translation[:2] == pytest.approx([0.1, 0], abs=1e-6)


def test_2010_02_11_e_two_quadratics_with_a_given_tangent_at_the_middle():
    t = np.array([1.3, -2.1])
    path = r1.trajectories.polynomial_spline([0, 0.5, 1], [IN, MID, FIN], (2, 2), [(1, 1, t)], continuity=1)
    first, second = in_powers_of_s(path)
    assert first == pytest.approx(np.array([IN, 4 * (MID - IN) - t, 4 * (IN - MID) + 2 * t]))
    assert second == pytest.approx(np.array([FIN - t, 4 * (MID - FIN) + 3 * t, 4 * (FIN - MID) - 2 * t]))
    smooth = r1.trajectories.polynomial_spline([0, 0.5, 1], [IN, MID, FIN], (2, 2), ())
    assert smooth.velocity(0.5) == pytest.approx(FIN - IN)
    assert smooth.velocity(0.5) == pytest.approx([3.3408, -2.8007], abs=PRINTED)
    assert smooth.breakpoints.size == 0  # the curvature is continuous too


def test_2010_02_11_f_one_timing_law_for_all_joints_keeps_the_path():
    path = r1.trajectories.polynomial_spline([0, 0.5, 1], [IN, MID, FIN], (2, 1), (), continuity=1)
    motion = r1.curves.PathTrajectory(path, r1.quintic(0, 1, 3).joint())
    s = r1.quintic(0, 1, 3)([0.4, 1.5, 2.2])[:, 0]
    assert motion([0.4, 1.5, 2.2]) == pytest.approx(path(s))
    assert motion.velocity([0, 3]) == pytest.approx(np.zeros((2, 2)), abs=1e-12)
    straight = r1.minimum_time(IN, MID, r1.MotionLimits([1, 2], [3, 2]), coordination="straight")
    s = (straight.trajectory(np.linspace(0, straight.duration, 20)) - IN) / (MID - IN)
    assert s[:, 0] == pytest.approx(s[:, 1], abs=1e-12)
