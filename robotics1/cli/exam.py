"""The command `robotics1 exam`."""

import importlib
import sys
from importlib.resources import files
from pathlib import Path
from types import ModuleType
from typing import Annotated

import typer

from robotics1.cli.options import AsJson
from robotics1.errors import InputError

EXAMPLES = ("exam", "exam --out answers", "exam my_exam.toml --seed 3")
FOLDER = Path("exam-2025-01-13")


def exam(
    file: Annotated[Path | None, typer.Argument(help="An exam as a TOML file; see docs/exams.md.")] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", "-o", help="The page to write, by default FILE.html; without a FILE, the folder."),
    ] = None,
    seed: Annotated[
        int | None, typer.Option(help="A variant of FILE: lengths and data drawn from the ranges in it.", min=0)
    ] = None,
    json: AsJson = False,
) -> None:
    """Solve an exam and check every published value: that of a file, or that of 13 January 2025."""
    from robotics1.cli.output import PlainConsole, progress_bar, write_json

    if file is not None:
        with progress_bar("answering", hidden=json) as show:
            page = out or Path(f"{file.stem}{'' if seed is None else f'-{seed}'}.html")
            worked = example("exams.from_file.worked").work_file(file, page, seed, show)
    elif seed is not None:
        raise InputError("--seed draws a variant of a file: give the file too")
    else:
        with PlainConsole(stderr=True).status("solving the exam"):
            worked = example("exams.exam_2025_01_13.worked").work_exam(out or FOLDER)
    if json:
        write_json(worked.as_json())
    else:
        worked.print(PlainConsole())
    raise typer.Exit(0 if worked.all_hold else 1)


def example(module: str) -> ModuleType:
    """Import a module of the folder `examples/` of the source tree, which a wheel carries inside the package."""
    installed = Path(str(files("robotics1"))) / "examples"
    folder = installed if installed.is_dir() else installed.parents[1] / "examples"
    if str(folder) not in sys.path:
        sys.path.append(str(folder))
    return importlib.import_module(module)
