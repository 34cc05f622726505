"""The robot that a caller hands in: a `Robot`, its name or path, the text of its URDF, or a model of Pinocchio."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Any, TypeAlias, cast

import pinocchio as pin

from robotics1.inputs import a_robot
from robotics1.robot.loading import load_robot
from robotics1.robot.model import Robot
from robotics1.robot.sources import TEXT, robot_file

RobotLike: TypeAlias = Robot | str | Path | pin.Model | tuple[pin.Model, pin.GeometryModel]
KEPT = 32  # robots, of those that were named last


def robot_from(value: RobotLike) -> Robot:
    """Return the robot that is meant: itself, or what `load_robot` makes of a name, a path, a text, or a model.

    The robot of a name or a path is loaded once, until its file changes; that of a xacro, which may include other
    files, each time.

    Raises:
        RobotFileError, UnknownNameError: as `load_robot`.
        InputError: it is none of these; the message says what would be right.
    """
    if isinstance(value, Robot):
        return value
    if isinstance(value, str | Path):
        return _loaded(value)
    if isinstance(value, pin.Model) or (isinstance(value, tuple) and value and isinstance(value[0], pin.Model)):
        return load_robot(value)
    a_robot(value)  # which refuses all but a stand-in for a robot
    return cast(Robot, value)


def _loaded(source: str | Path) -> Robot:
    path = robot_file(source)
    if path is TEXT:
        return _of_text(str(source))
    named = isinstance(source, str) and not Path(source).suffix and "/" not in source and "\\" not in source
    if path.suffix == ".xacro" and not named:
        return load_robot(source)
    state = path.stat()
    return _of_file(source, path.absolute(), state.st_mtime_ns, state.st_size)


@lru_cache(KEPT)
def _of_file(source: str | Path, *_: Any) -> Robot:
    return load_robot(source)


@lru_cache(KEPT)
def _of_text(text: str) -> Robot:
    return load_robot(text)
