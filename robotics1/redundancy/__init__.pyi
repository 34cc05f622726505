"""The public names of `robotics1.redundancy`, and where they are."""

from .null_motion import ProjectedGradient, projected_gradient
from .null_saturation import SaturationStep
from .objectives import (
    FunctionObjective,
    JointRangeObjective,
    ManipulabilityObjective,
    NearObjective,
    Objective,
    ObstacleObjective,
)
from .priorities import LevelOutcome, LevelStatus, Priorities, priority_acceleration, priority_velocity
from .saturation import (
    SaturatedMotion,
    SaturatedPriorities,
    SaturationStatus,
    saturated_acceleration,
    saturated_priority_velocity,
    saturated_velocity,
)

__all__ = [
    "FunctionObjective",
    "JointRangeObjective",
    "LevelOutcome",
    "LevelStatus",
    "ManipulabilityObjective",
    "NearObjective",
    "Objective",
    "ObstacleObjective",
    "Priorities",
    "ProjectedGradient",
    "SaturatedMotion",
    "SaturatedPriorities",
    "SaturationStatus",
    "SaturationStep",
    "priority_acceleration",
    "priority_velocity",
    "projected_gradient",
    "saturated_acceleration",
    "saturated_priority_velocity",
    "saturated_velocity",
]
