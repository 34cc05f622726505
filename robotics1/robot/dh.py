"""From a DH table to a robot, and to a URDF file that any other tool reads."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from robotics1.files import write_file
from robotics1.robot.dh_markup import dh_markup
from robotics1.robot.dh_rows import Limits, checked_table
from robotics1.robot.dh_table import DHTable
from robotics1.robot.loading import robot_from_text
from robotics1.robot.model import Robot


def robot_from_dh(
    rows: Sequence[Sequence[Any]],
    *,
    parameters: Mapping[str, float] | None = None,
    convention: str = "standard",
    base_placement: Any = None,
    tool_placement: Any = None,
    lower: Limits = None,
    upper: Limits = None,
) -> Robot:
    """Return the robot with T_world_tool(q) = T_base A_1(q_1) ⋯ A_n(q_n) T_tool, with

        standard: A_i = Rot_z(θ_i) Trans_z(d_i) Trans_x(a_i) Rot_x(α_i)
        modified: A_i = Rot_x(α_{i−1}) Trans_x(a_{i−1}) Rot_z(θ_i) Trans_z(d_i)

    where q_i is added to θ_i for a revolute joint and to d_i for a prismatic one. The joints are q1, q2, ...; frame i
    of the table is the link `link{i}`, from `link0`; the world is `base` and the last frame `tool`.

    Args:
        rows: one (type, a, alpha, d, theta) a joint, type "R" or "P", a and d [m], alpha and theta [rad]; in the
            modified convention row i holds a_{i−1} and α_{i−1}. An entry may be a name, "l2", or a negated name, "-l2".
        parameters: the values of the names, which the robot keeps as `robot.parameters`.
        convention: "standard" or "modified" (Craig's).
        base_placement: T_base, a `pin.SE3` or (4, 4), of frame 0 in the world; by default the identity.
        tool_placement: T_tool, likewise, of the tool in frame n.
        lower, upper: (n,) joint limits [rad or m]; None, for all or for one, means none.

    Raises:
        InputError: a row, entry, limit or placement is wrong, or a name has no value.
        UnknownNameError: a parameter is not among the names in the rows.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.8.2; Craig, Introduction to Robotics,
    2005, section 3.6.
    """
    return _robot_of(checked_table(rows, parameters, convention, base_placement, tool_placement, lower, upper))


@dataclass(frozen=True, eq=False)
class RobotTable:
    """The table a robot was made from."""

    table: DHTable

    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Return the robot of the table with these values of its names; the others stay."""
        options = self.table.options
        options["parameters"] |= values
        return robot_from_dh(self.table.rows, **options)


def _robot_of(table: DHTable) -> Robot:
    named = bool(table.parameters)
    path = Path("dh_table.urdf.xacro" if named else "dh_table.urdf")
    robot = robot_from_text(dh_markup(table, "dh", named=named), path=path, tool="tool")
    robot.model.lowerPositionLimit, robot.model.upperPositionLimit = table.lower, table.upper
    return replace(robot, warnings=(), source=RobotTable(table))  # a table has no inertia: nothing to warn of


def dh_to_urdf(
    rows: Sequence[Sequence[Any]],
    path: str | Path,
    *,
    parameters: Mapping[str, float] | None = None,
    convention: str = "standard",
    base_placement: Any = None,
    tool_placement: Any = None,
    lower: Limits = None,
    upper: Limits = None,
) -> Path:
    """Write the robot of a DH table as a plain URDF file, with shapes to look at, and return its path.

    The names are replaced by their values. URDF takes no infinite limit: a revolute joint without limits is written
    as `continuous`; where another limit is missing, the file says ±1000 m or rad.

    Args:
        rows: as for `robot_from_dh`, and so are the options.
        path: the file; its folder exists. It is replaced as a whole.
        parameters: the values of the names.
        convention: "standard" or "modified".
        base_placement, tool_placement: `pin.SE3` or (4, 4).
        lower, upper: (n,) joint limits [rad or m].

    Raises:
        InputError, UnknownNameError: as `robot_from_dh`; or the file cannot be written there.
    """
    table = checked_table(rows, parameters, convention, base_placement, tool_placement, lower, upper)
    return write_file(path, dh_markup(table, "dh", named=False))
