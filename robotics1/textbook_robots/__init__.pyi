"""The public names of `robotics1.textbook_robots`, and where they are."""

from .direct_kinematics import robot_from_formula
from .elementary_transforms import robot_from_transforms
from .placed import place_robot
from .planar import planar_arm

__all__ = [
    "place_robot",
    "planar_arm",
    "robot_from_formula",
    "robot_from_transforms",
]
