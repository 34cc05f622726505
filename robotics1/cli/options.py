"""The arguments and options that commands share."""

from pathlib import Path
from typing import Annotated

import typer

from robotics1.cli.arguments import TASKS

RobotName = Annotated[str, typer.Argument(help="A robot's name (prr, cylindrical, planar_2r) or a URDF or xacro file.")]
Parameters = Annotated[
    list[str] | None,
    typer.Option(
        "--param", "-p", help="A named length, as in l2=0.5, or a word that a xacro takes, as in ur_type=ur5e."
    ),
]
Packages = Annotated[
    list[Path] | None, typer.Option("--packages", help="A folder in which package:// looks for meshes and files.")
]
Tool = Annotated[str | None, typer.Option(help="The link that is the tool.")]
Frame = Annotated[str | None, typer.Option(help="The link that is asked about; by default the tool.")]
Q = Annotated[str | None, typer.Option("--q", help="Joint values, as in 0.5,pi/2,-0.7pi; by default zero.")]
TaskName = Annotated[str, typer.Option("--task", help=f"The task: {', '.join(TASKS)}.")]
Degrees = Annotated[
    bool, typer.Option("--degrees", help="Angles are read and printed in degrees; JSON stays in radians.")
]
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
