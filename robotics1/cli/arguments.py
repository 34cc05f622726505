"""What is typed at the command line, turned into robots, tasks and vectors.

Heavy libraries are imported where they are used: `--help` needs none of them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from robotics1.errors import InputError

if TYPE_CHECKING:
    from robotics1.inputs import Array
    from robotics1.robot.model import Robot
    from robotics1.tasks.task import FrameTask

NUMBER = re.compile(  # with one way only to read each text: else a long one takes the square of its length
    r"([+-]?)((?:\d+(?:\.\d*)?|\.\d+)?(?:e[+-]?\d+)?)\s*(?:\*\s*)?(pi|π)?(?:/(\d+(?:\.\d*)?))?", re.IGNORECASE
)

DEGREES = re.compile(r"(°|º|deg(rees?)?)\s*\Z", re.IGNORECASE)


def parse_number(text: str) -> float:
    """Return a number as typed: 1.5, -2e-3, pi, 0.7pi, -3pi/4, 1/2.

    Raises:
        InputError: it is none of these.
    """
    match = NUMBER.fullmatch(text.strip().replace("−", "-"))
    if match is None or not (match[2] or match[3]):
        unit = "; degrees are meant with --degrees" if DEGREES.search(text) else ""
        raise InputError(f"{text[:100]!r} is not a number; write it like 1.5, 0.7pi or -pi/4{unit}")
    try:
        value = float(match[2] or 1) * (math.pi if match[3] else 1.0) / float(match[4] or 1)
    except (ValueError, ZeroDivisionError) as error:
        raise InputError(f"{text!r} is not a number; write it like 1.5, 0.7pi or -pi/4") from error
    if not math.isfinite(value):
        raise InputError(f"a number must be finite; {text[:100]!r} is beyond 1e308")
    return -value if match[1] == "-" else value


def parse_vector(text: str, degrees: bool = False) -> Array:
    """Return numbers separated by commas or blanks.

    Raises:
        InputError: one of them is no number; or one has pi in it, where angles are typed in degrees.
    """
    import numpy as np

    return np.array([parse_number(without_pi(part) if degrees else part) for part in parse_names(text)])


def without_pi(text: str) -> str:
    """Return a number as typed in degrees.

    Raises:
        InputError: it has pi in it, and is an angle in radians then.
    """
    if "pi" in text.lower() or "π" in text:
        raise InputError(f"{text[:100]!r} is an angle in radians; leave out --degrees, or type degrees, as 90")
    return text


def parse_robot(
    source: str,
    parameters: Sequence[str] | None,
    tool: str | None,
    packages: Sequence[Path] | None = None,
    lock: Sequence[str] | None = None,
    degrees: bool = False,
) -> Robot:
    """Return the robot of a name or path, with parameters typed as l2=0.5, and joints locked as q1=0.2.

    Raises:
        Robotics1Error: what `parse_parameters` and `load_robot` raise.
    """
    from robotics1.robot.loading import load_robot

    path = source if "/" not in source else Path(source)
    given = loading_options(path, parameters, packages, lock, degrees)
    return load_robot(path, tool=tool, **given)


def loading_options(
    path: str | Path,
    parameters: Sequence[str] | None,
    packages: Sequence[Path] | None,
    lock: Sequence[str] | None,
    degrees: bool,
) -> dict[str, Any]:
    """Return parameters, packages and locked joints as `load_robot` and `check_robot` take them.

    Raises:
        Robotics1Error: one cannot be read; or joints are locked in degrees, and the robot cannot be loaded, which says
            which of them turn.
    """
    given: dict[str, Any] = {"parameters": parse_parameters(parameters), "packages": packages or ()}
    locked = parse_lock(lock, degrees)
    if degrees and locked:
        from robotics1.robot.loading import load_robot

        free = load_robot(path, **given)
        turning = {name for name, turns in zip(free.joint_names, free.revolute, strict=False) if turns}
        locked = {name: math.radians(value) if name in turning else value for name, value in locked.items()}
    return given | {"locked": locked}


def parse_lock(texts: Sequence[str] | None, degrees: bool = False) -> dict[str, float]:
    """Return the joints that are locked, typed as q1=0.2.

    Raises:
        InputError: one is not name=value.
    """
    values = {}
    for text in texts or ():
        name, sign, value = text.partition("=")
        if not sign:
            raise InputError(f"{text!r} is no locked joint; write it like q1=0.2")
        values[name.strip()] = parse_number(without_pi(value) if degrees else value)
    return values


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
    """Return names separated by commas or blanks, with or without brackets around them all."""
    inside = re.fullmatch(r"\s*[(\[](.*)[)\]]\s*", text, re.DOTALL)
    return tuple(part for part in re.split(r"[,\s]+", (inside[1] if inside else text).strip()) if part)


def parse_box(robot: Robot, texts: Sequence[str] | None, degrees: bool) -> dict[str, tuple[float, float]]:
    """Return joint → (lower, upper), each typed as q1=-1:pi/2; of revolute joints in degrees where asked.

    Raises:
        InputError: one of them is not name=lower:upper.
    """
    box = {}
    for text in texts or ():
        name, _, interval = text.partition("=")
        name, typed = name.strip(), interval.split(":")
        if len(typed) != 2:
            raise InputError(f"{text[:100]!r} is not an interval; write it like q1=-1:pi/2")
        lower, upper = (_joint_value(robot, name, end, degrees) for end in typed)
        box[name] = (lower, upper)
    return box


def _joint_value(robot: Robot, joint: str, text: str, degrees: bool) -> float:
    """Return the value of a joint as typed, of one that turns in degrees where asked."""
    value = parse_number(without_pi(text) if degrees else text)
    turns = degrees and joint in robot.joint_names and robot.revolute[robot.joint_names.index(joint)]
    return math.radians(value) if turns else value


def parse_task(text: str, frame: str | None, angles: str | None = None) -> FrameTask:
    """Return the task of a short form such as position:xy; orientation and pose also with angles.

    Raises:
        InputError: it is none of these, or has no angles.
    """
    from robotics1.tasks.given import short_form

    return short_form(text, frame, angles)


def task_for(robot: Robot, text: str | None, frame: str | None, angles: str | None = None) -> FrameTask:
    """Return the task that is typed; without a text, the one that the robot is made for.

    An arm in the plane z = 0 has a planar pose from three joints on, else a position; an arm in space a pose from six
    joints on, else a position.

    Raises:
        InputError: as `parse_task`.
    """
    if text is not None or angles is not None:
        return parse_task(text or "pose", frame, angles)
    from robotics1.tasks.position import PositionTask
    from robotics1.viewer.arm_data import default_task

    usual: Any = default_task(robot) or PositionTask()
    return replace(usual, frame=frame)  # type: ignore[no-any-return]


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
    """Return q as typed, in degrees where asked: numbers, q1=0.5,q2=1, or a posture's name.

    Without text it is zero, moved inside the limits.

    Raises:
        InputError: the wrong number of values.
    """
    import numpy as np

    if text is None:
        return np.clip(np.zeros(robot.nq), robot.lower, robot.upper)
    if text.strip() in robot.postures:
        return robot.configuration(text.strip())
    if "=" in text:
        pairs = [part.partition("=") for part in parse_names(text)]
        return robot.configuration({name: _joint_value(robot, name, value, degrees) for name, _, value in pairs})
    values = parse_vector(text, degrees)
    if degrees and robot.nq == robot.nv and values.shape == robot.revolute.shape:
        return robot.configuration(np.where(robot.revolute, np.radians(values), values))
    return robot.configuration(values)
