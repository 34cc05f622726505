"""The joints on the way to the tip, as axes in the world at q = 0."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from math import pi, tau

import numpy as np
import pinocchio as pin

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.kinematics import frame_jacobian
from robotics1.robot.box import intervals
from robotics1.robot.model import Robot
from robotics1.workspaces.planar_joints import CLOSED

STRAIGHT = 1e-9  # of directions that are parallel or normal, and of distances by the arm's size


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

    def turns_to(self, angle: float) -> bool:
        """Return whether an angle, but for whole turns, is in the range of a revolute joint."""
        beyond = (angle - self.lower) % tau
        return beyond <= self.upper - self.lower + CLOSED or beyond >= tau - CLOSED


def axes_to(robot: Robot, frame: str | None, tip: Array, box: Mapping[str, tuple[float, float]] | None) -> list[Axis]:
    """Return the joints on the way to the tip, without the last ones if they turn about the tip."""
    axes = all_axes_to(robot, frame, box)
    while axes and axes[-1].revolute and distance_to(axes[-1], tip) < STRAIGHT * robot.reach:
        axes.pop()
    return axes


def all_axes_to(robot: Robot, frame: str | None, box: Mapping[str, tuple[float, float]] | None) -> list[Axis]:
    """Return the joints on the way to a frame.

    Raises:
        TaskError: one of them mimics another one.
    """
    way = [joint for joint in robot.joints_to(frame) if joint.kind != "fixed"]
    followers = [joint.name for joint in way if joint.follows]
    if followers:
        raise TaskError(
            f"joint {followers[0]!r} mimics another one; the workspace of such arms is not known: a robot with "
            "independent joints is needed"
        )
    lower, upper = intervals(robot, box)
    q = np.zeros(robot.nq)
    pin.forwardKinematics(robot.own_model, robot.data, q)
    J = frame_jacobian(robot, q, frame=frame)
    placements = {joint.name: pin.SE3(robot.data.oMi[robot.own_model.getJointId(joint.name)]) for joint in way}
    axes = []
    for joint in way:
        i = robot.joint_names.index(joint.name)
        turns = bool(robot.revolute[i])
        direction = J[3:, i] if turns else J[:3, i]
        axes.append(
            Axis(i, joint.name, turns, direction, np.array(placements[joint.name].translation), lower[i], upper[i])
        )
    return [_with_one_turn(axis) for axis in axes]


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
