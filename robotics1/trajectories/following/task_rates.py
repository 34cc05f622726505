"""Second-order kinematics of any task: J̇, J̇ q̇, and the motion of the task that a joint motion makes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve
from robotics1.curves.named_derivatives import Side
from robotics1.differentiation import derivative_inside, directional_derivative
from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.kinematics import velocity_of_joints
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import Task


def jacobian_rate(robot: RobotLike, task: TaskLike, q: ConfigurationLike, qdot: npt.ArrayLike) -> Array:
    """Return J̇(q, q̇), (m, nv), of a task's Jacobian: r̈ = J q̈ + J̇ q̇.

    J̇ is the derivative of J along q̇, from differences of sixth order: exact to about 1e-11 for frames, and to 1e-9 for
    a `FunctionTask` without a Jacobian of its own. `frame_jacobian_rate` has that of a frame from Pinocchio.

    Args:
        robot: the robot.
        task: any task; of a task in moving axes J̇ is the derivative of the matrix ʳJ.
        q: (nq,) configuration [rad or m].
        qdot: (nv,) q̇ [rad/s or m/s].

    Raises:
        InputError: q or qdot has the wrong shape or is not finite.
        TaskError: the task does not fit the robot, or its angles are singular there.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.4.
    """
    robot, task = robot_and_task(robot, task)
    q = robot.configuration(q)
    return directional_derivative(lambda x: task.jacobian(robot, x), robot, q, velocity_of_joints(robot, "qdot", qdot))


@dataclass(frozen=True, eq=False)
class TaskTrajectory(Curve):
    """r(t) = f(q(t)) of a joint motion: ṙ = J q̇, r̈ = J q̈ + J̇ q̇; so its speed, peaks and plots are at hand.

    The third derivative is found by differences: exact to about 1e-6.

    Attributes:
        robot: the robot.
        task: r = f(q).
        trajectory: q(t).
    """

    robot: Robot
    task: Task
    trajectory: Curve

    def __post_init__(self) -> None:
        """Refuse a motion of other joints, and a task that does not fit."""
        motion = as_curve("trajectory", self.trajectory, derivatives=2)
        self.__dict__["robot"], self.__dict__["task"] = robot_and_task(self.robot, self.task)
        self.task.check(self.robot)
        if motion.shape != (self.robot.nv,):
            raise InputError(
                f"the trajectory must move {self.robot.nv} joints; its velocity has the shape {motion.shape}"
            )
        object.__setattr__(self, "trajectory", motion)

    @property
    def of_points(self) -> bool:
        """Whether the task's value is a vector."""
        return bool(np.shape(self._value(np.zeros(1), "right")[0]) == self.shape)

    @property
    def shape(self) -> tuple[int, ...]:
        """(m,)."""
        return (self.task.rows,)

    @property
    def end(self) -> float:
        """T [s]."""
        return self.trajectory.end

    @property
    def breakpoints(self) -> Array:
        """Those of the joint motion [s]."""
        return self.trajectory.breakpoints

    def _value(self, t: Array, side: Side) -> Any:
        values = [self.task.value(self.robot, q) for q in self.trajectory(t)]
        return values if hasattr(values[0], "rotation") else np.array(values)

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        if order > 3:
            raise InputError(f"derivatives of a task are known up to the third; order is {order}")
        if order == 0:
            return np.asarray(self._value(t, side))
        of = (self._velocity, self._acceleration, self._jerk)[order - 1]
        return np.array([of(float(x), side) for x in t])

    def _velocity(self, t: float, side: Side) -> Array:
        return np.asarray(self.task.jacobian(self.robot, self.trajectory(t)) @ self.trajectory.velocity(t, side=side))

    def _acceleration(self, t: float, side: Side) -> Array:
        q, qdot = self.trajectory(t), self.trajectory.velocity(t, side=side)
        drift = jacobian_rate(self.robot, self.task, q, qdot) @ qdot
        return np.asarray(self.task.jacobian(self.robot, q) @ self.trajectory.acceleration(t, side=side) + drift)

    def _jerk(self, t: float, side: Side) -> Array:
        return derivative_inside(self._acceleration, t, self.ends, side)
