"""A robot and a task, read as two joints that move a point in a section, and one before them that moves the section."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import tau

import numpy as np
import pinocchio as pin

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.robot.box import refuse_open_range
from robotics1.robot.model import Robot
from robotics1.workspaces.axes import STRAIGHT, Axis, across
from robotics1.workspaces.curved.domain import Domain
from robotics1.workspaces.curved.plane_map import PlaneMap, plane_map
from robotics1.workspaces.planar_joints import CLOSED


@dataclass(frozen=True, eq=False)
class SpatialArm:
    """What `CurvedSection` says of an arm, before its curves are known."""

    mapped: PlaneMap
    domain: Domain
    joints: tuple[Axis, Axis]
    base: Axis | None
    rows: Array
    origin: Array
    frame: Array
    size: float
    neutral: Array


def read_in_space(robot: Robot, axes: Sequence[Axis], tip: Array, rows: Array) -> SpatialArm:
    """Return the arm, if three joints move a point in space, or two joints two of its coordinates.

    Raises:
        TaskError: fewer joints move the point.
        InputError: a prismatic joint has no limits.
    """
    for axis in axes:
        if not axis.revolute:
            refuse_open_range(axis.name, axis.lower, axis.upper)
    lower, upper = robot.lower.copy(), robot.upper.copy()
    for axis in axes:
        lower[axis.number], upper[axis.number] = axis.lower, axis.upper
    neutral = np.clip(np.zeros(robot.nq), lower, upper)
    moving, tip = without_held(axes, tip, STRAIGHT * robot.reach)
    if len(moving) < len(rows):
        raise TaskError(
            f"{len(moving)} joints of robot {robot.name!r} move the point, too few for {len(rows)} coordinates: "
            "of an arm in a plane ask two, as PositionTask('xy')"
        )
    base = moving[0] if len(rows) == 3 else None
    pair = (moving[-2], moving[-1])
    frame, origin = section_frame(base, rows)
    size = _size(moving, tip)
    about = base is not None and base.revolute
    mapped = plane_map(pair, tip, frame, origin, size, about)
    units = [1.0 if axis.revolute else size for axis in pair]
    domain = Domain(
        np.array([axis.lower / u for axis, u in zip(pair, units, strict=True)]),
        np.array([axis.upper / u for axis, u in zip(pair, units, strict=True)]),
        (pair[0].circular, pair[1].circular),
        (pair[0].revolute, pair[1].revolute),
    )
    return SpatialArm(mapped, domain, pair, base, rows, origin, frame, size, neutral)


def section_frame(base: Axis | None, rows: Array) -> tuple[Array, Array]:
    """Return the axes (3, 3) of the section and its origin: the base's axis is the last; of a slide it starts at 0."""
    if base is None:
        return np.vstack([rows, np.cross(rows[0], rows[1])]), np.zeros(3)
    first = across(base.direction)
    frame = np.array([first, np.cross(base.direction, first), base.direction])
    across_axis = base.point - (base.point @ base.direction) * base.direction  # so that h is a coordinate of the world
    return frame, across_axis if base.revolute else np.zeros(3)


def _size(axes: Sequence[Axis], tip: Array) -> float:
    """Return the length of the arm: distances between its axes' points, and the largest strokes [m]."""
    centres = [axis.point for axis in axes if axis.revolute]
    chain = [*centres, tip]
    size = sum(float(np.linalg.norm(b - a)) for a, b in itertools.pairwise(chain))
    size += sum(max(abs(axis.lower), abs(axis.upper)) for axis in axes if not axis.revolute)
    return size or 1.0


def without_held(axes: Sequence[Axis], tip: Array, near: float) -> tuple[list[Axis], Array]:
    """Return the joints with room to move that move the tip, and the tip, as the others hold them."""
    kept = list(axes)
    for k in range(len(kept) - 1, -1, -1):
        held = kept[k]
        if held.upper - held.lower >= CLOSED:
            continue
        moved = _motion(held, held.lower)
        for i in range(k + 1, len(kept)):
            kept[i] = replace(kept[i], direction=moved.rotation @ kept[i].direction, point=moved.act(kept[i].point))
        tip = moved.act(tip)
        del kept[k]
    while kept and kept[-1].revolute and np.linalg.norm(np.cross(kept[-1].direction, tip - kept[-1].point)) < near:
        kept.pop()
    return kept, tip


def _motion(axis: Axis, value: float) -> pin.SE3:
    if not axis.revolute:
        return pin.SE3(np.eye(3), value * axis.direction)
    R = pin.AngleAxis(float(np.mod(value, tau)), axis.direction).toRotationMatrix()
    return pin.SE3(R, axis.point - R @ axis.point)
