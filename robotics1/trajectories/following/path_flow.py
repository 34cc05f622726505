"""The differential equation of joints that follow a task trajectory, of first and second order."""

from dataclasses import dataclass
from functools import partial
from typing import ClassVar

import numpy as np

from robotics1.curves.curve import Curve
from robotics1.curves.named_derivatives import Side
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.tasks.rows import unitless_rows
from robotics1.tasks.task import Task
from robotics1.trajectories.following.resolution import Resolution, Wish, resolved_acceleration, resolved_velocity

SOFT = 1e-4  # σ/σ₁ below which an inverse without damping is softened; elsewhere it is exact


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
class VelocityFlow:
    """q̇ = G J# (ṙ_d + K (r_d − r)) + null motion: the state is q.

    Attributes:
        robot, task, trajectory: r = f(q), and r_d(t).
        resolution: the inverse.
        gain: (m,) K.
        wish: q̇₀, a vector or a function of q.
    """

    robot: Robot
    task: Task
    trajectory: Curve
    resolution: Resolution
    gain: Array
    wish: Wish

    order: ClassVar = 1

    def command(self, t: float, state: Array, side: Side) -> Command:
        """Return what is asked at t and what the joints do."""
        error = self.task.error(self.robot, state, self.trajectory(t))
        asked = self.trajectory.velocity(t, side=side) + self.gain * error
        soft = partial(softness, self.robot, self.task)
        rates = resolved_velocity(self.robot, self.task, self.resolution, state, asked, self.wish, soft)
        return Command(rates.joints, rates.joints, error, asked - rates.A @ rates.inputs, rates.A)


@dataclass(frozen=True, eq=False)
class AccelerationFlow:
    """u̇ = (J G)# (r̈_d + K_D (ṙ_d − ṙ) + K_P (r_d − r) − d(J G)/dt u) + null motion: the state is (q, u).

    Attributes:
        robot, task, trajectory: r = f(q), and r_d(t).
        resolution: the inverse.
        gains: (2, m) K_P and K_D.
        wish: q̈₀, a vector or a function of q and u.
    """

    robot: Robot
    task: Task
    trajectory: Curve
    resolution: Resolution
    gains: Array
    wish: Wish

    order: ClassVar = 2

    def command(self, t: float, state: Array, side: Side) -> Command:
        """Return what is asked at t and what the joints do."""
        q, u = state[: self.robot.nv], state[self.robot.nv :]
        qdot = self.resolution.inputs(self.robot, q) @ u
        error = self.task.error(self.robot, q, self.trajectory(t))
        rate_error = self.trajectory.velocity(t, side=side) - self.task.jacobian(self.robot, q) @ qdot
        asked = self.trajectory.acceleration(t, side=side) + self.gains[1] * rate_error + self.gains[0] * error
        soft = partial(softness, self.robot, self.task)
        rates = resolved_acceleration(self.robot, self.task, self.resolution, (q, u), asked, self.wish, soft)
        residual = asked - rates.drift - rates.A @ rates.inputs
        return Command(rates.joints, np.concatenate([qdot, rates.inputs]), error, residual, rates.A)


def softness(robot: Robot, task: Task, A: Array) -> float:
    """Return the σ/σ₁ of A below which its inverse is softened: where that of A without units is below SOFT."""
    if A.shape[1] != robot.nv:
        return SOFT
    unitless = unitless_rows(robot, task)[:, None] * A * robot.units
    (a, b), (c, d) = (np.linalg.svd(M, compute_uv=False)[[0, -1]] for M in (A, unitless))
    return float(SOFT * (b / a) / (d / c)) if min(b, d) > 0 else SOFT
