"""The two answers of `robotics1 ik`: every solution, or one method's iterations."""

from dataclasses import replace
from typing import Any

import numpy as np
from rich.console import Console

from robotics1.cli.arguments import parse_vector
from robotics1.cli.output import in_degrees, joint_names, say_outside_limits, write_json
from robotics1.errors import InputError
from robotics1.ik.iterate import IKIterate, IKIteration, iterate_ik
from robotics1.ik.solutions import ik_solutions
from robotics1.inputs import Array
from robotics1.notation import count, vector
from robotics1.report.tables import iteration_table, matrix_table
from robotics1.robot.model import Robot
from robotics1.tasks.task import FrameTask

SHOWN = 16  # solutions of an infinite family that are printed


def parse_target(task: FrameTask, text: str, degrees: bool) -> Any:
    """Return the target as the task takes it: a vector, or a matrix typed row by row.

    Raises:
        InputError: the wrong number of values.
    """
    values = parse_vector(text)
    value = task.g(np.zeros(3), np.eye(3))
    shape = np.shape(getattr(value, "homogeneous", value))
    if len(shape) == 2:
        if values.size != shape[0] * shape[1]:
            raise InputError(f"the target is {shape[0]} × {shape[1]}, row by row; it has {values.size} numbers")
        return values.reshape(shape)
    if degrees and values.size == task.rows:
        values = np.where(np.array(task.row_units) == "rad", np.radians(values), values)
    return values


def print_solutions(
    console: Console,
    robot: Robot,
    task: FrameTask,
    target: Any,
    *,
    options: dict[str, Any],
    degrees: bool,
    json: bool,
) -> bool:
    """Print every solution, and return whether there is one."""
    found = ik_solutions(robot, task, target, **options)
    if json:
        write_json(
            {
                "status": found.status.name,
                "complete": found.complete,
                "solutions": found.q,
                "singular": found.singular,
                "error_norm": found.error_norm,
                "free_joints": found.free_joints,
                "dimension": found.dimension,
            }
        )
        return len(found) > 0
    console.print(f"{found.status.value} ({len(found)} found by search)")
    if not len(found):
        nearest = vector(in_degrees(robot, found.closest, degrees))
        console.print(f"the nearest miss is |e| = {found.error_norm:.4g} at q = {nearest}")
        return False
    rows = tuple(f"{i + 1}{' singular' if flag else ''}" for i, flag in enumerate(found.singular[:SHOWN]))
    console.print(matrix_table(in_degrees(robot, found.q[:SHOWN], degrees), rows, joint_names(robot)))
    if len(found) > SHOWN:
        console.print(f"and {len(found) - SHOWN} more")
    if found.free_joints:
        names = ", ".join(found.free_joints)
        console.print(f"{names}: anywhere in the limits, since the task does not move", highlight=False)
    return True


def print_iteration(
    console: Console,
    robot: Robot,
    task: FrameTask,
    target: Any,
    q0: Array,
    *,
    options: dict[str, Any],
    degrees: bool,
    json: bool,
) -> bool:
    """Print the table of an iteration, and return whether it converged."""
    run = iterate_ik(robot, task, target, q0, **options)
    if json:
        write_json(
            {
                "status": run.status.name,
                "iterations": run.iterations,
                "q": run.q,
                "within_limits": run.within_limits,
                "table": [row._asdict() for row in run.table],
            }
        )
        return run.converged
    title = f"{run.method}, angles in {'degrees, |e| in radians' if degrees else 'radians'}"
    console.print(iteration_table(_in_degrees(run, robot, task) if degrees else run, title))
    console.print(f"{run.status.name} after {count(run.iterations, 'iteration')}: {run.status.value}")
    say_outside_limits(console, robot, run.q)
    return run.converged


def _in_degrees(run: IKIteration, robot: Robot, task: FrameTask) -> IKIteration:
    """Return an iteration for printing, with its q, and r where it is a vector, in degrees."""
    angles = np.array(task.row_units) == "rad"

    def converted(row: IKIterate) -> IKIterate:
        is_vector = isinstance(row.r, np.ndarray) and row.r.shape == angles.shape
        r = np.where(angles, np.degrees(row.r), row.r) if is_vector else row.r
        return row._replace(q=in_degrees(robot, row.q, True), r=r)

    return replace(run, table=tuple(map(converted, run.table)))
