"""The command `robotics1 reach`: what an arm reaches of a grid of positions, with how many orientations."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from robotics1.cli.arguments import named_texts, parse_number
from robotics1.cli.options import AsJson, Figure, Frame, TaskName, TypedRobot, robot_command
from robotics1.cli.work import Scheduler, Workers, opened_work
from robotics1.errors import InputError

if TYPE_CHECKING:
    from rich.table import Table

    from robotics1.workspaces.reachability.result import ReachabilityMap

STEPS = 10  # of the step that is taken where none is given: to each side of the base
EXAMPLES = ("reach ur5 --step 0.2", "reach prr --task position:xy --grid x=-1:1:21 --grid y=-1:1:21 --figure reach.svg")
SHARES = (0.0, 0.1, 0.25, 0.5, 0.75, 1.0)  # of the orientations
WIDTH = 30  # of a bar

Grid = Annotated[list[str] | None, typer.Option("--grid", help="The values of a coordinate, as in x=-1:1:21 or z=0.3.")]


@robot_command
def reach(
    arm: TypedRobot,
    task: TaskName = None,
    step: Annotated[str | None, typer.Option(help="The step of a grid over the whole reach, in metres.")] = None,
    grid: Grid = None,
    orientations: Annotated[int, typer.Option(help="How many, spread evenly; 0: whatever the orientation.")] = 20,
    starts: Annotated[int, typer.Option(help="How many are followed to a pose, where there is no formula.")] = 16,
    seed: Annotated[int, typer.Option(help="Of the starts.")] = 0,
    configurations: Annotated[int, typer.Option(help="How many a pose has to compare, without a formula.")] = 1,
    checkpoint: Annotated[Path | None, typer.Option(help="A folder in which the map is kept, and goes on.")] = None,
    workers: Workers = None,
    scheduler: Scheduler = None,
    frame: Frame = None,
    figure: Figure = None,
    page: Annotated[Path | None, typer.Option(help="A file for a page with the cells, .html.")] = None,
    json: AsJson = False,
) -> None:
    """What an arm reaches of many positions, with which share of the orientations, and how well."""
    from robotics1.cli.output import PlainConsole, write_json
    from robotics1.workspaces.reachability.map import reachability_map

    robot, asked = arm.robot, arm.task(task, frame)
    turns = orientations if any(unit == "rad" for unit in asked.row_units) else 0
    with opened_work("trying poses", workers, scheduler) as (progress, executor):
        known = reachability_map(
            robot,
            asked,
            _positions(grid, step, robot.reach),
            turns or None,
            starts=starts,
            seed=seed,
            configurations=configurations,
            checkpoint=checkpoint,
            executor=executor,
            progress=progress,
        )
    if figure is not None:
        from robotics1.plots.reachability import plot_reachability

        plot_reachability(known, file=figure, title=robot.name)
    if page is not None:
        from robotics1.viewer.animation import view

        view(robot, file=page, reach=known, caption=known.explain())
    if json:
        write_json(_as_json(known))
        return
    out = PlainConsole()
    out.say(known.explain())
    if len(known.orientations) > 1:
        out.print(_shares(known))


def _positions(grid: Sequence[str] | None, step: str | None, reach: float) -> Any:
    """Return the grid that is typed, or the step of one over the whole reach.

    Raises:
        InputError: both are given, or one is not of its form.
    """
    if grid and step is not None:
        raise InputError("--grid and --step are two ways to say the same: give one of them")
    if not grid:
        return parse_number(step) if step is not None else reach / STEPS
    import numpy as np

    values: dict[str, Any] = {}
    what, example = "no coordinate of a grid", "x=-1:1:21, or z=0.3"
    for name, axis in named_texts(grid, what, example):
        numbers = [parse_number(number) for number in axis.split(":")] if axis else []
        if len(numbers) not in (1, 3) or (len(numbers) == 3 and numbers[2] != max(1, round(numbers[2]))):
            raise InputError(f"{f'{name}={axis}'!r} is {what}; write it like {example}")
        values[name] = numbers if len(numbers) == 1 else np.linspace(numbers[0], numbers[1], int(numbers[2]))
    return values


def _shares(known: ReachabilityMap) -> Table:
    """Return how many positions are reached with which share of the orientations."""
    from robotics1.terminal_tables import table

    share = known.capability
    rows, counts = [("none", "")], [int((share == 0).sum())]
    for low, high in pairwise(SHARES):
        rows.append((f"{100 * low:.0f} %", f"{100 * high:.0f} %"))
        counts.append(int(((share > low) & (share <= high) & (share < 1)).sum()))
    rows.append(("all", ""))
    counts.append(int((share == 1).sum()))
    bars = ["█" * round(WIDTH * count / max(counts)) for count in counts]
    lines = [(*row, str(count), bar) for row, count, bar in zip(rows, counts, bars, strict=True)]
    return table(("from", "to", "positions", ""), lines, "orientations that are reached")


def _as_json(known: ReachabilityMap) -> dict[str, Any]:
    """Return the map as what JSON knows, position by position; a map of millions is better read from its folder."""
    from robotics1.cli.output import attributes

    answer: dict[str, Any] = {"units": {"positions": "m", "volume": "m^3"}, "robot": known.robot, "rows": known.task}
    answer["counts"] = {status.name: number for status, number in known.counts().items()}
    answer |= {"complete": known.complete, "orientations": len(known.orientations)}
    measured = "volume grid positions capability most_solutions manipulability limit_margin q"
    return answer | attributes(known, measured)
