"""Arms with a spherical wrist: the points that the tool reaches with every orientation.

With a wrist that turns the tool anyhow, p is such a point if the sphere about p, with the distance d of the tool from
the centre of the wrist as radius, is in the workspace of the centre. A part of that one's boundary meets the sphere if
its least distance from p is at most d and its largest at least d, since it is connected.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from math import pi

import numpy as np
import numpy.typing as npt

from robotics1.errors import TaskError
from robotics1.inputs import Array, real_array
from robotics1.results import Frozen
from robotics1.robot.model import Robot
from robotics1.workspaces.axes import CLOSED, STRAIGHT, Axis, nearest_on
from robotics1.workspaces.result import Workspace


@dataclass(frozen=True, eq=False)
class WristDexterity(Frozen):
    """The points in space that an arm with a spherical wrist reaches with every orientation of the tool.

    Attributes:
        robot_name: the robot's name.
        offset: the distance d of the tool's point from the centre of the wrist [m].
        wrist: the workspace of the centre of the wrist.
        axis: (2, 3) a point of the first joint's axis [m], and its direction.
    """

    robot_name: str
    offset: float
    wrist: Workspace
    axis: Array = field(repr=False)

    def contains(self, p: npt.ArrayLike) -> bool:
        """Return whether a point (3,) [m] is reached with every orientation.

        Raises:
            InputError: p has another shape or is not finite.
        """
        point = real_array("p", p, (3,), "a point in world axes [m]")
        if self.offset < STRAIGHT:
            return self.wrist.contains(point)
        away = point - self.axis[0]
        h = float(away @ self.axis[1])
        rho = float(np.linalg.norm(away - h * self.axis[1]))
        ranges = self.wrist.section.sphere_ranges(np.array([rho, h]))
        if any(least <= self.offset <= most for least, most in ranges):
            return False
        return self.wrist.contains(point + self.offset * self.axis[1])

    def explain(self) -> str:
        """Return what is known in sentences."""
        if self.offset < STRAIGHT:
            return (
                f"The tool of {self.robot_name} is at the centre of its wrist, and the wrist turns it anyhow: every "
                f"reached point is reached with every orientation. " + self.wrist.explain()
            )
        return (
            f"{self.robot_name} reaches a point with every orientation if the sphere of radius {self.offset:.6g} m "
            f"about it is in the workspace of the centre of the wrist. " + self.wrist.explain()
        )


def wrist_of(axes: Sequence[Axis], tip: Array, robot: Robot) -> tuple[Array, float]:
    """Return the centre (3,) of a wrist of the last three joints, and the distance of the tip from it.

    Raises:
        TaskError: they are no spherical wrist, or cannot make every rotation.
    """
    near = STRAIGHT * robot.reach
    last = axes[-3:]
    if len(axes) < 5 or not all(axis.revolute for axis in last):
        raise TaskError(_NO_WRIST.format(robot.name))
    four, five, six = last
    centre = nearest_on(five, four)
    far = np.cross(six.direction, centre - six.point)
    square = max(abs(four.direction @ five.direction), abs(five.direction @ six.direction))
    if np.linalg.norm(np.cross(four.direction, centre - four.point)) > near or np.linalg.norm(far) > near:
        raise TaskError(_NO_WRIST.format(robot.name))
    if square > STRAIGHT:
        raise TaskError(
            f"the axes of the wrist of robot {robot.name!r} are not normal to each other: it cannot turn anyhow"
        )
    for axis, need in ((four, 2 * pi), (six, 2 * pi), (five, pi)):
        if axis.upper - axis.lower < need - CLOSED:
            raise TaskError(f"joint {axis.name!r} has too small a range for every orientation: it needs {need:.6g} rad")
    return centre, float(np.linalg.norm(tip - centre))


_NO_WRIST = (
    "robot {0!r} has no spherical wrist (three last revolute axes through one point); where it reaches every "
    "orientation is not known"
)
