"""The public names of `robotics1.textbook_robots`, and where they are."""

from .dh_of_matrix import DHParameters, DHRowOfMatrix, dh_row
from .direct_kinematics import robot_from_formula
from .elementary_transforms import robot_from_transforms
from .joint_maps import JointMap, joint_map
from .placed import place_robot
from .planar import planar_arm

__all__ = [
    "DHParameters",
    "DHRowOfMatrix",
    "JointMap",
    "dh_row",
    "joint_map",
    "place_robot",
    "planar_arm",
    "robot_from_formula",
    "robot_from_transforms",
]
