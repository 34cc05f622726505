"""The command line: its commands, and how each ends."""

import sys
import traceback
import warnings
from pathlib import Path
from typing import NoReturn

import typer

from robotics1.cli.check import check
from robotics1.cli.exam import exam
from robotics1.cli.fk import fk
from robotics1.cli.ik import ik
from robotics1.cli.jacobian import jacobian
from robotics1.cli.output import PlainConsole
from robotics1.cli.robot_page import view
from robotics1.cli.scan import scan
from robotics1.cli.sheet_page import report
from robotics1.cli.singularities import singularities
from robotics1.cli.statics import statics
from robotics1.cli.streams import streams_ready
from robotics1.cli.workspace_table import workspace
from robotics1.errors import Robotics1Error, RobotWarning
from robotics1.names import printable

app = typer.Typer(
    help="Kinematics of robot arms: the number, the formula, the verdict, the picture.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
for command in (exam, fk, jacobian, singularities, ik, statics, workspace, scan, view, report, check):
    app.command()(command)


def main() -> None:
    """Run the command: exit code 0 done, 1 the verdict is negative, 2 misuse or an error, 130 interrupted (Ctrl-C)."""
    try:
        with streams_ready(), warnings.catch_warnings():
            warnings.simplefilter("always", RobotWarning)
            warnings.showwarning = _show_warning
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


def _show_warning(message: Warning | str, *_: object, **__: object) -> None:
    PlainConsole(stderr=True).print(printable(f"warning: {message}"), style="yellow", soft_wrap=True)


def _stop(message: str, code: int) -> NoReturn:
    """Print a message on one line, whatever it holds, and end."""
    PlainConsole(stderr=True).print(printable(message), style="red", soft_wrap=True)
    sys.exit(code)
