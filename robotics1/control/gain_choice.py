"""Gains from what is wanted: an error ratio at a time, or as fast as the joint rates allow."""

from __future__ import annotations

from typing import Any, Literal, NamedTuple, get_args

import numpy as np
import numpy.typing as npt

from robotics1.curves.given import as_curve
from robotics1.errors import InputError, TaskError
from robotics1.inputs import (
    Array,
    counting_number,
    one_of,
    positive_bound,
    positive_number,
    real_array,
    real_number,
)
from robotics1.least_squares import generalized_inverse, rank_of
from robotics1.notation import vector
from robotics1.results import tuple_with_arrays
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.rows import unitless_factors

Criterion = Literal["error", "smallest", "common"]
CRITERIA: tuple[Criterion, ...] = get_args(Criterion)
Bounds = list[tuple[float, float | None]]
FIXED = 1e-9  # relative: a gain that can grow by less is at its largest


@tuple_with_arrays
class Gains(NamedTuple):
    """Gains of a law.

    Attributes:
        K: [1/s], or [1/s²] of second order.
        D: [1/s]; None of first order.
    """

    K: float
    D: float | None


def gains_for_decay(ratio: float, time: float, *, order: int = 1, damping_ratio: float = 1.0) -> Gains:
    """Return the gains with which an error falls to a ratio of its start at a time, for a start at rest.

    Of first order e(t)/e₀ = exp(−k t): k = ln(1/ratio)/time. Of second order K = ω², D = 2 ζ ω, and ω the smallest
    with which |e| stays below the ratio from that time on, where ė₀ = 0; for ζ = 1, (1 + ω t) exp(−ω t) = ratio.

    Args:
        ratio: |e(time)|/|e(0)|, between 0 and 1.
        time: [s].
        order: 1 or 2.
        damping_ratio: ζ > 0; 1 is critical damping, the fastest without oscillation.

    Raises:
        InputError: a number is out of its range.
    """
    wanted, T = real_number("ratio", ratio, positive=True), real_number("time", time, positive=True)
    if wanted >= 1:
        raise InputError(f"ratio must be below 1: the error shall decay; it is {wanted:g}")
    if counting_number("order", order, least=1, most=2) == 1:
        return Gains(float(-np.log(wanted)) / T, None)
    zeta = positive_number("damping_ratio", damping_ratio)
    from robotics1.control.decay import ErrorDecay

    one = np.ones((1, 1))
    decay = ErrorDecay(one, 2 * zeta * one, np.ones(1), np.zeros(1))  # ω = 1: the time scales with 1/ω
    omega = decay.time_to(wanted) / T
    return Gains(omega**2, 2 * zeta * omega)


def largest_gains(
    robot: RobotLike,
    task: TaskLike,
    wanted: Any,
    q: ConfigurationLike,
    *,
    limits: npt.ArrayLike | None = None,
    criterion: Criterion = "error",
    t: float = 0.0,
) -> Array:
    """Return the largest gains, (m,), of q̇ = J⁺ (ṙ_d + diag(K) (r_d − f(q))) within the joint rates at a state.

    ===========  =============================================================================================
    criterion    K ≥ 0 with |q̇| ≤ V
    ===========  =============================================================================================
    "error"      with the largest eᵀ K e: ½ |e|² falls as fast as it can; a gain may come out as 0
    "smallest"   whose smallest is as large as it can be, then the next, and so on: every error decays
    "common"     the same for all rows
    ===========  =============================================================================================

    A gain whose error is zero does not matter, and is infinite. They are found by linear programs.

    Args:
        robot: the robot.
        task: r = f(q).
        wanted: r_d(t), a motion, or r_d at rest.
        q: (nq,) configuration [rad or m].
        limits: (n,) V, or one number [rad/s or m/s]; None for the robot's.
        criterion: one of those above.
        t: the instant of the motion [s].

    Raises:
        InputError: the feedforward alone is beyond the limits, the rates have no limit, or a shape is wrong.
        TaskError: J has not full row rank at q.
    """
    robot, task = robot_and_task(robot, task)
    if not robot.nv:
        raise TaskError(f"robot {robot.name!r} has no joint to control")
    q, kind = robot.configuration(q), one_of("criterion", criterion, CRITERIA)
    V = positive_bound("rates", robot.max_velocity if limits is None else limits, robot.nv)
    moves = callable(wanted) or hasattr(wanted, "trajectory")
    motion = as_curve("wanted", wanted, derivatives=1) if moves else None
    e = task.error(robot, q, wanted if motion is None else motion(t))
    ahead = np.zeros(task.rows) if motion is None else real_array("ṙ_d", motion.velocity(t), (task.rows,))
    J = task.jacobian(robot, q)
    if (rank := rank_of(J, unitless_factors(robot, task))) < task.rows:
        raise TaskError("J has not full row rank at this q, so that no law realises every error rate")
    inverse = generalized_inverse(J, rank=rank).solve(np.eye(task.rows))
    base = inverse @ ahead
    if (np.abs(base) > V * (1 + 1e-12)).any():
        raise InputError(f"the feedforward alone, q̇ = {vector(base)}, is beyond the limits {vector(V)}")
    acts = np.abs(e) > 0
    effects, n = (inverse * e)[:, acts], int(acts.sum())
    gains = np.full(task.rows, np.inf)
    if not n:
        return gains
    rows = np.isfinite(V)
    A = np.vstack([effects[rows], -effects[rows]])
    b = np.concatenate([(V - base)[rows], (V + base)[rows]])
    if kind == "common":
        gains[acts] = _program(np.ones(1), A.sum(axis=1, keepdims=True), b, [(0.0, None)])[0]
    elif kind == "error":
        gains[acts] = _program(e[acts] ** 2, A, b, [(0.0, None)] * n)
    else:
        gains[acts] = _max_min(A, b)
    return gains


def _max_min(A: Array, b: Array) -> Array:
    """Return k ≥ 0 with A k ≤ b: the smallest as large as possible, then the next.

    With z for the common least value of those that are free, z is made as large as possible; those that cannot be
    larger alone are fixed there.
    """
    n = A.shape[1]
    fixed: dict[int, float] = {}
    while len(fixed) < n:
        free = [i for i in range(n) if i not in fixed]
        floors = np.hstack([-np.eye(n)[free], np.ones((len(free), 1))])  # z − kᵢ ≤ 0
        with_z = np.vstack([np.column_stack([A, np.zeros(len(A))]), floors])
        bounds: Bounds = [(fixed.get(i, 0.0), fixed.get(i)) for i in range(n)]
        level = float(
            _program(np.eye(n + 1)[-1], with_z, np.append(b, np.zeros(len(free))), [*bounds, (0.0, None)])[-1]
        )
        bounds = [(fixed.get(i, level * (1 - 1e-12)), fixed.get(i)) for i in range(n)]
        tops = {i: float(_program(np.eye(n)[i], A, b, bounds)[i]) for i in free}
        least = min(tops.values())
        fixed |= {i: level for i, top in tops.items() if top <= max(level, least) * (1 + FIXED)}
    return np.array([fixed[i] for i in range(n)])


def _program(value: Array, A: Array, b: Array, bounds: Bounds) -> Array:
    """Return x with the largest value · x, A x ≤ b, inside bounds.

    Raises:
        InputError: nothing bounds it.
    """
    from scipy.optimize import linprog

    found = linprog(-value, A_ub=A, b_ub=b, bounds=bounds, method="highs")
    if found.x is None:
        raise InputError("the rates of the joints that move the error have no limit: give limits=")
    return np.asarray(found.x)
