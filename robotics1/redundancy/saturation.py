"""Joint rates within their limits: what the task asks is taken over by joints that are not at one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from robotics1.inputs import (
    Array,
    moderate,
    one_of,
    real_array,
)
from robotics1.kinematics import velocity_of_joints
from robotics1.least_squares import RANK_TOLERANCE
from robotics1.redundancy.null_saturation import Saturated, SaturationStep, saturate_step_by_step
from robotics1.redundancy.rate_limits import acceleration_limits, at_limits, limits_of
from robotics1.redundancy.rates_within_digits import RowsAt, rates_within_digits, singularity_of_levels
from robotics1.redundancy.within_bounds import largest_scale_within
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.singularities.rounding import RoundedConfiguration
from robotics1.singularities.spaces import subspaces
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.trajectories.following.task_rates import jacobian_rate

Method = Literal["optimal", "sns", "scaled"]
METHODS: tuple[Method, ...] = get_args(Method)


class SaturationStatus(Enum):
    """What the limits leave of the task."""

    WITHIN_LIMITS = "realised, and the least norm is within the limits"
    SATURATED = "realised, with joints at their limits"
    SCALED = "only a part can be realised within the limits: the task is slowed down"
    OUT_OF_RANGE = "not in the range of the Jacobian: a part of it cannot be realised"


@dataclass(frozen=True, eq=False)
class SaturatedMotion(Frozen):
    """Joint rates with J q̇ = s ṙ, or accelerations with J q̈ + J̇q̇ = s r̈, within their limits.

    Attributes:
        joints: (nv,) q̇ or q̈.
        scale: s, from 0 to 1.
        status: what the limits leave of the task.
        saturated: (nv,) whether a joint is at a limit.
        lower, upper: (nv,) the limits.
        residual: (m,) what of the task is not realised.
        method: "optimal", "sns" or "scaled".
        within_digits: whether the task is in the range of the Jacobian only as far as the given digits tell: a part of
            the residual is their rounding.
        steps: of the algorithm, with method "sns".
        rounded: q with its printed digits, where a singular configuration rounds to it; else None.
        at_singularity: the answer at that configuration; else None.
    """

    joints: Array
    scale: float
    status: SaturationStatus
    saturated: npt.NDArray[np.bool_]
    lower: Array
    upper: Array
    residual: Array
    method: str
    within_digits: bool = False
    steps: tuple[SaturationStep, ...] = ()
    rounded: RoundedConfiguration | None = None
    at_singularity: SaturatedMotion | None = None

    def explain(self) -> str:
        """Return the status with the scale and the joints at their limits, in a sentence."""
        near = "" if self.rounded is None else f"{self.rounded.explain()}; the answer there is `at_singularity`; "
        at = [f"{i + 1}" for i in np.flatnonzero(self.saturated)]
        where = f"; at a limit: joint {', '.join(at)}" if at else ""
        digits = "; what is left is not more than the rounding of the given digits" if self.within_digits else ""
        return f"{near}{self.status.value}; s = {self.scale:.6g}{where}{digits}"

    def require(self) -> SaturatedMotion:
        """Return self if the whole task is realised.

        Raises:
            NotConverged: it is slowed down, or out of range, or the configuration may be singular.
        """
        return require(
            self, self.rounded is None and self.status in (SaturationStatus.WITHIN_LIMITS, SaturationStatus.SATURATED)
        )


def saturated_velocity(
    robot: RobotLike,
    task: TaskLike,
    rdot: npt.ArrayLike,
    q: ConfigurationLike,
    *,
    limits: npt.ArrayLike | None = None,
    lower: npt.ArrayLike | None = None,
    method: Method = "optimal",
) -> SaturatedMotion:
    """Return joint velocities within their limits with J q̇ = s ṙ, for the largest s ≤ 1 that they allow.

    =========  ==================================================================================================
    method     q̇
    =========  ==================================================================================================
    "optimal"  of all q̇ within the limits with the largest s the shortest: a linear and a quadratic program
    "sns"      saturation in the null space: the most critical joint is held at its limit, the others take over,
               until all are within; quick and taught, but its s may be smaller, and its q̇ longer
    "scaled"   s J⁺ṙ: the least norm slowed down, without use of the null space
    =========  ==================================================================================================

    Args:
        robot: the robot.
        task: r = f(q).
        rdot: (m,) ṙ.
        q: (nq,) configuration [rad or m].
        limits: (nv,) the largest q̇ of each joint, or one number; None for the robot's. ∞ is no limit.
        lower: (nv,) the least q̇, where it is not −limits; not above 0, as `limits` are not below 0.
        method: one of those above.

    Raises:
        InputError: a shape is wrong, or zero is not within the limits.
        TaskError: the task does not fit the robot.

    Source: Flacco, De Luca, Khatib, Motion control of redundant robots under joint constraints: saturation in the null
    space, ICRA 2012; Flacco, De Luca, Fast redundancy resolution for high-dimensional robots executing prioritized
    tasks under hard bounds in the joint space, IROS 2013 (the quadratic program that it solves).
    """
    robot, task = robot_and_task(robot, task)
    rdot = real_array("rdot", rdot, (task.rows,), "one number for each row of J")
    low, high = limits_of(robot, robot.max_velocity if limits is None else limits, lower)

    def rows_at(near: Array) -> list[tuple[Array, Array]]:
        return [(task.jacobian(robot, near), np.zeros(task.rows))]

    return _solved(robot, rows_at, rdot, q, (low, high), one_of("method", method, METHODS))


def saturated_acceleration(
    robot: RobotLike,
    task: TaskLike,
    rddot: npt.ArrayLike,
    q: ConfigurationLike,
    qdot: npt.ArrayLike,
    *,
    limits: npt.ArrayLike,
    lower: npt.ArrayLike | None = None,
    max_velocity: npt.ArrayLike | None = None,
    step: float | None = None,
    method: Method = "optimal",
) -> SaturatedMotion:
    """Return joint accelerations within their limits with J q̈ = s r̈ − J̇ q̇, for the largest s ≤ 1 that they allow.

    The drift J̇ q̇ is not scaled: where even s = 0 cannot hold it, the status is SCALED with s = 0 and a residual, and
    q̈ is the least squares solution of the bounds.

    Args:
        robot: the robot.
        task: r = f(q).
        rddot: (m,) r̈.
        q: (nq,) configuration [rad or m].
        qdot: (nv,) q̇ [rad/s or m/s].
        limits: (nv,) the largest q̈ of each joint, or one number.
        lower: (nv,) the least q̈, where it is not −limits.
        max_velocity: (nv,) V, or one number: after the step |q̇ + q̈ h| ≤ V. A joint that cannot be back within V in one
            step brakes as much as its limits allow.
        step: h > 0 [s], for how long q̈ is held; with max_velocity.
        method: as `saturated_velocity` has it.

    Raises:
        InputError, TaskError: as `saturated_velocity`.

    Source: Flacco, De Luca, Khatib, Control of redundant robots under hard joint constraints: saturation in the null
    space, IEEE Trans. Robotics 31, 2015.
    """
    robot, task = robot_and_task(robot, task)
    rddot = real_array("rddot", rddot, (task.rows,), "one number for each row of J")
    speed = moderate("qdot", velocity_of_joints(robot, "qdot", qdot))
    low, high = acceleration_limits(robot, speed, limits, lower, max_velocity, step)

    def rows_at(near: Array) -> list[tuple[Array, Array]]:
        return [(task.jacobian(robot, near), jacobian_rate(robot, task, near, speed) @ speed)]

    return _solved(robot, rows_at, rddot, q, (low, high), one_of("method", method, METHODS))


def _solved(
    robot: Robot, rows_at: RowsAt, asked: Array, q: ConfigurationLike, bounds: tuple[Array, Array], method: str
) -> SaturatedMotion:
    def at(x: ConfigurationLike) -> SaturatedMotion:
        (meant,), ((J, drift),) = rates_within_digits(robot, rows_at, [asked], x), rows_at(robot.configuration(x))
        return _resolved(J, (asked, meant), drift, *bounds, method)

    answer, rounded = at(q), singularity_of_levels(robot, rows_at, q)
    if rounded is None or rounded.singular_q is None:
        return answer
    return replace(answer, rounded=rounded, at_singularity=at(rounded.singular_q))


def _resolved(
    J: Array, asked_meant: tuple[Array, Array], drift: Array, low: Array, high: Array, method: str
) -> SaturatedMotion:
    asked, meant = asked_meant
    spaces = subspaces(J)
    out = spaces.unrealisable(meant - drift)
    reachable = np.linalg.norm(out) <= RANK_TOLERANCE * (np.linalg.norm(asked) + np.linalg.norm(drift))
    b, c = asked - spaces.unrealisable(asked), drift - spaces.unrealisable(drift)
    found = _within_limits(J, b, c, low, high, method)
    x, s = found.x, found.scale
    shortest = np.linalg.pinv(J, rcond=RANK_TOLERANCE) @ (b - c)
    if not reachable:
        status = SaturationStatus.OUT_OF_RANGE
    elif s < 1:
        status = SaturationStatus.SCALED
    else:
        plain = np.allclose(x, shortest, rtol=0, atol=1e-9 * float(np.abs(x).max(initial=0.0)))
        status = SaturationStatus.WITHIN_LIMITS if plain else SaturationStatus.SATURATED
    at, left, by_digits = at_limits(x, low, high), asked - drift - J @ x, bool((meant != asked).any())
    return SaturatedMotion(x, s, status, at, low, high, left, method, by_digits, found.steps)


def _within_limits(J: Array, b: Array, drift: Array, low: Array, high: Array, method: str) -> Saturated:
    """Return x with J x = s b − drift."""
    n = J.shape[1]
    shift = -np.linalg.pinv(J, rcond=RANK_TOLERANCE) @ drift  # x = shift + y with J y = s b
    if method == "sns":
        found = saturate_step_by_step(J, b, low - shift, high - shift)
        return Saturated(np.clip(found.x + shift, low, high), found.scale, found.steps)
    if method == "scaled":
        y = np.linalg.pinv(J, rcond=RANK_TOLERANCE) @ b
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = np.where(y > 0, (high - shift) / y, np.where(y < 0, (low - shift) / y, np.inf))
        s = float(np.clip(ends.min(initial=1.0), 0.0, 1.0))
        return Saturated(np.clip(s * y + shift, low, high), s)
    s, found_x = largest_scale_within(J, -drift, b, low, high)
    if found_x is not None:
        return Saturated(found_x, s)
    from scipy.optimize import lsq_linear

    if not n:
        return Saturated(np.zeros(0), 0.0)
    wide = np.where(high > low, high, low + 1e-12)
    return Saturated(np.clip(lsq_linear(J, -drift, bounds=(low, wide), method="bvls").x, low, high), 0.0)
