"""The public names at the top, and the namespaces that hold the others; `__init__.py` reads this file."""

from . import (
    control,
    curves,
    dh,
    ik,
    orientation,
    plots,
    redundancy,
    rigid_motions,
    singularities,
    tasks,
    textbook_robots,
    trajectories,
    workspaces,
)
from .data_sheet.sheet import report
from .dh.to_robot import robot_from_dh
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
from .ik.closed_form.find import ik_formulas
from .ik.iterate import iterate_ik
from .ik.solutions import ik_solutions
from .ik.solver import IKSolver, solve_ik
from .kinematics import forward_kinematics, frame_jacobian, frame_jacobian_rate
from .least_squares import RANK_TOLERANCE
from .robot.findings import RobotReport
from .robot.loading import check_robot, load_robot
from .robot.model import Robot
from .singularities.find import find_singularities
from .singularities.scan import scan_singularities
from .singularities.spaces import subspaces
from .singularities.statics import balancing_torque
from .symbolic.tasks.formula import formulas
from .symbolic.tasks.task_formulas import Formulas
from .tasks.function import FunctionTask
from .tasks.planar_pose import PlanarPoseTask
from .tasks.pointing import PointingTask
from .tasks.pose import OrientationTask, PoseTask
from .tasks.position import PositionTask
from .tasks.stacked import StackedTask
from .trajectories.elementary import cubic, quintic
from .trajectories.following.path_following import follow_trajectory
from .trajectories.least_time_of_joints import minimum_time
from .trajectories.limits import MotionLimits
from .trajectories.meeting import rendezvous
from .trajectories.profiles import trapezoidal
from .trajectories.target_motion import LinearMotion
from .viewer.animation import animate, view

__version__: str

__all__ = [
    "RANK_TOLERANCE",
    "FormulaError",
    "Formulas",
    "FunctionTask",
    "IKSolver",
    "InputError",
    "LinearMotion",
    "MissingExtraError",
    "MotionLimits",
    "NotConverged",
    "OrientationTask",
    "PlanarPoseTask",
    "PointingTask",
    "PoseTask",
    "PositionTask",
    "Robot",
    "RobotFileError",
    "RobotReport",
    "RobotWarning",
    "Robotics1Error",
    "StackedTask",
    "TaskError",
    "UnknownNameError",
    "animate",
    "balancing_torque",
    "check_robot",
    "control",
    "cubic",
    "curves",
    "dh",
    "find_singularities",
    "follow_trajectory",
    "formulas",
    "forward_kinematics",
    "frame_jacobian",
    "frame_jacobian_rate",
    "ik",
    "ik_formulas",
    "ik_solutions",
    "iterate_ik",
    "load_robot",
    "minimum_time",
    "orientation",
    "plots",
    "quintic",
    "redundancy",
    "rendezvous",
    "report",
    "rigid_motions",
    "robot_from_dh",
    "scan_singularities",
    "singularities",
    "solve_ik",
    "subspaces",
    "tasks",
    "textbook_robots",
    "trajectories",
    "trapezoidal",
    "view",
    "workspaces",
]
