"""The public names and where they are; `__init__.py` reads this file, and so do type checkers."""

from .control import (
    GainChoice,
    GainStatus,
    Tracking,
    simulate_tracking,
    smallest_gain,
)
from .dh.from_robot import urdf_to_dh
from .dh.table import DHRow, DHTable
from .dh.to_robot import robot_from_dh
from .dh.to_urdf import dh_to_urdf
from .errors import (
    FormulaError,
    InputError,
    MissingExtraError,
    NotConverged,
    RobotFileError,
    Robotics1Error,
    RobotWarning,
    TaskError,
    UnknownNameError,
)
from .ik.iterate import IKIterate, IKIteration, iterate_ik
from .ik.result import IKBatch, IKResult, IKStatus
from .ik.solutions import IKSolutions, ik_solutions
from .ik.solver import IKSolver, solve_ik
from .kinematics import (
    forward_kinematics,
    frame_jacobian,
    frame_jacobian_rate,
)
from .least_squares import RANK_TOLERANCE
from .orientation.axis_angle import (
    AxisAngle,
    axis_angle_to_rotation,
    rotation_to_axis_angle,
)
from .orientation.elementary import skew, vee
from .orientation.euler import (
    EulerSolutions,
    euler_to_rotation,
    rotation_to_euler,
)
from .orientation.nearest import NearestRotation, nearest_rotation
from .orientation.pointing import (
    Alignment,
    FrameAlignment,
    align_direction,
    align_two_directions,
)
from .orientation.quaternion import (
    UnitQuaternions,
    quaternion_rate_map,
    quaternion_to_rotation,
    rotation_to_quaternion,
)
from .orientation.rates import EulerRates, angular_velocity, euler_rate_map, euler_rates
from .orientation.sequence import EulerSequence
from .orientation.sequence_formulas import (
    EulerFormulas,
    SingularAngle,
    euler_formulas,
)
from .paths.arc_length import StackedPath, by_arc_length
from .paths.arcs import arc_path, arc_through, circle_path
from .paths.euler_rotation import euler_path
from .paths.frenet import FrenetFrame, frenet_frame
from .paths.frenet_rotation import frenet_path
from .paths.harmonic import ellipse_path, helix_path, line_path
from .paths.path import Path
from .paths.path_sequence import PathSequence
from .paths.polyline import polyline_path
from .paths.polynomial_path import spline_path
from .paths.pose_path import PosePath, pose_line
from .paths.rotations import axis_angle_path, turn_path
from .paths.symbolic_path import (
    FormulaPath,
    FrenetFormulas,
    formula_path,
    frenet_formulas,
)
from .robot.loading import check_robot, load_robot
from .robot.model import Robot
from .robot.report import RobotReport
from .singularities.find import find_singularities
from .singularities.intersections import find_intersections
from .singularities.other_lengths import parameter_conditions
from .singularities.reduction import MeasureDistribution
from .singularities.result import Intersections, SingularBranch, SingularSet
from .singularities.rounding import (
    RoundedConfiguration,
    singularity_within_rounding,
)
from .singularities.scan import scan_singularities
from .singularities.scan_result import RefinedGroup, Refinement, SingularityScan
from .singularities.spaces import (
    RankStatus,
    Subspaces,
    subspaces,
)
from .singularities.statics import balancing_torque, exerting_torque
from .symbolic.tasks.formula import formulas
from .symbolic.tasks.task_formulas import Formulas
from .tasks.function import FunctionTask
from .tasks.planar_pose import PlanarPoseTask
from .tasks.pointing import PointingTask
from .tasks.pose import OrientationTask, PoseTask
from .tasks.position import PositionTask
from .tasks.task import Task
from .trajectories.composition.joint_laws import JointLaws
from .trajectories.composition.path_trajectory import PathTrajectory
from .trajectories.composition.stretching import stretched
from .trajectories.composition.trajectory_sequence import Join, TrajectorySequence
from .trajectories.following.followed_trajectory import (
    FollowedTrajectory,
    FollowingStatus,
)
from .trajectories.following.joint_rates import (
    JointAcceleration,
    JointVelocity,
    RateStatus,
    joint_acceleration,
    joint_velocity,
)
from .trajectories.following.path_following import (
    follow_trajectory,
    follow_trajectory_by_acceleration,
)
from .trajectories.following.resolution import Resolution
from .trajectories.following.task_rates import TaskTrajectory, jacobian_rate
from .trajectories.laws.given_duration import (
    bang_bang,
    cruise_profile,
    double_s,
    trapezoidal,
)
from .trajectories.laws.profiles import ProfileLaw
from .trajectories.laws.trigonometric import cosine, cycloidal
from .trajectories.limits.bounds_along_path import TimingBounds, timing_bounds
from .trajectories.limits.coordination import MinimumTime, minimum_time
from .trajectories.limits.demands import Demand
from .trajectories.limits.fastest_along_path import PathTiming, fastest_along
from .trajectories.limits.minimum_duration import shortest_duration
from .trajectories.limits.motion_limits import MotionLimits
from .trajectories.limits.norm_limits import NormLimits
from .trajectories.limits.time_scaling import TimeScaling, scale_to_limits
from .trajectories.limits.violations import LimitViolation, limit_violations
from .trajectories.meeting import (
    MeetingBranch,
    MeetingVerdict,
    Rendezvous,
    rendezvous,
)
from .trajectories.peaks.norm_peaks import (
    AccelerationSplit,
    NormPeak,
    acceleration_split,
    peak_norm,
)
from .trajectories.polynomials.piecewise import PiecewiseTrajectory
from .trajectories.polynomials.polynomial import (
    PolynomialTrajectory,
    cubic,
    quintic,
    septic,
)
from .trajectories.polynomials.polynomial_law import PolynomialLaw
from .trajectories.polynomials.symbolic_polynomial import (
    PolynomialFormula,
    polynomial_formula,
)
from .trajectories.protocols import Peak, TimingLaw, Trajectory
from .trajectories.splines.cubic_splines import cubic_spline, cubics_through
from .trajectories.splines.knot_times import times_of_points
from .trajectories.splines.mixed_degrees import (
    mixed_spline,
    polynomial_through,
    virtual_point_spline,
)
from .trajectories.splines.passing_over import overfly
from .trajectories.target_motion import (
    FunctionMotion,
    LinearMotion,
    TargetMotion,
)
from .viewer.animation import animate, view
from .viewer.plot_curves import plot_path
from .viewer.plot_laws import plot_timing_law
from .viewer.plot_motions import plot_trajectory
from .viewer.plots import plot_joint_motion, plot_tool_path

__all__ = [
    "RANK_TOLERANCE",
    "AccelerationSplit",
    "Alignment",
    "AxisAngle",
    "DHRow",
    "DHTable",
    "Demand",
    "EulerFormulas",
    "EulerRates",
    "EulerSequence",
    "EulerSolutions",
    "FollowedTrajectory",
    "FollowingStatus",
    "FormulaError",
    "FormulaPath",
    "Formulas",
    "FrameAlignment",
    "FrenetFormulas",
    "FrenetFrame",
    "FunctionMotion",
    "FunctionTask",
    "GainChoice",
    "GainStatus",
    "IKBatch",
    "IKIterate",
    "IKIteration",
    "IKResult",
    "IKSolutions",
    "IKSolver",
    "IKStatus",
    "InputError",
    "Intersections",
    "Join",
    "JointAcceleration",
    "JointLaws",
    "JointVelocity",
    "LimitViolation",
    "LinearMotion",
    "MeasureDistribution",
    "MeetingBranch",
    "MeetingVerdict",
    "MinimumTime",
    "MissingExtraError",
    "MotionLimits",
    "NearestRotation",
    "NormLimits",
    "NormPeak",
    "NotConverged",
    "OrientationTask",
    "Path",
    "PathSequence",
    "PathTiming",
    "PathTrajectory",
    "Peak",
    "PiecewiseTrajectory",
    "PlanarPoseTask",
    "PointingTask",
    "PolynomialFormula",
    "PolynomialLaw",
    "PolynomialTrajectory",
    "PosePath",
    "PoseTask",
    "PositionTask",
    "ProfileLaw",
    "RankStatus",
    "RateStatus",
    "RefinedGroup",
    "Refinement",
    "Rendezvous",
    "Resolution",
    "Robot",
    "RobotFileError",
    "RobotReport",
    "RobotWarning",
    "Robotics1Error",
    "RoundedConfiguration",
    "SingularAngle",
    "SingularBranch",
    "SingularSet",
    "SingularityScan",
    "StackedPath",
    "Subspaces",
    "TargetMotion",
    "Task",
    "TaskError",
    "TaskTrajectory",
    "TimeScaling",
    "TimingBounds",
    "TimingLaw",
    "Tracking",
    "Trajectory",
    "TrajectorySequence",
    "UnitQuaternions",
    "UnknownNameError",
    "acceleration_split",
    "align_direction",
    "align_two_directions",
    "angular_velocity",
    "animate",
    "arc_path",
    "arc_through",
    "axis_angle_path",
    "axis_angle_to_rotation",
    "balancing_torque",
    "bang_bang",
    "by_arc_length",
    "check_robot",
    "circle_path",
    "cosine",
    "cruise_profile",
    "cubic",
    "cubic_spline",
    "cubics_through",
    "cycloidal",
    "dh_to_urdf",
    "double_s",
    "ellipse_path",
    "euler_formulas",
    "euler_path",
    "euler_rate_map",
    "euler_rates",
    "euler_to_rotation",
    "exerting_torque",
    "fastest_along",
    "find_intersections",
    "find_singularities",
    "follow_trajectory",
    "follow_trajectory_by_acceleration",
    "formula_path",
    "formulas",
    "forward_kinematics",
    "frame_jacobian",
    "frame_jacobian_rate",
    "frenet_formulas",
    "frenet_frame",
    "frenet_path",
    "helix_path",
    "ik_solutions",
    "iterate_ik",
    "jacobian_rate",
    "joint_acceleration",
    "joint_velocity",
    "limit_violations",
    "line_path",
    "load_robot",
    "minimum_time",
    "mixed_spline",
    "nearest_rotation",
    "overfly",
    "parameter_conditions",
    "peak_norm",
    "plot_joint_motion",
    "plot_path",
    "plot_timing_law",
    "plot_tool_path",
    "plot_trajectory",
    "polyline_path",
    "polynomial_formula",
    "polynomial_through",
    "pose_line",
    "quaternion_rate_map",
    "quaternion_to_rotation",
    "quintic",
    "rendezvous",
    "robot_from_dh",
    "rotation_to_axis_angle",
    "rotation_to_euler",
    "rotation_to_quaternion",
    "scale_to_limits",
    "scan_singularities",
    "septic",
    "shortest_duration",
    "simulate_tracking",
    "singularity_within_rounding",
    "skew",
    "smallest_gain",
    "solve_ik",
    "spline_path",
    "stretched",
    "subspaces",
    "times_of_points",
    "timing_bounds",
    "trapezoidal",
    "turn_path",
    "urdf_to_dh",
    "vee",
    "view",
    "virtual_point_spline",
]
