"""Several tasks by priority with joint rates, or accelerations, within their limits, at one state."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.redundancy.given_levels import AskedLevels, asked_levels
from robotics1.redundancy.rate_limits import acceleration_limits, at_limits, limits_of
from robotics1.redundancy.rates_within_digits import rates_within_digits, with_singularity
from robotics1.redundancy.within_bounds import BoundedLevel, levels_within
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.singularities.rounding import RoundedConfiguration
from robotics1.tasks.given import TaskLike

REALISED = 1e-7  # of what is asked: a residual that is rounding


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
        realised: of each level, whether all of it is realised, as far as the given digits tell.
        rounded: q with its printed digits, where a singular configuration rounds to it; else None.
        at_singularity: the answer at that configuration; else None.
    """

    joints: Array
    scales: tuple[float, ...]
    saturated: npt.NDArray[np.bool_]
    lower: Array
    upper: Array
    residuals: tuple[Array, ...]
    realised: tuple[bool, ...]
    rounded: RoundedConfiguration | None = None
    at_singularity: SaturatedPriorities | None = None

    def explain(self) -> str:
        """Return the scale of each level, in a sentence."""
        near = "" if self.rounded is None else f"{self.rounded.explain()}; the answer there is `at_singularity`; "
        levels = enumerate(zip(self.scales, self.realised, strict=True), 1)
        return near + "; ".join(f"level {i}: {_words(s, realised)}" for i, (s, realised) in levels)

    def require(self) -> SaturatedPriorities:
        """Return self if every level is realised.

        Raises:
            NotConverged: one is slowed down, not realised by any scale, or has a part out of the range of its Jacobian,
                or the configuration may be singular.
        """
        return require(self, self.rounded is None and all(self.realised))


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
    asked = asked_levels(robot, levels, "ṙ")
    high = asked.robot.max_velocity if limits is None else limits
    return _resolved(asked, q, limits_of(asked.robot, high, lower))


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
    asked = asked_levels(robot, levels, "r̈", qdot)
    bounds = acceleration_limits(asked, limits, lower, max_velocity, step)
    return _resolved(asked, q, bounds, least_squares=True)


def _words(s: float, realised: bool) -> str:
    if np.isnan(s):
        return "no scale realises it"
    if s < 1:
        return f"slowed down to {s:.6g}"
    return "realised" if realised else "realised but for a part that is not in the range of its Jacobian"


def _resolved(
    levels: AskedLevels, q: ConfigurationLike, bounds: tuple[Array, Array], *, least_squares: bool = False
) -> SaturatedPriorities:
    low, high = bounds

    def at(x: ConfigurationLike) -> SaturatedPriorities:
        rows, meant = levels.rows(levels.robot.configuration(x)), rates_within_digits(levels, x)
        bounded = [BoundedLevel(row.J, b, row.drift, row.scale) for row, b in zip(rows, meant, strict=True)]
        joints, scales = levels_within(bounded, low, high, least_squares=least_squares)
        made = [row.J @ joints + row.drift for row in rows]
        realised = tuple(
            s == 1 and row.size(b - r) <= REALISED * row.size(b, row.drift)
            for s, row, b, r in zip(scales, rows, meant, made, strict=True)
        )
        residuals = tuple(b - r for b, r in zip(levels.asked, made, strict=True))
        return SaturatedPriorities(joints, scales, at_limits(joints, low, high), low, high, residuals, realised)

    return with_singularity(at, levels, q)
