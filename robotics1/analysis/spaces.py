"""The four subspaces of a Jacobian, its rank, and its inverses, under one threshold of rank."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, real_array

RANK_TOLERANCE = 1e-9  # σᵢ counts as zero when σᵢ ≤ 1e-9 σ₁


@dataclass(frozen=True, eq=False)
class Subspaces:
    """The subspaces of J (m, n), as orthonormal columns.

    Attributes:
        J: (m, n) the matrix.
        singular_values: (min(m, n),) σ₁ ≥ σ₂ ≥ ...
        rank: r, the number of σᵢ > 1e-9 σ₁; J = 0 has rank 0.
        range: (m, r) the task velocities that can be realised, R(J).
        left_null: (m, m − r) N(Jᵀ): the velocities no q̇ has a part in, and the forces that need no torque.
        row: (n, r) the joint velocities without a part in the null space, R(Jᵀ).
        null: (n, n − r) N(J): the joint velocities that do not move the task.
    """

    J: Array
    singular_values: Array
    rank: int
    range: Array
    left_null: Array
    row: Array
    null: Array

    def contains(self, v: npt.ArrayLike) -> bool:
        """Return whether the task velocity v (m,) can be realised: v ∈ R(J), to 1e-9 of its length."""
        return bool(np.linalg.norm(self.unrealisable(v)) <= RANK_TOLERANCE * np.linalg.norm(v))

    def unrealisable(self, v: npt.ArrayLike) -> Array:
        """Return the part of the task velocity v (m,) that no q̇ realises: its projection on N(Jᵀ)."""
        v = real_array("v", v, (self.J.shape[0],), "one number for each row of J")
        return self.left_null @ (self.left_null.T @ v)


def subspaces(J: npt.ArrayLike) -> Subspaces:
    """Return the rank and the four subspaces of J (m, n), from its singular value decomposition J = U Σ Vᵀ.

    Raises:
        InputError: J is not a finite matrix.

    Source: Golub, Van Loan, Matrix Computations, 2013, section 2.4; Strang's four fundamental subspaces.
    """
    J = real_array("J", J, (None, None), "a matrix")
    return subspaces_of_rank(J, numeric_rank(np.linalg.svd(J, compute_uv=False)))


def subspaces_of_rank(J: Array, r: int) -> Subspaces:
    """Return the subspaces of a matrix whose rank is known to be r: the smaller singular values are rounding."""
    U, sigma, Vt = np.linalg.svd(J)
    return Subspaces(J, sigma, r, U[:, :r], U[:, r:], Vt[:r].T, Vt[r:].T)


def echelon(basis: Array) -> Array:
    """Return another basis of the same span, as it is written by hand: columns with 1 and 0 at the pivot rows,
    and a single column with its first entry positive.

    The pivots are those of a QR decomposition with pivoting, so that the other entries stay small.
    """
    from scipy.linalg import qr

    k = basis.shape[1]
    if k == 0:
        return basis
    pivots = np.sort(qr(basis.T, pivoting=True, mode="r")[1][:k])
    columns = np.linalg.solve(basis[pivots].T, basis.T).T
    if k == 1:
        columns *= np.sign(columns[np.abs(columns) > 1e-12][0])
    return np.where(np.abs(columns) < 1e-12, 0.0, columns)


def numeric_rank(singular_values: Array) -> int:
    """Return the number of σᵢ > 1e-9 σ₁, of singular values in descending order."""
    return int(np.count_nonzero(singular_values > RANK_TOLERANCE * singular_values[:1]))


def pseudoinverse(J: Array) -> Array:
    """Return J⁺ (n, m), with the singular values below the threshold of rank taken as zero."""
    return np.asarray(np.linalg.pinv(J, rcond=RANK_TOLERANCE))
