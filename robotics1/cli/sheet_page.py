"""The command `robotics1 report`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from robotics1.cli import arguments
from robotics1.cli.options import AsJson, Degrees, Frame, Locked, Packages, Parameters, Q, RobotName, TaskName, Tool

EXAMPLES = ("report prr", "report ur5 --out ur5.html --open")


def report(
    robot: RobotName,
    page: Annotated[
        Path | None,
        typer.Option("--out", "-o", help="The page to write; by default ROBOT-sheet.html, of the robot's name."),
    ] = None,
    task: TaskName = None,
    frame: Frame = None,
    q: Q = None,
    time_limit: Annotated[float, typer.Option(help="Of all sections together [s].")] = 60.0,
    show: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False,
    param: Parameters = None,
    tool: Tool = None,
    packages: Packages = None,
    lock: Locked = None,
    degrees: Degrees = False,
    json: AsJson = False,
) -> None:
    """Write the data sheet of an arm: one offline page with its picture, formulas, singularities, workspace."""
    from robotics1.cli.output import PlainConsole, progress_bar, write_json
    from robotics1.data_sheet.sheet import report as data_sheet
    from robotics1.names import file_stem

    arm = arguments.parse_robot(robot, param, tool, packages, lock, degrees)
    with progress_bar("writing the sheet", hidden=json) as show_progress:
        made = data_sheet(
            arm,
            page or Path(f"{file_stem(arm.name)}-sheet.html"),
            task=None if task is None else arguments.parse_task(task, frame),
            q=None if q is None else arguments.configuration(arm, q, degrees),
            time_limit=time_limit,
            progress=show_progress,
        )
    if json:
        write_json({"files": [str(made.file)]})
    else:
        PlainConsole().print(f"wrote {made.file}", soft_wrap=True)
    if show and made.file is not None:
        import webbrowser

        webbrowser.open(made.file.resolve().as_uri())
