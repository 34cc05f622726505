"""The public names of `robotics1.dh`, and where they are."""

from .from_robot import urdf_to_dh
from .table import DHRow, DHTable
from .to_robot import robot_from_dh
from .to_urdf import dh_to_urdf

__all__ = [
    "DHRow",
    "DHTable",
    "dh_to_urdf",
    "robot_from_dh",
    "urdf_to_dh",
]
