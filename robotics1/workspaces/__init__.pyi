"""The public names of `robotics1.workspaces`, and where they are."""

from .find import workspace
from .questions.dexterous import DexterousWorkspace, dexterous_workspace
from .questions.fitting import FittingCircle, largest_circle
from .questions.formulas_of_reach import WorkspaceFormulas, workspace_formulas
from .questions.membership import Membership, is_reached
from .questions.needed_ranges import JointRanges, joint_ranges
from .questions.optimized_reach import ExtremeReach, extreme_reach
from .questions.passages import Passages, crossings
from .questions.wrist_dexterity import WristDexterity
from .result import BoundaryCurve, Workspace, WorkspaceRegion

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
