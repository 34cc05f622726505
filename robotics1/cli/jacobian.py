"""The numbers of `robotics1 jacobian`."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from rich.console import Console

from robotics1.cli import output
from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.notation import enumeration, number, vector
from robotics1.report.tables import matrix_table
from robotics1.robot.model import Robot
from robotics1.singularities.explain import directions
from robotics1.singularities.rounding import RoundedConfiguration, rounded_configuration
from robotics1.singularities.spaces import Subspaces
from robotics1.symbolic.kinematics.points import with_point
from robotics1.symbolic.tasks.formula import row_places
from robotics1.tasks.task import FrameTask


def print_jacobian(
    console: Console,
    robot: Robot,
    task: FrameTask,
    q: Array,
    *,
    name: str,
    point: Sequence[float | str] | None,
    rows: Sequence[str] | None,
    degrees: bool,
    json: bool,
) -> None:
    """Print J at a configuration, its rank, determinant and subspaces; of a point of the frame, of chosen rows.

    Raises:
        InputError: the point has names without a value, or is none; the rows are none.
    """
    if point is not None:
        robot, task = _at_point(robot, task, point)
    places = list(row_places(task, rows))
    row_names = tuple(task.row_names[i] for i in places)
    rounded = rounded_configuration(lambda x: task.jacobian(robot, x)[places], robot, q)
    spaces, there = rounded.spaces, rounded.at_singularity
    J = spaces.J
    det = float(np.linalg.det(J)) if J.shape[0] == J.shape[1] else None
    if json:
        answer = {"q": q, "jacobian": J, "rank": spaces.rank, "singular_values": spaces.singular_values}
        answer |= {"determinant": det, "null": spaces.null.T, "left_null": spaces.left_null.T}
        output.write_json(answer | {"status": rounded.status.name, "at_singularity": as_json(rounded)})
        return
    output.say_outside_limits(console, robot, q)
    at = vector(output.in_degrees(robot, q, degrees))
    console.print(matrix_table(J, row_names, output.joint_names(robot), f"J of {name} at q = {at}, world axes"))
    determinant = "" if det is None else f", det J = {number(det)}"
    console.print(f"rank {spaces.rank}{determinant}, singular values {vector(spaces.singular_values)}")
    print_spaces(console, spaces)
    if there is not None:
        console.print(rounded.explain(), style="yellow", markup=False)
        console.print(f"there, singular values {vector(there.singular_values)}")
        print_spaces(console, there)


def print_spaces(console: Console, spaces: Subspaces) -> None:
    """Print what does not move the task, and what cannot be realised."""
    if spaces.null.size:
        console.print(f"the task does not move with q̇ along {directions(spaces.null)}")
    if spaces.left_null.size:
        lost = directions(spaces.left_null)
        console.print(f"velocities along {lost} cannot be realised; forces along it need no torque")


def as_json(rounded: RoundedConfiguration) -> dict[str, Any] | None:
    """Return the singular configuration within the rounding of q, and its subspaces; None where there is none."""
    there = rounded.at_singularity
    if there is None:
        return None
    return {"q": rounded.singular_q, "rank": there.rank, "null": there.null.T, "left_null": there.left_null.T}


def _at_point(robot: Robot, task: FrameTask, point: Sequence[float | str]) -> tuple[Robot, FrameTask]:
    """Return the robot with a frame at the point, and the task on it."""
    moved, frame = with_point(robot, task.frame, point)
    unvalued = [name for name in moved.parameters if name not in robot.parameters]
    if unvalued:
        raise InputError(f"{enumeration(unvalued)} of the point has no value; type a number, or ask for --symbolic")
    return moved, replace(task, frame=frame)
