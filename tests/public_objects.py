"""Instances of every public class, each made by public calls."""

from functools import cache
from math import pi

import numpy as np
import pinocchio as pin
import sympy
from arms import arm

import robotics1 as r1

PLANE = r1.PositionTask("xy")
Q = np.array([0.4, 0.9])
TARGET = np.array([1.0, 0.8])


def squared_distance(p, R, q):
    return [p[0] ** 2 + p[1] ** 2]


def its_jacobian(p, R, q):
    return [[0.0, -2 * 1.2 * 0.8 * np.sin(q[1])]]


def to_the_right(p, R, q, d):
    return [p[0] - d]


def moved_position(t):
    return np.array([1.0 + 0.1 * t, 0.2])


def moved_velocity(t):
    return np.array([0.1, 0.0])


@cache
def robots():
    """A robot of every origin."""
    spherical = [("R", 0, pi / 2, 0.3, 0), ("R", 0.4, 0, 0, 0), ("R", 0, pi / 2, 0, pi / 2)]
    named = [("R", "l1", pi / 2, 0.2, 0), ("P", "-l2", 0, 0, pi / 2), ("R", 0.1, 0, 0, 0)]
    return {
        "urdf": arm("six_r"),
        "continuous": arm("continuous"),
        "xacro": r1.load_robot("prr", parameters={"l2": 0.7}),
        "locked": r1.load_robot("prr", locked={"q1": 0.2}),
        "table": r1.robot_from_dh(spherical, lower=[-1, None, -2], upper=[1, None, 2]),
        "table with names": r1.robot_from_dh(named, parameters={"l1": 0.4, "l2": 0.5}),
        "screws": r1.rigid_motions.robot_from_screws(
            np.eye(4), space=[([0, 0, 1], [0, -0.4, 0.1]), ([0, 0, 0], [1, 0, 0])]
        ),
        "planar": r1.textbook_robots.planar_arm("RPR", ["l1", 0.5], parameters={"l1": 0.4}, absolute=True),
        "transforms": r1.textbook_robots.robot_from_transforms(["Rz(q1)", "Tx(l1)", "Ty(-q2)", "Rx(0.5*q1)"]),
        "placed": r1.textbook_robots.place_robot(arm("six_r"), base_placement=np.eye(4), tool_placement=np.eye(4)),
        "point": r1.formulas(arm("planar_2r"), PLANE, point=["d", 0.1, 0]).robot,
        "two tips": arm("two_tips"),
    }


@cache
def singular_sets():
    """In exact form, of another arm, and by numbers."""
    return [
        r1.find_singularities(arm("prr"), r1.PlanarPoseTask()),
        r1.find_singularities(arm("planar_2r"), PLANE),
        r1.find_singularities(arm("planar_2r"), PLANE, method="numeric"),
    ]


@cache
def formulas():
    return [
        r1.formulas(arm("planar_2r"), PLANE, point=["d", 0.1, 0]),
        r1.formulas(arm("planar_2r"), r1.FunctionTask(squared_distance, 1)),
    ]


@cache
def scan():
    measures = ("sigma_min", "manipulability")
    return r1.scan_singularities(arm("planar_2r"), PLANE, samples=500, measures=measures, refine=8)


@cache
def manipulabilities():
    """At a regular and at a singular configuration."""
    return [r1.singularities.manipulability(arm("planar_2r"), PLANE, q) for q in (Q, [0.3, 0])]


@cache
def meeting():
    return r1.rendezvous(arm("planar_2r"), PLANE, r1.LinearMotion([-2, 1], [1.4, 0.4]), [0, 0], meet=1.4)


@cache
def followed():
    robot, q0 = arm("planar_2r"), [0.1, 1.2]
    start = r1.forward_kinematics(robot, q0).translation[:2]
    line = r1.line_path(start, start + np.array([-0.1, 0.1]))
    motion = r1.curves.PathTrajectory(line, r1.trapezoidal(0, line.end, 1.0, acceleration=1).laws[0])
    return [
        r1.follow_trajectory(robot, PLANE, motion, q0, gain=4.0),
        r1.trajectories.follow_trajectory_by_acceleration(robot, PLANE, motion, (q0, [0, 0]), gains=(16.0, 8.0)),
    ]


q0, q1, T = sympy.symbols("q0 q1 T", real=True)


def cubic():
    return r1.cubic([0, 1], [1, -1], 2.0, v0=[0.1, 0])


def laws():
    return [
        r1.trapezoidal(0, 1, 2.0, acceleration=3),
        r1.trajectories.cosine(0, 1, 2.0),
        r1.trajectories.cycloidal(0, 1, 2.0),
        r1.trajectories.bang_bang(0, 1, 2.0),
        r1.trajectories.double_s([0, 1], [1, 3], 2.0, jerk=40),
    ]


def rotations():
    return [
        r1.curves.turn_path(np.eye(3), [0, 0, 1], 1.0),
        r1.curves.euler_path("ZYZ", r1.line_path([0, 0.2, 0], [1, 1, 1])),
    ]


def paths():
    """A path of every kind."""
    return [
        r1.line_path([0, 0, 0], [1, 1, 0]),
        r1.curves.helix_path([0, 0, 0], [1, 0, 0], 0.2, 2),
        r1.curves.circle_path([0, 0], 1.0),
        r1.curves.ellipse_path([0, 0], [2, 0], [0, 1]),
        r1.curves.by_arc_length(r1.curves.ellipse_path([0, 0], [2, 0], [0, 1])),
        r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], blend=0.2),
        r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], blend=0.2, kind="parabolic"),
        r1.trajectories.spline_path([[0, 0], [1, -0.5], [2, 0.3]]),
        r1.curves.formula_path(["cos(s)", "a*s"], "s", 2.0, values={"a": 0.3}),
        *rotations(),
        r1.curves.frenet_path(r1.curves.helix_path([0, 0, 0], [1, 0, 0], 0.2, 2)),
        r1.curves.slerp_path(np.eye(3), pin.exp3(np.array([0.1, 0.2, 0.3]))),
        r1.curves.pose_line(pin.SE3.Identity(), pin.SE3(pin.exp3(np.array([0.1, 0.2, 0.3])), np.ones(3))),
        r1.curves.screw_path(pin.SE3.Identity(), pin.SE3(pin.exp3(np.array([0.1, 0.2, 0.3])), np.ones(3))),
    ]


@cache
def reach():
    """The workspace of a SCARA with limits."""
    rows = [("R", 0.4, 0, 0, 0), ("R", 0.3, 0, 0, 0), ("P", 0, 0, 0, 0)]
    return r1.workspaces.workspace(r1.robot_from_dh(rows, lower=[-2, -2, 0], upper=[2, 2, 0.2]), r1.PositionTask())


def wrist():
    """An arm with a spherical wrist and a tool."""
    rows = [("R", 0, np.pi / 2, 0.4, 0), ("R", 0.9, 0, 0.1, 0), ("R", 0, np.pi / 2, 0, 0)]
    turns = [("R", 0, -np.pi / 2, 0.7, 0), ("R", 0, np.pi / 2, 0, 0), ("R", 0, 0, 0.15, 0)]
    return r1.robot_from_dh(rows + turns)


@cache
def mapped():
    """A map of a few positions, and one of a redundant arm."""
    grid = {"x": [0.3, 0.9], "y": [-0.2, 0.1, 0.4]}
    return [
        r1.reachability_map(arm("planar_2r"), PLANE, grid),
        r1.reachability_map(arm("redundant"), r1.PositionTask(), [[0.3, 0.2, 0.1], [9, 9, 9]]),
    ]


@cache
def inverse():
    return r1.ik.ik_formulas(arm("planar_2r"), PLANE)


def its_sine(q):
    return float(np.sin(q[0]))


def by_priority():
    low = r1.PositionTask("y", frame="link2")
    return r1.redundancy.ik_by_priority(arm("planar_3r"), [(PLANE, [1.0, 0.5]), (low, [9.0])], [0.3, 0.5, 0.4])


def prioritised():
    levels = [(PLANE, [0.1, 0.2]), (r1.PositionTask("x"), [1.0])]
    return r1.redundancy.priority_velocity(arm("planar_3r"), levels, [0.3, 0.5, 0.4])


def saturated(method):
    q = [0.3, 0.5, 0.4]
    return r1.redundancy.saturated_velocity(arm("planar_3r"), PLANE, [0.5, 0.2], q, limits=0.3, method=method)


@cache
def control_laws():
    """A Cartesian law along the normal and the tangent of a line, and a joint law."""
    line = r1.line_path([0.8, 0.5], [0.6, 0.6])
    motion = r1.curves.PathTrajectory(line, r1.cubic(0, line.end, 1.0))
    return [
        r1.control.cartesian_law(arm("planar_2r"), PLANE, motion, [2.0, 5.0], axes="frenet"),
        r1.control.joint_law(arm("planar_2r"), cubic(), [2.0, 3.0]),
    ]


@cache
def swaying():
    return r1.ik.self_motion(arm("planar_3r"), PLANE, [0.5, 0.3], samples=5, starts=3)


LIMITS = r1.MotionLimits(1.0, 3.0, 20.0)


INSTANCES = {
    "CompletedRotations": lambda: [r1.orientation.complete_rotation([["a", 0.6, 0], [None] * 3, [None] * 3])],
    "EulerAccelerations": lambda: [r1.orientation.euler_accelerations("ZYZ", [0.1, 0.2, 0.3], [1, 0, 1], [1, 0, 0])],
    "RecognisedSequence": lambda: [r1.orientation.recognise_sequence(r1.orientation.euler_formulas("ZYZ").rotation)],
    "RotationRates": lambda: [r1.orientation.rotation_rates(np.eye(3), [1, 2, 3], [0, 0, 1])],
    "BasisMotion": lambda: [
        r1.trajectories.motion_in_basis(["1", "t", "t**2"], [(0, 0, 1), (2, 0, 3), (0, 1, 0)], 2),
        r1.trajectories.motion_in_basis(["1", "t"], [(0, 0, "q0"), ("T", 0, "q1")], "T"),
    ],
    "LaterMotion": lambda: [r1.curves.starting_at(cubic(), 3.0)],
    "RateExtreme": lambda: list(r1.trajectories.rate_extremes(r1.trajectories.polynomial_formula((q0, 0), (q1, 0), T))),
    "SpeedAlongPath": lambda: [
        r1.trajectories.speed_along_path(
            arm("planar_2r"), PLANE, r1.line_path([1.5, 0], [1.2, 0.5]), Q, velocity=1, samples=9
        )
    ],
    "TimeCase": lambda: list(r1.trajectories.time_formula("trapezoidal", velocity="V", acceleration="A").cases),
    "TimeFormula": lambda: [r1.trajectories.time_formula("trapezoidal", velocity="V", acceleration="A")],
    "AccelerationSplit": lambda: [r1.trajectories.acceleration_split(cubic(), 0.5)],
    "Alignment": lambda: [r1.orientation.align_direction([0, 0, 1], [1, 1, 0])],
    "AxisAngle": lambda: [
        r1.orientation.rotation_to_axis_angle(np.eye(3)),
        r1.orientation.rotation_to_axis_angle(pin.exp3(np.ones(3))),
    ],
    "BoundaryCurve": lambda: list(reach().boundary),
    "Curve": lambda: [
        *paths(),
        r1.curves.stretched(r1.trajectories.TaskTrajectory(arm("planar_2r"), PLANE, cubic()), 2.0),
        laws()[1].joint(),
    ],
    "CurveSequence": lambda: [
        r1.curves.polyline_path([[0, 0], [1, 0], [1, 1]], blend=0.2),
        r1.curves.CurveSequence((cubic(), r1.cubic([1, -1], [0, 0], 1.0))),
    ],
    "DHRow": lambda: [r1.dh.DHRow("R", 1.0, 0.0, "l", 0.0)],
    "DHTable": lambda: [r1.dh.urdf_to_dh(arm("six_r")), r1.dh.urdf_to_dh(arm("prr"), convention="modified")],
    "DexterousWorkspace": lambda: [
        r1.workspaces.dexterous_workspace(
            r1.robot_from_dh([("R", a, 0, 0, 0) for a in (1, 0.5, 0.25)]), r1.PositionTask("xy")
        )
    ],
    "DHParameters": lambda: [r1.textbook_robots.dh_row(np.eye(4)).standard],
    "DHRowOfMatrix": lambda: [r1.textbook_robots.dh_row(np.eye(4))],
    "Ellipsoid": lambda: [found.force_ellipsoid for found in manipulabilities()],
    "EulerFormulas": lambda: [r1.orientation.euler_formulas("ZYZ")],
    "EulerRates": lambda: [r1.orientation.euler_rates("ZYZ", [0.1, 0.2, 0.3], [1, 0, 0])],
    "EulerSequence": lambda: [r1.orientation.euler_formulas("ZYZ").sequence],
    "EulerSolutions": lambda: [r1.orientation.rotation_to_euler("ZYZ", pin.exp3(np.ones(3)))],
    "RobotReport": lambda: [r1.check_robot("prr")],
    "Extreme": lambda: [laws()[0].peak(1), r1.trajectories.peak_norm(cubic())],
    "FollowedTrajectory": followed,
    "ExtremeReach": lambda: [r1.workspaces.extreme_reach(arm("planar_2r"), r1.PositionTask("xy"))],
    "FittingCircle": lambda: [r1.workspaces.largest_circle(reach())],
    "FollowingStatus": lambda: list(r1.trajectories.FollowingStatus),
    "FormulaPath": lambda: [r1.curves.formula_path(["cos(s)", "a*s"], "s", 2.0, values={"a": 0.3})],
    "ConfigurationFormulas": lambda: [r1.formulas(arm("planar_2r"), PLANE).at(q1=0, q2=pi / 2)],
    "Formulas": formulas,
    "FrameAlignment": lambda: [r1.orientation.align_two_directions([1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1])],
    "FreeWrenches": lambda: [r1.singularities.wrenches_without_torque(arm("six_r"), [0, 0, 0, 0, 3.1416, 0])],
    "FrenetFormulas": lambda: [r1.curves.frenet_formulas(r1.curves.formula_path(["cos(s)", "sin(s)", "s"], "s", 2.0))],
    "FrenetFrame": lambda: [r1.curves.frenet_frame(r1.curves.circle_path([0, 0], 1.0), 0.3)],
    "FunctionMotion": lambda: [r1.trajectories.FunctionMotion(moved_position, moved_velocity)],
    "FunctionTask": lambda: [
        r1.FunctionTask(squared_distance, 1),
        r1.FunctionTask(squared_distance, 1, its_jacobian),
        r1.FunctionTask(to_the_right, 1, units=("m",), parameters={"d": 0.2}, point=(0.1, 0.0, 0.0)),
    ],
    "Aspects": lambda: [r1.ik.group_by_aspect(r1.ik_solutions(arm("planar_2r"), PLANE, TARGET))],
    "Cuspidality": lambda: [r1.ik.is_cuspidal(arm("planar_2r"), PLANE)],
    "CuspidalityStatus": lambda: list(r1.ik.CuspidalityStatus),
    "ControlCommand": lambda: [law.command(Q, t=0.3) for law in control_laws()],
    "ControlLaw": control_laws,
    "ControlRun": lambda: [r1.control.simulate_law(control_laws()[0], Q, samples=5)],
    "ErrorDecay": lambda: [control_laws()[0].decay(Q)],
    "Gains": lambda: [r1.control.gains_for_decay(0.1, 2.0), r1.control.gains_for_decay(0.1, 2.0, order=2)],
    "LyapunovRate": lambda: [r1.control.lyapunov_rate(arm("planar_2r"), PLANE, TARGET, Q)],
    "LyapunovStatus": lambda: list(r1.control.LyapunovStatus),
    "GainChoice": lambda: [r1.control.smallest_gain(cubic(), [0.1, 1], 1e-2)],
    "GainStatus": lambda: list(r1.control.GainStatus),
    "HarmonicCurve": lambda: [r1.curves.circle_path([0, 0], 1.0), *laws()[1:3], r1.curves.stretched(laws()[1], 2.0)],
    "IKBatch": lambda: [r1.IKSolver(arm("planar_2r"), PLANE).solve_batch([TARGET, [0.5, 0.5]])],
    "IKBranch": lambda: list(inverse().branches),
    "IKFormulas": lambda: [inverse()],
    "IKIterate": lambda: [r1.iterate_ik(arm("planar_2r"), PLANE, TARGET, Q).table[0]],
    "IKIteration": lambda: [r1.iterate_ik(arm("planar_2r"), PLANE, TARGET, Q)],
    "IKResult": lambda: [r1.solve_ik(arm("planar_2r"), PLANE, TARGET), r1.solve_ik(arm("planar_2r"), PLANE, [9, 9])],
    "IKSolutions": lambda: [r1.ik_solutions(arm("planar_2r"), PLANE, TARGET)],
    "IKSolutionsBatch": lambda: [
        r1.ik.SolutionSolver(arm("planar_2r"), r1.FunctionTask(squared_distance, 1), starts=3).solve_batch([[1], [2]])
    ],
    "IKSolver": lambda: [
        r1.IKSolver(arm("planar_2r"), PLANE, seed=3),
        r1.IKSolver(arm("six_r"), r1.PoseTask(), prefer="middle", tolerance=1e-8),
        r1.IKSolver(arm("planar_2r"), r1.FunctionTask(squared_distance, 1), time_limit=0.2),
    ],
    "SolutionSolver": lambda: [
        r1.ik.SolutionSolver(arm("planar_2r"), PLANE, starts=7),
        r1.ik.SolutionSolver(arm("planar_2r"), r1.FunctionTask(squared_distance, 1)),
    ],
    "IKStatus": lambda: list(r1.ik.IKStatus),
    "PostureChange": lambda: [r1.ik.posture_change(arm("planar_2r"), PLANE, Q, b) for b in ([1, 0.5], [1, -0.5])],
    "PostureChangeStatus": lambda: list(r1.ik.PostureChangeStatus),
    "SelfMotion": lambda: [swaying()],
    "SelfMotionCurve": lambda: list(swaying().curves),
    "SingularSetStatus": lambda: list(r1.singularities.SingularSetStatus),
    "Intersections": lambda: [r1.singularities.find_intersections(found) for found in singular_sets()],
    "Join": lambda: list(r1.curves.CurveSequence((cubic(), r1.cubic([1, -1], [0, 0], 1.0))).joins),
    "JointAcceleration": lambda: [r1.joint_acceleration(arm("planar_2r"), PLANE, [1, 0], Q, [0.1, 0.2])],
    "JointRanges": lambda: [
        r1.workspaces.joint_ranges(arm("planar_2r"), r1.PositionTask("xy"), [[1, 0.2], [0.9, 0.3]])
    ],
    "JointBoundPolytope": lambda: [
        r1.singularities.velocity_polytope(arm("planar_2r"), PLANE, [0.3, 0], velocity=1),
        r1.singularities.force_polytope(arm("planar_2r"), PLANE, Q, torque=[1, 2]),
    ],
    "JointMap": lambda: [r1.textbook_robots.joint_map(["q1", "q1 + q2"])],
    "JointTrajectory": lambda: [laws()[0], *laws()[3:]],
    "JointVelocity": lambda: [r1.joint_velocity(arm("planar_2r"), PLANE, [1, 0], Q)],
    "LargestForce": lambda: [r1.singularities.largest_force(arm("planar_2r"), PLANE, Q, [1, 0], torque=1)],
    "LimitUse": lambda: [
        *r1.minimum_time(0, 1, LIMITS, "double_s").active,
        *r1.trajectories.limit_violations(arm("planar_2r"), cubic(), r1.MotionLimits(0.1)),
    ],
    "Load": lambda: [r1.singularities.Load([1, 0, 0], frame="tool")],
    "LinearMotion": lambda: [r1.LinearMotion([-2, 1], [1.4, 0.4])],
    "Manipulability": manipulabilities,
    "MeasureDistribution": lambda: list(scan().distributions.values()),
    "MeetingBranch": lambda: list(meeting().branches),
    "MeetingStatus": lambda: list(r1.trajectories.MeetingStatus),
    "Membership": lambda: [r1.workspaces.is_reached(reach(), [0.5, 0.1, 0.1])],
    "MinimumTime": lambda: [r1.minimum_time([0, 0], [1, 2], LIMITS, "double_s")],
    "MotionLimits": lambda: [LIMITS, r1.MotionLimits([1, 2])],
    "NearestRotation": lambda: [r1.orientation.nearest_rotation(np.eye(3))],
    "NormLimits": lambda: [r1.trajectories.NormLimits(velocity=1.0, rows=slice(0, 2))],
    "OrientationTask": lambda: [r1.OrientationTask(), r1.OrientationTask("ZYZ", fixed=True)],
    "Passages": lambda: [r1.workspaces.crossings(reach(), [[-1, 0.1, 0.1], [1, 0.1, 0.1]])],
    "PathTiming": lambda: [
        r1.trajectories.time_optimal(r1.line_path([0, 0], [1, 1]), r1.MotionLimits(1.0, 3.0), grid=50)
    ],
    "PathTrajectory": lambda: [r1.curves.PathTrajectory(r1.curves.circle_path([0, 0], 1.0), laws()[0].laws[0])],
    "Payload": lambda: [r1.singularities.Payload(2.0, [0, 0, 0.1])],
    "PiecewisePolynomial": lambda: [
        cubic(),
        r1.quintic([0, 1], [1, -1], 2.0),
        r1.quintic(0, 1, 2.0).joint(),
        r1.cubic_spline([0, 1, 2.5], [[0, 0], [1, -1], [0, 2]]),
        r1.curves.parabolic_blends([[0, 0], [1, 0], [1, 1]], [1.0, 1.0], [0.2]),
    ],
    "PlanarPoseTask": lambda: [r1.PlanarPoseTask(), r1.PlanarPoseTask("xz")],
    "PointingTask": lambda: [r1.PointingTask(), r1.PointingTask((1, 1, 0))],
    "CylindricalTask": lambda: [r1.tasks.CylindricalTask(), r1.tasks.CylindricalTask("zx", frame="tool")],
    "PolarTask": lambda: [r1.tasks.PolarTask(), r1.tasks.PolarTask("yz", point=(0.1, 0.0, 0.2))],
    "PolynomialFormula": lambda: [r1.trajectories.polynomial_formula((q0, 0), (q1, 0), T)],
    "PosePath": lambda: [r1.curves.pose_line(pin.SE3.Identity(), pin.SE3(np.eye(3), np.ones(3)))],
    "PoseTask": lambda: [r1.PoseTask(), r1.PoseTask("XYZ", frame="tool")],
    "PositionTask": lambda: [
        r1.PositionTask(),
        r1.PositionTask("xz", frame="tool", reference="tool"),
        r1.PositionTask(point=[0.1, 0, 0]),
    ],
    "FunctionObjective": lambda: [r1.redundancy.FunctionObjective(arm("planar_2r"), its_sine)],
    "JointRangeObjective": lambda: [r1.redundancy.JointRangeObjective(arm("planar_2r"), [-1, -2], [1, 2])],
    "LevelOutcome": lambda: list(prioritised().levels),
    "LevelStatus": lambda: list(r1.redundancy.LevelStatus),
    "ManipulabilityObjective": lambda: [r1.redundancy.ManipulabilityObjective(arm("planar_3r"), PLANE)],
    "NearObjective": lambda: [r1.redundancy.NearObjective([0.1, 0.2])],
    "Objective": lambda: [r1.redundancy.NearObjective([0.1, 0.2], [1, 2])],
    "ObstacleObjective": lambda: [r1.redundancy.ObstacleObjective(arm("planar_3r"), [0.5, 0.5, 0])],
    "Priorities": lambda: [prioritised()],
    "PriorityIK": lambda: [by_priority()],
    "PriorityIKLevel": lambda: list(by_priority().levels),
    "PriorityIKStatus": lambda: list(r1.redundancy.PriorityIKStatus),
    "PriorityRun": lambda: [
        r1.redundancy.follow_by_priority(
            arm("planar_3r"),
            [
                (r1.PositionTask("x"), r1.curves.PathTrajectory(r1.line_path([1.2], [1.1]), r1.cubic(0, 0.1, 1.0))),
                (r1.PositionTask("y", frame="link2"), [0.3], 2.0),
            ],
            [0.3, 0.5, 0.4],
            samples=5,
        )
    ],
    "RedundancyFormulas": lambda: [
        r1.redundancy.redundancy_formulas(r1.textbook_robots.planar_arm("PPR", [0.5]), r1.PositionTask("x"))
    ],
    "ProjectedGradient": lambda: [
        r1.redundancy.projected_gradient(
            arm("planar_3r"), PLANE, [0.1, 0.2], [0.3, 0.5, 0.4], r1.redundancy.NearObjective([0, 0, 0])
        )
    ],
    "SaturatedMotion": lambda: [saturated("sns"), saturated("optimal")],
    "SaturatedPriorities": lambda: [
        r1.redundancy.saturated_priority_velocity(
            arm("planar_3r"), [(PLANE, [0.5, 0.2]), (r1.PositionTask("y", frame="link2"), [0.1])], [0.3, 0.5, 0.4]
        )
    ],
    "SaturationStatus": lambda: list(r1.redundancy.SaturationStatus),
    "SaturationStep": lambda: list(saturated("sns").steps),
    "RankStatus": lambda: list(r1.singularities.RankStatus),
    "RateStatus": lambda: list(r1.trajectories.RateStatus),
    "Placements": lambda: [r1.workspaces.best_placements(arm("planar_2r"), PLANE, [TARGET], {"x": [0.0, 0.3, 5.0]})],
    "PlaneSection": lambda: [
        r1.workspaces.plane_section(reach(), [0, 0, 0.1], [0, 0, 1]),
        r1.workspaces.plane_section(reach(), [0.5, 0, 0], [1, 0, 0]),
    ],
    "PoseStatus": lambda: list(r1.workspaces.PoseStatus),
    "ReachabilityMap": mapped,
    "RefinedGroup": lambda: list(scan().refined.groups),
    "Refinement": lambda: [scan().refined],
    "Rendezvous": lambda: [meeting()],
    "Resolution": lambda: [r1.trajectories.Resolution(), r1.trajectories.Resolution(weights=[1, 2], damping=0.1)],
    "Robot": lambda: list(robots().values()),
    "RoundedConfiguration": lambda: [
        r1.singularities.singularity_within_rounding(arm("planar_2r"), PLANE, q) for q in ([0.3, 3.1416], [0.3, 1.25])
    ],
    "Screw": lambda: [
        r1.rigid_motions.displacement_screw(pin.SE3(pin.exp3(np.array([0.1, 0.2, 0.3])), np.ones(3))),
        r1.rigid_motions.displacement_screw(pin.SE3(np.eye(3), np.ones(3))),
        r1.rigid_motions.displacement_screw(pin.SE3.Identity()),
    ],
    "SingularAngle": lambda: list(r1.orientation.euler_formulas("ZYZ").singular),
    "SingularBranch": lambda: [branch for found in singular_sets() for branch in found.branches],
    "MotionSamples": lambda: [cubic().sample(10)],
    "SingularSet": singular_sets,
    "SingularTarget": lambda: list(inverse().singular_if),
    "SingularityScan": lambda: [scan()],
    "StackedCurve": lambda: [r1.curves.stacked_path([r1.line_path([0], [1]), r1.line_path([1], [3])])],
    "StackedTask": lambda: [
        r1.StackedTask([r1.PositionTask("x"), r1.PositionTask("y")]),
        r1.StackedTask([r1.PositionTask("x"), r1.PositionTask("y")], weights=[1, 4]),
        r1.StackedTask([r1.PoseTask(), r1.PositionTask("z", frame="tool")]),
    ],
    "StaticTorques": lambda: [r1.singularities.static_torques(arm("six_r"), np.zeros(6), r1.singularities.Load())],
    "Subspaces": lambda: [r1.subspaces(PLANE.jacobian(arm("planar_2r"), q)) for q in (Q, [0.3, 0])],
    "TargetMotion": lambda: [r1.LinearMotion([-2, 1], [1.4, 0.4])],
    "Task": lambda: [r1.PositionTask()],
    "TaskTrajectory": lambda: [r1.trajectories.TaskTrajectory(arm("planar_2r"), PLANE, cubic())],
    "TimeScaling": lambda: [r1.trajectories.scale_to_limits(cubic(), LIMITS)],
    "TimingBounds": lambda: [r1.trajectories.timing_bounds(r1.curves.ellipse_path([0, 0], [2, 0], [0, 1]), 1.0, 2.0)],
    "Tracking": lambda: [r1.simulate_tracking(cubic(), [0.1, 1], 2.0)],
    "Transmission": lambda: [found.transmission([1, 2]) for found in manipulabilities()],
    "TrigSolutions": lambda: [r1.ik.solve_trig(1, 2, 0.5), r1.ik.solve_trig("a", "b", 0)],
    "UnitQuaternions": lambda: [r1.orientation.rotation_to_quaternion(pin.exp3(np.ones(3)))],
    "VelocityProfile": lambda: [
        laws()[0].laws[0],
        r1.trajectories.cruise_profile(1.0, 2.0, acceleration=3.0, jerk=10.0),
    ],
    "Workspace": lambda: [reach(), r1.workspaces.workspace(wrist(), r1.PositionTask())],
    "WristJacobian": lambda: [r1.singularities.wrist_jacobian(arm("six_r"))],
    "WorkspaceFormulas": lambda: [r1.workspaces.workspace_formulas(arm("planar_2r"), r1.PositionTask("xy"))],
    "WorkspaceRegion": lambda: list(reach().regions),
    "WristDexterity": lambda: [r1.workspaces.dexterous_workspace(wrist(), r1.PositionTask())],
}
