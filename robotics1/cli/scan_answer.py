"""The answer of `robotics1 scan`: in sentences, where the task is nearest to singular, and a histogram; or as JSON."""

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from math import radians
from typing import Any

import numpy as np
from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn
from rich.table import Table

from robotics1.cli.arguments import parse_number
from robotics1.cli.output import in_degrees, write_json
from robotics1.errors import InputError
from robotics1.inputs import counting_number
from robotics1.notation import vector
from robotics1.robot.model import Robot
from robotics1.singularities.reduction import WORST_IS_LARGEST
from robotics1.singularities.scan import scan_singularities
from robotics1.singularities.scan_result import SingularityScan, symbols

QUANTILES = (0.0, 0.001, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99, 0.999, 1.0)
ROWS = 12  # of the histogram, and one for the rest
SHOWN = 5  # configurations that are printed; JSON has all
WIDTH = 30  # of a bar


def parse_box(robot: Robot, texts: Sequence[str], degrees: bool) -> dict[str, tuple[float, float]]:
    """Return joint → (lower, upper), each typed as q1=-1:pi/2; of revolute joints in degrees where asked.

    Raises:
        InputError: one of them is not name=lower:upper.
    """
    box = {}
    for text in texts:
        name, _, interval = text.partition("=")
        ends = [parse_number(end) for end in interval.split(":")] if interval else []
        if len(ends) != 2:
            raise InputError(f"{text!r} is not an interval; write it like q1=-1:pi/2")
        turns = degrees and name in robot.joint_names and robot.revolute[robot.joint_names.index(name)]
        lower, upper = (radians(end) if turns else end for end in ends)
        box[name] = (lower, upper)
    return box


def run_scan(console: Console, workers: int, *arguments: Any, **options: Any) -> SingularityScan:
    """Scan with a progress bar, in so many threads.

    Raises:
        Robotics1Error: what `scan_singularities` raises.
    """
    counting_number("--workers", workers, least=1)
    with _bar(console) as progress:
        if workers == 1:
            return scan_singularities(*arguments, progress=progress, **options)
        with ThreadPoolExecutor(workers) as executor:  # the kernels leave the interpreter free; processes start slowly
            return scan_singularities(*arguments, progress=progress, executor=executor, **options)


@contextmanager
def _bar(console: Console) -> Iterator[Callable[[int, int], None]]:
    """Show a bar from the first chunk on; what is refined after the last has no measure, so it just says so."""
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    bar = Progress(*columns, console=console, transient=True)
    task = bar.add_task("scanning")

    def show(done: int, total: int) -> None:
        bar.start()
        bar.update(task, completed=done, total=total, description="scanning" if done < total else "summing up")

    try:
        yield show
    finally:
        if bar.live.is_started:
            bar.stop()


def print_scan(console: Console, scan: SingularityScan, *, degrees: bool, json: bool) -> None:
    """Print the scan in sentences, the worst configurations and a histogram, or all as JSON."""
    if json:
        write_json(as_json(scan))
        return
    lines = [
        scan.explain(),
        f"The {min(SHOWN, len(scan.worst))} nearest to singular, {symbols(scan)[scan.measures[0]]} and q:",
    ]
    for value, q in zip(scan.worst_values[:SHOWN], scan.worst, strict=False):
        lines.append(f"  {value:<10.4g} {vector(in_degrees(scan.robot, q, degrees))}")
    console.print("\n".join(lines), soft_wrap=True)
    console.print(_histogram(scan))


def _histogram(scan: SingularityScan) -> Table:
    """Return the histogram of the first measure, with a row from x to 2x; rare worst values share one row."""
    edges, counts = scan.histogram()
    largest = WORST_IS_LARGEST[scan.measures[0]]
    if len(counts) > ROWS:
        kept = slice(0, ROWS) if largest else slice(len(counts) - ROWS, None)
        rest = counts.sum() - counts[kept].sum()
        ends = [*edges[: ROWS + 1], edges[-1]] if largest else [edges[0], *edges[-ROWS - 1 :]]
        edges, counts = np.array(ends), np.array([*counts[kept], rest] if largest else [rest, *counts[kept]])
    table = Table(title=f"{symbols(scan)[scan.measures[0]]} of all configurations", title_justify="left")
    for heading in ("from", "to", "configurations"):
        table.add_column(heading, justify="right")
    table.add_column("")
    for low, high, inside in zip(edges[:-1], edges[1:], counts, strict=True):
        table.add_row(f"{low:.3g}", f"{high:.3g}", str(inside), "█" * round(WIDTH * inside / counts.max()))
    return table


def as_json(scan: SingularityScan) -> dict[str, Any]:
    """Return the scan as what JSON knows."""
    return {
        "robot": scan.robot.name,
        "rows": scan.task.row_names,
        "method": scan.method,
        "seed": scan.seed,
        "count": scan.count,
        "undefined": scan.undefined,
        "rank": scan.rank,
        "length": scan.length,
        "measures": {measure: _distribution(scan, measure) for measure in scan.measures},
        "worst": scan.worst,
        "worst_values": scan.worst_values,
        "refined": _refined(scan),
    }


def _distribution(scan: SingularityScan, measure: str) -> dict[str, Any]:
    edges, counts = scan.histogram(measure)
    quantiles = {f"{p:g}": scan.quantile(p, measure) for p in QUANTILES}
    return {"quantiles": quantiles, "histogram": {"edges": edges, "counts": counts}}


def _refined(scan: SingularityScan) -> dict[str, Any] | None:
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
                "gaps": group.gaps,
                "ranks": group.ranks,
                "starts": group.starts,
            }
            for group in scan.refined.groups
        ],
        "unreached": scan.refined.unreached,
        "branches": len(branches),
        "note": scan.refined.note,
        "missed": scan.refined.missed,
    }
