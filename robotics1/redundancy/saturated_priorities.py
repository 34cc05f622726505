"""Several tasks by priority with joint rates within their limits, at one state."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.redundancy.priorities import checked_levels
from robotics1.redundancy.saturation import limits_of
from robotics1.redundancy.within_bounds import levels_within
from robotics1.results import Frozen, require
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

REALISED = 1e-7  # a residual that is rounding, in SI units


@dataclass(frozen=True, eq=False)
class SaturatedPriorities(Frozen):
    """Joint rates of several tasks by priority, within their limits.

    Attributes:
        joints: (nv,) q̇.
        scales: sᵢ of each level, from 0 to 1, of the part in the range of its Jacobian; nan of a level that no scale
            realises, which is left out.
        saturated: (nv,) whether a joint is at a limit.
        lower, upper: (nv,) the limits.
        residuals: of each level, ṙᵢ − Jᵢ q̇.
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
            f"level {i}: " + ("left out" if np.isnan(s) else "realised" if s == 1 else f"slowed down to {s:.6g}")
            for i, s in enumerate(self.scales, 1)
        ]
        return "; ".join(levels)

    def require(self) -> "SaturatedPriorities":
        """Return self if every level is realised.

        Raises:
            NotConverged: one is slowed down, left out, or has a part out of the range of its Jacobian.
        """
        left = max(float(np.abs(residual).max(initial=0.0)) for residual in self.residuals)
        return require(self, all(s == 1 for s in self.scales) and left <= REALISED)


def saturated_priority_velocity(
    robot: Robot,
    levels: Sequence[tuple[Task, npt.ArrayLike]],
    q: npt.ArrayLike,
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
    tasks, rates = checked_levels(robot, levels, "ṙ")
    low, high = limits_of(robot, robot.max_velocity if limits is None else limits, lower)
    jacobians = [task.jacobian(robot, q) for task in tasks]
    x, scales = levels_within([(J, b, 0 * b) for J, b in zip(jacobians, rates, strict=True)], low, high)
    at = (np.abs(x - low) <= 1e-9) | (np.abs(x - high) <= 1e-9)
    left = tuple(rate - J @ x for J, rate in zip(jacobians, rates, strict=True))
    return SaturatedPriorities(x, scales, at, low, high, left)
