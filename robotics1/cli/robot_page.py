"""The command `robotics1 view`."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from robotics1.cli.options import TASKS, AsJson, OpenPage, Q, TypedRobot, robot_command
from robotics1.errors import InputError
from robotics1.names import file_stem

if TYPE_CHECKING:
    from robotics1.viewer.page import Page

EXAMPLES = ("view prr --q 0.3,0.6,0.7 --open", "view ur5 -o ur5.html", "view planar_2r --trajectory motion.csv --serve")


@robot_command
def view(
    arm: TypedRobot,
    q: Q = None,
    trajectory: Annotated[
        Path | None,
        typer.Option(
            help="A recorded motion to play, as CSV: a column t [s] and one for each joint [rad or m], by name or "
            "in the order of q."
        ),
    ] = None,
    task: Annotated[
        str | None,
        typer.Option(help=f"The task whose Jacobian is shown: {', '.join(TASKS)}; by default by the robot."),
    ] = None,
    page: Annotated[
        Path | None,
        typer.Option(
            "--out", "-o", help="The page to write; by default ROBOT.html, of the letters and digits of its name."
        ),
    ] = None,
    show: OpenPage = False,
    server: Annotated[
        bool, typer.Option("--serve", help="Write no file; show the page at an address of this computer until Ctrl-C.")
    ] = False,
    port: Annotated[int, typer.Option(help="The port of --serve; 0 takes a free one.", min=0, max=65535)] = 0,
    json: AsJson = False,
) -> None:
    """Write an offline page to play with a robot, or to watch a recorded motion."""
    from robotics1.cli.output import PlainConsole, say_outside_limits, say_written

    file = None if server else page or Path(f"{file_stem(arm.robot.name)}.html")
    made = _page(arm, q, trajectory, task, file)
    if server:
        _serve(made, port, show)
        return
    if not json:
        say_outside_limits(PlainConsole(), arm.robot, arm.configuration(q))
    say_written(made, json=json, show=show)


def _page(arm: TypedRobot, q: str | None, trajectory: Path | None, task: str | None, file: Path | None) -> Page:
    """Return the page of a recorded motion, or of a configuration."""
    from robotics1.notation import vector
    from robotics1.viewer.animation import animate, view as view_robot
    from robotics1.viewer.recording import read_recording

    if trajectory is None:
        values = arm.configuration(q)
        return view_robot(arm.robot, values, file, task=task, caption=f"q = {vector(arm.shown(values))}")
    if q is not None:
        raise InputError("give --q or --trajectory, not both")
    times, recorded = read_recording(trajectory, arm.robot)
    return animate(arm.robot, times=times, q=recorded, file=file, task=task, caption=trajectory.name)


def _serve(page: Page, port: int, show: bool) -> None:
    import webbrowser

    from robotics1.cli.output import PlainConsole
    from robotics1.viewer.server import serve

    def started(address: str) -> None:
        PlainConsole().print(f"{address}  (Ctrl-C ends it)", soft_wrap=True)
        if show:
            webbrowser.open(address)

    try:
        serve(page.html, port, started)
    except OSError as error:
        raise InputError(f"the port {port} cannot be used: {error.strerror}") from error
