"""A robot in tables: its joints and limits, its tips, its lengths."""

from typing import Any

import numpy as np

from robotics1.names import printable
from robotics1.notation import count, joint_value
from robotics1.results import Shown
from robotics1.robot.joints import Joint, tips
from robotics1.tables import MORE, Table, table_of

LETTERS = {"revolute": "R", "prismatic": "P"}
MOST = 12  # letters of joints


class DescribedRobot(Shown):
    """How a robot is shown: in one line, in sentences, and with a table of its joints."""

    def __repr__(self) -> str:
        robot: Any = self
        number = len(robot.moving_joints)
        shown = f" {letters(robot)}" if 0 < number <= MOST else ""
        values = "".join(f", {name}={value:g}" for name, value in list(robot.parameters.items())[:4])
        return printable(f"Robot({robot.name!r}, {count(number, 'joint')}{shown}, tool={robot.tool!r}{values})")

    def _sentences(self) -> str:
        """Return what the robot is, its tool, tips and lengths, and what is odd about its file."""
        robot: Any = self
        ends = ", ".join(tips(robot.frame_names, robot.joints))
        lines = [
            f"{robot.name}: {count(robot.nv, 'degree')} of freedom",
            f"tool: {robot.tool or 'open, name it with tool='}; tips: {ends}",
        ]
        if robot.parameters:
            lines.append("lengths: " + ", ".join(f"{name} = {value:g} m" for name, value in robot.parameters.items()))
        meshes = [text for text in robot.warnings if text.startswith("mesh ")]
        lines += [f"warning: {text}" for text in robot.warnings if text not in meshes]
        if meshes:
            more = f"; and {len(meshes) - 1} more about meshes, in robot.warnings" if meshes[1:] else ""
            lines.append(f"warning: {meshes[0]}{more}")
        return printable("\n".join(lines), keep="\n")

    def _tables(self) -> tuple[Table, ...]:
        table = joint_table(self)
        return (table,) if table.rows else ()

    def _drawings(self) -> list[str]:
        return [shown for make in MORE.get("Robot", ()) if (shown := make(self))]


def letters(robot: Any) -> str:
    """Return the moving joints as letters, as in PRR, and others by name; more than a dozen as their number."""
    kinds = [LETTERS.get(joint.kind, joint.kind) for joint in robot.moving_joints]
    if len(kinds) > MOST:
        return f"{len(kinds)} joints"
    return ("" if all(len(kind) == 1 for kind in kinds) else "-").join(kinds)


def joint_table(robot: Any) -> Table:
    """Return the moving joints with kind, axis and limits."""
    rows = []
    for joint in robot.moving_joints:
        number = robot.own_model.getJointId(joint.name)
        limits, rates = ["", ""], ["", ""]
        if joint.kind in LETTERS:
            i, j = robot.own_model.idx_qs[number], robot.own_model.idx_vs[number]
            limits = [_limit(robot.lower[i], joint), _limit(robot.upper[i], joint)]
            rates = [_bound(robot.max_velocity[j]), _bound(robot.max_effort[j])]
        rows.append((printable(joint.name), _kind(joint), *limits, *rates))
    return table_of(("joint", "kind", "lower", "upper", "velocity", "effort"), rows)


def _kind(joint: Joint) -> str:
    """Return what a joint is, in words."""
    if joint.kind not in LETTERS:
        return joint.kind
    aligned = [name for name, unit in zip("xyz", np.eye(3), strict=True) if np.abs(joint.axis - unit).max() <= 1e-12]
    if not aligned:
        return f"{joint.kind}, skew axis"
    return f"{joint.kind} {'about' if joint.kind == 'revolute' else 'along'} {aligned[0]}"


def _limit(value: float, joint: Joint) -> str:
    """Return a limit in its unit, or none."""
    turns = joint.kind == "revolute" and np.isfinite(value)
    return joint_value(float(value)) if turns else _bound(value)


def _bound(value: float) -> str:
    return f"{value:g}" if np.isfinite(value) else "none"
