"""The command line: its commands, and how each ends."""

import re
import sys
import traceback
import warnings
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from robotics1.cli.check import check
from robotics1.cli.ellipsoids import manipulability
from robotics1.cli.exam import exam
from robotics1.cli.fk import fk
from robotics1.cli.ik import ik
from robotics1.cli.jacobian import jacobian
from robotics1.cli.reach import reach
from robotics1.cli.robot_page import view
from robotics1.cli.robots import robots
from robotics1.cli.scan import scan
from robotics1.cli.sheet_page import report
from robotics1.cli.singularities import singularities
from robotics1.cli.statics import statics
from robotics1.cli.streams import streams_ready
from robotics1.cli.usage import CommandGroup, RobotCommand
from robotics1.cli.workspace_table import workspace
from robotics1.errors import Robotics1Error, RobotWarning
from robotics1.names import printable

RADIANS = r"write radians\(.*\)$"  # what Python would take; a command has an option for it

app = typer.Typer(
    cls=CommandGroup,
    help="Kinematics of robot arms: the number, the formula, the verdict, the picture.",
    no_args_is_help=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)


def examples_of(command: Callable[..., None]) -> str | None:
    """Return the examples of a command, as its help shows them: what EXAMPLES of its module holds."""
    examples = getattr(sys.modules[command.__module__], "EXAMPLES", ())
    return "\n".join(["\b", "Examples:", *(f"  robotics1 {example}" for example in examples)]) if examples else None


for command in (
    exam,
    fk,
    jacobian,
    manipulability,
    singularities,
    ik,
    statics,
    workspace,
    reach,
    scan,
    view,
    report,
    check,
    robots,
):
    app.command(cls=RobotCommand, epilog=examples_of(command))(command)


def _version(asked: bool) -> None:
    if asked:
        from importlib.metadata import version

        typer.echo(f"robotics1 {version('robotics1')}")
        raise typer.Exit


@app.callback()
def every_command(
    version: Annotated[
        bool,
        typer.Option("--version", help="Print the version.", is_eager=True, callback=_version),
    ] = False,
) -> None:
    """Kinematics of robot arms: the number, the formula, the verdict, the picture."""


def main() -> None:
    """Run the command: exit code 0 done, 1 the verdict is negative, 2 misuse or an error, 130 interrupted (Ctrl-C)."""
    try:
        with streams_ready(), warnings.catch_warnings():
            warnings.simplefilter("always", RobotWarning)
            warnings.showwarning = _shown_once()
            app()
    except KeyboardInterrupt:
        _stop("interrupted", 130)
    except SystemExit as end:
        if end.code == 130:  # Typer has caught the interrupt
            _stop("interrupted", 130)
        raise
    except (Robotics1Error, OSError) as error:
        _stop(f"error: {error}", 2)
    except Exception as error:  # 1 is a verdict: what this package got wrong must not look like one
        place = traceback.extract_tb(error.__traceback__)[-1]
        where = f"{Path(place.filename).name}, line {place.lineno}"
        _stop(f"error inside robotics1, please report it: {type(error).__name__}: {error} ({where})", 2)


def _shown_once() -> Callable[..., None]:
    """Return what shows a warning, unless it has shown the same one before."""
    shown: set[str] = set()

    def show(message: Warning | str, *_: object, **__: object) -> None:
        from robotics1.cli.output import PlainConsole

        if str(message) not in shown:
            shown.add(str(message))
            text = str(message) if sys.argv[1:2] == ["exam"] else re.sub(RADIANS, "add --degrees", str(message))
            PlainConsole(stderr=True).say(printable(f"warning: {text}"), style="yellow")

    return show


def _stop(message: str, code: int) -> NoReturn:
    """Print a message on one line, whatever it holds, and end."""
    from robotics1.cli.output import PlainConsole

    PlainConsole(stderr=True).say(printable(message), style="red")
    sys.exit(code)
