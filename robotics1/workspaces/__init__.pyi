"""The public names of `robotics1.workspaces`, and where they are."""

from .find import workspace
from .questions.dexterous import DexterousWorkspace, dexterous_workspace
from .questions.fitting import FittingCircle, largest_circle
from .questions.formulas_of_reach import WorkspaceFormulas, workspace_formulas
from .questions.membership import Membership, is_reached
from .questions.needed_ranges import JointRanges, joint_ranges
from .questions.optimized_reach import ExtremeReach, extreme_reach
from .questions.passages import Passages, crossings
from .questions.plane_sections import PlaneSection, plane_section
from .questions.wrist_dexterity import WristDexterity
from .reachability.comparison import map_difference, map_union
from .reachability.evaluation import PoseStatus
from .reachability.map import reachability_map
from .reachability.placements import Placements, best_placements
from .reachability.result import ReachabilityMap
from .reachability.saved import read_map, save_map
from .result import BoundaryCurve, Workspace, WorkspaceRegion

__all__ = [
    "BoundaryCurve",
    "DexterousWorkspace",
    "ExtremeReach",
    "FittingCircle",
    "JointRanges",
    "Membership",
    "Passages",
    "Placements",
    "PlaneSection",
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
    "plane_section",
    "reachability_map",
    "read_map",
    "save_map",
    "workspace",
    "workspace_formulas",
]
