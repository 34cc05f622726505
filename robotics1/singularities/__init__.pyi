"""The public names of `robotics1.singularities`, and where they are."""

from .dexterity import Manipulability, Transmission, manipulability, sigma_min
from .ellipsoids import Ellipsoid
from .equilibrium import (
    FreeWrenches,
    LargestForce,
    StaticTorques,
    largest_force,
    static_torques,
    wrenches_without_torque,
)
from .exact_values import ConfigurationFormulas
from .find import find_singularities
from .intersections import find_intersections
from .other_lengths import parameter_conditions
from .polytopes import JointBoundPolytope, force_polytope, velocity_polytope
from .reduction import MeasureDistribution
from .result import Intersections, SingularBranch, SingularSet, SingularSetStatus
from .rounding import RoundedConfiguration, singularity_within_rounding
from .scan import scan_singularities
from .scan_result import RefinedGroup, Refinement, SingularityScan
from .spaces import RankStatus, Subspaces, subspaces
from .statics import Load, Payload, balancing_torque, exerting_torque
from .wrist import WristJacobian, wrist_jacobian

__all__ = [
    "ConfigurationFormulas",
    "Ellipsoid",
    "FreeWrenches",
    "Intersections",
    "JointBoundPolytope",
    "LargestForce",
    "Load",
    "Manipulability",
    "MeasureDistribution",
    "Payload",
    "RankStatus",
    "RefinedGroup",
    "Refinement",
    "RoundedConfiguration",
    "SingularBranch",
    "SingularSet",
    "SingularSetStatus",
    "SingularityScan",
    "StaticTorques",
    "Subspaces",
    "Transmission",
    "WristJacobian",
    "balancing_torque",
    "exerting_torque",
    "find_intersections",
    "find_singularities",
    "force_polytope",
    "largest_force",
    "manipulability",
    "parameter_conditions",
    "scan_singularities",
    "sigma_min",
    "singularity_within_rounding",
    "static_torques",
    "subspaces",
    "velocity_polytope",
    "wrenches_without_torque",
    "wrist_jacobian",
]
