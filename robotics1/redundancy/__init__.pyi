"""The public names of `robotics1.redundancy`, and where they are."""

from .along_path import PriorityRun, follow_by_priority
from .formulas_of_redundancy import RedundancyFormulas, redundancy_formulas
from .null_motion import ProjectedGradient, extended_task, projected_gradient, reduced_gradient
from .null_saturation import SaturationStep
from .objectives import (
    FunctionObjective,
    JointRangeObjective,
    ManipulabilityObjective,
    NearObjective,
    Objective,
    ObstacleObjective,
)
from .positions_by_priority import PriorityIK, PriorityIKLevel, PriorityIKStatus, ik_by_priority
from .priorities import LevelOutcome, LevelStatus, Priorities, priority_acceleration, priority_velocity
from .saturated_priorities import SaturatedPriorities, saturated_priority_acceleration, saturated_priority_velocity
from .saturation import SaturatedMotion, SaturationStatus, saturated_acceleration, saturated_velocity
from .weighted import weighted_pseudoinverse

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
    "PriorityIK",
    "PriorityIKLevel",
    "PriorityIKStatus",
    "PriorityRun",
    "ProjectedGradient",
    "RedundancyFormulas",
    "SaturatedMotion",
    "SaturatedPriorities",
    "SaturationStatus",
    "SaturationStep",
    "extended_task",
    "follow_by_priority",
    "ik_by_priority",
    "priority_acceleration",
    "priority_velocity",
    "projected_gradient",
    "reduced_gradient",
    "redundancy_formulas",
    "saturated_acceleration",
    "saturated_priority_acceleration",
    "saturated_priority_velocity",
    "saturated_velocity",
    "weighted_pseudoinverse",
]
