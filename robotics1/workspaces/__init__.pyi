"""The public names of `robotics1.workspaces`, and where they are."""

from .find import workspace
from .reachability.evaluation import PoseStatus
from .reachability.map import reachability_map
from .reachability.result import ReachabilityMap
from .reachability.saved import read_map, save_map
from .result import BoundaryCurve, Workspace, WorkspaceRegion

__all__ = [
    "BoundaryCurve",
    "PoseStatus",
    "ReachabilityMap",
    "Workspace",
    "WorkspaceRegion",
    "reachability_map",
    "read_map",
    "save_map",
    "workspace",
]
