"""The options that commands share, and the robot that some of them describe.

Heavy libraries are imported where they are used: `--help` needs none of them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass, replace
from functools import wraps
from inspect import Parameter, signature
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from robotics1.cli.arguments import named_texts, parse_names, parse_number, parse_parameters, parse_vector, without_pi
from robotics1.errors import InputError

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from robotics1.inputs import Array
    from robotics1.robot.model import Robot
    from robotics1.tasks.task import FrameTask

TASKS = ("position[:xyz]", "planar-pose[:xy]", "orientation", "pose", "pointing[:z]")


def complete_robot(beginning: str) -> list[str]:
    """Return the named robots that begin so, for a shell that completes."""
    from robotics1.robot.sources import named_robots

    return [name for name in named_robots() if name.startswith(beginning)]


RobotName = Annotated[
    str,
    typer.Argument(
        metavar="robot",
        help="A robot's name (prr, cylindrical, planar_2r; `robotics1 robots` lists more) or a URDF, xacro or MJCF.",
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
Trusted = Annotated[
    bool, typer.Option("--trusted", help="Let the robot's file name any files of this computer; MJCF needs it.")
]
Tool = Annotated[str | None, typer.Option(help="The link that is the tool.")]
Degrees = Annotated[
    bool,
    typer.Option("--degrees", help="Angles are read and printed in degrees; JSON stays in radians."),
]
TypedDegrees = Annotated[bool, typer.Option("--degrees", help="The angles of the other options are in degrees.")]
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
AsJson = Annotated[bool, typer.Option("--json", help="Print JSON.")]
Figure = Annotated[Path | None, typer.Option("--figure", help="A file for the picture: .svg, .pdf or .png.")]
OpenPage = Annotated[bool, typer.Option("--open", help="Open the page in the browser.")]


@dataclass(frozen=True)
class TypedRobot:
    """The robot that is typed, and how its angles are; each field is an option of the commands."""

    source: RobotName
    param: Parameters = None
    tool: Tool = None
    packages: Packages = None
    lock: Locked = None
    trusted: Trusted = False
    degrees: Degrees = False

    @property
    def robot(self) -> Robot:
        """The robot, as `load_robot` returns it; it is loaded once."""
        from robotics1.robot.loading import load_robot

        kept: dict[str, Any] = vars(self)
        if "_robot" not in kept:
            kept["_robot"] = load_robot(self.source, **self.loading)
        return kept["_robot"]  # type: ignore[no-any-return]

    @property
    def loading(self) -> dict[str, Any]:
        """The arguments of `load_robot` and `check_robot`.

        Raises:
            Robotics1Error: one cannot be read; or joints are locked in degrees, and the robot cannot be loaded, which
                says which of them turn.
        """
        from robotics1.robot.loading import load_robot

        given: dict[str, Any] = {"parameters": parse_parameters(self.param), "packages": self.packages or ()}
        given |= {"tool": self.tool, "trusted": self.trusted}
        locked = dict(named_texts(self.lock, "no locked joint", "q1=0.2"))
        turning = _turning(load_robot(self.source, **given)) if self.degrees and locked else ()
        return given | {"locked": {name: self._value(value, name in turning) for name, value in locked.items()}}

    def configuration(self, text: str | None) -> Array:
        """Return q as typed: numbers, q1=0.5,q2=1, or a posture's name; by default zero, moved inside the limits.

        Raises:
            InputError: the wrong number of values.
        """
        import numpy as np

        robot, text = self.robot, (text or "zero").strip()
        if text in robot.postures:
            return robot.configuration(text)
        if "=" in text:
            pairs = [part.partition("=") for part in parse_names(text)]
            turning = _turning(robot)
            return robot.configuration({name: self._value(value, name in turning) for name, _, value in pairs})
        values = parse_vector(text, self.degrees)
        in_degrees = self.degrees and values.shape == (robot.nq,)
        return robot.configuration(np.where(self._angles, np.radians(values), values) if in_degrees else values)

    def box(self, texts: Sequence[str] | None) -> dict[str, tuple[float, float]]:
        """Return joint → (lower, upper), each typed as q1=-1:pi/2.

        Raises:
            InputError: one of them is not name=lower:upper.
        """
        box, turning = {}, _turning(self.robot)
        for name, interval in named_texts(texts, "not an interval", "q1=-1:pi/2"):
            ends = interval.split(":")
            if len(ends) != 2:
                raise InputError(f"{f'{name}={interval}'[:100]!r} is not an interval; write it like q1=-1:pi/2")
            lower, upper = (self._value(end, name in turning) for end in ends)
            box[name] = (lower, upper)
        return box

    def task(self, text: str | None, frame: str | None, angles: str | None = None) -> FrameTask:
        """Return the task of a short form; without one, the task that the robot is made for.

        An arm in the plane z = 0 has a planar pose from three joints on, else a position; an arm in space a pose from
        six joints on, else a position.

        Raises:
            InputError: it is no short form, or has no angles.
        """
        from robotics1.tasks.given import short_form

        if text is not None or angles is not None:
            return short_form(text or "pose", frame, angles)
        from robotics1.tasks.position import PositionTask
        from robotics1.viewer.arm_data import default_task

        usual: Any = default_task(self.robot) or PositionTask()
        return replace(usual, frame=frame)  # type: ignore[no-any-return]

    def shown(self, q: Array) -> Array:
        """Return q for printing: its angles in degrees where asked."""
        import numpy as np

        return np.where(self._angles, np.degrees(q), q) if self.degrees else q

    @property
    def _angles(self) -> npt.NDArray[np.bool_]:
        """Which entries of q are angles, (nq,)."""
        import numpy as np

        from robotics1.cli.output import units

        return np.array([unit == "rad" for unit in units(self.robot)])

    def _value(self, text: str, turns: bool) -> float:
        """Return the value of a joint as typed, of one that turns in degrees where asked."""
        value = parse_number(without_pi(text) if self.degrees else text)
        return math.radians(value) if self.degrees and turns else value


@dataclass(frozen=True)
class RobotOfFormulas(TypedRobot):
    """The robot of a command that prints no angles of configurations."""

    degrees: TypedDegrees = False


def _turning(robot: Robot) -> Collection[str]:
    """Return the names of the joints that turn."""
    return {name for name, turns in zip(robot.joint_names, robot.revolute, strict=False) if turns}


def robot_command(command: Callable[..., None]) -> Callable[..., None]:
    """Give a command the options of a `TypedRobot`, or of a kind of it, in the place of its first parameter."""
    first, *own = signature(command, eval_str=True).parameters.values()
    source, *others = signature(first.annotation, eval_str=True).parameters.values()

    @wraps(command)
    def run(**given: Any) -> None:
        typed = {parameter.name: given.pop(parameter.name) for parameter in (source, *others)}
        command(first.annotation(**typed), **given)

    options = (source, *own[:-1], *others, own[-1])  # the last is --json
    listed = [option.replace(kind=Parameter.KEYWORD_ONLY) for option in options]
    run.__dict__.update(__signature__=signature(command).replace(parameters=listed))
    return run
