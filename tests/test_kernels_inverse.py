"""The parts of the descent: rotation vectors, errors, the damped step inside limits, starts, turns, preferences."""

import math
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pinocchio as pin
import pytest
from arms import arm, random_q
from scipy.optimize import lsq_linear
from scipy.spatial.transform import Rotation

from robotics1 import IKSolver, PoseTask, PositionTask, forward_kinematics, frame_jacobian, load_robot
from robotics1.ik.pose_problem import pose_problem
from robotics1.kernels.chain import chain_arrays
from robotics1.kernels.compilation import on_all_cores
from robotics1.kernels.damped_step import damped_step, factor, solve_factored
from robotics1.kernels.descent import descend
from robotics1.kernels.inverse import is_pose, nearest_start, start_table, wind
from robotics1.kernels.pose import leave_out, pose_error, rotation_vector
from robotics1.kernels.redundancy import approach

FREE = np.array([[-np.inf], [np.inf], [1.0]])
NOTHING = np.zeros(3)


def directions(count, seed=0):
    a = np.random.default_rng(seed).standard_normal((count, 3))
    return [*np.eye(3), *(a / np.linalg.norm(a, axis=1)[:, None])]


def log3(R):
    w = np.empty(3)
    rotation_vector(np.ascontiguousarray(R), w)
    return w


# --- log3


@pytest.mark.parametrize("angle", [0.0, 1e-14, 1e-9, 1e-6, 1e-3, 0.5, 1.5, 3.0, 3.1, math.pi - 1e-3])
def test_log3_of_a_turn_by_theta_about_a_is_theta_a(angle):
    for a in directions(20):
        assert log3(Rotation.from_rotvec(angle * a).as_matrix()) == pytest.approx(angle * a, abs=2e-13)


@pytest.mark.parametrize("below", [1e-4, 1e-6, 1e-9, 1e-12, 0.0])
def test_log3_next_to_a_half_turn_is_the_axis_times_the_angle_of_either_sense(below):
    for a in directions(20):
        R = Rotation.from_rotvec((math.pi - below) * a).as_matrix()
        w = log3(R)
        assert np.linalg.norm(w) == pytest.approx(math.pi - below, abs=1e-12)
        assert abs(w @ a) == pytest.approx(math.pi - below, abs=1e-12)
        assert Rotation.from_rotvec(w).as_matrix() == pytest.approx(R, abs=1e-10)


def test_log3_is_pinocchios():
    for seed in range(200):
        R = Rotation.random(rng=seed).as_matrix()
        w = pin.log3(R)
        error = np.finfo(float).eps / (math.pi - np.linalg.norm(w)) ** 2  # Pinocchio's, next to a half turn
        assert log3(R) == pytest.approx(w, abs=max(1e-12, 30 * error))


# --- the error of a pose, and of a direction


def error(goal, T, axis=NOTHING):
    e = np.empty(6)
    pose_error(goal.homogeneous, axis, np.ascontiguousarray(T.homogeneous[:3]), np.empty((3, 3)), e)
    return e


def placement(seed):
    rng = np.random.default_rng(seed)
    return pin.SE3(Rotation.random(rng=rng).as_matrix(), rng.standard_normal(3))


def test_the_error_of_a_pose_is_p_d_minus_p_and_log3_of_R_d_R_transposed():
    for seed in range(50):
        goal, T = placement(seed), placement(1000 + seed)
        expected = [*(goal.translation - T.translation), *pin.log3(goal.rotation @ T.rotation.T)]
        assert error(goal, T) == pytest.approx(expected, abs=1e-12)


def test_the_error_of_a_direction_turns_it_onto_the_goals_by_the_least_angle():
    for seed, a in enumerate(directions(50)):
        goal, T = placement(seed), placement(1000 + seed)
        omega = error(goal, T, a)[3:]
        r, r_d = T.rotation @ a, goal.rotation @ a
        assert np.linalg.norm(omega) == pytest.approx(np.arccos(np.clip(r @ r_d, -1, 1)), abs=1e-9)
        assert pin.exp3(omega) @ r == pytest.approx(r_d, abs=1e-12)
        assert omega @ r == pytest.approx(0, abs=1e-12)


def test_opposite_directions_are_half_a_turn_about_a_normal_apart():
    for a in directions(20):
        T = placement(3)
        r = T.rotation @ a
        normal = np.cross(r, np.eye(3)[np.argmin(np.abs(r))])
        goal = pin.SE3(pin.exp3(np.pi * normal / np.linalg.norm(normal)) @ T.rotation, np.zeros(3))
        omega = error(goal, T, a)[3:]
        assert np.linalg.norm(omega) == pytest.approx(np.pi, abs=1e-7)
        assert pin.exp3(omega) @ r == pytest.approx(-r, abs=1e-7)


def test_rows_that_do_not_count_vanish_and_so_do_turns_about_the_axis():
    rng, a, T = np.random.default_rng(0), np.array([0.0, 0.6, 0.8]), placement(1)
    J, counted = rng.standard_normal((6, 7)), np.array([1.0, 0, 1, 1, 1, 1])
    columns, e = np.ascontiguousarray(J.T), rng.standard_normal(6)
    kept = e.copy()
    leave_out(counted, a, np.ascontiguousarray(T.homogeneous[:3]), columns, e)
    r = T.rotation @ a
    expected = np.vstack([J[0], np.zeros(7), J[2], (np.eye(3) - np.outer(r, r)) @ J[3:]])
    assert columns.T == pytest.approx(expected, abs=1e-14)
    assert e == pytest.approx(kept * counted)


# --- the damped step


def test_L_D_L_transposed_is_the_matrix_and_the_solution_is_numpys():
    rng = np.random.default_rng(0)
    for _ in range(50):
        root = rng.standard_normal((6, 8))
        A, b = root @ root.T + 1e-6 * np.eye(6), rng.standard_normal(6)
        packed, y = A.copy(), b.copy()
        factor(packed)
        L, D = np.tril(packed, -1) + np.eye(6), np.diag(np.diag(packed))
        assert L @ D @ L.T == pytest.approx(A, abs=1e-12)
        solve_factored(packed, y)
        assert A @ y == pytest.approx(b, abs=1e-9)


def step_of(J, e, damping, *, wish=None, limits=None, x=None):
    n = J.shape[1]
    step = np.empty(n)
    damped_step(
        np.ascontiguousarray(J.T), e, np.zeros(n) if wish is None else wish, damping,
        np.repeat(FREE, n, axis=1) if limits is None else limits, np.zeros(n) if x is None else x,
        np.empty(n), np.empty((6, 6)), np.empty(6), step,
    )  # fmt: skip
    return step


@pytest.mark.parametrize("n", [1, 2, 6, 7, 10])
def test_the_step_is_J_transposed_times_the_damped_inverse_of_J_J_transposed_times_e(n):
    rng = np.random.default_rng(n)
    J, e, wish = rng.standard_normal((6, n)), rng.standard_normal(6), rng.standard_normal(n)
    expected = J.T @ np.linalg.solve(J @ J.T + 0.01 * np.eye(6), e)
    assert step_of(J, e, 0.01) == pytest.approx(expected, abs=1e-10)
    moved = wish + J.T @ np.linalg.solve(J @ J.T + 0.01 * np.eye(6), e - J @ wish)
    assert step_of(J, e, 0.01, wish=wish) == pytest.approx(moved, abs=1e-10)


def test_without_a_task_error_the_step_is_the_projection_of_the_wish_on_the_null_space():
    rng = np.random.default_rng(1)
    J, wish = rng.standard_normal((6, 9)), rng.standard_normal(9)
    projection = (np.eye(9) - np.linalg.pinv(J) @ J) @ wish
    assert step_of(J, np.zeros(6), 1e-12, wish=wish) == pytest.approx(projection, abs=1e-8)


def test_joints_at_limits_that_would_leave_them_are_held_and_the_others_make_the_damped_step_alone():
    held_somewhere = 0
    for seed in range(200):
        rng = np.random.default_rng(seed)
        J, e, x = rng.standard_normal((6, 7)), rng.standard_normal(6), np.zeros(7)
        side = rng.integers(-1, 2, 7)  # −1 stands at the lower limit, 1 at the upper, 0 between
        limits = np.array([np.where(side == -1, 0.0, -9.0), np.where(side == 1, 0.0, 9.0), np.zeros(7)])
        step = step_of(J, e, 0.1, limits=limits, x=x)
        assert not np.any((side == -1) & (step < 0))
        assert not np.any((side == 1) & (step > 0))
        free = step != 0
        alone = J[:, free].T @ np.linalg.solve(J[:, free] @ J[:, free].T + 0.1 * np.eye(6), e)
        assert step[free] == pytest.approx(alone, abs=1e-10)
        # it reduces |e − J Δx|² + λ² |Δx|², and no more than the least of it inside the limits does
        stacked, wanted = np.vstack([J, np.sqrt(0.1) * np.eye(7)]), np.concatenate([e, np.zeros(7)])
        best = lsq_linear(stacked, wanted, (np.where(side == -1, 0, -9.0), np.where(side == 1, 0, 9.0)), method="bvls")
        cost = np.sum((stacked @ step - wanted) ** 2)
        assert 2 * best.cost - 1e-9 <= cost <= e @ e + 1e-12
        held_somewhere += not free.all()
    assert held_somewhere > 100


# --- starts and turns


def test_a_pose_is_finite_and_its_rotation_orthonormal_and_right_handed():
    T = placement(0).homogeneous
    assert is_pose(T)
    for i, j, value in [(0, 3, np.nan), (1, 3, np.inf), (2, 2, np.nan), (0, 0, T[0, 0] + 1e-5)]:
        broken = T.copy()
        broken[i, j] = value
        assert not is_pose(broken)
    mirrored = T.copy()
    mirrored[:3, 0] *= -1
    assert not is_pose(mirrored)


def test_the_nearest_start_has_the_least_sum_of_squared_distance_and_half_the_squared_difference_of_rotations():
    robot, rng = arm("six_r"), np.random.default_rng(0)
    chain, starts = chain_arrays(robot), rng.uniform(-3, 3, (64, robot.nq))
    table = start_table(chain.links(), starts)
    for seed in range(20):
        goal = forward_kinematics(robot, random_q(robot, seed))
        poses = [forward_kinematics(robot, q) for q in starts]
        far = [
            np.sum((goal.translation - T.translation) ** 2) + 0.5 * np.sum((goal.rotation - T.rotation) ** 2)
            for T in poses
        ]
        chosen = nearest_start(np.ones(6), goal.homogeneous, table, 0, 64)
        assert chosen == np.argmin(far)
        assert table[chosen, 12:] == pytest.approx(starts[chosen], abs=0)
        assert nearest_start(np.ones(6), goal.homogeneous, table, 32, 64) == 32 + np.argmin(far[32:])
        plane = [np.sum((goal.translation - T.translation)[:2] ** 2) for T in poses]
        counted = np.array([1.0, 1, 0, 0, 0, 0])
        assert nearest_start(counted, goal.homogeneous, table, 0, 64) == np.argmin(plane)


@pytest.mark.parametrize(
    ("x", "around", "lower", "upper", "expected"),
    [
        (7.0, 0.0, -np.inf, np.inf, 7.0 - 2 * np.pi),
        (3.5, 0.0, -np.inf, np.inf, 3.5 - 2 * np.pi),
        (2.9, 0.0, -np.inf, np.inf, 2.9),
        (0.5, 6.5, -2 * np.pi, 4 * np.pi, 0.5 + 2 * np.pi),
        (0.5, 6.5, -2 * np.pi, 2 * np.pi, 0.5),  # 6.78 would be the nearest, and is beyond the limit
        (-0.5, -6.5, -2 * np.pi, 2 * np.pi, -0.5),
        (3.0, 100.0, 10.0, 20.0, 3.0 + 4 * np.pi),
    ],
)
def test_a_joint_that_makes_whole_turns_takes_the_value_nearest_inside_the_limits(x, around, lower, upper, expected):
    values = np.array([x])
    wind(np.array([[lower], [upper], [1.0]]), np.array([around]), values)
    assert values[0] == pytest.approx(expected, abs=1e-12)


def test_a_joint_with_limits_is_not_turned():
    values = np.array([3.0])
    wind(np.array([[-4.0], [4.0], [0.0]]), np.array([-3.0]), values)
    assert values[0] == 3.0


# --- descents


def test_a_descent_from_a_solution_ends_there_with_no_error():
    robot, q = arm("six_r"), random_q(arm("six_r"), 2)
    chain, goal = chain_arrays(robot).links(), forward_kinematics(robot, q).homogeneous
    best = np.empty(robot.nq)
    limits = np.repeat(FREE, robot.nq, axis=1)
    error = descend(chain, limits, np.ones(6), NOTHING, 1.0, 1e-9, goal, q.copy(), best)
    assert error <= 1e-14
    assert best == pytest.approx(q, abs=0)


def test_a_descent_near_a_regular_solution_converges_like_newtons_method():
    """With a tolerance of 1e-12 just one or two steps more are needed than with 1e-6."""
    robot, q = arm("six_r"), np.array([0.4, -0.7, 0.9, 0.3, 0.8, -0.2])
    chain, goal = chain_arrays(robot).links(), forward_kinematics(robot, q).homogeneous
    limits, best = np.repeat(FREE, robot.nq, axis=1), np.empty(robot.nq)
    error = descend(chain, limits, np.ones(6), NOTHING, 1.0, 1e-12, goal, q + 0.02, best)
    assert error <= 1e-12
    assert best == pytest.approx(q, abs=1e-9)


def test_along_the_null_space_the_wish_is_reached_as_far_as_its_projection_vanishes():
    robot = load_robot("panda", tool="panda_link8")
    problem = pose_problem(robot, PositionTask())
    chain = chain_arrays(robot)
    n = len(problem.active)
    q = np.array([0.1, 0.3, -0.2, -1.8, 0.2, 2.0, 0.4])
    goal = forward_kinematics(robot, np.append(q, 0.0))
    limits, wished, x = np.repeat(FREE, n, axis=1), q + 0.1, q.copy()
    approach(chain.links(), limits, np.array([1.0, 1, 1, 0, 0, 0]), NOTHING, goal.homogeneous, wished, x)
    J = frame_jacobian(robot, np.append(x, 0.0))[:3, :n]
    null = np.eye(n) - np.linalg.pinv(J) @ J
    assert np.linalg.norm(null @ (wished - x)) <= 1e-6
    assert forward_kinematics(robot, np.append(x, 0.0)).translation == pytest.approx(goal.translation, abs=1e-6)
    assert np.linalg.norm(wished - x) < np.linalg.norm(wished - q)


# --- many targets at once

FORKED = """
import multiprocessing, sys
import numpy as np
from robotics1 import IKSolver, PositionTask, load_robot
robot = load_robot("planar_2r")
targets = np.random.default_rng(0).uniform(-1, 1, (500, 2)) + [0.6, 0.6]
solver = IKSolver(robot, PositionTask("xy"))
solver.solve_batch(targets)
child = multiprocessing.get_context("fork").Process(target=solver.solve_batch, args=(targets,))
child.start()
child.join(60)
sys.exit(child.exitcode)
"""


def test_a_batch_runs_in_a_process_that_was_forked_after_another_batch():
    run = subprocess.run([sys.executable, "-c", FORKED], check=False, capture_output=True, text=True, timeout=120)
    assert run.returncode == 0, run.stderr


def test_batches_of_two_threads_at_once_are_those_of_one_after_the_other():
    robot = arm("six_r")
    targets = [forward_kinematics(robot, random_q(robot, seed)) for seed in range(200)]
    solvers = [IKSolver(arm("six_r"), PoseTask(), seed=seed) for seed in (1, 2)]
    alone = [solver.solve_batch(targets).q for solver in solvers]
    with ThreadPoolExecutor(2) as pool:
        together = list(pool.map(lambda solver: solver.solve_batch(targets).q, solvers))
    for one, other in zip(alone, together, strict=True):
        assert one == pytest.approx(other, abs=0)


def test_slices_on_all_cores_make_up_the_whole_once_and_errors_are_raised():
    for count in (1, 2, 7, 100, 1001):
        done = np.zeros(count, dtype=int)

        def work(some, done=done):
            done[some] += 1

        on_all_cores(work, count)
        assert done.tolist() == [1] * count

    def fail(some):
        raise ZeroDivisionError

    with pytest.raises(ZeroDivisionError):
        on_all_cores(fail, 100)
