"""The arguments and options that commands share."""

from pathlib import Path
from typing import Annotated

import typer

TASKS = ("position[:xyz]", "planar-pose[:xy]", "orientation", "pose", "pointing[:z]")


def complete_robot(beginning: str) -> list[str]:
    """Return the named robots that begin so, for a shell that completes."""
    from robotics1.robot.sources import named_robots

    return [name for name in named_robots() if name.startswith(beginning)]


RobotName = Annotated[
    str,
    typer.Argument(
        help="A robot's name (prr, cylindrical, planar_2r; `robotics1 robots` lists more) or a URDF or xacro file.",
        autocompletion=complete_robot,
    ),
]
Parameters = Annotated[
    list[str] | None,
    typer.Option(
        "--set", "--param", "-p", help="A named length, as in l2=0.5, or a word that a xacro takes, as in ur_type=ur5e."
    ),
]
Locked = Annotated[
    list[str] | None, typer.Option("--lock", help="A joint that is held, as in q1=0.2 [rad, m, or --degrees].")
]
Packages = Annotated[
    list[Path] | None, typer.Option("--packages", help="A folder in which package:// looks for meshes and files.")
]
Tool = Annotated[str | None, typer.Option(help="The link that is the tool.")]
Frame = Annotated[str | None, typer.Option(help="The link that is asked about; by default the tool.")]
Q = Annotated[
    str | None,
    typer.Option(
        "--q", "-q", help="Joint values, as in 0.5,pi/2,-0.7pi or q1=0.5,q2=1; or a posture's name; by default zero."
    ),
]
TaskName = Annotated[
    str | None, typer.Option("--task", help=f"The task: {', '.join(TASKS)}; by default by the kind of robot.")
]
Degrees = Annotated[
    bool,
    typer.Option("--degrees", help="Angles are read and printed in degrees; JSON stays in radians."),
]
TypedDegrees = Annotated[bool, typer.Option("--degrees", help="The angles of the other options are in degrees.")]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
