"""How a task velocity is resolved into joint velocities: generalized inverses, and inputs other than the joints."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, real_array, real_number
from robotics1.least_squares import generalized_inverse
from robotics1.robot.model import Robot

Matrix = npt.ArrayLike | Callable[[Array], npt.ArrayLike]


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
        G = self.input_matrix(q) if callable(self.input_matrix) else self.input_matrix
        G = real_array("input_matrix", G, (robot.nv, None), "one row for each degree of freedom")
        if not G.shape[1]:
            raise InputError("input_matrix must have a column for each input; there is none")
        return G

    def solve(self, A: Array, b: Array, wish: Array | None = None, *, soft: float = 0.0) -> tuple[Array, float]:
        """Return u = A# b + (1 − A⁺A) wish, (k,), and the λ that was used.

        With W = CᵀC and A C⁻¹ = U Σ Vᵀ it is A# = C⁻¹ V diag(σ/(σ² + λ²)) Uᵀ. A⁺ is the inverse without damping, so
        that the second part does not move the task. `soft` is a region for inverses without damping, relative to the
        largest σ, with a tenth of it as damping: what is integrated must not jump at a singularity.

        Raises:
            InputError: the weights are for another number of inputs.
        """
        C = self._root(A.shape[1])
        back = np.linalg.inv(C)
        inverse = generalized_inverse(A @ back, lambda sigma: self._damping(sigma, soft))
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
