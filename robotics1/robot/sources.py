"""Where robot files are: the named ones, and those given by path."""

from importlib.resources import files
from pathlib import Path

from robotics1.errors import InputError, RobotFileError, UnknownNameError


def urdf_folder() -> Path:
    """Return the folder of the named robots: the copy in the installed package, else the checkout's `urdf/`."""
    installed = Path(str(files("robotics1"))) / "urdf"
    return installed if installed.is_dir() else installed.parents[1] / "urdf"


def named_robots() -> dict[str, Path]:
    """Return name → file of the robots in `urdf/`: `prr.urdf.xacro` has the name `prr`."""
    return {path.name.split(".")[0]: path for path in sorted(urdf_folder().glob("*.urdf*"))}


def robot_file(source: str | Path) -> Path:
    """Return the file meant by `source`: with a suffix or a separator it is a path, else the name of a robot.

    Raises:
        RobotFileError: there is no such file.
        UnknownNameError: there is no robot of that name.
        InputError: the source is neither a name nor a path.
    """
    if not isinstance(source, str | Path):
        raise InputError(f"a robot is named by a name or a path, not by {source!r}")
    path = Path(source)
    if isinstance(source, Path) or path.suffix or "/" in source or "\\" in source:
        if not path.is_file():
            raise RobotFileError("there is no such file", path=path)
        return path
    robots = named_robots()
    if source not in robots:
        raise UnknownNameError("robot named", source, robots)
    return robots[source]
