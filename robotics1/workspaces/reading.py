"""A robot and a task, read as a planar chain: in the task's plane, times a slide across it, or turned about an axis."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from robotics1.caching import cached_property
from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.kinematics import forward_kinematics
from robotics1.robot.box import refuse_open_range
from robotics1.robot.model import Robot
from robotics1.tasks.rows import constant_rows
from robotics1.tasks.task import Task
from robotics1.workspaces.axes import STRAIGHT, Axis, across, are_planar, axes_to, require_moving
from robotics1.workspaces.planar_joints import CLOSED, PlanarJoint


@dataclass(frozen=True)
class ReadArm:
    """An arm as a planar chain of unit size, and where its plane is.

    A point P of the world is z = ((P − origin)·first + i (P − origin)·second)/size in the plane.

    Attributes:
        joints: of the plane, the first nearest to the base.
        tip: the tip at q = 0.
        size: a length of the size of the arm [m].
        origin: the first centre in the plane; of an arm that turns, a point of the axis.
        first, second: unit vectors of the plane; of an arm that turns, second is the axis.
        rows: (m, 3) the rows of the task: r = rows P.
        neutral: (nq,) the values of the joints that do not move the tip [rad or m]; 0 of the others, if it is a limit.
        base: the joint that turns the plane about `second`, or None.
        slide: the joint that slides across the plane, or None.
        height: of the tip across the plane when the slide is at 0 [m].
    """

    joints: tuple[PlanarJoint, ...]
    tip: complex
    size: float
    origin: Array
    first: Array
    second: Array
    rows: Array
    neutral: tuple[float, ...]
    base: Axis | None = None
    slide: Axis | None = None
    height: float = 0.0

    @cached_property
    def normal(self) -> Array:
        """The unit vector across the plane."""
        return np.cross(self.first, self.second)

    def in_plane(self, point: Array) -> complex:
        """Return z of a point (3,) of the world."""
        offset = (point - self.origin) / self.size
        return complex(offset @ self.first, offset @ self.second)

    def in_world(self, z: complex) -> Array:
        """Return the point (3,) of the plane at z."""
        return self.origin + self.size * (z.real * self.first + z.imag * self.second)


def moving_point(
    robot: Robot, task: Task, box: Mapping[str, tuple[float, float]] | None
) -> tuple[Array, Array, list[Axis]]:
    """Return the rows (m, 3) of a task, its point (3,) at q = 0, and the joints that move it.

    Raises:
        TaskError: the task is no position, or no joint moves it.
    """
    robot.require_single_coordinates("have a workspace")
    rows, frame = position_rows(task)
    tip = np.array(forward_kinematics(robot, np.zeros(robot.nq), frame=frame).translation)
    axes = axes_to(robot, frame, tip, box)
    require_moving(axes, robot)
    return rows, tip, axes


def read_arm(robot: Robot, axes: Sequence[Axis], tip: Array, rows: Array) -> ReadArm | None:
    """Return the planar chain that joints are for the rows (m, 3) of a task; None if they are none.

    Raises:
        TaskError: the chain has no area or volume, or two of its joints move the tip alike.
        InputError: a prismatic joint has no limits.
    """
    if len(rows) == 2:
        return _in_plane(axes, tip, rows, robot)
    return _across_a_slide(axes, tip, rows, robot) or _about_an_axis(axes, tip, rows, robot)


def position_rows(task: Task) -> tuple[Array, str | None]:
    """Return the directions whose coordinates the task is, (m, 3), and its frame."""
    form, S = task.frame_map(), constant_rows(task)
    if form is not None and S is not None and form.reference == "world" and len(S) in (2, 3):
        n = S[:, :3]
        if not S[:, 3:].any() and np.allclose(n @ n.T, np.eye(len(S))):
            return n, form.frame
    raise TaskError(
        "a workspace is one of two or three coordinates of a point in world axes: use PositionTask('xy') of an "
        "arm in a plane, or PositionTask() of an arm in space, with point= beside the tool; a function of your own "
        "cannot be read"
    )


def _in_plane(axes: Sequence[Axis], tip: Array, rows: Array, robot: Robot) -> ReadArm | None:
    normal = np.cross(rows[0], rows[1])
    moving = [axis for axis in axes if axis.revolute or abs(axis.direction @ normal) < 1 - STRAIGHT]
    if not are_planar(moving, normal):
        return None
    return _chain(moving, tip, rows, robot, rows[0], rows[1])


def _across_a_slide(axes: Sequence[Axis], tip: Array, rows: Array, robot: Robot) -> ReadArm | None:
    """Return the arm if one prismatic joint is normal to the plane in which the others move."""
    turning = [axis for axis in axes if axis.revolute]
    for slide in (axis for axis in axes if not axis.revolute):
        others = [axis for axis in axes if axis is not slide]
        normal = slide.direction * np.sign(slide.direction[np.argmax(np.abs(slide.direction))])
        if not are_planar(others, normal) or (turning and abs(turning[0].direction @ normal) < 1 - STRAIGHT):
            continue
        refuse_open_range(slide.name, slide.lower, slide.upper)
        _need_room(slide)
        first = across(normal)
        arm = _chain(others, tip, rows, robot, first, np.cross(normal, first))
        return replace(arm, slide=slide, height=float((tip - arm.origin) @ normal))
    return None


def plane_beside_axis(robot: Robot, axes: Sequence[Axis], tip: Array, rows: Array) -> ReadArm | None:
    """Return the arm as if the plane that its first joint turns contained the axis; None if it turns no plane."""
    return None if len(rows) == 2 else _about_an_axis(axes, tip, rows, robot, beside=True)


def _about_an_axis(
    axes: Sequence[Axis], tip: Array, rows: Array, robot: Robot, *, beside: bool = False
) -> ReadArm | None:
    """Return the arm if its first joint turns the plane of the others, which contains the axis or is beside it."""
    if len(axes) < 3 or not axes[0].revolute:
        return None
    base, others = axes[0], axes[1:]
    turning = [axis.direction for axis in others if axis.revolute]
    normal = turning[0] if turning else np.cross(base.direction, others[0].direction)
    size = np.linalg.norm(normal)
    if size < STRAIGHT or abs(normal @ base.direction) > STRAIGHT or not are_planar(others, normal / size):
        return None
    away = float((tip - base.point) @ normal) / size
    if beside:
        tip = tip - away * normal / size
    elif abs(away) > STRAIGHT * robot.reach:
        return None
    _need_room(base)
    first = np.cross(base.direction, normal / size)
    return _moved_to(_chain(others, tip, rows, robot, first, base.direction), base)


def _need_room(axis: Axis) -> None:
    if axis.upper - axis.lower < CLOSED:
        raise TaskError(
            f"joint {axis.name!r} has no room to move, so that the workspace in space has no volume; "
            "use two coordinates, as PositionTask('xy')"
        )


def _moved_to(arm: ReadArm, base: Axis) -> ReadArm:
    """Return the arm with the origin of its plane on the axis of its first joint."""
    offset = arm.in_plane(base.point)
    joints = tuple(replace(j, place=j.place - offset) if j.revolute else j for j in arm.joints)
    return replace(arm, joints=joints, tip=arm.tip - offset, origin=base.point, base=base)


def _chain(axes: Sequence[Axis], tip: Array, rows: Array, robot: Robot, first: Array, second: Array) -> ReadArm:
    """Return a planar chain of unit size; joints that have no room to move are fixed where they are.

    Raises:
        TaskError: fewer than two joints move the tip, or two joints one after the other do the same.
        InputError: a prismatic joint has no limits.
    """
    for axis in axes:
        if not axis.revolute:
            refuse_open_range(axis.name, axis.lower, axis.upper)
    origin = next((axis.point for axis in axes if axis.revolute), tip)
    centres = [axis.point for axis in axes if axis.revolute]
    flat = np.array([[(p - origin) @ first, (p - origin) @ second] for p in [*centres, tip]])
    size = sum(float(np.hypot(*(b - a))) for a, b in pairwise(flat))
    size += sum(max(abs(axis.lower), abs(axis.upper)) for axis in axes if not axis.revolute)
    lower, upper = robot.lower.copy(), robot.upper.copy()
    for axis in axes:
        lower[axis.number], upper[axis.number] = axis.lower, axis.upper
    neutral = tuple(map(float, np.clip(np.zeros(robot.nq), lower, upper)))
    arm = ReadArm((), 0j, size or 1.0, origin, first, second, rows, neutral)
    joints = [_planar_joint(axis, arm) for axis in axes]
    moving, at_tip = _without_fixed(joints, arm.in_plane(tip))
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
    return replace(arm, joints=tuple(moving), tip=at_tip)


def _planar_joint(axis: Axis, arm: ReadArm) -> PlanarJoint:
    if axis.revolute:
        sign = 1 if axis.direction @ arm.normal > 0 else -1
        return PlanarJoint(
            axis.number, axis.name, True, arm.in_plane(axis.point), sign, axis.lower, axis.upper, axis.circular
        )
    direction = complex(axis.direction @ arm.first, axis.direction @ arm.second)
    return PlanarJoint(
        axis.number,
        axis.name,
        False,
        direction / abs(direction),
        1,
        axis.lower / arm.size,
        axis.upper / arm.size,
        False,
    )


def _without_fixed(joints: Sequence[PlanarJoint], tip: complex) -> tuple[list[PlanarJoint], complex]:
    """Return the joints with room to move, and the tip, as the others hold them."""
    kept = list(joints)
    for k in range(len(kept) - 1, -1, -1):
        held = kept[k]
        if held.upper - held.lower >= CLOSED:
            continue
        value = held.lower
        for i in range(k + 1, len(kept)):
            j = kept[i]
            kept[i] = replace(j, place=held.move(j.place, value) if j.revolute else held.turn(j.place, value))
        tip = held.move(tip, value)
        del kept[k]
    while kept and kept[-1].revolute and abs(kept[-1].place - tip) < STRAIGHT:
        kept.pop()
    return kept, tip
