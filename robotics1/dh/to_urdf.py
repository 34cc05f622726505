"""A DH table written as a URDF file, with shapes to look at."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pinocchio as pin

from robotics1.dh.joints import joints_of, links_of
from robotics1.dh.shapes import visuals
from robotics1.dh.table import DHTable
from robotics1.files import write_file
from robotics1.robot.urdf import Link, urdf_text


def dh_to_urdf(table: DHTable | Sequence[Sequence[Any]], path: str | Path) -> Path:
    """Write the robot of a DH table as a plain URDF file, with shapes to look at, and return its path.

    The names are replaced by their values. URDF takes no infinite limit: a revolute joint without limits is written
    as `continuous`; where another limit is missing, the file says ±1000 m or rad.

    Args:
        table: a `DHTable`; or the rows of one without names, limits and placements, in the standard convention.
        path: the file; its folder exists. It is replaced as a whole.

    Raises:
        InputError: the rows are wrong, or the file cannot be written there.
    """
    return write_file(path, dh_text(table if isinstance(table, DHTable) else DHTable(table)))  # type: ignore[arg-type]


def dh_text(table: DHTable) -> str:
    """Return the text of the robot: base → link0 → ... → link n → tool."""
    shapes = visuals(table)
    links = {name: Link(pin.Inertia.Zero(), tuple(shapes.get(name, ()))) for name in links_of(table)}
    return urdf_text("dh", links, joints_of(table))
