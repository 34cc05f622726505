"""The public names of `robotics1.rigid_motions`, and where they are."""

from .changes_of_frame import adjoint, transform_wrench
from .exponential import pose_exp, pose_log
from .product_of_exponentials import robot_from_screws, screws
from .screw import Screw, displacement_screw, twist_screw

__all__ = [
    "Screw",
    "adjoint",
    "displacement_screw",
    "pose_exp",
    "pose_log",
    "robot_from_screws",
    "screws",
    "transform_wrench",
    "twist_screw",
]
