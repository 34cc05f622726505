"""A robot and a task, read as two joints that move a point in a section, and one before them that moves the section."""

from dataclasses import dataclass

import numpy as np

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.notation import count
from robotics1.robot.model import Robot
from robotics1.workspaces.axes import Axis, length_of
from robotics1.workspaces.curved.domain import Domain
from robotics1.workspaces.curved.plane_map import PlaneMap, plane_map
from robotics1.workspaces.moving_point import MovingPoint
from robotics1.workspaces.placed_section import SectionFrame, frame_of_section


@dataclass(frozen=True, eq=False)
class SpatialArm:
    """Two joints that move a point in a section, and where the section is.

    Attributes:
        place: of the section, with the joint before the two.
        mapped, domain: the map of the two joints, and their values; lengths are shares of `size`.
        joints: the two joints.
        size: a length of the size of the arm [m].
    """

    place: SectionFrame
    mapped: PlaneMap
    domain: Domain
    joints: tuple[Axis, Axis]
    size: float

    def configuration(self, q: Array, base: float | None = None) -> Array:
        """Return all joints' values (nq,) [rad or m] of values (2,) of the two joints."""
        values = self.place.neutral.copy()
        for joint, value in zip(self.joints, self.domain.wrapped(q), strict=True):
            centred = (value + np.pi) % (2 * np.pi) - np.pi
            if joint.circular and joint.lower <= centred <= joint.upper:
                values[joint.number] = centred
            else:
                values[joint.number] = value if joint.revolute else value * self.size
        if self.place.base is not None and base is not None:
            values[self.place.base.number] = base
        return values


def read_in_space(robot: Robot, point: MovingPoint) -> SpatialArm:
    """Return the arm, if three joints move a point in space, or two joints two of its coordinates.

    Raises:
        TaskError: fewer joints move the point.
    """
    axes, rows = point.axes, point.rows
    if len(axes) < len(rows):
        held = f", as {', '.join(point.held)} has no room to move" if point.held else ""
        raise TaskError(
            f"{count(len(axes), 'joint')} of robot {robot.name!r} can move the point{held}, too few for "
            f"{len(rows)} coordinates: "
            "of an arm in a plane ask two, as PositionTask('xy')"
        )
    base = axes[0] if len(rows) == 3 else None
    pair = (axes[-2], axes[-1])
    frame, origin = frame_of_section(base, rows)
    place = SectionFrame(rows, origin, frame, base, point.neutral)
    size = length_of(axes, point.tip)
    mapped = plane_map(pair, point.tip, frame, origin, size, place.about_axis)
    lower, upper = (
        np.array([getattr(axis, end) / (1.0 if axis.revolute else size) for axis in pair]) for end in ("lower", "upper")
    )
    domain = Domain(lower, upper, (pair[0].circular, pair[1].circular), (pair[0].revolute, pair[1].revolute))
    return SpatialArm(place, mapped, domain, pair, size)
