"""A planar chain: in the task's plane, times a slide across it, or turned about an axis."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from robotics1.caching import cached_property
from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.workspaces.axes import STRAIGHT, Axis, are_planar, length_of, refuse_open_slides
from robotics1.workspaces.flat.planar_joints import PlanarJoint
from robotics1.workspaces.moving_point import MovingPoint
from robotics1.workspaces.placed_section import SectionFrame, frame_of_section


@dataclass(frozen=True)
class PlanarArm:
    """An arm as a planar chain of unit size, and where its plane is.

    A point with the coordinates (u, v) [m] in the section's frame is z = (u + i v)/size in the plane.

    Attributes:
        joints: of the plane, the first nearest to the base.
        tip: the tip at q = 0.
        size: a length of the size of the arm [m].
        place: where the plane is: its origin is the first centre in the plane; of an arm that turns, a point of the
            axis. The base turns the plane, which contains the axis at an angle of 0; or it slides across the plane.
        height: of the tip across the plane when a slide is at 0 [m].
    """

    joints: tuple[PlanarJoint, ...]
    tip: complex
    size: float
    place: SectionFrame
    height: float = 0.0

    @property
    def turn(self) -> Axis | None:
        """The joint that turns the plane, or None."""
        return self.place.base if self.place.about_axis else None

    @property
    def slide(self) -> Axis | None:
        """The joint that slides across the plane, or None."""
        return None if self.place.about_axis else self.place.base

    @property
    def directions(self) -> Array:
        """Unit vectors (2, 3) along u and v."""
        return self.place.frame[[0, 2 if self.place.about_axis else 1]]

    @property
    def normal(self) -> Array:
        """The unit vector across the plane."""
        return np.cross(*self.directions)

    def in_plane(self, point: Array) -> complex:
        """Return z of a point (3,) of the world."""
        u, v = self.directions @ (point - self.place.origin) / self.size
        return complex(u, v)

    @cached_property
    def start(self) -> Array:
        """The section's coordinates (2,) of z = 0 [m]: those of the world, but for ρ."""
        u, v = self.directions @ self.place.origin
        return np.array([0.0 if self.place.about_axis else u, v])

    def coordinates(self, z: complex) -> Array:
        """Return the section's coordinates (2,) at z [m]; see `Workspace`."""
        return self.start + self.size * np.array([z.real, z.imag])

    def at(self, coordinates: Array) -> complex:
        """Return z at coordinates (2,) of the section [m]."""
        return complex(*(coordinates - self.start) / self.size)

    def in_units(self, q: tuple[float, ...]) -> Array:
        """Return q (nq,) [rad or m] of a chain of unit size; a slide across the plane is in the middle of its range."""
        values = np.array(q)
        for joint in self.joints:
            values[joint.number] *= 1.0 if joint.revolute else self.size
        if self.slide is not None:
            values[self.slide.number] = (self.slide.lower + self.slide.upper) / 2
        return values


def planar_arm(robot: Robot, point: MovingPoint) -> PlanarArm | None:
    """Return the planar chain that joints are for a task; None if they are none.

    Raises:
        TaskError: the chain has no area or volume, or two of its joints move the tip alike.
        InputError: a prismatic joint has no limits.
    """
    if len(point.rows) == 2:
        return _in_plane(robot, point)
    return _across_a_slide(robot, point) or _about_an_axis(robot, point)


def _in_plane(robot: Robot, point: MovingPoint) -> PlanarArm | None:
    frame, _ = frame_of_section(None, point.rows)
    moving = [axis for axis in point.axes if axis.revolute or abs(axis.direction @ frame[2]) < 1 - STRAIGHT]
    return _chain(robot, point, moving, frame, None) if are_planar(moving, frame[2]) else None


def _across_a_slide(robot: Robot, point: MovingPoint) -> PlanarArm | None:
    """Return the arm if one prismatic joint is normal to the plane in which the others move."""
    turning = [axis for axis in point.axes if axis.revolute]
    for slide in (axis for axis in point.axes if not axis.revolute):
        others = [axis for axis in point.axes if axis is not slide]
        n = slide.direction
        if are_planar(others, n) and not (turning and abs(turning[0].direction @ n) < 1 - STRAIGHT):
            refuse_open_slides([slide])
            return _chain(robot, point, others, frame_of_section(slide, point.rows)[0], slide)
    return None


def plane_beside_axis(robot: Robot, point: MovingPoint) -> PlanarArm | None:
    """Return the arm as if the plane that its first joint turns contained the axis; None if it turns no plane."""
    return None if len(point.rows) == 2 else _about_an_axis(robot, point, beside=True)


def _about_an_axis(robot: Robot, point: MovingPoint, *, beside: bool = False) -> PlanarArm | None:
    """Return the arm if its first joint turns the plane of the others, which contains the axis or is beside it."""
    if len(point.axes) < 3 or not point.axes[0].revolute:
        return None
    base, others = point.axes[0], point.axes[1:]
    turning = [axis.direction for axis in others if axis.revolute]
    normal = turning[0] if turning else np.cross(base.direction, others[0].direction)
    size = np.linalg.norm(normal)
    if size < STRAIGHT or abs(normal @ base.direction) > STRAIGHT or not are_planar(others, normal / size):
        return None
    away = float((point.tip - base.point) @ normal) / size
    if not beside and abs(away) > STRAIGHT * robot.reach:
        return None
    point = point._replace(tip=point.tip - away * normal / size if beside else point.tip)
    first = np.cross(base.direction, normal / size)
    return _chain(robot, point, others, np.array([first, np.cross(base.direction, first), base.direction]), base)


def _chain(robot: Robot, point: MovingPoint, axes: Sequence[Axis], frame: Array, base: Axis | None) -> PlanarArm:
    """Return the planar chain of some of the joints.

    Raises:
        TaskError: fewer than two joints move the tip in the plane, or two joints one after the other do the same.
        InputError: a prismatic joint has no limits.
    """
    refuse_open_slides(axes)
    tip, about_axis = point.tip, base is not None and base.revolute
    origin = next((axis.point for axis in axes if axis.revolute), tip)
    if base is not None and base.revolute:
        origin = base.point
    size = length_of(axes, tip, frame[[0, 2 if about_axis else 1]])
    arm = PlanarArm((), 0j, size, SectionFrame(point.rows, origin, frame, base, point.neutral))
    moving = [_planar_joint(axis, arm) for axis in axes]
    while moving and moving[-1].revolute and abs(moving[-1].place - arm.in_plane(tip)) < STRAIGHT:
        moving.pop()
    if len(moving) < 2:
        raise TaskError(
            f"a workspace with an area needs two joints that move the tip in the plane; "
            f"robot {robot.name!r} has {len(moving)}"
        )
    for one, other in pairwise(moving):
        same = abs(one.place - other.place) if one.revolute else abs((one.place.conjugate() * other.place).imag)
        if one.revolute == other.revolute and same < STRAIGHT:
            raise TaskError(
                f"joints {one.name!r} and {other.name!r} move the tip alike; lock one of them, as in "
                f"load_robot(..., locked={{{other.name!r}: 0}})"
            )
    height = 0.0 if about_axis else float(frame[2] @ (tip - origin))
    return replace(arm, joints=tuple(moving), tip=arm.in_plane(tip), height=height)


def _planar_joint(axis: Axis, arm: PlanarArm) -> PlanarJoint:
    if axis.revolute:
        sign = 1 if axis.direction @ arm.normal > 0 else -1
        place, unit = arm.in_plane(axis.point), 1.0
    else:
        d = complex(*arm.directions @ axis.direction)
        sign, place, unit = 1, d / abs(d), arm.size
    lower, upper = axis.lower / unit, axis.upper / unit
    return PlanarJoint(axis.number, axis.name, axis.revolute, place, sign, lower, upper, axis.circular)
