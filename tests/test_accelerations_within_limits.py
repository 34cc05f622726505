"""Accelerations of several tasks by priority, within limits of accelerations and rates: against quadratic programs."""

import numpy as np
import pytest
from arms import arm, random_q
from hypothesis import given, strategies as st

import robotics1 as r1
from robotics1.redundancy import saturated_acceleration, saturated_priority_acceleration, saturated_priority_velocity

XY, ELBOW = r1.PositionTask("xy"), r1.PositionTask("y", frame="link3")
FOUR = r1.textbook_robots.planar_arm("RRRR", [1.0, 1.0, 1.0, 1.0])
seeds = st.integers(0, 10**6)


def program(H, f, A, b, low, high):
    """min ½ xᵀ H x − fᵀ x with A x = b inside the limits, by quadprog; None where there is none."""
    quadprog = pytest.importorskip("quadprog")  # of the extra "dev"
    n = len(low)
    C = np.hstack([A.T, np.eye(n), -np.eye(n)])
    try:
        return quadprog.solve_qp(H, f, C, np.concatenate([b, low, -high]), len(b))[0]
    except ValueError:
        return None


def largest(A, b, drift, low, high):
    """The largest s in [0, 1] with A x = s b − drift inside: of the least x² + ε s², by the range of s; nan if none."""
    C = np.column_stack([A, -b])
    H = np.eye(A.shape[1] + 1)
    H[-1, -1] = 1.0
    x = program(1e-6 * H, np.append(np.zeros(A.shape[1]), 1e3), C, -drift, np.append(low, 0.0), np.append(high, 1.0))
    return np.nan if x is None else x[-1]


def drawn(seed, size):
    rng = np.random.default_rng(seed)
    q, qdot, limit = rng.uniform(-2, 2, 4), rng.uniform(-0.8, 0.8, 4), rng.uniform(0.5, 2.5, 4)
    tasks = [XY, ELBOW]
    asked = [size * rng.uniform(-1, 1, task.rows) for task in tasks]
    J = [task.jacobian(FOUR, q) for task in tasks]
    drift = [r1.trajectories.jacobian_rate(FOUR, task, q, qdot) @ qdot for task in tasks]
    return q, qdot, limit, list(zip(tasks, asked, strict=True)), J, drift


@given(seeds, st.sampled_from([0.3, 1.0, 4.0]))
def test_by_levels_the_largest_scale_and_the_least_norm_are_those_of_quadratic_programs(seed, size):
    q, qdot, limit, levels, J, drift = drawn(seed, size)
    found = saturated_priority_acceleration(FOUR, levels, q, qdot, limits=limit)
    assert (np.abs(found.joints) <= limit).all()
    first = largest(J[0], levels[0][1], drift[0], -limit, limit)
    assert found.scales[0] == pytest.approx(first, abs=1e-5, nan_ok=True)
    for task, (_, asked), residual, d in zip(J, levels, found.residuals, drift, strict=True):
        assert residual == pytest.approx(asked - d - task @ found.joints, abs=1e-12)
    if not np.isnan(first):
        assert J[0] @ found.joints == pytest.approx(found.scales[0] * levels[0][1] - drift[0], abs=1e-8)
    both = np.concatenate([a - d for (_, a), d in zip(levels, drift, strict=True)])
    whole = program(np.eye(4), np.zeros(4), np.vstack(J), both, -limit, limit)
    assert (found.scales == (1.0, 1.0)) == (whole is not None)
    if whole is not None:
        assert found.joints == pytest.approx(whole, abs=1e-6)
        assert found.require() is found


@given(seeds)
def test_a_level_whose_drift_the_limits_cannot_hold_has_the_least_error(seed):
    """Limits of a tenth: of each level the least |J q̈ + J̇ q̇ − r̈|, level by level, by quadprog."""
    q, qdot, limit, levels, J, drift = drawn(seed, 1.0)
    limit = 0.1 * limit
    found = saturated_priority_acceleration(FOUR, levels, q, qdot, limits=limit)
    assert (np.abs(found.joints) <= limit).all()
    if not np.isnan(found.scales[0]):
        return
    best = program(
        J[0].T @ J[0] + 1e-9 * np.eye(4),
        J[0].T @ (levels[0][1] - drift[0]),
        np.zeros((0, 4)),
        np.zeros(0),
        -limit,
        limit,
    )
    wanted = np.linalg.norm(levels[0][1] - drift[0] - J[0] @ best)
    assert np.linalg.norm(found.residuals[0]) == pytest.approx(wanted, abs=1e-5)
    with pytest.raises(r1.NotConverged, match="level 1: no scale realises it"):
        found.require()


@given(seeds)
def test_the_rates_stay_within_theirs_after_the_step(seed):
    q, qdot, limit, levels, _, _ = drawn(seed, 3.0)
    V, h = np.array([0.5, 0.9, 0.9, 0.9]), 0.05
    found = saturated_priority_acceleration(FOUR, levels, q, qdot, limits=limit, max_velocity=V, step=h)
    after = qdot + h * found.joints
    slow = np.abs(qdot) <= V + h * limit  # the others cannot be back within one step
    assert (np.abs(after) <= V + 1e-9)[slow].all()
    assert found.joints[~slow] == pytest.approx((-np.sign(qdot) * limit)[~slow])
    one = saturated_acceleration(FOUR, *levels[0], q, qdot, limits=limit, max_velocity=V, step=h)
    assert found.lower.tolist() == one.lower.tolist()
    if one.scale > 0:
        assert one.scale == pytest.approx(found.scales[0], abs=1e-7)


def test_by_hand_a_joint_at_its_rate_is_taken_over_by_the_others():
    """q̈1 + q̈2 + q̈3 = 1.5, q̇1 = 1 = V: joint 1 may not accelerate, and the others share 0.75 each."""
    robot = r1.textbook_robots.planar_arm("RRR", [1.0, 0.8, 0.5])
    task = r1.FunctionTask(lambda p, R, q: [q.sum()], 1, lambda p, R, q: [[1.0, 1.0, 1.0]])
    found = saturated_priority_acceleration(
        robot, [(task, [1.5])], [0.1, 0.2, 0.3], [1.0, 0, 0], limits=2.0, max_velocity=1.0, step=0.1
    )
    assert found.joints == pytest.approx([0, 0.75, 0.75], abs=1e-9)
    assert found.saturated.tolist() == [True, False, False]


@pytest.mark.parametrize("name", ["six_r", "prr", "cylindrical"])
def test_without_limits_in_the_way_it_is_the_priority_of_accelerations(name):
    robot, rng = arm(name), np.random.default_rng(3)
    q, qdot = random_q(robot, 3), rng.uniform(-0.5, 0.5, arm(name).nv)
    levels = [(r1.PositionTask("z"), [0.3]), (r1.PositionTask("x"), [-0.2])]
    free = r1.redundancy.priority_acceleration(robot, levels, q, qdot)
    found = saturated_priority_acceleration(robot, levels, q, qdot, limits=np.inf)
    assert found.joints == pytest.approx(free.joints, abs=1e-8)


def test_names_stand_for_robots_and_tasks():
    by_name = saturated_priority_velocity("planar_2r", [("position:xy", [0.1, 0.2])], [0.3, 1.1], limits=1.0)
    robot = r1.load_robot("planar_2r")
    given_ = saturated_priority_velocity(robot, [(XY, [0.1, 0.2])], [0.3, 1.1], limits=1.0)
    assert by_name.joints.tolist() == given_.joints.tolist()
    named = r1.redundancy.priority_velocity("planar_2r", [("position:xy", [0.1, 0.2])], [0.3, 1.1])
    assert named.joints == pytest.approx(given_.joints, abs=1e-12)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"max_velocity": 1.0}, "max_velocity= and step= belong together"),
        ({"step": 0.1}, "max_velocity= and step= belong together"),
        ({"max_velocity": -1.0, "step": 0.1}, "max_velocity must leave zero between them"),
        ({"max_velocity": 1.0, "step": 0.0}, "step must be a positive number"),
    ],
)
def test_misuse_says_what_would_be_right(options, words):
    with pytest.raises(r1.InputError, match=words):
        saturated_priority_acceleration(FOUR, [(XY, [1, 0])], [0.1] * 4, [0.0] * 4, limits=1.0, **options)
