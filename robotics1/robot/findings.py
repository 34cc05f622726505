"""What is found in a robot file: what is wrong with it, what was understood, and whether another parser agrees."""

import io
import logging
import math
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
import pinocchio as pin

from robotics1.angles import TURN
from robotics1.errors import MissingExtraError, RobotFileError
from robotics1.inputs import Array
from robotics1.names import printable
from robotics1.results import Shown
from robotics1.robot.description import joint_table
from robotics1.robot.markup import Element, undeclared
from robotics1.robot.model import Robot
from robotics1.tables import Table

LARGEST = 1e18  # of lengths, angles and factors: sums and products of a few of them stay finite
CONFIGURATIONS = 10  # at which forward kinematics is compared
AGREES = 1e-9  # largest difference of an entry of a pose that is rounding, relative to the larger of 1 and the pose


@dataclass(frozen=True)
class Finding:
    """One thing that is wrong.

    Attributes:
        severe: whether the file cannot be read as a robot; otherwise it is a warning.
        message: what is wrong, and what would be right.
        line: where.
        element: whose name is meant, such as the joint's.
    """

    severe: bool
    message: str
    line: int | None = None
    element: str | None = None

    def __str__(self) -> str:
        return self.message if self.line is None else f"line {self.line}: {self.message}"


@dataclass
class Findings:
    """What has been found so far."""

    found: list[Finding] = field(default_factory=list)

    def error(self, owner: Element, message: str, at: Element | None = None) -> None:
        """Add what makes the file unusable: of a named element, at a part of it."""
        self._add(True, owner, message, at)

    def warn(self, owner: Element, message: str, at: Element | None = None) -> None:
        """Add what is odd but harmless: of a named element, at a part of it."""
        self._add(False, owner, message, at)

    def _add(self, severe: bool, owner: Element, message: str, at: Element | None) -> None:
        line = (owner if at is None else at).line
        self.found.append(Finding(severe, f"{owner.label} {message}", line, owner.get("name")))

    def numbers(
        self, owner: Element, element: Element, attribute: str, count: int = 1, largest: float = LARGEST
    ) -> list[float] | None:
        """Return the numbers of an attribute, or None when it is absent or wrong; then the report has a finding."""
        text = element.get(attribute)
        if text is None:
            return None
        try:
            values = [float(part) for part in text.split()]
        except ValueError:
            values = []
        if "_" in text or not text.isascii():  # Python reads 1_0 as 10, and digits of every script; urdfdom does not
            values = []
        where = "" if element is owner else f" of its <{element.tag}>"
        if len(values) != count:
            wanted = "a number" if count == 1 else f"{count} numbers"
            self.error(owner, f"needs {wanted} in {attribute}{where}, not {text!r}", element)
            return None
        if not all(math.isfinite(value) for value in values):
            self.error(owner, f"has {text!r} in {attribute}{where}; numbers must be finite", element)
            return None
        if max(map(abs, values)) > largest:
            self.error(owner, f"has {text!r} in {attribute}{where}; at most {largest:g} can be computed with", element)
            return None
        return values

    def without_lines(self) -> "Findings":
        """Return the same without lines: those of an expanded xacro are not those of its file."""
        return Findings([replace(finding, line=None) for finding in self.found])

    @property
    def errors(self) -> tuple[Finding, ...]:
        """What makes the file unusable."""
        return tuple(finding for finding in self.found if finding.severe)

    @property
    def warnings(self) -> tuple[Finding, ...]:
        """What is odd but harmless."""
        return tuple(finding for finding in self.found if not finding.severe)


@dataclass(frozen=True, eq=False)
class RobotReport(Shown):
    """What a robot file is found to be.

    Attributes:
        path: the file.
        errors: what makes it unusable; empty for a robot.
        warnings: what is odd but harmless.
        robot: what was understood, or None.
        fk_difference: the largest difference between its forward kinematics and yourdfpy's, over all links, relative
            to the larger of 1 and the entries of the pose; None when it was not compared.
    """

    path: Path
    errors: tuple[Finding, ...]
    warnings: tuple[Finding, ...] = ()
    robot: Robot | None = None
    fk_difference: float | None = None
    _text: str = field(default="", repr=False)  # the URDF text that was checked: of a xacro, expanded

    @property
    def sound(self) -> bool:
        """Whether the file is a robot, and the independent parser agrees."""
        return self.robot is not None and (self.fk_difference is None or self.fk_difference <= AGREES)

    def explain(self) -> str:
        """Return whether the file is a robot, and what was found, one a line."""
        if self.robot is None:
            verdict = f"{self.path.name} is no robot"
        elif self.sound:
            verdict = f"{self.path.name} is the robot {self.robot.name!r}"
        else:
            verdict = f"{self.path.name}: another parser finds other poses, by up to {self.fk_difference:.1e}"
        found = [f"error: {finding}" for finding in self.errors] + [f"warning: {finding}" for finding in self.warnings]
        return printable("\n".join([verdict, *found]), keep="\n")

    def _tables(self) -> tuple[Table, ...]:
        return () if self.robot is None else (joint_table(self.robot),)

    def require(self) -> Robot:
        """Return the robot.

        Raises:
            RobotFileError: the file is none; with the first error, and the number of the others.
        """
        if self.robot is None:
            first, others = self.errors[0], len(self.errors) - 1
            more = f" (and {others} more error{'s' if others > 1 else ''})" if others else ""
            raise RobotFileError(first.message + more, path=self.path, line=first.line, element=first.element)
        return self.robot


def random_configurations(robot: Robot, count: int, rng: np.random.Generator) -> Array:
    """Return `count` random configurations, (count, nq), in the limits, and in [−π, π] where there are none."""
    return random_within(robot.lower, robot.upper, count, rng)


def random_within(lower: Array, upper: Array, count: int, rng: np.random.Generator) -> Array:
    """Return `count` random rows, (count, n), inside limits (n,): in [−π, π], and where the limits are apart from that,
    in the 2π of them that are nearest.
    """
    low, high = np.clip(-np.pi, lower, upper), np.clip(np.pi, lower, upper)
    apart = low == high
    low, high = (
        np.where(apart, np.maximum(lower, high - TURN), low),
        np.where(apart, np.minimum(upper, low + TURN), high),
    )
    return rng.uniform(low, high, (count, len(lower)))


class NotComparable(Exception):  # noqa: N818 (an outcome of this module alone)
    """The other parser does not know joints of this kind."""


def difference_from_yourdfpy(robot: Robot, text: str) -> float:
    """Return the largest difference of forward kinematics from yourdfpy's own reading of a URDF text, over all links,
    relative to the larger of 1 and the entries of the pose.

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
        pin.framesForwardKinematics(robot.own_model, robot.data, q)
        for link in robot.frame_names:
            ours = robot.data.oMf[robot.frame_id(link)].homogeneous
            worst = max(worst, relative_difference(ours, other.get_transform(link, other.base_link)))
    return worst


def relative_difference(T: Array, other: Array) -> float:
    """Return the largest difference of two poses (4, 4), relative to the larger of 1 and the entries of T."""
    return float(np.abs(T - other).max() / max(1.0, np.abs(T).max()))
