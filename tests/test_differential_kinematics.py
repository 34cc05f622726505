"""Joint velocities and accelerations for those of a task: laws of generalized inverses, and second-order kinematics."""

from math import cos, sin

import numpy as np
import pytest
from arms import ARMS, arm, random_q
from hypothesis import given, settings, strategies as st
from scipy.linalg import null_space
from scipy.optimize import minimize

import robotics1 as r1
from robotics1 import InputError, TaskError
from robotics1.trajectories import Resolution

XYZ = r1.PositionTask("xyz")
FRAMES = {"two_tips": "camera"}


def rates(n, seed):
    return np.random.default_rng(seed).normal(size=n)


def distance(p, R, q):
    return [np.sqrt(p @ p) + 0.3 * np.sin(q[0])]


def tasks(name):
    """Tasks that fit an arm."""
    frame = FRAMES.get(name)
    found = [r1.PositionTask("xyz", frame=frame), r1.PoseTask(frame=frame), r1.OrientationTask(frame=frame)]
    found += [r1.PointingTask("x", frame=frame), r1.FunctionTask(distance, 1, frame=frame)]
    if name in ("prr", "planar_2r", "planar_3r", "elbow_limited"):
        found.append(r1.PlanarPoseTask("xy", frame=frame))
    if name in ("redundant", "six_r", "spatial"):
        found += [r1.PoseTask(angles="XYZ"), r1.PositionTask("xz", reference="tool"), r1.OrientationTask(angles="ZYZ")]
    return found


CASES = [(name, task) for name in ARMS for task in tasks(name)]
IDS = [f"{name}-{type(task).__name__}{i}" for i, (name, task) in enumerate(CASES)]


# --- J̇


@pytest.mark.parametrize(("name", "task"), CASES, ids=IDS)
def test_task_jacobian_rate_is_the_derivative_of_the_jacobian(name, task):
    robot = arm(name)
    q, qdot, h = random_q(robot, 3), rates(robot.nv, 4), 2e-3
    f = lambda x: task.jacobian(robot, q + x * qdot)  # noqa: E731
    expected = (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h)
    assert r1.trajectories.jacobian_rate(robot, task, q, qdot) == pytest.approx(expected, abs=3e-8)


@pytest.mark.parametrize("name", ARMS)
def test_rate_of_a_pose_task_is_pinocchios_and_rate_times_qdot_is_the_second_difference(name):
    robot, frame = arm(name), FRAMES.get(name)
    q, qdot, h = random_q(robot, 3), rates(robot.nv, 4), 1e-3
    task = r1.PoseTask(frame=frame)
    rate = r1.trajectories.jacobian_rate(robot, task, q, qdot)
    assert rate == pytest.approx(r1.frame_jacobian_rate(robot, q, qdot, frame=frame), abs=1e-10)
    p = lambda x: r1.forward_kinematics(robot, q + x * qdot, frame=frame).translation.copy()  # noqa: E731
    second = (p(h) - 2 * p(0) + p(-h)) / h**2
    assert rate[:3] @ qdot == pytest.approx(second, abs=1e-4)


def test_rate_of_a_function_task_without_a_jacobian_is_exact_to_1e_8():
    robot = arm("redundant")
    q, qdot = random_q(robot, 3), rates(7, 4)
    given_, own = r1.FunctionTask(lambda p, R, q: p, 3), XYZ
    assert r1.trajectories.jacobian_rate(robot, given_, q, qdot) == pytest.approx(
        r1.trajectories.jacobian_rate(robot, own, q, qdot), abs=1e-8
    )


def test_a_planar_2r_has_the_centripetal_drift():
    robot = arm("planar_2r", l1=0.7, l2=0.4)
    q, w = [0.3, 0.9], np.array([1.5, -0.4])
    c1, s1, c12, s12 = cos(0.3), sin(0.3), cos(1.2), sin(1.2)
    w12 = w.sum()
    expected = [-0.7 * c1 * w[0] ** 2 - 0.4 * c12 * w12**2, -0.7 * s1 * w[0] ** 2 - 0.4 * s12 * w12**2]
    assert r1.trajectories.jacobian_rate(robot, r1.PositionTask("xy"), q, w) @ w == pytest.approx(expected, abs=1e-11)


# --- first order


@pytest.mark.parametrize(("name", "task"), CASES, ids=IDS)
def test_a_velocity_in_the_range_is_realised_and_the_residual_of_another_is_orthogonal_to_the_range(name, task):
    robot = arm(name)
    q = random_q(robot, 11)
    J = task.jacobian(robot, q)
    inside = J @ rates(robot.nv, 1)
    found = r1.joint_velocity(robot, task, inside, q)
    assert J @ found.qdot == pytest.approx(inside, abs=1e-9)
    assert found.feasible
    assert found.status.name.startswith("REALISED")
    assert not found.unrealisable.any()
    other = r1.joint_velocity(robot, task, rates(task.rows, 2), q)
    assert J.T @ other.residual == pytest.approx(np.zeros(robot.nv), abs=1e-9)
    assert other.realised == pytest.approx(J @ other.qdot, abs=1e-12)
    if np.linalg.matrix_rank(J, tol=1e-9) < task.rows:
        assert other.status is r1.trajectories.RateStatus.OUT_OF_RANGE
        assert other.unrealisable == pytest.approx(other.residual, abs=1e-9)
    kernel = null_space(J, rcond=1e-9)
    assert kernel.T @ found.qdot == pytest.approx(np.zeros(kernel.shape[1]), abs=1e-9)  # the shortest


@given(st.integers(0, 50))
@settings(max_examples=15)
def test_weighted_velocity_has_the_least_weighted_norm_by_the_closed_form(seed):
    robot = arm("redundant")
    q, rdot = random_q(robot, seed), rates(6, seed + 1)
    w = np.random.default_rng(seed).uniform(0.2, 5, 7)
    J, inverse = r1.PoseTask().jacobian(robot, q), np.diag(1 / w)
    expected = inverse @ J.T @ np.linalg.solve(J @ inverse @ J.T, rdot)
    found = r1.joint_velocity(robot, r1.PoseTask(), rdot, q, resolution=Resolution(weights=w))
    assert found.qdot == pytest.approx(expected, rel=1e-6, abs=1e-8)
    assert found.qdot @ (w * null_space(J)[:, 0]) == pytest.approx(0, abs=1e-8 * np.abs(found.qdot).max())


def test_weights_may_be_a_matrix_and_one_for_all_is_the_pseudoinverse():
    robot, q = arm("redundant"), random_q(arm("redundant"), 2)
    root = np.random.default_rng(3).normal(size=(7, 7))
    W = root @ root.T + np.eye(7)
    rdot = np.array([0.3, -0.1, 0.2])
    J, inverse = XYZ.jacobian(robot, q), np.linalg.inv(W)
    found = r1.joint_velocity(robot, XYZ, rdot, q, resolution=Resolution(weights=W))
    assert found.qdot == pytest.approx(inverse @ J.T @ np.linalg.solve(J @ inverse @ J.T, rdot), rel=1e-9)
    plain = r1.joint_velocity(robot, XYZ, rdot, q, resolution=Resolution(weights=np.full(7, 3.0)))
    assert plain.qdot == pytest.approx(np.linalg.pinv(J) @ rdot, rel=1e-9)
    heavy = r1.joint_velocity(robot, XYZ, rdot, q, resolution=Resolution(weights=[1, 1e8, 1, 1, 1, 1, 1]))
    assert abs(heavy.qdot[1]) < 1e-7


@given(st.floats(0.01, 2), st.integers(0, 30))
@settings(max_examples=15)
def test_damped_velocity_minimises_the_error_and_the_damped_weighted_norm(damping, seed):
    robot, w = arm("spatial"), np.array([1.0, 2, 0.5, 3, 1])
    q, rdot = random_q(robot, seed), rates(3, seed)
    J = XYZ.jacobian(robot, q)
    found = r1.joint_velocity(robot, XYZ, rdot, q, resolution=Resolution(damping=damping, weights=w))
    expected = np.linalg.solve(J.T @ J + damping**2 * np.diag(w), J.T @ rdot)
    assert found.qdot == pytest.approx(expected, abs=1e-9)
    cost = lambda x: np.sum((rdot - J @ x) ** 2) + damping**2 * np.sum(w * x**2)  # noqa: E731
    assert cost(found.qdot) <= minimize(cost, np.zeros(5)).fun + 1e-9
    assert found.status is r1.trajectories.RateStatus.DAMPED
    assert found.feasible


def test_damping_in_a_region_leaves_regular_states_alone_and_grows_towards_the_singularity():
    robot, task = arm("planar_2r"), r1.PositionTask("xy")
    soft = Resolution(damping=0.3, region=0.2)
    J = task.jacobian(robot, [0.2, 1.0])
    regular = r1.joint_velocity(robot, task, [1, 2], [0.2, 1.0], resolution=soft)
    assert regular.damping == 0
    assert regular.qdot == pytest.approx(np.linalg.solve(J, [1, 2]))
    near = r1.joint_velocity(robot, task, [1, 2], [0.2, 0.1], resolution=soft)
    sigma = near.singular_values[-1]
    assert near.damping == pytest.approx(0.3 * np.sqrt(1 - (sigma / 0.2) ** 2))
    singular = r1.joint_velocity(robot, task, [1, 2], [0.2, 0.0], resolution=soft)
    assert singular.damping == pytest.approx(0.3)
    assert np.linalg.norm(singular.qdot) < 3


def test_a_singular_2r_realises_what_is_across_it_and_says_what_is_lost():
    robot, task, q = arm("planar_2r", l1=1.0, l2=1.0), r1.PositionTask("xy"), [0.5, 0.0]
    along, across = np.array([cos(0.5), sin(0.5)]), np.array([-sin(0.5), cos(0.5)])
    good = r1.joint_velocity(robot, task, 3 * across, q)
    assert good.status is r1.trajectories.RateStatus.REALISED_ALL_THE_SAME
    assert (good.rank, good.feasible) == (1, True)
    assert good.qdot == pytest.approx(np.array([2, 1]) * 3 / 5)
    bad = r1.joint_velocity(robot, task, 3 * across + 2 * along, q)
    assert bad.status is r1.trajectories.RateStatus.OUT_OF_RANGE
    assert bad.residual == pytest.approx(2 * along)
    assert bad.unrealisable == pytest.approx(2 * along)
    assert bad.qdot == pytest.approx(good.qdot)
    assert "rank 1 of 2" in bad.explain()
    assert "|residual| = 2" in bad.explain()
    close = r1.joint_velocity(robot, task, along, [0.5, 1e-3])
    assert close.near_singular
    assert close.status is r1.trajectories.RateStatus.REALISED
    assert "near a singularity" in close.explain()
    assert np.abs(close.qdot).max() > 1e3 / 3
    assert "near" not in r1.joint_velocity(robot, task, along, [0.5, 1.0]).explain()


@pytest.mark.parametrize(
    "resolution", [Resolution(), Resolution(weights=[1, 2, 3, 4, 5, 6, 7]), Resolution(damping=0.1)]
)
def test_null_motion_adds_a_part_that_does_not_move_the_task(resolution):
    robot, q, rdot, wish = arm("redundant"), random_q(arm("redundant"), 4), rates(6, 1), rates(7, 2)
    task = r1.PoseTask()
    plain = r1.joint_velocity(robot, task, rdot, q, resolution=resolution)
    moved = r1.joint_velocity(robot, task, rdot, q, resolution=resolution, null_velocity=wish)
    added = moved.qdot - plain.qdot
    assert np.linalg.norm(added) > 0.05
    assert task.jacobian(robot, q) @ added == pytest.approx(np.zeros(6), abs=1e-9)
    kernel = null_space(task.jacobian(robot, q))
    if resolution.weights is None:
        assert added == pytest.approx(kernel @ (kernel.T @ wish), abs=1e-9)


# --- second order


@pytest.mark.parametrize(("name", "task"), CASES, ids=IDS)
def test_an_acceleration_in_the_range_is_realised(name, task):
    robot = arm(name)
    q, qdot = random_q(robot, 11), rates(robot.nv, 3)
    J = task.jacobian(robot, q)
    drift = r1.trajectories.jacobian_rate(robot, task, q, qdot) @ qdot
    asked = J @ rates(robot.nv, 4) + drift
    found = r1.joint_acceleration(robot, task, asked, q, qdot)
    assert found.drift == pytest.approx(drift, abs=1e-7)
    assert J @ found.qddot + drift == pytest.approx(asked, abs=1e-7)
    assert found.realised == pytest.approx(asked, abs=1e-7)
    assert np.linalg.norm(found.residual) == pytest.approx(0, abs=1e-7)


@pytest.mark.parametrize("name", ["spatial", "cylindrical", "redundant"])
def test_round_trip_of_a_joint_motion_through_the_task(name):
    robot = arm(name)
    motion = r1.cubic(random_q(robot, 1), random_q(robot, 2), 2.0)
    task = r1.PoseTask() if robot.nv > 5 else r1.PositionTask("xyz")
    seen = r1.trajectories.TaskTrajectory(robot, task, motion)
    t = 0.63
    q, qdot, qddot = motion(t), motion.velocity(t), motion.acceleration(t)
    J = task.jacobian(robot, q)
    P = np.eye(robot.nv) - np.linalg.pinv(J) @ J
    found = r1.joint_velocity(robot, task, seen.velocity(t), q, null_velocity=qdot)
    assert found.qdot == pytest.approx(qdot, abs=1e-9)
    second = r1.joint_acceleration(robot, task, seen.acceleration(t), q, qdot, null_acceleration=qddot)
    assert second.qddot == pytest.approx(qddot, abs=1e-7)
    least = r1.joint_acceleration(robot, task, seen.acceleration(t), q, qdot)
    assert P @ least.qddot == pytest.approx(np.zeros(robot.nv), abs=1e-9)


def test_a_singular_acceleration_is_realised_by_the_centripetal_part_alone():
    robot, task = arm("planar_2r", l1=1.0, l2=1.0), r1.PositionTask("xy")
    w = 1.5
    found = r1.joint_acceleration(robot, task, [-2 * w**2, 0], [0, 0], [w, 0])
    assert found.feasible
    assert found.drift == pytest.approx([-2 * w**2, 0])
    assert found.qddot == pytest.approx([0, 0], abs=1e-9)
    lost = r1.joint_acceleration(robot, task, [0, 0], [0, 0], [w, 0])
    assert lost.status is r1.trajectories.RateStatus.OUT_OF_RANGE
    assert lost.residual == pytest.approx([2 * w**2, 0])


# --- the motion of the task


@pytest.mark.parametrize(("name", "task"), CASES, ids=IDS)
def test_motion_of_the_task_is_differentiated_along_the_joint_motion(name, task):
    robot = arm(name)
    if getattr(task, "reference", "world") != "world":
        return
    q = random_q(robot, 1)
    motion = r1.cubic(q, q + 0.3 * rates(robot.nv, 2), 2.0, v0=0.2)
    seen, t, h = r1.trajectories.TaskTrajectory(robot, task, motion), 0.8, 1e-3
    now = seen(t)
    steps = [task.error(robot, motion(t), seen(t + k * h)) for k in (1, -1, 2, -2)]  # log3(R(t + kh) Rᵀ) of rotations
    velocity = (8 * (steps[0] - steps[1]) - (steps[2] - steps[3])) / (12 * h)
    assert seen.velocity(t) == pytest.approx(velocity, abs=1e-7)
    for f, g, precision in [(seen.velocity, seen.acceleration, 1e-7), (seen.acceleration, seen.jerk, 1e-4)]:
        expected = (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h)
        assert g(t) == pytest.approx(expected, abs=precision * (1 + np.abs(expected).max()))
    assert len(seen([0.0, t])) == 2
    assert seen.velocity(np.array([0.0, t])).shape == (2, task.rows)
    assert now is not None


def test_cartesian_speed_of_a_joint_motion_has_its_exact_peak():
    robot, motion = arm("planar_2r"), r1.cubic([0, 0.5], [1, 1.5], 2.0)
    seen = r1.trajectories.TaskTrajectory(robot, r1.PositionTask("xy"), motion)
    t = np.linspace(0, 2, 2001)
    samples = np.linalg.norm(seen.velocity(t), axis=1)
    peak = r1.trajectories.peak_norm(seen)
    assert peak.value == pytest.approx(samples.max(), rel=1e-6)
    assert peak.value >= samples.max()
    assert peak.resolved


# --- inputs other than the joints


ROVER = """<robot name="rover"><link name="ground"/>{joints}
<joint name="t" type="fixed"><parent link="l5"/><child link="tip"/><origin xyz="0.4 0 0"/></joint>
<link name="tip"/></robot>"""


@pytest.fixture(scope="module")
def rover(tmp_path_factory):
    """A base (x, y, φ) with a planar 2R arm: q has five coordinates."""
    text, last = "", "ground"
    joints = [("prismatic", "1 0 0", 0), ("prismatic", "0 1 0", 0), ("revolute", "0 0 1", 0)]
    joints += [("revolute", "0 0 1", 0.2), ("revolute", "0 0 1", 0.5)]
    for i, (kind, axis, x) in enumerate(joints, start=1):
        text += (
            f'<joint name="q{i}" type="{kind}"><parent link="{last}"/><child link="l{i}"/><axis xyz="{axis}"/>'
            f'<origin xyz="{x} 0 0"/><limit lower="-9" upper="9" velocity="1" effort="1"/></joint><link name="l{i}"/>'
        )
        last = f"l{i}"
    file = tmp_path_factory.mktemp("rover") / "rover.urdf"
    file.write_text(ROVER.format(joints=text))
    return r1.load_robot(file)


def wheels(q):
    """The base on wheels moves along its heading: inputs (v, ω, q̇4, q̇5)."""
    G = np.zeros((5, 4))
    G[:3, :2] = [[cos(q[2]), 0], [sin(q[2]), 0], [0, 1]]
    G[3:, 2:] = np.eye(2)
    return G


def test_a_rover_moves_its_tool_by_j_times_g(rover):
    robot, G = rover, wheels
    task, q = r1.PositionTask("xy"), np.array([0.3, -0.2, 0.7, 0.4, -0.9])
    u = np.array([0.5, -0.3, 0.8, 0.2])
    a, b = 0.7 + 0.4, 0.7 + 0.4 - 0.9  # the tool is at (x, y) + 0.2 e(0.7) + 0.5 e(a) + 0.4 e(b)
    wa, wb = -0.3 + 0.8, -0.3 + 0.8 + 0.2
    rdot = 0.5 * np.array([cos(0.7), sin(0.7)]) - 0.3 * 0.2 * np.array([-sin(0.7), cos(0.7)])
    rdot += 0.5 * wa * np.array([-sin(a), cos(a)]) + 0.4 * wb * np.array([-sin(b), cos(b)])
    resolution = Resolution(input_matrix=G)
    found = r1.joint_velocity(robot, task, rdot, q, resolution=resolution)
    A = task.jacobian(robot, q) @ G(q)
    assert A @ u == pytest.approx(rdot)
    assert found.inputs == pytest.approx(np.linalg.pinv(A) @ rdot)
    assert found.qdot == pytest.approx(G(q) @ found.inputs)
    assert found.qdot[:2] @ [-sin(0.7), cos(0.7)] == pytest.approx(0)  # wheels do not slide
    assert A @ found.inputs == pytest.approx(rdot, abs=1e-12)
    kept = r1.joint_velocity(robot, task, rdot, q, resolution=resolution, null_velocity=u)
    assert kept.inputs == pytest.approx(u, abs=1e-9)  # the motion that was wished realises it


def test_a_rovers_acceleration_has_the_drift_of_j_and_of_g(rover):
    robot, G = rover, wheels
    task, q, u, udot = (
        r1.PositionTask("xy"),
        np.array([0.3, -0.2, 0.7, 0.4, -0.9]),
        np.array([0.5, -0.3, 0.8, 0.2]),
        rates(4, 5),
    )
    h = 1e-4

    def flow(steps, x, v):
        """Integrate q̇ = G u, u̇ constant, by midpoint steps."""
        for _ in range(abs(steps)):
            d = np.copysign(h, steps)
            x, v = x + d * G(x + d / 2 * G(x) @ v) @ (v + d / 2 * udot), v + d * udot
        return r1.forward_kinematics(robot, x).translation[:2].copy(), x

    ahead, now, back = flow(1, q, u), flow(0, q, u), flow(-1, q, u)
    rddot, qddot = ((a - 2 * b + c) / h**2 for a, b, c in zip(ahead, now, back, strict=True))
    found = r1.joint_acceleration(
        robot, task, rddot, q, u, resolution=Resolution(input_matrix=G), null_acceleration=udot
    )
    assert found.inputs == pytest.approx(udot, abs=1e-5)
    assert found.qddot == pytest.approx(qddot, abs=1e-5)


def test_coupled_joints_by_a_constant_matrix():
    robot, task, q = arm("planar_2r", l1=0.7, l2=0.4), r1.PositionTask("xy"), [0.3, 0.9]
    G = [[1, 0], [-1, 1]]  # motors at the base turn the links' absolute angles
    found = r1.joint_velocity(robot, task, [0.2, 0.1], q, resolution=Resolution(input_matrix=G))
    absolute = np.array([[-0.7 * sin(0.3), -0.4 * sin(1.2)], [0.7 * cos(0.3), 0.4 * cos(1.2)]])
    assert found.inputs == pytest.approx(np.linalg.solve(absolute, [0.2, 0.1]))
    assert found.qdot == pytest.approx([found.inputs[0], found.inputs[1] - found.inputs[0]])


# --- misuse

PRR = arm("prr")
CALLS = [
    (lambda: r1.joint_velocity(PRR, XYZ, [1, 2], [0, 0, 0]), InputError, r"rdot must have shape \(3,\)"),
    (lambda: r1.joint_velocity(PRR, XYZ, [1, 2, 3], [0, 0]), InputError, "q must have shape"),
    (lambda: r1.joint_velocity(PRR, XYZ, [1, np.nan, 3], [0, 0, 0]), InputError, "rdot must be finite"),
    (lambda: r1.joint_velocity(PRR, XYZ, [1, 2, 3], [0, 0, 0], null_velocity=[1]), InputError, "null_velocity must"),
    (lambda: r1.joint_velocity(PRR, r1.PlanarPoseTask("xz"), [1, 2, 3], [0, 0, 0]), TaskError, "leaves the xz plane"),
    (
        lambda: r1.joint_velocity(PRR, XYZ, [1, 2, 3], [0, 0, 0], resolution=Resolution(weights=[1, 2])),
        InputError,
        r"weights must have shape \(3,\)",
    ),
    (
        lambda: r1.joint_velocity(PRR, XYZ, [1, 2, 3], [0, 0, 0], resolution=Resolution(input_matrix=np.eye(2))),
        InputError,
        r"input_matrix must have shape \(3, any\)",
    ),
    (lambda: r1.joint_acceleration(PRR, XYZ, [1, 2, 3], [0, 0, 0], [0, 0]), InputError, "qdot must have shape"),
    (lambda: r1.joint_acceleration(PRR, XYZ, [1, 2], [0, 0, 0], [0, 0, 0]), InputError, "rddot must have shape"),
    (lambda: r1.trajectories.jacobian_rate(PRR, XYZ, [0, 0, 0], [1, 2]), InputError, "qdot must have shape"),
    (lambda: Resolution(weights=[1, 0, 2]), InputError, "weights must be positive"),
    (lambda: Resolution(weights=[[1, 2], [2, 1]]), InputError, "symmetric, positive definite"),
    (lambda: Resolution(weights=[[1, 0.5], [0, 1]]), InputError, "symmetric, positive definite"),
    (lambda: Resolution(damping=-0.1), InputError, "damping must be a non-negative number"),
    (lambda: Resolution(region=0.1), InputError, "give the damping λ too"),
    (lambda: Resolution(damping=0.1, region=0), InputError, "region must be a positive number"),
    (lambda: r1.trajectories.TaskTrajectory(PRR, XYZ, r1.cubic([0, 0], [1, 1], 1.0)), InputError, "must move 3 joints"),
    (
        lambda: r1.trajectories.TaskTrajectory(PRR, XYZ, r1.cubic([0] * 3, [1] * 3, 1.0))(1.1),
        InputError,
        r"must be in \[0, 1\]",
    ),
]


@pytest.mark.parametrize(("call", "kind", "message"), CALLS, ids=range(len(CALLS)))
def test_misuse_of_differential_kinematics_is_a_typed_error(call, kind, message):
    with pytest.raises(kind, match=message):
        call()


def test_what_is_not_realised_is_an_error_for_who_requires_it():
    """At q2 = 0 the stretched arm has no velocity along itself."""
    robot, task = arm("planar_2r"), r1.PositionTask("xy")
    good = r1.joint_velocity(robot, task, [0.1, 0.2], [0.5, 1.0])
    assert good.require() is good
    with pytest.raises(r1.NotConverged, match="not in the range of the Jacobian") as caught:
        r1.joint_velocity(robot, task, [1.0, 0.0], [0.0, 0.0]).require()
    assert caught.value.result.status is r1.trajectories.RateStatus.OUT_OF_RANGE
