"""Following a task trajectory: integration of first and second order, corrections, null motion, singularities."""

import pickle
from math import cos, sin

import numpy as np
import pinocchio as pin
import pytest
from arms import arm, random_q

import robotics1 as r1
from robotics1 import InputError, NotConverged, TaskError
from robotics1.trajectories import FollowingStatus, Resolution

XY, XYZ = r1.PositionTask("xy"), r1.PositionTask("xyz")
START = [0.3, 1.2]


def two_r():
    return arm("planar_2r", l1=1.0, l2=1.0)


def timed(path, duration=2.0):
    return r1.curves.PathTrajectory(path, r1.cubic([0], [path.end], duration).joint(0))


def tool(robot, q):
    return r1.forward_kinematics(robot, q).translation


def line_from(robot, q, step, rows=2):
    p = tool(robot, q)[:rows]
    return timed(r1.line_path(p, p + np.array(step, float)))


def rate(f, t, h):
    return (8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h)


def pose_motion(robot, q):
    T0 = r1.forward_kinematics(robot, q)
    T1 = pin.SE3(pin.exp3(np.array([0.1, 0.3, -0.2])) @ T0.rotation, T0.translation + np.array([0.1, 0.1, -0.05]))
    return timed(r1.curves.pose_line(T0, T1))


@pytest.fixture(scope="module")
def followed():
    """A pose followed by a redundant arm."""
    robot = arm("redundant")
    q = random_q(robot, 1)
    motion = pose_motion(robot, q)
    return robot, motion, r1.follow_trajectory(robot, r1.PoseTask(), motion, q)


def test_a_line_is_followed_and_the_joints_are_those_of_the_inverse_kinematics():
    robot = two_r()
    motion = line_from(robot, START, [-0.6, 0.3])
    found = r1.follow_trajectory(robot, XY, motion, START)
    assert found.status is FollowingStatus.FOLLOWS
    assert found.duration == 2
    assert found.require() is found
    for t in (0.0, 0.7, 1.4, 2.0):
        sols = r1.ik_solutions(robot, XY, motion(t))
        nearest = min(np.abs(sols.q - found(t)).max(axis=1))
        assert nearest < 1e-7
        assert tool(robot, found(t))[:2] == pytest.approx(motion(t), abs=1e-8)
    assert found(np.array([0.0, 1.0])).shape == (2, 2)


def test_the_followed_motion_has_its_derivatives(followed):
    _, _, found = followed
    assert found.status is FollowingStatus.FOLLOWS
    for t in (0.4, 1.1, 1.7):
        assert found.velocity(t) == pytest.approx(rate(found, t, 2e-3), abs=1e-6)
        assert found.acceleration(t) == pytest.approx(rate(found.velocity, t, 2e-3), abs=1e-5)
        assert found.jerk(t) == pytest.approx(rate(found.acceleration, t, 2e-3), abs=1e-4)
    for t in (0.0, 2.0):
        assert found.velocity(t) == pytest.approx(np.zeros(7), abs=1e-9)


def test_first_order_satisfies_the_second_order_equation(followed):
    robot, motion, found = followed
    task = r1.PoseTask()
    for t in (0.5, 1.3):
        q, qdot, qddot = found(t), found.velocity(t), found.acceleration(t)
        left = task.jacobian(robot, q) @ qddot + r1.trajectories.jacobian_rate(robot, task, q, qdot) @ qdot
        assert left == pytest.approx(motion.acceleration(t), abs=1e-7)


@pytest.mark.parametrize("name", ["spatial", "redundant", "cylindrical", "anthropomorphic", "six_r"])
def test_arms_of_all_kinds_follow_a_line_in_space(name):
    robot = arm(name)
    q = random_q(robot, 12)
    found = r1.follow_trajectory(robot, XYZ, line_from(robot, q, [0.05, -0.04, 0.06], 3), q)
    assert found.status is FollowingStatus.FOLLOWS
    end = tool(robot, q) + np.array([0.05, -0.04, 0.06])
    assert tool(robot, found(2.0)) == pytest.approx(end, abs=1e-7)


def test_without_a_gain_an_error_at_the_start_stays_and_with_one_it_decays_exponentially():
    robot = two_r()
    motion = line_from(robot, START, [-0.3, 0.2])
    q0 = np.array(START) + np.array([0.02, -0.01])
    e0 = motion(0.0) - tool(robot, q0)[:2]
    open_loop = r1.follow_trajectory(robot, XY, motion, q0)
    assert open_loop.status is FollowingStatus.DEVIATES
    assert open_loop.final_error == pytest.approx(np.linalg.norm(e0), rel=1e-6)
    with pytest.raises(NotConverged, match="the end of the path is missed") as caught:
        open_loop.require()
    assert caught.value.result is open_loop
    closed = r1.follow_trajectory(robot, XY, motion, q0, gain=[3.0, 8.0])
    for t in (0.2, 0.9):
        e = motion(t) - tool(robot, closed(t))[:2]
        assert e == pytest.approx(e0 * np.exp([-3 * t, -8 * t]), rel=1e-5)
        assert closed.errors[closed.times == t] == pytest.approx(e[None], abs=1e-9)
    quick = r1.follow_trajectory(robot, XY, motion, q0, gain=20)
    assert quick.status is FollowingStatus.RETURNS
    assert quick.largest_error.value == pytest.approx(np.linalg.norm(e0))
    assert quick.largest_error.time == 0


def test_second_order_gives_the_error_the_dynamics_of_its_gains():
    robot = two_r()
    motion = line_from(robot, START, [-0.3, 0.2])
    q0 = np.array(START) + np.array([0.02, -0.01])
    e0 = motion(0.0) - tool(robot, q0)[:2]
    found = r1.trajectories.follow_trajectory_by_acceleration(robot, XY, motion, (q0, [0, 0]), gains=(16.0, 8.0))
    for t in (0.3, 1.0):  # critically damped, from rest: e = e0 (1 + 4t) exp(−4t)
        e = motion(t) - tool(robot, found(t))[:2]
        assert e == pytest.approx(e0 * (1 + 4 * t) * np.exp(-4 * t), rel=1e-5)
    exact = r1.trajectories.follow_trajectory_by_acceleration(robot, XY, motion, (START, [0, 0]))
    first = r1.follow_trajectory(robot, XY, motion, START)
    t = np.array([0.4, 1.2, 2.0])
    assert exact.status is FollowingStatus.FOLLOWS
    assert exact(t) == pytest.approx(first(t), abs=1e-7)
    assert exact.velocity(t) == pytest.approx(first.velocity(t), abs=1e-7)
    assert exact.acceleration(t) == pytest.approx(first.acceleration(t), abs=1e-6)


def test_null_motion_goes_on_while_the_task_is_followed():
    robot = arm("redundant")
    q = random_q(robot, 1)
    motion, middle = pose_motion(robot, q), (robot.lower + robot.upper) / 2
    middle = np.where(np.isfinite(middle), middle, 0.0)
    plain = r1.follow_trajectory(robot, r1.PoseTask(), motion, q)
    centred = r1.follow_trajectory(robot, r1.PoseTask(), motion, q, null_velocity=lambda x: 2 * (middle - x))
    assert centred.status is FollowingStatus.FOLLOWS
    copied = pickle.loads(pickle.dumps(centred))  # what was wished is a function, and no part of the result
    assert copied(1.3) == pytest.approx(centred(1.3), abs=0)
    assert np.linalg.norm(centred(2.0) - middle) < np.linalg.norm(plain(2.0) - middle) - 0.01
    damped = r1.trajectories.follow_trajectory_by_acceleration(
        robot, r1.PoseTask(), motion, (q, np.zeros(7)), null_acceleration=lambda x, v: -3 * v
    )
    assert damped.status is FollowingStatus.FOLLOWS


def test_switching_times_are_kept_and_the_acceleration_is_told_from_both_sides():
    robot = two_r()
    p = tool(robot, START)[:2]
    path = r1.curves.polyline_path([p, p + np.array([-0.3, 0]), p + np.array([-0.3, 0.3])], blend=0.1)
    motion = timed(path)
    found = r1.follow_trajectory(robot, XY, motion, START)
    assert found.breakpoints == pytest.approx(motion.breakpoints)
    t = float(found.breakpoints[0])
    q, qdot = found(t), found.velocity(t)
    drift = r1.trajectories.jacobian_rate(robot, XY, q, qdot) @ qdot
    for side in ("left", "right"):
        left = XY.jacobian(robot, q) @ found.acceleration(t, side=side) + drift
        assert left == pytest.approx(motion.acceleration(t, side=side), abs=1e-6)
    assert np.abs(found.acceleration(t) - found.acceleration(t, side="left")).max() > 0.1


# --- singularities


def test_a_path_out_of_reach_stops_where_the_joints_run_away():
    robot = two_r()
    motion = line_from(robot, [0.3, 0.5], [0.6, 0.3])
    found = r1.follow_trajectory(robot, XY, motion, [0.3, 0.5])
    assert found.status is FollowingStatus.STOPPED
    assert found.duration < 2
    assert np.linalg.norm(motion(found.duration)) == pytest.approx(2, abs=1e-4)  # where the arm is stretched
    assert "stopped there" in found.explain()
    assert found.least_singular_value.value < 1e-3
    with pytest.raises(NotConverged):
        found.require()
    with pytest.raises(InputError, match=r"the parameter must be in \[0, 0\."):
        found(1.9)


def test_damping_goes_on_beyond_it_with_an_error_that_is_told():
    robot = two_r()
    motion = line_from(robot, [0.3, 0.5], [0.6, 0.3])
    found = r1.follow_trajectory(robot, XY, motion, [0.3, 0.5], gain=5, resolution=Resolution(damping=0.1, region=0.3))
    assert found.status is FollowingStatus.DEVIATES
    assert found.duration == 2
    beyond = np.linalg.norm(motion(2.0)) - 2
    assert found.final_error == pytest.approx(beyond, rel=0.05)
    assert np.abs(found.velocity(np.linspace(0, 2, 101))).max() < 10
    assert found.largest_residual.value > 0.1


def test_a_motion_through_a_singularity_that_it_does_not_feel_is_followed():
    """Stretched, the arm goes on along the circle that its tool is on: ṙ stays in the range of J."""
    robot = two_r()
    motion = timed(r1.curves.arc_path([0, 0], [2, 0], 1.0))
    found = r1.follow_trajectory(robot, XY, motion, [0.0, 0.0])
    assert found.status is FollowingStatus.FOLLOWS
    assert found.least_singular_value.value == pytest.approx(0, abs=1e-12)
    assert found(2.0)[1] == pytest.approx(0, abs=2e-3)  # 2 − |p| is q2²/4: an error of 1e-6 of p
    assert found(2.0) @ [1, 0.5] == pytest.approx(1, abs=1e-6)


def test_an_unrealisable_velocity_at_the_start_does_not_move_the_arm():
    found = r1.follow_trajectory(two_r(), XY, timed(r1.line_path([2, 0], [1, 0])), [0.0, 0.0])
    assert found.status is FollowingStatus.DEVIATES
    assert found(2.0) == pytest.approx([0, 0])
    assert found.largest_residual.value == pytest.approx(0.75, rel=1e-3)
    assert found.final_error == pytest.approx(1)


def test_joint_velocities_that_run_away_at_once_give_no_motion():
    robot = two_r()
    motion = r1.curves.PathTrajectory(r1.line_path([2, 0], [-8, 0]), r1.cubic([0], [10], 1.0, v0=10, v1=10).joint(0))
    found = r1.follow_trajectory(robot, XY, motion, [0.0, 1e-3])
    assert found.status is FollowingStatus.STOPPED
    assert found.duration == 0
    assert found(0.0) == pytest.approx([0, 1e-3])


def test_a_gain_that_needs_too_many_steps_stops_the_integration(monkeypatch):
    monkeypatch.setattr("robotics1.trajectories.following.path_following.STEPS", 30)
    found = r1.follow_trajectory(two_r(), XY, line_from(two_r(), START, [-0.3, 0.2]), START, gain=1e6)
    assert found.status is FollowingStatus.STOPPED
    assert 0 < found.duration < 2


# --- inputs


def test_coupled_joints_follow_with_their_inputs():
    robot = two_r()
    motion = line_from(robot, START, [-0.6, 0.3])
    coupled = Resolution(input_matrix=[[1, 0], [-1, 1]])
    found = r1.follow_trajectory(robot, XY, motion, START, resolution=coupled)
    plain = r1.follow_trajectory(robot, XY, motion, START)
    assert found(2.0) == pytest.approx(plain(2.0), abs=1e-8)
    varying = Resolution(input_matrix=lambda q: [[1 + 0.5 * sin(q[1]), 0], [0.2 * cos(q[0]), 1]])
    other = r1.trajectories.follow_trajectory_by_acceleration(robot, XY, motion, (START, [0, 0]), resolution=varying)
    assert other(2.0) == pytest.approx(plain(2.0), abs=1e-7)
    assert other.acceleration(1.0) == pytest.approx(plain.acceleration(1.0), abs=1e-6)


def test_a_followed_motion_is_plotted_and_animated_like_any_other(tmp_path):
    robot = two_r()
    found = r1.follow_trajectory(robot, XY, line_from(robot, START, [-0.6, 0.3]), START)
    r1.plot_trajectory(found, file=tmp_path / "a.svg", robot=robot)
    assert (tmp_path / "a.svg").is_file()
    assert r1.animate(robot, found, tmp_path / "c.html").file.is_file()


# --- misuse

MOTION = timed(r1.line_path([1.0, 1.0], [0.5, 1.0]))
CALLS = [
    (lambda r: r1.follow_trajectory(r, XYZ, MOTION, START), InputError, "one number for each of x, y, z"),
    (lambda r: r1.follow_trajectory(r, XY, MOTION, [0.1]), InputError, "q must have shape"),
    (lambda r: r1.follow_trajectory(r, XY, MOTION, START, gain=-1), InputError, "gain must not be negative"),
    (lambda r: r1.follow_trajectory(r, XY, MOTION, START, gain=[1, 2, 3]), InputError, "gain must have shape"),
    (lambda r: r1.follow_trajectory(r, XY, MOTION, START, null_velocity=[1, 2, 3]), InputError, "null_velocity must"),
    (lambda r: r1.follow_trajectory(r, XY, r1.LinearMotion([1, 1], [0, 1]), START), InputError, "with a duration"),
    (lambda r: r1.follow_trajectory(r, r1.PositionTask("xy", reference="tool"), MOTION, START), TaskError, "move with"),
    (
        lambda r: r1.trajectories.follow_trajectory_by_acceleration(r, XY, MOTION, START),
        InputError,
        "q must have shape",
    ),
    (
        lambda r: r1.trajectories.follow_trajectory_by_acceleration(r, XY, MOTION, 3.0),
        InputError,
        "state must be two values",
    ),
    (
        lambda r: r1.trajectories.follow_trajectory_by_acceleration(r, XY, MOTION, (START, [0])),
        InputError,
        r"state\[1\] must have",
    ),
    (
        lambda r: r1.trajectories.follow_trajectory_by_acceleration(r, XY, MOTION, (START, [0, 0]), gains=(1, -1)),
        InputError,
        "gains must not be negative",
    ),
]


@pytest.mark.parametrize(("call", "kind", "message"), CALLS, ids=range(len(CALLS)))
def test_misuse_of_following_is_a_typed_error(call, kind, message):
    with pytest.raises(kind, match=message):
        call(two_r())
