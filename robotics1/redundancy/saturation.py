"""Joint rates within their limits: what the task asks is taken over by joints that are not at one."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, one_of
from robotics1.least_squares import RANK_TOLERANCE, GeneralizedInverse, generalized_inverse, rank_of
from robotics1.redundancy.given_levels import AskedLevels, LevelRows, asked_of_one
from robotics1.redundancy.null_saturation import Saturated, SaturationStep, saturate_step_by_step
from robotics1.redundancy.rate_limits import acceleration_limits, at_limits, limits_of
from robotics1.redundancy.rates_within_digits import rates_within_digits, with_singularity
from robotics1.redundancy.within_bounds import largest_scale_within
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.singularities.rounding import RoundedConfiguration
from robotics1.tasks.given import TaskLike, robot_and_task

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
    asked = asked_of_one(robot, task, "rdot", rdot)
    bounds = limits_of(robot, robot.max_velocity if limits is None else limits, lower)
    return _solved(asked, q, bounds, one_of("method", method, METHODS))


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
    asked = asked_of_one(robot, task, "rddot", rddot, qdot)
    bounds = acceleration_limits(asked, limits, lower, max_velocity, step)
    return _solved(asked, q, bounds, one_of("method", method, METHODS))


def _solved(levels: AskedLevels, q: ConfigurationLike, bounds: tuple[Array, Array], method: str) -> SaturatedMotion:
    def at(x: ConfigurationLike) -> SaturatedMotion:
        (rows,), (meant,) = levels.rows(levels.robot.configuration(x)), rates_within_digits(levels, x)
        return _resolved(rows, (levels.asked[0], meant), *bounds, method)

    return with_singularity(at, levels, q)


def _resolved(
    rows: LevelRows, asked_meant: tuple[Array, Array], low: Array, high: Array, method: str
) -> SaturatedMotion:
    J, drift, (asked, meant) = rows.J, rows.drift, asked_meant
    inverse = generalized_inverse(J, rank=rank_of(J, rows.scale))

    def inside(b: Array) -> Array:
        return np.asarray(b - inverse.left_null @ (inverse.left_null.T @ b))

    reachable = rows.size(meant - drift - inside(meant - drift)) <= RANK_TOLERANCE * rows.size(asked, drift)
    b, c = inside(asked), inside(drift)
    found = _within_limits(rows._replace(drift=c), inverse, b, low, high, method)
    x, s = found.x, found.scale
    if not reachable:
        status = SaturationStatus.OUT_OF_RANGE
    elif s < 1:
        status = SaturationStatus.SCALED
    else:
        plain = np.allclose(x, inverse.solve(b - c), rtol=0, atol=1e-9 * float(np.abs(x).max(initial=0.0)))
        status = SaturationStatus.WITHIN_LIMITS if plain else SaturationStatus.SATURATED
    residual, by_digits = asked - drift - J @ x, bool((meant != asked).any())
    return SaturatedMotion(x, s, status, at_limits(x, low, high), low, high, residual, method, by_digits, found.steps)


def _within_limits(
    rows: LevelRows, inverse: GeneralizedInverse, b: Array, low: Array, high: Array, method: str
) -> Saturated:
    """Return x with J x = s b − drift."""
    J, drift, scale, _ = rows
    shift = -inverse.solve(drift)  # x = shift + y with J y = s b
    if method == "sns":
        found = saturate_step_by_step(J, b, low - shift, high - shift, scale)
        return Saturated(np.clip(found.x + shift, low, high), found.scale, found.steps)
    if method == "scaled":
        y = inverse.solve(b)
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = np.where(y > 0, (high - shift) / y, np.where(y < 0, (low - shift) / y, np.inf))
        s = float(np.clip(ends.min(initial=1.0), 0.0, 1.0))
        return Saturated(np.clip(s * y + shift, low, high), s)
    s, found_x = largest_scale_within(J, -drift, b, low, high, scale)
    if found_x is not None:
        return Saturated(found_x, s)
    from scipy.optimize import lsq_linear

    if not len(low):
        return Saturated(np.zeros(0), 0.0)
    wide = np.where(high > low, high, low + 1e-12)
    return Saturated(np.clip(lsq_linear(J, -drift, bounds=(low, wide), method="bvls").x, low, high), 0.0)
