"""Whatever is handed to the functions of paths and differential kinematics: an answer or a Robotics1Error."""

import warnings
from contextlib import suppress

import numpy as np
import pytest
from arms import arm
from hypothesis import HealthCheck, given, settings, strategies as st
from test_misuse import JUNK

import robotics1 as r1

LINE, CURVE = r1.line_path([0, 0, 0], [1, 2, 2]), r1.trajectories.spline_path([[0, 0], [1, 2], [3, 1]])
LAW = r1.cubic(0, 3, 1.0).joint()
MOTION = r1.curves.PathTrajectory(LINE, LAW)
ROBOT, XY = arm("planar_2r"), r1.PositionTask("xy")
FLAT = r1.curves.PathTrajectory(r1.line_path([1.0, 1.0], [0.5, 1.0]), r1.cubic(0, 0.5, 1.0).joint())
TURN = r1.curves.turn_path(np.eye(3), [0, 0, 1], 1.0)

CALLS = {
    "line_path": r1.line_path,
    "line_path from": lambda a, b: r1.line_path([0, 0], b),
    "arc_path": lambda a, b: r1.curves.arc_path([0, 0, 0], a, b),
    "arc_path normal": lambda a, b: r1.curves.arc_path([0, 0, 0], [1, 0, 0], a, normal=b),
    "arc_path centre": lambda a, b: r1.curves.arc_path(a, b, 1.0),
    "arc_through": lambda a, b: r1.curves.arc_through([0, 0], a, b),
    "circle_path": r1.curves.circle_path,
    "circle_path normal": lambda a, b: r1.curves.circle_path([0, 0, 0], a, normal=b),
    "ellipse_path": lambda a, b: r1.curves.ellipse_path([0, 0], a, b),
    "ellipse_path angle": lambda a, b: r1.curves.ellipse_path(a, [1, 0], [0, 1], angle=b),
    "helix_path": lambda a, b: r1.curves.helix_path([0, 0, 0], [1, 0, 0], a, b),
    "helix_path normal": lambda a, b: r1.curves.helix_path(a, [1, 0, 0], 1, 1, normal=b),
    "polyline_path": lambda a, b: r1.curves.polyline_path(a, blend=b),
    "polyline_path blend": lambda a, b: r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], blend=a, kind=b),
    "polyline_path radius": lambda a, b: r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], radius=a, kind="circular"),
    "spline_path": lambda a, b: r1.trajectories.spline_path(a, knots=b),
    "spline_path ends": lambda a, b: r1.trajectories.spline_path([[0, 0], [1, 0], [1, 1]], bc_type=a, v0=b),
    "formula_path": lambda a, b: r1.curves.formula_path(a, b, 1.0),
    "formula_path text": lambda a, b: r1.curves.formula_path([a, "s"], "s", b),
    "formula_path values": lambda a, b: r1.curves.formula_path(["R*s"], a, 1.0, values=b),
    "frenet_formulas": lambda a, b: r1.curves.frenet_formulas(a),
    "frenet_frame": r1.curves.frenet_frame,
    "frenet_frame s": lambda a, b: r1.curves.frenet_frame(CURVE, a, side=b),
    "CurveSequence of points": lambda a, b: r1.curves.CurveSequence(a),
    "CurveSequence after a line": lambda a, b: r1.curves.CurveSequence((LINE, a)),
    "stacked_path": r1.curves.stacked_path,
    "stacked_path last": lambda a, b: r1.curves.stacked_path((LINE,), a),
    "by_arc_length": lambda a, b: r1.curves.by_arc_length(a),
    "path(s)": lambda a, b: CURVE(a, side=b),
    "path.derivative": CURVE.derivative,
    "path.curvature": lambda a, b: CURVE.curvature(a),
    "slerp_path": r1.curves.slerp_path,
    "turn_path": lambda a, b: r1.curves.turn_path(np.eye(3), a, b),
    "euler_path": r1.curves.euler_path,
    "euler_path angles": lambda a, b: r1.curves.euler_path("ZYX", a, fixed=b),
    "frenet_path": lambda a, b: r1.curves.frenet_path(a),
    "PosePath": r1.curves.PosePath,
    "PosePath position": lambda a, b: r1.curves.PosePath(a, TURN),
    "pose_line": r1.curves.pose_line,
    "pose_line to": lambda a, b: r1.curves.pose_line(np.eye(4), a),
    "PathTrajectory": r1.curves.PathTrajectory,
    "PathTrajectory law": lambda a, b: r1.curves.PathTrajectory(LINE, a),
    "motion(t)": lambda a, b: MOTION(a, side=b),
    "motion.velocity": lambda a, b: MOTION.velocity(a, side=b),
    "motion.jerk": lambda a, b: MOTION.jerk(a),
    "acceleration_split": r1.trajectories.acceleration_split,
    "acceleration_split t": lambda a, b: r1.trajectories.acceleration_split(MOTION, a, side=b),
    "peak_norm": r1.trajectories.peak_norm,
    "peak_norm quantity": lambda a, b: r1.trajectories.peak_norm(MOTION, a, rows=b),
    "peak_norm rows": lambda a, b: r1.trajectories.peak_norm(MOTION, rows=a),
    "timing_bounds": lambda a, b: r1.trajectories.timing_bounds(CURVE, a, b),
    "timing_bounds path": lambda a, b: r1.trajectories.timing_bounds(a, 1.0, 1.0),
    "CurveSequence": lambda a, b: r1.curves.CurveSequence(a),
    "CurveSequence of": lambda a, b: r1.curves.CurveSequence((MOTION, a)),
    "parabolic_blends": lambda a, b: r1.curves.parabolic_blends(a, b, 0.1),
    "parabolic_blends speeds": lambda a, b: r1.curves.parabolic_blends([[0, 0], [1, 0], [1, 1]], a, b),
    "frame_jacobian_rate": lambda a, b: r1.frame_jacobian_rate(ROBOT, a, b),
    "frame_jacobian_rate frame": lambda a, b: r1.frame_jacobian_rate(ROBOT, [0, 0], [1, 1], frame=a, reference=b),
    "jacobian_rate": lambda a, b: r1.trajectories.jacobian_rate(ROBOT, XY, a, b),
    "TaskTrajectory": lambda a, b: r1.trajectories.TaskTrajectory(ROBOT, XY, a),
    "joint_velocity": lambda a, b: r1.joint_velocity(ROBOT, XY, b, a),
    "joint_velocity null": lambda a, b: r1.joint_velocity(ROBOT, XY, [1, 0], [0, 1], null_velocity=a, resolution=b),
    "joint_acceleration": lambda a, b: r1.joint_acceleration(ROBOT, XY, b, [0, 1], a),
    "Resolution": lambda a, b: r1.joint_velocity(
        ROBOT, XY, [1, 0], [0, 1], resolution=r1.trajectories.Resolution(weights=a, damping=b)
    ),
    "Resolution region": lambda a, b: r1.trajectories.Resolution(damping=a, region=b),
    "Resolution input": lambda a, b: r1.joint_velocity(
        ROBOT, XY, [1, 0], [0, 1], resolution=r1.trajectories.Resolution(input_matrix=a)
    ),
    "follow_trajectory": lambda a, b: r1.follow_trajectory(ROBOT, XY, a, b),
    "follow_trajectory gain": lambda a, b: r1.follow_trajectory(ROBOT, XY, FLAT, b, resolution=a),
    "follow_trajectory null": lambda a, b: r1.follow_trajectory(ROBOT, XY, FLAT, [0, 1.5, 0], null_velocity=a),
    "follow_by_acceleration": lambda a, b: r1.trajectories.follow_trajectory_by_acceleration(
        ROBOT, XY, FLAT, a, gains=b
    ),
}


@pytest.mark.parametrize("name", CALLS)
@settings(max_examples=60, deadline=None, derandomize=True, database=None, suppress_health_check=list(HealthCheck))
@given(a=JUNK, b=JUNK)
def test_junk_is_answered_or_refused_by_a_typed_error(name, a, b):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with suppress(r1.Robotics1Error):
            CALLS[name](a, b)


@given(st.sampled_from(["a.svg", "b.svg"]), JUNK)
@settings(max_examples=40, deadline=None, derandomize=True, database=None, suppress_health_check=list(HealthCheck))
def test_junk_is_drawn_or_refused_by_a_typed_error(tmp_path_factory, name, junk):
    folder = tmp_path_factory.mktemp("plots")
    drawings = [
        lambda: r1.plot_path(junk, junk, file=folder / name),
        lambda: r1.plot_trajectory(junk, file=folder / name),
        lambda: r1.plot_timing_law(junk, file=folder / name),
        lambda: r1.plot_path(CURVE, junk, file=folder / name, frames=junk),
        lambda: r1.plot_path(CURVE, file=folder / name, robot=junk),
        lambda: r1.plots.plot_ellipses(ROBOT, XY, junk, file=folder / name),
        lambda: r1.plots.plot_ellipses(ROBOT, XY, MOTION, kinds=junk, count=3),
        lambda: r1.plot_trajectory(MOTION, file=folder / name, names=junk, units="m"),
    ]
    for drawing in drawings:
        with suppress(r1.Robotics1Error):
            drawing()
