"""Where robots are: the named ones, those given by path, and those that are a text themselves."""

from importlib.metadata import PackageNotFoundError, distribution
from importlib.resources import files
from pathlib import Path
from stat import S_ISDIR, S_ISREG
from typing import Any

from robotics1.errors import InputError, MissingExtraError, RobotFileError, UnknownNameError
from robotics1.robot import markup
from robotics1.robot.markup import decoded

TEXT = Path("<text>")  # stands for the file of a robot that is given as a text
LONGEST_PATH = 4096  # characters: no system takes longer ones
LARGEST_CHARACTER = 4  # bytes
OTHER_FILES = {
    **dict.fromkeys((".stl", ".dae", ".obj", ".glb", ".ply"), "the mesh of a link"),
    **dict.fromkeys((".step", ".stp", ".iges", ".sldasm", ".f3d"), "a drawing of a CAD program, which can export one"),
    **dict.fromkeys((".sdf", ".usd"), "a robot for a simulator"),
    **dict.fromkeys((".py", ".ipynb", ".csv", ".json", ".toml", ".yaml", ".yml", ".html", ".pdf"), "of another kind"),
    ".srdf": "what MoveIt knows of a robot; its URDF stands beside it",
}
EXAMPLES = "cmeel.prefix/share/example-robot-data/robots"


def own_folder(name: str) -> Path:
    """Return the folder `urdf/` or `examples/`: the copy in the installed package, else the checkout's."""
    installed = Path(str(files("robotics1"))) / name
    return installed if installed.is_dir() else installed.parents[1] / name


def named_robots() -> dict[str, Path]:
    """Return name → file of the robots in `urdf/` (`prr.urdf.xacro` has the name `prr`) and of example-robot-data."""
    own = own_robots()
    return own | {name: path for name, path in example_robots().items() if name not in own}


def own_robots() -> dict[str, Path]:
    """Return name → file of the robots in `urdf/`."""
    return {path.name.split(".")[0]: path for path in sorted(own_folder("urdf").glob("*.urdf*"))}


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


def robot_text(source: Any, path: Path) -> str:
    """Return the text of a robot, with the path that `robot_file` gives.

    Raises:
        RobotFileError: the file cannot be read, or is not in the encoding that it declares.
    """
    if path is TEXT:
        return str(source)
    try:
        size = path.stat().st_size
        if size > LARGEST_CHARACTER * markup.LARGEST_FILE:
            raise RobotFileError(f"it has {size} bytes; at most {markup.LARGEST_FILE} characters are read", path=path)
        data = path.read_bytes()
    except OSError as error:
        raise RobotFileError(f"it cannot be read: {error.strerror}", path=path) from error
    return decoded(data, path)


def robot_file(source: Any) -> Path:
    """Return the file meant by `source`: with a suffix or a separator it is a path, else the name of a robot.

    What begins with "<" is the text of a robot itself, for which `TEXT` stands.

    Raises:
        RobotFileError: there is no such file.
        UnknownNameError: there is no robot of that name.
        InputError: the source is neither a name nor a path.
    """
    if hasattr(source, "joint_names"):
        raise InputError("it is a Robot already and needs no loading; hand it to the functions as it is")
    if not isinstance(source, str | Path):
        raise InputError(
            f"a robot is named by a name or a path, or is the text of a URDF; it is {_shortened(repr(source))}"
        )
    if isinstance(source, str) and source.lstrip("\ufeff \t\r\n").startswith("<"):
        return TEXT
    if len(str(source)) > LONGEST_PATH or {"\0", "\n"} & set(str(source)):
        raise InputError(
            f"a robot is named by a name or a path, or is the text of a URDF, which begins with '<'; "
            f"{_shortened(repr(str(source)))} is none"
        )
    path = Path(source)
    if isinstance(source, Path) or path.suffix or "/" in source or "\\" in source:
        _check_file(path)
        if path.suffix.lower() in OTHER_FILES:
            raise RobotFileError(f"it is {OTHER_FILES[path.suffix.lower()]}, and no URDF or xacro", path=path)
        return path
    robots = own_robots()
    if source not in robots:  # the others take longer to list
        robots = named_robots()
    if source not in robots:
        note = "" if example_robots() else "; more have names with pip install 'robotics1[robots]'"
        raise UnknownNameError("robot named", source, robots, note)
    return robots[source]


def _check_file(path: Path) -> None:
    try:
        mode = path.stat().st_mode
    except (FileNotFoundError, NotADirectoryError) as error:
        home = "; only a shell knows what ~ means: write Path('~/...').expanduser()" if path.parts[:1] == ("~",) else ""
        raise RobotFileError(f"there is no such file{home}", path=path) from error
    except (OSError, ValueError) as error:  # ValueError: a character that no file name can hold
        raise RobotFileError(f"it cannot be read: {getattr(error, 'strerror', error)}", path=path) from error
    if not S_ISREG(mode):
        what = "a folder" if S_ISDIR(mode) else "a device, a pipe or a socket"
        raise RobotFileError(f"it is {what}, and no file", path=path)


def _shortened(text: str) -> str:
    return text if len(text) < 80 else f"{text[:75]}..."
