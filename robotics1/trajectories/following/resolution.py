"""How a task velocity is resolved into joint velocities: generalized inverses, and inputs other than the joints."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.differentiation import directional_derivative
from robotics1.errors import InputError
from robotics1.inputs import Array, answer_of, dimensions, real_array, real_number
from robotics1.least_squares import generalized_inverse, rank_of
from robotics1.robot.model import Robot
from robotics1.tasks.rows import unitless_factors, unitless_rows
from robotics1.tasks.task import Task

Matrix = npt.ArrayLike | Callable[[Array], npt.ArrayLike]
Wish = npt.ArrayLike | Callable[..., npt.ArrayLike] | None


@dataclass(frozen=True, eq=False)
class Resolution:
    """The generalized inverse A# with which u = A# ṙ is chosen, where ṙ = A u.

    By default A is the Jacobian J, u is q̇, and A# = J⁺: of all q̇ with the least |ṙ − J q̇| the shortest.

    Attributes:
        weights: W of the norm uᵀ W u that is least, (k,) positive or (k, k) positive definite:
            A# = W⁻¹Aᵀ(A W⁻¹Aᵀ)⁻¹ where A has full row rank. A large weight spares a joint.
        damping: λ ≥ 0; u minimises |ṙ − A u|² + λ² uᵀWu: A# = W⁻¹Aᵀ(A W⁻¹Aᵀ + λ²1)⁻¹.
        region: damp only where the smallest singular value σ of A (of A W^(−1/2), with weights) is below this, by
            λ² = damping² (1 − (σ/region)²), so that elsewhere the task is met exactly; None: damp everywhere.
        input_matrix: G(q), (nv, k), with q̇ = G(q) u, where the inputs are not the joint velocities: wheels of a base,
            coupled joints; A = J G. A matrix, or a function of q; None for u = q̇.

    Source: Whitney, IEEE Trans. Man-Machine Systems 10, 1969 (resolved rates, weights); Nakamura, Hanafusa,
        J. Dyn. Sys. Meas. Control 108, 1986 (damping); Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009,
        section 3.5.
    """

    weights: npt.ArrayLike | None = None
    damping: float = 0.0
    region: float | None = None
    input_matrix: Matrix | None = None

    def __post_init__(self) -> None:
        """Refuse weights that are no norm, and a damping that is negative."""
        object.__setattr__(self, "damping", real_number("damping", self.damping, non_negative=True))
        if self.region is not None:
            if self.damping == 0:
                raise InputError("region says where to damp; give the damping λ too, as Resolution(damping=0.1, ...)")
            object.__setattr__(self, "region", real_number("region", self.region, positive=True))
        if self.weights is not None:
            self._root(None)

    def inputs(self, robot: Robot, q: Array) -> Array:
        """Return G(q), (nv, k): the identity where the inputs are the joint velocities.

        Raises:
            InputError: the input matrix has not one row for each degree of freedom.
        """
        if self.input_matrix is None:
            return np.eye(robot.nv)
        matrix = self.input_matrix
        G = answer_of("input_matrix", matrix, q) if callable(matrix) else matrix
        G = real_array("input_matrix", G, (robot.nv, None), "one row for each degree of freedom")
        if not G.shape[1]:
            raise InputError("input_matrix must have a column for each input; there is none")
        return G

    def scale(self, robot: Robot, task: Task, k: int) -> Array:
        """Return (m, k) factors that take the units out of A = J G; those of inputs of the user's own stay."""
        if self.input_matrix is None:
            return unitless_factors(robot, task)
        return np.tile(unitless_rows(robot, task)[:, None], k)

    def solve(
        self, A: Array, b: Array, wish: Array | None = None, *, rank: int, soft: float = 0.0
    ) -> tuple[Array, float]:
        """Return u = A# b + (1 − A⁺A) wish, (k,), and the λ that was used, of a matrix of known rank.

        With W = CᵀC and A C⁻¹ = U Σ Vᵀ it is A# = C⁻¹ V diag(σ/(σ² + λ²)) Uᵀ. A⁺ is the inverse without damping, so
        that the second part does not move the task. `soft` is a region for inverses without damping, relative to the
        largest σ, with a tenth of it as damping: what is integrated must not jump at a singularity.

        Raises:
            InputError: the weights are for another number of inputs.
        """
        C = self._root(A.shape[1])
        back = np.linalg.inv(C)
        inverse = generalized_inverse(A @ back, lambda sigma: self._damping(sigma, soft), rank=rank)
        y = inverse.solve(b)
        if wish is not None:
            y = y + inverse.null_part(C @ wish)
        return np.asarray(back @ y), inverse.damping

    def _damping(self, sigma: Array, soft: float) -> float:
        """Return λ: constant, or growing from zero at the edge of the region to the damping where σ_min = 0."""
        largest, least = (sigma[0], sigma[-1]) if len(sigma) else (0.0, 0.0)
        damping, region = (self.damping, self.region) if self.damping else (soft / 10 * largest, soft * largest)
        if region is None or damping == 0:
            return float(damping)
        return float(damping * np.sqrt(max(0.0, 1 - (least / region) ** 2)))

    def _root(self, k: int | None) -> Array:
        """Return C with W = CᵀC, (k, k)."""
        if self.weights is None:
            return np.eye(1 if k is None else k)
        meaning = "one positive weight for each input, or a positive definite matrix"
        if dimensions("weights", self.weights) < 2:
            w = real_array("weights", self.weights, (k,), meaning)
            if (w <= 0).any():
                raise InputError(f"weights must be positive; they are {w.tolist()}")
            return np.diag(np.sqrt(w))
        W = real_array("weights", self.weights, (k, k), meaning)
        try:
            root = np.linalg.cholesky(W).T
        except np.linalg.LinAlgError:
            root = None
        if root is None or not np.allclose(W, W.T, rtol=1e-12):
            raise InputError(f"weights must be a symmetric, positive definite matrix; it is {W.tolist()}")
        return np.asarray(root)


def resolution_or_default(resolution: Resolution | None) -> Resolution:
    """Return the resolution, or for None that of the pseudoinverse.

    Raises:
        InputError: it is none.
    """
    if resolution is not None and not isinstance(resolution, Resolution):
        raise InputError(f"resolution must be such as Resolution(damping=0.1); it is {resolution!r}")
    return resolution or Resolution()


class Rates(NamedTuple):
    """What the joints do for what is asked of the task at one state.

    Attributes:
        A: (m, k) J G.
        rows: (m,) factors that take the units out of ṙ, or r̈.
        scale: (m, k) factors that take the units out of A.
        inputs: (k,) u, or u̇.
        damping: the λ that was used.
        joints: (nv,) q̇, or q̈.
        drift: (m,) the part of ṙ, or r̈, that is there without these inputs.
    """

    A: Array
    rows: Array
    scale: Array
    inputs: Array
    damping: float
    joints: Array
    drift: Array

    @property
    def realised(self) -> Array:
        """(m,) ṙ, or r̈, of the task."""
        return np.asarray(self.A @ self.inputs + self.drift)


def resolved(
    robot: Robot,
    task: Task,
    resolution: Resolution,
    q: Array,
    asked: Array,
    wish: Wish,
    *,
    u: Array | None = None,
    soft: float = 0.0,
) -> Rates:
    """Return u = A# ṙ + (1 − A⁺A) u₀ and q̇ = G u at a q; or at a state (q, u) what accelerates the task by r̈:
    u̇ = A# (r̈ − Ȧ u) + (1 − A⁺A) u̇₀ and q̈ = G u̇ + Ġ u. `soft` is that of `Resolution.solve`, of A without units.
    """
    G = resolution.inputs(robot, q)
    A, scale = task.jacobian(robot, q) @ G, resolution.scale(robot, task, G.shape[1])
    if u is None:
        drift: Array = np.zeros(task.rows)
        turning: Array = np.zeros(robot.nv)
        wanted = wished("null_velocity", wish, A, q)
    else:
        drift, turning = drifts(robot, task, resolution, q, u)
        wanted = wished("null_acceleration", wish, A, q, u)
    x, damping = resolution.solve(A, asked - drift, wanted, rank=rank_of(A, scale), soft=_with_units(soft, A, scale))
    return Rates(A, unitless_rows(robot, task), scale, x, damping, G @ x + turning, drift)


def _with_units(soft: float, A: Array, scale: Array) -> float:
    """Return the σ/σ₁ of A where that of `scale` * A is `soft`, as far as their smallest σ tell."""
    if not soft:
        return 0.0
    (a, b), (c, d) = (np.linalg.svd(M, compute_uv=False)[[0, -1]] for M in (A, scale * A))
    return float(soft * (b / a) / (d / c)) if min(b, d) > 0 else soft


def drifts(robot: Robot, task: Task, resolution: Resolution, q: Array, u: Array) -> tuple[Array, Array]:
    """Return d(J G)/dt u, (m,), and Ġ u, (nv,): the accelerations of the task and of the joints when u is steady."""
    qdot = resolution.inputs(robot, q) @ u

    def rates(x: Array) -> Array:
        G = resolution.inputs(robot, x)
        return np.concatenate([task.jacobian(robot, x) @ G @ u, G @ u])

    rate = directional_derivative(rates, robot, q, qdot)
    return rate[: task.rows], rate[task.rows :]


def wished(name: str, wish: Wish, A: Array, *state: Array) -> Array | None:
    """Return the wished inputs, (k,), of a vector or a function of the state.

    Raises:
        InputError: they have another shape, or are not finite.
    """
    if wish is None:
        return None
    value: Any = wish
    if callable(value) and not isinstance(value, type):
        value = answer_of(name, value, *state)
    return real_array(name, value, (A.shape[1],), "one number for each joint, or each input")
