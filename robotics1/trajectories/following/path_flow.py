"""The differential equation of joints that follow a task trajectory, of first and second order."""

from dataclasses import dataclass

import numpy as np

from robotics1.curves.curve import Curve
from robotics1.curves.named_derivatives import Side
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task
from robotics1.trajectories.following.resolution import Resolution, Wish, resolved

SOFT = 1e-4  # σ/σ₁ of A without units below which an inverse without damping is softened; elsewhere it is exact


@dataclass(frozen=True, eq=False)
class Command:
    """What is asked of the task at one instant, and what the joints make of it.

    Attributes:
        joints: (nv,) what is chosen: q̇ of first order, q̈ of second.
        rate: the derivative of the state: q̇, or (q̇, u̇).
        error: (m,) r_d − r.
        residual: (m,) the part of the asked ṙ or r̈ that is not realised.
        jacobian: (m, k) A = J G.
    """

    joints: Array
    rate: Array
    error: Array
    residual: Array
    jacobian: Array

    @property
    def sigma(self) -> float:
        """The smallest singular value of A; 0 without inputs."""
        return float(np.linalg.svd(self.jacobian, compute_uv=False)[-1:].sum())


@dataclass(frozen=True, eq=False)
class PathFlow:
    """The joints of a state q: q̇ = G u with u = A# (ṙ_d + K e) + null motion, A = J G and e = r_d − r. Of second order
    the state is (q, u): u̇ = A# (r̈_d + K_D ė + K_P e − Ȧ u) + null motion.

    Attributes:
        robot, task, trajectory: r = f(q), and r_d(t).
        resolution: the inverse.
        gains: (1, m) K; of second order (2, m) K_P and K_D.
        wish: q̇₀, a vector or a function of q; of second order q̈₀, a vector or a function of q and u.
    """

    robot: Robot
    task: Task
    trajectory: Curve
    resolution: Resolution
    gains: Array
    wish: Wish

    @property
    def order(self) -> int:
        """1 or 2."""
        return len(self.gains)

    def command(self, t: float, state: Array, side: Side) -> Command:
        """Return what is asked at t and what the joints do."""
        robot, task = self.robot, self.task
        q, u = state[: robot.nv], state[robot.nv :]
        error = task.error(robot, q, self.trajectory(t))
        asked = self.trajectory.derivative(t, self.order, side=side) + self.gains[0] * error
        if self.order == 2:
            qdot = self.resolution.inputs(robot, q) @ u
            asked += self.gains[1] * (self.trajectory.velocity(t, side=side) - task.jacobian(robot, q) @ qdot)
        given = u if self.order == 2 else None
        rates = resolved(robot, task, self.resolution, q, asked, self.wish, u=given, soft=SOFT)
        rate = rates.joints if self.order == 1 else np.concatenate([qdot, rates.inputs])
        return Command(rates.joints, rate, error, asked - rates.realised, rates.A)
