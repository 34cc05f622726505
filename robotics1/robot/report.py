"""The report on a robot file: what is wrong with it, what was understood, and whether an independent parser agrees."""

import io
import logging
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pinocchio as pin

from robotics1.errors import MissingExtraError, RobotFileError
from robotics1.inputs import Array
from robotics1.robot.findings import Finding
from robotics1.robot.markup import undeclared
from robotics1.robot.model import Robot

CONFIGURATIONS = 10  # at which forward kinematics is compared
AGREES = 1e-9  # largest difference of an entry of a pose that is rounding [m or 1]


@dataclass(frozen=True, eq=False)
class RobotReport:
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
    warnings: tuple[Finding, ...] = ()
    robot: Robot | None = None
    fk_difference: float | None = None
    _text: str = field(default="", repr=False)  # the URDF text that was checked: of a xacro, expanded

    @property
    def sound(self) -> bool:
        """Whether the file is a robot, and the independent parser agrees."""
        return self.robot is not None and (self.fk_difference is None or self.fk_difference <= AGREES)

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
    lower, upper = np.maximum(robot.lower, -np.pi), np.minimum(robot.upper, np.pi)
    return rng.uniform(np.minimum(lower, upper), upper, (count, robot.nq))


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
