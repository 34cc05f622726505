"""The command `robotics1 exam`."""

import importlib
import sys
from pathlib import Path
from types import ModuleType
from typing import Annotated

import typer

from robotics1.cli.options import AsJson

EXAMPLES = ("exam", "exam --out answers.html", "exam my_exam.toml --seed 3")
FIRST = "exam_2025_01_13.toml"


def exam(
    file: Annotated[
        Path | None,
        typer.Argument(help="An exam as a TOML file, see docs/exams.md; by default that of 13 January 2025."),
    ] = None,
    out: Annotated[Path | None, typer.Option("--out", "-o", help="The page to write, by default FILE.html.")] = None,
    seed: Annotated[
        int | None, typer.Option(help="A variant of FILE: lengths and data drawn from the ranges in it.", min=0)
    ] = None,
    json: AsJson = False,
) -> None:
    """Solve an exam and check every published value: that of a file, or that of 13 January 2025."""
    from robotics1.cli.output import PlainConsole, progress_bar, write_json
    from robotics1.robot.sources import own_folder

    source = own_folder("examples") / "exams" / FIRST if file is None else file
    with progress_bar("answering", hidden=json) as show:
        page = out or Path(f"{source.stem}{'' if seed is None else f'-{seed}'}.html")
        worked = example("exams.from_file.worked").work_file(source, page, seed, show)
    if json:
        write_json(worked.as_json())
    else:
        worked.print(PlainConsole())
    raise typer.Exit(0 if worked.all_hold else 1)


def example(module: str) -> ModuleType:
    """Import a module of the folder of examples."""
    from robotics1.robot.sources import own_folder

    folder = str(own_folder("examples"))
    if folder not in sys.path:
        sys.path.append(folder)
    return importlib.import_module(module)
