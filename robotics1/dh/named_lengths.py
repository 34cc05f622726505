"""Entries of a Denavit–Hartenberg table that are named lengths of the robot, such as l2 for 0.5."""

from dataclasses import replace
from typing import cast

from robotics1.dh.from_robot import urdf_to_dh
from robotics1.dh.table import Convention, DHRow, DHTable
from robotics1.errors import Robotics1Error
from robotics1.robot.model import Robot

CHANGES = (1.25, 1.5)  # of one length, at which the table is made again
SAME = 1e-9  # of the largest named length

Lengths = dict[str, float]


def with_named_lengths(table: DHTable, robot: Robot, frame: str | None = None) -> DHTable:
    """Return a table of `urdf_to_dh` with "l2" or "-l2" for each a and d that is this length of the robot.

    The table is made again with other values of each length: an entry is its name if it has the length's value each
    time, and does not change with any other length. Where a table cannot be made, or has other angles, it stays as it
    is.
    """
    tried = [dict(robot.parameters)]
    for name, value in robot.parameters.items():
        tried += [{**robot.parameters, name: factor * value} for factor in CHANGES]
    try:
        tables = [
            urdf_to_dh(robot.with_parameters(lengths), tool=frame, convention=cast("Convention", table.convention))
            for lengths in tried
        ]
    except Robotics1Error:
        return table
    if any(len(other.rows) != len(table.rows) for other in tables):
        return table
    rows = []
    for i, row in enumerate(table.rows):
        a, d = ([float(other.numbers[i][k]) for other in tables] for k in (1, 3))
        rows.append(DHRow(row.type, _name(a, tried), row.alpha, _name(d, tried), row.theta))
    written = {entry.removeprefix("-") for row in rows for entry in (row.a, row.d) if isinstance(entry, str)}
    used = {name: value for name, value in robot.parameters.items() if name in written}
    return replace(table, rows=tuple(rows), parameters=used)


def _name(values: list[float], tried: list[Lengths]) -> float | str:
    """Return the name that has these values at the lengths that were tried, with its sign; the first value without."""
    near = SAME * max(map(abs, tried[0].values()), default=1.0)
    if abs(values[0]) < near:
        return values[0]
    for name in tried[0]:
        for sign, written in ((1.0, name), (-1.0, f"-{name}")):
            if all(abs(x - sign * lengths[name]) < near for x, lengths in zip(values, tried, strict=True)):
                return written
    return values[0]
