"""The public names of `robotics1.workspaces`, and where they are."""

from .find import workspace
from .reachability.comparison import map_difference, map_union
from .reachability.evaluation import PoseStatus
from .reachability.map import reachability_map
from .reachability.placements import Placements, best_placements
from .reachability.result import ReachabilityMap
from .reachability.saved import read_map, save_map
from .result import BoundaryCurve, Workspace, WorkspaceRegion

__all__ = [
    "BoundaryCurve",
    "Placements",
    "PoseStatus",
    "ReachabilityMap",
    "Workspace",
    "WorkspaceRegion",
    "best_placements",
    "map_difference",
    "map_union",
    "reachability_map",
    "read_map",
    "save_map",
    "workspace",
]
