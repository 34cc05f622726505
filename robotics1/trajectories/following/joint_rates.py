"""Inverse differential kinematics at one state: q̇ from ṙ, and q̈ from r̈, with what cannot be realised."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from enum import Enum
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt

from robotics1.analysis.rounded_configuration import RoundedConfiguration, rounded_configuration
from robotics1.analysis.spaces import RANK_TOLERANCE, subspaces
from robotics1.differentiation import directional_derivative
from robotics1.inputs import Array, a_robot_and_a_task, real_array
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task
from robotics1.trajectories.following.resolution import Resolution, resolution_or_default

NEAR = 1e-2  # σ_min/σ_max: below, joint velocities become large


class RateVerdict(Enum):
    """Whether what is asked of the task is realised."""

    REALISED = "realised"
    REALISED_ALL_THE_SAME = "realised, although the Jacobian has lost rank: what is asked is in its range"
    DAMPED = "in the range of the Jacobian, but the damping leaves a part of it"
    OUT_OF_RANGE = "not in the range of the Jacobian: a part of it cannot be realised"
    NEARLY_SINGULAR = "nearly singular: with the digits it is given by, the configuration may be singular"


@dataclass(frozen=True, eq=False)
class Resolved:
    """The inputs u that realise b = A u best.

    Attributes:
        inputs: (k,) u; the joint velocities or accelerations themselves unless there is an input matrix.
        realised: (m,) A u.
        residual: (m,) b − A u: what is not realised.
        unrealisable: (m,) the part of b outside the range of A, which no inputs realise; zero where there is none.
        singular_values: of A, descending.
        rank: of A.
        damping: the λ that was used.
        verdict: whether b is realised; NEARLY_SINGULAR where a singularity is within the rounding of q.
        rounded: q with its printed digits, and the singular configuration within them.
    """

    inputs: Array
    realised: Array
    residual: Array
    unrealisable: Array
    singular_values: Array
    rank: int
    damping: float
    verdict: RateVerdict
    rounded: RoundedConfiguration = field(kw_only=True)

    @property
    def feasible(self) -> bool:
        """Whether b is in the range of A, so that some inputs realise it."""
        return not self.unrealisable.any()

    @property
    def near_singular(self) -> bool:
        """Whether the rank is lost, or σ_min ≤ 0.01 σ_max."""
        return bool((self.singular_values[-1:] <= NEAR * self.singular_values[:1]).any())

    @property
    def explanation(self) -> str:
        """The verdict with its numbers, in a sentence."""
        if self.verdict is RateVerdict.NEARLY_SINGULAR:
            return f"{self.rounded.explain()}; the answer there is `at_singularity`"
        rank = f"rank {self.rank} of {min(len(self.realised), len(self.inputs))}"
        near = ""
        if self.near_singular and self.singular_values[-1] > 0:
            near = f", near a singularity: σ_min/σ_max = {self.singular_values[-1] / self.singular_values[0]:.2g}"
        left = float(np.linalg.norm(self.residual))
        rest = "" if self.verdict.name.startswith("REALISED") else f"; |residual| = {left:.6g}"
        return f"{self.verdict.value} ({rank}{near}{rest})"


@dataclass(frozen=True, eq=False)
class JointVelocity(Resolved):
    """The joint velocities for a task velocity.

    Attributes:
        qdot: (nv,) q̇ = G u [rad/s or m/s].
        at_singularity: the answer at the singular configuration within the rounding of q; None where there is none.
    """

    qdot: Array
    at_singularity: "JointVelocity | None" = None


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
    at_singularity: "JointAcceleration | None" = None


Answer = TypeVar("Answer", JointVelocity, JointAcceleration)


def joint_velocity(
    robot: Robot,
    task: Task,
    q: npt.ArrayLike,
    rdot: npt.ArrayLike,
    *,
    resolution: Resolution | None = None,
    null_velocity: npt.ArrayLike | None = None,
) -> JointVelocity:
    """Return the joint velocities q̇ = J# ṙ + (1 − J⁺J) q̇₀ for a task velocity, and what of it is not realised.

    Args:
        robot: the robot.
        task: r = f(q).
        q: (nq,) configuration [rad or m].
        rdot: (m,) ṙ, one number for each row of J.
        resolution: which inverse J# is taken, and what the inputs are; by default the pseudoinverse.
        null_velocity: (nv,) q̇₀, or (k,) of inputs, of which the part that does not move the task is added.

    Raises:
        InputError: a shape is wrong.
        TaskError: the task does not fit the robot.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.5.
    """
    a_robot_and_a_task(robot, task)
    chosen = resolution_or_default(resolution)
    rdot = real_array("rdot", rdot, (task.rows,), "one number for each row of J")
    rounded = _rounded(robot, task, chosen, q)

    def at(x: Array, A: Array) -> JointVelocity:
        u, damping = chosen.solve(A, rdot, _wish("null_velocity", null_velocity, A))
        resolved = _resolved(A, rdot, u, damping, float(np.linalg.norm(rdot)))
        return JointVelocity(**resolved, qdot=chosen.inputs(robot, x) @ u, rounded=rounded)

    return _also_at_singularity(rounded, at)


def joint_acceleration(
    robot: Robot,
    task: Task,
    q: npt.ArrayLike,
    qdot: npt.ArrayLike,
    rddot: npt.ArrayLike,
    *,
    resolution: Resolution | None = None,
    null_acceleration: npt.ArrayLike | None = None,
) -> JointAcceleration:
    """Return the joint accelerations q̈ = J# (r̈ − J̇ q̇) + (1 − J⁺J) q̈₀ for a task acceleration, and what is not realised.

    With an input matrix G(q): u̇ = (J G)# (r̈ − d(J G)/dt u) + …, and q̈ = G u̇ + Ġ u.

    Args:
        robot: the robot.
        task: r = f(q).
        q: (nq,) configuration [rad or m].
        qdot: (nv,) q̇ [rad/s or m/s]; with an input matrix (k,), the inputs u.
        rddot: (m,) r̈, one number for each row of J.
        resolution: which inverse J# is taken, and what the inputs are; by default the pseudoinverse.
        null_acceleration: (nv,) q̈₀, or (k,) of inputs, of which the part that does not accelerate the task is added.

    Raises:
        InputError: a shape is wrong.
        TaskError: the task does not fit the robot.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.4.
    """
    a_robot_and_a_task(robot, task)
    chosen = resolution_or_default(resolution)
    rddot = real_array("rddot", rddot, (task.rows,), "one number for each row of J")
    rounded = _rounded(robot, task, chosen, q)
    u = real_array("qdot", qdot, (rounded.spaces.J.shape[1],), "one number for each joint, or each input")

    def at(x: Array, A: Array) -> JointAcceleration:
        drift, turning = drifts(robot, task, chosen, x, u)
        udot, damping = chosen.solve(A, rddot - drift, _wish("null_acceleration", null_acceleration, A))
        size = float(np.linalg.norm(rddot) + np.linalg.norm(drift))
        resolved = _resolved(A, rddot - drift, udot, damping, size)
        resolved["realised"] = resolved["realised"] + drift
        qddot = chosen.inputs(robot, x) @ udot + turning
        return JointAcceleration(**resolved, qddot=qddot, drift=drift, rounded=rounded)

    return _also_at_singularity(rounded, at)


def _rounded(robot: Robot, task: Task, resolution: Resolution, q: npt.ArrayLike) -> RoundedConfiguration:
    """Return what the digits of q leave open of the rank of A = J G."""
    return rounded_configuration(lambda x: task.jacobian(robot, x) @ resolution.inputs(robot, x), robot, q)


def _also_at_singularity(rounded: RoundedConfiguration, at: Callable[[Array, Array], Answer]) -> Answer:
    """Return the answer at q, and in it the one at a singular configuration within the rounding of q, if any."""
    found = at(rounded.q, rounded.spaces.J)
    if rounded.singular_q is None or rounded.at_singularity is None:
        return found
    there = at(rounded.singular_q, rounded.at_singularity.J)
    return replace(found, verdict=RateVerdict.NEARLY_SINGULAR, at_singularity=there)


def drifts(robot: Robot, task: Task, resolution: Resolution, q: Array, u: Array) -> tuple[Array, Array]:
    """Return d(J G)/dt u, (m,), and Ġ u, (nv,): the accelerations of the task and of the joints when u is steady."""
    qdot = resolution.inputs(robot, q) @ u

    def rates(x: Array) -> Array:
        G = resolution.inputs(robot, x)
        return np.concatenate([task.jacobian(robot, x) @ G @ u, G @ u])

    rate = directional_derivative(rates, robot, q, qdot)
    return rate[: task.rows], rate[task.rows :]


def _wish(name: str, value: npt.ArrayLike | None, A: Array) -> Array | None:
    return None if value is None else real_array(name, value, (A.shape[1],), "one number for each joint, or each input")


def _resolved(A: Array, b: Array, u: Array, damping: float, size: float) -> dict[str, Any]:
    """Return the fields of `Resolved`; parts of b below 1e-9 of the size of what it is made of are rounding."""
    spaces = subspaces(A)
    inside = bool(np.linalg.norm(spaces.unrealisable(b)) <= RANK_TOLERANCE * size)
    residual = b - A @ u
    if not inside:
        verdict = RateVerdict.OUT_OF_RANGE
    elif damping > 0 and np.linalg.norm(residual) > RANK_TOLERANCE * size:
        verdict = RateVerdict.DAMPED
    else:
        lost = spaces.rank < min(A.shape)
        verdict = RateVerdict.REALISED_ALL_THE_SAME if lost else RateVerdict.REALISED
    return {
        "inputs": u,
        "realised": A @ u,
        "residual": residual,
        "unrealisable": np.zeros(len(b)) if inside else spaces.unrealisable(b),
        "singular_values": spaces.singular_values,
        "rank": spaces.rank,
        "damping": damping,
        "verdict": verdict,
    }
