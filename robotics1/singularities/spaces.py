"""The four subspaces of a Jacobian, its rank, and its inverses, under one threshold of rank."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import Enum

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, real_array, real_number
from robotics1.least_squares import RANK_TOLERANCE, least_distance_in_box, numeric_rank
from robotics1.notation import vector
from robotics1.printed_digits import all_printed, half_units, shared_half_units
from robotics1.results import Frozen
from robotics1.tables import Table, table_of

FOUR_DECIMALS = 5e-5  # of σ₁: what a configuration that is rounded to four decimals does not tell from zero
DECIMALS = 3  # of an entry of a matrix that is a rounded one: with fewer, as 0.5 and 0.25, it is a choice


class RankStatus(Enum):
    """Whether the rank is certain, with the digits that are known."""

    FULL_RANK = "the rank is full"
    RANK_DEFICIENT = "the rank is not full"
    NEARLY_SINGULAR = "nearly singular: a lower rank is within the rounding of the given digits"


@dataclass(frozen=True, eq=False)
class Subspaces(Frozen):
    """The subspaces of J (m, n), as orthonormal columns.

    Attributes:
        J: (m, n) the matrix.
        singular_values: (min(m, n),) σ₁ ≥ σ₂ ≥ ...
        rank: r, the number of σᵢ > 1e-9 σ₁; J = 0 has rank 0.
        range: (m, r) the task velocities that can be realised, R(J).
        left_null: (m, m − r) N(Jᵀ): the velocities no q̇ has a part in, and the forces that need no torque.
        row: (n, r) the joint velocities without a part in the null space, R(Jᵀ).
        null: (n, n − r) N(J): the joint velocities that do not move the task.
        rounding: what J may be off by, ‖ΔJ‖: no σᵢ is off by more.
    """

    J: Array
    singular_values: Array
    rank: int
    range: Array
    left_null: Array
    row: Array
    null: Array
    rounding: float = 0.0

    @property
    def certain_rank(self) -> int:
        """The number of σᵢ above the threshold of rank and above the rounding of J: no less is possible."""
        return min(self.rank, int(np.count_nonzero(self.singular_values > self.rounding)))

    @property
    def nearly_singular(self) -> bool:
        """Whether a matrix of lower rank is within the rounding of J, so that its rank may be lower."""
        return self.certain_rank < self.rank

    @property
    def status(self) -> RankStatus:
        """Whether the rank is full, deficient, or not certain with the digits that are known."""
        if self.nearly_singular:
            return RankStatus.NEARLY_SINGULAR
        return RankStatus.FULL_RANK if self.rank == min(self.J.shape) else RankStatus.RANK_DEFICIENT

    @property
    def at_singularity(self) -> Subspaces:
        """The subspaces of the nearest matrix of the certain rank, U_r Σ_r V_rᵀ (Eckart, Young); else these."""
        if not self.nearly_singular:
            return self
        r = self.certain_rank
        U, V = np.hstack([self.range, self.left_null]), np.hstack([self.row, self.null])
        sigma = np.where(np.arange(len(self.singular_values)) < r, self.singular_values, 0.0)
        return Subspaces((U[:, :r] * sigma[:r]) @ V[:, :r].T, sigma, r, U[:, :r], U[:, r:], V[:, :r], V[:, r:])

    def explain(self) -> str:
        """Return the status with its numbers, in a sentence."""
        rank = f"{self.status.value} (rank {self.rank} of {min(self.J.shape)})"
        if not self.nearly_singular:
            return rank
        sigma = self.singular_values[self.certain_rank]
        return f"{rank}; σ = {sigma:.1e} is below {self.rounding:.1e}, and without it the rank is {self.certain_rank}"

    def _tables(self) -> tuple[Table, ...]:
        bases = {
            "task velocities that can be realised, R(J)": self.range,
            "those that are lost, and forces that need no torque, N(Jᵀ)": self.left_null,
            "joint velocities that do not move the task, N(J)": self.null,
        }
        rows = [(name, ", ".join(map(vector, basis.T)) or "none") for name, basis in bases.items()]
        return (table_of(("subspace", "orthonormal basis"), rows),)

    def contains(self, v: npt.ArrayLike) -> bool:
        """Return whether the task velocity v (m,) can be realised: v ∈ R(J), to 1e-9 of its length and to its digits.

        A v with three or more decimals is taken as rounded: another that rounds to it may be in the range.
        """
        outside, rounding = self.unrealisable(v), RANK_TOLERANCE * np.linalg.norm(v)
        if np.linalg.norm(outside) <= rounding:
            return True
        moves = self.left_null.T * shared_half_units(v)
        return bool(least_distance_in_box(moves, self.left_null.T @ outside) <= rounding)

    def unrealisable(self, v: npt.ArrayLike) -> Array:
        """Return the part of the task velocity v (m,) that no q̇ realises: its projection on N(Jᵀ)."""
        v = real_array("v", v, (self.J.shape[0],), "one number for each row of J")
        return self.left_null @ (self.left_null.T @ v)


def subspaces(J: npt.ArrayLike, *, rounding: float | None = None) -> Subspaces:
    """Return the rank and the four subspaces of J (m, n), from its singular value decomposition J = U Σ Vᵀ.

    The rank counts σᵢ > 1e-9 σ₁. Where some of these are not above the rounding of J, the status is NEARLY_SINGULAR,
    and `at_singularity` has the subspaces of the matrix without them: no σᵢ changes by more than ‖ΔJ‖ (Weyl).

    Args:
        J: a matrix.
        rounding: ‖ΔJ‖, what J may be off by. By default, of a matrix printed with three to twelve digits, the Frobenius
            norm of half a unit of each last digit; of a computed one 5e-5 σ₁, what a configuration that is rounded
            to four decimals leaves open. `singularity_within_rounding` finds it for a configuration itself.

    Raises:
        InputError: J is not a finite matrix, or the rounding is negative.

    Source: Golub, Van Loan, Matrix Computations, 2013, sections 2.4 and 8.6 (Weyl); Strang's four fundamental
    subspaces.
    """
    J = real_array("J", J, (None, None), "a matrix")
    sigma = np.linalg.svd(J, compute_uv=False)
    if rounding is None:
        off = np.linalg.norm(half_units(J, DECIMALS)) if all_printed(J) else FOUR_DECIMALS * sigma[:1].sum()
    else:
        off = real_number("rounding", rounding, non_negative=True)
    return subspaces_of_rank(J, numeric_rank(sigma), float(off))


def subspaces_without_units(J: Array, scale: Array | float) -> Subspaces:
    """Return the subspaces of a computed J (m, n). What counts as rounding follows from the singular values of
    `scale` * J, which has no units: so the rank of metres beside radians does not depend on the unit of length.
    """
    sigma = np.linalg.svd(scale * J, compute_uv=False)
    found = subspaces_of_rank(J, numeric_rank(sigma))
    certain = int(np.count_nonzero(sigma[: found.rank] > FOUR_DECIMALS * sigma[:1]))
    return found if certain == found.rank else replace(found, rounding=float(found.singular_values[certain]))


def subspaces_of_rank(J: Array, r: int, rounding: float = 0.0) -> Subspaces:
    """Return the subspaces of a matrix whose rank is known to be r: the smaller singular values are rounding."""
    U, sigma, Vt = np.linalg.svd(J)
    return Subspaces(J, sigma, r, U[:, :r], U[:, r:], Vt[:r].T, Vt[r:].T, rounding)


def vanishing_block(J: Array, slopes: Array, r: int) -> tuple[Array, Array]:
    """Return (A, b): near J = U Σ Vᵀ, (m, n), the block U₂ᵀ J V₂, as a vector, is b + A dx.

    U₂ and V₂ hold the singular vectors after the first r: where the block vanishes, the rank is at most r. The solution
    of least norm of A dx = −b is a Newton step to such a place.

    Args:
        J: (m, n).
        slopes: (m, n, k) ∂J/∂x.
        r: the rank that is wanted.

    Source: the Schur complement of a rank-revealing block, Golub, Van Loan, Matrix Computations, 2013, chapter 5.
    """
    U, sigma, Vt = np.linalg.svd(J)
    U2, V2 = U[:, r:], Vt[r:].T
    block = np.zeros((U2.shape[1], V2.shape[1]))
    np.fill_diagonal(block, sigma[r:])
    return np.einsum("ia,ijk,jb->abk", U2, slopes, V2).reshape(-1, slopes.shape[2]), block.ravel()


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
