"""The command `robotics1 report`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from robotics1.cli.options import AsJson, Frame, OpenPage, Q, TaskName, TypedRobot, robot_command

EXAMPLES = ("report prr", "report ur5 --out ur5.html --open")


@robot_command
def report(
    arm: TypedRobot,
    page: Annotated[
        Path | None,
        typer.Option("--out", "-o", help="The page to write; by default ROBOT-sheet.html, of the robot's name."),
    ] = None,
    task: TaskName = None,
    frame: Frame = None,
    q: Q = None,
    time_limit: Annotated[float, typer.Option(help="Of all sections together [s].")] = 60.0,
    show: OpenPage = False,
    json: AsJson = False,
) -> None:
    """Write the data sheet of an arm: one offline page with its picture, formulas, singularities, workspace."""
    from robotics1.cli.output import progress_bar, say_written
    from robotics1.data_sheet.sheet import report as data_sheet
    from robotics1.names import file_stem

    with progress_bar("writing the sheet", hidden=json) as show_progress:
        made = data_sheet(
            arm.robot,
            page or Path(f"{file_stem(arm.robot.name)}-sheet.html"),
            task=None if task is None else arm.task(task, frame),
            q=None if q is None else arm.configuration(q),
            time_limit=time_limit,
            progress=show_progress,
        )
    say_written(made, json=json, show=show)
