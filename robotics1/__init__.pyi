"""The public names and where they are; `__init__.py` reads this file, and so do type checkers."""

from .analysis.rounded_configuration import (
    RoundedConfiguration as RoundedConfiguration,
)
from .analysis.rounded_configuration import (
    singularity_within_rounding as singularity_within_rounding,
)
from .analysis.singular_set import (
    SingularBranch as SingularBranch,
)
from .analysis.singular_set import (
    SingularSet as SingularSet,
)
from .analysis.singularity import (
    find_singularities as find_singularities,
)
from .analysis.spaces import (
    RANK_TOLERANCE as RANK_TOLERANCE,
)
from .analysis.spaces import (
    RankStatus as RankStatus,
)
from .analysis.spaces import (
    Subspaces as Subspaces,
)
from .analysis.spaces import (
    subspaces as subspaces,
)
from .analysis.statics import (
    balancing_torque as balancing_torque,
)
from .analysis.statics import (
    exerting_torque as exerting_torque,
)
from .control import (
    GainChoice as GainChoice,
)
from .control import (
    GainVerdict as GainVerdict,
)
from .control import (
    Tracking as Tracking,
)
from .control import (
    simulate_tracking as simulate_tracking,
)
from .control import (
    smallest_gain as smallest_gain,
)
from .errors import (
    FormulaError as FormulaError,
)
from .errors import (
    InputError as InputError,
)
from .errors import (
    MissingExtraError as MissingExtraError,
)
from .errors import (
    NotConverged as NotConverged,
)
from .errors import (
    RobotFileError as RobotFileError,
)
from .errors import (
    Robotics1Error as Robotics1Error,
)
from .errors import (
    RobotWarning as RobotWarning,
)
from .errors import (
    TaskError as TaskError,
)
from .errors import (
    UnknownNameError as UnknownNameError,
)
from .ik.iterate import (
    IKIterate as IKIterate,
)
from .ik.iterate import (
    IKIteration as IKIteration,
)
from .ik.iterate import (
    iterate_ik as iterate_ik,
)
from .ik.result import (
    IKBatch as IKBatch,
)
from .ik.result import (
    IKResult as IKResult,
)
from .ik.solutions import (
    IKSolutions as IKSolutions,
)
from .ik.solutions import (
    IKVerdict as IKVerdict,
)
from .ik.solutions import (
    ik_solutions as ik_solutions,
)
from .ik.solver import (
    IKSolver as IKSolver,
)
from .ik.solver import (
    solve_ik as solve_ik,
)
from .ik.status import (
    IKStatus as IKStatus,
)
from .kinematics import (
    forward_kinematics as forward_kinematics,
)
from .kinematics import (
    frame_jacobian as frame_jacobian,
)
from .kinematics import (
    frame_jacobian_rate as frame_jacobian_rate,
)
from .orientation.axis_angle import (
    AxisAngle as AxisAngle,
)
from .orientation.axis_angle import (
    axis_angle_to_rotation as axis_angle_to_rotation,
)
from .orientation.axis_angle import (
    rotation_to_axis_angle as rotation_to_axis_angle,
)
from .orientation.elementary import (
    skew as skew,
)
from .orientation.elementary import (
    vee as vee,
)
from .orientation.euler import (
    EulerSolutions as EulerSolutions,
)
from .orientation.euler import (
    euler_to_rotation as euler_to_rotation,
)
from .orientation.euler import (
    rotation_to_euler as rotation_to_euler,
)
from .orientation.nearest import (
    NearestRotation as NearestRotation,
)
from .orientation.nearest import (
    nearest_rotation as nearest_rotation,
)
from .orientation.pointing import (
    Alignment as Alignment,
)
from .orientation.pointing import (
    FrameAlignment as FrameAlignment,
)
from .orientation.pointing import (
    align_direction as align_direction,
)
from .orientation.pointing import (
    align_two_directions as align_two_directions,
)
from .orientation.quaternion import (
    UnitQuaternions as UnitQuaternions,
)
from .orientation.quaternion import (
    quaternion_rate_map as quaternion_rate_map,
)
from .orientation.quaternion import (
    quaternion_to_rotation as quaternion_to_rotation,
)
from .orientation.quaternion import (
    rotation_to_quaternion as rotation_to_quaternion,
)
from .orientation.rates import (
    EulerRates as EulerRates,
)
from .orientation.rates import (
    euler_rate_map as euler_rate_map,
)
from .orientation.rates import (
    euler_rates as euler_rates,
)
from .orientation.sequence import (
    EulerSequence as EulerSequence,
)
from .orientation.sequence_formulas import (
    EulerFormulas as EulerFormulas,
)
from .orientation.sequence_formulas import (
    SingularAngle as SingularAngle,
)
from .orientation.sequence_formulas import (
    euler_formulas as euler_formulas,
)
from .orientation.velocity import (
    angular_velocity as angular_velocity,
)
from .paths.arc_length import (
    StackedPath as StackedPath,
)
from .paths.arc_length import (
    by_arc_length as by_arc_length,
)
from .paths.arcs import (
    arc_path as arc_path,
)
from .paths.arcs import (
    arc_through as arc_through,
)
from .paths.arcs import (
    circle_path as circle_path,
)
from .paths.euler_rotation import (
    euler_path as euler_path,
)
from .paths.frenet import (
    FrenetFrame as FrenetFrame,
)
from .paths.frenet import (
    frenet_frame as frenet_frame,
)
from .paths.frenet_rotation import (
    frenet_path as frenet_path,
)
from .paths.harmonic import (
    ellipse_path as ellipse_path,
)
from .paths.harmonic import (
    helix_path as helix_path,
)
from .paths.harmonic import (
    line_path as line_path,
)
from .paths.path import (
    Path as Path,
)
from .paths.path_sequence import (
    PathSequence as PathSequence,
)
from .paths.polyline import (
    polyline_path as polyline_path,
)
from .paths.polynomial_path import (
    spline_path as spline_path,
)
from .paths.pose_path import (
    PosePath as PosePath,
)
from .paths.pose_path import (
    pose_line as pose_line,
)
from .paths.rotations import (
    axis_angle_path as axis_angle_path,
)
from .paths.rotations import (
    turn_path as turn_path,
)
from .paths.symbolic_path import (
    FormulaPath as FormulaPath,
)
from .paths.symbolic_path import (
    FrenetFormulas as FrenetFormulas,
)
from .paths.symbolic_path import (
    formula_path as formula_path,
)
from .paths.symbolic_path import (
    frenet_formulas as frenet_formulas,
)
from .robot.dh import (
    dh_to_urdf as dh_to_urdf,
)
from .robot.dh import (
    robot_from_dh as robot_from_dh,
)
from .robot.dh_from_urdf import (
    urdf_to_dh as urdf_to_dh,
)
from .robot.dh_table import (
    DHRow as DHRow,
)
from .robot.dh_table import (
    DHTable as DHTable,
)
from .robot.examination import (
    Examination as Examination,
)
from .robot.examination import (
    examine as examine,
)
from .robot.loading import (
    load_robot as load_robot,
)
from .robot.model import (
    Robot as Robot,
)
from .scan.histogram import (
    MeasureDistribution as MeasureDistribution,
)
from .scan.refinement import (
    RefinedGroup as RefinedGroup,
)
from .scan.refinement import (
    Refinement as Refinement,
)
from .scan.result import (
    SingularityScan as SingularityScan,
)
from .scan.scanning import (
    scan_singularities as scan_singularities,
)
from .symbolic.tasks.formula import (
    formulas as formulas,
)
from .symbolic.tasks.task_formulas import (
    Formulas as Formulas,
)
from .tasks.function import (
    FunctionTask as FunctionTask,
)
from .tasks.planar_pose import (
    PlanarPoseTask as PlanarPoseTask,
)
from .tasks.pointing import (
    PointingTask as PointingTask,
)
from .tasks.pose import (
    OrientationTask as OrientationTask,
)
from .tasks.pose import (
    PoseTask as PoseTask,
)
from .tasks.position import (
    PositionTask as PositionTask,
)
from .tasks.task import (
    Task as Task,
)
from .trajectories.composition.joint_laws import (
    JointLaws as JointLaws,
)
from .trajectories.composition.path_trajectory import (
    PathTrajectory as PathTrajectory,
)
from .trajectories.composition.stretching import (
    stretched as stretched,
)
from .trajectories.composition.trajectory_sequence import (
    Join as Join,
)
from .trajectories.composition.trajectory_sequence import (
    TrajectorySequence as TrajectorySequence,
)
from .trajectories.following.followed_trajectory import (
    FollowedTrajectory as FollowedTrajectory,
)
from .trajectories.following.followed_trajectory import (
    FollowingVerdict as FollowingVerdict,
)
from .trajectories.following.joint_rates import (
    JointAcceleration as JointAcceleration,
)
from .trajectories.following.joint_rates import (
    JointVelocity as JointVelocity,
)
from .trajectories.following.joint_rates import (
    RateVerdict as RateVerdict,
)
from .trajectories.following.joint_rates import (
    joint_acceleration as joint_acceleration,
)
from .trajectories.following.joint_rates import (
    joint_velocity as joint_velocity,
)
from .trajectories.following.path_following import (
    follow_trajectory as follow_trajectory,
)
from .trajectories.following.path_following import (
    follow_trajectory_by_acceleration as follow_trajectory_by_acceleration,
)
from .trajectories.following.resolution import (
    Resolution as Resolution,
)
from .trajectories.following.task_rates import (
    TaskTrajectory as TaskTrajectory,
)
from .trajectories.following.task_rates import (
    jacobian_rate as jacobian_rate,
)
from .trajectories.laws.given_duration import (
    bang_bang as bang_bang,
)
from .trajectories.laws.given_duration import (
    cruise_profile as cruise_profile,
)
from .trajectories.laws.given_duration import (
    double_s as double_s,
)
from .trajectories.laws.given_duration import (
    trapezoidal as trapezoidal,
)
from .trajectories.laws.profiles import (
    ProfileLaw as ProfileLaw,
)
from .trajectories.laws.trigonometric import (
    cosine as cosine,
)
from .trajectories.laws.trigonometric import (
    cycloidal as cycloidal,
)
from .trajectories.limits.bounds_along_path import (
    TimingBounds as TimingBounds,
)
from .trajectories.limits.bounds_along_path import (
    timing_bounds as timing_bounds,
)
from .trajectories.limits.coordination import (
    MinimumTime as MinimumTime,
)
from .trajectories.limits.coordination import (
    minimum_time as minimum_time,
)
from .trajectories.limits.demands import (
    Demand as Demand,
)
from .trajectories.limits.fastest_along_path import (
    PathTiming as PathTiming,
)
from .trajectories.limits.fastest_along_path import (
    fastest_along as fastest_along,
)
from .trajectories.limits.minimum_duration import (
    shortest_duration as shortest_duration,
)
from .trajectories.limits.motion_limits import (
    MotionLimits as MotionLimits,
)
from .trajectories.limits.norm_limits import (
    NormLimits as NormLimits,
)
from .trajectories.limits.time_scaling import (
    TimeScaling as TimeScaling,
)
from .trajectories.limits.time_scaling import (
    scale_to_limits as scale_to_limits,
)
from .trajectories.limits.violations import (
    LimitViolation as LimitViolation,
)
from .trajectories.limits.violations import (
    limit_violations as limit_violations,
)
from .trajectories.meeting import (
    MeetingBranch as MeetingBranch,
)
from .trajectories.meeting import (
    MeetingVerdict as MeetingVerdict,
)
from .trajectories.meeting import (
    Rendezvous as Rendezvous,
)
from .trajectories.meeting import (
    rendezvous as rendezvous,
)
from .trajectories.peaks.norm_peaks import (
    AccelerationSplit as AccelerationSplit,
)
from .trajectories.peaks.norm_peaks import (
    NormPeak as NormPeak,
)
from .trajectories.peaks.norm_peaks import (
    acceleration_split as acceleration_split,
)
from .trajectories.peaks.norm_peaks import (
    peak_norm as peak_norm,
)
from .trajectories.polynomials.piecewise import (
    PiecewiseTrajectory as PiecewiseTrajectory,
)
from .trajectories.polynomials.polynomial import (
    PolynomialTrajectory as PolynomialTrajectory,
)
from .trajectories.polynomials.polynomial import (
    cubic as cubic,
)
from .trajectories.polynomials.polynomial import (
    quintic as quintic,
)
from .trajectories.polynomials.polynomial import (
    septic as septic,
)
from .trajectories.polynomials.polynomial_law import (
    PolynomialLaw as PolynomialLaw,
)
from .trajectories.polynomials.symbolic_polynomial import (
    PolynomialFormula as PolynomialFormula,
)
from .trajectories.polynomials.symbolic_polynomial import (
    polynomial_formula as polynomial_formula,
)
from .trajectories.protocols import (
    Peak as Peak,
)
from .trajectories.protocols import (
    TimingLaw as TimingLaw,
)
from .trajectories.protocols import (
    Trajectory as Trajectory,
)
from .trajectories.splines.cubic_splines import (
    cubic_spline as cubic_spline,
)
from .trajectories.splines.cubic_splines import (
    cubics_through as cubics_through,
)
from .trajectories.splines.knot_times import (
    times_of_points as times_of_points,
)
from .trajectories.splines.mixed_degrees import (
    mixed_spline as mixed_spline,
)
from .trajectories.splines.mixed_degrees import (
    polynomial_through as polynomial_through,
)
from .trajectories.splines.mixed_degrees import (
    virtual_point_spline as virtual_point_spline,
)
from .trajectories.splines.passing_over import (
    overfly as overfly,
)
from .trajectories.target_motion import (
    FunctionMotion as FunctionMotion,
)
from .trajectories.target_motion import (
    LinearMotion as LinearMotion,
)
from .trajectories.target_motion import (
    TargetMotion as TargetMotion,
)
from .viewer.animation import (
    animate as animate,
)
from .viewer.animation import (
    view as view,
)
from .viewer.plot_curves import (
    plot_path as plot_path,
)
from .viewer.plot_laws import (
    plot_timing_law as plot_timing_law,
)
from .viewer.plot_motions import (
    plot_trajectory as plot_trajectory,
)
from .viewer.plots import (
    plot_joint_motion as plot_joint_motion,
)
from .viewer.plots import (
    plot_tool_path as plot_tool_path,
)

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
    "Examination",
    "FollowedTrajectory",
    "FollowingVerdict",
    "FormulaError",
    "FormulaPath",
    "Formulas",
    "FrameAlignment",
    "FrenetFormulas",
    "FrenetFrame",
    "FunctionMotion",
    "FunctionTask",
    "GainChoice",
    "GainVerdict",
    "IKBatch",
    "IKIterate",
    "IKIteration",
    "IKResult",
    "IKSolutions",
    "IKSolver",
    "IKStatus",
    "IKVerdict",
    "InputError",
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
    "RateVerdict",
    "RefinedGroup",
    "Refinement",
    "Rendezvous",
    "Resolution",
    "Robot",
    "RobotFileError",
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
    "examine",
    "exerting_torque",
    "fastest_along",
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
