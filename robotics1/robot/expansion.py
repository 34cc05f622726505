"""xacro → URDF text, with the file's arguments as the robot's named parameters."""

import xml.etree.ElementTree as ET
from collections.abc import Mapping
from pathlib import Path

from robotics1.errors import RobotFileError, UnknownNameError
from robotics1.inputs import real_number

XACRO = "{http://www.ros.org/wiki/xacro}"


def expand_xacro(path: Path, parameters: Mapping[str, float]) -> tuple[str, dict[str, float]]:
    """Return the URDF text of a xacro file and the values its arguments had.

    xacro itself takes unknown arguments and NaN in silence, so the names are held against those the file
    declares, and the values must be finite.

    Raises:
        UnknownNameError: a parameter the file does not declare.
        InputError: a value is not a finite number.
        RobotFileError: an argument has neither a value nor a default, or xacro refuses the file.
    """
    import xacro

    declared = declared_arguments(path)
    for name in parameters:
        if name not in declared:
            raise UnknownNameError(f"parameter of {path.name} named", name, declared)
    values = {name: real_number(f"parameter {name!r}", value) for name, value in parameters.items()}
    for name, default in declared.items():
        if name not in values and not default:
            raise RobotFileError(f"parameter {name!r} has no default: give it a value", path=path, element=name)
    try:
        document = xacro.process_file(str(path), mappings={name: repr(value) for name, value in values.items()})
    except Exception as error:  # xacro raises whatever its evaluation of the file ran into
        raise RobotFileError(f"xacro cannot expand it: {error}", path=path) from error
    numbers = {name: float(default) for name, default in declared.items() if _is_number(default)}
    return document.toxml(), numbers | values


def declared_arguments(path: Path) -> dict[str, str]:
    """Return name → default (text) of the `xacro:arg` elements of a file."""
    try:
        root = ET.parse(path).getroot()
    except (ET.ParseError, UnicodeDecodeError) as error:
        raise not_well_formed(path, error) from error
    return {arg.get("name", ""): arg.get("default", "") for arg in root.iter(f"{XACRO}arg")}


def not_well_formed(path: Path, error: ET.ParseError | UnicodeDecodeError) -> RobotFileError:
    """Return the error to raise for a file that is no XML."""
    line = error.position[0] if isinstance(error, ET.ParseError) else None
    return RobotFileError(f"it is not well-formed XML: {error}", path=path, line=line)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
