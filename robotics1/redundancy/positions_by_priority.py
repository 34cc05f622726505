"""Inverse kinematics of several tasks by priority: q of the least error of the first, then of the second, and so on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from functools import reduce
from typing import Any

import numpy as np

from robotics1.inputs import Array, counting_number, real_number, true_or_false
from robotics1.notation import count
from robotics1.redundancy.coordinates_within_limits import BoundedJoints
from robotics1.redundancy.descent_by_levels import LevelEnd, Part, descend_by_levels
from robotics1.redundancy.given_levels import level_pairs
from robotics1.results import Frozen, require
from robotics1.robot.findings import random_configurations
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.tasks.given import TaskLike
from robotics1.tasks.task import Task

EQUAL = 1e-6  # of the size of a residual: two starts that end in the same


class PriorityIKStatus(Enum):
    """What becomes of one level of an inverse kinematics by priority."""

    REALISED = "realised"
    LEAST_ERROR = "not realised: no motion that the levels before it allow makes its error smaller"
    NOT_CONVERGED = "not realised: the descent stopped before its error was the least"


@dataclass(frozen=True, eq=False)
class PriorityIKLevel(Frozen):
    """One level of an inverse kinematics by priority.

    Attributes:
        status: what becomes of it.
        error: (m,) r_d − f(q), by forward kinematics at the q of the answer.
        freedom: of how many directions the level had the choice; 0 where the levels before it decide q.
        steps: how many were taken.
    """

    status: PriorityIKStatus
    error: Array
    freedom: int
    steps: int

    @property
    def error_norm(self) -> float:
        """|e|."""
        return float(np.linalg.norm(self.error))


@dataclass(frozen=True, eq=False)
class PriorityIK(Frozen):
    """The configuration of an inverse kinematics by priority.

    Attributes:
        q: (n,) [rad or m].
        levels: what becomes of each, in the order of priority.
        within_limits: whether q is inside the joint limits.
    """

    q: Array
    levels: tuple[PriorityIKLevel, ...]
    within_limits: bool

    @property
    def converged(self) -> bool:
        """Whether each level is realised, or has the least error that the levels before it leave."""
        return all(level.status is not PriorityIKStatus.NOT_CONVERGED for level in self.levels)

    def explain(self) -> str:
        """Return what becomes of each level, in sentences."""
        parts = [
            f"level {i}: {level.status.value}, |e| = {level.error_norm:.3g}, after {count(level.steps, 'step')}"
            for i, level in enumerate(self.levels, 1)
        ]
        return "; ".join(parts) + ("" if self.within_limits else "; outside the joint limits")

    def require(self) -> PriorityIK:
        """Return self if every level is realised.

        Raises:
            NotConverged: one is not.
        """
        return require(self, all(level.status is PriorityIKStatus.REALISED for level in self.levels))


def ik_by_priority(
    robot: RobotLike,
    levels: Sequence[tuple[TaskLike, Any]],
    q0: ConfigurationLike,
    *,
    tolerance: float = 1e-9,
    most_steps: int = 200,
    starts: int = 1,
    limits: bool = True,
) -> PriorityIK:
    """Return q of the least |e₁| within the joint limits, of all such q one of the least |e₂|, and so on.

    eᵢ = r_d,ᵢ − fᵢ(q), and lower ≤ q ≤ upper.

    Level by level the error is made small by steps q + N z, with N of the null space of what the levels before hold:
    eᵢ = 0 where they are realised, else that the gradient Jᵢᵀ eᵢ along the allowed motions is zero. z is that of Gauss
    and Newton, damped until |eᵢ| falls, or of Newton where that is slow; after each step the levels before are brought
    back. So a lower level never makes a higher one worse. The descent ends at the least error near the start: `starts=`
    tries others.

    Args:
        robot: an arm of revolute and prismatic joints.
        levels: pairs (task, target), the most important first.
        q0: (n,) where the descent starts, moved inside the limits [rad or m].
        tolerance: the |e| of a level that is realised.
        most_steps: of each level.
        starts: how many starts are tried: q0, and random ones within the limits; the best answer is returned.
        limits: whether the joint limits bound q; False ignores them.

    Raises:
        InputError: a shape is wrong, there is no level, or a task stands in two of them.
        TaskError: a task does not fit the robot, or its axes move with it.

    Source: Escande, Mansard, Wieber, Hierarchical quadratic programming: fast online humanoid-robot motion generation,
    Int. J. Robotics Research 33, 2014; Baerlocher, Boulic, The Visual Computer 20, 2004; James, Roos, MINUIT,
    Computer Physics Communications 10, 1975 (limits).
    """
    robot = robot_from(robot)
    robot.require_single_coordinates("have an inverse kinematics by priority")
    goals, start = _goals(robot, levels), robot.configuration(q0, "q0")
    zero = real_number("tolerance", tolerance, positive=True)
    steps = counting_number("most_steps", most_steps, least=1, most=100_000)
    number = counting_number("starts", starts, least=1, most=10_000)
    others = random_configurations(robot, number - 1, np.random.default_rng(0))
    parts = [_part(robot, task, target) for task, target in goals]
    kept, none = true_or_false("limits", limits), np.full(robot.nq, np.inf)
    joints = BoundedJoints(robot.lower if kept else -none, robot.upper if kept else none, robot.units)
    found = [
        _answer(robot, goals, descend_by_levels(parts, q, joints, tolerance=zero, most_steps=steps), zero)
        for q in (start, *others)
    ]
    return reduce(lambda best, other: other if _is_better(other, best, zero) else best, found)


def _part(robot: Robot, task: Task, target: Any) -> Part:
    return lambda q: (task.error(robot, q, target), task.jacobian(robot, q))


def _answer(robot: Robot, goals: Sequence[tuple[Task, Any]], ends: Sequence[LevelEnd], tolerance: float) -> PriorityIK:
    """Return what forward kinematics says of the last q."""
    q, found = ends[-1].q, []
    for (task, target), end in zip(goals, ends, strict=True):
        error = task.error(robot, q, target)
        if np.linalg.norm(error) <= tolerance:
            status = PriorityIKStatus.REALISED
        else:
            least = end.stationary and not end.realised
            status = PriorityIKStatus.LEAST_ERROR if least else PriorityIKStatus.NOT_CONVERGED
        found.append(PriorityIKLevel(status, error, end.freedom, end.steps))
    return PriorityIK(q, tuple(found), robot.within_limits(q))


def _is_better(one: PriorityIK, other: PriorityIK, tolerance: float) -> bool:
    """Whether the first level whose errors differ has the smaller one; of equal ones, which is within the limits."""
    for a, b in zip(one.levels, other.levels, strict=True):
        small, large = sorted((a.error_norm, b.error_norm))
        if large > tolerance and large - small > EQUAL * large:
            return a.error_norm < b.error_norm
    return one.within_limits and not other.within_limits


def _goals(robot: Robot, levels: Any) -> list[tuple[Task, Any]]:
    """Return the levels, checked: tasks that the robot has, and targets in the form of their values."""
    pairs = level_pairs(levels, "target")
    for task, _ in pairs:
        task.check_integrable(robot)
    return [(task, task.target(target)) for task, target in pairs]
