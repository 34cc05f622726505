"""Kinematic control laws: commands, closed forms of their errors, gains from a specification, Lyapunov rates."""

from math import cos, exp, log, pi, sin, sqrt

import numpy as np
import pytest
import sympy
from hypothesis import given, strategies as st
from numpy.testing import assert_allclose

import robotics1 as r1
from robotics1.control import (
    LyapunovStatus,
    cartesian_law,
    gains_for_decay,
    joint_law,
    largest_gains,
    law_formula,
    lyapunov_rate,
    simulate_law,
)

TWO = r1.textbook_robots.planar_arm("RR", [1.0, 0.8])
XY = r1.PositionTask("xy")
Q = np.array([0.4, 0.9])
K2, D2 = np.array([[4.0, 1.0], [1.0, 3.0]]), np.array([[5.0, 0.0], [0.0, 5.0]])
CIRCLE = r1.curves.circle_path([0.9, 0.4], 0.3)
ROUND = r1.curves.PathTrajectory(CIRCLE, r1.quintic(0, CIRCLE.end, 3.0))
t = sympy.Symbol("t", nonnegative=True)


def J_of(q):
    s1, c1, s12, c12 = sin(q[0]), cos(q[0]), sin(q[0] + q[1]), cos(q[0] + q[1])
    return np.array([[-s1 - 0.8 * s12, -0.8 * s12], [c1 + 0.8 * c12, 0.8 * c12]])


def p_of(q):
    return np.array([cos(q[0]) + 0.8 * cos(q[0] + q[1]), sin(q[0]) + 0.8 * sin(q[0] + q[1])])


# --- commands at a state


@given(st.floats(0.2, 2.8), st.floats(-3, 3), st.floats(0, 3))
def test_first_order_command_is_the_formula(q2, q1, time):
    q = np.array([q1, q2])
    law = cartesian_law(TWO, XY, ROUND, K2)
    found = law.command(q, t=time)
    e = ROUND(time) - p_of(q)
    assert_allclose(found.error, e, atol=1e-12)
    assert_allclose(found.joints, np.linalg.solve(J_of(q), ROUND.velocity(time) + K2 @ e), atol=1e-8)
    assert_allclose(found.error_rate, -K2 @ e, atol=1e-8)
    assert_allclose(found.residual, [0, 0], atol=1e-8)


def test_second_order_command_is_the_formula():
    qdot, time = np.array([0.3, -0.5]), 1.3
    found = cartesian_law(TWO, XY, ROUND, K2, D2).command(Q, qdot, t=time)
    e, rate = ROUND(time) - p_of(Q), ROUND.velocity(time) - J_of(Q) @ qdot
    c1, s1, c12, s12 = cos(Q[0]), sin(Q[0]), cos(Q.sum()), sin(Q.sum())
    a, b = qdot[0] ** 2, 0.8 * qdot.sum() ** 2
    drift = -np.array([c1 * a + c12 * b, s1 * a + s12 * b])
    wanted = np.linalg.solve(J_of(Q), ROUND.acceleration(time) + D2 @ rate + K2 @ e - drift)
    assert_allclose(found.joints, wanted, atol=1e-9)


def test_joint_laws_of_both_orders():
    motion = r1.quintic([0, 0], [1, -1], 2.0)
    first = joint_law(TWO, motion, [2.0, 3.0]).command(Q, t=0.7)
    assert_allclose(first.joints, motion.velocity(0.7) + [2, 3] * (motion(0.7) - Q))
    qdot = np.array([0.1, 0.2])
    second = joint_law(TWO, motion, K2, D2).command(Q, qdot, t=0.7)
    wanted = motion.acceleration(0.7) + D2 @ (motion.velocity(0.7) - qdot) + K2 @ (motion(0.7) - Q)
    assert_allclose(second.joints, wanted, atol=1e-9)
    whole_turn = joint_law(TWO, [2 * pi, 0.0], 1.0).command([0.0, 0.0])
    assert_allclose(whole_turn.joints, [2 * pi, 0])  # of joints a turn is a turn


def test_exam_2010_06_15_1b_acceleration_law_for_one_coordinate_of_an_rp_arm():
    arm = r1.textbook_robots.robot_from_formula(["q2*sin(q1)"], joints="RP")
    wanted = r1.quintic([0.5], [0.9], 1.0, v0=[0.1], v1=[0.0], a0=[0.2], a1=[0.0])
    law = cartesian_law(arm, arm.task, wanted, 4.0, 4.0)
    assert_allclose(law.command([0.4, 0.9], [0.3, -0.2]).joints, [0.649232, 0.30499], atol=1e-6)


def test_exam_2010_01_12_2b_acceleration_law_of_a_cylindrical_arm():
    arm = r1.robot_from_dh([("R", 0, 0, 0, 0), ("P", 0, pi / 2, 0, pi / 2), ("P", 0, 0, 0, 0)])
    ends = {"v0": [0.1, 0, -0.2], "v1": [0, 0, 0], "a0": [0, 0.3, 0.1], "a1": [0, 0, 0]}
    wanted = r1.quintic([0.7, 0.5, 0.3], [1, 1, 1], 1.0, **ends)
    found = cartesian_law(arm, r1.PositionTask(), wanted, 4.0, 4.0).command([0.5, 0.2, 0.8], [0.4, -0.1, 0.3])
    assert_allclose(found.joints, [-1.294652, 0.1, -0.361057], atol=1e-6)


def test_gradient_law_is_the_transpose():
    target = [0.9, 0.5]
    found = cartesian_law(TWO, XY, target, K2, method="gradient").command(Q)
    assert_allclose(found.joints, J_of(Q).T @ K2 @ (target - p_of(Q)), atol=1e-12)


def test_null_motion_of_a_redundant_arm_leaves_the_task():
    arm = r1.textbook_robots.planar_arm("RRR", [1.0, 0.8, 0.5])
    q = [0.4, 0.7, -0.9]
    law = cartesian_law(arm, XY, [1.0, 1.0], 2.0, null_motion=lambda x: -x)
    J, found = XY.jacobian(arm, q), law.command(q)
    assert_allclose(J @ found.joints, 2 * found.error, atol=1e-12)
    other = (np.eye(3) - np.linalg.pinv(J) @ J) @ (-np.array(q))
    assert_allclose(found.joints, np.linalg.pinv(J) @ (2 * found.error) + other, atol=1e-10)


# --- the error along a simulation is its closed form


@pytest.mark.parametrize("K", [3.0, [2.0, 5.0], K2, [[3.0, 1.0], [-1.0, 2.0]]], ids=["one", "two", "full", "skew"])
@pytest.mark.parametrize("axes", [None, [[0.6, -0.8], [0.8, 0.6]], "frenet"], ids=["world", "turned", "frenet"])
def test_error_in_the_axes_decays_as_its_closed_form(K, axes):
    law = cartesian_law(TWO, XY, ROUND, K, axes=axes)
    q0 = r1.solve_ik(TWO, XY, ROUND(0.0), Q).require().q + np.array([0.1, -0.15])
    run, decay = simulate_law(law, q0, samples=31), law.decay(q0)
    assert run.complete
    assert_allclose(run.error_in_axes, decay(run.t), atol=1e-6)
    assert_allclose(np.linalg.norm(run.error, axis=1), np.linalg.norm(run.error_in_axes, axis=1))


@pytest.mark.parametrize("axes", [None, "frenet"])
@pytest.mark.parametrize(("K", "D"), [([4.0, 9.0], [5.0, 3.0]), (K2, D2)], ids=["diagonal", "full"])
def test_error_of_second_order_decays_as_its_closed_form(K, D, axes):
    law = cartesian_law(TWO, XY, ROUND, K, D, axes=axes)
    q0 = r1.solve_ik(TWO, XY, ROUND(0.0), Q).require().q + np.array([0.1, -0.1])
    run, decay = simulate_law(law, q0, [0.1, 0.2], samples=31), law.decay(q0, [0.1, 0.2])
    assert_allclose(run.error_in_axes, decay(run.t), atol=1e-6)


def test_tangent_and_normal_errors_have_their_own_rates_also_in_space():
    helix = r1.curves.helix_path([0, 0, 0.3], [0.5, 0, 0.3], 0.3, 0.5)
    motion = r1.curves.PathTrajectory(helix, r1.quintic(0, helix.end, 2.0))
    arm = r1.robot_from_dh([("P", 0, -pi / 2, 0, -pi / 2), ("P", 0, pi / 2, 0, pi / 2), ("P", 0, 0, 0, 0)])
    xyz = r1.PositionTask()
    J = xyz.jacobian(arm, np.zeros(3))
    assert abs(np.linalg.det(J)) == pytest.approx(1)
    q0 = np.linalg.solve(J, motion(0.0) + np.array([0.1, -0.05, 0.02]) - xyz.value(arm, np.zeros(3)))
    law = cartesian_law(arm, xyz, motion, [1.0, 4.0, 8.0], axes="frenet")
    run = simulate_law(law, q0, samples=21)
    e0 = run.error_in_axes[0]
    frame = r1.curves.frenet_frame(helix, 0.0)
    assert_allclose(e0, frame.rotation.T @ run.error[0], atol=1e-12)
    assert_allclose(run.error_in_axes, e0 * np.exp(-np.outer(run.t, [1, 4, 8])), atol=1e-6)
    second = simulate_law(
        cartesian_law(arm, xyz, motion, [1.0, 4.0, 8.0], [2.0, 4.0, 6.0], axes="frenet"), q0, samples=9
    )
    closed = cartesian_law(arm, xyz, motion, [1.0, 4.0, 8.0], [2.0, 4.0, 6.0], axes="frenet").decay(q0, np.zeros(3))
    assert_allclose(second.error_in_axes, closed(second.t), atol=1e-6)


def test_axes_that_turn_by_themselves_have_their_own_rates():
    """A conveyor that turns about z: R(t), with the errors along it, across and up."""
    arm = r1.robot_from_dh([("P", 0, -pi / 2, 0, -pi / 2), ("P", 0, pi / 2, 0, pi / 2), ("P", 0, 0, 0, 0)])
    xyz, turning = r1.PositionTask(), r1.curves.turn_path(np.eye(3), [0, 0, 1], 1.2)
    motion = r1.quintic([0.1, 0.2, 0.3], [0.4, 0.1, 0.5], 2.0)
    axes = r1.curves.PathTrajectory(turning, r1.quintic(0, turning.end, 2.0))
    for D in (None, [3.0, 4.0, 5.0]):
        law = cartesian_law(arm, xyz, motion, [1.0, 4.0, 6.0], D, axes=axes)
        rest = None if D is None else np.zeros(3)
        run = simulate_law(law, [0.3, 0.2, 0.1], samples=9)
        assert_allclose(run.error_in_axes, law.decay([0.3, 0.2, 0.1], rest)(run.t), atol=1e-6)
    with pytest.raises(r1.InputError, match=r"a motion R\(t\) of three axes"):
        cartesian_law(TWO, XY, ROUND, 1.0, axes=axes)


def test_along_a_line_the_normal_is_a_quarter_turn_to_the_left():
    line = r1.line_path([0.5, 0.5], [1.1, 1.3])
    motion = r1.curves.PathTrajectory(line, r1.cubic(0, line.end, 2.0))
    law = cartesian_law(TWO, XY, motion, [1.0, 6.0], axes="frenet")
    A = law.axes.at(0.3).A
    assert_allclose(A, [[0.6, -0.8], [0.8, 0.6]], atol=1e-12)


# --- closed forms and gains


def test_formulas_of_the_decay():
    decay = joint_law(TWO, [0.0, 0.0], [2.0, 3.0]).decay([-1.0, -0.5])
    assert decay.formula == sympy.Matrix([sympy.exp(-2 * t), sympy.exp(-3 * t) / 2])
    critical = joint_law(TWO, [0.0, 0.0], 4.0, 4.0).decay([-1.0, 0.0], [0.0, 0.0])
    assert sympy.simplify(critical.formula[0] - (1 + 2 * t) * sympy.exp(-2 * t)) == 0
    full = joint_law(TWO, [0.0, 0.0], K2).decay([-1.0, -0.5])
    at = np.array(full.formula.subs(t, 0.7).evalf(), dtype=float).ravel()
    assert_allclose(at, full(0.7), atol=1e-9)
    for D in (1.0, 5.0):  # oscillates, and does not
        second = joint_law(TWO, [0.0, 0.0], K2, D).decay([-1.0, -0.5], [0.2, 0.1])
        at = np.array(second.formula.subs(t, 0.7).evalf(), dtype=float).ravel()
        assert_allclose(at, second(0.7), atol=1e-9)
    with pytest.raises(r1.FormulaError, match="do not commute"):
        _ = joint_law(TWO, [0.0, 0.0], K2, [2.0, 5.0]).decay(Q, [0, 0]).formula
    assert_allclose(full.rates, -np.sort(np.linalg.eigvalsh(K2)))


@pytest.mark.parametrize(("ratio", "time"), [(0.05, 2.0), (0.5, 0.3), (1e-6, 10.0)])
def test_gains_for_a_ratio_at_a_time(ratio, time):
    assert gains_for_decay(ratio, time).K == pytest.approx(log(1 / ratio) / time)
    K, D = gains_for_decay(ratio, time, order=2)
    w = sqrt(K)
    assert pytest.approx(2 * w) == D
    assert (1 + w * time) * exp(-w * time) == pytest.approx(ratio, rel=1e-6)
    K, D = gains_for_decay(ratio, time, order=2, damping_ratio=0.4)
    decay = joint_law(TWO, [0.0, 0.0], K, D).decay([-1.0, 0.0], [0.0, 0.0])
    assert abs(decay(time)[0]) == pytest.approx(ratio, rel=1e-5)
    assert (np.abs(decay(np.linspace(time, 3 * time, 200))[:, 0]) <= ratio * (1 + 1e-5)).all()
    assert decay.time_to(ratio) == pytest.approx(time, rel=1e-5)


def test_exam_2009_06_10_largest_gains_within_the_rate_limits():
    """Planar PRP arm: r = (q3 s2, q1 − q3 c2, q2 − π/2) at (1.2, π/2, 1)."""
    arm = r1.textbook_robots.robot_from_formula(["q3*sin(q2)", "q1 - q3*cos(q2)", "q2 - pi/2"], joints="PRP")
    moving = r1.cubic([1.5, 1.5, -pi / 4], [1.5, 2.5, -pi / 4], 1.0, v0=[0, 1, 0], v1=[0, 1, 0])
    K = largest_gains(arm, arm.task, moving, [1.2, pi / 2, 1], limits=[5, pi, 4])
    law = cartesian_law(arm, arm.task, moving, K).command([1.2, pi / 2, 1])
    assert_allclose(np.sort(np.abs(law.joints) / [5, pi, 4]), [1, 1, 1], atol=1e-8)
    assert_allclose(K, [8, 10 * (4 - pi) / 3, 4], atol=1e-6)
    assert_allclose(law.joints, [5, -pi, 4], atol=1e-6)


@given(st.integers(0, 10**6))
def test_largest_gains_cannot_be_made_larger(seed):
    rng = np.random.default_rng(seed)
    q, target, V = rng.uniform([-2, 0.3], [2, 2.5]), rng.uniform(-1, 1, 2), rng.uniform(0.5, 2, 2)
    e, inverse = target - p_of(q), np.linalg.inv(J_of(q))
    fast, even, one = (
        largest_gains(TWO, XY, target, q, limits=V, criterion=criterion)
        for criterion in ("error", "smallest", "common")
    )
    for K in (fast, even, one):
        assert (np.abs(inverse @ (K * e)) <= V + 1e-7).all()
        assert np.max(np.abs(inverse @ (K * e)) / V) == pytest.approx(1, abs=1e-6)
        assert e**2 @ K <= e**2 @ fast * (1 + 1e-7)
        assert K.min() <= even.min() * (1 + 1e-7)
    for K in rng.uniform(0, 3 * even.max(), (200, 2)):  # brute force: none that is allowed is better
        if (np.abs(inverse @ (K * e)) <= V).all():
            assert e**2 @ K <= e**2 @ fast * (1 + 1e-7)
            assert K.min() <= even.min() * (1 + 1e-7)


# --- Lyapunov


@pytest.mark.parametrize("method", ["gradient", "newton"])
def test_lyapunov_rate_is_the_derivative_of_v_along_the_law(method):
    target = np.array([0.9, 0.5])
    found = lyapunov_rate(TWO, XY, target, Q, K2, method=method)
    W = K2 if method == "gradient" else np.eye(2)

    def V(time):
        e = target - p_of(Q + time * found.qdot)
        return 0.5 * e @ W @ e

    assert found.value == pytest.approx(V(0))
    assert found.rate == pytest.approx((V(1e-5) - V(-1e-5)) / 2e-5, rel=1e-6)
    assert found.rate < 0
    assert found.status is LyapunovStatus.DECREASES
    law = cartesian_law(TWO, XY, target, K2, method=method)
    assert_allclose(found.qdot, law.command(Q).joints, atol=1e-9)


def test_a_gradient_law_is_stuck_where_the_error_is_along_a_stretched_arm():
    found = lyapunov_rate(TWO, XY, [3.0, 0.0], [0.0, 0.0])
    assert found.status is LyapunovStatus.STUCK
    assert found.rate == pytest.approx(0, abs=1e-15)
    assert lyapunov_rate(TWO, XY, p_of(Q), Q).status in (LyapunovStatus.AT_TARGET, LyapunovStatus.DECREASES)
    run = simulate_law(cartesian_law(TWO, XY, [3.0, 0.0], 1.0, method="gradient"), [0.0, 0.0], duration=1.0, samples=3)
    assert_allclose(run.q, 0, atol=1e-12)


def test_gradient_simulation_lets_v_fall():
    law = cartesian_law(TWO, XY, [0.9, 0.5], K2, method="gradient")
    run = simulate_law(law, Q, duration=3.0, samples=30)
    V = 0.5 * np.einsum("ki,ij,kj->k", run.error, K2, run.error)
    assert (np.diff(V) <= 1e-9).all()
    assert run.final_error < 0.01


# --- simulation under limits, printed laws, misuse


def test_commands_are_cut_at_their_limits():
    law = joint_law(TWO, [1.0, 0.0], 4.0)
    run = simulate_law(law, [0.0, 0.0], duration=3.0, limits=[0.5, 1.0])
    q = np.where(run.t <= 1.75, 0.5 * run.t, 1 - 0.125 * np.exp(-4 * (run.t - 1.75)))  # as for the tracking of a joint
    assert_allclose(run.q[:, 0], q, atol=1e-6)
    assert run.saturated.tolist() == [True, False]
    assert "joint 1 saturates" in run.explain()


def test_the_law_is_printed():
    cases = {
        "q̇ = q̇_d + K (q_d − q), K = diag(2, 3)": joint_law(TWO, r1.cubic([0, 0], [1, 1], 1), [2, 3]),
        "q̇ = J⁻¹(q) (ṙ_d + K (r_d − f(q))), K = 2": cartesian_law(TWO, XY, ROUND, 2),
        "q̇ = J⁻¹(q) (K (r_d − f(q))), K = 2": cartesian_law(TWO, XY, [1, 1], 2),
        "q̈ = J⁻¹(q) (r̈_d + D (ṙ_d − J(q) q̇) + K (r_d − f(q)) − J̇(q) q̇), K = 4, D = 5": cartesian_law(
            TWO, XY, ROUND, 4, 5
        ),
        "q̇ = Jᵀ(q) K (r_d − f(q)), K = [[4, 1], [1, 3]]": cartesian_law(TWO, XY, [1, 1], K2, method="gradient"),
    }
    for text, law in cases.items():
        assert law.formula() == text
    assert "A K Aᵀ" in cartesian_law(TWO, XY, ROUND, [1, 2], axes="frenet").formula()
    assert "ë = −D ė − K e" in cartesian_law(TWO, XY, ROUND, 4, 5).explain()


def test_the_law_in_symbols_has_the_numbers_of_the_command():
    qdot, time = np.array([0.3, -0.5]), 1.3
    laws = {
        "first": cartesian_law(TWO, XY, ROUND, K2),
        "second": cartesian_law(TWO, XY, ROUND, K2, D2),
        "turned": cartesian_law(TWO, XY, ROUND, [1.0, 2.0], axes=[[0.6, -0.8], [0.8, 0.6]]),
        "gradient": cartesian_law(TWO, XY, [0.9, 0.5], K2, method="gradient"),
        "at rest": cartesian_law(TWO, XY, [0.9, 0.5], K2),
        "joints": joint_law(TWO, r1.quintic([0, 0], [1, -1], 2.0), [2.0, 3.0], [4.0, 5.0]),
    }
    for law in laws.values():
        motion = law.motion
        wanted = [law.target] + [np.zeros(2)] * 2 if motion is None else [motion.derivative(time, k) for k in range(3)]
        values = dict(zip(("q1", "q2", "qdot1", "qdot2"), [*Q, *qdot], strict=True))
        for name, numbers in zip(("rd", "rd_dot", "rd_ddot"), wanted, strict=True):
            values |= {f"{name}_{i + 1}": x for i, x in enumerate(numbers)}
        for name, G in (("K", law.K), ("D", law.D)):
            values |= {} if G is None else {f"{name}_{i + 1}{j + 1}": G[i, j] for i in range(2) for j in range(2)}
        formula = law_formula(law)
        numbers = formula.subs({symbol: values[symbol.name] for symbol in formula.free_symbols})
        found = law.command(Q, qdot if law.order == 2 else None, t=time).joints
        assert_allclose(np.array(numbers.evalf(), dtype=float).ravel(), found, atol=1e-9)
    with pytest.raises(r1.FormulaError, match="fixed axes"):
        law_formula(cartesian_law(TWO, XY, ROUND, 1.0, axes="frenet"))


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: joint_law(TWO, [0, 0], [1.0, -1.0]), "K must be positive definite"),
        (lambda: joint_law(TWO, [0, 0], 0.0), "K must be positive definite"),
        (lambda: joint_law(TWO, [0, 0], [[1, 3], [3, 1]]), "smallest eigenvalue of its symmetric part is -2"),
        (lambda: joint_law(TWO, [0, 0], [[1, 1], [-1, 1]], 2.0), "K of a law of second order must be symmetric"),
        (lambda: joint_law(TWO, [0, 0], 1.0, -2.0), "D must be positive definite"),
        (lambda: joint_law(TWO, [0, 0, 0], 1.0), "the target must have shape"),
        (lambda: joint_law(TWO, r1.cubic([0], [1], 1), 1.0), "the motion must have 2 rows"),
        (lambda: cartesian_law(TWO, XY, [1, 1], 1.0, axes="tangent"), "'frenet'"),
        (lambda: cartesian_law(TWO, XY, [1, 1], 1.0, axes="frenet"), "needs two or three coordinates"),
        (lambda: cartesian_law(TWO, XY, [1, 1], 1.0, axes=[[1, 1], [0, 1]]), "orthonormal"),
        (lambda: cartesian_law(TWO, XY, ROUND, 1.0, method="gradient"), "for a target at rest"),
        (lambda: cartesian_law(TWO, XY, [1, 1], 1.0, method="lyapunov"), "method must be one of"),
        (lambda: cartesian_law(TWO, XY, [1, 1], 1.0).command(Q, Q), "leave out qdot"),
        (lambda: cartesian_law(TWO, XY, [1, 1], 1.0, 1.0).command(Q), r"command\(q, qdot\)"),
        (lambda: simulate_law(joint_law(TWO, [1, 1], 1.0), Q), "give duration="),
        (lambda: simulate_law(cartesian_law(TWO, XY, ROUND, 1.0), Q, duration=1.0), "leave out duration="),
        (lambda: simulate_law("law", Q), "law must be joint_law"),
        (lambda: gains_for_decay(1.5, 1.0), "ratio must be below 1"),
        (lambda: gains_for_decay(0.1, 1.0, order=3), "order must be an integer"),
        (lambda: largest_gains(TWO, XY, [1, 1], Q, limits=np.inf), "give limits="),
        (lambda: lyapunov_rate(TWO, XY, [1, 1], Q, [[1, 1], [0, 1]]), "symmetric"),
    ],
)
def test_misuse_says_what_would_be_right(call, words):
    with pytest.raises(r1.InputError, match=words):
        call()


def test_errors_without_a_linear_equation_have_no_closed_form():
    for law in (
        cartesian_law(TWO, XY, [1, 1], 1.0, method="gradient"),
        cartesian_law(TWO, XY, ROUND, 1.0, feedforward=False),
    ):
        with pytest.raises(r1.TaskError, match="linear error equation"):
            law.decay(Q)
    pose = cartesian_law(TWO, r1.PoseTask(), r1.forward_kinematics(TWO, Q), 1.0)
    with pytest.raises(r1.TaskError, match="error of a pose"):
        pose.decay(Q + 0.1)
    with pytest.raises(r1.TaskError, match="full row rank"):
        largest_gains(TWO, XY, [1, 1], [0.3, 0.0], limits=1.0)
