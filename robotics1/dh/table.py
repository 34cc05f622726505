"""A Denavit–Hartenberg table: its rows, where the arm stands, and what it carries."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any, Literal, NamedTuple, get_args

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.angles import warn_of_degrees
from robotics1.dh.entries import joint_limits, named_values, number_or_name, value_of
from robotics1.errors import InputError
from robotics1.inputs import Array, by_name, one_of, real_array
from robotics1.notation import joint_value, length, vector
from robotics1.results import Listed
from robotics1.robot.checking import MOST_DEGREES
from robotics1.robot.findings import LARGEST
from robotics1.robot.parameters import Parameters
from robotics1.robot.placements import homogeneous
from robotics1.tables import in_html, table_of

Convention = Literal["standard", "modified"]
CONVENTIONS: tuple[Convention, ...] = get_args(Convention)
X, Z = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])


class DHRow(NamedTuple):
    """One joint: type "R" or "P", a [m], alpha [rad], d [m], theta [rad]; an entry may be a name, or "-name"."""

    type: str
    a: float | str
    alpha: float | str
    d: float | str
    theta: float | str


@dataclass(frozen=True, eq=False)
class DHTable(Listed[DHRow]):
    """T_world_tool(q) = T_base A_1(q_1) ⋯ A_n(q_n) T_tool, with

        standard: A_i = Rot_z(θ_i) Trans_z(d_i) Trans_x(a_i) Rot_x(α_i)
        modified: A_i = Rot_x(α_{i−1}) Trans_x(a_{i−1}) Rot_z(θ_i) Trans_z(d_i)

    where q_i is added to θ_i for a revolute joint ("R") and to d_i for a prismatic one ("P").

    It is made of the arguments of `robot_from_dh`, and raises its errors; the attributes are what these mean.

    Attributes:
        rows: one (type, a, alpha, d, theta) a joint [m, rad]; in a modified table, row i holds a_{i−1} and α_{i−1}.
        convention: "standard" or "modified".
        base_placement: T_base, of frame 0 in the world; None for the identity.
        tool_placement: T_tool, of the tool in frame n; None for the identity.
        lower, upper: (n,) joint limits [rad or m]; ∓∞ where there is none.
        parameters: the values of the names in the rows [m or rad].
        joint_names: the joints in the robot the table was found from; q1, q2, ... otherwise.
        residual: of a table found from a robot: the largest difference between an entry of T_world_tool(q) by the
            table and by the robot, at configurations drawn at random.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.8.2; for the modified convention
    Craig, Introduction to Robotics, 2005, sections 3.4 and 3.6.
    """

    entries_in = "rows"

    rows: tuple[DHRow, ...]
    convention: str = "standard"
    base_placement: pin.SE3 = None
    tool_placement: pin.SE3 = None
    lower: Array = None  # type: ignore[assignment]  # None becomes ∓∞
    upper: Array = None  # type: ignore[assignment]
    parameters: Mapping[str, float] = field(default_factory=Parameters)
    joint_names: tuple[str, ...] = ()
    residual: float = 0.0

    def __post_init__(self) -> None:
        """Check the arguments, and copy them."""
        one_of("convention", self.convention, CONVENTIONS)
        rows = _rows(self.rows)
        lower, upper = joint_limits(self.lower, self.upper, [row.type == "R" for row in rows])
        self.__dict__.update(
            rows=rows,
            base_placement=homogeneous("base_placement", self.base_placement),
            tool_placement=homogeneous("tool_placement", self.tool_placement),
            parameters=named_values(
                [x for row in rows for x in row[1:]], by_name("parameters", self.parameters, "{'l2': 0.5}")
            ),
            joint_names=tuple(self.joint_names) or tuple(f"q{i}" for i in range(1, len(rows) + 1)),
        )
        self.__setstate__({"lower": lower, "upper": upper})
        lengths = [*self.base_placement.translation, *self.tool_placement.translation]
        for value in (*(x for row in self.numbers for x in row[1:]), *lengths):
            if abs(value) > LARGEST:
                raise InputError(f"a DH table has the number {value:g}; at most {LARGEST:g} can be computed with")
        warn_of_degrees("the DH table", np.array([(alpha, theta) for _, _, alpha, _, theta in self.numbers]))

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        for limits in (self.lower, self.upper):
            limits.flags.writeable = False

    @property
    def options(self) -> dict[str, Any]:
        """What `robot_from_dh(table.rows, **table.options)` needs beside the rows."""
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
        return value_of(entry, self.parameters)

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

    def written_rows(self) -> tuple[list[str], list[list[str]]]:
        """Return the headings and the rows as on paper, angles as multiples of π where they are."""
        shift = "" if self.convention == "standard" else "ᵢ₋₁"
        size = max(abs(x) for _, a, _, d, _ in self.numbers for x in (a, d))
        in_metres = partial(length, size=size or 1.0)
        rows = []
        for i, (kind, a, alpha, d, theta) in enumerate(self.rows, 1):
            turn, slide = _written(theta, joint_value), _written(d, in_metres)
            q_i = f"q{i}"
            turn, slide = (_with_offset(q_i, turn), slide) if kind == "R" else (turn, _with_offset(q_i, slide))
            rows.append([str(i), kind, _written(a, in_metres), _written(alpha, joint_value), slide, turn])
        return ["i", "type", f"a{shift}", f"α{shift}", "d", "θ"], rows

    def _repr_html_(self) -> str:
        """The table for a notebook, with the placements and lengths below it."""
        head, rows = self.written_rows()
        return in_html("\n".join(self._constants()), [table_of(head, rows, f"{self.convention} DH table")])

    def _repr_latex_(self) -> str:
        """The table in LaTeX."""
        _, rows = self.written_rows()
        shift = "" if self.convention == "standard" else "_{i-1}"
        head = rf"i & & a{shift} & \alpha{shift} & d & \theta"
        body = [" & ".join(map(_latex, row)) for row in rows]
        return rf"$$\begin{{array}}{{cccccc}} {head} \\ \hline " + r" \\ ".join(body) + r" \end{array}$$"

    def __str__(self) -> str:
        """The table as on paper."""
        headings, rows = self.written_rows()
        lines = [headings, *rows]
        widths = [max(map(len, column)) for column in zip(*lines, strict=True)]
        table = ["  ".join(map(str.ljust, line, widths)).rstrip() for line in lines]
        return "\n".join([f"{self.convention} DH table", *table, *self._constants()])

    def _constants(self) -> list[str]:
        """Return the placements that are not the identity, and the values of the names."""
        placements = [("base", self.base_placement), ("tool", self.tool_placement)]
        constants = [f"{name}: {placement_text(T)}" for name, T in placements if not T.isIdentity(1e-12)]
        return [*constants, *(f"{name} = {value:g}" for name, value in self.parameters.items())]


def screw(axis: Array, angle: float, length: float) -> pin.SE3:
    """Return the turn by `angle` [rad] about an axis through the origin, with the shift by `length` [m] along it."""
    return pin.SE3(pin.exp3(angle * axis), length * axis)


def _written(value: float | str, written: Callable[[float], str]) -> str:
    return value if isinstance(value, str) else written(value)


def _latex(text: str) -> str:
    """Return an entry of a table in LaTeX: numbers, π, and names, whose underscores are escaped."""
    return text.replace("π", r"\pi ").replace("−", "-").replace("_", r"\_")


def _with_offset(joint: str, offset: str) -> str:
    signed = f"− {offset[1:]}" if offset[0] in "-−" else f"+ {offset}"
    return joint if offset == "0" else f"{joint} {signed}"


def placement_text(T: pin.SE3) -> str:
    """Return the position [m] and the roll, pitch and yaw [rad] of a placement."""
    turn = ", ".join(joint_value(float(angle)) for angle in pin.rpy.matrixToRpy(T.rotation))
    return f"p = {vector(T.translation)}, rpy = ({turn})"


# --- what a caller writes


def _rows(rows: Sequence[Sequence[Any]]) -> tuple[DHRow, ...]:
    try:
        listed = [(row,) if isinstance(row, str) else tuple(row) for row in rows]
    except TypeError as error:
        raise InputError(f"rows must be a list of (type, a, alpha, d, theta), not {rows!r}") from error
    if not listed:
        raise InputError("a DH table needs at least one row (type, a, alpha, d, theta)")
    if len(listed) > MOST_DEGREES:
        raise InputError(f"a DH table has {len(listed)} rows; at most {MOST_DEGREES} can be computed with")
    return tuple(_row(i, row) for i, row in enumerate(listed, 1))


def _row(i: int, row: tuple[Any, ...]) -> DHRow:
    if len(row) != len(DHRow._fields) or row == DHRow._fields:  # the keys of a mapping
        found = ", ".join(map(str, row))
        raise InputError(f"row {i} must be (type, a, alpha, d, theta), such as ('R', 0.3, 0, 0, 0); it is ({found})")
    if not isinstance(row[0], str) or row[0] not in ("R", "P"):
        raise InputError(f"the type of row {i} must be 'R' (revolute) or 'P' (prismatic); it is {row[0]!r}")
    entries = [
        number_or_name(f"{name} of row {i}", value) for name, value in zip(DHRow._fields[1:], row[1:], strict=True)
    ]
    for name, value in zip(("alpha", "theta"), (entries[1], entries[3]), strict=True):
        if not isinstance(value, str) and abs(value) > 2 * math.pi:
            raise InputError(
                f"{name} of row {i} is {value:g}, more than a turn: angles are in radians; write radians({value:g})"
            )
    return DHRow(str(row[0]), *entries)
