"""Inverse differential kinematics at one state: q̇ from ṙ, and q̈ from r̈, with what cannot be realised."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Any, Self, TypeVar

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, real_array
from robotics1.least_squares import RANK_TOLERANCE, generalized_inverse
from robotics1.printed_digits import shared_half_units
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.singularities.rounding import RoundedConfiguration, rounded_configuration
from robotics1.singularities.spaces import subspaces_without_units
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import Task
from robotics1.trajectories.following.open_digits import realised_within_digits
from robotics1.trajectories.following.resolution import (
    Rates,
    Resolution,
    Wish,
    drifts,
    resolution_or_default,
    resolved,
)

NEAR = 1e-2  # σ_min/σ_max: below, joint velocities become large


class RateStatus(Enum):
    """Whether what is asked of the task is realised."""

    REALISED = "realised"
    REALISED_ALL_THE_SAME = "realised, although the Jacobian has lost rank: what is asked is in its range"
    DAMPED = "in the range of the Jacobian, but the damping leaves a part of it"
    REALISED_WITHIN_DIGITS = "realised to the digits that are given: what is left is not more than their rounding"
    OUT_OF_RANGE = "not in the range of the Jacobian: a part of it cannot be realised"
    NEARLY_SINGULAR = "nearly singular: with the digits it is given by, the configuration may be singular"


@dataclass(frozen=True, eq=False)
class Resolved(Frozen):
    """The inputs u that realise b = A u best.

    Attributes:
        inputs: (k,) u; the joint velocities or accelerations themselves unless there is an input matrix.
        realised: (m,) A u.
        residual: (m,) b − A u: what is not realised.
        unrealisable: (m,) the part of b outside the range of A, which no inputs realise; zero where there is none.
        singular_values: of A, descending.
        relative_sigma: σ_min/σ_max of A without units, its metres divided by the reach of the robot.
        rank: of A.
        damping: the λ that was used.
        status: whether b is realised; NEARLY_SINGULAR where a singularity is within the rounding of q.
        rounded: q with its printed digits, and the singular configuration within them.
    """

    inputs: Array
    realised: Array
    residual: Array
    unrealisable: Array
    singular_values: Array
    relative_sigma: float
    rank: int
    damping: float
    status: RateStatus
    rounded: RoundedConfiguration = field(kw_only=True)

    @property
    def feasible(self) -> bool:
        """Whether b is in the range of A, as far as its digits and those of q tell, so that some inputs realise it."""
        return not self.unrealisable.any()

    @property
    def near_singular(self) -> bool:
        """Whether the rank is lost, or σ_min ≤ 0.01 σ_max, without units."""
        return self.relative_sigma <= NEAR

    def explain(self) -> str:
        """Return the status with its numbers, in a sentence."""
        if self.status is RateStatus.NEARLY_SINGULAR:
            return f"{self.rounded.explain()}; the answer there is `at_singularity`"
        rank = f"rank {self.rank} of {min(len(self.realised), len(self.inputs))}"
        near = ""
        if self.near_singular and self.relative_sigma > 0:
            near = f", near a singularity: σ_min/σ_max = {self.relative_sigma:.2g}"
        left = float(np.linalg.norm(self.residual))
        rest = "" if self.status.name.startswith("REALISED") else f"; |residual| = {left:.6g}"
        return f"{self.status.value} ({rank}{near}{rest})"

    def require(self) -> Self:
        """Return self if b is realised.

        Raises:
            NotConverged: a part of it is not, or the configuration may be singular.
        """
        return require(self, self.status.name.startswith("REALISED"))


@dataclass(frozen=True, eq=False)
class JointVelocity(Resolved):
    """The joint velocities for a task velocity.

    Attributes:
        qdot: (nv,) q̇ = G u [rad/s or m/s].
        at_singularity: the answer at the singular configuration within the rounding of q; None where there is none.
    """

    qdot: Array
    at_singularity: JointVelocity | None = None


@dataclass(frozen=True, eq=False)
class JointAcceleration(Resolved):
    """The joint accelerations for a task acceleration.

    Attributes:
        qddot: (nv,) q̈ = G u̇ + Ġ u [rad/s² or m/s²].
        drift: (m,) J̇ q̇, or with an input matrix d(J G)/dt u: the task acceleration when the inputs are steady.
        at_singularity: the answer at the singular configuration within the rounding of q; None where there is none.
    """

    qddot: Array
    drift: Array
    at_singularity: JointAcceleration | None = None


AnyRates = TypeVar("AnyRates", JointVelocity, JointAcceleration)


def joint_velocity(
    robot: RobotLike,
    task: TaskLike,
    rdot: npt.ArrayLike,
    q: ConfigurationLike,
    *,
    resolution: Resolution | None = None,
    null_velocity: npt.ArrayLike | None = None,
) -> JointVelocity:
    """Return the joint velocities q̇ = J# ṙ + (1 − J⁺J) q̇₀ for a task velocity, and what of it is not realised.

    Args:
        robot: the robot.
        task: r = f(q).
        rdot: (m,) ṙ, one number for each row of J.
        q: (nq,) configuration [rad or m].
        resolution: which inverse J# is taken, and what the inputs are; by default the pseudoinverse.
        null_velocity: (nv,) q̇₀, or (k,) of inputs; its part that does not move the task is added.

    Raises:
        InputError: a shape is wrong.
        TaskError: the task does not fit the robot.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.5.
    """
    robot, task = robot_and_task(robot, task)
    chosen = resolution_or_default(resolution)
    rdot = real_array("rdot", rdot, (task.rows,), "one number for each row of J")

    def made(rates: Rates, outcome: dict[str, Any]) -> JointVelocity:
        return JointVelocity(**outcome, qdot=rates.joints)

    return _at_the_given_digits(robot, task, chosen, q, None, (rdot, null_velocity), made)


def joint_acceleration(
    robot: RobotLike,
    task: TaskLike,
    rddot: npt.ArrayLike,
    q: ConfigurationLike,
    qdot: npt.ArrayLike,
    *,
    resolution: Resolution | None = None,
    null_acceleration: npt.ArrayLike | None = None,
) -> JointAcceleration:
    """Return the joint accelerations q̈ = J# (r̈ − J̇ q̇) + (1 − J⁺J) q̈₀ for a task acceleration, and what is not realised.

    With an input matrix G(q): u̇ = (J G)# (r̈ − d(J G)/dt u) + …, and q̈ = G u̇ + Ġ u.

    Args:
        robot: the robot.
        task: r = f(q).
        rddot: (m,) r̈, one number for each row of J.
        q: (nq,) configuration [rad or m].
        qdot: (nv,) q̇ [rad/s or m/s]; with an input matrix (k,), the inputs u.
        resolution: which inverse J# is taken, and what the inputs are; by default the pseudoinverse.
        null_acceleration: (nv,) q̈₀, or (k,) of inputs; its part that does not accelerate the task is added.

    Raises:
        InputError: a shape is wrong.
        TaskError: the task does not fit the robot.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.4.
    """
    robot, task = robot_and_task(robot, task)
    chosen = resolution_or_default(resolution)
    rddot = real_array("rddot", rddot, (task.rows,), "one number for each row of J")

    def made(rates: Rates, outcome: dict[str, Any]) -> JointAcceleration:
        return JointAcceleration(**outcome, qddot=rates.joints, drift=rates.drift)

    return _at_the_given_digits(robot, task, chosen, q, qdot, (rddot, null_acceleration), made)


def _at_the_given_digits(
    robot: Robot,
    task: Task,
    resolution: Resolution,
    q: ConfigurationLike,
    qdot: npt.ArrayLike | None,
    asked_wish: tuple[Array, Wish],
    made: Callable[[Rates, dict[str, Any]], AnyRates],
) -> AnyRates:
    """Return what is made of the rates at q; with it that at the singular configuration that rounds to q, if there is.

    Without q̇ a velocity is asked, else an acceleration.
    """
    asked, wish = asked_wish
    k = resolution.inputs(robot, robot.configuration(q)).shape[1]
    u = None if qdot is None else real_array("qdot", qdot, (k,), "one number for each joint, or each input")
    scale = resolution.scale(robot, task, k)
    rounded = rounded_configuration(lambda x: task.jacobian(robot, x) @ resolution.inputs(robot, x), robot, q, scale)

    def at(x: Array) -> AnyRates:
        rates = resolved(robot, task, resolution, x, asked, wish, u=u)

        def near(y: Array) -> Array:
            drift = 0.0 if u is None else drifts(robot, task, resolution, y, u)[0]
            return np.asarray(task.jacobian(robot, y) @ resolution.inputs(robot, y) @ rates.inputs + drift)

        def within(rank: int, outside: Array) -> bool:
            rows = rates.rows  # without units
            N = generalized_inverse(rows[:, None] * rates.A, rank=rank).left_null
            given, half_units = rows * asked, rows * shared_half_units(asked)
            return realised_within_digits(
                N, (given, half_units), rows * outside, lambda y: rows * near(y), (x, rounded.half_units)
            )

        return made(rates, {**_outcome(rates, asked, within), "rounded": rounded})

    found = at(rounded.q)
    if rounded.singular_q is None:
        return found
    return replace(found, status=RateStatus.NEARLY_SINGULAR, at_singularity=at(rounded.singular_q))


def _outcome(rates: Rates, asked: Array, within: Callable[[int, Array], bool]) -> dict[str, Any]:
    """Return the fields of `Resolved`; parts of b below 1e-9 of the size of what it is made of are rounding.

    So is a part outside the range of A that the digits leave open, as `within` says of the rank of A and the part.
    """
    b, spaces, rows = asked - rates.drift, subspaces_without_units(rates.A, rates.scale), rates.rows
    rounding = RANK_TOLERANCE * float(np.linalg.norm(rows * asked) + np.linalg.norm(rows * rates.drift))
    unrealisable, residual = spaces.unrealisable(b), asked - rates.realised
    inside = bool(np.linalg.norm(rows * unrealisable) <= rounding)
    sigma = np.linalg.svd(rates.scale * rates.A, compute_uv=False)
    lost = spaces.rank < min(rates.A.shape)
    status = RateStatus.REALISED_ALL_THE_SAME if lost else RateStatus.REALISED
    if not inside:
        inside = within(spaces.rank, unrealisable)
        status = RateStatus.REALISED_WITHIN_DIGITS if inside else RateStatus.OUT_OF_RANGE
    elif rates.damping > 0 and np.linalg.norm(rows * residual) > rounding:
        status = RateStatus.DAMPED
    return {
        "inputs": rates.inputs,
        "realised": rates.realised,
        "residual": residual,
        "unrealisable": np.zeros(len(b)) if inside else unrealisable,
        "singular_values": spaces.singular_values,
        "relative_sigma": float(sigma[-1] / sigma[0] if sigma[:1].any() else 1.0 - len(sigma[:1])),
        "rank": spaces.rank,
        "damping": rates.damping,
        "status": status,
    }
