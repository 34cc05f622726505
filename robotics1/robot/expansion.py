"""xacro → URDF text, with the file's arguments as the robot's named parameters."""

import io
from collections.abc import Mapping
from contextlib import redirect_stderr
from pathlib import Path

from robotics1.errors import RobotFileError, UnknownNameError
from robotics1.inputs import real_number
from robotics1.robot.markup import parse_xml
from robotics1.robot.xacro_guard import guarded


def expand_xacro(
    text: str, path: Path, parameters: Mapping[str, float], packages: list[Path], *, trusted: bool = False
) -> tuple[str, dict[str, float]]:
    """Return the URDF text of a xacro text and the values its numeric arguments had.

    xacro itself takes unknown arguments and NaN in silence, so the names are held against those the file
    declares, and the values must be finite. Files it includes are looked for beside it.

    Raises:
        UnknownNameError: a parameter the file does not declare.
        InputError: a value is not a finite number.
        RobotFileError: an argument has neither a value nor a default, the file reads YAML or the environment
            without being trusted, or xacro refuses it.
    """
    import xacro

    declared = declared_arguments(text, path)
    for name in parameters:
        if name not in declared:
            raise UnknownNameError(f"parameter of {path.name} named", name, declared)
    values = {name: real_number(f"parameter {name!r}", value) for name, value in parameters.items()}
    for name, default in declared.items():
        if name not in values and not default:
            raise RobotFileError(f"parameter {name!r} has no default: give it a value", path=path, element=name)
    with guarded(path, packages, trusted=trusted), redirect_stderr(io.StringIO()):
        try:
            xacro.init_stacks(str(path))
            document = xacro.parse(text)
            for argument in document.getElementsByTagName("xacro:arg"):
                if not argument.hasAttribute("default"):
                    argument.setAttribute("default", "")  # xacro wants one; a value is there by now
            xacro.process_doc(document, mappings={name: _as_text(value) for name, value in values.items()})
        except Exception as error:  # xacro raises whatever its evaluation of the file ran into
            message = " ".join(str(error).split())
            where = "" if xacro.filestack[-1] in (None, str(path)) else f" {Path(xacro.filestack[-1]).name}:"
            raise RobotFileError(f"xacro cannot expand it:{where} {message}", path=path) from error
    numbers = {name: float(default) for name, default in declared.items() if _is_number(default)}
    return document.toprettyxml(indent="  "), numbers | values


def declared_arguments(text: str, path: Path) -> dict[str, str]:
    """Return name → default (text) of the `xacro:arg` elements of a text."""
    return {arg.get("name", ""): arg.get("default", "") for arg in parse_xml(text, path).iter("xacro:arg")}


def _as_text(value: float) -> str:
    """Return a value as it is put into the file; a whole number without a point, so that it serves in a condition."""
    return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
