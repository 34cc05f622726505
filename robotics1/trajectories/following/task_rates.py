"""Second-order kinematics of any task: J̇, J̇ q̇, and the motion of the task that a joint motion makes."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.differentiation import derivative_inside, directional_derivative
from robotics1.errors import InputError
from robotics1.inputs import Array, a_robot_and_a_task
from robotics1.kinematics import joint_rates
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task
from robotics1.trajectories.instants import times_inside
from robotics1.trajectories.protocols import Side, Trajectory, require_motion, smooth_ends


def jacobian_rate(robot: Robot, task: Task, q: npt.ArrayLike, qdot: npt.ArrayLike) -> Array:
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
    a_robot_and_a_task(robot, task)
    q = robot.configuration(q)
    return directional_derivative(lambda x: task.jacobian(robot, x), robot, q, joint_rates(robot, "qdot", qdot))


@dataclass(frozen=True, eq=False)
class TaskTrajectory:
    """r(t) = f(q(t)) of a joint motion: ṙ = J q̇, r̈ = J q̈ + J̇ q̇; so its speed, peaks and plots are at hand.

    Attributes:
        robot: the robot.
        task: r = f(q).
        trajectory: q(t).
    """

    robot: Robot
    task: Task
    trajectory: Trajectory

    def __post_init__(self) -> None:
        """Refuse a motion of other joints, and a task that does not fit."""
        require_motion("trajectory", self.trajectory, derivatives=2)
        a_robot_and_a_task(self.robot, self.task)
        self.task.check(self.robot)
        rates = np.shape(self.trajectory.velocity(0.0))
        if rates != (self.robot.nv,):
            raise InputError(f"the trajectory must move {self.robot.nv} joints; its velocity has the shape {rates}")

    @property
    def duration(self) -> float:
        """T [s]."""
        return float(self.trajectory.duration)

    @property
    def switching_times(self) -> Array:
        """Those of the joint motion [s]."""
        return np.array(smooth_ends(self.trajectory)[1:-1])

    def __call__(self, t: npt.ArrayLike) -> Any:
        """Return r(t) in the form of the task's value; of (k,) times an array, or of poses a list."""
        times = times_inside(t, self.duration)
        values = [self.task.value(self.robot, self.trajectory(float(x))) for x in np.atleast_1d(times)]
        return values[0] if not times.ndim else values if hasattr(values[0], "rotation") else np.array(values)

    def velocity(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return ṙ(t), (m,) or (k, m)."""
        return self._each(t, lambda x: self._velocity(x, side))

    def acceleration(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return r̈(t), (m,) or (k, m)."""
        return self._each(t, lambda x: self._acceleration(x, side))

    def jerk(self, t: npt.ArrayLike, *, side: Side = "right") -> Array:
        """Return the third derivative of r(t), (m,) or (k, m), by differences: exact to about 1e-6."""
        return self._each(t, lambda x: derivative_inside(self._acceleration, x, smooth_ends(self), side))

    def _velocity(self, t: float, side: Side) -> Array:
        return self.task.jacobian(self.robot, self.trajectory(t)) @ self.trajectory.velocity(t, side=side)

    def _acceleration(self, t: float, side: Side) -> Array:
        q, qdot = self.trajectory(t), self.trajectory.velocity(t, side=side)
        drift = jacobian_rate(self.robot, self.task, q, qdot) @ qdot
        return np.asarray(self.task.jacobian(self.robot, q) @ self.trajectory.acceleration(t, side=side) + drift)

    def _each(self, t: npt.ArrayLike, f: Any) -> Array:
        times = times_inside(t, self.duration)
        values = np.array([f(float(x)) for x in np.atleast_1d(times)])
        return values if times.ndim else values[0]
