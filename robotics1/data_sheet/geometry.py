"""Sections of what the file says: joints and limits, Denavit–Hartenberg tables, warnings, versions."""

import platform
from importlib.metadata import version

import numpy as np

from robotics1.data_sheet.asked import Answer, Asked
from robotics1.data_sheet.markup import folded, note, paragraphs, table
from robotics1.dh.from_robot import urdf_to_dh
from robotics1.dh.named_lengths import with_named_lengths
from robotics1.dh.table import DHTable, placement_text
from robotics1.notation import count, enumeration, joint_value

RESIDUAL = 1e-9  # of a DH table: the difference that is rounding
DH_TITLES = {"standard": "standard: A = Z(θ, d) X(a, α)", "modified": "modified (Craig): A = X(a, α) Z(θ, d)"}
LIBRARIES = ("robotics1", "pin", "numpy", "scipy", "sympy", "numba", "python-flint")


def joints(asked: Asked) -> Answer:
    """Return the joints with their limits, and those that follow others or do not move the tool."""
    robot = asked.robot
    limits = zip(robot.moving_joints, robot.lower, robot.upper, robot.max_velocity, robot.max_effort, strict=True)
    moving = {joint.leader for joint in robot.joints_to(asked.frame) if joint.kind != "fixed"}
    rows = [
        (
            f"q{i}",
            joint.name,
            joint.kind,
            _range(low, high, joint.kind),
            _limit(speed, "rad/s" if joint.kind == "revolute" else "m/s"),
            _limit(effort, "N m" if joint.kind == "revolute" else "N"),
        )
        for i, (joint, low, high, speed, effort) in enumerate(limits, 1)
    ]
    kinds = [joint.kind for joint in robot.moving_joints]
    parts = [count(kinds.count(kind), f"{kind} joint") for kind in dict.fromkeys(kinds)]
    followers = [
        (joint.name, _followed(joint.multiplier, joint.leader, joint.offset)) for joint in robot.joints if joint.follows
    ]
    lines = [f"{name} = {value:g}" for name, value in robot.parameters.items()]
    text = table(("", "joint", "kind", "range", "speed", "effort"), rows) if rows else paragraphs("No joint moves.")
    text += table(("joint that follows", "its value"), followers) if followers else ""
    still = [joint.name for joint in robot.moving_joints if joint.name not in moving]
    text += paragraphs(f"The tool is not moved by {enumeration(still)}." if still else "")
    text += paragraphs(f"Named lengths: {', '.join(lines)} [m]." if lines else "")
    reach = f"; the tool is at most {robot.reach:.4g} m from the first joint" if np.isfinite(robot.reach) else ""
    return Answer(text, (", ".join(parts) or "no joint moves") + reach)


def _followed(multiplier: float, leader: str, offset: float) -> str:
    """Return m q + b as it is written."""
    product = leader if multiplier == 1 else f"{multiplier:g} · {leader}"
    return product if offset == 0 else f"{product} {'+' if offset > 0 else '−'} {abs(offset):g}"


def _range(low: float, high: float, kind: str) -> str:
    if not np.isfinite([low, high]).any():
        return "no limits"
    ends = [joint_value(x) if np.isfinite(x) else "∞" for x in (low, high)]
    unit = "m" if kind != "revolute" else f"rad ({np.degrees(low):.4g}° to {np.degrees(high):.4g}°)"
    return f"{ends[0]} to {ends[1]} {unit}"


def _limit(value: float, unit: str) -> str:
    return f"{value:.4g} {unit}" if np.isfinite(value) else "no limit"


def dh_tables(asked: Asked) -> Answer:
    """Return the table of both conventions, with what stands before and after it."""
    tables = [
        urdf_to_dh(asked.robot, tool=asked.frame, convention=convention) for convention in ("standard", "modified")
    ]
    worst = max(found.residual for found in tables)
    if asked.robot.parameters:
        tables = [with_named_lengths(found, asked.robot, asked.frame) for found in tables]
    text = f'<div class="side">{"".join(_dh(found) for found in tables)}</div>'
    if worst > RESIDUAL:
        text += note(f"The tables differ from the file by at most {worst:.1e} in an entry of the pose.")
    return Answer(text)


def _dh(found: DHTable) -> str:
    heading, rows = found.written_rows()
    text = table(heading, rows, f"{DH_TITLES[found.convention]}; lengths in m, angles in rad")
    placements = (("base", found.base_placement), ("tool", found.tool_placement))
    text += paragraphs(*(f"{name}: {placement_text(T)}" for name, T in placements if not T.isIdentity(RESIDUAL)))
    return f"<div>{text}</div>"


def origin(asked: Asked) -> Answer:
    """Return what is odd about the file, and what computed the sheet."""
    robot = asked.robot
    file = robot.path.name if robot.path is not None else "made without a file"
    warnings = "".join(paragraphs(warning) for warning in robot.warnings)
    rows = [(name, version(name)) for name in LIBRARIES] + [("Python", platform.python_version())]
    text = table(("", ""), [("source", file), ("tool", asked.frame or robot.tool or "the last link")])
    text += warnings or paragraphs("Nothing in the file is odd.")
    fact = f"{file}: {count(len(robot.warnings), 'warning') if robot.warnings else 'nothing is odd'}"
    return Answer(text + folded("Versions", table(("library", "version"), rows)), fact)
