"""The command `robotics1 exam`."""

import importlib
import sys
from importlib.resources import files
from pathlib import Path
from types import ModuleType
from typing import Annotated

import typer

from robotics1.cli.options import AsJson

EXAMPLES = ("exam", "exam --out answers")


def exam(
    folder: Annotated[Path, typer.Option("--out", help="The folder for figures and pages.")] = Path("exam-2025-01-13"),
    json: AsJson = False,
) -> None:
    """Solve the exam of 13 January 2025 and check every published value."""
    from robotics1.cli.output import PlainConsole, write_json

    with PlainConsole(stderr=True).status("solving the exam"):
        worked = example("exams.exam_2025_01_13.worked").work_exam(folder)
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
