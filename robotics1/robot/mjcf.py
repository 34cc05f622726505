"""A robot in MuJoCo's format, MJCF, as Pinocchio reads it."""

from pathlib import Path
from tempfile import TemporaryDirectory

import pinocchio as pin

from robotics1.errors import InputError, RobotFileError
from robotics1.robot.from_pinocchio import robot_of_model
from robotics1.robot.markup import parse_xml
from robotics1.robot.model import Robot
from robotics1.robot.sources import TEXT


def is_mjcf(text: str, path: Path) -> bool:
    """Return whether a text is MJCF: its root is <mujoco>, and it is well-formed."""
    return "<mujoco" in text[:100_000] and parse_xml(text, path).tag == "mujoco"


def robot_of_mjcf(text: str, path: Path, tool: str | None, *, trusted: bool) -> Robot:
    """Return the robot of an MJCF text, which stands in the file `path` or, for `TEXT`, in memory.

    A site is a frame, and shapes are left out. Pinocchio reads the file, and the files that it names, without the
    checks of a URDF. It reads files only: a text in memory is written to one.

    Raises:
        InputError: the file is not trusted.
        RobotFileError: Pinocchio cannot read it, or reads what is no robot.
    """
    if not trusted:
        raise InputError(
            f"{'the text' if path is TEXT else path} is MJCF, which Pinocchio reads unchecked, with the files that "
            "it names; if you trust it, say trusted=True, or give its URDF"
        )
    try:
        if path is TEXT:
            with TemporaryDirectory() as folder:
                file = Path(folder, "robot.xml")
                file.write_text(text, encoding="utf-8")
                model = pin.buildModelFromMJCF(str(file))
        else:
            model = pin.buildModelFromMJCF(str(path))
    except (RuntimeError, ValueError) as error:
        reason = str(error).strip().splitlines()[-1]
        raise RobotFileError(f"Pinocchio cannot read it as MJCF: {reason}", path=path) from error
    try:
        return robot_of_model(model, tool=tool)
    except InputError as error:
        raise RobotFileError(str(error), path=path) from error
