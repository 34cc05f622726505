"""The public names of `robotics1.textbook_robots`, and where they are."""

from .planar import planar_arm

__all__ = [
    "planar_arm",
]
