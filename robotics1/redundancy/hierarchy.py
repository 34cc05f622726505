"""Several linear equations Aᵢ x = bᵢ, the first before the second: least squares by levels."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from robotics1.inputs import Array
from robotics1.least_squares import RANK_TOLERANCE, generalized_inverse, numeric_rank

Level = tuple[Array, Array, Array | float]  # A, b, and factors that take the units out of A


@dataclass(frozen=True, eq=False)
class Hierarchy:
    """The solution of levels.

    Attributes:
        x: (n,).
        ranks: of each Aᵢ.
        free_ranks: of each Aᵢ Nᵢ₋₁, with Nᵢ₋₁ the null space of the levels before.
        null: (n, k) orthonormal columns, that no level sees.
    """

    x: Array
    ranks: tuple[int, ...]
    free_ranks: tuple[int, ...]
    null: Array


def by_levels(levels: Sequence[Level], n: int, *, damping: float = 0.0) -> Hierarchy:
    """Return x that solves level by level.

    Of all x with the least |A₁ x − b₁| it has the least |A₂ x − b₂|, of these the least |A₃ x − b₃|, and so on.
    With N of orthonormal columns for the null space of the levels before, x ← x + N (Aᵢ N)⁺ (bᵢ − Aᵢ x). It is the
    recursion xᵢ = xᵢ₋₁ + (Aᵢ Pᵢ₋₁)⁺ (bᵢ − Aᵢ xᵢ₋₁) with the projector P = N Nᵀ of the augmented matrix [A₁; ...; Aᵢ₋₁].
    Of all solutions x is the shortest.

    Args:
        levels: (Aᵢ, bᵢ, scaleᵢ); ranks are those of scaleᵢ * Aᵢ, which has no units.
        n: the length of x.
        damping: λ of the inverses of the levels after the first.

    Source: Siciliano, Slotine, A general framework for managing multiple tasks in highly redundant robotic systems,
    ICAR 1991; Baerlocher, Boulic, An inverse kinematics architecture enforcing an arbitrary number of strict priority
    levels, The Visual Computer 20, 2004.
    """
    x, N, free = np.zeros(n), np.eye(n), np.eye(n)  # `free` is N without units
    ranks, free_ranks = [], []
    for number, (A, b, scale) in enumerate(levels):
        sigma = np.linalg.svd(scale * A, compute_uv=False)
        _, s, turned = np.linalg.svd(scale * A @ free)
        r = int(np.count_nonzero(s > RANK_TOLERANCE * sigma[:1]))  # of the size of A, else rounding would count
        inverse = generalized_inverse(A @ N, damping if number else 0.0, rank=r)
        inverse = replace(inverse, sigma=inverse.sigma[:r])  # the others are rounding, which a small λ would enlarge
        x = x + N @ inverse.solve(b - A @ x)
        N, free = N @ inverse.null, free @ turned[r:].T
        ranks.append(numeric_rank(sigma))
        free_ranks.append(r)
    return Hierarchy(x, tuple(ranks), tuple(free_ranks), N)


def by_projection(levels: Sequence[Level], n: int) -> Hierarchy:
    """Return x = A₁⁺ b₁ + N₁N₁ᵀ A₂⁺ b₂ + N₂N₂ᵀ A₃⁺ b₃ + ..., each level solved alone, then projected.

    Nᵢ is the null space of [A₁; ...; Aᵢ]. No inverse of Aᵢ Nᵢ₋₁ is taken, so that x stays bounded where two levels are
    in conflict; a level that is not orthogonal to those before is then not met, also where it could be.

    Source: Chiaverini, Singularity-robust task-priority redundancy resolution for real-time kinematic control of robot
    manipulators, IEEE Trans. Robotics and Automation 13, 1997.
    """
    x = np.zeros(n)
    exact = by_levels(levels, n)
    for i, (A, b, _) in enumerate(levels):
        N = by_levels(levels[:i], n).null
        x = x + N @ (N.T @ generalized_inverse(A, rank=exact.ranks[i]).solve(b))
    return Hierarchy(x, exact.ranks, exact.free_ranks, exact.null)
