"""What is typed at the command line, turned into robots, tasks and vectors."""

import re
from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.robot.loading import load_robot
from robotics1.robot.model import Robot
from robotics1.tasks.planar_pose import PlanarPoseTask
from robotics1.tasks.pose import OrientationTask, PoseTask
from robotics1.tasks.position import PositionTask
from robotics1.tasks.task import FrameTask

TASKS = ("position[:xyz]", "planar-pose[:xy]", "orientation", "pose")
NUMBER = re.compile(  # with one way only to read each text: else a long one takes the square of its length
    r"([+-]?)((?:\d+(?:\.\d*)?|\.\d+)?(?:e[+-]?\d+)?)\s*(?:\*\s*)?(pi|π)?(?:/(\d+(?:\.\d*)?))?", re.IGNORECASE
)


def parse_number(text: str) -> float:
    """Return a number as typed: 1.5, -2e-3, pi, 0.7pi, -3pi/4, 1/2.

    Raises:
        InputError: it is none of these.
    """
    match = NUMBER.fullmatch(text.strip().replace("−", "-"))
    if match is None or not (match[2] or match[3]):
        raise InputError(f"{text[:100]!r} is not a number; write it like 1.5, 0.7pi or -pi/4")
    try:
        value = float(match[2] or 1) * (np.pi if match[3] else 1.0) / float(match[4] or 1)
    except (ValueError, ZeroDivisionError) as error:
        raise InputError(f"{text!r} is not a number; write it like 1.5, 0.7pi or -pi/4") from error
    if not np.isfinite(value):
        raise InputError(f"a number must be finite; {text[:100]!r} is beyond 1e308")
    return -value if match[1] == "-" else value


def parse_vector(text: str) -> Array:
    """Return numbers separated by commas or blanks.

    Raises:
        InputError: one of them is no number.
    """
    return np.array([parse_number(part) for part in parse_names(text)])


def parse_robot(
    source: str, parameters: Sequence[str] | None, tool: str | None, packages: Sequence[Path] | None = None
) -> Robot:
    """Return the robot of a name or path, with parameters typed as l2=0.5.

    Raises:
        Robotics1Error: what `parse_parameters` and `load_robot` raise.
    """
    path = source if "/" not in source else Path(source)
    return load_robot(path, parameters=parse_parameters(parameters), tool=tool, packages=packages or ())


def parse_parameters(texts: Sequence[str] | None) -> dict[str, float | str]:
    """Return the parameters typed as l2=0.5, or as ur_type=ur5e: what is no number is a word.

    Raises:
        InputError: one is not name=value.
    """
    values: dict[str, float | str] = {}
    for text in texts or ():
        name, sign, value = text.partition("=")
        if not sign:
            raise InputError(f"{text!r} is not a parameter; write it like l2=0.5")
        try:
            values[name.strip()] = parse_number(value)
        except InputError:
            values[name.strip()] = value
    return values


def parse_point(text: str) -> tuple[float | str, ...]:
    """Return coordinates separated by commas or blanks: numbers, and names such as d."""
    words = parse_names(text)
    return tuple(word if word.isidentifier() and word != "pi" else parse_number(word) for word in words)


def parse_names(text: str) -> tuple[str, ...]:
    """Return names separated by commas or blanks."""
    return tuple(part for part in re.split(r"[,\s]+", text.strip()) if part)


def parse_task(text: str, frame: str | None, angles: str | None = None) -> FrameTask:
    """Return the task typed as position, position:xy, planar-pose:xz, orientation or pose; these two also with angles.

    Raises:
        InputError: it is none of these, or has no angles.
    """
    kind, _, option = text.partition(":")
    kinds: dict[str, Callable[[], FrameTask]] = {
        "position": lambda: PositionTask(option or "xyz", frame=frame),
        "planar-pose": lambda: PlanarPoseTask(option or "xy", frame=frame),
        "orientation": lambda: OrientationTask(angles, frame=frame),
        "pose": lambda: PoseTask(angles, frame=frame),
    }
    if kind not in kinds or (option and kind in ("orientation", "pose")):
        raise InputError(f"there is no task {text!r}; there is {', '.join(TASKS)}")
    if angles is not None and kind not in ("orientation", "pose"):
        raise InputError(f"task {text!r} has no angles; orientation and pose have")
    return kinds[kind]()


def read_text(path: Path) -> str:
    """Return the text of a file in UTF-8, with a byte order mark or without.

    Raises:
        InputError: there is no such file, or it is no such text.
    """
    if not path.is_file():
        raise InputError(f"there is no file {path}")
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{path} is no text file in UTF-8") from error
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}") from error


def configuration(robot: Robot, text: str | None, degrees: bool) -> Array:
    """Return q as typed, in degrees where asked; without text, zero moved inside the limits.

    Raises:
        InputError: the wrong number of values.
    """
    if text is None:
        return np.clip(np.zeros(robot.nq), robot.lower, robot.upper)
    q = robot.configuration(parse_vector(text))
    return np.where(robot.revolute, np.radians(q), q) if degrees else q
