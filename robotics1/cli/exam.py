"""The command `robotics1 exam`."""

from pathlib import Path
from typing import Annotated

import typer

from robotics1.cli.options import AsJson
from robotics1.cli.output import PlainConsole, write_json


def exam(
    folder: Annotated[Path, typer.Option("--out", help="The folder for figures and pages.")] = Path("exam-2025-01-13"),
    json: AsJson = False,
) -> None:
    """Solve the exam of 13 January 2025 and check every published value."""
    from robotics1.exams.worked_2025_01_13 import work_exam

    with PlainConsole(stderr=True).status("solving the exam"):
        worked = work_exam(folder)
    if json:
        write_json(worked.as_json())
    else:
        worked.print(PlainConsole())
    raise typer.Exit(0 if worked.all_hold else 1)
