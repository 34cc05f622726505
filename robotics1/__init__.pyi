"""The public names and where they are; `__init__.py` reads this file, and so do type checkers."""

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
    IKStatus as IKStatus,
)
from .ik.iterate import (
    iterate_ik as iterate_ik,
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
from .kinematics import (
    forward_kinematics as forward_kinematics,
)
from .kinematics import (
    frame_jacobian as frame_jacobian,
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
from .symbolic.formula import (
    Formulas as Formulas,
)
from .symbolic.formula import (
    formulas as formulas,
)
from .tasks.function import (
    FunctionTask as FunctionTask,
)
from .tasks.planar_pose import (
    PlanarPoseTask as PlanarPoseTask,
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
from .trajectories.limits import (
    LimitViolation as LimitViolation,
)
from .trajectories.limits import (
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
from .trajectories.polynomial import (
    PolynomialTrajectory as PolynomialTrajectory,
)
from .trajectories.polynomial import (
    cubic as cubic,
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
from .viewer.plots import (
    plot_joint_motion as plot_joint_motion,
)
from .viewer.plots import (
    plot_tool_path as plot_tool_path,
)

__all__ = [
    "RANK_TOLERANCE",
    "DHRow",
    "DHTable",
    "Examination",
    "FormulaError",
    "Formulas",
    "FunctionMotion",
    "FunctionTask",
    "GainChoice",
    "GainVerdict",
    "IKIterate",
    "IKIteration",
    "IKSolutions",
    "IKStatus",
    "IKVerdict",
    "InputError",
    "LimitViolation",
    "LinearMotion",
    "MeetingBranch",
    "MeetingVerdict",
    "MissingExtraError",
    "NotConverged",
    "OrientationTask",
    "PlanarPoseTask",
    "PolynomialTrajectory",
    "PoseTask",
    "PositionTask",
    "Rendezvous",
    "Robot",
    "RobotFileError",
    "RobotWarning",
    "Robotics1Error",
    "SingularBranch",
    "SingularSet",
    "Subspaces",
    "TargetMotion",
    "Task",
    "TaskError",
    "Tracking",
    "UnknownNameError",
    "animate",
    "balancing_torque",
    "cubic",
    "dh_to_urdf",
    "examine",
    "exerting_torque",
    "find_singularities",
    "formulas",
    "forward_kinematics",
    "frame_jacobian",
    "ik_solutions",
    "iterate_ik",
    "limit_violations",
    "load_robot",
    "plot_joint_motion",
    "plot_tool_path",
    "rendezvous",
    "robot_from_dh",
    "simulate_tracking",
    "smallest_gain",
    "subspaces",
    "urdf_to_dh",
    "view",
]
