"""A motion of the wrong kind: it works, with the shapes of what was asked, or is refused; no error of NumPy's."""

from contextlib import suppress

import numpy as np
import pytest
from arms import arm

import robotics1 as r1

ROBOT, TASK, LIMITS = arm("planar_2r"), r1.PositionTask("xy"), r1.MotionLimits(1, 2)
LINE, LINE_IN_SPACE = r1.line_path([0, 0], [1, 0]), r1.line_path([1, 1, 0], [1.2, 1, 0])
LAW, TURN = r1.cubic(0, 1, 1.0).joint(), r1.curves.turn_path(np.eye(3), [0, 0, 1], 1.0)
MOTION = r1.curves.PathTrajectory(LINE, LAW)
JOINTS = r1.cubic([0, 1], [0.1, 1.2], 1.0)

ONE = {
    "polynomial": r1.cubic(0, 1, 1.0),
    "spline": r1.cubic_spline([0, 0.5, 1.0], [0.0, 0.5, 1.0]),
    "sine": r1.trajectories.cosine(0, 1, 1.0),
    "trapezoid": r1.trapezoidal(0, 1, 1.0, velocity=1.5),
    "least time": r1.minimum_time(0, 1, LIMITS).trajectory,
    "along a line": r1.curves.PathTrajectory(r1.line_path([0], [1.0]), LAW),
    "synchronized": r1.curves.stretched(r1.curves.PathTrajectory(r1.line_path([0], [1.0]), LAW), 2.0),
    "in a row": r1.curves.CurveSequence((r1.cubic(0, 0.5, 1.0, 0, 1), r1.cubic(0.5, 1, 1.0, 1, 0))),
}
THINGS = ONE | {
    "law": LAW,
    "law of sines": r1.trajectories.cosine(0, 1, 1.0).joint(),
    "two joints": JOINTS,
    "laws of two": r1.trajectories.cosine([0, 0], [1, 1], 1.0),
    "along a path": MOTION,
    "state": r1.minimum_time(0, 0, LIMITS).trajectory,
    "law of a state": r1.minimum_time(0, 0, LIMITS).laws[0],
    "answer": r1.minimum_time(0, 1, LIMITS),
    "path": LINE,
    "path in space": LINE_IN_SPACE,
    "turn": TURN,
    "pose path": r1.curves.PosePath(LINE_IN_SPACE, TURN),
    "pose motion": r1.curves.PathTrajectory(r1.curves.PosePath(LINE_IN_SPACE, TURN), r1.cubic(0, 0.2, 1.0).joint()),
    "turn motion": r1.curves.PathTrajectory(TURN, LAW),
    "target": r1.LinearMotion([1.0, 1.0], [0.1, 0]),
    "limits": LIMITS,
    "norms": r1.trajectories.NormLimits(1, 1),
    "robot": ROBOT,
    "task": TASK,
    "kind of task": r1.PoseTask,
    "formula": r1.trajectories.polynomial_formula((0,), (1,), 1),
    "class": r1.curves.JointTrajectory,
    "none": None,
    "number": 1.0,
    "text": "line",
    "array": np.zeros(2),
    "pose": r1.forward_kinematics(ROBOT, [0, 0]),
}
CALLS = {
    "JointTrajectory": lambda x: r1.curves.JointTrajectory((x,)),
    "JointTrajectory with": lambda x: r1.curves.JointTrajectory((LAW, x)),
    "PathTrajectory": lambda x: r1.curves.PathTrajectory(x, LAW),
    "PathTrajectory law": lambda x: r1.curves.PathTrajectory(LINE, x),
    "PathTrajectory of a turn": lambda x: r1.curves.PathTrajectory(TURN, x),
    "CurveSequence": lambda x: r1.curves.CurveSequence((x,)),
    "CurveSequence of": lambda x: r1.curves.CurveSequence((ONE["polynomial"], x)),
    "joins": lambda x: r1.curves.CurveSequence((x, x)).joins,
    "stretched": lambda x: r1.curves.stretched(x, 2.0),
    "scale_to_limits": lambda x: r1.trajectories.scale_to_limits(x, LIMITS),
    "scale_to_limits of norms": lambda x: r1.trajectories.scale_to_limits(x, r1.trajectories.NormLimits(1, 1)),
    "scale_to_limits, limits": lambda x: r1.trajectories.scale_to_limits(JOINTS, x),
    "peak_norm": r1.trajectories.peak_norm,
    "peak_norm, normal": lambda x: r1.trajectories.peak_norm(x, "normal acceleration"),
    "acceleration_split": lambda x: r1.trajectories.acceleration_split(x, 0.1),
    "timing_bounds": lambda x: r1.trajectories.timing_bounds(x, 1, 1),
    "time_optimal": lambda x: r1.trajectories.time_optimal(x, LIMITS, grid=10),
    "time_optimal, limits": lambda x: r1.trajectories.time_optimal(LINE, x, grid=10),
    "limit_violations": lambda x: r1.trajectories.limit_violations(ROBOT, x),
    "limit_violations, robot": lambda x: r1.trajectories.limit_violations(x, JOINTS),
    "limit_violations, limits": lambda x: r1.trajectories.limit_violations(ROBOT, JOINTS, x),
    "minimum_duration": lambda x: r1.trajectories.minimum_duration(x, LIMITS),
    "minimum_duration, motion": lambda x: r1.trajectories.minimum_duration(lambda T: x, LIMITS),
    "minimum_duration, limits": lambda x: r1.trajectories.minimum_duration(lambda T: r1.cubic(0, 1, T), x),
    "minimum_time": lambda x: r1.minimum_time(x, 1, LIMITS),
    "minimum_time, limits": lambda x: r1.minimum_time(0, 1, x),
    "simulate_tracking": lambda x: r1.simulate_tracking(x, [0, 0], 1.0, samples=3),
    "simulate_tracking of one": lambda x: r1.simulate_tracking(x, [0.0], 1.0, samples=3),
    "TaskTrajectory": lambda x: r1.trajectories.TaskTrajectory(ROBOT, TASK, x),
    "TaskTrajectory, robot": lambda x: r1.trajectories.TaskTrajectory(x, TASK, JOINTS),
    "TaskTrajectory, task": lambda x: r1.trajectories.TaskTrajectory(ROBOT, x, JOINTS),
    "follow_trajectory, robot": lambda x: r1.follow_trajectory(x, TASK, MOTION, [0, 1.0]),
    "follow_trajectory, task": lambda x: r1.follow_trajectory(ROBOT, x, MOTION, [0, 1.0]),
    "rendezvous, robot": lambda x: r1.rendezvous(x, TASK, THINGS["target"], [0, 1.0], 1.0),
    "rendezvous, task": lambda x: r1.rendezvous(ROBOT, x, THINGS["target"], [0, 1.0], 1.0),
    "jacobian_rate": lambda x: r1.trajectories.jacobian_rate(x, TASK, [0, 1], [0, 1]),
    "jacobian_rate, task": lambda x: r1.trajectories.jacobian_rate(ROBOT, x, [0, 1], [0, 1]),
    "joint_velocity": lambda x: r1.joint_velocity(x, TASK, [0, 1.0], [0, 1.0]),
    "joint_velocity, task": lambda x: r1.joint_velocity(ROBOT, x, [0, 1.0], [0, 1.0]),
    "joint_acceleration": lambda x: r1.joint_acceleration(x, TASK, [0, 0], [0, 1.0], [0, 1.0]),
    "joint_acceleration, task": lambda x: r1.joint_acceleration(ROBOT, x, [0, 0], [0, 1.0], [0, 1.0]),
    "by_arc_length": r1.curves.by_arc_length,
    "stacked_path": lambda x: r1.curves.stacked_path((x,)),
    "CurveSequence of paths": lambda x: r1.curves.CurveSequence((LINE, x)),
    "PosePath": lambda x: r1.curves.PosePath(x, TURN),
    "PosePath, turn": lambda x: r1.curves.PosePath(LINE_IN_SPACE, x),
    "euler_path": lambda x: r1.curves.euler_path("ZYX", x),
    "frenet_frame": lambda x: r1.curves.frenet_frame(x, 0.0),
    "frenet_path": r1.curves.frenet_path,
    "frenet_formulas": r1.curves.frenet_formulas,
    "pose_line": lambda x: r1.curves.pose_line(x, x),
    "PiecewisePolynomial": lambda x: r1.curves.PiecewisePolynomial(x, [0, 1]),
    "PiecewisePolynomial, x": lambda x: r1.curves.PiecewisePolynomial([[1.0]], x),
    "from_ppoly": r1.curves.PiecewisePolynomial.from_ppoly,
    "cubic": lambda x: r1.cubic(x, 1, 1.0),
    "cubic, duration": lambda x: r1.cubic(0, 1, x),
    "formula_path": lambda x: r1.curves.formula_path([x], "s", 1.0),
    "polynomial_formula": lambda x: r1.trajectories.polynomial_formula((x,), (1,), 1),
    "LinearMotion": lambda x: r1.LinearMotion(x, x),
    "FunctionMotion": lambda x: r1.trajectories.FunctionMotion(x, x),
    "knot_times": lambda x: r1.trajectories.knot_times(x, 1.0),
}


@pytest.mark.parametrize("call", CALLS)
def test_every_kind_of_argument_works_or_is_refused(call):
    for name, thing in THINGS.items():
        with suppress(r1.Robotics1Error):
            assert_consistent(CALLS[call](thing), f"{call} of {name}")


def assert_consistent(found, what):
    """The values of three times have the shape of the value at one, three times."""
    if not hasattr(found, "duration") or not callable(found):
        return
    times = [0.0, found.duration / 2, found.duration]
    for f in (found, found.velocity, found.acceleration):
        one = f(times[1])
        if not hasattr(one, "rotation"):
            assert np.shape(f(times)) == (3, *np.shape(one)), what
    if isinstance(found, r1.curves.JointTrajectory):
        assert found(times[1]).shape == (len(found.laws),), what


@pytest.mark.parametrize("name", ONE)
def test_a_motion_of_one_joint_is_a_timing_law(name):
    """p(s(t)) = s(t) along a line of length 1, and q(t) = (s(t), 2 s(t)) of two joints."""
    motion = ONE[name]
    t = np.linspace(0, motion.duration, 7)
    along, joints = r1.curves.PathTrajectory(LINE, motion), r1.curves.JointTrajectory((motion, motion))
    assert along(t)[:, 0] == pytest.approx(motion(t)[:, 0], abs=1e-12)
    assert along.velocity(t)[:, :1] == pytest.approx(motion.velocity(t), abs=1e-12)
    assert along.acceleration(t)[:, :1] == pytest.approx(motion.acceleration(t), abs=1e-12)
    assert joints(t) == pytest.approx(np.hstack([motion(t)] * 2), abs=1e-12)
    assert joints.extremes(1)[1] == pytest.approx(
        np.hstack([joints.velocity(t)]).max(axis=0) * [[0], [1]], rel=0.1, abs=0.2
    )
    assert joints(0.5).shape == (2,)


def test_a_law_of_several_joints_is_refused():
    with pytest.raises(r1.InputError, match="law must be a timing law"):
        r1.curves.PathTrajectory(LINE, JOINTS)
    with pytest.raises(r1.InputError, match="a law must be a timing law"):
        r1.curves.JointTrajectory((JOINTS,))


EMPTY = np.empty(0)
OF_NO_JOINTS = {
    "cubic": lambda: r1.cubic(EMPTY, EMPTY, 1.0),
    "quintic": lambda: r1.quintic(EMPTY, EMPTY, 1.0),
    "cosine": lambda: r1.trajectories.cosine(EMPTY, EMPTY, 1.0),
    "bang_bang": lambda: r1.trajectories.bang_bang(EMPTY, EMPTY, 1.0),
    "trapezoidal": lambda: r1.trapezoidal(EMPTY, EMPTY, 1.0, velocity=1),
    "double_s": lambda: r1.trajectories.double_s(EMPTY, EMPTY, 1.0, jerk=1),
    "minimum_time": lambda: r1.minimum_time(EMPTY, EMPTY, LIMITS),
    "polynomial_through": lambda: r1.trajectories.polynomial_through([(0, 0, EMPTY), (1, 0, EMPTY)]),
    "cubic_spline": lambda: r1.cubic_spline([0, 1, 2], np.empty((3, 0))),
    "polynomial_spline": lambda: r1.trajectories.polynomial_spline([0, 1, 2, 3], np.empty((4, 0)), (4, 3, 4)),
    "parabolic_blends": lambda: r1.curves.parabolic_blends(np.empty((3, 0)), 1, 0.1),
    "extremes": lambda: r1.cubic(EMPTY, EMPTY, 1.0).extremes(1),
    "breakpoints": lambda: r1.curves.PiecewisePolynomial(np.empty((4, 2, 0)), [0, 1, 2]).breakpoints,
    "scale_to_limits": lambda: r1.trajectories.scale_to_limits(r1.cubic(EMPTY, EMPTY, 1.0), LIMITS),
    "minimum_duration": lambda: r1.trajectories.minimum_duration(lambda T: r1.cubic(EMPTY, EMPTY, T), LIMITS),
    "simulate_tracking": lambda: r1.simulate_tracking(r1.cubic(EMPTY, EMPTY, 1.0), EMPTY, 1.0),
    "smallest_gain": lambda: r1.control.smallest_gain(r1.cubic(EMPTY, EMPTY, 1.0), EMPTY, 1e-3),
    "joins": lambda: r1.curves.CurveSequence((r1.cubic(EMPTY, EMPTY, 1.0),) * 2).joins,
    "line_path": lambda: r1.line_path(EMPTY, EMPTY),
    "spline_path": lambda: r1.trajectories.spline_path(np.empty((3, 0))),
    "peak_norm": lambda: r1.trajectories.peak_norm(r1.cubic(EMPTY, EMPTY, 1.0)),
    "acceleration_split": lambda: r1.trajectories.acceleration_split(r1.cubic(EMPTY, EMPTY, 1.0), 0.5),
    "LinearMotion": lambda: r1.LinearMotion(EMPTY, EMPTY)(1.0),
}


@pytest.mark.parametrize("name", OF_NO_JOINTS)
def test_motions_of_no_joints_are_answered_or_refused(name):
    with suppress(r1.Robotics1Error):
        found = OF_NO_JOINTS[name]()
        if isinstance(found, r1.curves.PiecewisePolynomial):
            assert found(0.5).shape == found.velocity(0.5).shape == (0,)
            assert found([0.0, 1.0]).shape == (2, 0)
