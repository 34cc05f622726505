"""Inverse kinematics as it is taught: one method, iterated, with its table and the reason it stopped."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from robotics1.angles import angles_of_an_iteration
from robotics1.errors import TaskError
from robotics1.ik.iteration_error import Bounds, ErrorKind, error_and_jacobian, tolerances
from robotics1.ik.result import IKStatus
from robotics1.inputs import Array, counting_number, one_of, real_number
from robotics1.least_squares import RANK_TOLERANCE, generalized_inverse, numeric_rank
from robotics1.notation import count, number, vector
from robotics1.results import Listed, require, tuple_with_arrays
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.tables import Table, table_of
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import Task

Method = Literal["newton", "pseudoinverse", "gradient", "damped"]
METHODS = ("newton", "pseudoinverse", "gradient", "damped")
TOO_FAR = 1e6  # a joint value beyond this says that the iteration diverges [rad, or lengths of the arm and of the way]


@tuple_with_arrays
class IKIterate(NamedTuple):
    """One row of the table: k, q, r = f(q), |e|, det J (NaN if J is not square), the least singular value, and e."""

    k: int
    q: Array
    r: Any
    error_norm: float
    det: float
    sigma_min: float
    e: Array


@dataclass(frozen=True, eq=False)
class IKIteration(Listed[IKIterate]):
    """What an iteration did.

    Attributes:
        status: why it stopped.
        q: (nq,) the last iterate.
        table: one row an iterate, the start included.
        within_limits: whether q is inside the joint limits; the iteration itself ignores them.
        method: its name.
        groups: unit → the rows of e whose norm has a tolerance of its own; under "" all rows, with one tolerance.
    """

    entries_in = "table"

    status: IKStatus
    q: Array
    table: tuple[IKIterate, ...]
    within_limits: bool
    method: str
    groups: Mapping[str, tuple[int, ...]]

    @property
    def converged(self) -> bool:
        """Whether |e| ≤ tolerance at `q`."""
        return self.status is IKStatus.CONVERGED

    @property
    def iterations(self) -> int:
        """The number of updates of q that were made."""
        return len(self.table) - 1

    @property
    def error_norms(self) -> dict[str, Array]:
        """Unit → (k,) the norm of e in the rows of that unit, of every iterate; under "" of all rows."""
        return {
            unit: np.array([np.hypot.reduce(row.e[list(rows)]) for row in self.table])
            for unit, rows in self.groups.items()
        }

    def _tables(self) -> tuple[Table, ...]:
        square = not np.isnan(self.table[0].det)
        norms, rows = self.error_norms, []
        for row in self.table:
            r = getattr(row.r, "translation", row.r)
            last = row.det if square else row.sigma_min
            errors = [f"{norm[row.k]:.5f}" for norm in norms.values()]
            rows.append((str(row.k), vector(row.q), vector(r), *errors, number(last)))
        titles = [f"|e| [{unit}]" if unit else "|e|" for unit in norms]
        return (table_of(("k", "q", "r", *titles, "det J" if square else "σ_min"), rows),)

    def explain(self) -> str:
        """Return why the iteration stopped, with its numbers, in a sentence."""
        last = " and ".join(f"{norm[-1]:.3g} {unit}".strip() for unit, norm in self.error_norms.items())
        after = count(self.iterations, "iteration")
        return f"{self.method} stopped after {after} with |e| = {last}: {self.status.value}"

    def require(self) -> IKIteration:
        """Return self if it converged.

        Raises:
            NotConverged: it did not; the message says why.
        """
        return require(self, self.converged)


def iterate_ik(
    robot: RobotLike,
    task: TaskLike,
    target: Any,
    q0: ConfigurationLike,
    *,
    method: Method = "newton",
    error: ErrorKind = "task",
    tolerance: float | Mapping[str, float] = 1e-4,
    max_iterations: int = 50,
    gain: float | None = None,
    damping: float | None = None,
) -> IKIteration:
    """Iterate q ← q + Δq(J(q), e), e = r_d − f(q), from q0 until |e| ≤ tolerance, and return every iterate.

    With error="body", e = (v, ω) = log(T⁻¹ T_d) is the twist, in the tool's own axes, that moves the tool to the target
    in unit time, and J is the body Jacobian.

    Args:
        robot: the robot; its joint limits are ignored, and looked at in the end.
        task: r = f(q), m rows.
        target: r_d, in the form of the task's value.
        q0: (nq,) the start [rad or m].
        method: "newton" Δq = J⁻¹e; "pseudoinverse" Δq = J⁺e; "gradient" Δq = α Jᵀe;
            "damped" Δq = Jᵀ(JJᵀ + λ²1)⁻¹e.
        error: "task", or "body" for a task whose value is a whole pose.
        tolerance: on |e| in the task's units; or one for each unit, as {"rad": 1e-3, "m": 1e-4}.
        max_iterations: the most updates of q.
        gain: factor of every step, 1 by default; of "gradient" it is α, by default the optimal one (Cauchy).
        damping: λ of "damped", 0.1 by default.

    Raises:
        TaskError: "newton" on a task with m ≠ n rows, axes that move with the robot, or the body twist of what is no
            pose.
        InputError: an argument has the wrong shape or value.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7; of the body twist Lynch, Park, Modern
    Robotics, 2017, section 6.2.
    """
    robot, task = robot_and_task(robot, task)
    step = _step(robot, task, method, gain, damping)
    bounds = tolerances(task, tolerance)
    limit = counting_number("max_iterations", max_iterations)
    task.check_integrable(robot)
    target = task.target(target)
    q = robot.configuration(q0, "q0")
    error_at = error_and_jacobian(robot, task, target, error)
    table: list[IKIterate] = []
    with angles_of_an_iteration():
        too_far = _too_far(robot, task, q, target)
        while True:
            e, J = error_at(q)
            table.append(_row(len(table), q, task.value(robot, q), e, J))
            status = _status(J, e, method, bounds, len(table) > limit)
            if status is None:
                with np.errstate(over="ignore", invalid="ignore"):
                    ahead = q + step(J, e)
                if not np.all(np.abs(ahead) < too_far):  # also when it is not a number
                    status = IKStatus.DIVERGED
            if status is not None:
                return IKIteration(status, q, tuple(table), robot.within_limits(q), method, bounds.rows)
            q = ahead


def _too_far(robot: Robot, task: Task, q0: Array, target: Any) -> Array:
    """Return (n,) the joint values beyond which an iteration diverges: a target may itself be 10⁷ m away."""
    lengths = [robot.reach, *np.abs(q0[~robot.revolute])]
    lengths += list(np.abs(task.error(robot, q0, target))[np.array(task.row_units) != "rad"])
    with np.errstate(over="ignore"):
        turns = TOO_FAR * np.maximum(1.0, np.abs(q0))
        return np.where(robot.revolute, turns, TOO_FAR * max(1.0, *lengths))


def _step(
    robot: Robot, task: Task, method: str, gain: float | None, damping: float | None
) -> Callable[[Array, Array], Array]:
    """Return (J, e) → Δq of the method."""
    one_of("method", method, METHODS)
    if robot.nq != robot.nv:
        raise TaskError(f"robot {robot.name!r} has joints with several degrees of freedom, so q + Δq is not defined")
    if method == "newton" and task.rows != robot.nv:
        raise TaskError(
            f"newton needs as many task rows as joints; here there are {count(task.rows, 'row')} and "
            f"{count(robot.nv, 'joint')}: "
            f"use method='pseudoinverse'"
        )
    alpha = None if gain is None else real_number("gain", gain, positive=True)
    factor = 1.0 if alpha is None else alpha
    lam = 0.1 if damping is None else real_number("damping", damping, positive=True)
    return {
        "newton": lambda J, e: factor * np.linalg.solve(J, e),
        "pseudoinverse": lambda J, e: factor * generalized_inverse(J).solve(e),
        "gradient": lambda J, e: gradient_step(J, e, alpha),
        "damped": lambda J, e: factor * generalized_inverse(J, lam).solve(e),
    }[method]


def gradient_step(J: Array, e: Array, gain: float | None = None) -> Array:
    """Return Δq = α Jᵀ e, down the gradient of ½ eᵀe.

    Without a gain, α = |Jᵀe|² / |J Jᵀe|² minimises the error to first order along the gradient (Cauchy's step).
    """
    g = J.T @ e
    if gain is None:
        size = np.hypot.reduce(g)
        slope = np.hypot.reduce(J @ (g / size)) if size > 0 else 0.0  # of a unit vector, whose squares do not overflow
        gain = float(1 / slope) ** 2 if slope > 0 else 0.0
    return gain * g


def _row(k: int, q: Array, r: Any, e: Array, J: Array) -> IKIterate:
    square = J.shape[0] == J.shape[1]
    det = float(np.linalg.det(J)) if square else float("nan")
    least = np.linalg.svd(J, compute_uv=False)[-1:].sum()  # 0 without joints
    return IKIterate(k, q, r, float(np.hypot.reduce(e)), det, float(least), e)


def _status(J: Array, e: Array, method: str, bounds: Bounds, used_up: bool) -> IKStatus | None:
    """Return why the iteration ends at this iterate, or None if it goes on."""
    if bounds.hold(e):
        return IKStatus.CONVERGED
    error = float(np.hypot.reduce(e))  # which does not overflow
    sigma = np.linalg.svd(J, compute_uv=False)
    if method == "newton":
        if numeric_rank(sigma) < len(sigma):
            return IKStatus.SINGULAR
    elif np.hypot.reduce(J.T @ e) <= RANK_TOLERANCE * sigma[:1].sum() * error:
        return IKStatus.STALLED
    return IKStatus.MAX_ITERATIONS if used_up else None
