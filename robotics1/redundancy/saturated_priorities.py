"""Several tasks by priority with joint rates, or accelerations, within their limits, at one state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, moderate
from robotics1.kinematics import velocity_of_joints
from robotics1.redundancy.given_levels import checked_levels
from robotics1.redundancy.saturation import acceleration_limits, limits_of
from robotics1.redundancy.within_bounds import BoundedLevel, levels_within
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.tasks.given import TaskLike
from robotics1.trajectories.following.task_rates import jacobian_rate

REALISED = 1e-7  # a residual that is rounding, in SI units


@dataclass(frozen=True, eq=False)
class SaturatedPriorities(Frozen):
    """Joint rates, or accelerations, of several tasks by priority, within their limits.

    Attributes:
        joints: (nv,) q̇, or q̈.
        scales: sᵢ of each level, from 0 to 1, of the part in the range of its Jacobian; nan of a level that no scale
            realises.
        saturated: (nv,) whether a joint is at a limit.
        lower, upper: (nv,) the limits.
        residuals: of each level, ṙᵢ − Jᵢ q̇, or r̈ᵢ − J̇ᵢ q̇ − Jᵢ q̈.
    """

    joints: Array
    scales: tuple[float, ...]
    saturated: npt.NDArray[np.bool_]
    lower: Array
    upper: Array
    residuals: tuple[Array, ...]

    def explain(self) -> str:
        """Return the scale of each level, in a sentence."""
        levels = [
            f"level {i}: "
            + ("no scale realises it" if np.isnan(s) else "realised" if s == 1 else f"slowed down to {s:.6g}")
            for i, s in enumerate(self.scales, 1)
        ]
        return "; ".join(levels)

    def require(self) -> SaturatedPriorities:
        """Return self if every level is realised.

        Raises:
            NotConverged: one is slowed down, not realised by any scale, or has a part out of the range of its Jacobian.
        """
        left = max(float(np.abs(residual).max(initial=0.0)) for residual in self.residuals)
        return require(self, all(s == 1 for s in self.scales) and left <= REALISED)


def saturated_priority_velocity(
    robot: RobotLike,
    levels: Sequence[tuple[TaskLike, npt.ArrayLike]],
    q: ConfigurationLike,
    *,
    limits: npt.ArrayLike | None = None,
    lower: npt.ArrayLike | None = None,
) -> SaturatedPriorities:
    """Return joint velocities of several tasks by priority within their limits: Jᵢ q̇ = sᵢ ṙᵢ, level by level.

    s₁ is as large as the limits allow, then s₂ with the first level as it is, and so on; of all such q̇ the shortest. A
    level that no scale from 0 to 1 realises, since the levels before it move it, is left out.

    Args:
        robot: the robot.
        levels: pairs (task, ṙ), the most important first.
        q: (nq,) configuration [rad or m].
        limits: (nv,) the largest q̇ of each joint, or one number; None for the robot's.
        lower: (nv,) the least q̇, where it is not −limits.

    Raises:
        InputError, TaskError: as `priority_velocity` and `saturated_velocity`.

    Source: Flacco, De Luca, Khatib, Prioritized multi-task motion control of redundant robots under hard joint
    constraints, IROS 2012.
    """
    robot, tasks, rates = checked_levels(robot, levels, "ṙ")
    low, high = limits_of(robot, robot.max_velocity if limits is None else limits, lower)
    rows = [(task.jacobian(robot, q), b, np.zeros(len(b))) for task, b in zip(tasks, rates, strict=True)]
    return _resolved(rows, low, high, levels_within(rows, low, high))


def saturated_priority_acceleration(
    robot: RobotLike,
    levels: Sequence[tuple[TaskLike, npt.ArrayLike]],
    q: ConfigurationLike,
    qdot: npt.ArrayLike,
    *,
    limits: npt.ArrayLike,
    lower: npt.ArrayLike | None = None,
    max_velocity: npt.ArrayLike | None = None,
    step: float | None = None,
) -> SaturatedPriorities:
    """Return joint accelerations of several tasks by priority within their limits: Jᵢ q̈ = sᵢ r̈ᵢ − J̇ᵢ q̇, by levels.

    s₁ is as large as the limits allow, then s₂ with the first level as it is, and so on; of all such q̈ the shortest.
    The drift J̇ᵢ q̇ is not scaled. Where no scale from 0 to 1 lets the limits hold it, sᵢ is nan, and the level is
    brought as near to r̈ᵢ as the levels before it allow: the least |Jᵢ q̈ + J̇ᵢ q̇ − r̈ᵢ|. The shortest q̈ lets
    self-motions go on; a last level such as q̈ = −k q̇ stops them.

    Args:
        robot: the robot.
        levels: pairs (task, r̈), the most important first.
        q: (nq,) configuration [rad or m].
        qdot: (nv,) q̇ [rad/s or m/s].
        limits: (nv,) A, the largest q̈ of each joint, or one number.
        lower: (nv,) the least q̈, where it is not −limits.
        max_velocity: (nv,) V, or one number: after the step |q̇ + q̈ h| ≤ V, so that (−V − q̇)/h ≤ q̈ ≤ (V − q̇)/h. A
            joint that cannot be back within V in one step brakes as much as A allows.
        step: h > 0 [s], for how long q̈ is held; with max_velocity.

    Raises:
        InputError: as `saturated_velocity`; or only one of max_velocity and step is given.
        TaskError: a task does not fit the robot.

    Source: Flacco, De Luca, Khatib, Control of redundant robots under hard joint constraints: saturation in the null
    space, IEEE Trans. Robotics 31, 2015 (limits of q̈); Kanoun, Lamiraux, Wieber, Kinematic control of redundant
    manipulators: generalizing the task-priority framework to inequality task, IEEE Trans. Robotics 27, 2011 (least
    squares by levels).
    """
    robot, tasks, asked = checked_levels(robot, levels, "r̈")
    q, qdot = robot.configuration(q), moderate("qdot", velocity_of_joints(robot, "qdot", qdot))
    low, high = acceleration_limits(robot, qdot, limits, lower, max_velocity, step)
    rows = [
        (task.jacobian(robot, q), b, jacobian_rate(robot, task, q, qdot) @ qdot)
        for task, b in zip(tasks, asked, strict=True)
    ]
    return _resolved(rows, low, high, levels_within(rows, low, high, least_squares=True))


def _words(s: float) -> str:
    if np.isnan(s):
        return "no scale realises it"
    return "realised" if s == 1 else f"slowed down to {s:.6g}"


def _resolved(
    rows: Sequence[BoundedLevel], low: Array, high: Array, found: tuple[Array, tuple[float, ...]]
) -> SaturatedPriorities:
    x, scales = found
    at = (np.abs(x - low) <= 1e-9) | (np.abs(x - high) <= 1e-9)
    return SaturatedPriorities(x, scales, at, low, high, tuple(b - d - A @ x for A, b, d in rows))
