"""Recorded motions from a file."""

import csv
from itertools import islice
from pathlib import Path

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.robot.model import Robot

MOST_ROWS = 2_000_000


def read_recording(path: str | Path, robot: Robot) -> tuple[Array, Array]:
    """Return instants (k,) [s] and configurations (k, n) of a CSV file.

    A row is an instant and a value of each joint [rad or m]. A first row of words names the columns: "t" or "time", and
    the joints in any order; columns of other names are left out. Without it the order is that of q.

    Raises:
        InputError: the file cannot be read, is no such table, or has no column of a joint.
    """
    try:
        with Path(path).open(newline="", encoding="utf-8-sig") as file:
            rows = [row for row in islice(csv.reader(file), MOST_ROWS) if row]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise InputError(f"{str(path)!r} cannot be read as a table: {error}") from error
    if not rows:
        raise InputError(f"{str(path)!r} has no rows")
    columns = list(range(robot.nq + 1))
    if _is_header(rows[0]):
        columns = _columns([name.strip() for name in rows.pop(0)], robot)
    values = np.array([_numbers(row, columns, i) for i, row in enumerate(rows, 1)]).reshape(-1, robot.nq + 1)
    return values[:, 0], values[:, 1:]


def _is_header(row: list[str]) -> bool:
    try:
        float(row[0])
    except ValueError:
        return True
    return False


def _columns(names: list[str], robot: Robot) -> list[int]:
    """Return the columns of the time and of each joint."""
    time = next((i for i, name in enumerate(names) if name.lower() in ("t", "time")), None)
    missing = [joint for joint in robot.joint_names if joint not in names]
    if time is None or missing:
        wanted = "t" if time is None else repr(missing[0])
        raise InputError(f"the table has no column {wanted}; its columns are {', '.join(map(repr, names[:12]))}")
    return [time, *map(names.index, robot.joint_names)]


def _numbers(row: list[str], columns: list[int], number: int) -> list[float]:
    try:
        return [float(row[column]) for column in columns]
    except (ValueError, IndexError) as error:
        raise InputError(f"row {number} of the table must be {len(columns)} numbers; it is {row[:12]}") from error
