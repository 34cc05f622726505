"""The joints on the way to the tip, as axes in the world at q = 0."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import pi, tau

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.angles import without_turns
from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.robot.box import intervals, refuse_open_range
from robotics1.robot.model import Robot

STRAIGHT = 1e-9  # of directions that are parallel or normal, and of distances by the arm's size
CLOSED = 1e-9  # rad that a full turn may lack
ALIKE = 1e-11  # the same, where bounds are proven


@dataclass(frozen=True)
class Axis:
    """A joint that is on the way to the tip, at q = 0, in world axes."""

    number: int
    name: str
    revolute: bool
    direction: Array
    point: Array
    lower: float
    upper: float

    @property
    def circular(self) -> bool:
        """Whether it can make a full turn."""
        return self.revolute and self.upper - self.lower >= tau - CLOSED

    def motion(self, value: float) -> pin.SE3:
        """Return how it moves what is after it."""
        if not self.revolute:
            return pin.SE3(np.eye(3), value * self.direction)
        R = pin.AngleAxis(float(np.mod(value, tau)), self.direction).toRotationMatrix()
        return pin.SE3(R, self.point - R @ self.point)

    def value_at(self, w: float, near: float) -> float | None:
        """Return its value at an angle, but for whole turns, or at a place of a slide; None if beyond its limits."""
        if not self.revolute:
            return w if self.lower - near <= w <= self.upper + near else None
        beyond = (w - self.lower) % tau
        if near < beyond - (self.upper - self.lower) and beyond < tau - near:
            return None
        return self.lower + (beyond if beyond < tau - near else beyond - tau)


def joints_on_the_way(robot: Robot, frame: str | None) -> tuple[list[Axis], list[float]]:
    """Return the joints on the way to a frame, without limits, and how fast each moves when its coordinate does."""
    pin.forwardKinematics(robot.own_model, robot.data, np.zeros(robot.nq))
    axes, factors = [], []
    for joint in robot.joints_to(frame):
        if joint.kind == "fixed" or joint.multiplier == 0:
            continue
        T = robot.data.oMi[robot.own_model.getJointId(joint.name)]
        direction = T.rotation @ np.array(joint.axis) / np.linalg.norm(joint.axis)
        number, turns = robot.joint_names.index(joint.leader), joint.kind != "prismatic"
        axes.append(Axis(number, joint.name, turns, direction, np.array(T.translation), -np.inf, np.inf))
        factors.append(joint.multiplier)
    return axes, factors


def axes_to(robot: Robot, frame: str | None, box: Mapping[str, tuple[float, float]] | None) -> list[Axis]:
    """Return the joints on the way to a frame, with their limits.

    Raises:
        TaskError: one of them mimics another one.
    """
    followers = [joint.name for joint in robot.joints_to(frame) if joint.kind != "fixed" and joint.follows]
    if followers:
        raise TaskError(
            f"joint {followers[0]!r} mimics another one; the workspace of such arms is not known: a robot with "
            "independent joints is needed"
        )
    lower, upper = intervals(robot, box)
    axes, _ = joints_on_the_way(robot, frame)
    return [_with_one_turn(replace(axis, lower=lower[axis.number], upper=upper[axis.number])) for axis in axes]


def without_joints_at(tip: Array, axes: Sequence[Axis], near: float) -> list[Axis]:
    """Return the joints without the last ones, if they turn about the tip."""
    kept = list(axes)
    while kept and kept[-1].revolute and distance_to(kept[-1], tip) < near:
        kept.pop()
    return kept


def require_moving(axes: Sequence[Axis], robot: Robot) -> None:
    """Raise TaskError if there is no joint."""
    if not axes:
        raise TaskError(f"no joint moves the tip of robot {robot.name!r}, so that its workspace is a point")


def _with_one_turn(axis: Axis) -> Axis:
    """Return a revolute joint that can make a full turn with a range of one turn, around 0 if it can."""
    if not axis.circular:
        return axis
    lower = max(axis.lower, min(-pi, axis.upper - tau))
    return replace(axis, lower=lower, upper=lower + tau)


def distance_to(axis: Axis, point: Array) -> float:
    """Return how far a point (3,) is from the line of an axis."""
    return float(np.linalg.norm(np.cross(axis.direction, point - axis.point)))


def nearest_on(axis: Axis, other: Axis) -> Array:
    """Return the point of an axis that is nearest to another axis; of parallel ones, to the point of the other."""
    a, b, between = axis.direction, other.direction, other.point - axis.point
    c = a @ b
    along = a @ between if 1 - c * c < ALIKE else (a @ between - c * (b @ between)) / (1 - c * c)
    return np.asarray(axis.point + a * along)


def are_planar(axes: Sequence[Axis], normal: Array) -> bool:
    """Return whether revolute axes are along a normal, and prismatic ones across it."""
    along = [abs(float(axis.direction @ normal)) for axis in axes]
    return all(c > 1 - STRAIGHT if axis.revolute else c < STRAIGHT for c, axis in zip(along, axes, strict=True))


def across(direction: Array) -> Array:
    """Return a unit vector normal to a direction: a world axis if one is."""
    for axis in np.eye(3):
        if abs(axis @ direction) < STRAIGHT:
            return np.asarray(axis)
    normal = np.cross(direction, np.eye(3)[int(np.argmin(np.abs(direction)))])
    return np.asarray(normal / np.linalg.norm(normal))


def length_of(axes: Sequence[Axis], tip: Array, directions: Array | None = None) -> float:
    """Return the length of an arm, or 1: its largest strokes and the distances between points of its axes [m].

    With directions (d, 3) they are distances in these only.
    """
    places = np.array([*(axis.point for axis in axes if axis.revolute), tip])
    steps = np.diff(places, axis=0) if directions is None else np.diff(places, axis=0) @ directions.T
    strokes = sum(max(abs(axis.lower), abs(axis.upper)) for axis in axes if not axis.revolute)
    return float(np.linalg.norm(steps, axis=1).sum() + strokes) or 1.0


def without_held(axes: Sequence[Axis], tip: Array, near: float) -> tuple[list[Axis], Array]:
    """Return the joints with room to move that move the tip, and the tip, as the others hold them."""
    kept = list(axes)
    for k in range(len(kept) - 1, -1, -1):
        held = kept[k]
        if held.upper - held.lower >= CLOSED:
            continue
        moved = held.motion(held.lower)
        for i in range(k + 1, len(kept)):
            kept[i] = replace(kept[i], direction=moved.rotation @ kept[i].direction, point=moved.act(kept[i].point))
        tip = moved.act(tip)
        del kept[k]
    return without_joints_at(tip, kept, near), tip


def refuse_open_slides(axes: Sequence[Axis]) -> None:
    """Raise InputError if a prismatic joint has no limits."""
    for axis in axes:
        if not axis.revolute:
            refuse_open_range(axis.name, axis.lower, axis.upper)


def distinct(q: Array, turning: Sequence[bool] | npt.NDArray[np.bool_], same: float) -> npt.NDArray[np.intp]:
    """Return the numbers of rows of q (k, n) that are not those of one before; whole turns of some columns are none."""
    d = q[:, None] - q[None]
    d = np.where(turning, without_turns(d), d)
    return np.flatnonzero(~np.tril(np.abs(d).max(axis=-1, initial=0.0) < same, -1).any(axis=1))
