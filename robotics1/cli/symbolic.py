"""The formulas of `robotics1 jacobian --symbolic`."""

from collections.abc import Sequence

import sympy
from rich.console import Console

from robotics1.cli.output import write_json
from robotics1.errors import FormulaError, InputError
from robotics1.notation import enumeration
from robotics1.robot.model import Robot
from robotics1.symbolic.tasks.formula import formulas
from robotics1.symbolic.tasks.task_formulas import Formulas
from robotics1.symbolic.writing.printing import latex_text, unicode_text
from robotics1.tasks.task import FrameTask


def print_formulas(
    console: Console,
    robot: Robot,
    task: FrameTask,
    *,
    point: Sequence[float | str] | None = None,
    rows: Sequence[str] | None = None,
    latex: bool = False,
    python: bool = False,
    json: bool = False,
) -> None:
    """Print the value, the Jacobian, and its determinant or minors; as LaTeX or JSON where asked; or a function.

    A point of the frame and rows of the task are chosen as `formulas` chooses them.

    Raises:
        InputError: both LaTeX and Python are asked for.
    """
    if latex and python:
        raise InputError("choose one of --latex and --python")
    found = formulas(robot, task, point=point, rows=rows)
    if python:
        source = found.python()
        if json:
            write_json({"python": source})
        else:
            console.print(source, soft_wrap=True, end="")
        return
    minors, reason = _named_minors(found)
    if json:
        form = latex_text if latex else str
        write_json(
            {
                "value": [form(entry) for entry in found.value],
                "jacobian": [[form(entry) for entry in found.jacobian.row(i)] for i in range(found.jacobian.rows)],
                "minors": {name: form(minor) for name, minor in minors},
            }
        )
        return
    for name, formula in (("r", found.value), ("J", found.jacobian), *minors):
        console.print(f"{name} =")
        text = latex_text(formula) if latex else unicode_text(formula)
        console.print(text, soft_wrap=True)
    if reason:
        console.print(f"no minors: {reason}", soft_wrap=True)
    if found.cleaned:
        console.print(f"angles of the file were made exact, by at most {found.cleaned:.1e} rad")


def _named_minors(found: Formulas) -> tuple[list[tuple[str, sympy.Expr]], str]:
    """Return the determinant, or the minors with the joints or rows that are left out; or why there are none."""
    wide = len(found.q) > len(found.row_names)
    names = found.robot.joint_names if wide else found.row_names
    try:
        minors = found.minors
    except FormulaError as error:
        return [], str(error)
    named = [
        ("det J" if not out else f"det J without {enumeration(names[i] for i in out)}", minor)
        for out, minor in minors.items()
    ]
    return named, ""
