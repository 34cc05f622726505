"""The command `robotics1 jacobian`: numbers at a configuration, or formulas."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any

import typer

from robotics1.cli.arguments import parse_names, parse_point
from robotics1.cli.options import AsJson, Frame, Q, TaskName, TypedRobot, robot_command
from robotics1.errors import FormulaError, InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import sympy

    from robotics1.cli.output import PlainConsole
    from robotics1.inputs import Array
    from robotics1.robot.model import Robot
    from robotics1.singularities.rounding import RoundedConfiguration
    from robotics1.singularities.spaces import Subspaces
    from robotics1.symbolic.tasks.task_formulas import Formulas
    from robotics1.tasks.task import FrameTask

EXAMPLES = (
    "jacobian prr --task planar-pose --q 0.5,pi/2,1",
    "jacobian prr --task position:xy --symbolic",
    "jacobian ur5 --q 0,-90,90,0,90,0 --degrees",
)


@robot_command
def jacobian(
    arm: TypedRobot,
    q: Q = None,
    task: TaskName = None,
    frame: Frame = None,
    symbolic: Annotated[bool, typer.Option("--symbolic", help="Formulas instead of numbers; --q is not used.")] = False,
    latex: Annotated[bool, typer.Option("--latex", help="Formulas in LaTeX.")] = False,
    python: Annotated[bool, typer.Option("--python", help="J as a Python function that needs NumPy alone.")] = False,
    angles: Annotated[str | None, typer.Option(help="Of orientation or pose: the analytic J of ZYZ, XYZ, ...")] = None,
    rows: Annotated[str | None, typer.Option(help="Some rows, as in y,wz.")] = None,
    point: Annotated[str | None, typer.Option(help="A point of the frame instead, as in 0,0,0.1 or 0,0,d.")] = None,
    json: AsJson = False,
) -> None:
    """The Jacobian of a task, its rank and its subspaces; or its formulas, with determinant or minors."""
    what = arm.task(task, frame, angles)
    chosen = None if rows is None else parse_names(rows)
    at = None if point is None else parse_point(point)
    if symbolic or latex or python:
        if latex and python:
            raise InputError("choose one of --latex and --python")
        from robotics1.symbolic.tasks.formula import formulas

        _print_formulas(formulas(arm.robot, what, point=at, rows=chosen), latex=latex, python=python, json=json)
        return
    _print_numbers(arm, what, arm.configuration(q), chosen, at, json=json)


def _print_numbers(
    arm: TypedRobot,
    what: FrameTask,
    values: Array,
    chosen: Sequence[str] | None,
    at: Sequence[float | str] | None,
    *,
    json: bool,
) -> None:
    """Print the Jacobian at a configuration, its rank and its subspaces."""
    import numpy as np

    from robotics1.cli.output import PlainConsole, joint_names, say_outside_limits, units, write_json
    from robotics1.notation import vector
    from robotics1.singularities.rounding import rounded_configuration
    from robotics1.tasks.rows import unitless_factors
    from robotics1.terminal_tables import matrix_table

    robot = arm.robot
    if at is not None:
        robot, what = _at_point(robot, what, at)
    places = list(range(what.rows))
    if chosen is not None:
        from robotics1.symbolic.tasks.formula import row_places

        places = list(row_places(what, chosen))
    scale = unitless_factors(robot, what)[places]
    found = rounded_configuration(lambda x: what.jacobian(robot, x)[places], robot, values, scale)
    J = found.spaces.J
    det = float(np.linalg.det(J)) if J.shape[0] == J.shape[1] else None
    if json:
        rows = [f"{what.row_units[i]}/s" for i in places]
        write_json(_as_json(found, det) | {"units": {"q": units(robot), "rows": rows}})
        return
    out = PlainConsole()
    say_outside_limits(out, robot, values)
    shown = tuple(what.row_names[i] for i in places)
    title = f"J of ({', '.join(shown)}) at q = {vector(arm.shown(values))}, world axes"
    out.print(matrix_table(J, shown, joint_names(robot), title))
    _print_rank(out, found, det)


def _at_point(robot: Robot, task: FrameTask, at: Sequence[float | str]) -> tuple[Robot, FrameTask]:
    """Return the robot and the task with a point of the frame instead.

    Raises:
        InputError: a name in the point has no value.
    """
    from robotics1.notation import enumeration
    from robotics1.symbolic.kinematics.points import with_point

    placed, moved = with_point(robot, task.frame, at)
    unvalued = [name for name in placed.parameters if name not in robot.parameters]
    if unvalued:
        raise InputError(f"{enumeration(unvalued)} of the point has no value; type a number, or ask for --symbolic")
    return placed, replace(task, frame=moved)


def _print_rank(out: PlainConsole, found: RoundedConfiguration, det: float | None) -> None:
    from robotics1.notation import number, vector

    determinant = "" if det is None else f", det J = {number(det)}"
    out.print(f"rank {found.spaces.rank}{determinant}, singular values {vector(found.spaces.singular_values)}")
    _print_spaces(out, found.spaces)
    if found.at_singularity is not None:
        out.print(found.explain(), style="yellow", markup=False)
        out.print(f"there, singular values {vector(found.at_singularity.singular_values)}")
        _print_spaces(out, found.at_singularity)


def _print_spaces(out: PlainConsole, spaces: Subspaces) -> None:
    """Print what does not move the task, and what cannot be realised."""
    from robotics1.singularities.explain import directions

    if spaces.null.size:
        out.print(f"the task does not move with q̇ along {directions(spaces.null)}")
    if spaces.left_null.size:
        lost = directions(spaces.left_null)
        out.print(f"velocities along {lost} cannot be realised; forces along it need no torque")


def _as_json(found: RoundedConfiguration, det: float | None) -> dict[str, Any]:
    spaces = found.spaces
    answer = {"q": found.q, "jacobian": spaces.J, "rank": spaces.rank, "singular_values": spaces.singular_values}
    answer |= {"determinant": det, "null": spaces.null.T, "left_null": spaces.left_null.T}
    return answer | {"status": found.status.name, "at_singularity": singularity_as_json(found)}


def singularity_as_json(found: RoundedConfiguration) -> dict[str, Any] | None:
    """Return the singular configuration within the rounding of q, and its subspaces; None where there is none."""
    there = found.at_singularity
    if there is None:
        return None
    return {"q": found.singular_q, "rank": there.rank, "null": there.null.T, "left_null": there.left_null.T}


def _print_formulas(found: Formulas, *, latex: bool, python: bool, json: bool) -> None:
    """Print the value, the Jacobian, and its determinant or minors; as LaTeX or JSON where asked; or a function."""
    from robotics1.cli.output import PlainConsole, write_json
    from robotics1.symbolic.tasks.shown_formulas import in_characters
    from robotics1.symbolic.writing.decimals import lengths_in
    from robotics1.symbolic.writing.printing import latex_text
    from robotics1.symbolic.writing.readable import readable

    out = PlainConsole()
    if python:
        source = found.python()
        if json:
            write_json({"python": source})
        else:
            out.print(source, soft_wrap=True, end="")
        return
    minors, reason = _named_minors(found)
    if json:
        form = latex_text if latex else str
        rows = [[form(entry) for entry in found.jacobian.row(i)] for i in range(found.jacobian.rows)]
        named = {name: form(minor) for name, minor in minors}
        write_json({"value": [form(entry) for entry in found.value], "jacobian": rows, "minors": named})
        return
    lengths = lengths_in(found.robot, found.task)
    for name, formula in (("r", found.value), ("J", found.jacobian), *minors):
        read = readable(formula, lengths)
        out.print(f"{name} =\n{latex_text(read)}" if latex else in_characters(name, read), soft_wrap=True)
    if reason:
        out.say(f"no minors: {reason}")
    if found.cleaned:
        out.print(f"angles of the file were made exact, by at most {found.cleaned:.1e} rad")


def _named_minors(found: Formulas) -> tuple[list[tuple[str, sympy.Expr]], str]:
    """Return the determinant, or the minors with the joints or rows that are left out; or why there are none."""
    from robotics1.notation import enumeration

    wide = len(found.q) > len(found.row_names)
    names = found.robot.joint_names if wide else found.row_names
    try:
        minors = found.minors
    except FormulaError as error:
        return [], str(error)
    return [
        (f"det J without {enumeration(names[i] for i in out)}" if out else "det J", minor)
        for out, minor in minors.items()
    ], ""
