"""The commands: each reads its arguments, asks the package, and prints."""

import sys
import traceback
import warnings
import webbrowser
from pathlib import Path
from typing import Annotated, NoReturn

import typer

from robotics1.cli import arguments, output
from robotics1.cli.ik import ik
from robotics1.cli.options import AsJson, Degrees, Frame, Parameters, Q, RobotName, TaskName, Tool
from robotics1.cli.scan import scan
from robotics1.cli.streams import streams_ready
from robotics1.errors import Robotics1Error, RobotWarning
from robotics1.names import file_stem, printable
from robotics1.notation import vector
from robotics1.report.tables import matrix_table

app = typer.Typer(
    help="Kinematics of robot arms: the number, the formula, the verdict, the picture.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
out, err = output.PlainConsole(), output.PlainConsole(stderr=True)


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
    err.print(printable(f"warning: {message}"), style="yellow", soft_wrap=True)


def _stop(message: str, code: int) -> NoReturn:
    """Print a message on one line, whatever it holds, and end."""
    err.print(printable(message), style="red", soft_wrap=True)
    sys.exit(code)


@app.command()
def exam(
    folder: Annotated[Path, typer.Option("--out", help="The folder for figures and pages.")] = Path("exam-2025-01-13"),
    json: AsJson = False,
) -> None:
    """Solve the exam of 13 January 2025 and check every published value."""
    from robotics1.exams.worked_2025_01_13 import work_exam

    with err.status("solving the exam"):
        worked = work_exam(folder)
    if json:
        output.write_json(worked.as_json())
    else:
        worked.print(out)
    raise typer.Exit(0 if worked.all_hold else 1)


@app.command()
def fk(
    robot: RobotName,
    q: Q = None,
    frame: Frame = None,
    param: Parameters = None,
    tool: Tool = None,
    degrees: Degrees = False,
    json: AsJson = False,
) -> None:
    """Forward kinematics: where a frame is."""
    from robotics1.kinematics import forward_kinematics

    arm = arguments.parse_robot(robot, param or [], tool)
    values = arguments.configuration(arm, q, degrees)
    T = forward_kinematics(arm, values, frame=frame)
    if json:
        output.write_json({"q": values, "position": T.translation, "rotation": T.rotation})
        return
    output.say_outside_limits(out, arm, values)
    where = f"{printable(frame or arm.tool or '')} of {printable(arm.name)}"
    out.print(f"{where} at q = {vector(output.in_degrees(arm, values, degrees))}")
    out.print(f"p = {vector(T.translation)} m")
    out.print(matrix_table(T.rotation, title="R"))


@app.command()
def jacobian(
    robot: RobotName,
    q: Q = None,
    task: TaskName = "pose",
    frame: Frame = None,
    param: Parameters = None,
    tool: Tool = None,
    degrees: Degrees = False,
    symbolic: Annotated[bool, typer.Option("--symbolic", help="Formulas instead of numbers; --q is not used.")] = False,
    latex: Annotated[bool, typer.Option("--latex", help="Formulas in LaTeX.")] = False,
    python: Annotated[bool, typer.Option("--python", help="J as a Python function that needs NumPy alone.")] = False,
    angles: Annotated[str | None, typer.Option(help="Of orientation or pose: the analytic J of ZYZ, XYZ, ...")] = None,
    rows: Annotated[str | None, typer.Option(help="Some rows, as in y,wz.")] = None,
    point: Annotated[str | None, typer.Option(help="A point of the frame instead, as in 0,0,0.1 or 0,0,d.")] = None,
    json: AsJson = False,
) -> None:
    """The Jacobian of a task, its rank and its subspaces; or its formulas, with determinant or minors."""
    arm = arguments.parse_robot(robot, param or [], tool)
    what = arguments.parse_task(task, frame, angles)
    chosen = None if rows is None else arguments.parse_names(rows)
    at = None if point is None else arguments.parse_point(point)
    if symbolic or latex or python:
        from robotics1.cli.symbolic import print_formulas

        print_formulas(out, arm, what, point=at, rows=chosen, latex=latex, python=python, json=json)
        return
    from robotics1.cli.jacobian import print_jacobian

    values = arguments.configuration(arm, q, degrees)
    print_jacobian(out, arm, what, values, name=task, point=at, rows=chosen, degrees=degrees, json=json)


@app.command()
def singularities(
    robot: RobotName,
    task: TaskName = "pose",
    frame: Frame = None,
    method: Annotated[str, typer.Option(help="auto, symbolic or numeric.")] = "auto",
    time_limit: Annotated[float, typer.Option(help="Of the exact answer, in seconds.")] = 30.0,
    intersections: Annotated[bool, typer.Option("--intersections", help="The rank where branches meet too.")] = False,
    latex: Annotated[bool, typer.Option("--latex", help="Conditions and bases in LaTeX.")] = False,
    python: Annotated[bool, typer.Option("--python", help="Conditions and bases as Python functions.")] = False,
    param: Parameters = None,
    tool: Tool = None,
    json: AsJson = False,
) -> None:
    """All singular configurations of a task: where, what is lost there, and what does not move the tool."""
    from robotics1.analysis.singularity import find_singularities
    from robotics1.cli.singularities import print_singularities

    arm = arguments.parse_robot(robot, param or [], tool)
    with err.status("searching"):
        found = find_singularities(arm, arguments.parse_task(task, frame), method=method, time_limit=time_limit)
        print_singularities(out, found, latex=latex, python=python, intersections=intersections, json=json)


app.command()(ik)


@app.command()
def statics(
    robot: RobotName,
    force: Annotated[str, typer.Option(help="The force on the tool by the environment, one number a task row.")],
    q: Q = None,
    task: TaskName = "position",
    frame: Frame = None,
    param: Parameters = None,
    tool: Tool = None,
    degrees: Degrees = False,
    json: AsJson = False,
) -> None:
    """The torques that balance a force on the tool, τ = −Jᵀ f."""
    import numpy as np

    from robotics1.analysis.rounded_configuration import singularity_within_rounding
    from robotics1.analysis.singularity_words import directions
    from robotics1.analysis.statics import balancing_torque

    arm = arguments.parse_robot(robot, param or [], tool)
    values = arguments.configuration(arm, q, degrees)
    what = arguments.parse_task(task, frame)
    rounded = singularity_within_rounding(arm, what, values)
    torque = balancing_torque(rounded.spaces.J, arguments.parse_vector(force))
    free, there = rounded.spaces.left_null, rounded.at_singularity
    within = np.abs(torque) <= arm.max_effort
    if json:
        from robotics1.cli.jacobian import as_json

        answer = {"q": values, "torque": torque, "within_limits": within, "forces_without_torque": free.T}
        output.write_json(answer | {"status": rounded.status.name, "at_singularity": as_json(rounded)})
        return
    output.say_outside_limits(out, arm, values)
    out.print(f"τ = −Jᵀ f = {vector(torque)} for ({', '.join(output.joint_names(arm))}) [N m, for a prismatic joint N]")
    for name, value, ok, limit in zip(output.joint_names(arm), torque, within, arm.max_effort, strict=True):
        if not ok:
            out.print(f"{name} would need {value:.4g}, beyond its effort limit {limit:.4g}", style="yellow")
    if free.size:
        out.print(f"forces along {directions(free)} need no torque")
    if there is not None:
        out.print(rounded.explain(), style="yellow", markup=False)
        out.print(f"there forces along {directions(there.left_null)} need no torque")


app.command()(scan)


@app.command()
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

    arm = arguments.parse_robot(robot, param or [], tool)
    values = arguments.configuration(arm, q, degrees)
    caption = f"q = {vector(output.in_degrees(arm, values, degrees))}"
    written = write_view(arm, values, page or Path(f"{file_stem(arm.name)}.html"), caption=caption)
    if json:
        output.write_json({"files": [str(written)]})
    else:
        output.say_outside_limits(out, arm, values)
        out.print(f"wrote {written}", soft_wrap=True)
    if show:
        webbrowser.open(written.resolve().as_uri())


@app.command()
def check(
    robot: RobotName,
    dh: Annotated[Path | None, typer.Option("--dh", help="A CSV file type,a,alpha,d,theta to compare with.")] = None,
    convention: Annotated[str, typer.Option(help="Of the DH table: standard or modified.")] = "standard",
    packages: Annotated[list[Path] | None, typer.Option(help="A folder in which package:// looks.")] = None,
    trusted: Annotated[bool, typer.Option("--trusted", help="Let a xacro read YAML and the environment.")] = False,
    param: Parameters = None,
    tool: Tool = None,
    json: AsJson = False,
) -> None:
    """The verdict on a robot file, and what was understood of it."""
    from robotics1.cli import check as checking
    from robotics1.dh.to_robot import robot_from_dh
    from robotics1.robot.loading import check_robot
    from robotics1.robot.report import AGREES

    values = arguments.parse_parameters(param or [])
    found = check_robot(robot, parameters=values, tool=tool, packages=packages or (), trusted=trusted)
    difference = None
    if dh is not None and found.robot is not None:
        table = robot_from_dh(checking.read_dh_table(dh), convention=convention)
        difference = checking.difference_from(found.robot, table)
    if json:
        output.write_json(checking.as_json(found, difference))
    else:
        checking.print_report(out, found, difference)
    raise typer.Exit(0 if found.sound and (difference is None or difference <= AGREES) else 1)
