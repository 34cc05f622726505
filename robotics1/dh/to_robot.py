"""From a DH table to a robot."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import pi
from pathlib import Path
from typing import Any

import pinocchio as pin

from robotics1.angles import printed_twelfths_of_pi
from robotics1.dh.entries import Limits
from robotics1.dh.joints import joints_of, links_of, placements_of
from robotics1.dh.table import Convention, DHTable
from robotics1.dh.to_urdf import dh_text
from robotics1.errors import InputError
from robotics1.notation import joint_value
from robotics1.robot.building import build_model
from robotics1.robot.model import Robot
from robotics1.robot.parameters import Placements


def robot_from_dh(
    rows: Sequence[Sequence[Any]] | DHTable,
    *,
    parameters: Mapping[str, float] | None = None,
    convention: Convention = "standard",
    base_placement: Any = None,
    tool_placement: Any = None,
    lower: Limits = None,
    upper: Limits = None,
) -> Robot:
    """Return the robot with T_world_tool(q) = T_base A_1(q_1) ⋯ A_n(q_n) T_tool, with

        standard: A_i = Rot_z(θ_i) Trans_z(d_i) Trans_x(a_i) Rot_x(α_i)
        modified: A_i = Rot_x(α_{i−1}) Trans_x(a_{i−1}) Rot_z(θ_i) Trans_z(d_i)

    where q_i is added to θ_i for a revolute joint and to d_i for a prismatic one. An angle printed with three decimals
    or more, as 1.5708, is the multiple of π/12 that it rounds; `robot.warnings` says so. The joints are q1, q2, ...;
    frame i of the table is the link `link{i}`, from `link0`; the world is `base` and the last frame `tool`.

    Args:
        rows: one (type, a, alpha, d, theta) a joint, type "R" or "P", a and d [m], alpha and theta [rad]; in the
            modified convention row i holds a_{i−1} and α_{i−1}. An entry may be a name, "l2", or a negated name, "-l2".
            Also a `DHTable`, as `urdf_to_dh` returns it: it holds all other arguments, and its angles stay as they are.
        parameters: the values of the names, which the robot keeps as `robot.parameters`.
        convention: "standard" or "modified" (Craig's).
        base_placement: T_base, a `pin.SE3` or (4, 4), of frame 0 in the world; by default the identity.
        tool_placement: T_tool, likewise, of the tool in frame n.
        lower, upper: (n,) joint limits [rad or m]; None, for all or for one, means none.

    Raises:
        InputError: a row, entry, limit or placement is wrong, or a name has no value.
        UnknownNameError: a parameter is not among the names in the rows.

    Warns:
        RobotWarning: a limit of a revolute joint is a whole or half number from 40 to 720, as if in degrees.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.8.2; Craig, Introduction to Robotics,
    2005, section 3.6.
    """
    if isinstance(rows, DHTable):
        if (
            parameters
            or convention != "standard"
            or any(option is not None for option in (base_placement, tool_placement, lower, upper))
        ):
            raise InputError("a DHTable holds its options; change one by dataclasses.replace(table, tool_placement=T)")
        return robot_of(rows)
    table = DHTable(rows, convention, base_placement, tool_placement, lower, upper, parameters or {})  # type: ignore[arg-type]
    meant, sentences = _printed_angles(table)
    return robot_of(meant, sentences)


def _printed_angles(table: DHTable) -> tuple[DHTable, tuple[str, ...]]:
    """Return the table with multiples of π/12 in place of angles that round them, and a sentence about each."""
    rows, sentences = [], []
    for i, row in enumerate(table.rows, 1):
        exact: dict[str, Any] = {}
        for name in ("alpha", "theta"):
            angle = getattr(row, name)
            k = None if isinstance(angle, str) else printed_twelfths_of_pi(angle)
            if k is not None:
                exact[name] = k * pi / 12
                sentences.append(f"{name} of row {i} is {angle!r}, which is read as {joint_value(exact[name])}")
        rows.append(row._replace(**exact))
    return (replace(table, rows=tuple(rows)) if sentences else table), tuple(sentences)


def robot_of(table: DHTable, warnings: tuple[str, ...] = ()) -> Robot:
    """Return the robot of a table; the text of its URDF has shapes to look at."""
    joints = joints_of(table)
    model = build_model("dh", dict.fromkeys(links_of(table), pin.Inertia.Zero()), joints)
    source = RobotTable(table, warnings)
    return Robot("dh", model, joints, "tool", table.parameters, dh_text(table), Path("dh_table.urdf"), warnings, source)


@dataclass(frozen=True, eq=False)
class RobotTable:
    """The table a robot was made from, and what is said about it."""

    table: DHTable
    warnings: tuple[str, ...] = ()

    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Return the robot of the table with these values of its names; the others stay."""
        return robot_of(replace(self.table, parameters={**self.table.parameters, **values}), self.warnings)

    def placements(self, robot: Robot) -> Placements:
        """Return the placements of the joints as polynomials in the names."""
        return placements_of(self.table)
