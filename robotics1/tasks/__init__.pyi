"""The public names of `robotics1.tasks`, and where they are."""

from .function import FunctionTask
from .planar_pose import PlanarPoseTask
from .pointing import PointingTask
from .polar import CylindricalTask, PolarTask
from .pose import OrientationTask, PoseTask
from .position import PositionTask
from .stacked import StackedTask
from .task import Task

__all__ = [
    "CylindricalTask",
    "FunctionTask",
    "OrientationTask",
    "PlanarPoseTask",
    "PointingTask",
    "PolarTask",
    "PoseTask",
    "PositionTask",
    "StackedTask",
    "Task",
]
