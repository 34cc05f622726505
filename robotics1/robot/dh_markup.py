"""A DH table written as URDF, or as xacro when its entries are names.

Each A_i is two screws, and each screw is one URDF joint, so that every entry of the table stands alone in the text:

    standard: link i−1 ──(d, θ) and q_i──> link i_z ──(a, α)──> link i
    modified: link i−1 ──(a, α)──> link i_x ──(d, θ) and q_i──> link i

Rot_z(θ) Trans_z(d) commutes with the motion about or along z, so the constant part may come first, as URDF wants it.
"""

import math

import numpy as np
import pinocchio as pin

from robotics1.robot.building import WITHOUT_LIMIT
from robotics1.robot.dh_shapes import links_of_row, materials, visuals
from robotics1.robot.dh_table import DHTable

FAR = 1000.0  # m or rad: what the text says where one joint limit is missing, for URDF takes no infinity


def dh_markup(table: DHTable, name: str, *, named: bool) -> str:
    """Return the text of the robot: base → link0 → ... → link n → tool.

    Args:
        table: what to write.
        name: the robot's name.
        named: whether names stay names, as xacro arguments, or are replaced by their values.
    """
    rows = table.rows if named else table.numbers
    joints = [_joint("base_mount", "fixed", "base", "link0", *_origin(table.base_placement))]
    for i, (kind, a, alpha, d, theta) in enumerate(rows, 1):
        previous, half, link = links_of_row(table.convention, i)
        along_z, along_x = (f"0 0 {_text(d)}", f"0 0 {_text(theta)}"), (f"{_text(a)} 0 0", f"{_text(alpha)} 0 0")
        urdf_type, limit = _motion(kind, table.lower[i - 1], table.upper[i - 1])
        if table.convention == "standard":
            joints.append(_joint(f"q{i}", urdf_type, previous, half, *along_z, limit))
            joints.append(_joint(f"x{i}", "fixed", half, link, *along_x))
        else:
            joints.append(_joint(f"x{i}", "fixed", previous, half, *along_x))
            joints.append(_joint(f"q{i}", urdf_type, half, link, *along_z, limit))
    joints.append(_joint("tool_mount", "fixed", f"link{len(rows)}", "tool", *_origin(table.tool_placement)))
    xmlns = ' xmlns:xacro="http://www.ros.org/wiki/xacro"' if named else ""
    lines = ['<?xml version="1.0"?>', f'<robot name="{name}"{xmlns}>', *(_arguments(table) if named else [])]
    return "\n".join([*lines, *materials(), *_links(table), *joints, "</robot>", ""])


def _arguments(table: DHTable) -> list[str]:
    """Return the lines that declare the names and their values."""
    return [
        f'  <xacro:arg name="{name}" default="{value!r}"/><xacro:property name="{name}" value="$(arg {name})"/>'
        for name, value in table.parameters.items()
    ]


def _links(table: DHTable) -> list[str]:
    names = ["base", "link0"]
    for i in range(1, len(table.rows) + 1):
        names += links_of_row(table.convention, i)[1:]
    shapes = visuals(table)
    lines = []
    for name in [*names, "tool"]:
        inside = [f"    {shape}" for shape in shapes.get(name, [])]
        lines += [f'  <link name="{name}">', *inside, "  </link>"] if inside else [f'  <link name="{name}"/>']
    return lines


def _joint(name: str, urdf_type: str, parent: str, child: str, xyz: str, rpy: str, limit: str = "") -> str:
    motion = f'\n    <axis xyz="0 0 1"/>{limit}' if urdf_type != "fixed" else ""
    return (
        f'  <joint name="{name}" type="{urdf_type}">\n    <parent link="{parent}"/><child link="{child}"/>\n'
        f'    <origin xyz="{xyz}" rpy="{rpy}"/>{motion}\n  </joint>'
    )


def _motion(kind: str, lower: float, upper: float) -> tuple[str, str]:
    """Return the URDF type and the limit."""
    if kind == "R" and math.isinf(lower) and math.isinf(upper):
        return "continuous", ""
    low = lower if math.isfinite(lower) else min(-FAR, upper - FAR)
    high = upper if math.isfinite(upper) else max(FAR, lower + FAR)
    low, high = (-FAR, FAR) if math.isinf(lower) and math.isinf(upper) else (low, high)
    limits = f'lower="{float(low)!r}" upper="{float(high)!r}"'
    none = f'velocity="{WITHOUT_LIMIT:g}" effort="{WITHOUT_LIMIT:g}"'
    return "revolute" if kind == "R" else "prismatic", f"<limit {limits} {none}/>"


def _origin(T: pin.SE3) -> tuple[str, str]:
    """Return the xyz and rpy of a constant placement."""
    return tuple(  # type: ignore[return-value]
        " ".join(_text(float(value)) for value in values)
        for values in (np.array(T.translation), pin.rpy.matrixToRpy(T.rotation))
    )


def _text(entry: float | str) -> str:
    """Return an entry with every digit, or as an expression of its name."""
    return f"${{{entry}}}" if isinstance(entry, str) else repr(entry + 0.0)
