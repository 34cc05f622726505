"""The numbers of `robotics1 jacobian`."""

import numpy as np
from rich.console import Console

from robotics1.analysis.singularity_words import directions
from robotics1.analysis.spaces import subspaces
from robotics1.cli import output
from robotics1.inputs import Array
from robotics1.notation import number, vector
from robotics1.report.tables import matrix_table
from robotics1.robot.model import Robot
from robotics1.tasks.task import FrameTask


def print_jacobian(
    console: Console, robot: Robot, task: FrameTask, q: Array, *, name: str, degrees: bool, json: bool
) -> None:
    """Print J at a configuration, its rank, determinant and subspaces."""
    J = task.jacobian(robot, q)
    spaces = subspaces(J)
    det = float(np.linalg.det(J)) if J.shape[0] == J.shape[1] else None
    if json:
        answer = {"q": q, "jacobian": J, "rank": spaces.rank, "singular_values": spaces.singular_values}
        output.write_json(answer | {"determinant": det, "null": spaces.null.T, "left_null": spaces.left_null.T})
        return
    output.say_outside_limits(console, robot, q)
    at = vector(output.in_degrees(robot, q, degrees))
    console.print(matrix_table(J, task.row_names, robot.joint_names, f"J of {name} at q = {at}, world axes"))
    determinant = "" if det is None else f", det J = {number(det)}"
    console.print(f"rank {spaces.rank}{determinant}, singular values {vector(spaces.singular_values)}")
    if spaces.null.size:
        console.print(f"the task does not move with q̇ along {directions(spaces.null)}")
    if spaces.left_null.size:
        lost = directions(spaces.left_null)
        console.print(f"velocities along {lost} cannot be realised; forces along it need no torque")
