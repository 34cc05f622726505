"""The command `robotics1 ik`."""

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from robotics1.cli import arguments
from robotics1.cli.options import AsJson, Degrees, Frame, Parameters, RobotName, TaskName, Tool
from robotics1.errors import InputError
from robotics1.inputs import one_of

Target = Annotated[str | None, typer.Option(help="The target: x,y,z or x,y,φ; for a pose, 16 numbers row by row.")]
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
Start = Annotated[str | None, typer.Option("--q0", help="The start; by default zero, for solve at random.")]
Prefer = Annotated[
    str, typer.Option(help="For solve, of a redundant arm: any, near (to q0) or middle (of the ranges).")
]
Seed = Annotated[int, typer.Option(help="For solve: of the random starts.")]
TimeLimit = Annotated[float, typer.Option(help="For solve: the most seconds for one target.")]
Tolerance = Annotated[float | None, typer.Option(help="The wanted |e|; by default 1e-4, for solve 1e-6.")]


def ik(
    robot: RobotName,
    target: Target = None,
    task: TaskName = "position",
    method: Method = None,
    targets: Targets = None,
    q0: Start = None,
    prefer: Prefer = "any",
    seed: Seed = 0,
    time_limit: TimeLimit = 0.5,
    tolerance: Tolerance = None,
    max_iterations: Annotated[int, typer.Option(help="For newton, ..., damped: the most iterations.")] = 50,
    frame: Frame = None,
    param: Parameters = None,
    tool: Tool = None,
    degrees: Degrees = False,
    json: AsJson = False,
) -> None:
    """Inverse kinematics: all solutions, one found robustly, many targets, or the table of one method's iterations."""
    from robotics1.cli import inverse, robust_inverse
    from robotics1.ik.iterate import METHODS

    if (target is None) == (targets is None):
        raise InputError("give either --target, as in --target 1,-1,3, or --targets FILE with a target on each line")
    if method is not None:
        one_of("--method", method, ("solve", *METHODS))
    if targets is not None and method not in (None, "solve"):
        raise InputError(f"--targets is for --method solve; {method!r} takes one --target")
    solve = method == "solve" or targets is not None
    if prefer != "any" and not solve:
        raise InputError(f"--prefer {prefer} is for --method solve")
    arm = arguments.parse_robot(robot, param or [], tool)
    what, out = arguments.parse_task(task, frame), Console()
    wanted = tolerance if tolerance is not None else 1e-6 if solve else 1e-4
    start = None if q0 is None else arguments.configuration(arm, q0, degrees)
    if not solve:
        goal = inverse.parse_target(what, target or "", degrees)
        if method is None:
            done = inverse.print_solutions(out, arm, what, goal, degrees=degrees, json=json)
        else:
            begin = arguments.configuration(arm, None, degrees) if start is None else start
            options = {"method": method, "tolerance": wanted, "max_iterations": max_iterations}
            done = inverse.print_iteration(out, arm, what, goal, begin, options=options, json=json)
    else:
        wishes = {"prefer": prefer, "seed": seed, "time_limit": time_limit, "tolerance": wanted}
        search = robust_inverse.RobustInverse(out, arm, what, start, wishes, degrees=degrees, json=json)
        done = search.answer(target or "") if targets is None else search.answer_all(targets)
    raise typer.Exit(0 if done else 1)
