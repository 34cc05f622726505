from math import cos, inf, nan, pi, radians, sin

import closed_forms as cf
import numpy as np
import pytest
from arms import arm
from hypothesis import given, settings, strategies as st

from robotics1 import (
    InputError,
    LinearMotion,
    NotConverged,
    PlanarPoseTask,
    PoseTask,
    PositionTask,
    TaskError,
    cubic,
    forward_kinematics,
    frame_jacobian,
    rendezvous,
)
from robotics1.trajectories import FunctionMotion, MeetingStatus

POINT, SPACE = PositionTask("xy"), PositionTask("xyz")
SPEED = 1.5 * np.array([cos(radians(15)), sin(radians(15))])
TARGET = LinearMotion([-2, 1], SPEED)
T_RV = 2 / (1.5 * cos(radians(15)))


def on_the_y_axis(t, p):
    return p[0]


@pytest.fixture(scope="module")
def meeting(planar_2r):
    return rendezvous(planar_2r, POINT, TARGET, [0, 0], meet=on_the_y_axis)


# --- exercise 3 of the exam


def test_rendezvous_time_is_minus_p0x_over_v_cos_delta(meeting):
    assert meeting.time == pytest.approx(T_RV, abs=1e-12)
    assert meeting.time == pytest.approx(1.380, abs=5e-4)
    assert meeting.position == pytest.approx([0, 1 + 1.5 * T_RV * sin(radians(15))], abs=1e-12)
    assert meeting.position[1] == pytest.approx(1.5359, abs=5e-5)
    assert meeting.velocity == pytest.approx([1.4489, 0.3882], abs=5e-5)
    assert (meeting.status, meeting.miss) == (MeetingStatus.MEETS, 0)
    assert meeting.require() is meeting


EXAM = [  # q, q̇, coefficients of τ², τ³, of t², t³
    ([1.0294, 1.4250], [-0.7359, -0.6278], [4.1040, 5.1415], [-3.0746, -3.7165], [2.1539, 2.6984], [-1.1690, -1.4130]),
    ([2.1122, -1.4250], [-1.1508, 0.6278], [7.9251, -5.1415], [-5.8129, 3.7165], [4.1593, -2.6984], [-2.2101, 1.4130]),
]


@pytest.mark.parametrize("values", EXAM, ids=["right", "left"])
def test_rendezvous_branch_is_the_exams(meeting, values):
    q, qdot, tau2, tau3, t2, t3 = values
    branch = min(meeting.branches, key=lambda branch: abs(branch.q[1] - q[1]))
    digit = 1.0001e-4  # the exam rounds some entries and truncates others
    assert len(meeting.branches) == 2
    assert branch.q == pytest.approx(q, abs=digit)
    assert branch.qdot == pytest.approx(qdot, abs=digit)
    assert branch.trajectory.coefficients == pytest.approx(np.array([[0, 0], [0, 0], tau2, tau3]), abs=digit)
    assert branch.trajectory.coefficients_t[2:] == pytest.approx(np.array([t2, t3]), abs=digit)


def test_rendezvous_branches_are_the_closed_form_solutions_with_q_dot_j_inverse_v(meeting):
    solutions = cf.two_link_solutions(meeting.position, 1.2, 0.8)
    for q, branch in zip(solutions, sorted(meeting.branches, key=lambda b: -b.q[1]), strict=True):
        qdot = np.linalg.solve(cf.planar_jacobian(q, [1.2, 0.8]), SPEED)
        assert branch.q == pytest.approx(q, abs=1e-9)
        assert branch.qdot == pytest.approx(qdot, abs=1e-8)
        wanted = cf.cubic_coefficients(np.zeros(2), q, T_RV, np.zeros(2), qdot)
        assert branch.trajectory.coefficients == pytest.approx(wanted, abs=1e-8)
        assert not branch.singular
        assert branch.matches
        assert not branch.velocity_error.any()


def test_a_meeting_time_gives_the_same_as_the_event_at_that_time(planar_2r, meeting):
    timed = rendezvous(planar_2r, POINT, TARGET, [0, 0], meet=T_RV)
    for a, b in zip(timed.branches, meeting.branches, strict=True):
        assert a.trajectory.coefficients == pytest.approx(b.trajectory.coefficients, abs=1e-8)


# --- laws: at the end the tool is where the target is, and moves as it does


def assert_meets(robot, task, target, rv, q0, qdot0):
    assert rv.branches
    for branch in rv.branches:
        trajectory = branch.trajectory
        assert trajectory.duration == rv.time
        assert trajectory(0) == pytest.approx(q0, abs=1e-12)
        assert trajectory.velocity(0) == pytest.approx(qdot0, abs=1e-12)
        q, qdot = trajectory(rv.time), trajectory.velocity(rv.time)
        assert task.error(robot, q, target(rv.time)) == pytest.approx(np.zeros(task.rows), abs=1e-8)
        assert task.jacobian(robot, q) @ qdot == pytest.approx(target.velocity(rv.time), abs=1e-7)


@given(x=st.floats(-3, -0.5), y=st.floats(0.3, 0.9), speed=st.floats(0.3, 2), angle=st.floats(-0.2, 0.2))
@settings(max_examples=10)
def test_planar_2r_meets_any_line_that_crosses_the_y_axis_in_reach(x, y, speed, angle):
    target = LinearMotion([x, y + 0.6 + x * np.tan(angle)], speed * np.array([cos(angle), sin(angle)]))
    rv = rendezvous(arm("planar_2r"), POINT, target, [0.1, -0.2], meet=on_the_y_axis, qdot0=[0.3, 0])
    assert rv.time == pytest.approx(-x / (speed * cos(angle)), rel=1e-10)
    assert_meets(arm("planar_2r"), POINT, target, rv, [0.1, -0.2], [0.3, 0])


def test_spatial_arm_meets_with_the_shortest_joint_velocity(spatial):
    q = np.array([0.4, 0.3, -0.5, 0.7, 0.2])
    goal = forward_kinematics(spatial, q).translation
    v = np.array([0.1, -0.2, 0.15])
    target = LinearMotion(goal - 2 * v, v)
    rv = rendezvous(spatial, SPACE, target, np.zeros(5), meet=2.0)
    assert_meets(spatial, SPACE, target, rv, np.zeros(5), np.zeros(5))
    for branch in rv.branches:
        J = frame_jacobian(spatial, branch.q)[:3]
        assert branch.qdot == pytest.approx(J.T @ np.linalg.solve(J @ J.T, v), abs=1e-9)


def test_prr_meets_in_position_and_angle(prr):
    target = LinearMotion([-0.5, 0.6, 0.2], [0.3, 0.1, 0.25])
    rv = rendezvous(prr, PlanarPoseTask("xy"), target, [0, 0.1, 0.2], meet=1.5)
    assert len(rv.branches) == 2
    assert_meets(prr, PlanarPoseTask("xy"), target, rv, [0, 0.1, 0.2], [0, 0, 0])


def test_a_target_on_a_circle_is_met_at_its_first_passage(planar_2r):
    """p = 1.5 (cos ωt, sin ωt) has y = 0.75 first at ωt = π/6."""
    w = 0.8
    target = FunctionMotion(
        lambda t: 1.5 * np.array([cos(w * t), sin(w * t)]), lambda t: 1.5 * w * np.array([-sin(w * t), cos(w * t)])
    )
    rv = rendezvous(planar_2r, POINT, target, [0, 0], meet=lambda t, p: p[1] - 0.75)
    assert rv.time == pytest.approx(pi / 6 / w, abs=1e-12)
    assert_meets(planar_2r, POINT, target, rv, [0, 0], [0, 0])


def test_a_trajectory_is_a_target(planar_2r):
    target = cubic([-1, 1], [1, 1], 4)
    rv = rendezvous(planar_2r, POINT, target, [0.5, 0.5], meet=on_the_y_axis, horizon=4)
    assert rv.time == pytest.approx(2, abs=1e-12)
    assert rv.velocity == pytest.approx([0.75, 0], abs=1e-12)
    assert_meets(planar_2r, POINT, target, rv, [0.5, 0.5], [0, 0])


def test_an_event_at_time_zero_does_not_count(planar_2r):
    """x = sin πt is zero at 0 and then at 1."""
    target = FunctionMotion(lambda t: [sin(pi * t), 1.0], lambda t: [pi * cos(pi * t), 0.0])
    rv = rendezvous(planar_2r, POINT, target, [0, 0], meet=on_the_y_axis)
    assert rv.time == pytest.approx(1, abs=1e-9)


# --- verdicts


def test_out_of_reach_is_an_outcome_with_its_miss(planar_2r):
    rv = rendezvous(planar_2r, POINT, LinearMotion([3, 0], [0, 0.5]), [0, 0], meet=8.0)
    assert (rv.status, rv.branches) == (MeetingStatus.UNREACHABLE, ())
    assert rv.miss == pytest.approx(3, abs=1e-7)
    for insist in (lambda: rv.trajectory, rv.require):
        with pytest.raises(NotConverged, match="out of the robot's reach") as caught:
            insist()
        assert caught.value.result is rv


@pytest.mark.parametrize(
    ("v", "verdict", "lost"),
    [((0, 0.5), MeetingStatus.MEETS, (0, 0)), ((0.5, 0.5), MeetingStatus.VELOCITY_LOST, (0.5, 0))],
)
def test_at_the_stretched_arm_only_the_velocity_across_it_can_be_matched(planar_2r, v, verdict, lost):
    rv = rendezvous(planar_2r, POINT, LinearMotion(np.subtract([2, 0], np.multiply(4, v)), v), [0.3, 0.3], meet=4.0)
    assert rv.status is verdict
    (branch,) = rv.branches
    assert branch.singular
    assert branch.matches is (verdict is MeetingStatus.MEETS)
    assert branch.velocity_error == pytest.approx(lost, abs=1e-6)
    J = cf.planar_jacobian([0, 0], [1.2, 0.8])
    assert branch.qdot == pytest.approx(np.linalg.pinv(J) @ [0, 0.5], abs=1e-6)


def test_too_little_time_is_beyond_the_limits_and_says_which(planar_2r):
    rv = rendezvous(planar_2r, POINT, LinearMotion([0, 1.4], [0.0, 0.0]), [0, 0], meet=0.1)
    assert rv.status is MeetingStatus.BEYOND_LIMITS
    assert all(branch.violations and branch.matches and not branch.feasible for branch in rv.branches)
    with pytest.raises(NotConverged, match="the velocity of q1 is"):
        rv.require()


def test_feasible_branches_come_first(planar_2r):
    """In half a second the near way is slow enough, and the other one turns too far."""
    right, left = cf.two_link_solutions([1.2, 0.9], 1.2, 0.8)
    rv = rendezvous(planar_2r, POINT, LinearMotion([1.2, 0.9], [0, 0]), right + 0.1, meet=0.5)
    assert rv.status is MeetingStatus.MEETS
    assert rv.branches[0].q == pytest.approx(right, abs=1e-8)
    assert rv.branches[1].q == pytest.approx(left, abs=1e-8)
    assert [branch.feasible for branch in rv.branches] == [True, False]
    assert rv.trajectory is rv.branches[0].trajectory


# --- turns


@pytest.mark.parametrize("turns", [0, 1, -2])
def test_a_joint_without_limits_takes_the_turn_nearest_to_its_start(turns):
    robot = arm("continuous")
    q0 = np.array([0.2 + 2 * pi * turns, 0.1, 0.3])
    q = np.array([0.9 + 2 * pi * turns, 0.5, 1.0])
    target = LinearMotion(forward_kinematics(robot, q).translation, [0, 0, 0])
    rv = rendezvous(robot, SPACE, target, q0, meet=3.0)
    assert min(np.abs(branch.q - q).max() for branch in rv.branches) < 1e-7
    assert all(np.abs(branch.q - q0)[[0, 2]].max() <= pi + 1e-9 for branch in rv.branches)


def test_a_turn_beyond_the_limits_is_not_taken(planar_2r):
    """From q1 = 3 the solution q1 = −3 is nearest as 2π − 3, which is beyond π."""
    p = cf.planar_position([-3.0, 1.0], [1.2, 0.8])
    rv = rendezvous(planar_2r, POINT, LinearMotion(p, [0, 0]), [3.0, 1.0], meet=5.0)
    assert min(np.abs(branch.q - [-3.0, 1.0]).max() for branch in rv.branches) < 1e-8


# --- misuse


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"meet": 0.0}, "positive"),
        ({"meet": -1.0}, "positive"),
        ({"meet": nan}, "meeting time"),
        ({"meet": "noon"}, "meeting time"),
        ({"meet": lambda t, p: p[0] + 100}, "does not happen within 60 s"),
        ({"meet": lambda t, p: nan}, "event's value"),
        ({"meet": on_the_y_axis, "horizon": 1.0}, "does not happen within 1 s"),
        ({"meet": on_the_y_axis, "horizon": -1.0}, "horizon"),
        ({"meet": 1.0, "qdot0": [1, 2, 3]}, "qdot0"),
        ({"meet": 1.0, "q0": [0, 0, 0]}, "q must have shape"),
        ({"meet": 1.0, "target_motion": [1, 2]}, "target_motion"),
        ({"meet": 1.0, "target_motion": lambda t: [1, 1]}, "target_motion"),
        ({"meet": 1.0, "target_motion": LinearMotion([1, 1, 1], [0, 0, 0])}, "the target must have shape"),
        ({"meet": 1.0, "target_motion": FunctionMotion(lambda t: [1, 1], lambda t: [0, 0, 0])}, "velocity"),
    ],
)
def test_bad_arguments_are_input_errors(planar_2r, options, message):
    arguments = {"target_motion": TARGET, "q0": [0, 0]} | options
    with pytest.raises(InputError, match=message):
        rendezvous(planar_2r, POINT, **arguments)


@pytest.mark.parametrize(("p0", "v"), [([1, 2], [1]), ([1, nan], [0, 0]), ([1, 2], [inf, 0]), ("a", "b"), (1, 2)])
def test_a_line_needs_a_point_and_a_velocity_of_its_size(p0, v):
    with pytest.raises(InputError):
        LinearMotion(p0, v)


def test_a_function_motion_needs_two_functions():
    with pytest.raises(InputError):
        FunctionMotion(lambda t: [0, 0], [0, 0])


def test_a_task_that_does_not_fit_is_a_task_error(spatial):
    with pytest.raises(TaskError):
        rendezvous(spatial, PlanarPoseTask("xy"), LinearMotion([0, 0, 0], [0, 0, 0]), np.zeros(5), meet=1.0)


def test_a_pose_can_be_met_by_a_motion_that_gives_poses():
    robot = arm("six_r")
    q, qdot = np.array([0.3, 0.7, -1.1, 0.5, 0.8, -0.4]), np.array([0.1, -0.2, 0.3, 0.2, -0.1, 0.4])

    def joints(t):
        return q + (t - 2) * qdot

    target = FunctionMotion(
        lambda t: forward_kinematics(robot, joints(t)), lambda t: frame_jacobian(robot, joints(t)) @ qdot
    )
    rv = rendezvous(robot, PoseTask(), target, np.zeros(6), meet=2.0)
    assert len(rv.branches) == 8
    assert_meets(robot, PoseTask(), target, rv, np.zeros(6), np.zeros(6))
    nearest = min(rv.branches, key=lambda branch: np.abs(branch.q - q).max())
    assert nearest.qdot == pytest.approx(qdot, abs=1e-6)
