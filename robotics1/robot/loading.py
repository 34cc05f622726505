"""From a file to a `Robot`: the text is expanded, checked, and becomes joints and Pinocchio's model."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, cast
from warnings import catch_warnings, simplefilter

import pinocchio as pin

from robotics1.errors import (
    InputError,
    MissingExtraError,
    RobotFileError,
    Robotics1Error,
    RobotWarning,
    shown,
    warn,
)
from robotics1.inputs import by_name
from robotics1.robot.assembly import robot_of_joints
from robotics1.robot.checking import check_urdf
from robotics1.robot.findings import Finding, NotComparable, RobotReport, difference_from_yourdfpy
from robotics1.robot.from_pinocchio import robot_of_model
from robotics1.robot.joints import Joint
from robotics1.robot.locking import lock, rebase
from robotics1.robot.markup import Element, parse_xml
from robotics1.robot.meshes import find_meshes
from robotics1.robot.mimic import follow_leaders, narrow_leaders
from robotics1.robot.mjcf import is_mjcf, robot_of_mjcf
from robotics1.robot.model import Robot
from robotics1.robot.parameters import Placements, agree, fitted_placements
from robotics1.robot.sources import robot_file, robot_text
from robotics1.robot.urdf import Link, read_joints, read_links
from robotics1.robot.xacro.expansion import Expanded, expand_xacro

FEW = 6  # parameters: with more, or in a large file, the polynomials are found when formulas are first asked for
SHOWN = 2  # of the warnings of a file, in the one that Python shows
LITTLE = 0.01  # of what an expansion may use


def load_robot(
    source: str | Path | pin.Model | tuple[pin.Model, pin.GeometryModel],
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
        source: a path, a name, or a text; an MJCF file or text that is trusted; or a `pin.Model`, also with its
            `pin.GeometryModel`. For the last two only `tool` is taken.
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

    Warns:
        RobotWarning: something about a joint is odd; `Robot.warnings` has these sentences, and those on masses and
            meshes.
    """
    model, shapes = source if isinstance(source, tuple) and len(source) == 2 else (source, None)
    if isinstance(model, pin.Model):
        _refuse_choices("a pin.Model", parameters, base, locked)
        return robot_of_model(model, shapes, tool)
    path = robot_file(source)
    text = robot_text(source, path)
    if is_mjcf(text, path):
        _refuse_choices("MJCF", parameters, base, locked)
        return robot_of_mjcf(text, path, tool, trusted=trusted is True)
    report = RobotText(text, path, parameters, base, tool, locked, packages, trusted).read()
    robot = report.require()
    # What is odd about masses does not change kinematics, and a mesh that is missing is noticed when it is drawn.
    odd = [str(finding) for finding in report.warnings if finding.message.startswith("joint ")]
    if odd:
        more = f"; and {len(odd) - SHOWN} more in robot.warnings" if len(odd) > SHOWN else ""
        warn(f"robot {robot.name!r}: {'; '.join(odd[:SHOWN])}{more}")
    return robot


def check_robot(
    source: str | Path,
    *,
    parameters: Mapping[str, float | str] | None = None,
    base: str | None = None,
    tool: str | None = None,
    locked: Mapping[str, Any] | None = None,
    packages: Iterable[str | Path] = (),
    trusted: bool = False,
) -> RobotReport:
    """Return everything that is wrong or odd in a robot file, where `load_robot` raises its first error.

    Its forward kinematics is compared with that of yourdfpy, where that is installed and can read the file. The
    arguments are those of `load_robot`.

    Raises:
        RobotFileError: there is no such file.
        UnknownNameError, InputError: what `load_robot` raises for its arguments.
    """
    path = robot_file(source)
    try:
        text = robot_text(source, path)
        if is_mjcf(text, path):
            _refuse_choices("MJCF", parameters, base, locked)
            return _report_of_mjcf(text, path, tool, trusted)
        report = RobotText(text, path, parameters, base, tool, locked, packages, trusted).read()
    except RobotFileError as error:
        return RobotReport(path, (Finding(True, error.message, error.line, error.element),))
    if report.robot is None or base is not None or locked:  # the other parser knows nothing of these two
        return report
    with suppress(MissingExtraError, NotComparable):
        report = replace(report, fk_difference=difference_from_yourdfpy(report.robot, report._text))
    return report


@dataclass(frozen=True)
class RobotText:
    """A URDF text, or a xacro text when the path ends in `.xacro`, and how it is read; see `load_robot`.

    It is kept, so that the text can be read again with other parameters. The path says where the text comes from, for
    messages and for the files that it names.
    """

    text: str
    path: Path
    parameters: Mapping[str, float | str] | None = None
    base: str | None = None
    tool: str | None = None
    locked: Mapping[str, Any] | None = None
    packages: Iterable[str | Path] = ()
    trusted: bool = False
    known: Placements | None = None  # the placements of the joints as polynomials in the parameters

    def __post_init__(self) -> None:
        """Check the arguments, and copy them."""
        self.__dict__["packages"] = _folders(self.packages)
        self.__dict__["trusted"] = self.trusted is True
        self.__dict__["locked"] = by_name("locked", self.locked, "{'q1': 0.5}")
        self.__dict__["parameters"] = by_name("parameters", self.parameters, "{'l2': 0.5}")

    def read(self) -> RobotReport:
        """Return what is found in the text, and the robot if it has no errors.

        Raises:
            RobotFileError: it is no XML, or cannot be expanded.
            UnknownNameError, InputError: as `load_robot`.
        """
        urdf, parameters, effort = self._expanded()
        root = parse_xml(urdf, self.path)
        findings = check_urdf(root)
        if self.path.suffix == ".xacro":
            findings = findings.without_lines()
        if findings.errors:
            return RobotReport(self.path, findings.errors, findings.warnings)
        more = find_meshes(root, self.path, self._folders, trusted=self.trusted)
        links, own_joints = self._parts(root)
        joints, contradictions = narrow_leaders(own_joints)
        warnings = findings.warnings + tuple(Finding(False, text) for text in (*more, *contradictions))
        robot = robot_of_joints(
            root.get("name", ""),
            joints,
            links,
            tool=self.tool,
            written=own_joints,
            parameters=parameters,
            path=self.path,
            warnings=tuple(map(str, warnings)),
            source=self._source(joints, parameters, effort) if parameters else None,
        )
        return RobotReport(self.path, (), warnings, robot, _text=urdf)

    def _source(self, joints: Sequence[Joint], parameters: Mapping[str, float], effort: float) -> RobotText:
        """Return what is kept of the text with the robot; with the polynomials, where these cost little."""
        path = self.path.absolute() if self.path.is_file() else self.path  # the working folder may be another one later
        known = self.known if self.known is not None and agree(self.known, joints, parameters) else None
        if known is None and effort <= LITTLE and len(parameters) <= FEW:
            with suppress(Robotics1Error):  # which is raised once somebody asks for formulas
                known = fitted_placements(joints, parameters, self._joints_at)
        return replace(self, path=path, known=known)

    def with_parameters(self, values: Mapping[str, float]) -> Robot:
        """Return the robot of the text with these parameters; the others stay as they were given."""
        return self._at(values).read().require()

    def placements(self, robot: Robot) -> Placements:
        """Return the placements of the joints as polynomials in the parameters."""
        return self.known or fitted_placements(robot.joints, robot.parameters, self._joints_at)

    @property
    def _folders(self) -> tuple[Path, ...]:
        return cast("tuple[Path, ...]", self.packages)

    def _at(self, values: Mapping[str, float]) -> RobotText:
        return replace(self, parameters={**(self.parameters or {}), **values})

    def _joints_at(self, values: Mapping[str, float]) -> tuple[Joint, ...]:
        """Return the joints alone, at these parameters, with the limits that they have in the text."""
        again = self._at(values)
        root = parse_xml(again._expanded().urdf, self.path)
        errors = check_urdf(root).errors
        if errors:
            RobotReport(self.path, errors).require()
        return again._parts(root)[1]

    def _expanded(self) -> Expanded:
        """Return the URDF text, expanded if it is xacro.

        Raises:
            InputError: parameters are given to a plain URDF.
        """
        parameters = self.parameters or {}
        if self.path.suffix == ".xacro":
            return expand_xacro(self.text, self.path, parameters, self._folders, trusted=self.trusted)
        if parameters:
            names = ", ".join(parameters)
            raise InputError(f"{self.path.name} is a plain URDF and has no parameters; {names} cannot be set")
        return Expanded(self.text, {}, 0.0)

    def _parts(self, root: Element) -> tuple[dict[str, Link], tuple[Joint, ...]]:
        """Return links and joints, with joints locked and another base as the caller wants."""
        links, joints = read_links(root), lock(follow_leaders(read_joints(root)), self.locked or {})
        return (links, joints) if self.base is None else rebase(links, joints, self.base, self.tool)


def _folders(packages: Iterable[str | Path]) -> tuple[Path, ...]:
    listed = [packages] if isinstance(packages, str | Path) else packages
    try:
        folders = tuple(Path(folder).resolve() for folder in listed)
    except TypeError as error:
        raise InputError(f"packages must be folders, as in packages=['ros/src']; it is {packages!r}") from error
    if folders and not any(folder.is_dir() for folder in folders):
        raise InputError(f"packages must be folders; there is no folder {shown(str(folders[0]))}")
    return folders


def _refuse_choices(what: str, parameters: Any, base: str | None, locked: Any) -> None:
    if parameters or base is not None or locked:
        raise InputError(f"{what} has no parameters, base or locked joints to choose; write a URDF for that")


def _report_of_mjcf(text: str, path: Path, tool: str | None, trusted: bool) -> RobotReport:
    """Return the report on MJCF, which no other parser is asked to read."""
    with catch_warnings():
        simplefilter("ignore", RobotWarning)  # they are in the report
        robot = robot_of_mjcf(text, path, tool, trusted=trusted is True)
    return RobotReport(path, (), tuple(Finding(False, sentence) for sentence in robot.warnings), robot)
