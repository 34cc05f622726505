"""From a file to a `Robot`: the text is expanded, checked and cleaned, and Pinocchio makes the model of it."""

import xml.etree.ElementTree as ET
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import pinocchio as pin

from robotics1.errors import InputError, UnknownNameError
from robotics1.inputs import by_name
from robotics1.robot.building import build_model
from robotics1.robot.checking import check_urdf
from robotics1.robot.findings import Findings
from robotics1.robot.follower_limits import narrow_leaders
from robotics1.robot.locking import lock
from robotics1.robot.markup import Element, parse_xml
from robotics1.robot.meshes import find_meshes
from robotics1.robot.model import Robot, frame_number, tips
from robotics1.robot.parameters import Parameters
from robotics1.robot.rewriting import clean, rebase
from robotics1.robot.sources import robot_file, robot_text
from robotics1.robot.xacro.expansion import expand_xacro

USUAL_TOOLS = ("tool0", "tool")


def load_robot(
    source: str | Path,
    *,
    parameters: Mapping[str, float | str] | None = None,
    base: str | None = None,
    tool: str | None = None,
    locked: Mapping[str, Any] | None = None,
    packages: Iterable[str | Path] = (),
    trusted: bool = False,
) -> Robot:
    """Load a robot from a URDF or xacro file, or one of the named robots.

    A source with a suffix or a separator is a path, one that begins with "<" is the text of a URDF itself; any other
    is a name: "prr", "cylindrical", "planar_2r", or a robot of example-robot-data such as "ur5". A `continuous` joint
    is a revolute joint without limits, so that q has one number a joint; a mimicking joint has no number of its own,
    and narrows the limits of the joint that it mimics.

    Args:
        source: a path, a name, or a text.
        parameters: values for the arguments of a xacro file: named lengths such as {"l2": 0.5} [m], and words such
            as {"ur_type": "ur5e"}, which True and False may stand for.
        base: the link that is the world; by default the root. Of a link that moves, only its subtree is kept.
        tool: the link meant when no frame is named; without it the only tip, else the one called `tool0` or
            `tool`, else none.
        locked: joint name → value at which it is fixed [rad or m]; of a planar joint [x, y, θ]; of a floating one
            [x, y, z, qx, qy, qz, qw], a `pin.SE3` or a matrix (4, 4); 0 is where the file draws it.
        packages: folders in which `package://` and `$(find pkg)` look, beside those above the file.
        trusted: whether meshes may be any files of this computer, and a xacro may read files outside its folder, its
            package and `packages`, and the environment.

    Raises:
        RobotFileError: the file is missing, not in the encoding that it declares, or no robot; with the line.
        UnknownNameError: no robot, parameter, link or joint of that name.
        InputError: a value has another form or is not finite, or the file has no parameters.
    """
    path = robot_file(source)
    return robot_from_text(
        robot_text(source, path),
        path=path,
        parameters=parameters,
        base=base,
        tool=tool,
        locked=locked,
        packages=packages,
        trusted=trusted,
    )


def robot_from_text(
    text: str,
    *,
    path: Path,
    parameters: Mapping[str, float | str] | None = None,
    base: str | None = None,
    tool: str | None = None,
    locked: Mapping[str, Any] | None = None,
    packages: Iterable[str | Path] = (),
    trusted: bool = False,
) -> Robot:
    """Return the robot of a URDF text, or of a xacro text when the path ends in `.xacro`.

    The path says where the text comes from, for messages and for the files it names. The other arguments and the
    errors are those of `load_robot`.
    """
    folders = _folders(packages)
    trusted = trusted is True
    values_at = by_name("locked", locked, "{'q1': 0.5}")

    place = path.absolute() if path.is_file() else path  # the working folder may be another one later
    given = by_name("parameters", parameters, "{'l2': 0.5}")
    source = LoadedText(text, place, given, base, tool, values_at, tuple(folders), trusted)
    text, values = urdf_text(text, path, given, folders, trusted=trusted)
    root = parse_xml(text, path)
    findings = findings_of(root, path)
    findings.stop(path)
    warnings = [str(finding) for finding in findings.warnings]
    warnings += find_meshes(root, path, folders, trusted=trusted)
    lock(root, values_at)
    clean(root)
    if base is not None:
        rebase(root, base, tool)
    text = _written(root)
    model = build_model(root)
    warnings += narrow_leaders(model, root)
    return Robot(
        model.name,
        model,
        _tool(model, tool),
        Parameters(values),
        text,
        path,
        tuple(warnings),
        source if values else None,
    )


@dataclass(frozen=True)
class LoadedText:
    """The arguments of `robot_from_text`, kept so that a xacro can be expanded with other parameters."""

    text: str
    path: Path
    parameters: Mapping[str, float | str]
    base: str | None
    tool: str | None
    locked: Mapping[str, Any]
    packages: tuple[Path, ...]
    trusted: bool

    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Return the robot of the text with these parameters; the others stay as they were given."""
        options = dict(vars(replace(self, parameters={**self.parameters, **values})))
        return robot_from_text(options.pop("text"), **options)


def _folders(packages: Iterable[str | Path]) -> list[Path]:
    listed = [packages] if isinstance(packages, str | Path) else packages
    try:
        return [Path(folder).resolve() for folder in listed]
    except TypeError as error:
        raise InputError(f"packages must be folders, as in packages=['ros/src']; it is {packages!r}") from error


def _written(root: ET.Element) -> str:
    """Return the URDF text, in one layout: xacro, once imported, changes how Python writes all XML."""
    ET.indent(root)
    for element in root.iter():
        element.attrib = dict(sorted(element.attrib.items()))
    return ET.tostring(root, encoding="unicode")


def findings_of(root: Element, path: Path) -> Findings:
    """Return what is wrong with a URDF; of an expanded xacro, without lines."""
    findings = check_urdf(root)
    return findings.without_lines() if path.suffix == ".xacro" else findings


def urdf_text(
    text: str, path: Path, parameters: Mapping[str, float | str], packages: list[Path], *, trusted: bool
) -> tuple[str, dict[str, float]]:
    """Return the URDF text, expanded if it is xacro, and the values of its parameters.

    Raises:
        InputError: parameters are given to a plain URDF.
    """
    if path.suffix == ".xacro":
        return expand_xacro(text, path, parameters, packages, trusted=trusted)
    if parameters:
        raise InputError(f"{path.name} is a plain URDF and has no parameters; {', '.join(parameters)} cannot be set")
    return text, {}


def _tool(model: pin.Model, named: str | None) -> str | None:
    """Return the tool frame: the named one, the only tip, or the tip with a usual name."""
    if named is not None:
        if frame_number(model, named) is None:
            links = [frame.name for frame in model.frames if frame.type == pin.FrameType.BODY]
            raise UnknownNameError(f"frame of robot {model.name!r} named", named, links)
        return named
    candidates = tips(model)
    if len(candidates) == 1:
        return candidates[0]
    return next((name for name in USUAL_TOOLS if name in candidates), None)
