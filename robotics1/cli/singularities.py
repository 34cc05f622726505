"""The answers of `robotics1 singularities`: in sentences, as LaTeX, as Python, as JSON."""

from collections.abc import Iterable
from typing import Any

import sympy
from rich.console import Console

from robotics1.cli.output import write_json
from robotics1.errors import FormulaError, InputError
from robotics1.singularities.intersections import find_intersections
from robotics1.singularities.other_lengths import parameter_conditions
from robotics1.singularities.result import SingularBranch, SingularSet
from robotics1.symbolic.writing.printing import latex_text, python_function

BASES = {"null": r"\mathcal{N}(J)", "range": r"\mathcal{R}(J)", "left_null": r"\mathcal{N}(J^T)"}


def print_singularities(
    console: Console, found: SingularSet, *, latex: bool, python: bool, intersections: bool, json: bool
) -> None:
    """Print the branches in the form that is asked for.

    Raises:
        InputError: both LaTeX and Python are asked for, or one of them with the intersections.
        FormulaError: LaTeX or Python is asked for of branches that were found by numbers, or the intersections were
            not found in time.
    """
    if latex and python:
        raise InputError("choose one of --latex and --python")
    if intersections and (latex or python):
        raise InputError("--intersections has neither LaTeX nor Python; leave out --latex or --python")
    if latex or python:
        form = _in_latex if latex else _in_python
        text = "\n\n".join(form(found, number, branch) for number, branch in enumerate(found.branches, start=1))
        text = f"import numpy as np\n\n\n{text}" if python else text
        if json:
            write_json({"latex" if latex else "python": text})
        else:
            console.print(text, soft_wrap=True)
    elif json:
        write_json(_as_json(found, intersections))
    else:
        console.print(found.explain(), soft_wrap=True)
        if intersections:
            console.print(find_intersections(found).explain(), soft_wrap=True)


def _in_latex(found: SingularSet, number: int, branch: SingularBranch) -> str:
    formulas = branch.require_formulas()
    where = r",\quad ".join(latex_text(condition) for condition in formulas.conditions)
    lines = [rf"{where}\quad\Rightarrow\quad \mathrm{{rank}}\,J = {branch.rank}"]
    for name, symbol in BASES.items():
        basis = getattr(formulas, name)
        if basis.cols:
            vectors = ", ".join(latex_text(basis.col(i)) for i in range(basis.cols))
            lines.append(rf"{symbol} = \mathrm{{span}}\left\{{{vectors}\right\}}")
    return "\n".join(lines)


def _in_python(found: SingularSet, number: int, branch: SingularBranch) -> str:
    """Return functions of q: what vanishes on the branch, and its bases."""
    formulas = branch.require_formulas()
    symbols = formulas.piece.locus.frequencies.q
    parameters: dict[str, float | None] = dict(found.robot.parameters)
    residuals = [condition.lhs - condition.rhs for condition in formulas.conditions]
    where = ", ".join(f"{condition.lhs} = {condition.rhs}" for condition in formulas.conditions)
    functions = [("conditions", residuals, f"What vanishes where {where}; angles up to whole turns")]
    functions += [(name, getattr(formulas, name), f"The columns span {name} of J where {where}") for name in BASES]
    sources = [
        python_function(f"{name}_{number}", formula, {"q": symbols}, parameters, summary)
        for name, formula, summary in functions
    ]
    return "\n\n".join(source.removeprefix("import numpy as np\n\n\n") for source in sources)


def _as_json(found: SingularSet, intersections: bool) -> dict[str, Any]:
    answer = {
        "method": found.method,
        "complete": found.complete,
        "note": found.note,
        "generic_rank": found.generic_rank,
        "branches": _branches(found.branches),
        "outside_limits": _branches(found.outside),
        "parameter_conditions": [str(equation) for equation in parameter_conditions(found)],
    }
    return answer | ({"intersections": _branches(find_intersections(found).branches)} if intersections else {})


def _branches(branches: Iterable[SingularBranch]) -> list[dict[str, Any]]:
    return [
        {
            "conditions": [str(condition) for condition in branch.conditions],
            "values": dict(branch.values),
            "free_joints": branch.free_joints,
            "dimension": branch.dimension,
            "rank": branch.rank,
            "q": branch.q,
            "null": branch.null.T,
            "left_null": branch.left_null.T,
            "formulas": _bases(branch),
        }
        for branch in branches
    ]


def _bases(branch: SingularBranch) -> dict[str, list[list[str]]] | None:
    """Return the bases in symbols that are short."""
    if branch.formulas is None:
        return None
    names = [name for name in BASES if branch.formulas.is_short(name)]
    try:
        bases: dict[str, sympy.Matrix] = {name: getattr(branch.formulas, name) for name in names}
    except FormulaError:
        return None
    return {name: [[str(entry) for entry in basis.col(i)] for i in range(basis.cols)] for name, basis in bases.items()}
