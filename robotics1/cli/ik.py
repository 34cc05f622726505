"""The command `robotics1 ik`."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Any

import typer

from robotics1.cli.options import AsJson, Frame, TaskName, TypedRobot, robot_command
from robotics1.cli.uncompiled import run_without_compiler
from robotics1.errors import InputError

EXAMPLES = (
    "ik planar_2r --target 0,1.5359 --degrees",
    "ik ur5 --target 0.4,0.2,0.3,pi,0,0",
    "ik cylindrical --target 1,-1,3 --method newton --q0 -2,0.7pi,1.4142",
    "ik planar_2r --task position:xy --formulas",
)
Target = Annotated[
    str | None,
    typer.Option(
        help="The target: x,y,z or x,y,φ; of a pose x,y,z,roll,pitch,yaw, or x,y,z and a quaternion qx,qy,qz,qw, or 16 "
        "numbers row by row."
    ),
]
Targets = Annotated[
    Path | None,
    typer.Option(help="A file with a target on each line as in --target, # for comments; --method solve is meant."),
]
Method = Annotated[
    str | None,
    typer.Option(
        help="solve: one solution inside the limits, robustly; newton, pseudoinverse, gradient or damped: the table of "
        "its iterations; without it, all solutions."
    ),
]
Start = Annotated[
    str | None, typer.Option("--q0", help="For a method: the start; by default zero, for solve at random.")
]
Prefer = Annotated[
    str | None,
    typer.Option(help="For solve, of a redundant arm: any (the default), near (to q0) or middle (of the ranges)."),
]
Seed = Annotated[int | None, typer.Option(help="For solve and for all solutions: of the random starts; by default 0.")]
TimeLimit = Annotated[float | None, typer.Option(help="For solve: the most seconds for one target; by default 0.5.")]
Tolerance = Annotated[float | None, typer.Option(help="For a method: the wanted |e|; by default 1e-4, for solve 1e-6.")]
Iterations = Annotated[int | None, typer.Option(help="For newton, ..., damped: the most iterations; by default 50.")]

Formulas = Annotated[bool, typer.Option("--formulas", help="Print the formulas of all solutions; needs no --target.")]
PageFile = Annotated[
    Path | None,
    typer.Option("--page", "--out", "-o", help="For all solutions: the page to write, which shows them together."),
]

ALL, SOLVE, ITERATE = "all solutions", "--method solve", "--method newton, pseudoinverse, gradient or damped"
USES = {  # option → the questions whose answer it changes
    "q0": (SOLVE, ITERATE),
    "prefer": (SOLVE,),
    "seed": (ALL, SOLVE),
    "time_limit": (SOLVE,),
    "tolerance": (SOLVE, ITERATE),
    "max_iterations": (ITERATE,),
    "page": (ALL,),
}


@robot_command
def ik(
    arm: TypedRobot,
    target: Target = None,
    task: TaskName = None,
    method: Method = None,
    targets: Targets = None,
    q0: Start = None,
    prefer: Prefer = None,
    seed: Seed = None,
    time_limit: TimeLimit = None,
    tolerance: Tolerance = None,
    max_iterations: Iterations = None,
    formulas: Formulas = False,
    page: PageFile = None,
    frame: Frame = None,
    json: AsJson = False,
) -> None:
    """Inverse kinematics: all solutions or their formulas, one solution, many targets, or one method's iterations."""
    if method == "solve" and targets is None:
        run_without_compiler()
    from robotics1.cli import ik_answers as answers
    from robotics1.ik.iterate import METHODS
    from robotics1.inputs import one_of

    given: dict[str, Any] = {"q0": q0, "prefer": prefer, "seed": seed, "time_limit": time_limit}
    given |= {"tolerance": tolerance, "max_iterations": max_iterations, "page": page}
    if formulas:
        _refuse_beside_formulas({"target": target, "targets": targets, "method": method, **given})
        answers.formulas(arm.robot, arm.task(task, frame), json=json)
        return
    if (target is None) == (targets is None):
        raise InputError("give either --target, as in --target 1,-1,3, or --targets FILE with a target on each line")
    if method is not None:
        one_of("--method", method, ("solve", *METHODS))
    if targets is not None and method not in (None, "solve"):
        raise InputError(f"--targets is for --method solve; {method!r} takes one --target")
    question = SOLVE if method == "solve" or targets is not None else ALL if method is None else ITERATE
    options = _used(question, given)
    what = arm.task(task, frame)
    start = None if q0 is None else arm.configuration(q0)
    if targets is not None:
        wanted = answers.read_targets(targets, what, arm.degrees)
        done = answers.many_solutions(arm, what, wanted, start, options, json=json)
    else:
        goal = answers.parse_target(what, target or "", arm.degrees, by_default=task is None)
        if question == ITERATE:
            start = arm.configuration(None) if start is None else start
            options["method"] = method
        kinds: dict[str, Callable[..., bool]] = {
            ALL: answers.all_solutions,
            SOLVE: answers.one_solution,
            ITERATE: answers.iteration,
        }
        done = kinds[question](arm, what, goal, start, options, json=json)
    raise typer.Exit(0 if done else 1)


def _refuse_beside_formulas(given: dict[str, Any]) -> None:
    """Raise InputError if an option is given that changes nothing for the formulas."""
    for name, value in given.items():
        if value is not None:
            raise InputError(
                f"--{name.replace('_', '-')} {value} changes nothing for --formulas, which hold of every target"
            )


def _used(question: str, given: dict[str, Any]) -> dict[str, Any]:
    """Return the options that were given, without the start; what is left out has the default of the function called.

    Raises:
        InputError: an option would change nothing.
    """
    typed = {name: value for name, value in given.items() if value is not None}
    for name, value in typed.items():
        if question not in USES[name]:
            option = f"--{name.replace('_', '-')} {value}"
            raise InputError(f"{option} is for {' and '.join(USES[name])}; it changes nothing for {question}")
    if typed.get("prefer") == "near" and "q0" not in typed:
        raise InputError("--prefer near needs --q0: the solution is brought near to it")
    return {name: value for name, value in typed.items() if name != "q0"}
