"""The singularity that the rounding of a configuration may hide: q2 = 1.5708 where the rank is lost at π/2."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from robotics1.differentiation import configuration_derivative
from robotics1.errors import Robotics1Error
from robotics1.inputs import Array
from robotics1.least_squares import numeric_rank
from robotics1.notation import enumeration, joint_value, pi_fraction
from robotics1.printed_digits import half_units
from robotics1.results import Frozen
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.singularities.spaces import RankStatus, Subspaces, subspaces_without_units, vanishing_block
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.rows import unitless_factors

ROUNDS = 8  # of Newton's method, which converges quadratically from so near
SLACK = 1e-6  # relative: how far beyond half a unit a singularity still counts as within
UNMOVED = 0.01  # of the largest move, in half units: a joint that moves less may not be what makes A singular


@dataclass(frozen=True, eq=False)
class RoundedConfiguration(Frozen):
    """A configuration with the digits it is given by, and the singular one that these may stand for.

    Attributes:
        q: (nq,) as given [rad or m].
        half_units: (nq,) half a unit of the last printed digit; 0 of a number that is exact, or computed.
        spaces: the subspaces of J(q).
        singular_q: (nq,) the nearest configuration within the half units at which J has a lower rank; else None.
        at_singularity: the subspaces there; else None.
        joint_names: of the robot.
    """

    q: Array
    half_units: Array
    spaces: Subspaces
    singular_q: Array | None
    at_singularity: Subspaces | None
    joint_names: tuple[str, ...]

    @property
    def status(self) -> RankStatus:
        """NEARLY_SINGULAR where a singularity is within the rounding of q; else by the rank of J(q)."""
        if self.singular_q is not None:
            return RankStatus.NEARLY_SINGULAR
        full = self.spaces.rank == min(self.spaces.J.shape)
        return RankStatus.FULL_RANK if full else RankStatus.RANK_DEFICIENT

    def explain(self) -> str:
        """Return the status in a sentence, with the joints whose digits hide the singularity."""
        rank = f"rank {self.spaces.rank} of {min(self.spaces.J.shape)}"
        if self.singular_q is None or self.at_singularity is None:
            return f"{self.status.value} ({rank})"
        joints = []
        for i in np.flatnonzero(self.singular_q != self.q):
            value, half_unit, there = self.q[i], self.half_units[i], self.singular_q[i]
            printed = f"{value:.{round(-np.log10(2 * half_unit))}f}"
            as_pi = f" ({joint_value(there)})" if pi_fraction(there) else ""
            joints.append(f"{self.joint_names[i]} = {printed} is within {half_unit:.0e} of {there:.10g}{as_pi}")
        sigma = self.spaces.singular_values[self.at_singularity.rank]
        return (
            f"{self.status.value}: {enumeration(joints)}, where the rank is {self.at_singularity.rank}, not "
            f"{self.spaces.rank}; σ = {sigma:.1e} here is not more than rounding"
        )


class AtPrintedConfiguration(Frozen):
    """An answer at a configuration, whose digits may stand for a singular one."""

    rounded: RoundedConfiguration

    @property
    def status(self) -> RankStatus:
        """Whether J has full rank, not, or not certainly with the digits of q."""
        return self.rounded.status


def singularity_within_rounding(robot: RobotLike, task: TaskLike, q: ConfigurationLike) -> RoundedConfiguration:
    """Return whether q, with the digits it is given by, may be singular: J(q') loses rank at a q' that rounds to q.

    A number of two or more decimals and at most 12 digits is taken as rounded to them, so that q2 = 1.5708 stands for
    1.57075 ≤ q2 ≤ 1.57085. A computed number, of 16 digits, stands for itself.

    Args:
        robot: of joints with one coordinate each; other joints are never taken as rounded.
        task: r = f(q).
        q: (nq,) configuration [rad or m], as it was printed or typed.

    Raises:
        InputError: q has the wrong shape or is not finite.
        TaskError: the task does not fit the robot.
    """
    robot, task = robot_and_task(robot, task)
    return rounded_configuration(lambda x: task.jacobian(robot, x), robot, q, unitless_factors(robot, task))


def rounded_configuration(
    matrix: Callable[[Array], Array], robot: Robot, q: ConfigurationLike, scale: Array | float = 1.0
) -> RoundedConfiguration:
    """Return the same for any matrix A(q), (m, n), such as a Jacobian times an input matrix; `scale` * A has no
    units, and tells the rank.
    """
    x, units = robot.configuration(q), printed_half_units(robot, q)
    singular = singular_within(lambda at: scale * matrix(at), robot, x, units)
    there = None if singular is None else subspaces_without_units(matrix(singular), scale)
    return RoundedConfiguration(x, units, subspaces_without_units(matrix(x), scale), singular, there, robot.joint_names)


def printed_half_units(robot: Robot, q: ConfigurationLike) -> Array:
    """Return half a unit of the last printed digit of each joint, (nq,); 0 of a number that is exact, or computed."""
    if robot.nq != robot.nv:
        return np.zeros(robot.nq)
    return half_units(robot.configuration(q) if isinstance(q, str | Mapping) else q)


def singular_within(matrix: Callable[[Array], Array], robot: Robot, q: Array, within: Array) -> Array | None:
    """Return the configuration (nq,) nearest to q at which A(q) has a lower rank, if no joint is farther than `within`.

    Where A is to lose its k smallest singular values, and with them those that are zero anyway, the block of their
    singular vectors must vanish. Newton's method on that block, with the shortest step, finds the nearest such q. The
    largest k that is found counts; None if there is none.

    Args:
        matrix: A(q), (m, n).
        robot: of joints with one coordinate each.
        q: (nq,).
        within: (nq,) how far each joint may be moved.
    """
    if not within.any():
        return None
    sigma = np.linalg.svd(matrix(q), compute_uv=False)
    rank = numeric_rank(sigma)
    suspects = int(np.count_nonzero(sigma[:rank] <= _largest_change(matrix, robot, q, within)))
    for lost in range(suspects, 0, -1):
        found = _newton(matrix, robot, q, rank - lost, within)
        if found is not None:
            moves = np.divide(np.abs(found - q), within, out=np.zeros(robot.nq), where=within > 0)
            fewer = _newton(matrix, robot, q, rank - lost, np.where(moves > UNMOVED * moves.max(), within, 0.0))
            return found if fewer is None else fewer
    return None


def _largest_change(matrix: Callable[[Array], Array], robot: Robot, q: Array, within: Array) -> float:
    """Return Σ ‖∂A/∂qᵢ‖ |Δqᵢ| ≥ ‖ΔA‖ of the largest moves, by which no σ changes more; twice, for the curvature."""
    try:
        slopes = configuration_derivative(matrix, robot, q)
    except Robotics1Error:  # the task has no value beside q
        return 0.0
    return 2 * float(np.linalg.norm(slopes, axis=(0, 1)) @ within)


def _newton(matrix: Callable[[Array], Array], robot: Robot, q: Array, rank: int, within: Array) -> Array | None:
    """Return the configuration near q at which A has this rank, if there is one with |Δqᵢ| ≤ within."""
    x = q.copy()
    try:
        for _ in range(ROUNDS):
            A = matrix(x)
            sigma = np.linalg.svd(A, compute_uv=False)
            if sigma[rank] <= 4 * np.finfo(float).eps * sigma[0]:
                break
            # steps in half units: what is printed finer moves less
            tangent, block = vanishing_block(A, configuration_derivative(matrix, robot, x) * within, rank)
            x = x - within * np.linalg.lstsq(tangent, block, rcond=1e-6)[0]
            if (np.abs(x - q) > 2 * within).any():
                return None
        singular = numeric_rank(np.linalg.svd(matrix(x), compute_uv=False)) <= rank
    except Robotics1Error:  # the task has no value there
        return None
    return x if singular and (np.abs(x - q) <= (1 + SLACK) * within).all() else None
