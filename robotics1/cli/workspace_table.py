"""The command `robotics1 workspace`."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Annotated, Any

import typer

from robotics1.cli.arguments import parse_vector
from robotics1.cli.options import AsJson, Figure, Frame, RobotOfFormulas, robot_command
from robotics1.errors import InputError

if TYPE_CHECKING:
    from robotics1.robot.model import Robot
    from robotics1.tasks.position import PositionTask
    from robotics1.workspaces.result import Workspace

EXAMPLES = ("workspace planar_2r", "workspace planar_2r --box q1=-1:1 --box q2=0.5:pi/2 --figure reach.svg")
Boxes = Annotated[
    list[str] | None,
    typer.Option(
        "--box",
        help="A joint and its range [rad, m, or --degrees], as q2=0.2:1.5; needed for a slide without limits.",
    ),
]
TaskName = Annotated[
    str | None,
    typer.Option("--task", help="The task: position[:xyz]; by default all three coordinates, or the arm's plane."),
]
Points = Annotated[
    list[str] | None,
    typer.Option("--point", help="A point [m], as in 0.3,0.2: is it reached, and how far is the boundary?"),
]
Line = Annotated[
    str | None, typer.Option("--line", help="Two points [m], as in -1,0.1:1,0.1: where does the line enter and leave?")
]
Slices = Annotated[
    list[str] | None,
    typer.Option("--slice", help="A point and a normal, as in 0,0,0.3:0,0,1: what is reached in this plane?"),
]
Circle = Annotated[bool, typer.Option("--circle", help="Also the largest circle that fits into the section.")]
Symbolic = Annotated[bool, typer.Option("--formulas", help="Also the radii and the area or volume as formulas.")]
Dexterous = Annotated[
    bool, typer.Option("--dexterous", help="Also the points that are reached with every orientation.")
]


@robot_command
def workspace(
    arm: RobotOfFormulas,
    task: TaskName = None,
    box: Boxes = None,
    frame: Frame = None,
    point: Points = None,
    line: Line = None,
    slices: Slices = None,
    circle: Circle = False,
    dexterous: Dexterous = False,
    formulas: Symbolic = False,
    figure: Figure = None,
    json: AsJson = False,
) -> None:
    """What an arm reaches: area or volume, smallest and largest reach, regions, and the boundary with its reasons."""
    from robotics1.cli.output import PlainConsole, write_json
    from robotics1.terminal_tables import table
    from robotics1.workspaces.find import workspace as found_workspace

    robot, ranges = arm.robot, arm.box(box) or None
    asked = arm.task(task, frame) if task is not None else _own_task(robot, frame)
    ws = found_workspace(robot, asked, box=ranges)
    if figure is not None:
        from robotics1.plots.reach import plot_workspace

        plot_workspace(ws, file=figure, title=robot.name)
    answers = _answers(ws, point, line, circle, slices)
    if dexterous:
        from robotics1.workspaces.questions.dexterous import dexterous_workspace

        answers.append(("dexterous", dexterous_workspace(robot, asked, box=ranges)))
    if formulas:
        from robotics1.workspaces.questions.formulas_of_reach import workspace_formulas

        answers.append(("formulas", workspace_formulas(robot, asked, box=ranges)))
    if json:
        write_json(_as_json(ws) | {name: _answer_as_json(answer) for name, answer in answers})
        return
    out = PlainConsole()
    out.print(ws.explain().split("\nThe boundary")[0])
    for boundary in ws._tables() if ws.boundary else ():
        out.print(table(boundary.headings, boundary.rows, boundary.title, left=boundary.headings))
    for _, answer in answers:
        out.print(answer.explain())


def _own_task(robot: "Robot", frame: str | None) -> "PositionTask":
    """Return the position in space, or in the plane in which the arm moves."""
    import numpy as np

    from robotics1.tasks.position import PositionTask

    robot.require_single_coordinates("have a workspace")
    lower, upper = np.clip(robot.lower, -1, 1), np.clip(robot.upper, -1, 1)
    q = np.random.default_rng(0).uniform(lower, upper, (4, robot.nq))
    columns = np.hstack([PositionTask(frame=frame).jacobian(robot, one) for one in q])
    moving = np.abs(columns).max(axis=1, initial=0.0) > 1e-9
    letters = "".join(letter for letter, moves in zip("xyz", moving, strict=True) if moves)
    return PositionTask(letters if len(letters) == 2 else "xyz", frame=frame)


def _answers(
    ws: "Workspace", points: Sequence[str] | None, line: str | None, circle: bool, planes: Sequence[str] | None
) -> list[tuple[str, Any]]:
    """Return what was asked of a workspace, by name."""
    from robotics1.workspaces.questions.fitting import largest_circle
    from robotics1.workspaces.questions.membership import is_reached
    from robotics1.workspaces.questions.passages import crossings
    from robotics1.workspaces.questions.plane_sections import plane_section

    found: list[tuple[str, Any]] = [(f"point {text}", is_reached(ws, parse_vector(text))) for text in points or ()]
    if line is not None:
        start, colon, end = line.partition(":")
        if not colon:
            raise InputError(f"{line[:100]!r} is not a line; write it like -1,0.1:1,0.1")
        found.append(("line", crossings(ws, [parse_vector(start), parse_vector(end)])))
    for text in planes or ():
        place, colon, normal = text.partition(":")
        if not colon:
            raise InputError(f"{text[:100]!r} is not a plane; write a point and a normal like 0,0,0.3:0,0,1")
        cut = plane_section(ws, parse_vector(place), parse_vector(normal))
        found.append((f"slice {text}", cut))
    if circle:
        found.append(("circle", largest_circle(ws)))
    return found


def _answer_as_json(answer: Any) -> dict[str, Any]:
    """Return the numbers of an answer and its sentences."""
    plain = {name: value for name, value in vars(answer).items() if not hasattr(value, "__dataclass_fields__")}
    plain.pop("regions", None)
    plain.pop("outlines", None)
    plain = {name: str(value) if hasattr(value, "free_symbols") else value for name, value in plain.items()}
    return plain | {"explanation": answer.explain()}


def _as_json(ws: "Workspace") -> dict[str, Any]:
    from robotics1.cli.output import attributes

    regions = {
        name: [attributes(region, "solutions area volume point") for region in found]
        for name, found in (("regions", ws.regions), ("voids", ws.voids))
    }
    numbers = "area volume r_min r_max r_bounds redundant volume_error resolution cusps nodes"
    answer = {"units": {"area": "m^2", "volume": "m^3", "lengths": "m"}, **attributes(ws, numbers)}
    boundary = [vars(curve) | {"kind": curve.kind} for curve in ws.boundary]
    return answer | attributes(ws, "nearest farthest coordinates") | regions | {"boundary": boundary}
