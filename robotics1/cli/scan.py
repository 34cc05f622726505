"""The command `robotics1 scan`: in sentences, where the task is nearest to singular, and a histogram; or as JSON."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, cast

import typer

from robotics1.cli.arguments import parse_number
from robotics1.cli.options import AsJson, Frame, TaskName, TypedRobot, robot_command
from robotics1.cli.uncompiled import run_without_compiler
from robotics1.cli.work import Scheduler, Workers, opened_work

if TYPE_CHECKING:
    from rich.table import Table

    from robotics1.singularities.scan_result import SingularityScan

EXAMPLES = ("scan prr --samples 1e5", "scan ur5 --samples 1e6 --refine 10", "scan planar_2r --box q1=-1:pi/2")
FEW = 3000  # samples, which take less time than the import of the compiler
QUANTILES = (0.0, 0.001, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99, 0.999, 1.0)
ROWS = 12  # of the histogram, and one for the rest
SHOWN = 5  # configurations that are printed; JSON has all
WIDTH = 30  # of a bar


@robot_command
def scan(
    arm: TypedRobot,
    task: TaskName = None,
    samples: Annotated[str, typer.Option(help="How many configurations, as 1e6; of a grid at most so many.")] = "1e6",
    measure: Annotated[
        list[str] | None, typer.Option(help="sigma_min, condition or manipulability; the first decides what is worst.")
    ] = None,
    method: Annotated[str, typer.Option(help="random, sobol or grid.")] = "random",
    seed: Annotated[int, typer.Option(help="Of the random numbers.")] = 0,
    refine: Annotated[int, typer.Option(help="How many of the worst are moved to singular configurations.")] = 0,
    box: Annotated[list[str] | None, typer.Option(help="An interval of a joint, as in q1=-1:pi/2.")] = None,
    length: Annotated[str, typer.Option(help="The length in metres that counts as one, or reach.")] = "1",
    checkpoint: Annotated[Path | None, typer.Option(help="A file in which the scan is kept, and goes on.")] = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    frame: Frame = None,
    json: AsJson = False,
) -> None:
    """How near to singular a task is, over millions of configurations."""
    number = parse_number(samples)
    if number <= FEW and refine == 0:
        run_without_compiler()
    from robotics1.cli.output import write_json
    from robotics1.singularities.scan import scan_singularities

    robot = arm.robot
    with opened_work("scanning", workers, scheduler, "summing up") as (progress, executor):
        done = scan_singularities(
            robot,
            arm.task(task, frame),
            samples=number,
            measures=cast(Any, measure or ["sigma_min"]),
            method=cast(Any, method),
            seed=seed,
            refine=refine,
            box=arm.box(box),
            length=robot.reach if length == "reach" else parse_number(length),
            checkpoint=checkpoint,
            progress=progress,
            executor=executor,
        )
    if json:
        write_json(_as_json(done))
    else:
        _print(done, arm)


def _print(scan: SingularityScan, arm: TypedRobot) -> None:
    """Print the scan in sentences, the worst configurations and a histogram."""
    from robotics1.cli.output import PlainConsole
    from robotics1.notation import vector
    from robotics1.singularities.scan_result import symbols

    lines = [
        scan.explain(),
        f"The {min(SHOWN, len(scan.worst))} nearest to singular, {symbols(scan)[scan.measures[0]]} and q:",
    ]
    for value, q in zip(scan.worst_values[:SHOWN], scan.worst, strict=False):
        lines.append(f"  {value:<10.4g} {vector(arm.shown(q))}")
    out = PlainConsole()
    out.say("\n".join(lines))
    out.print(_histogram(scan))


def _histogram(scan: SingularityScan) -> Table:
    """Return the histogram of the first measure, with a row from x to 2x; rare worst values share one row."""
    import numpy as np

    from robotics1.singularities.reduction import WORST_IS_LARGEST
    from robotics1.singularities.scan_result import symbols
    from robotics1.terminal_tables import table

    edges, counts = scan.histogram()
    largest = WORST_IS_LARGEST[scan.measures[0]]
    if len(counts) > ROWS:
        kept = slice(0, ROWS) if largest else slice(len(counts) - ROWS, None)
        rest = counts.sum() - counts[kept].sum()
        ends = [*edges[: ROWS + 1], edges[-1]] if largest else [edges[0], *edges[-ROWS - 1 :]]
        edges, counts = np.array(ends), np.array([*counts[kept], rest] if largest else [rest, *counts[kept]])
    bars = ["█" * round(WIDTH * inside / counts.max()) for inside in counts]
    rows = [
        (f"{low:.3g}", f"{high:.3g}", str(inside), bar)
        for low, high, inside, bar in zip(edges[:-1], edges[1:], counts, bars, strict=True)
    ]
    title = f"{symbols(scan)[scan.measures[0]]} of all configurations"
    return table(("from", "to", "configurations", ""), rows, title)


def _as_json(scan: SingularityScan) -> dict[str, Any]:
    """Return the scan as what JSON knows."""
    from robotics1.cli.output import attributes, units

    measures = {}
    for measure in scan.measures:
        edges, counts = scan.histogram(measure)
        quantiles = {f"{p:g}": scan.quantile(p, measure) for p in QUANTILES}
        measures[measure] = {"quantiles": quantiles, "histogram": {"edges": edges, "counts": counts}}
    return {
        "units": {"q": units(scan.robot)},
        "robot": scan.robot.name,
        "rows": scan.task.row_names,
        **attributes(scan, "method seed count undefined rank length worst worst_values"),
        "measures": measures,
        "refined": _refined(scan),
    }


def _refined(scan: SingularityScan) -> dict[str, Any] | None:
    from robotics1.cli.output import attributes

    if scan.refined is None:
        return None
    branches = scan.refined.branches
    return {
        "groups": [
            {
                "branch": group.branch,
                "conditions": None if group.branch is None else [str(c) for c in branches[group.branch].conditions],
                "values": dict(group.values),
                "q": group.configurations,
                **attributes(group, "relative_sigmas ranks starts"),
            }
            for group in scan.refined.groups
        ],
        "branches": len(branches),
        **attributes(scan.refined, "unreached note missed"),
    }
