"""The verdict on a robot file: what is wrong with it, what was understood, and whether an independent parser agrees."""

import io
import logging
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pinocchio as pin

from robotics1.errors import MissingExtraError, RobotFileError
from robotics1.inputs import Array
from robotics1.robot.encoding import undeclared
from robotics1.robot.findings import Finding
from robotics1.robot.loading import findings_of, robot_from_text, urdf_text
from robotics1.robot.markup import parse_xml
from robotics1.robot.model import Robot
from robotics1.robot.sources import robot_file, robot_text

CONFIGURATIONS = 10  # at which forward kinematics is compared
AGREES = 1e-9  # largest difference of an entry of a pose that is rounding [m or 1]


@dataclass(frozen=True, eq=False)
class Examination:
    """What a robot file is found to be.

    Attributes:
        path: the file.
        errors: what makes it unusable; empty for a robot.
        warnings: what is odd but harmless.
        robot: what was understood, or None.
        fk_difference: the largest difference between its forward kinematics and yourdfpy's, over all links; None
            when it was not compared.
    """

    path: Path
    errors: tuple[Finding, ...]
    warnings: tuple[Finding, ...]
    robot: Robot | None
    fk_difference: float | None

    @property
    def sound(self) -> bool:
        """Whether the file is a robot, and the independent parser agrees."""
        return self.robot is not None and (self.fk_difference is None or self.fk_difference <= AGREES)


def examine(
    source: str | Path,
    *,
    parameters: Mapping[str, float | str] | None = None,
    tool: str | None = None,
    packages: Iterable[str | Path] = (),
    trusted: bool = False,
) -> Examination:
    """Return everything that is to be said of a robot file, instead of raising at its first error.

    Arguments are those of `load_robot`.

    Raises:
        RobotFileError: there is no such file.
        UnknownNameError, InputError: what `load_robot` raises for its arguments.
    """
    path = robot_file(source)
    folders = [Path(folder) for folder in packages]
    try:
        source_text = robot_text(source, path)
        text, _ = urdf_text(source_text, path, parameters or {}, folders, trusted=trusted)
        findings = findings_of(parse_xml(text, path), path)
        errors, warnings = tuple(findings.errors), tuple(findings.warnings)
        if errors:
            return Examination(path, errors, warnings, None, None)
        robot = robot_from_text(
            source_text, path=path, parameters=parameters, tool=tool, packages=folders, trusted=trusted
        )
    except RobotFileError as error:
        return Examination(path, (_finding(error),), (), None, None)
    known = {str(warning) for warning in warnings}
    more = tuple(Finding(False, text) for text in robot.warnings if text not in known)
    return Examination(path, (), warnings + more, robot, _difference(robot, text))


def random_configurations(robot: Robot, count: int, rng: np.random.Generator) -> Array:
    """Return `count` random configurations, (count, nq), in the limits, and in [−π, π] where there are none."""
    lower, upper = np.maximum(robot.lower, -np.pi), np.minimum(robot.upper, np.pi)
    return rng.uniform(np.minimum(lower, upper), upper, (count, robot.nq))


def _difference(robot: Robot, text: str) -> float | None:
    try:
        return difference_from_yourdfpy(robot, text)
    except (MissingExtraError, NotComparable):
        return None


class NotComparable(Exception):  # noqa: N818 (an outcome of this module alone)
    """The other parser does not know joints of this kind."""


def difference_from_yourdfpy(robot: Robot, text: str) -> float:
    """Return the largest difference of forward kinematics from yourdfpy's own reading of a URDF text, over all links.

    Raises:
        MissingExtraError: yourdfpy is not installed.
        NotComparable: the robot has floating or planar joints, or yourdfpy cannot read the text.
    """
    if robot.nq != robot.nv:
        raise NotComparable("yourdfpy moves no floating or planar joints")
    try:
        import yourdfpy
    except ImportError as error:
        raise MissingExtraError("yourdfpy", "check") from error
    logging.getLogger("yourdfpy").setLevel(logging.CRITICAL)
    try:
        other = yourdfpy.URDF.load(
            io.BytesIO(undeclared(text).encode()),
            build_scene_graph=True,
            load_meshes=False,
            load_collision_meshes=False,
        )
    except Exception as error:  # yourdfpy raises whatever it runs into
        raise NotComparable(f"yourdfpy cannot read it: {error!r}") from error
    worst = 0.0
    for q in random_configurations(robot, CONFIGURATIONS, np.random.default_rng(0)):
        other.update_cfg(dict(zip(robot.joint_names, q, strict=True)))
        pin.framesForwardKinematics(robot.model, robot.data, q)
        for link in robot.frame_names:
            ours = robot.data.oMf[robot.frame_id(link)].homogeneous
            worst = max(worst, float(np.abs(ours - other.get_transform(link, other.base_link)).max()))
    return worst


def _finding(error: RobotFileError) -> Finding:
    where = ":".join(str(part) for part in (error.path, error.line) if part is not None)
    return Finding(True, str(error).removeprefix(f"{where}: "), error.line, error.element)
