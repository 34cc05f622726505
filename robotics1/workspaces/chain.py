"""The point that the joints of any arm move, for many configurations at once: a product of exponentials.

Joints that mimic another one move with it: n coordinates q drive m joints, v = A q, and the point is p(v).

Source: Lynch, Park, Modern Robotics, 2017, sections 4.1 and 5.1.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.kinematics import forward_kinematics
from robotics1.orientation.elementary import cross_matrix
from robotics1.robot.box import intervals, joint_box, refuse_open_range, turns_of_followers
from robotics1.robot.model import Robot
from robotics1.workspaces.axes import ALIKE, Axis, joints_on_the_way, without_joints_at

AT_LIMIT = 0.125  # the share of drawn values that are at a limit


@dataclass(frozen=True, eq=False)
class Chain:
    """A point, moved by m joints that n coordinates drive.

    Attributes:
        axes: the joints at q = 0, the first nearest to the base.
        tip: (3,) the point at q = 0 [m].
        A: (m, n) v = A q; a joint that mimics none has a row with one 1.
        numbers: (n,) the places of the coordinates in the configuration of the robot.
        lower, upper: (n,) the limits [rad or m]; of a circle its ends.
        circular: (n,) whether lower and upper are the same place.
    """

    axes: tuple[Axis, ...]
    tip: Array
    A: Array
    numbers: npt.NDArray[np.intp]
    lower: Array
    upper: Array
    circular: npt.NDArray[np.bool_]

    @cached_property
    def _motions(self) -> list["_Motion"]:
        return [_Motion.of(axis) for axis in self.axes]

    def point(self, q: Array) -> Array:
        """Return the point at q (k, n): (k, 3)."""
        v = q @ self.A.T
        p = np.broadcast_to(self.tip, (len(q), 3))
        for i in range(len(self.axes) - 1, -1, -1):
            p = self._motions[i].point(v[:, i], p)
        return np.asarray(p)

    def jacobian(self, q: Array) -> tuple[Array, Array]:
        """Return the point (k, 3) and its Jacobian (k, 3, n) at q (k, n)."""
        p, columns = self.joint_columns(q @ self.A.T)
        return p, columns @ self.A

    def joint_columns(self, v: Array) -> tuple[Array, Array]:
        """Return the point (k, 3) and its derivatives by the joints (k, 3, m), at their values v (k, m)."""
        k, m = v.shape
        columns = np.zeros((m, k, 3))
        p = np.broadcast_to(self.tip, (k, 3))
        for i in range(m - 1, -1, -1):
            motion = self._motions[i]
            p = motion.point(v[:, i], p)
            columns[i + 1 :] = motion.vectors(v[:, i], columns[i + 1 :])
            columns[i] = motion.velocity(p)
        return np.asarray(p), np.moveaxis(columns, 0, -1)

    def turning(self, v: Array) -> Array:
        """Return the axes of the joints, at their values v (k, m): (k, m, 3); zero of slides."""
        k, m = v.shape
        directions = np.zeros((m, k, 3))
        for i in range(m - 1, -1, -1):
            motion = self._motions[i]
            directions[i + 1 :] = motion.vectors(v[:, i], directions[i + 1 :])
            directions[i] = motion.direction if motion.revolute else 0.0
        return np.moveaxis(directions, 0, 1)

    def drawn(self, rng: np.random.Generator, count: int) -> Array:
        """Return configurations (count, n) inside the limits; some values are at limits."""
        q = rng.uniform(self.lower, self.upper, (count, len(self.lower)))
        at_limit = rng.random(q.shape) < AT_LIMIT
        ends = np.where(rng.random(q.shape) < 0.5, self.lower, self.upper)
        return np.where(at_limit & ~self.circular, ends, q)


@dataclass(frozen=True, eq=False)
class _Motion:
    """A joint: R v = v + sin q K v + (1 − cos q) K² v (Rodrigues), with K v = a × v."""

    revolute: bool
    direction: Array
    place: Array
    K: Array
    square: Array

    @classmethod
    def of(cls, axis: Axis) -> "_Motion":
        K = cross_matrix(axis.direction)
        return cls(axis.revolute, axis.direction, axis.point, K.T, (K @ K).T)

    def vectors(self, value: Array, v: Array) -> Array:
        """Return vectors (..., k, 3), turned by values (k,)."""
        if not self.revolute:
            return v
        return np.asarray(v + np.sin(value)[:, None] * (v @ self.K) + (1 - np.cos(value))[:, None] * (v @ self.square))

    def point(self, value: Array, p: Array) -> Array:
        """Return points (k, 3), moved by values (k,)."""
        if not self.revolute:
            return np.asarray(p + value[:, None] * self.direction)
        return np.asarray(self.place + self.vectors(value, p - self.place))

    def velocity(self, p: Array) -> Array:
        """Return how fast points (k, 3) move at unit speed."""
        return np.asarray((p - self.place) @ self.K) if self.revolute else np.broadcast_to(self.direction, p.shape)


def chain_of(axes: Sequence[Axis], tip: Array) -> Chain:
    """Return the chain of joints that move a tip (3,), each driven by its own coordinate."""
    ends = np.array([(axis.lower, axis.upper) for axis in axes]).reshape(-1, 2)
    numbers = np.array([axis.number for axis in axes], dtype=np.intp)
    circular = np.array([axis.circular for axis in axes], dtype=bool)
    return Chain(tuple(axes), np.array(tip), np.eye(len(axes)), numbers, ends[:, 0], ends[:, 1], circular)


def driven_chain(robot: Robot, frame: str | None, box: Mapping[str, tuple[float, float]] | None) -> Chain:
    """Return what moves the origin of a frame; without the last joints if they turn about it.

    Raises:
        InputError: a prismatic joint has no limits.
        UnknownNameError: the box names no joint.
    """
    tip = np.array(forward_kinematics(robot, np.zeros(robot.nq), frame=frame).translation)
    axes, factors = joints_on_the_way(robot, frame)
    axes = without_joints_at(tip, axes, ALIKE * robot.reach)
    numbers = np.array(sorted({axis.number for axis in axes}), dtype=np.intp)
    lower, upper = intervals(robot, box)
    for i in numbers[~robot.revolute[numbers]]:  # slides that do not move the point may be endless
        refuse_open_range(robot.joint_names[i], lower[i], upper[i])
    limits = joint_box(robot, box, unlimited=1.0, turns=turns_of_followers(robot, [frame]))
    A = np.zeros((len(axes), len(numbers)))
    for row, axis, factor in zip(A, axes, factors, strict=False):
        row[np.searchsorted(numbers, axis.number)] = factor
    return Chain(tuple(axes), tip, A, numbers, limits.lower[numbers], limits.upper[numbers], limits.circular[numbers])
