"""A Denavit–Hartenberg table: its rows, where the arm stands, and what it carries."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.inputs import Array, real_array
from robotics1.notation import joint_value, number, vector
from robotics1.robot.parameters import Parameters

CONVENTIONS = ("standard", "modified")
X, Z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])


class DHRow(NamedTuple):
    """One joint: type "R" or "P", a [m], alpha [rad], d [m], theta [rad]; an entry may be a name, or "-name"."""

    type: str
    a: float | str
    alpha: float | str
    d: float | str
    theta: float | str


@dataclass(frozen=True, eq=False)
class DHTable:
    """T_world_tool(q) = T_base A_1(q_1) ⋯ A_n(q_n) T_tool, with

        standard: A_i = Rot_z(θ_i) Trans_z(d_i) Trans_x(a_i) Rot_x(α_i)
        modified: A_i = Rot_x(α_{i−1}) Trans_x(a_{i−1}) Rot_z(θ_i) Trans_z(d_i)

    where q_i is added to θ_i for a revolute joint ("R") and to d_i for a prismatic one ("P").

    Attributes:
        rows: one (type, a, alpha, d, theta) a joint [m, rad]; in a modified table, row i holds a_{i−1} and α_{i−1}.
        convention: "standard" or "modified".
        base_placement: T_base, of frame 0 in the world.
        tool_placement: T_tool, of the tool in frame n.
        lower, upper: (n,) joint limits [rad or m]; ∓∞ where there is none.
        parameters: the values of the names in the rows [m or rad].
        joint_names: the joints in the robot the table was found from; q1, q2, ... otherwise.
        residual: of a table found from a robot: the largest difference between an entry of T_world_tool(q) by the
            table and by the robot, at configurations drawn at random.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.8.2; for the modified convention
    Craig, Introduction to Robotics, 2005, sections 3.4 and 3.6.
    """

    rows: tuple[DHRow, ...]
    convention: str
    base_placement: pin.SE3
    tool_placement: pin.SE3
    lower: Array
    upper: Array
    parameters: Mapping[str, float] = field(default_factory=Parameters)
    joint_names: tuple[str, ...] = ()
    residual: float = 0.0

    @property
    def options(self) -> dict[str, Any]:
        """What `robot_from_dh(table.rows, **table.options)` and `dh_to_urdf` need beside the rows."""
        return {
            "convention": self.convention,
            "base_placement": self.base_placement,
            "tool_placement": self.tool_placement,
            "parameters": dict(self.parameters),
            "lower": self.lower,
            "upper": self.upper,
        }

    @property
    def numbers(self) -> tuple[tuple[str, float, float, float, float], ...]:
        """The rows, with the values of their names."""
        return tuple((row.type, *(self.value(entry) for entry in row[1:])) for row in self.rows)  # type: ignore[misc]

    def value(self, entry: float | str) -> float:
        """Return the number that an entry stands for."""
        if not isinstance(entry, str):
            return entry
        name = entry.removeprefix("-")
        return -self.parameters[name] if entry.startswith("-") else self.parameters[name]

    def pose(self, q: npt.ArrayLike) -> pin.SE3:
        """Return T_world_tool(q), the product of the matrices of the table, for q (n,) [rad or m].

        Raises:
            InputError: q has the wrong shape or is not finite.
        """
        q = real_array("q", q, (len(self.rows),), "one number for each row")
        T = self.base_placement
        for (kind, a, alpha, d, theta), q_i in zip(self.numbers, q, strict=True):
            along_z = screw(Z, theta + q_i, d) if kind == "R" else screw(Z, theta, d + q_i)
            along_x = screw(X, alpha, a)
            T = T * along_z * along_x if self.convention == "standard" else T * along_x * along_z
        return T * self.tool_placement

    def __str__(self) -> str:
        """The table as on paper, angles as multiples of π where they are."""
        shift = "" if self.convention == "standard" else "ᵢ₋₁"
        lines = [["i", "type", f"a{shift}", f"α{shift}", "d", "θ"]]
        for i, (kind, a, alpha, d, theta) in enumerate(self.rows, 1):
            turn, slide = _entry(theta, joint_value), _entry(d, number)
            if kind == "R":
                turn = _with_offset(f"q{i}", turn)
            else:
                slide = _with_offset(f"q{i}", slide)
            lines.append([str(i), kind, _entry(a, number), _entry(alpha, joint_value), slide, turn])
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        table = ["  ".join(map(str.ljust, line, widths)).rstrip() for line in lines]
        placements = [("base", self.base_placement), ("tool", self.tool_placement)]
        constants = [f"{name}: {_placement(T)}" for name, T in placements if not T.isIdentity(1e-12)]
        values = [f"{name} = {value:g}" for name, value in self.parameters.items()]
        return "\n".join([f"{self.convention} DH table", *table, *constants, *values])


def screw(axis: Array, angle: float, length: float) -> pin.SE3:
    """Return the turn by `angle` [rad] about an axis through the origin, with the shift by `length` [m] along it."""
    return pin.SE3(pin.exp3(angle * axis), length * axis)


def _entry(value: float | str, written: Callable[[float], str]) -> str:
    return value if isinstance(value, str) else written(value)


def _with_offset(joint: str, offset: str) -> str:
    if offset == "0":
        return joint
    return f"{joint} − {offset[1:]}" if offset[0] in "-−" else f"{joint} + {offset}"


def _placement(T: pin.SE3) -> str:
    turn = ", ".join(joint_value(float(angle)) for angle in pin.rpy.matrixToRpy(T.rotation))
    return f"p = {vector(T.translation)}, rpy = ({turn})"
