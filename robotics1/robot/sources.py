"""Where robot files are: the named ones, and those given by path."""

from importlib.metadata import PackageNotFoundError, distribution
from importlib.resources import files
from pathlib import Path

from robotics1.errors import InputError, MissingExtraError, RobotFileError, UnknownNameError

EXAMPLES = "cmeel.prefix/share/example-robot-data/robots"


def urdf_folder() -> Path:
    """Return the folder of the named robots: the copy in the installed package, else the checkout's `urdf/`."""
    installed = Path(str(files("robotics1"))) / "urdf"
    return installed if installed.is_dir() else installed.parents[1] / "urdf"


def named_robots() -> dict[str, Path]:
    """Return name → file of the robots in `urdf/` (`prr.urdf.xacro` has the name `prr`) and of example-robot-data."""
    own = {path.name.split(".")[0]: path for path in sorted(urdf_folder().glob("*.urdf*"))}
    return own | {name: path for name, path in example_robots().items() if name not in own}


def example_robots() -> dict[str, Path]:
    """Return name → file of the robots of the package example-robot-data, if it is installed.

    The name is the file's, without "_robot" and with "_" for a dot; where two have the same, it is their folder's.
    """
    try:
        folder = example_folder()
    except MissingExtraError:
        return {}
    files: dict[str, list[Path]] = {}
    for path in sorted(folder.glob("*/*/*.urdf"), key=lambda path: (not path.stem.endswith("_robot"), path)):
        files.setdefault(path.stem.removesuffix("_robot").replace(".", "_"), []).append(path)
    robots: dict[str, Path] = {}
    for name, paths in files.items():
        for path in paths:
            same_folder = paths[0].parts[-3] == path.parts[-3]
            unique = name if len(paths) == 1 or (same_folder and path is paths[0]) else None
            robots.setdefault(unique or path.parts[-3].removesuffix("_description"), path)
    return robots


def example_folder() -> Path:
    """Return the folder of the package example-robot-data.

    Raises:
        MissingExtraError: it is not installed.
    """
    try:
        return Path(str(distribution("example-robot-data").locate_file(EXAMPLES)))
    except PackageNotFoundError as error:
        raise MissingExtraError("example-robot-data", "robots") from error


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
        note = "" if example_robots() else "; more have names with pip install 'robotics1[robots]'"
        raise UnknownNameError("robot named", source, robots, note)
    return robots[source]
