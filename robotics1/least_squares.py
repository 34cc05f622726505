"""Least squares: the rank of a matrix, and its generalized inverse, which is the step of Gauss and Newton."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from robotics1.inputs import Array

RANK_TOLERANCE = 1e-9  # σᵢ counts as zero when σᵢ ≤ 1e-9 σ₁


def numeric_rank(singular_values: Array) -> int:
    """Return the number of σᵢ > 1e-9 σ₁, of singular values in descending order."""
    return int(np.count_nonzero(singular_values > RANK_TOLERANCE * singular_values[:1]))


def rank_of(A: Array, scale: Array | float = 1.0) -> int:
    """Return the rank of `scale` * A, (m, n): with factors that take the units out of A, the unit of length is no
    matter.
    """
    return numeric_rank(np.linalg.svd(scale * A, compute_uv=False))


@dataclass(frozen=True, eq=False)
class GeneralizedInverse:
    """A# = V diag(σ/(σ² + λ²)) Uᵀ D of D A = U Σ Vᵀ, (m, n); without damping, λ = 0, it is the pseudoinverse A⁺.

    Attributes:
        U, sigma, Vt: the singular value decomposition, (m, m), (min(m, n),) and (n, n).
        rows: (m,) the diagonal of D: 1, but where A is known to have full row rank.
        rank: r; the σᵢ after the first r count as zero in A⁺.
        damping: λ; A# b minimises |b − A x|² + λ² |x|².
    """

    U: Array
    sigma: Array
    Vt: Array
    rows: Array
    rank: int
    damping: float

    def solve(self, b: Array) -> Array:
        """Return A# b."""
        sigma = self.sigma if self.damping > 0 else self.sigma[: self.rank]
        factors = sigma / (sigma**2 + self.damping**2) if self.damping > 0 else 1 / sigma
        return np.asarray((self.Vt[: len(sigma)].T * factors) @ (self.U[:, : len(sigma)].T @ (self.rows * b.T).T))

    @property
    def null(self) -> Array:
        """(n, n − r) a basis of the null space of A, orthonormal columns."""
        return self.Vt[self.rank :].T

    @property
    def left_null(self) -> Array:
        """(m, m − r) a basis of the null space of Aᵀ, orthonormal columns."""
        return self.U[:, self.rank :]

    def null_part(self, x: Array) -> Array:
        """Return (1 − A⁺A) x, the part of x that A maps to zero."""
        rows = self.Vt[: self.rank]
        return np.asarray(x - rows.T @ (rows @ x))


def generalized_inverse(
    A: Array, damping: float | Callable[[Array], float] = 0.0, *, rank: int | None = None
) -> GeneralizedInverse:
    """Return A# of a matrix (m, n), with a damping λ, or one that depends on the singular values.

    It is a step of every iteration here: Δq = A# r of Gauss and Newton (λ = 0), or of Levenberg and Marquardt.

    Args:
        A: (m, n).
        damping: λ, or σ → λ.
        rank: r, where it is known; by default the number of σᵢ > 1e-9 σ₁.

    Source: Golub, Van Loan, Matrix Computations, 2013, section 5.5; Nakamura, Hanafusa, J. Dyn. Sys. Meas. Control 108,
    1986, and Wampler, IEEE Trans. SMC 16, 1986 (damping).
    """
    U, sigma, Vt = np.linalg.svd(A)
    lam, rows = float(damping(sigma) if callable(damping) else damping), np.ones(len(A))
    if rank == len(A) and lam == 0:  # rows of different units lose no digits: A⁺ = (D A)⁺ D
        rows = 1 / np.linalg.norm(A, axis=1)
        U, sigma, Vt = np.linalg.svd(rows[:, None] * A)
    return GeneralizedInverse(U, sigma, Vt, rows, numeric_rank(sigma) if rank is None else rank, lam)


def least_distance_in_box(M: Array, b: Array) -> float:
    """Return min |M x − b| over |xᵢ| ≤ 1.

    Source: Stark, Parker, Bounded-variable least squares, Computational Statistics 10, 1995.
    """
    from scipy.optimize import lsq_linear

    size = float(np.abs(M).max(initial=0.0))
    if size == 0:
        return float(np.linalg.norm(b))
    found = lsq_linear(M / size, b / size, (-1.0, 1.0), method="bvls", tol=1e-14)
    return float(np.linalg.norm(M @ found.x - b))
