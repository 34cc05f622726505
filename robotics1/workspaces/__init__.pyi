"""The public names of `robotics1.workspaces`, and where they are."""

from .dexterous import DexterousWorkspace, dexterous_workspace
from .find import workspace
from .fitting import FittingCircle, largest_circle
from .formulas_of_reach import WorkspaceFormulas, workspace_formulas
from .membership import Membership, is_reached
from .needed_ranges import JointRanges, joint_ranges
from .optimized_reach import ExtremeReach, extreme_reach
from .passages import Passages, crossings
from .reachability.comparison import map_difference, map_union
from .reachability.evaluation import PoseStatus
from .reachability.map import reachability_map
from .reachability.placements import Placements, best_placements
from .reachability.result import ReachabilityMap
from .reachability.saved import read_map, save_map
from .result import BoundaryCurve, Workspace, WorkspaceRegion
from .wrist_dexterity import WristDexterity

__all__ = [
    "BoundaryCurve",
    "DexterousWorkspace",
    "ExtremeReach",
    "FittingCircle",
    "JointRanges",
    "Membership",
    "Passages",
    "Placements",
    "PoseStatus",
    "ReachabilityMap",
    "Workspace",
    "WorkspaceFormulas",
    "WorkspaceRegion",
    "WristDexterity",
    "best_placements",
    "crossings",
    "dexterous_workspace",
    "extreme_reach",
    "is_reached",
    "joint_ranges",
    "largest_circle",
    "map_difference",
    "map_union",
    "reachability_map",
    "read_map",
    "save_map",
    "workspace",
    "workspace_formulas",
]
