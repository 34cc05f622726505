from itertools import pairwise
from math import nan, pi, sqrt

import closed_forms as cf
import numpy as np
import pinocchio as pin
import pytest
from arms import arm, random_q

from robotics1 import (
    InputError,
    NotConverged,
    OrientationTask,
    PlanarPoseTask,
    PoseTask,
    PositionTask,
    TaskError,
    forward_kinematics,
    frame_jacobian,
    iterate_ik,
    planar_arm,
)
from robotics1.ik import IKStatus

SPACE, POINT = PositionTask("xyz"), PositionTask("xy")
GOAL = (1, -1, 3)
Q_A, Q_B = (-2, 0.7 * pi, sqrt(2)), (2, pi / 4, sqrt(2))

# Tables 1 and 2 of the exam: q, p, |e|, det J. The sign of two entries is a misprint there: z of p at k = 0 is
# q1 = −2, and y of p at k = 1 is q3 sin q2 < 0.
TABLE_1 = [
    ((-2, 2.1991, 1.4142), (-0.8312, 1.1441, -2), 5.74027, -1.4142),
    ((3, 2.0426, -1.3968), (0.6349, -1.2441, 3), 0.43918, 1.3968),
    ((3, 2.3549, -1.3452), (0.9500, -0.9524, 3), 0.06895, 1.3452),
    ((3, 2.3562, -1.4142), (1.0000, -0.9999, 3), 0.00009, 1.4142),
]
TABLE_2 = [
    ((2, 0.7854, 1.4142), (1, 1, 2), 2.23607, -1.4142),
    ((3, -0.2146, 0), (0, 0, 3), 1.41421, 0),
    ((3, -0.2146, 1.1900), (1.1627, -0.2534, 3), 0.76410, -1.1900),
    ((3, -0.8567, 1.1900), (0.7794, -0.8993, 3), 0.24252, -1.1900),
    ((3, -0.7720, 1.4106), (1.0107, -0.9840, 3), 0.01921, -1.4106),
    ((3, -0.7854, 1.4141), (0.9999, -0.9999, 3), 0.00013, -1.4141),
    ((3, -0.7854, 1.4142), (1, -1, 3), 0.00000, -1.4142),
]
DIGIT = 1.0001e-4  # one unit of the fourth decimal: the exam rounds some entries and truncates others


def assert_is_table(run, table):
    assert len(run.table) == len(table) == run.iterations + 1
    for k, (row, (q, p, error, det)) in enumerate(zip(run.table, table, strict=True)):
        assert row.k == k
        assert row.q == pytest.approx(q, abs=DIGIT)
        assert row.r == pytest.approx(p, abs=DIGIT)
        assert row.error_norm == pytest.approx(error, abs=DIGIT / 10)
        assert row.det == pytest.approx(det, abs=DIGIT)


# --- the exam


def test_newton_from_q_a_is_table_1(cylindrical):
    run = iterate_ik(cylindrical, SPACE, GOAL, Q_A, method="newton", tolerance=1e-4)
    assert_is_table(run, TABLE_1)
    assert (run.status, run.converged, run.iterations) == (IKStatus.CONVERGED, True, 3)
    assert run.q == pytest.approx([3, 3 * pi / 4, -sqrt(2)], abs=1e-4)
    assert run.require() is run


def test_newton_from_q_b_meets_the_singularity_after_one_iteration(cylindrical):
    run = iterate_ik(cylindrical, SPACE, GOAL, Q_B, method="newton", tolerance=1e-4)
    assert_is_table(run, TABLE_2[:2])
    assert (run.status, run.converged) == (IKStatus.SINGULAR, False)
    assert run.q == pytest.approx([3, pi / 4 - 1, 0], abs=1e-14)
    with pytest.raises(NotConverged, match="singular") as caught:
        run.require()
    assert caught.value.result is run


def test_pseudoinverse_from_q_b_is_table_2(cylindrical):
    run = iterate_ik(cylindrical, SPACE, GOAL, Q_B, method="pseudoinverse", tolerance=1e-4)
    assert_is_table(run, TABLE_2)
    assert run.status is IKStatus.CONVERGED
    assert run.q == pytest.approx([3, -pi / 4, sqrt(2)], abs=1e-4)


# --- each step against its formula


def by_hand(method, J, e, damping=0.1, gain=None):
    if method == "newton":
        return np.linalg.inv(J) @ e
    if method == "pseudoinverse":  # of full row rank
        return J.T @ np.linalg.inv(J @ J.T) @ e
    if method == "damped":  # the other form of the same formula
        return np.linalg.inv(J.T @ J + damping**2 * np.eye(J.shape[1])) @ J.T @ e
    g = J.T @ e
    return (g @ g / ((J @ g) @ (J @ g)) if gain is None else gain) * g


@pytest.mark.parametrize("method", ["newton", "pseudoinverse", "damped", "gradient"])
def test_steps_on_the_cylindrical_robot_are_the_formulas(cylindrical, method):
    run = iterate_ik(cylindrical, SPACE, GOAL, Q_A, method=method, max_iterations=4, tolerance=1e-9)
    for row, after in pairwise(run.table):
        J, e = cf.cylindrical_jacobian(row.q), GOAL - cf.cylindrical_position(row.q)
        assert after.q - row.q == pytest.approx(by_hand(method, J, e), rel=1e-10, abs=1e-12)
        assert row.error_norm == pytest.approx(np.linalg.norm(e), rel=1e-12)
        assert row.det == pytest.approx(cf.cylindrical_determinant(row.q), abs=1e-12)
        assert row.sigma_min == pytest.approx(np.linalg.norm(J, -2), abs=1e-12)


@pytest.mark.parametrize("method", ["pseudoinverse", "damped", "gradient"])
def test_steps_on_a_redundant_planar_arm_are_the_formulas(method):
    lengths = [0.5, 0.4, 0.3]
    run = iterate_ik(arm("planar_3r"), POINT, [0.3, 0.6], [0.1, 0.5, 0.9], method=method, max_iterations=3)
    for row, after in pairwise(run.table):
        J, e = cf.planar_jacobian(row.q, lengths), np.array([0.3, 0.6]) - cf.planar_position(row.q, lengths)
        assert after.q - row.q == pytest.approx(by_hand(method, J, e), abs=1e-12)
        assert np.isnan(row.det)


def test_gain_scales_the_step_and_is_alpha_of_the_gradient(cylindrical):
    J, e = cf.cylindrical_jacobian(Q_A), np.subtract(GOAL, cf.cylindrical_position(Q_A))
    for method, step in [("newton", 0.3 * np.linalg.solve(J, e)), ("gradient", 0.3 * J.T @ e)]:
        run = iterate_ik(cylindrical, SPACE, GOAL, Q_A, method=method, gain=0.3, max_iterations=1)
        assert run.q - Q_A == pytest.approx(step, abs=1e-13)


def test_damping_is_lambda(cylindrical):
    J, e = cf.cylindrical_jacobian(Q_A), np.subtract(GOAL, cf.cylindrical_position(Q_A))
    run = iterate_ik(cylindrical, SPACE, GOAL, Q_A, method="damped", damping=0.7, max_iterations=1)
    assert run.q - Q_A == pytest.approx(by_hand("damped", J, e, damping=0.7), abs=1e-13)


def test_newton_converges_quadratically(cylindrical):
    errors = [row.error_norm for row in iterate_ik(cylindrical, SPACE, GOAL, Q_A, tolerance=1e-13).table]
    assert errors[-1] <= 1e-13
    assert all(after <= 2 * before**2 for before, after in pairwise(errors[1:]) if before > 1e-7)


# --- other tasks and arms: what converged is a solution


@pytest.mark.parametrize(
    ("name", "task", "method"),
    [
        ("spatial", PoseTask(), "pseudoinverse"),
        ("spatial", SPACE, "damped"),
        ("redundant", PoseTask(), "pseudoinverse"),
        ("redundant", OrientationTask(), "damped"),
        ("six_r", PoseTask(), "newton"),
        ("prr", PlanarPoseTask("xy"), "newton"),
        ("continuous", SPACE, "newton"),
    ],
)
def test_the_solution_has_the_wanted_forward_kinematics(name, task, method):
    robot = arm(name)
    q = 0.8 * random_q(robot, 11)
    target = task.value(robot, q)
    run = iterate_ik(robot, task, target, q + 0.1, method=method, tolerance=1e-9, max_iterations=200).require()
    reached = task.value(robot, run.q)
    if isinstance(reached, pin.SE3):
        assert forward_kinematics(robot, run.q).homogeneous == pytest.approx(target.homogeneous, abs=1e-8)
    else:
        assert reached == pytest.approx(target, abs=1e-8)
    assert len(run.table) == run.iterations + 1
    assert np.array_equal(run.table[-1].q, run.q)


# --- why it stops


def test_a_start_at_the_target_makes_no_update(planar_2r):
    run = iterate_ik(planar_2r, POINT, [2, 0], [0, 0])
    assert (run.status, run.iterations) == (IKStatus.CONVERGED, 0)


def test_max_iterations_counts_updates(cylindrical):
    run = iterate_ik(cylindrical, SPACE, GOAL, Q_A, max_iterations=2, tolerance=1e-4)
    assert (run.status, run.iterations) == (IKStatus.MAX_ITERATIONS, 2)
    assert iterate_ik(cylindrical, SPACE, GOAL, Q_A, max_iterations=3).status is IKStatus.CONVERGED
    assert iterate_ik(cylindrical, SPACE, GOAL, Q_A, max_iterations=0).iterations == 0


@pytest.mark.parametrize("method", ["pseudoinverse", "damped", "gradient"])
def test_a_stretched_arm_pulled_along_itself_stalls(planar_2r, method):
    run = iterate_ik(planar_2r, POINT, [3, 0], [0, 0], method=method)
    assert (run.status, run.iterations) == (IKStatus.STALLED, 0)
    assert iterate_ik(planar_2r, POINT, [3, 0], [0, 0], method="newton").status is IKStatus.SINGULAR


def test_an_unreachable_target_is_an_outcome(planar_2r):
    run = iterate_ik(planar_2r, POINT, [3, 1], [0.2, 0.3], method="damped", damping=1, max_iterations=500)
    assert run.status in (IKStatus.STALLED, IKStatus.MAX_ITERATIONS)
    assert run.table[-1].error_norm == pytest.approx(sqrt(10) - 2, abs=1e-3)


def test_too_large_a_gain_diverges(cylindrical):
    run = iterate_ik(cylindrical, SPACE, GOAL, Q_A, method="gradient", gain=50, max_iterations=500)
    assert run.status is IKStatus.DIVERGED
    assert np.isfinite(run.q).all()
    with pytest.raises(NotConverged, match="grow without bound"):
        run.require()


def test_limits_are_ignored_on_the_way_and_looked_at_in_the_end():
    robot = arm("elbow_limited")
    right, left = cf.two_link_solutions([0.6, 0.7], 0.7, 0.4)
    run = iterate_ik(robot, POINT, [0.6, 0.7], right + 0.05).require()
    assert run.within_limits
    run = iterate_ik(robot, POINT, [0.6, 0.7], left + 0.05).require()
    assert run.q == pytest.approx(left, abs=1e-3)
    assert not run.within_limits


# --- misuse


@pytest.mark.parametrize(
    ("name", "task", "target"),
    [("planar_3r", POINT, [0.3, 0.3]), ("planar_2r", SPACE, [1, 0, 0]), ("redundant", PoseTask(), pin.SE3.Identity())],
)
def test_newton_needs_as_many_rows_as_joints(name, task, target):
    with pytest.raises(TaskError, match="newton needs as many task rows as joints"):
        iterate_ik(arm(name), task, target, np.zeros(arm(name).nv))


@pytest.mark.parametrize("reference", ["tool", "link3"])
def test_axes_that_move_are_a_task_error(spatial, reference):
    task = PositionTask("xyz", reference=reference)
    with pytest.raises(TaskError, match="move with the robot"):
        iterate_ik(spatial, task, [1, 0, 0], np.zeros(5), method="damped")


def test_a_planar_pose_of_a_spatial_arm_is_a_task_error(spatial):
    with pytest.raises(TaskError, match="leaves the xy plane"):
        iterate_ik(spatial, PlanarPoseTask("xy"), [0, 0, 0], np.zeros(5), method="damped")


@pytest.mark.parametrize(
    "options",
    [
        {"method": "magic"},
        {"tolerance": 0},
        {"tolerance": -1},
        {"tolerance": nan},
        {"tolerance": {"m": 0}},
        {"tolerance": {"rad": 1e-3}},
        {"tolerance": {"m": 1e-4, "rad": 1e-3}},
        {"tolerance": {}},
        {"tolerance": {1: 1e-4}},
        {"error": "space"},
        {"max_iterations": -1},
        {"max_iterations": 2.5},
        {"gain": 0},
        {"gain": "big"},
        {"damping": 0},
        {"damping": -0.1},
    ],
)
def test_bad_options_are_input_errors(cylindrical, options):
    with pytest.raises(InputError):
        iterate_ik(cylindrical, SPACE, GOAL, Q_A, **options)


@pytest.mark.parametrize(
    ("target", "q0"),
    [((1, 2), Q_A), ((1, nan, 3), Q_A), (GOAL, (1, 2)), (GOAL, (1, 2, nan)), (GOAL, None), (None, Q_A)],
)
def test_wrong_targets_and_starts_are_input_errors(cylindrical, target, q0):
    with pytest.raises(InputError):
        iterate_ik(cylindrical, SPACE, target, q0)


def test_the_start_is_not_changed(cylindrical):
    q0 = np.array(Q_A)
    iterate_ik(cylindrical, SPACE, GOAL, q0)
    assert np.array_equal(q0, Q_A)


# --- the body twist, and tolerances of their own


@pytest.mark.parametrize(("name", "method"), [("six_r", "newton"), ("redundant", "pseudoinverse"), ("six_r", "damped")])
def test_with_the_body_twist_each_step_is_that_of_log6_and_of_the_body_jacobian(name, method):
    robot = arm(name)
    T_d = forward_kinematics(robot, random_q(robot, 3))
    q0 = random_q(robot, 3) + 0.1
    run = iterate_ik(robot, PoseTask(), T_d, q0, method=method, error="body", tolerance=1e-9)
    e = pin.log6(forward_kinematics(robot, q0).inverse() * T_d).vector
    J = frame_jacobian(robot, q0, kind="body")
    inverse = J.T @ np.linalg.inv(J @ J.T + (0.01 if method == "damped" else 0) * np.eye(6))
    assert run[0].e == pytest.approx(e, abs=1e-12)
    assert run[1].q == pytest.approx(q0 + inverse @ e, abs=1e-9)
    assert pin.log6(run.require().table[-1].r.actInv(T_d)).vector == pytest.approx(np.zeros(6), abs=1e-9)


def test_an_iteration_ends_where_the_norm_in_each_unit_is_within_its_tolerance():
    robot, task = arm("six_r"), PoseTask()
    T_d = forward_kinematics(robot, random_q(robot, 3))
    run = iterate_ik(robot, task, T_d, random_q(robot, 3) + 0.1, error="body", tolerance={"rad": 1e-9, "m": 1.0})
    linear, angular = (np.array([np.linalg.norm(row.e[part]) for row in run]) for part in (slice(3), slice(3, 6)))
    assert run.error_norms["m"] == pytest.approx(linear)
    assert run.error_norms["rad"] == pytest.approx(angular)
    assert (angular[:-1] > 1e-9).all()  # it went on although the position was near enough
    assert angular[-1] <= 1e-9
    assert "|e| [rad]" in str(run)
    assert " rad" in run.explain()


def test_the_body_twist_is_that_of_a_whole_pose(cylindrical):
    for task, target in ((SPACE, GOAL), (PoseTask(angles="ZYZ"), [0.3, 0.2, 0.4, 0.1, 0.7, 0.2])):
        with pytest.raises(TaskError, match=r"twist log.* of a whole pose: use PoseTask\(\), without angles"):
            iterate_ik(cylindrical, task, target, Q_A, method="pseudoinverse", error="body")


def test_a_planar_2r_arm_of_lynch_and_park_reaches_30_and_90_degrees():
    """Their example: links of 1 m, T_d at (30°, 90°), from (0°, 30°)."""
    robot = planar_arm("RR", [1.0, 1.0])
    T_d = forward_kinematics(robot, np.radians([30, 90]))
    tolerance = {"rad": 1e-3, "m": 1e-4}
    run = iterate_ik(robot, "pose", T_d, np.radians([0, 30]), method="pseudoinverse", error="body", tolerance=tolerance)
    assert np.degrees(run[1].q) == pytest.approx([34.23, 79.18], abs=0.005)
    assert np.degrees(run[2].q) == pytest.approx([29.98, 90.22], abs=0.005)
    assert np.degrees(run.require().q) == pytest.approx([30.0, 90.0], abs=0.005)
