"""The command `robotics1 workspace`."""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from robotics1.cli import arguments
from robotics1.cli.options import AsJson, Frame, Locked, Packages, Parameters, RobotName, Tool
from robotics1.errors import InputError

if TYPE_CHECKING:
    from robotics1.workspaces.result import BoundaryCurve, Workspace

EXAMPLES = ("workspace planar_2r", "workspace planar_2r --box q1=-1:1 --box q2=0.5:pi/2 --figure reach.svg")
Boxes = Annotated[
    list[str] | None,
    typer.Option(
        "--box", help="A joint and its range [rad or m], as in q2=0.2:1.5; needed for a slide without limits."
    ),
]
TaskName = Annotated[str, typer.Option("--task", help="The task: position[:xyz].")]
Figure = Annotated[Path | None, typer.Option("--figure", help="A file for the picture: .svg, .pdf or .png.")]


def workspace(
    robot: RobotName,
    task: TaskName = "position:xy",
    box: Boxes = None,
    frame: Frame = None,
    param: Parameters = None,
    tool: Tool = None,
    packages: Packages = None,
    lock: Locked = None,
    figure: Figure = None,
    json: AsJson = False,
) -> None:
    """What an arm reaches: area or volume, smallest and largest reach, regions, and the boundary with its reasons."""
    from robotics1.cli.output import PlainConsole, write_json
    from robotics1.report.tables import table
    from robotics1.workspaces.find import workspace as exact_workspace

    arm = arguments.parse_robot(robot, param, tool, packages, lock)
    ws = exact_workspace(arm, arguments.parse_task(task, frame), box=_ranges(box))
    if figure is not None:
        from robotics1.plots.reach import plot_workspace

        plot_workspace(ws, file=figure, title=arm.name)
    if json:
        write_json(_as_json(ws))
        return
    out = PlainConsole()
    out.print(ws.explain().split("\nThe boundary")[0])
    for boundary in ws._tables():
        out.print(table(boundary.headings, boundary.rows, boundary.title, left=boundary.headings))


def _ranges(texts: Sequence[str] | None) -> dict[str, tuple[float, float]] | None:
    """Return ranges of joints typed as q2=0.2:1.5.

    Raises:
        InputError: one is not of this form.
    """
    ranges = {}
    for text in texts or ():
        name, _, ends = text.partition("=")
        low, colon, high = ends.partition(":")
        if not colon:
            raise InputError(f"{text[:100]!r} is not a range of a joint; write it like q2=0.2:1.5")
        ranges[name.strip()] = (arguments.parse_number(low), arguments.parse_number(high))
    return ranges or None


def _as_json(ws: "Workspace") -> dict[str, Any]:
    regions = {
        name: [{"solutions": r.solutions, "area": r.area, "volume": r.volume, "point": r.point} for r in found]
        for name, found in (("regions", ws.regions), ("voids", ws.voids))
    }
    numbers = {"area": ws.area, "volume": ws.volume, "r_min": ws.r_min, "r_max": ws.r_max, "redundant": ws.redundant}
    reach = {"nearest": ws.nearest, "farthest": ws.farthest, "coordinates": ws.coordinates}
    return numbers | reach | regions | {"boundary": [_curve_as_json(curve) for curve in ws.boundary]}


def _curve_as_json(curve: "BoundaryCurve") -> dict[str, Any]:
    return vars(curve) | {"kind": "segment" if curve.center is None else "arc"}
