"""The public names and where they are; `__init__.py` reads this file, and so do type checkers."""

from .control import (
    GainChoice,
    GainStatus,
    Tracking,
    simulate_tracking,
    smallest_gain,
)
from .curves.arcs import (
    arc_path,
    arc_through,
    circle_path,
    ellipse_path,
    helix_path,
    line_path,
)
from .curves.composition import PathTrajectory, by_arc_length, stretched
from .curves.curve import Curve
from .curves.frenet import FrenetFrame, frenet_frame, frenet_path
from .curves.harmonic import HarmonicCurve
from .curves.interpolants import Extreme
from .curves.piecewise_polynomial import PiecewisePolynomial
from .curves.polyline import parabolic_blends, polyline_path
from .curves.pose_path import PosePath, pose_line
from .curves.rotations import euler_path, slerp_path, turn_path
from .curves.sequence import CurveSequence, Join
from .curves.stack import JointTrajectory, StackedCurve, stacked_path
from .curves.symbolic_path import (
    FormulaPath,
    FrenetFormulas,
    formula_path,
    frenet_formulas,
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
from .trajectories.bounds_along_path import TimingBounds, timing_bounds
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
from .trajectories.least_time_along_path import PathTiming, time_optimal
from .trajectories.least_time_of_joints import MinimumTime, minimum_time
from .trajectories.limits import (
    LimitUse,
    MotionLimits,
    NormLimits,
    limit_violations,
)
from .trajectories.meeting import (
    MeetingBranch,
    MeetingStatus,
    Rendezvous,
    rendezvous,
)
from .trajectories.norms import (
    AccelerationSplit,
    acceleration_split,
    peak_norm,
)
from .trajectories.polynomial_splines import (
    polynomial_spline,
    polynomial_through,
    virtual_point_spline,
)
from .trajectories.polynomials import cubic, quintic, septic
from .trajectories.profiles import (
    VelocityProfile,
    bang_bang,
    cruise_profile,
    double_s,
    trapezoidal,
)
from .trajectories.scaling import TimeScaling, scale_to_limits
from .trajectories.shortest import minimum_duration
from .trajectories.sines import cosine, cycloidal
from .trajectories.splines import (
    cubic_hermite_spline,
    cubic_spline,
    knot_times,
    spline_path,
)
from .trajectories.symbolic_polynomial import (
    PolynomialFormula,
    polynomial_formula,
)
from .trajectories.target_motion import (
    FunctionMotion,
    LinearMotion,
    TargetMotion,
)
from .viewer.animation import animate, view
from .viewer.plots import plot_path, plot_timing_law, plot_trajectory

__all__ = [
    "RANK_TOLERANCE",
    "AccelerationSplit",
    "Alignment",
    "AxisAngle",
    "Curve",
    "CurveSequence",
    "DHRow",
    "DHTable",
    "EulerFormulas",
    "EulerRates",
    "EulerSequence",
    "EulerSolutions",
    "Extreme",
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
    "HarmonicCurve",
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
    "JointTrajectory",
    "JointVelocity",
    "LimitUse",
    "LinearMotion",
    "MeasureDistribution",
    "MeetingBranch",
    "MeetingStatus",
    "MinimumTime",
    "MissingExtraError",
    "MotionLimits",
    "NearestRotation",
    "NormLimits",
    "NotConverged",
    "OrientationTask",
    "PathTiming",
    "PathTrajectory",
    "PiecewisePolynomial",
    "PlanarPoseTask",
    "PointingTask",
    "PolynomialFormula",
    "PosePath",
    "PoseTask",
    "PositionTask",
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
    "StackedCurve",
    "Subspaces",
    "TargetMotion",
    "Task",
    "TaskError",
    "TaskTrajectory",
    "TimeScaling",
    "TimingBounds",
    "Tracking",
    "UnitQuaternions",
    "UnknownNameError",
    "VelocityProfile",
    "acceleration_split",
    "align_direction",
    "align_two_directions",
    "angular_velocity",
    "animate",
    "arc_path",
    "arc_through",
    "axis_angle_to_rotation",
    "balancing_torque",
    "bang_bang",
    "by_arc_length",
    "check_robot",
    "circle_path",
    "cosine",
    "cruise_profile",
    "cubic",
    "cubic_hermite_spline",
    "cubic_spline",
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
    "knot_times",
    "limit_violations",
    "line_path",
    "load_robot",
    "minimum_duration",
    "minimum_time",
    "nearest_rotation",
    "parabolic_blends",
    "parameter_conditions",
    "peak_norm",
    "plot_path",
    "plot_timing_law",
    "plot_trajectory",
    "polyline_path",
    "polynomial_formula",
    "polynomial_spline",
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
    "simulate_tracking",
    "singularity_within_rounding",
    "skew",
    "slerp_path",
    "smallest_gain",
    "solve_ik",
    "spline_path",
    "stacked_path",
    "stretched",
    "subspaces",
    "time_optimal",
    "timing_bounds",
    "trapezoidal",
    "turn_path",
    "urdf_to_dh",
    "vee",
    "view",
    "virtual_point_spline",
]
