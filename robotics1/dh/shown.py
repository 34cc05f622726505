"""What a robot shows of its DH tables in a notebook."""

from robotics1.dh.from_robot import urdf_to_dh
from robotics1.errors import Robotics1Error
from robotics1.robot.model import Robot


def folded_tables(robot: Robot) -> str:
    """Return the standard and the modified DH table as HTML, folded; nothing of a robot that has none."""
    try:
        tables = [urdf_to_dh(robot), urdf_to_dh(robot, convention="modified")]
    except Robotics1Error:  # an open tool, or a joint on the way to it that no row describes
        return ""
    shown = "".join(table._repr_html_() for table in tables)
    return f"<details><summary>DH tables, standard and modified</summary>{shown}</details>"
