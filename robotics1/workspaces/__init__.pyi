"""The public names of `robotics1.workspaces`, and where they are."""

from .dexterous import DexterousWorkspace, dexterous_workspace
from .find import workspace
from .fitting import FittingCircle, largest_circle
from .formulas_of_reach import WorkspaceFormulas, workspace_formulas
from .membership import Membership, is_reached
from .needed_ranges import JointRanges, joint_ranges
from .optimized_reach import ExtremeReach, extreme_reach
from .passages import Passages, crossings
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
    "Workspace",
    "WorkspaceFormulas",
    "WorkspaceRegion",
    "WristDexterity",
    "crossings",
    "dexterous_workspace",
    "extreme_reach",
    "is_reached",
    "joint_ranges",
    "largest_circle",
    "workspace",
    "workspace_formulas",
]
