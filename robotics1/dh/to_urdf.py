"""A DH table written as a URDF file, with shapes to look at."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from robotics1.dh.joints import joints_of, links_of
from robotics1.dh.shapes import materials, visuals
from robotics1.dh.table import DHTable
from robotics1.files import write_file
from robotics1.robot.building import WITHOUT_LIMIT
from robotics1.robot.joints import Joint

FAR = 1000.0  # m or rad: what the text says where one joint limit is missing, for URDF takes no infinity


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
    return write_file(path, urdf_text(table if isinstance(table, DHTable) else DHTable(table)))  # type: ignore[arg-type]


def urdf_text(table: DHTable) -> str:
    """Return the text of the robot: base → link0 → ... → link n → tool."""
    lines = ['<?xml version="1.0"?>', '<robot name="dh">', *materials()]
    shapes = visuals(table)
    for link in links_of(table):
        inside = [f"    {shape}" for shape in shapes.get(link, [])]
        lines += [f'  <link name="{link}">', *inside, "  </link>"] if inside else [f'  <link name="{link}"/>']
    return "\n".join([*lines, *map(_joint, joints_of(table)), "</robot>", ""])


def _joint(joint: Joint) -> str:
    xyz, rpy = (" ".join(repr(x + 0.0) for x in numbers) for numbers in (joint.xyz, joint.rpy))
    kind, limit = ("fixed", "") if joint.kind == "fixed" else _motion(joint)
    motion = f'\n    <axis xyz="0 0 1"/>{limit}' if kind != "fixed" else ""
    return (
        f'  <joint name="{joint.name}" type="{kind}">\n'
        f'    <parent link="{joint.parent}"/><child link="{joint.child}"/>\n'
        f'    <origin xyz="{xyz}" rpy="{rpy}"/>{motion}\n  </joint>'
    )


def _motion(joint: Joint) -> tuple[str, str]:
    """Return the URDF type and the limit."""
    lower, upper = joint.lower, joint.upper
    if joint.kind == "revolute" and math.isinf(lower) and math.isinf(upper):
        return "continuous", ""
    low = lower if math.isfinite(lower) else min(-FAR, upper - FAR)
    high = upper if math.isfinite(upper) else max(FAR, lower + FAR)
    low, high = (-FAR, FAR) if math.isinf(lower) and math.isinf(upper) else (low, high)
    none = f'velocity="{WITHOUT_LIMIT:g}" effort="{WITHOUT_LIMIT:g}"'
    return joint.kind, f'<limit lower="{low!r}" upper="{high!r}" {none}/>'
