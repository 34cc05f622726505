"""The command `robotics1 singularities`: in sentences, as LaTeX, as Python, as JSON."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Annotated, Any, cast

import typer

from robotics1.cli.options import AsJson, Frame, RobotOfFormulas, TaskName, robot_command
from robotics1.errors import FormulaError, InputError

if TYPE_CHECKING:
    import sympy

    from robotics1.singularities.result import SingularBranch, SingularSet

EXAMPLES = ("singularities planar_2r", "singularities ur5 --task pose", "singularities prr --latex")
BASES = {"null": r"\mathcal{N}(J)", "range": r"\mathcal{R}(J)", "left_null": r"\mathcal{N}(J^T)"}


@robot_command
def singularities(
    arm: RobotOfFormulas,
    task: TaskName = None,
    frame: Frame = None,
    method: Annotated[str, typer.Option(help="auto, symbolic or numeric.")] = "auto",
    time_limit: Annotated[float, typer.Option(help="Of the exact answer, in seconds.")] = 30.0,
    intersections: Annotated[bool, typer.Option("--intersections", help="The rank where branches meet too.")] = False,
    latex: Annotated[bool, typer.Option("--latex", help="Conditions and bases in LaTeX.")] = False,
    python: Annotated[bool, typer.Option("--python", help="Conditions and bases as Python functions.")] = False,
    json: AsJson = False,
) -> None:
    """All singular configurations of a task: where, what is lost there, and what does not move the tool."""
    from robotics1.cli.output import PlainConsole, write_json
    from robotics1.singularities.find import find_singularities
    from robotics1.singularities.intersections import find_intersections

    if latex and python:
        raise InputError("choose one of --latex and --python")
    if intersections and (latex or python):
        raise InputError("--intersections has neither LaTeX nor Python; leave out --latex or --python")
    robot, what, out = arm.robot, arm.task(task, frame), PlainConsole()
    with PlainConsole(stderr=True).status("searching"):
        found = find_singularities(robot, what, method=cast(Any, method), time_limit=time_limit)
        if latex or python:
            text = _in_latex(found) if latex else _in_python(found)
            if json:
                write_json({"latex" if latex else "python": text})
            else:
                out.print(text, soft_wrap=True)
            return
        if json:
            met = {"intersections": _branches(find_intersections(found).branches)} if intersections else {}
            write_json(_as_json(found) | met)
            return
        said = [found.explain(), *([find_intersections(found).explain()] if intersections else [])]
    out.say("\n".join(said))


def _in_latex(found: "SingularSet") -> str:
    """Return the conditions and the bases of each branch.

    Raises:
        FormulaError: a branch was found by numbers.
    """
    from robotics1.symbolic.writing.decimals import lengths_in
    from robotics1.symbolic.writing.printing import latex_text
    from robotics1.symbolic.writing.readable import readable, readable_vector

    lengths, blocks = lengths_in(found.robot, found.task), []
    for branch in found.branches:
        formulas = branch.require_formulas()
        where = r",\quad ".join(latex_text(readable(condition, lengths)) for condition in formulas.conditions)
        lines = [rf"{where}\quad\Rightarrow\quad \mathrm{{rank}}\,J = {branch.rank}"]
        for name, symbol in BASES.items():
            basis = getattr(formulas, name)
            if basis.cols:
                vectors = ", ".join(latex_text(readable_vector(basis.col(i), lengths)) for i in range(basis.cols))
                lines.append(rf"{symbol} = \mathrm{{span}}\left\{{{vectors}\right\}}")
        blocks.append("\n".join(lines))
    return "\n\n".join(blocks)


def _in_python(found: "SingularSet") -> str:
    """Return functions of q for each branch: what vanishes on it, and its bases.

    Raises:
        FormulaError: a branch was found by numbers.
    """
    from robotics1.symbolic.writing.source_code import python_function

    head = "import numpy as np\n\n\n"
    parameters: dict[str, float | None] = dict(found.robot.parameters)
    sources = []
    for number, branch in enumerate(found.branches, start=1):
        formulas = branch.require_formulas()
        residuals = [condition.lhs - condition.rhs for condition in formulas.conditions]
        where = ", ".join(f"{condition.lhs} = {condition.rhs}" for condition in formulas.conditions)
        functions = [("conditions", residuals, f"What vanishes where {where}; angles up to whole turns")]
        functions += [(name, getattr(formulas, name), f"The columns span {name} of J where {where}") for name in BASES]
        for name, formula, summary in functions:
            source = python_function(f"{name}_{number}", formula, {"q": formulas.q}, parameters, summary)
            sources.append(source.removeprefix(head))
    return head + "\n\n".join(sources)


def _as_json(found: "SingularSet") -> dict[str, Any]:
    from robotics1.cli.output import attributes, units
    from robotics1.singularities.other_lengths import parameter_conditions

    return {
        "units": {"q": units(found.robot)},
        **attributes(found, "method complete note generic_rank"),
        "branches": _branches(found.branches),
        "outside_limits": _branches(found.outside),
        "parameter_conditions": [str(equation) for equation in parameter_conditions(found)],
    }


def _branches(branches: "Iterable[SingularBranch]") -> list[dict[str, Any]]:
    from robotics1.cli.output import attributes

    return [
        {
            "conditions": [str(condition) for condition in branch.conditions],
            "values": dict(branch.values),
            **attributes(branch, "free_joints dimension rank q"),
            "null": branch.null.T,
            "left_null": branch.left_null.T,
            "formulas": _bases(branch),
        }
        for branch in branches
    ]


def _bases(branch: "SingularBranch") -> dict[str, list[list[str]]] | None:
    """Return the bases in symbols that are short."""
    if branch.formulas is None:
        return None
    names = [name for name in BASES if branch.formulas.is_short(name)]
    try:
        bases: dict[str, sympy.Matrix] = {name: getattr(branch.formulas, name) for name in names}
    except FormulaError:
        return None
    return {name: [[str(entry) for entry in basis.col(i)] for i in range(basis.cols)] for name, basis in bases.items()}
