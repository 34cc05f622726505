"""A DH table written as a URDF file, with shapes to look at.

Drums stand at the revolute joints, sleeves at the prismatic ones, and rods lead from joint to joint.
"""

import math
import xml.etree.ElementTree as ET
from collections import defaultdict
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.dh.joints import joints_of, links_of, links_of_row
from robotics1.dh.table import DHTable, X, Z
from robotics1.files import check_suffix, write_file
from robotics1.inputs import Array
from robotics1.robot.urdf import Link, element, urdf_text

MATERIALS = {
    "base": "0.55 0.58 0.62 1",
    "joint": "0.18 0.20 0.24 1",
    "link": "0.13 0.42 0.71 1",
    "slide": "0.93 0.55 0.14 1",
    "tip": "0.80 0.15 0.15 1",
}


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
    check_suffix("a robot", path, (".urdf", ".xml"))
    return write_file(path, dh_text(table if isinstance(table, DHTable) else DHTable(table)))  # type: ignore[arg-type]


def dh_text(table: DHTable) -> str:
    """Return the text of the robot: base → link0 → ... → link n → tool."""
    shapes = _visuals(table)
    links = {name: Link(pin.Inertia.Zero(), tuple(shapes.get(name, ()))) for name in links_of(table)}
    return urdf_text("dh", links, joints_of(table))


def _visuals(table: DHTable) -> dict[str, list[ET.Element]]:
    """Return link → its elements <visual>; the links are those of `links_of`."""
    size = _size(table)
    w = 0.03 * size  # the radius of a drum
    shapes: dict[str, list[ET.Element]] = defaultdict(list)
    shapes["base"].append(_rod(-w * Z, 0 * Z, 1.5 * w, "base"))
    shapes["base"] += _rods(0 * Z, table.base_placement.translation, w / 2, "base")
    n = len(table.rows)
    for i, (kind, a, _, d, _) in enumerate(table.numbers, 1):
        previous, half, link = links_of_row(table.convention, i)
        fixed, moving, along_x = (previous, half, half) if table.convention == "standard" else (half, link, previous)
        if kind == "R":
            shapes[moving].append(_rod(-(d + w) * Z, (w - d) * Z, w, "joint"))
            shapes[moving] += _rods(-d * Z, 0 * Z, w / 2, "link")
        else:
            back, front = _travel(d, table.lower[i - 1], table.upper[i - 1], size / 2)
            shapes[fixed].append(_visual(element("box", size=" ".join([f"{1.5 * w:.6g}"] * 3)), "joint"))
            shapes[moving] += _rods(-back * Z, front * Z, w / 2, "slide")
        shapes[along_x] += _rods(0 * X, a * X, w / 2, "link")
    shapes[f"link{n}"] += _rods(0 * Z, table.tool_placement.translation, w / 2, "link")
    shapes["tool"].append(_visual(element("sphere", radius=f"{0.8 * w:.6g}"), "tip"))
    return dict(shapes)


def _size(table: DHTable) -> float:
    """Return the sum of the lengths [m], or 1 when there is none to see."""
    lengths = [abs(a) + abs(d) for _, a, _, d, _ in table.numbers]
    constants = [float(np.linalg.norm(T.translation)) for T in (table.base_placement, table.tool_placement)]
    size = sum(lengths) + sum(constants)
    return size if size > 1e-6 else 1.0


def _travel(d: float, lower: float, upper: float, unlimited: float) -> tuple[float, float]:
    """Return how far a sliding rod reaches behind and before its frame, so that it never leaves its sleeve."""
    furthest = d + upper if math.isfinite(upper) else max(d, 0.0) + unlimited
    nearest = d + lower if math.isfinite(lower) else min(d, 0.0)
    return max(furthest, 0.0), max(-nearest, 0.0)


def _rods(start: Array, end: Array, radius: float, material: str) -> list[ET.Element]:
    return [_rod(start, end, radius, material)] if np.linalg.norm(end - start) > 1e-9 else []


def _rod(start: Array, end: Array, radius: float, material: str) -> ET.Element:
    """Return a cylinder between two points."""
    along = end - start
    length = float(np.linalg.norm(along))
    rpy = pin.rpy.matrixToRpy(pin.Quaternion.FromTwoVectors(Z, along / length).toRotationMatrix())
    centre = (start + end) / 2
    shape = element("cylinder", radius=f"{radius:.6g}", length=f"{length:.6g}")
    return _visual(shape, material, element("origin", xyz=_rounded(centre), rpy=_rounded(rpy)))


def _visual(shape: ET.Element, material: str, *origin: ET.Element) -> ET.Element:
    color = element("color", rgba=MATERIALS[material])
    return element("visual", *origin, element("geometry", shape), element("material", color, name=material))


def _rounded(values: Array) -> str:
    return " ".join(f"{value + 0.0:.6g}" for value in np.round(values, 9))
