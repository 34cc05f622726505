"""Why a law makes the error small: a Lyapunov function of the gradient and of the Newton law, and its rate."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.control.gain_matrix import gain_matrix
from robotics1.control.laws import METHODS, Method
from robotics1.inputs import Array, one_of
from robotics1.least_squares import RANK_TOLERANCE, generalized_inverse, rank_of
from robotics1.results import Frozen
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.rows import unitless_factors


class LyapunovStatus(Enum):
    """What V̇ says."""

    DECREASES = "V decreases"
    AT_TARGET = "the error is zero"
    STUCK = "V̇ = 0 with an error: Kᵀe, or e, is in the null space of Jᵀ, and the law stands still"


@dataclass(frozen=True, eq=False)
class LyapunovRate(Frozen):
    """A Lyapunov function V(e) ≥ 0 and its rate along a law, for a target at rest.

    Attributes:
        value: V.
        rate: V̇ = −eᵀ K J q̇ of the gradient law, −eᵀ J q̇ of the Newton law.
        qdot: (n,) what the law commands.
        error: (m,) e = r_d − f(q).
        status: whether V decreases.
        method: "gradient" or "newton".
    """

    value: float
    rate: float
    qdot: Array
    error: Array
    status: LyapunovStatus
    method: str

    def explain(self) -> str:
        """Return V and V̇ with their formulas and numbers, in a sentence."""
        formulas = {
            "gradient": "q̇ = Jᵀ K e: V = ½ eᵀ K e, V̇ = −|Jᵀ K e|²",
            "newton": "q̇ = J⁺ K e: V = ½ eᵀ e, V̇ = −eᵀ J J⁺ K e, which is −eᵀ K e where J has full row rank",
        }
        return f"{formulas[self.method]}; V = {self.value:.6g}, V̇ = {self.rate:.6g}: {self.status.value}"


def lyapunov_rate(
    robot: RobotLike,
    task: TaskLike,
    target: Any,
    q: ConfigurationLike,
    K: npt.ArrayLike = 1.0,
    *,
    method: Method = "gradient",
) -> LyapunovRate:
    """Return V and V̇ at q for a target at rest.

    Of the gradient law q̇ = Jᵀ K e: V = ½ eᵀ K e and V̇ = −eᵀ K J Jᵀ K e = −|Jᵀ K e|² ≤ 0, which vanishes at the target
    and where K e is in N(Jᵀ), at singularities. Of the Newton law q̇ = J⁺ K e: V = ½ eᵀ e and V̇ = −eᵀ K e < 0 where J
    has full row rank.

    Args:
        robot: the robot.
        task: r = f(q), whose error is a difference of numbers.
        target: r_d.
        q: (nq,) configuration [rad or m].
        K: gains, one number, (m,) or (m, m), positive definite; symmetric for the gradient law.
        method: "gradient" or "newton".

    Raises:
        InputError: the gains are not positive definite, or a shape is wrong.
        TaskError: the task does not fit the robot.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.2.
    """
    robot, task = robot_and_task(robot, task)
    law = one_of("method", method, METHODS)
    gain: Array = gain_matrix("K", K, task.rows, symmetric=law == "gradient")
    e, J = task.error(robot, q, target), task.jacobian(robot, q)
    weight = gain @ e if law == "gradient" else e
    inverse = generalized_inverse(J, rank=rank_of(J, unitless_factors(robot, task)))
    qdot = np.asarray(J.T @ gain @ e) if law == "gradient" else inverse.solve(gain @ e)
    value = 0.5 * float(e @ weight)
    rate = -float(weight @ J @ qdot)
    inside = J @ inverse.solve(gain @ e)
    if not e.any():
        status = LyapunovStatus.AT_TARGET
    elif np.linalg.norm(inside) <= RANK_TOLERANCE * np.linalg.norm(gain @ e):
        status = LyapunovStatus.STUCK
    else:
        status = LyapunovStatus.DECREASES
    return LyapunovRate(value, rate, qdot, e, status, law)
