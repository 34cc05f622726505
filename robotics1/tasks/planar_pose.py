"""The pose of a frame that moves in a plane: two coordinates and an angle."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.angles import warn_of_degrees
from robotics1.errors import TaskError
from robotics1.inputs import Array, one_of, real_array
from robotics1.kinematics import frame_jacobian
from robotics1.orientation.expressions import angle_of, wrapped
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import Robot
from robotics1.tasks.position import numbers_of
from robotics1.tasks.task import FrameTask, PoseError


@dataclass(frozen=True)
class PlanarPoseTask(FrameTask):
    """r = (a, b, φ): the coordinates in the plane [m] and the angle of the frame's x axis [rad].

    φ ∈ (−π, π] is measured from the plane's first axis a to its second b, about n = a × b:
    φ = atan2(x·b, x·a), φ̇ = n·ω.

    Attributes:
        plane: "xy", "xz" or "yz", in the axes of `reference`.
    """

    plane: str = "xy"
    row_units = ("m", "m", "rad")
    has_constant_rows = True

    def __post_init__(self) -> None:
        """Refuse a plane that is none of the three."""
        super().__post_init__()
        one_of("plane", self.plane, ("xy", "xz", "yz"))

    @property
    def row_names(self) -> tuple[str, ...]:
        """The two coordinates and φ."""
        return (*self.plane, "φ")

    def g(self, p: Array, R: Array) -> Array:
        """Return (p·a, p·b, atan2(x·b, x·a)), (3,)."""
        a, b = numbers_of(self.plane)
        return np.array([p[a], p[b], angle_of(R[b, 0], R[a, 0])])

    def S(self, p: Array, R: Array) -> Array:
        """Return the rows a·v, b·v, n·ω, (3, 6)."""
        a, b = np.eye(3)[numbers_of(self.plane)]
        zero = np.zeros(3)
        return np.array([[*a, *zero], [*b, *zero], [*zero, *np.cross(a, b)]])

    def target(self, target: Any) -> Array:
        """Return the target as (3,) [m, m, rad]."""
        r = real_array("the target", target, (3,), f"({', '.join(self.row_names)}) [m, m, rad]")
        warn_of_degrees("the target", r, np.array([False, False, True]))
        return r

    def difference(self, target: Array, value: Array) -> Array:
        """Return r_d − r, (3,), the angle wrapped into (−π, π]."""
        e = target - value
        e[2] = wrapped(e[2])
        return e

    def pose_error(self) -> PoseError:
        """Return the coordinates, and the turn about n."""
        a, b = numbers_of(self.plane)
        return PoseError((a, b, 6 - a - b), self._goal)

    def _goal(self, robot: Robot, target: Any) -> Array:
        """Return the pose of the target; the tilt out of the plane is that of every pose of the robot."""
        r = self.target(target)
        a, b = numbers_of(self.plane)
        n, T = 3 - a - b, np.zeros((4, 4))
        c, s = np.cos(r[2]), np.sin(r[2])
        T[[a, b, n], [a, b, n]], T[b, a], T[a, b] = (c, c, 1.0), s, -s
        T[:3, :3] = T[:3, :3] @ _tilt(robot, self)
        T[a, 3], T[b, 3], T[3, 3] = r[0], r[1], 1.0
        return T

    def _orients(self, rows: tuple[int, ...]) -> bool:
        """Whether φ fixes the orientation: it does, of a frame that stays in the plane."""
        return True

    def check(self, robot: RobotLike) -> None:
        """Raise TaskError if the frame leaves the plane, or its x axis stands on it."""
        robot = robot_from(robot)
        _check_planar(robot, self)


@lru_cache(maxsize=256)
def _tilt(robot: Robot, task: PlanarPoseTask) -> Array:
    """Return the R of the frame where φ = 0, (3, 3)."""
    here = task._pose(robot, pin.neutral(robot.own_model))
    a, b = np.eye(3)[numbers_of(task.plane)]
    return np.asarray(pin.exp3(-task.g(here.translation, here.rotation)[2] * np.cross(a, b)) @ here.rotation)


@lru_cache(maxsize=256)
def _check_planar(robot: Robot, task: PlanarPoseTask) -> None:
    """The rows of J that leave the plane vanish, and x is not along n: seen at three configurations."""
    a, b = numbers_of(task.plane)
    n = 3 - a - b
    for seed in range(3):
        step = np.random.default_rng(seed).uniform(-1, 1, robot.nv)
        q = pin.integrate(robot.own_model, pin.neutral(robot.own_model), step)
        J = frame_jacobian(robot, q, frame=task.frame, reference=task.reference, point=task.point)
        if np.abs(J[[n, 3 + a, 3 + b]]).max(initial=0.0) > 1e-9 * max(robot.reach, 1.0):
            raise TaskError(
                f"robot {robot.name!r} leaves the {task.plane} plane, so it has no planar pose there; "
                f"use another plane, PositionTask or PoseTask"
            )
        x = task._pose(robot, q).rotation[:, 0]
        if np.hypot(x[a], x[b]) < 1e-9:
            raise TaskError(f"the frame's x axis is normal to the {task.plane} plane, so φ is not defined")
