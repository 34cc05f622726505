"""The public names of `robotics1.trajectories`, and where they are."""

from .basis_motions import BasisMotion, motion_in_basis
from .bounds_along_path import TimingBounds, timing_bounds
from .elementary import cosine, cubic, cycloidal, quintic, septic
from .following.followed_trajectory import FollowedTrajectory, FollowingStatus
from .following.joint_rates import JointAcceleration, JointVelocity, RateStatus, joint_acceleration, joint_velocity
from .following.path_following import follow_trajectory, follow_trajectory_by_acceleration
from .following.resolution import Resolution
from .following.task_rates import TaskTrajectory, jacobian_rate
from .instants import time_of
from .largest_speeds import SpeedAlongPath, speed_along_path
from .least_time_along_path import PathTiming, time_optimal
from .least_time_of_joints import MinimumTime, minimum_time
from .limits import LimitUse, MotionLimits, NormLimits, limit_violations
from .linear_blends import linear_segments_with_blends
from .meeting import MeetingBranch, MeetingStatus, Rendezvous, rendezvous
from .norms import AccelerationSplit, acceleration_split, peak_norm
from .piecewise_constant import motion_of_accelerations, motion_of_jerks
from .polynomial_splines import polynomial_spline, polynomial_through, virtual_point_spline
from .profiles import VelocityProfile, bang_bang, cruise_profile, double_s, trapezoidal
from .rate_conditions import RateExtreme, bounded_if, rate_extremes
from .scaling import TimeScaling, minimum_duration, scale_to_limits
from .splines import cubic_hermite_spline, cubic_spline, knot_times, spline_path
from .symbolic_polynomial import PolynomialFormula, polynomial_formula
from .target_motion import FunctionMotion, LinearMotion, TargetMotion
from .time_cases import TimeCase
from .time_formulas import TimeFormula, time_formula

__all__ = [
    "AccelerationSplit",
    "BasisMotion",
    "FollowedTrajectory",
    "FollowingStatus",
    "FunctionMotion",
    "JointAcceleration",
    "JointVelocity",
    "LimitUse",
    "LinearMotion",
    "MeetingBranch",
    "MeetingStatus",
    "MinimumTime",
    "MotionLimits",
    "NormLimits",
    "PathTiming",
    "PolynomialFormula",
    "RateExtreme",
    "RateStatus",
    "Rendezvous",
    "Resolution",
    "SpeedAlongPath",
    "TargetMotion",
    "TaskTrajectory",
    "TimeCase",
    "TimeFormula",
    "TimeScaling",
    "TimingBounds",
    "VelocityProfile",
    "acceleration_split",
    "bang_bang",
    "bounded_if",
    "cosine",
    "cruise_profile",
    "cubic",
    "cubic_hermite_spline",
    "cubic_spline",
    "cycloidal",
    "double_s",
    "follow_trajectory",
    "follow_trajectory_by_acceleration",
    "jacobian_rate",
    "joint_acceleration",
    "joint_velocity",
    "knot_times",
    "limit_violations",
    "linear_segments_with_blends",
    "minimum_duration",
    "minimum_time",
    "motion_in_basis",
    "motion_of_accelerations",
    "motion_of_jerks",
    "peak_norm",
    "polynomial_formula",
    "polynomial_spline",
    "polynomial_through",
    "quintic",
    "rate_extremes",
    "rendezvous",
    "scale_to_limits",
    "septic",
    "speed_along_path",
    "spline_path",
    "time_formula",
    "time_of",
    "time_optimal",
    "timing_bounds",
    "trapezoidal",
    "virtual_point_spline",
]
