"""Task priority: several tasks, the first before the second, at one state."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import Enum
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, moderate, one_of, positive_numbers, real_number
from robotics1.kinematics import velocity_of_joints
from robotics1.least_squares import RANK_TOLERANCE, generalized_inverse
from robotics1.redundancy.given_levels import AskedLevels, LevelRows, asked_levels
from robotics1.redundancy.hierarchy import Hierarchy, Level, by_levels, by_projection
from robotics1.redundancy.rates_within_digits import rates_within_digits, with_singularity
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.singularities.rounding import RoundedConfiguration
from robotics1.tasks.given import TaskLike

Method = Literal["levels", "projection", "stacked"]
METHODS: tuple[Method, ...] = get_args(Method)


class LevelStatus(Enum):
    """What becomes of one level."""

    REALISED = "realised"
    REALISED_WITHIN_DIGITS = "realised to the digits that are given: what is left is not more than their rounding"
    IN_CONFLICT = "not realised: the levels before it leave too little freedom"
    OUT_OF_RANGE = "not realised: it is not in the range of the task's Jacobian"
    NOT_MET = "not realised by this method, although it could be"


@dataclass(frozen=True, eq=False)
class LevelOutcome(Frozen):
    """One level of a task priority.

    Attributes:
        status: whether its rate is realised.
        asked: (m,) ṙ, or r̈.
        residual: (m,) what of it is not realised.
        rank: of its Jacobian J.
        free_rank: of J N, with the null space N of the levels before: less than the rank where they are in conflict
            (an algorithmic singularity).
    """

    status: LevelStatus
    asked: Array
    residual: Array
    rank: int
    free_rank: int

    @property
    def is_realised(self) -> bool:
        """Whether the rate is realised, or what is left of it is not more than the rounding of the given digits."""
        return self.status in (LevelStatus.REALISED, LevelStatus.REALISED_WITHIN_DIGITS)

    @property
    def is_algorithmic_singularity(self) -> bool:
        """Whether the levels before take a part of what the task could do alone."""
        return self.free_rank < self.rank


@dataclass(frozen=True, eq=False)
class Priorities(Frozen):
    """The joint velocities, or accelerations, of several tasks by priority.

    Attributes:
        joints: (nv,) q̇ [rad/s or m/s], or q̈ [rad/s² or m/s²].
        levels: what becomes of each, in the order of priority.
        null: (nv, k) orthonormal columns: motions that no level sees.
        method: "levels", "projection" or "stacked".
        rounded: q with its printed digits, where a singular configuration rounds to it; else None.
        at_singularity: the answer at that configuration; else None.
    """

    joints: Array
    levels: tuple[LevelOutcome, ...]
    null: Array
    method: str
    rounded: RoundedConfiguration | None = None
    at_singularity: Priorities | None = None

    def explain(self) -> str:
        """Return what becomes of each level, in sentences."""
        parts = [] if self.rounded is None else [f"{self.rounded.explain()}; the answer there is `at_singularity`"]
        for number, level in enumerate(self.levels, 1):
            size = float(np.linalg.norm(level.residual))
            rest = "" if level.is_realised else f" (|residual| = {size:.6g})"
            parts.append(f"level {number}: {level.status.value}{rest}")
        return "; ".join(parts)

    def require(self) -> Priorities:
        """Return self if every level is realised.

        Raises:
            NotConverged: one is not, or the configuration may be singular.
        """
        return require(self, self.rounded is None and all(level.is_realised for level in self.levels))


def priority_velocity(
    robot: RobotLike,
    levels: Sequence[tuple[TaskLike, npt.ArrayLike]],
    q: ConfigurationLike,
    *,
    method: Method = "levels",
    null_velocity: npt.ArrayLike | None = None,
    damping: float = 0.0,
    weights: npt.ArrayLike | None = None,
) -> Priorities:
    """Return the joint velocities of several tasks by priority: each as well as those before it allow.

    - "levels": q̇ᵢ = q̇ᵢ₋₁ + (Jᵢ Pᵢ₋₁)⁺ (ṙᵢ − Jᵢ q̇ᵢ₋₁), of all q̇ that do the best for the levels before those with the
      least error of level i.
    - "projection": J₁⁺ ṙ₁ + P₁ J₂⁺ ṙ₂ + P₂ J₃⁺ ṙ₃ + ..., bounded where levels are in conflict; lower levels are met in
      part only.
    - "stacked": [J₁; J₂; ...]⁺ (ṙ₁, ṙ₂, ...), no priority: the least sum of wᵢ (ṙᵢ − Jᵢ q̇)².

    Pᵢ is the projector into the null space of the augmented Jacobian [J₁; ...; Jᵢ]; a null velocity is projected there.

    Args:
        robot: the robot.
        levels: pairs (task, ṙ), the most important first; ṙ has one number for each row of the task.
        q: (nq,) configuration [rad or m].
        method: one of those above.
        null_velocity: (nv,) q̇₀, whose part that no level sees is added.
        damping: λ of the inverses of "levels" after the first: near an algorithmic singularity q̇ stays bounded.
        weights: of "stacked", wᵢ > 0 of each task; None for 1. They matter where not all can be realised.

    Raises:
        InputError: there is no level, a task stands in two of them, a shape is wrong, or damping is given to a method
            that has none.
        TaskError: a task does not fit the robot.

    Source: Nakamura, Hanafusa, Yoshikawa, Int. J. Robotics Research 6, 1987; Siciliano, Slotine, ICAR 1991
    ("levels"); Chiaverini, IEEE Trans. Robotics and Automation 13, 1997 ("projection").
    """
    return _solved(asked_levels(robot, levels, "ṙ"), q, method, null_velocity, damping, weights)


def priority_acceleration(
    robot: RobotLike,
    levels: Sequence[tuple[TaskLike, npt.ArrayLike]],
    q: ConfigurationLike,
    qdot: npt.ArrayLike,
    *,
    method: Method = "levels",
    null_acceleration: npt.ArrayLike | None = None,
    damping: float = 0.0,
) -> Priorities:
    """Return the joint accelerations of several tasks by priority: as `priority_velocity`, with r̈ᵢ − J̇ᵢ q̇ for ṙᵢ.

    The null space of accelerations is not that of velocities: a null acceleration such as −k q̇ stops self-motions,
    which the tasks do not see and which else go on.

    Args:
        robot: the robot.
        levels: pairs (task, r̈), the most important first.
        q: (nq,) configuration [rad or m].
        qdot: (nv,) q̇ [rad/s or m/s].
        method: as `priority_velocity` has it.
        null_acceleration: (nv,) q̈₀, whose part that no level sees is added.
        damping: as `priority_velocity` has it.

    Raises:
        InputError, TaskError: as `priority_velocity`.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.4 (second order).
    """
    return _solved(asked_levels(robot, levels, "r̈", qdot), q, method, null_acceleration, damping)


def _solved(
    levels: AskedLevels, q: ConfigurationLike, method: str, wish: Any, damping: float, weights: Any = None
) -> Priorities:
    robot, asked = levels.robot, levels.asked
    solve = _solver(one_of("method", method, METHODS), len(asked), robot.nv, damping, weights)
    extra = None if wish is None else moderate("the null motion", velocity_of_joints(robot, "the null motion", wish))

    def at(x: ConfigurationLike) -> Priorities:
        rows = levels.rows(robot.configuration(x))
        found = solve([row.equation(b) for row, b in zip(rows, asked, strict=True)])
        joints = found.x if extra is None else found.x + found.null @ (found.null.T @ extra)
        return Priorities(joints, _outcomes(rows, asked, rates_within_digits(levels, x), joints), found.null, method)

    return with_singularity(at, levels, q)


def _solver(method: str, number: int, n: int, damping: float, weights: Any) -> Callable[[Sequence[Level]], Hierarchy]:
    """Return what solves the levels by a method.

    Raises:
        InputError: the damping or the weights belong to another method.
    """
    soft = real_number("damping", damping, non_negative=True)
    if soft and method != "levels":
        raise InputError(f"damping belongs to method='levels'; the method is {method!r}")
    if weights is not None and method != "stacked":
        raise InputError(f"weights belong to method='stacked', which has no priorities; the method is {method!r}")
    if method == "levels":
        return lambda rows: by_levels(rows, n, damping=soft)
    if method == "projection":
        return lambda rows: by_projection(rows, n)
    w = np.sqrt(np.ones(number) if weights is None else positive_numbers("weights", weights, number))

    def stacked(rows: Sequence[Level]) -> Hierarchy:
        A, b = (np.concatenate([x * row[i] for x, row in zip(w, rows, strict=True)]) for i in (0, 1))
        return by_levels([(A, b, np.vstack([scale for _, _, scale in rows]))], n)

    return stacked


def _outcomes(
    rows: Sequence[LevelRows], asked: Sequence[Array], meant: Sequence[Array], x: Array
) -> tuple[LevelOutcome, ...]:
    """Return what becomes of each level with x, `meant` being what the digits of what is asked mean."""
    exact = by_levels([row.equation(b) for row, b in zip(rows, asked, strict=True)], len(x))
    outcomes = []
    for i, row in enumerate(rows):
        J, left = row.J, asked[i] - row.drift - row.J @ x
        rounding = RANK_TOLERANCE * row.size(asked[i], row.drift)
        if row.size(left) <= 10 * rounding:
            status = LevelStatus.REALISED
        else:
            b = meant[i] - row.drift
            alone = b - J @ generalized_inverse(J, rank=exact.ranks[i]).solve(b)
            status = _status(row.size(alone), row.size(b - J @ exact.x), row.size(b - J @ x), rounding)
        outcomes.append(LevelOutcome(status, asked[i], left, exact.ranks[i], exact.free_ranks[i]))
    return tuple(outcomes)


def _status(alone: float, at_best: float, left: float, rounding: float) -> LevelStatus:
    """Return the status from the sizes of residuals: without other levels, by priority, and of the method."""
    if left <= 10 * rounding:
        return LevelStatus.REALISED_WITHIN_DIGITS
    if alone > rounding:
        return LevelStatus.OUT_OF_RANGE
    return LevelStatus.IN_CONFLICT if at_best > 10 * rounding else LevelStatus.NOT_MET
