"""The public names of `robotics1.workspaces`, and where they are."""

from .find import workspace
from .result import BoundaryCurve, Workspace, WorkspaceRegion

__all__ = [
    "BoundaryCurve",
    "Workspace",
    "WorkspaceRegion",
    "workspace",
]
