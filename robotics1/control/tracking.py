"""Kinematic control: following a joint trajectory with feedback, and how much gain that needs."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np
import numpy.typing as npt

from robotics1.curves.given import Motion, joint_motion
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import (
    Array,
    counting_number,
    dimensions,
    non_negative_numbers,
    real_array,
    real_number,
    without_infinity,
)
from robotics1.results import Frozen, require
from robotics1.trajectories.following.integration import integrated

PRECISION = 1e-12  # of the integration, of the largest value of each joint
FASTEST = 1e9  # gain times duration: a faster loop follows at once, and cannot be integrated
LARGEST = 1e150  # rad or m: squares of such errors are finite


@dataclass(frozen=True, eq=False)
class Tracking(Frozen):
    """A simulated run of q̇ = q̇_d + K (q_d − q).

    Attributes:
        t: (k,) times [s].
        q: (k, n) what the joints did [rad or m].
        command: (k, n) the velocities they were given, after saturation [rad/s or m/s].
        error: (k, n) q_d − q.
        saturated: (n,) whether a joint's command was cut at its rate limit.
    """

    t: Array
    q: Array
    command: Array
    error: Array
    saturated: npt.NDArray[np.bool_]

    @property
    def final_error(self) -> float:
        """|q_d(T) − q(T)|, the error at the end of the trajectory."""
        return float(np.linalg.norm(self.error[-1]))


def simulate_tracking(
    trajectory: Motion,
    q0: npt.ArrayLike,
    gain: npt.ArrayLike,
    *,
    rate_limits: npt.ArrayLike | None = None,
    samples: int = 401,
) -> Tracking:
    """Integrate q̇ = sat(q̇_d(t) + K (q_d(t) − q)) from q(0) = q0 along the trajectory, K = diag(gain).

    Without saturation the error decays as e_i(t) = e_i(0) exp(−k_i t). Where q̇_d jumps, the integration starts anew.

    Args:
        trajectory: q_d(t), any of n joints: a polynomial, a profile, a spline, one that follows a path.
        q0: (n,) where the joints really start [rad or m].
        gain: (n,) k_i [1/s], or one number for all; zero is feedforward alone.
        rate_limits: (n,) largest |q̇| of each joint, or one number; None for no saturation.
        samples: the number of times that are returned.

    Raises:
        InputError: no trajectory of joints, a negative gain or limit, a gain too large for the duration, or a wrong
            shape.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.1, with joint errors.
    """
    motion = joint_motion("trajectory", trajectory, derivatives=2)
    n, ends = motion.dimension, motion.ends
    q0 = real_array("q0", q0, (n,), "one number for each joint")
    k = non_negative_numbers("gain", gain, n)
    _refuse_what_is_too_large(k, ends[-1], q0)
    limits = _limits(rate_limits, n)
    t = np.linspace(0.0, ends[-1], counting_number("samples", samples, least=2))

    def wanted(time: float, q: Array, side: Side) -> Array:
        return np.asarray(motion.velocity(time, side=side) + k * (motion(time) - q))

    size = np.maximum(np.abs(q0), np.abs(motion(t)).max(axis=0))
    precision = PRECISION * np.where(size > 0, size, 1.0)
    solution = integrated(
        lambda time, q, side: np.clip(wanted(time, q, side), -limits, limits),
        ends,
        q0,
        method="LSODA",
        rtol=1e-10,
        atol=precision,
        max_step=ends[-1] / 50,
    )
    q = np.full((len(t), n), np.nan)
    reached, states = solution.sampled(t)
    q[: len(reached)] = states.reshape(len(reached), n)
    asked = np.array([wanted(time, position, "right") for time, position in zip(t, q, strict=True)])
    saturated = (np.abs(asked) > limits).any(axis=0)
    return Tracking(t, q, np.clip(asked, -limits, limits), motion(t) - q, saturated)


class GainStatus(Enum):
    """What the smallest gain leads to."""

    FEEDBACK = "feedback recovers the error"
    SATURATES = "the command saturates for a while, but feedback still recovers the error in time"
    REPLAN = "the command saturates and the error remains: plan a new trajectory from where the robot is"


@dataclass(frozen=True, eq=False)
class GainChoice(Frozen):
    """The smallest gain for a wanted final error, and whether the robot can follow its command.

    Attributes:
        gain: (n,) k_i [1/s], equal for all joints.
        status: whether feedback with it recovers the error.
        run: the simulated run with it.
    """

    gain: Array
    status: GainStatus
    run: Tracking

    def explain(self) -> str:
        """Return the status with its numbers, in a sentence."""
        return f"{self.status.value}; with k = {self.gain.max(initial=0.0):.6g} 1/s |e(T)| = {self.run.final_error:.3g}"

    def require(self) -> GainChoice:
        """Return self if feedback recovers the error.

        Raises:
            NotConverged: it does not, so that a new trajectory is needed.
        """
        return require(self, self.status is not GainStatus.REPLAN)


def smallest_gain(
    trajectory: Motion,
    q0: npt.ArrayLike,
    final_error: float,
    *,
    rate_limits: npt.ArrayLike | None = None,
) -> GainChoice:
    """Return the smallest diagonal gain with |q_d(T) − q(T)| ≤ final_error, and try it under the rate limits.

    With e(0) = q_d(0) − q0, the error of the loop is |e(T)|² = Σ e_i(0)² exp(−2 k_i T); the largest k_i is
    least when all are k = ln(|e(0)| / final_error) / T. A command that saturates loses some of this; when the
    run then misses the wanted error, replanning is the better answer.

    Args:
        trajectory: q_d(t), of duration T.
        q0: (n,) where the joints really start [rad or m].
        final_error: the wanted |e(T)|, positive.
        rate_limits: (n,) largest |q̇| of each joint, or one number; None for no saturation.

    Raises:
        InputError: final_error is not positive, or a shape is wrong.
    """
    wanted = real_number("final_error", final_error, positive=True)
    motion = joint_motion("trajectory", trajectory)
    n = motion.dimension
    q0 = real_array("q0", q0, (n,), "one number for each joint")
    start = float(np.hypot.reduce(motion(0.0) - q0))
    k = max(0.0, float(np.log(start) - np.log(wanted)) / motion.end) if start > 0 else 0.0
    run = simulate_tracking(motion, q0, k, rate_limits=rate_limits)
    if not run.saturated.any():
        status = GainStatus.FEEDBACK
    elif run.final_error <= wanted * (1 + 1e-6):
        status = GainStatus.SATURATES
    else:
        status = GainStatus.REPLAN
    return GainChoice(np.full(n, k), status, run)


def _refuse_what_is_too_large(k: Array, duration: float, q0: Array) -> None:
    """Raise InputError where the loop is too fast, or the start too far, for numbers."""
    fastest = float(k.max(initial=0.0))
    if fastest > FASTEST / duration:
        raise InputError(
            f"gain must be at most {FASTEST / duration:g} for a motion of {duration:g} s; it is {fastest:g}"
        )
    if (np.abs(q0) > LARGEST).any():
        raise InputError(f"q0 must be at most {LARGEST:g}; it is {q0.tolist()}")


def _limits(rate_limits: npt.ArrayLike | None, n: int) -> Array:
    """Return the largest |q̇| of each joint; infinity, as a robot says it, and None are no limit."""
    if rate_limits is None:
        return np.full(n, np.inf)
    dimensions("rate_limits", rate_limits)
    finite, unlimited = without_infinity(rate_limits, 0.0)
    return np.where(unlimited, np.inf, non_negative_numbers("rate_limits", finite, n))
