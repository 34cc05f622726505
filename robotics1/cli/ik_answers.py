"""The answers of `robotics1 ik`, each printed or written as JSON; each returns whether it is a success."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from robotics1.cli.arguments import parse_vector, read_text
from robotics1.cli.options import TypedRobot
from robotics1.cli.output import (
    PlainConsole,
    attributes,
    joint_names,
    progress_bar,
    say_outside_limits,
    units,
    write_json,
)
from robotics1.errors import InputError
from robotics1.ik.iterate import IKIterate, IKIteration, iterate_ik
from robotics1.ik.result import IKBatch, IKResult
from robotics1.ik.solution_set import IKSolutions
from robotics1.inputs import Array
from robotics1.notation import count, number, vector
from robotics1.robot.model import Robot
from robotics1.tasks.task import FrameTask
from robotics1.terminal_tables import iteration_table, matrix_table, table

OF_A_FAMILY = 16  # solutions that are printed, where there are infinitely many
IN_COLUMNS = 4  # joints, up to which the table has a column for the posture
OF_A_FILE = 20  # targets that are printed; JSON has all

POSITIONS = {(3, 2): ("planar pose x,y,φ", "position:xy"), (6, 3): ("pose", "position")}  # rows, numbers of a target


def parse_target(task: FrameTask, text: str, degrees: bool, *, by_default: bool = False) -> Any:
    """Return the target as the task takes it: a vector, or a matrix typed row by row.

    Args:
        task: r = f(q).
        text: as typed.
        degrees: whether its angles are in degrees.
        by_default: whether no task was typed.

    Raises:
        InputError: the wrong number of values; or they are a position, and the task is a pose that nobody typed.
    """
    values = parse_vector(text, degrees)
    if by_default and (task.rows, values.size) in POSITIONS:
        kind, option = POSITIONS[task.rows, values.size]
        raise InputError(
            f"{values.size} numbers are a position, and this robot's task is the {kind}, {task.rows} numbers; "
            f"for a position add --task {option}"
        )
    value = task.g(np.zeros(3), np.eye(3))
    shape = np.shape(getattr(value, "homogeneous", value))
    if len(shape) == 2:
        return _pose_or_rotation(values, shape, degrees)
    if degrees and values.size == task.rows:
        values = np.where(np.array(task.row_units) == "rad", np.radians(values), values)
    return values


def _pose_or_rotation(values: Array, shape: tuple[int, ...], degrees: bool) -> Any:
    """Return a pose (4, 4), or a rotation (3, 3), from its matrix row by row, from rpy, or from a quaternion.

    Raises:
        InputError: there is another number of values.
    """
    place = 3 if shape[0] == 4 else 0
    if values.size == shape[0] * shape[1]:
        return values.reshape(shape)
    if values.size not in (place + 3, place + 4):
        at = "x,y,z," * bool(place)
        raise InputError(
            f"the target is {at}roll,pitch,yaw, or {at}qx,qy,qz,qw, or {shape[0]} × {shape[1]} numbers row by row; "
            f"it has {values.size} numbers"
        )
    turn = values[place:]
    if turn.size == 3 and degrees:
        turn = np.radians(turn)
    return (values[:3], turn) if place else turn


def read_targets(path: Path, task: FrameTask, degrees: bool) -> list[Any]:
    """Return the targets of a file, one on each line in the form of --target; # begins a comment.

    Raises:
        InputError: there is no such file, it holds no target, or a line is none; the message has the line's number.
    """
    targets = []
    for n, line in enumerate(read_text(path).splitlines(), 1):
        text = line.partition("#")[0].strip()
        if not text:
            continue
        try:
            targets.append(task.target(parse_target(task, text, degrees)))
        except InputError as error:
            raise InputError(f"{path}, line {n}: {error}") from error
    if not targets:
        raise InputError(f"there is no target in {path}; write one on each line, as in 1,-1,3")
    return targets


def all_solutions(
    arm: TypedRobot, task: FrameTask, target: Any, _: None, options: dict[str, Any], *, json: bool
) -> bool:
    """Print every solution, write a page of them if that is asked for, and return whether there is one."""
    from robotics1.ik.solutions import ik_solutions

    page = options.pop("page", None)
    found = ik_solutions(arm.robot, task, target, **options)
    if page is not None and len(found):
        from robotics1.viewer.animation import view

        view(arm.robot, file=page, task=task, solutions=found)
    if json:
        write_json(_solutions_as_json(found))
        return len(found) > 0
    out = PlainConsole()
    out.print(f"{found.status.value} ({len(found)} found by {found.method})")
    if len(found) or len(found.outside_limits):
        _print_solutions(out, found, arm)
    if len(found) > OF_A_FAMILY:
        out.print(f"and {len(found) - OF_A_FAMILY} more")
    if not len(found):
        nearest = vector(arm.shown(found.closest))
        out.print(f"the nearest miss is |e| = {found.error_norm:.4g} at q = {nearest}")
        return False
    if found.free_joints:
        out.print(f"{', '.join(found.free_joints)}: anywhere in the limits, since the task does not move")
    if page is not None:
        out.print(f"wrote {page}", soft_wrap=True)
    return True


def _print_solutions(out: PlainConsole, found: IKSolutions, arm: TypedRobot) -> None:
    """Print the solutions as a table, and the posture of each in a column, or below where there are many joints."""
    inside = found.q[:OF_A_FAMILY]
    q = arm.shown(np.vstack([inside, found.outside_limits]))
    labels = (*found.labels[: len(inside)], *found.labels_of(found.outside_limits))
    singular = (*found.singular[: len(inside)], *[False] * len(found.outside_limits))
    notes = []
    for i, (names, flag) in enumerate(zip(labels, singular, strict=True)):
        beside = ["singular"] * bool(flag) + ["outside the limits"] * (i >= len(inside))
        notes.append(", ".join((*names, *beside)))
    numbers = [(str(i + 1), *(number(float(value)) for value in values)) for i, values in enumerate(q)]
    headings = ("", *joint_names(arm.robot))
    if any(notes) and arm.robot.nq <= IN_COLUMNS:
        rows = [(*row, note) for row, note in zip(numbers, notes, strict=True)]
        out.print(table((*headings, "posture"), rows, left=("posture",)))
        return
    out.print(table(headings, numbers))
    for i, note in enumerate(notes, 1):
        if note:
            out.say(f"{i}: {note}")


def _solutions_as_json(found: IKSolutions) -> dict[str, Any]:
    answer: dict[str, Any] = {
        "status": found.status.name,
        "units": {"q": units(found.robot)},
    }
    answer |= {"complete": found.complete, "method": found.method, "solutions": found.q}
    return answer | attributes(found, "labels singular within_limits outside_limits error_norm free_joints dimension")


def formulas(robot: Robot, task: FrameTask, *, json: bool) -> None:
    """Print the formulas of every solution."""
    from robotics1.ik.closed_form.find import ik_formulas

    found = ik_formulas(robot, task)
    if json:
        branches = [{name: str(e) for name, e in branch.q.items()} for branch in found.branches]
        write_json({"branches": branches, "free_joints": found.free_joints, "latex": found.latex()})
    else:
        PlainConsole().say(found.explain())


def one_solution(
    arm: TypedRobot, task: FrameTask, target: Any, q0: Array | None, options: dict[str, Any], *, json: bool
) -> bool:
    """Print the solution that is found robustly, or the nearest miss; and return which it is."""
    from robotics1.ik.solver import IKSolver

    result = IKSolver(arm.robot, task, **options)(target, q0)
    if json:
        write_json(_as_json(result) | {"units": {"q": units(arm.robot)}})
        return result.converged
    out = PlainConsole()
    out.print(f"{result.status.name} after {count(result.starts, 'start')}: {result.status.value}")
    if not result.converged:
        out.print(f"the nearest miss is |e| = {result.error_norm:.4g} at")
    out.print(matrix_table(arm.shown(result.q)[:, None], joint_names(arm.robot), ("q",)))
    if result.converged:
        out.print(f"|e| = {result.error_norm:.2g} by forward kinematics")
    return result.converged


def many_solutions(
    arm: TypedRobot, task: FrameTask, targets: Sequence[Any], q0: Array | None, options: dict[str, Any], *, json: bool
) -> bool:
    """Print the solutions of many targets, and return whether all are reached."""
    from robotics1.ik.solver import IKSolver

    with progress_bar("solving", hidden=json) as progress:
        batch = IKSolver(arm.robot, task, **options).solve_batch(targets, q0, progress=progress)
    if json:
        write_json([_as_json(batch[i]) for i in range(len(batch))])
    else:
        _print_batch(batch, arm)
    return bool(batch.converged.all())


def _print_batch(batch: IKBatch, arm: TypedRobot) -> None:
    out = PlainConsole()
    out.print(f"{int(batch.converged.sum())} of {count(len(batch), 'target')} reached")
    for status in dict.fromkeys(batch.status[~batch.converged]):
        out.print(f"{(batch.status == status).sum()} {status.name}: {status.value}")
    missed_first = np.argsort(batch.converged, kind="stable")
    rows = []
    for i in sorted(missed_first[:OF_A_FILE].tolist()):
        q = vector(arm.shown(batch.q[i]))
        rows.append((str(i + 1), batch.status[i].name, str(batch.starts[i]), f"{batch.error_norm[i]:.2g}", q))
    out.print(table(("target", "status", "starts", "|e|", "q"), rows, left=("status",)))
    if len(batch) > OF_A_FILE:
        out.print(f"and {len(batch) - OF_A_FILE} more; --json prints all")


def _as_json(result: IKResult) -> dict[str, Any]:
    return {"status": result.status.name, "q": result.q, "error_norm": result.error_norm, "starts": result.starts}


def iteration(arm: TypedRobot, task: FrameTask, target: Any, q0: Array, options: dict[str, Any], *, json: bool) -> bool:
    """Print the table of an iteration, and return whether it converged."""
    run = iterate_ik(arm.robot, task, target, q0, **options)
    if json:
        answer = {"units": {"q": units(arm.robot)}, "status": run.status.name, "iterations": run.iterations, "q": run.q}
        write_json(answer | {"within_limits": run.within_limits, "table": [row._asdict() for row in run.table]})
        return run.converged
    out = PlainConsole()
    title = f"{run.method}, angles in {'degrees, |e| in radians' if arm.degrees else 'radians'}"
    out.print(iteration_table(_in_degrees(run, arm, task) if arm.degrees else run, title))
    out.print(f"{run.status.name} after {count(run.iterations, 'iteration')}: {run.status.value}")
    say_outside_limits(out, arm.robot, run.q)
    return run.converged


def _in_degrees(run: IKIteration, arm: TypedRobot, task: FrameTask) -> IKIteration:
    """Return an iteration for printing, with its q, and r where it is a vector, in degrees."""
    angles = np.array(task.row_units) == "rad"

    def converted(row: IKIterate) -> IKIterate:
        is_vector = isinstance(row.r, np.ndarray) and row.r.shape == angles.shape
        r = np.where(angles, np.degrees(row.r), row.r) if is_vector else row.r
        return row._replace(q=arm.shown(row.q), r=r)

    return replace(run, table=tuple(map(converted, run.table)))
