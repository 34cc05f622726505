"""The command `robotics1 view`."""

import webbrowser
from pathlib import Path
from typing import Annotated

import typer

from robotics1.cli import arguments
from robotics1.cli.options import AsJson, Degrees, Parameters, Q, RobotName, Tool
from robotics1.cli.output import PlainConsole, in_degrees, say_outside_limits, write_json
from robotics1.names import file_stem
from robotics1.notation import vector


def view(
    robot: RobotName,
    q: Q = None,
    page: Annotated[
        Path | None,
        typer.Option(
            "--out", "-o", help="The page to write; by default ROBOT.html, of the letters and digits of its name."
        ),
    ] = None,
    show: Annotated[bool, typer.Option("--open", help="Open the page in the browser.")] = False,
    param: Parameters = None,
    tool: Tool = None,
    degrees: Degrees = False,
    json: AsJson = False,
) -> None:
    """Write an offline page that shows the robot."""
    from robotics1.viewer.animation import view as write_view

    arm = arguments.parse_robot(robot, param, tool)
    values = arguments.configuration(arm, q, degrees)
    caption = f"q = {vector(in_degrees(arm, values, degrees))}"
    written = write_view(arm, values, page or Path(f"{file_stem(arm.name)}.html"), caption=caption)
    if json:
        write_json({"files": [str(written)]})
    else:
        out = PlainConsole()
        say_outside_limits(out, arm, values)
        out.print(f"wrote {written}", soft_wrap=True)
    if show:
        webbrowser.open(written.resolve().as_uri())
