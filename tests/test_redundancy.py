"""Redundancy resolution at one state: projected gradient, priorities, rates within limits."""

from math import cos, pi, sin

import numpy as np
import pytest
from arms import ARMS, arm, random_q
from differences import derivative
from hypothesis import given, strategies as st

import robotics1 as r1
from robotics1.redundancy import (
    FunctionObjective,
    JointRangeObjective,
    LevelStatus,
    ManipulabilityObjective,
    NearObjective,
    ObstacleObjective,
    SaturationStatus,
    priority_acceleration,
    priority_velocity,
    projected_gradient,
    saturated_acceleration,
    saturated_priority_velocity,
    saturated_velocity,
)

XY = r1.PositionTask("xy")
THREE = r1.textbook_robots.planar_arm("RRR", [1.0, 0.8, 0.5])
Q, V = np.array([0.4, 0.7, -0.9]), np.array([0.3, -0.2])
FOUR = r1.textbook_robots.planar_arm("RRRR", [1.0, 1.0, 1.0, 1.0])
SEVEN = r1.textbook_robots.planar_arm("RRRRRRR", [1.0] * 7)
seeds = st.integers(0, 10**6)


def planar_jacobian(lengths, q):
    """The hand formula of an arm with revolute joints in its plane."""
    angles = np.cumsum(q)
    x, y = lengths * np.cos(angles), lengths * np.sin(angles)
    return np.array([[-y[i:].sum() for i in range(len(q))], [x[i:].sum() for i in range(len(q))]])


# --- the projected gradient


def test_manipulability_and_its_gradient_of_a_planar_3r_arm():
    J = planar_jacobian(np.array([1.0, 0.8, 0.5]), Q)
    objective = ManipulabilityObjective(THREE, XY)
    assert objective.value(Q) == pytest.approx(np.sqrt(np.linalg.det(J @ J.T)))
    assert objective.value(Q) == pytest.approx(0.664498139, abs=1e-9)
    assert objective.gradient(Q) == pytest.approx([0.0, 0.385579769, -0.269167327], abs=1e-8)


def test_projected_gradient_is_pinv_v_plus_the_projection():
    J = planar_jacobian(np.array([1.0, 0.8, 0.5]), Q)
    found = projected_gradient(THREE, XY, V, Q, ManipulabilityObjective(THREE, XY), gain=2.0)
    slope, P = np.array([0.0, 0.385579769, -0.269167327]), np.eye(3) - np.linalg.pinv(J) @ J
    assert found.qdot == pytest.approx(np.linalg.pinv(J) @ V + 2 * P @ slope, abs=1e-7)
    assert found.qdot == pytest.approx([-0.097698159, -0.277107807, 0.427852137], abs=1e-7)
    assert J @ found.null_velocity == pytest.approx([0, 0], abs=1e-12)
    assert found.null_rate == pytest.approx(2 * slope @ P @ slope, abs=1e-7)
    assert found.rate == pytest.approx(found.gradient @ found.qdot)
    assert found.require() is found
    assert "by self-motion" in found.explain()


def test_joint_range_objective_is_that_of_liegeois():
    objective = JointRangeObjective(THREE, [-1.5, 0, -2], [1.5, 2.5, 0.5])
    assert objective.gradient(Q) == pytest.approx([-0.014814815, 0.029333333, 0.008], abs=1e-9)
    assert objective.value(Q) == pytest.approx(-((0.4 / 3) ** 2 + (0.55 / 2.5) ** 2 + (0.15 / 2.5) ** 2) / 6)
    found = projected_gradient(THREE, XY, V, Q, objective, gain=5.0)
    assert found.qdot == pytest.approx([-0.102036048, -0.271394686, 0.43361197], abs=1e-8)


@pytest.mark.parametrize("name", ["six_r", "prr", "planar_3r", "cylindrical"])
def test_gradients_are_the_derivatives_of_the_objectives(name):
    robot, q = arm(name), random_q(arm(name), 3)
    near = NearObjective(np.zeros(robot.nv), np.arange(1.0, robot.nv + 1))
    objectives = [
        ManipulabilityObjective(robot, r1.PositionTask("xy")),
        near,
        ObstacleObjective(robot, [0.7, 0.4, 0.5]),
    ]
    objectives.append(ObstacleObjective(robot, [0.7, 0.4, 0.5], frame=robot.tool, point=[0.1, 0, 0]))
    objectives.append(FunctionObjective(robot, lambda x: float(np.sin(x).sum())))
    if np.isfinite(robot.lower).any():
        objectives.append(JointRangeObjective(robot))
    for objective in objectives:
        slope = derivative(lambda x, H=objective: np.array([H.value(x)]), q)[0]
        assert objective.gradient(q) == pytest.approx(slope, abs=1e-7)


@pytest.mark.parametrize("kinds", ["RPR", "PRP", "RRP", "PPR"])
@pytest.mark.parametrize("obstacle", [[0.5, 0.3, 0.1], [-0.4, 0.6, 0.0], [0.2, 1.5, -0.3]])
def test_gradient_of_the_distance_where_joints_slide(kinds, obstacle):
    robot, q = r1.textbook_robots.planar_arm(kinds, [0.6] * kinds.count("R")), np.array([0.4, 0.7, 0.5])
    objective = ObstacleObjective(robot, obstacle)
    slope = derivative(lambda x: np.array([objective.value(x)]), q)[0]
    assert objective.gradient(q) == pytest.approx(slope, abs=1e-8)
    rows = [("R", 0.3, pi / 2, 0.4, 0.2), ("P", 0.2, 0.5, 0, 0.3), ("R", 0.5, 0, 0.1, 0)]  # the slide has an offset
    skew = r1.robot_from_dh(rows)
    objective = ObstacleObjective(skew, obstacle)
    slope = derivative(lambda x: np.array([objective.value(x)]), q)[0]
    assert objective.gradient(q) == pytest.approx(slope, abs=1e-8)


def test_distance_of_a_planar_arm_from_a_point_beside_its_second_link():
    """The second link points along x: the obstacle is 0.3 above a point of it."""
    robot = THREE
    q = [np.pi / 2, -np.pi / 2, 0.4]
    objective = ObstacleObjective(robot, [0.5, 1.3, 0.0])
    assert objective.value(q) == pytest.approx(0.3)
    assert objective.gradient(q) == pytest.approx([-0.5, -0.5, 0.0], abs=1e-12)  # the point sinks as 0.5 q̇12 rises
    assert ObstacleObjective(robot, [0.0, 1.0, 0.0]).gradient(q) == pytest.approx(np.zeros(3))  # touched


def test_along_a_path_the_objective_grows_beyond_that_of_the_least_norm():
    start = XY.value(THREE, Q)
    line = r1.line_path(start, start + np.array([-0.3, 0.2]))
    motion = r1.curves.PathTrajectory(line, r1.cubic(0, line.end, 2.0))
    objective = ManipulabilityObjective(THREE, XY)
    plain = r1.follow_trajectory(THREE, XY, motion, Q)
    better = r1.follow_trajectory(THREE, XY, motion, Q, null_velocity=lambda q: 5 * objective.gradient(q))
    assert XY.value(THREE, better(2.0)) == pytest.approx(line(line.end), abs=1e-6)
    assert objective.value(better(2.0)) > objective.value(plain(2.0)) + 0.01


# --- priorities


def test_two_levels_on_a_planar_3r_arm_by_the_formula_of_nakamura():
    top, low = XY, r1.FunctionTask(lambda p, R, q: [q[0] + q[1]], 1)
    found = priority_velocity(THREE, [(top, V), (low, [0.5])], Q)
    J1, J2 = planar_jacobian(np.array([1.0, 0.8, 0.5]), Q), np.array([[1.0, 1.0, 0.0]])
    first = np.linalg.pinv(J1) @ V
    P = np.eye(3) - np.linalg.pinv(J1) @ J1
    wanted = first + np.linalg.pinv(J2 @ P) @ ([0.5] - J2 @ first)
    assert found.joints == pytest.approx(wanted, abs=1e-8)
    assert [level.status for level in found.levels] == [LevelStatus.REALISED] * 2
    assert found.null.shape == (3, 0)
    stacked = priority_velocity(THREE, [(top, V), (low, [0.5])], Q, method="stacked")
    assert stacked.joints == pytest.approx(wanted, abs=1e-8)
    projected = priority_velocity(THREE, [(top, V), (low, [0.5])], Q, method="projection")
    assert projected.joints == pytest.approx(first + P @ np.linalg.pinv(J2) @ [0.5], abs=1e-8)
    assert projected.levels[1].status is LevelStatus.NOT_MET


def test_a_ppr_arm_by_hand():
    """p = (q1 + l c3, q2 + l s3) first, then q̇3 = ω: q̇ = (ẋ + l s3 ω, ẏ − l c3 ω, ω)."""
    robot = r1.textbook_robots.planar_arm("PPR", [0.5])
    q = np.array([0.2, -0.1, 0.6])
    J = XY.jacobian(robot, q)
    assert J == pytest.approx(np.array([[1, 0, -0.5 * sin(0.6)], [0, 1, 0.5 * cos(0.6)]]), abs=1e-12)
    turn = r1.FunctionTask(lambda p, R, x: [x[2]], 1, lambda p, R, x: [[0.0, 0.0, 1.0]])
    found = priority_velocity(robot, [(XY, [0.3, -0.2]), (turn, [0.7])], q)
    wanted = np.linalg.solve(np.vstack([J, [0, 0, 1]]), [0.3, -0.2, 0.7])
    assert found.joints == pytest.approx(wanted, abs=1e-12)
    least = priority_velocity(robot, [(XY, [0.3, -0.2])], q)
    assert least.joints == pytest.approx(J.T @ np.linalg.solve(J @ J.T, [0.3, -0.2]), abs=1e-12)


def test_weights_of_stacked_rates_make_the_least_weighted_squares():
    q, weights = [0.3, 0.6, -0.9, 0.7], [1, 4, 9]
    elbow, first = r1.PositionTask("xy", frame="link3"), r1.PositionTask("x", frame="link2")
    levels = [(XY, [1.0, 0.5]), (elbow, [-1.0, 2.0]), (first, [0.3])]
    found = priority_velocity(FOUR, levels, q, method="stacked", weights=weights)
    A = np.vstack([np.sqrt(w) * task.jacobian(FOUR, q) for w, (task, _) in zip(weights, levels, strict=True)])
    b = np.concatenate([np.sqrt(w) * np.array(rate) for w, (_, rate) in zip(weights, levels, strict=True)])
    assert found.joints == pytest.approx(np.linalg.lstsq(A, b)[0], abs=1e-9)


def test_what_the_first_level_takes_is_a_conflict_and_what_no_joint_can_do_is_out_of_range():
    both = [(XY, [0.3, -0.2]), (r1.PositionTask("x"), [1.0])]
    found = priority_velocity(THREE, both, Q)
    assert XY.jacobian(THREE, Q) @ found.joints == pytest.approx([0.3, -0.2], abs=1e-12)
    assert found.levels[1].status is LevelStatus.IN_CONFLICT
    assert found.levels[1].is_algorithmic_singularity
    assert found.levels[1].residual == pytest.approx([0.7], abs=1e-12)
    with pytest.raises(r1.NotConverged, match="level 2: not realised: the levels before it"):
        found.require()
    height = priority_velocity(THREE, [(XY, V), (r1.PositionTask("z"), [1.0])], Q)
    assert height.levels[1].status is LevelStatus.OUT_OF_RANGE


@given(seeds)
def test_each_level_is_the_best_that_those_before_allow(seed):
    """Of three levels on a drawn arm: residuals of a brute lexicographic least squares by null-space bases."""
    rng = np.random.default_rng(seed)
    q = rng.uniform(-2, 2, 4)
    tasks = [XY, r1.PositionTask("y", frame="link3"), r1.FunctionTask(lambda p, R, x: [x[0] + x[3], x[2]], 2)]
    asked = [rng.uniform(-1, 1, task.rows) for task in tasks]
    found = priority_velocity(FOUR, list(zip(tasks, asked, strict=True)), q)
    A, b = np.zeros((0, 4)), np.zeros(0)
    for task, rate, level in zip(tasks, asked, found.levels, strict=True):
        J = task.jacobian(FOUR, q)
        # minimise |J x − rate| subject to A x = b, by the equations of Karush, Kuhn and Tucker
        K = np.block([[J.T @ J, A.T], [A, np.zeros((len(A), len(A)))]])
        x = np.linalg.lstsq(K, np.concatenate([J.T @ rate, b]), rcond=1e-11)[0][:4]
        assert np.linalg.norm(level.residual) == pytest.approx(np.linalg.norm(rate - J @ x), abs=1e-5)
        A, b = np.vstack([A, J]), np.concatenate([b, J @ x])


def test_damping_bounds_the_joints_at_a_conflict():
    """The null vector of J turns the second row of the low level by ε only: 1/ε without damping."""
    J = XY.jacobian(THREE, Q)
    n = np.linalg.svd(J)[2][2]
    row = (np.linalg.pinv(J) @ J)[0] + 1e-6 * n
    low = r1.FunctionTask(lambda p, R, q: [row @ q], 1, lambda p, R, q: [row])
    levels = [(XY, V), (low, [1.0])]
    wild, tame = (priority_velocity(THREE, levels, Q, damping=damping) for damping in (0.0, 0.05))
    assert np.linalg.norm(wild.joints) > 1e5
    assert np.linalg.norm(tame.joints) < 1
    assert J @ tame.joints == pytest.approx(V, abs=1e-12)
    assert tame.levels[1].status is LevelStatus.NOT_MET


def test_accelerations_by_priority_realise_both_levels():
    qdot = np.array([0.2, -0.3, 0.5])
    low = r1.FunctionTask(lambda p, R, q: [q[0] ** 2 + q[1]], 1, lambda p, R, q: [[2 * q[0], 1.0, 0.0]])
    found = priority_acceleration(THREE, [(XY, [0.4, 0.1]), (low, [0.3])], Q, qdot)
    assert found.require() is found
    rate = r1.trajectories.jacobian_rate(THREE, XY, Q, qdot)
    assert XY.jacobian(THREE, Q) @ found.joints + rate @ qdot == pytest.approx([0.4, 0.1], abs=1e-9)
    assert 2 * Q[0] * found.joints[0] + found.joints[1] + 2 * qdot[0] ** 2 == pytest.approx(0.3, abs=1e-9)
    alone = priority_acceleration(THREE, [(XY, [0.4, 0.1])], Q, qdot, null_acceleration=-3 * qdot)
    assert XY.jacobian(THREE, Q) @ alone.joints + rate @ qdot == pytest.approx([0.4, 0.1], abs=1e-9)


# --- rates within limits


def quadratic(J, b, low, high):
    """min ½|x|² with J x = b inside the limits by quadprog; None where there is none."""
    quadprog = pytest.importorskip("quadprog")  # of the extra "dev"
    n = len(low)
    C = np.hstack([J.T, np.eye(n), -np.eye(n)])
    try:
        return quadprog.solve_qp(np.eye(n), np.zeros(n), C, np.concatenate([b, low, -high]), len(b))[0]
    except ValueError:
        return None


def largest(J, b, low, high):
    """The largest s with s b inside, by bisection of whether the quadratic program has a solution."""
    if quadratic(J, b, low, high) is not None:
        return 1.0
    a, c = 0.0, 1.0
    for _ in range(45):
        middle = 0.5 * (a + c)
        a, c = (middle, c) if quadratic(J, middle * b, low, high) is not None else (a, middle)
    return a


@given(seeds, st.sampled_from([0.5, 1.5, 3.0, 6.0]))
def test_optimal_saturation_is_the_quadratic_program(seed, size):
    rng = np.random.default_rng(seed)
    q, limit = rng.uniform(-2, 2, 4), rng.uniform(0.3, 1.5, 4)
    J, v = XY.jacobian(FOUR, q), size * rng.uniform(-1, 1, 2)
    found = saturated_velocity(FOUR, XY, v, q, limits=limit)
    s = largest(J, v, -limit, limit)
    assert found.scale == pytest.approx(s, abs=1e-6)
    assert J @ found.joints == pytest.approx(found.scale * v, abs=1e-8)
    assert (np.abs(found.joints) <= limit).all()
    if s == 1:
        assert found.joints == pytest.approx(quadratic(J, v, -limit, limit), abs=1e-7)
        assert found.require() is found
    else:
        assert found.status is SaturationStatus.SCALED


@given(seeds, st.sampled_from([0.5, 1.5, 3.0, 6.0]))
def test_saturation_in_the_null_space_stays_within_limits_and_below_the_optimum(seed, size):
    rng = np.random.default_rng(seed)
    q, limit = rng.uniform(-2, 2, 4), rng.uniform(0.3, 1.5, 4)
    J, v = XY.jacobian(FOUR, q), size * rng.uniform(-1, 1, 2)
    best, sns = (saturated_velocity(FOUR, XY, v, q, limits=limit, method=method) for method in ("optimal", "sns"))
    plain = saturated_velocity(FOUR, XY, v, q, limits=limit, method="scaled")
    assert J @ sns.joints == pytest.approx(sns.scale * v, abs=1e-8)
    assert (np.abs(sns.joints) <= limit).all()
    assert plain.scale - 1e-9 <= sns.scale <= best.scale + 1e-7
    if sns.scale == best.scale == 1:
        assert np.linalg.norm(sns.joints) >= np.linalg.norm(best.joints) - 1e-9
    assert sns.steps[0].x == pytest.approx(np.linalg.pinv(J) @ v, abs=1e-9)
    assert len(sns.steps) <= 4


@given(seeds, st.sampled_from([1e-6, 1.0, 1e6]))
def test_the_unit_of_the_rates_does_not_matter(seed, unit):
    """Also with joints that are held, and limits that are not the same to both sides."""
    rng = np.random.default_rng(seed)
    J, b = rng.normal(size=(2, 5)), 3 * rng.normal(size=2)
    high, low = (rng.uniform(0, 1.5, 5) * (rng.random(5) > 0.2) for _ in range(2))
    task = r1.FunctionTask(lambda p, R, q: J @ q, 2, lambda p, R, q: J)
    arm = r1.textbook_robots.planar_arm("RRRRR", [1.0] * 5)
    ask = {"limits": unit * high, "lower": -unit * low}
    found = saturated_velocity(arm, task, unit * b, np.zeros(5), **ask)
    assert found.scale == pytest.approx(largest(J, b, -low, high), abs=1e-6)
    assert J @ found.joints == pytest.approx(found.scale * unit * b, abs=1e-7 * unit)
    sns = saturated_velocity(arm, task, unit * b, np.zeros(5), **ask, method="sns")
    assert J @ sns.joints == pytest.approx(sns.scale * unit * b, abs=1e-7 * unit)
    assert sns.scale <= found.scale + 1e-7
    for x in (found.joints, sns.joints):
        assert (x <= unit * high).all()
        assert (x >= -unit * low).all()


@pytest.mark.sweep
def test_saturation_in_the_null_space_misses_the_largest_scale_in_some_six_percent_of_cases():
    """Three rows and seven joints, rates that exceed the limits: what docs/redundancy.md says of the algorithm."""
    rng = np.random.default_rng(0)
    tried = smaller = 0
    while tried < 1000:
        J, b, limit = rng.normal(size=(3, 7)), 3 * rng.normal(size=3), rng.uniform(0.3, 1.5, 7)
        task = r1.FunctionTask(lambda p, R, q, J=J: J @ q, 3, lambda p, R, q, J=J: J)
        if (np.abs(np.linalg.pinv(J) @ b) <= limit).all():
            continue
        best, sns = (
            saturated_velocity(SEVEN, task, b, np.zeros(7), limits=limit, method=m) for m in ("optimal", "sns")
        )
        tried, smaller = tried + 1, smaller + (sns.scale < best.scale - 1e-6)
    assert 0.03 < smaller / tried < 0.09


def test_one_saturated_joint_by_hand():
    """q̇1 + q̇2 + q̇3 = 1.5 with |q̇1| ≤ 0.2: the others share the rest, 0.65 each."""
    task = r1.FunctionTask(lambda p, R, q: [q.sum()], 1, lambda p, R, q: [[1.0, 1.0, 1.0]])
    for method in ("optimal", "sns"):
        found = saturated_velocity(THREE, task, [1.5], Q, limits=[0.2, 1, 1], method=method)
        assert found.joints == pytest.approx([0.2, 0.65, 0.65], abs=1e-9)
        assert found.saturated.tolist() == [True, False, False]
        assert found.status is SaturationStatus.SATURATED
        slowed = saturated_velocity(THREE, task, [4.4], Q, limits=[0.2, 1, 1], method=method)
        assert slowed.joints == pytest.approx([0.2, 1, 1], abs=1e-7)
        assert slowed.scale == pytest.approx(0.5, abs=1e-8)
    assert saturated_velocity(THREE, task, [1.5], Q, limits=[0.2, 1, 1], method="scaled").scale == pytest.approx(0.4)
    one_way = saturated_velocity(THREE, task, [-1.5], Q, limits=[0.2, 1, 1], lower=[-1, -0.25, 0])
    assert one_way.joints == pytest.approx([-1, -0.25, 0], abs=1e-7)
    assert one_way.scale == pytest.approx(1.25 / 1.5, abs=1e-8)


def test_the_joint_that_is_the_most_beyond_its_limit_is_held_first():
    """q̇1 + q̇2 + q̇3 = 3: (1, 1, 1), then (0.2, 1.4, 1.4), then (0.2, 0.9, 1.9)."""
    task = r1.FunctionTask(lambda p, R, q: [q.sum()], 1, lambda p, R, q: [[1.0, 1.0, 1.0]])
    found = saturated_velocity(THREE, task, [3.0], Q, limits=[0.2, 0.9, 5], method="sns")
    assert [step.critical for step in found.steps] == [0, 1, -1]
    assert [step.scale for step in found.steps] == pytest.approx([0.2, (2 * 0.9 + 0.2) / 3, 1.0])
    assert np.array([step.x for step in found.steps]) == pytest.approx(
        np.array([[1, 1, 1], [0.2, 1.4, 1.4], [0.2, 0.9, 1.9]])
    )


def test_without_limits_in_the_way_it_is_the_pseudoinverse():
    for limits in (np.inf, 100.0, [np.inf, 5, 5]):
        found = saturated_velocity(THREE, XY, V, Q, limits=limits)
        assert found.status is SaturationStatus.WITHIN_LIMITS
        assert found.joints == pytest.approx(np.linalg.pinv(XY.jacobian(THREE, Q)) @ V, abs=1e-12)


def test_out_of_range_is_said():
    straight = [0.3, 0.0, 0.0]
    found = saturated_velocity(THREE, XY, [1.0, 0.0], straight, limits=1.0)
    assert found.status is SaturationStatus.OUT_OF_RANGE
    with pytest.raises(r1.NotConverged):
        found.require()


@given(seeds)
def test_accelerations_within_limits_hold_the_drift(seed):
    rng = np.random.default_rng(seed)
    q, qdot, limit = rng.uniform(-2, 2, 4), rng.uniform(-0.5, 0.5, 4), rng.uniform(0.5, 2, 4)
    asked = rng.uniform(-4, 4, 2)
    drift = r1.trajectories.jacobian_rate(FOUR, XY, q, qdot) @ qdot
    found = saturated_acceleration(FOUR, XY, asked, q, qdot, limits=limit)
    J = XY.jacobian(FOUR, q)
    assert (np.abs(found.joints) <= limit + 1e-9).all()
    if found.scale > 0:
        assert J @ found.joints + drift == pytest.approx(found.scale * asked, abs=1e-7)
    whole = quadratic(J, asked - drift, -limit, limit)
    assert (found.scale == 1) == (whole is not None)
    if whole is not None:
        assert found.joints == pytest.approx(whole, abs=1e-7)


@given(seeds)
def test_priorities_within_limits_are_those_of_quadratic_programs(seed):
    rng = np.random.default_rng(seed)
    q, limit = rng.uniform(-2, 2, 4), rng.uniform(0.3, 1.5, 4)
    low = r1.PositionTask("y", frame="link3")
    v, w = 2 * rng.uniform(-1, 1, 2), rng.uniform(-1, 1, 1)
    found = saturated_priority_velocity(FOUR, [(XY, v), (low, w)], q, limits=limit)
    J, K = XY.jacobian(FOUR, q), low.jacobian(FOUR, q)
    assert (np.abs(found.joints) <= limit).all()
    assert found.scales[0] == pytest.approx(largest(J, v, -limit, limit), abs=1e-6)
    assert J @ found.joints == pytest.approx(found.scales[0] * v, abs=1e-7)
    both = quadratic(np.vstack([J, K]), np.concatenate([v, w]), -limit, limit)
    if both is not None:
        assert found.scales == (1.0, 1.0)
        assert found.joints == pytest.approx(both, abs=1e-6)
    elif np.isfinite(found.scales[1]):
        assert K @ found.joints == pytest.approx(found.scales[1] * w, abs=1e-7)


# --- robots of every kind

KINDS = [name for name in ARMS if arm(name).nq == arm(name).nv > 0 and arm(name).tool is not None]


@pytest.mark.parametrize("name", KINDS)
def test_levels_and_limits_on_a_robot_of_every_kind(name):
    """Spatial, prismatic, skew, mimicking arms, with a point beside the tool: against the quadratic program."""
    robot, rng = arm(name), np.random.default_rng(7)
    q = random_q(robot, 7)
    top = r1.PositionTask("z", point=(0.1, 0.05, 0.02))
    low = r1.PositionTask("x", point=(0.1, 0.05, 0.02))
    J, K = top.jacobian(robot, q), low.jacobian(robot, q)
    v, w, limit = J @ rng.uniform(-1, 1, robot.nv), K @ rng.uniform(-1, 1, robot.nv), rng.uniform(0.2, 0.8, robot.nv)
    found = priority_velocity(robot, [(top, v), (low, w)], q)
    assert J @ found.joints == pytest.approx(v, abs=1e-9)
    if np.linalg.matrix_rank(np.vstack([J, K])) == 2:
        assert K @ found.joints == pytest.approx(w, abs=1e-7)
        assert found.joints == pytest.approx(np.linalg.pinv(np.vstack([J, K])) @ [*v, *w], abs=1e-7)
    held = saturated_velocity(robot, top, v, q, limits=limit)
    assert (np.abs(held.joints) <= limit).all()
    assert J @ held.joints == pytest.approx(held.scale * v, abs=1e-8)
    if np.linalg.norm(J) > 1e-9:
        assert held.scale == pytest.approx(min(1.0, float((np.abs(J) @ limit)[0]) / abs(v[0])), abs=1e-7)


def test_a_level_with_a_part_out_of_range_is_realised_in_its_range():
    """The rows of a pointing task are dependent: r itself is in the left null space."""
    robot = arm("six_r")
    q = random_q(robot, 5)
    task = r1.PointingTask()
    r = task.value(robot, q)
    turn = np.cross([0.1, 0.2, 0.3], r)
    found = saturated_priority_velocity(robot, [(task, turn + 0.5 * r)], q, limits=5.0)
    assert found.scales == (1.0,)
    assert task.jacobian(robot, q) @ found.joints == pytest.approx(turn, abs=1e-9)
    assert found.residuals[0] == pytest.approx(0.5 * r, abs=1e-9)
    with pytest.raises(r1.NotConverged):
        found.require()


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: priority_velocity(THREE, [], Q), "levels must be a list of pairs"),
        (lambda: priority_velocity(THREE, [(XY, V), (XY, V)], Q), "the same task as one before it"),
        (lambda: priority_velocity(THREE, [XY, V], Q), "level 1 must be a pair"),
        (lambda: priority_velocity(THREE, [(XY, [1, 2, 3])], Q), "ṙ of level 1"),
        (lambda: priority_velocity(THREE, [(V, XY)], Q), "the task must be a task"),
        (lambda: priority_velocity(THREE, [(XY, V)], Q, method="levels", damping=-1), "damping"),
        (lambda: priority_velocity(THREE, [(XY, V)], Q, method="stacked", damping=0.1), "damping belongs to"),
        (lambda: priority_velocity(THREE, [(XY, V)], Q, weights=[1]), "weights belong to method='stacked'"),
        (lambda: priority_velocity(THREE, [(XY, V)], Q, method="stacked", weights=[0]), "weights must be positive"),
        (lambda: priority_velocity(THREE, [(XY, V)], Q, method="order"), "method must be one of"),
        (lambda: projected_gradient(THREE, XY, V, Q, "w"), r"the objective must have value\(q\)"),
        (lambda: projected_gradient(THREE, XY, V, Q, NearObjective([0, 0])), r"q must have shape"),
        (lambda: saturated_velocity(THREE, XY, V, Q, limits=[-1, 1, 1]), "leave zero between"),
        (lambda: saturated_velocity(THREE, XY, V, Q, limits=1.0, lower=[0.1, 0, 0]), "leave zero between"),
        (lambda: saturated_velocity(THREE, XY, V, Q, limits=[1, 1]), "limits must have shape"),
        (lambda: saturated_velocity(THREE, XY, V, Q, limits=1.0, method="qp"), "method must be one of"),
        (lambda: JointRangeObjective(THREE, [0, 0, 0], [1, 0, 1]), "above the lower"),
        (lambda: JointRangeObjective(THREE), "no joint of robot"),
        (lambda: ObstacleObjective(THREE, [0, 0]), "obstacle must have shape"),
        (lambda: ObstacleObjective(THREE, [0, 0, 0], point=[0, 0, 0]), "a point needs its frame"),
        (lambda: FunctionObjective(THREE, 3), "f must be a function"),
    ],
)
def test_misuse_says_what_would_be_right(call, words):
    with pytest.raises(r1.InputError, match=words):
        call()
