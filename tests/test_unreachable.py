"""UNREACHABLE is proven: whatever says so is true, and what can be proven cheaply is."""

from math import cos, pi, sqrt

import numpy as np
import pinocchio as pin
import pytest
from arms import arm
from dh_arms import P, R, dh
from drawn_arms import drawn_arm
from hypothesis import given, settings, strategies as st
from scipy.optimize import least_squares
from sweeps import some_of
from test_solve_ik import L1, L2, reached, robot

from robotics1 import (
    FunctionTask,
    IKSolver,
    LinearMotion,
    OrientationTask,
    PointingTask,
    PoseTask,
    PositionTask,
    forward_kinematics,
    ik_solutions,
    rendezvous,
    robot_from_dh,
    solve_ik,
)
from robotics1.ik import IKStatus
from robotics1.ik.pose_problem import pose_problem
from robotics1.ik.proof import UnreachableProof, reach_bound
from robotics1.trajectories import MeetingStatus

XY, XYZ = PositionTask("xy"), PositionTask()
TASKS = (XYZ, XY, PositionTask("z"), PoseTask(), OrientationTask(), PointingTask())


def goal_of(task, T):
    return {3: T.translation, 2: T.translation[:2], 1: T.translation[2:]}[task.rows]


def assert_never_proven(seed):
    """No pose that forward kinematics gives is proven out of reach, for any task."""
    robot, rng = drawn_arm(seed), np.random.default_rng(seed)
    for task in TASKS:
        proof = UnreachableProof(pose_problem(robot, task))
        for q in rng.uniform(robot.lower, robot.upper, (3, robot.nq)):
            goal = forward_kinematics(robot, q).homogeneous
            assert not proof.at_once(goal, 1e-9 * robot.reach, 1e-9)
            assert not proof.by_exclusion(goal, 1e-9 * robot.reach, 1e-9, seconds=0.0)


@given(st.integers(0, 10_000))
@settings(max_examples=12)
def test_no_pose_of_a_drawn_arm_is_proven_out_of_reach(seed):
    assert_never_proven(seed)


@pytest.mark.parametrize("seed", some_of(range(30_000, 30_500), 10))
def test_nor_is_one_of_many_drawn_arms(seed):
    assert_never_proven(seed)


def brute_force(robot, target, rng):
    """The least |p_d − p| that 400 samples and descents from the ten nearest of them find."""
    samples = rng.uniform(robot.lower, robot.upper, (400, robot.nq))
    far = [np.linalg.norm(XYZ.error(robot, q, target)) for q in samples]
    least = np.inf
    for i in np.argsort(far)[:10]:
        inside = np.clip(samples[i], robot.lower + 1e-12, robot.upper - 1e-12)
        found = least_squares(
            lambda q: XYZ.error(robot, q, target), inside, bounds=(robot.lower - 1e-12, robot.upper + 1e-12),
            x_scale=robot.units,
        )  # fmt: skip
        least = min(least, float(np.linalg.norm(found.fun)))
    return least


def assert_brute_force_agrees(seed):
    """A target of which UNREACHABLE is told is reached by no brute force, and its nearest miss is as near as any."""
    robot, rng = drawn_arm(seed, joints=1 + seed % 3, followers=False), np.random.default_rng(seed)
    T = forward_kinematics(robot, rng.uniform(robot.lower, robot.upper))
    target = T.translation + robot.reach * rng.choice([0.02, 0.2, 1.0]) * rng.standard_normal(3)
    answer = solve_ik(robot, XYZ, target, time_limit=0.05)
    found = ik_solutions(robot, XYZ, target, starts=10)
    assert (answer.status is IKStatus.CONVERGED) != (found.status in (IKStatus.UNREACHABLE, IKStatus.NOT_FOUND)) or (
        robot.reach < 1e-2  # there the absolute tolerance of one is not the relative of the other
    )
    if IKStatus.UNREACHABLE is answer.status or found.status is IKStatus.UNREACHABLE:
        least = brute_force(robot, target, rng)
        assert least > 1e-7 * robot.reach
        assert min(answer.error_norm, found.error_norm) <= least * (1 + 1e-6)


@given(st.integers(0, 10_000))
@settings(max_examples=10)
def test_what_is_unreachable_is_reached_by_no_brute_force(seed):
    assert_brute_force_agrees(seed)


@pytest.mark.parametrize("seed", some_of(range(40_000, 40_200), 10))
def test_so_it_is_for_many_drawn_arms(seed):
    assert_brute_force_agrees(seed)


# --- what is proven


@pytest.mark.parametrize(
    ("name", "task", "target"),
    [
        ("planar_2r", XY, [0.1, 0]),  # nearer than l1 − l2
        ("planar_2r", XY, [0, 2.01]),
        ("planar_2r", XYZ, [1, 1, 0.1]),  # out of the plane
        ("elbow_limited", XY, [sqrt(0.49 + 0.16 + 0.56 * cos(0.3)) + 1e-3, 0]),
        ("cylindrical", XYZ, [1, 0, 5]),  # beyond the slide
        ("anthropomorphic", XYZ, [0, 0.01, 0.4]),  # nearer than l2 − l3 to the shoulder
    ],
)
def test_holes_planes_limits_and_slides_are_proven_in_both_calls(name, task, target):
    robot = arm(name)
    assert solve_ik(robot, task, target).status is IKStatus.UNREACHABLE
    found = ik_solutions(robot, task, target, starts=10)
    assert (found.status, found.complete) == (IKStatus.UNREACHABLE, True)


def test_a_planar_arm_turns_about_its_normal_alone(planar_2r):
    tilted = pin.exp3(np.array([0.2, 0, 0]))
    for task, target in (
        (OrientationTask(), tilted),
        (PointingTask(), [0, 1, 1]),
        (PoseTask(), pin.SE3(tilted, np.ones(3))),
    ):
        assert solve_ik(planar_2r, task, target, time_limit=0.05).status is IKStatus.UNREACHABLE
    assert solve_ik(planar_2r, OrientationTask(), pin.exp3(np.array([0, 0, 0.3]))).converged


def test_a_task_that_no_joint_moves_is_proven():
    robot = robot_from_dh([("P", 0, 0, 0.1, 0)], lower=[-1], upper=[1])
    assert solve_ik(robot, XY, [0.1, 0], time_limit=0.05).status is IKStatus.UNREACHABLE
    assert solve_ik(robot, XY, [0, 0]).converged


def test_nothing_is_proven_of_a_function_or_of_a_search_that_failed(planar_2r):
    same = FunctionTask(lambda p, R, q: p[:2], 2)
    assert ik_solutions(planar_2r, same, [3, 0], starts=3).status is IKStatus.NOT_FOUND
    slides = robot_from_dh([("R", 0.3, pi / 2, 0, 0), ("P", 0, 0, 0, 0)])
    on_the_axis = IKSolver(slides, XYZ, time_limit=0.01)([0.0, 0.0, 0.0])  # 0.3 m away, whatever the endless slide does
    assert on_the_axis.status is IKStatus.NOT_FOUND


def test_a_meeting_point_is_unreachable_only_where_that_is_proven(planar_2r):
    here = LinearMotion([3, 0], [0, 0.5])
    assert rendezvous(planar_2r, XY, here, [0, 0], meet=1.0).status is MeetingStatus.UNREACHABLE
    same = FunctionTask(lambda p, R, q: p[:2], 2)
    assert rendezvous(planar_2r, same, here, [0, 0], meet=1.0).status is MeetingStatus.NOT_FOUND


# --- the bound on the reach


@pytest.mark.parametrize(
    ("name", "o", "length"),
    [
        ("planar_2r", (0, 0, 0), L1 + L2),
        ("prr", (0, 0, 0), 2 + 0.6 + 0.4),  # the travel of the slide, and both links
        ("cylindrical", (0, 0, 0), 4 + 4),  # both travels
        ("anthropomorphic", (0, 0, 0.4), 0.5 + 0.35),
        ("redundant", (0, 0, 0.36), 0.42 + 0.4 + 0.126),
    ],
)
def test_the_bound_is_the_sum_of_links_and_travels_from_the_first_axis(name, o, length):
    bound = reach_bound(pose_problem(arm(name), PositionTask()))
    assert bound.o == pytest.approx(np.array(o), abs=1e-6)
    assert bound.length == pytest.approx(length, abs=1e-7)


@pytest.mark.parametrize("name", ["spatial", "six_r", "redundant", "continuous", "elbow_limited", "ur5", "panda"])
def test_no_configuration_is_beyond_the_bound(name):
    some, rng = robot(name), np.random.default_rng(1)
    bound = reach_bound(pose_problem(some, PoseTask()))
    for q in rng.uniform(np.maximum(some.lower, -7), np.minimum(some.upper, 7), (500, some.nq)):
        T = forward_kinematics(some, q)
        assert np.linalg.norm(T.translation - bound.o) <= bound.length + 1e-12
        assert bound.excess(T.homogeneous[None], np.ones(6)) <= 1e-12
        if bound.hand is not None:
            assert np.linalg.norm(T.act(bound.hand) - bound.o) <= bound.length_to_hand + 1e-12


@pytest.mark.parametrize(("lower", "upper"), [(-3, 1), (-1, 3)])
def test_a_travel_counts_with_its_farther_limit(lower, upper):
    rows = [("R", 0.3, pi / 2, 0.2, 0), ("P", 0, 0, 0, 0)]
    slide = robot_from_dh(rows, lower=[None, lower], upper=[None, upper])
    bound = reach_bound(pose_problem(slide, PositionTask()))
    assert bound.length == pytest.approx(0.3 + 3, abs=1e-6)
    assert bound.o == pytest.approx(np.array([0, 0, 0.2]), abs=1e-3)
    for q in ([0.4, lower], [0.4, upper]):
        reached(slide, PositionTask(), forward_kinematics(slide, q).translation)


def test_a_prismatic_joint_without_limits_has_no_bound_and_goes_as_far_as_it_must():
    slide = dh(R("a", pi / 2, 0.2), P(0), a=0.3)
    assert np.isinf(reach_bound(pose_problem(slide, PositionTask())).length)
    target = forward_kinematics(slide, [0.4, 2]).translation
    found = reached(slide, PositionTask(), target)
    assert forward_kinematics(slide, found.q).translation == pytest.approx(target, abs=1e-6)
    assert abs(found.q[1]) == pytest.approx(2, abs=0.7)


@pytest.mark.parametrize("far", [1e160, 1e308])
@pytest.mark.parametrize(
    ("name", "task"), [("six_r", PoseTask()), ("general", PoseTask()), ("spatial", XYZ), ("planar_2r", PoseTask())]
)
def test_a_target_whose_square_is_no_number_is_out_of_reach(name, task, far):
    rows = [("R", *row, 0) for row in np.random.default_rng(3).uniform(-1, 1, (6, 3)).round(3)]
    robot = robot_from_dh(rows) if name == "general" else arm(name)
    T = np.eye(4)
    T[0, 3] = far
    found = ik_solutions(robot, task, T[:3, 3] if task is XYZ else T)
    assert (found.status, found.complete) == (IKStatus.UNREACHABLE, True)
    assert found.error_norm == pytest.approx(far)
