"""The formulas of `robotics1 jacobian --symbolic`."""

import sympy
from rich.console import Console

from robotics1.cli.output import write_json
from robotics1.notation import enumeration
from robotics1.robot.model import Robot
from robotics1.symbolic.formula import Formulas, formulas
from robotics1.tasks.task import FrameTask


def print_formulas(console: Console, robot: Robot, task: FrameTask, *, latex: bool, json: bool) -> None:
    """Print the value, the Jacobian, and its determinant or minors; as LaTeX or JSON where asked."""
    found = formulas(robot, task)
    if json:
        form = sympy.latex if latex else str
        write_json(
            {
                "value": [form(entry) for entry in found.value],
                "jacobian": [[form(entry) for entry in found.jacobian.row(i)] for i in range(found.jacobian.rows)],
                "minors": {name: form(minor) for name, minor in _named_minors(found)},
            }
        )
        return
    for name, formula in (("r", found.value), ("J", found.jacobian), *_named_minors(found)):
        text = sympy.latex(formula) if latex else sympy.pretty(formula, use_unicode=True, wrap_line=False)
        console.print(f"{name} =", highlight=False, markup=False)
        console.print(text, highlight=False, markup=False, soft_wrap=True)
    if found.cleaned:
        console.print(f"angles of the file were made exact, by at most {found.cleaned:.1e} rad", highlight=False)


def _named_minors(found: Formulas) -> list[tuple[str, sympy.Expr]]:
    """Return the determinant, or the minors with the joints or rows that are left out."""
    wide = found.jacobian.cols > found.jacobian.rows
    names = found.robot.joint_names if wide else found.task.row_names
    return [
        ("det J" if not out else f"det J without {enumeration(names[i] for i in out)}", minor)
        for out, minor in found.minors.items()
    ]
