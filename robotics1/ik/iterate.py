"""Inverse kinematics as it is taught: one method, iterated, with its table and the reason it stopped."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from robotics1.errors import TaskError
from robotics1.ik.result import IKStatus
from robotics1.inputs import Array, counting_number, one_of, real_number
from robotics1.least_squares import RANK_TOLERANCE, generalized_inverse, numeric_rank
from robotics1.notation import count, number, vector
from robotics1.results import Frozen, require, tuple_with_arrays
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
    """One row of the table: k, q, r = f(q), |e|, det J (NaN if J is not square), and the least singular value."""

    k: int
    q: Array
    r: Any
    error_norm: float
    det: float
    sigma_min: float


@dataclass(frozen=True, eq=False)
class IKIteration(Frozen):
    """What an iteration did.

    Attributes:
        status: why it stopped.
        q: (nq,) the last iterate.
        table: one row an iterate, the start included.
        within_limits: whether q is inside the joint limits; the iteration itself ignores them.
        method: its name.
    """

    status: IKStatus
    q: Array
    table: tuple[IKIterate, ...]
    within_limits: bool
    method: str

    @property
    def converged(self) -> bool:
        """Whether |e| ≤ tolerance at `q`."""
        return self.status is IKStatus.CONVERGED

    @property
    def iterations(self) -> int:
        """The number of updates of q that were made."""
        return len(self.table) - 1

    def __len__(self) -> int:
        return len(self.table)

    def __iter__(self) -> Iterator[IKIterate]:
        return iter(self.table)

    def __getitem__(self, i: int) -> IKIterate:
        return self.table[i]

    def _tables(self) -> tuple[Table, ...]:
        square = not np.isnan(self.table[0].det)
        rows = []
        for row in self.table:
            r = getattr(row.r, "translation", row.r)
            last = row.det if square else row.sigma_min
            rows.append((str(row.k), vector(row.q), vector(r), f"{row.error_norm:.5f}", number(last)))
        return (table_of(("k", "q", "r", "|e|", "det J" if square else "σ_min"), rows),)

    def explain(self) -> str:
        """Return why the iteration stopped, with its numbers, in a sentence."""
        error = self.table[-1].error_norm
        after = count(self.iterations, "iteration")
        return f"{self.method} stopped after {after} with |e| = {error:.3g}: {self.status.value}"

    def require(self) -> "IKIteration":
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
    tolerance: float = 1e-4,
    max_iterations: int = 50,
    gain: float | None = None,
    damping: float | None = None,
) -> IKIteration:
    """Iterate q ← q + Δq(J(q), e), e = r_d − f(q), from q0 until |e| ≤ tolerance, and return every iterate.

    Args:
        robot: the robot; its joint limits are ignored, and looked at in the end.
        task: r = f(q), m rows.
        target: r_d, in the form of the task's value.
        q0: (nq,) the start [rad or m].
        method: "newton" Δq = J⁻¹e; "pseudoinverse" Δq = J⁺e; "gradient" Δq = α Jᵀe;
            "damped" Δq = Jᵀ(JJᵀ + λ²1)⁻¹e.
        tolerance: on |e| in the task's units [m, rad].
        max_iterations: the most updates of q.
        gain: factor of every step, 1 by default; of "gradient" it is α, by default the optimal one (Cauchy).
        damping: λ of "damped", 0.1 by default.

    Raises:
        TaskError: "newton" on a task with m ≠ n rows, or axes that move with the robot.
        InputError: an argument has the wrong shape or value.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.
    """
    robot, task = robot_and_task(robot, task)
    step = _step(robot, task, method, gain, damping)
    tolerance = real_number("tolerance", tolerance, positive=True)
    limit = counting_number("max_iterations", max_iterations)
    task.check_integrable(robot)
    target = task.target(target)
    q = robot.configuration(q0, "q0")
    table: list[IKIterate] = []
    too_far = _too_far(robot, task, q, target)
    while True:
        e, J = task.error(robot, q, target), task.jacobian(robot, q)
        table.append(_row(len(table), q, task.value(robot, q), e, J))
        status = _status(J, e, method, tolerance, len(table) > limit)
        if status is None:
            with np.errstate(over="ignore", invalid="ignore"):
                ahead = q + step(J, e)
            if not np.all(np.abs(ahead) < too_far):  # also when it is not a number
                status = IKStatus.DIVERGED
        if status is not None:
            return IKIteration(status, q, tuple(table), robot.within_limits(q), method)
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
            f"newton needs as many task rows as joints; here there are {task.rows} rows and {robot.nv} joints: "
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
    return IKIterate(k, q, r, float(np.hypot.reduce(e)), det, float(least))


def _status(J: Array, e: Array, method: str, tolerance: float, used_up: bool) -> IKStatus | None:
    """Return why the iteration ends at this iterate, or None if it goes on."""
    error = float(np.hypot.reduce(e))  # which does not overflow
    if error <= tolerance:
        return IKStatus.CONVERGED
    sigma = np.linalg.svd(J, compute_uv=False)
    if method == "newton":
        if numeric_rank(sigma) < len(sigma):
            return IKStatus.SINGULAR
    elif np.hypot.reduce(J.T @ e) <= RANK_TOLERANCE * sigma[:1].sum() * error:
        return IKStatus.STALLED
    return IKStatus.MAX_ITERATIONS if used_up else None
