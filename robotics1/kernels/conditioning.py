"""How near to singular a Jacobian is: by its determinant, which is quick, and by its inverse."""

import math

from robotics1.inputs import Array
from robotics1.kernels.chain import PRISMATIC, Indices
from robotics1.kernels.compilation import compiled
from robotics1.kernels.scratch import scratch

FLAT = 1e-14  # of a pivot


@compiled(contract=True, inner=True)
def transposed_jacobian(links: Array, rows: Indices, T: Array, axes: Array, M: Array) -> None:
    """Write Jᵀ, of the rows of J that count, to M, (6, 6), from what `forward_kinematics` found.

    Each joint has a coordinate of its own. Outside of its first n rows and columns M is set to 0, so that loops have a
    constant length, which the compiler writes out.
    """
    n, column = len(rows), scratch(6)
    for j in range(6):
        for k in range(6):
            M[j, k] = 0.0
    for j in range(n):
        x, y, z = axes[j, 0], axes[j, 1], axes[j, 2]
        if links[j, PRISMATIC] != 0.0:
            column[0], column[1], column[2], column[3], column[4], column[5] = x, y, z, 0.0, 0.0, 0.0
        else:
            dx, dy, dz = T[0, 3] - axes[j, 3], T[1, 3] - axes[j, 4], T[2, 3] - axes[j, 5]
            column[0], column[1], column[2] = y * dz - z * dy, z * dx - x * dz, x * dy - y * dx
            column[3], column[4], column[5] = x, y, z
        for k in range(n):
            M[j, k] = column[rows[k]]


@compiled(contract=True, inner=True)
def is_far_from_singular(n: int, M: Array, least: float) -> bool:
    """Whether 1 / (|M| |M⁻¹|), in Frobenius' norm, is certainly above `least`; M, (6, 6), is overwritten.

    |det M| = σ₁ ... σ_n, and the first n − 1 of them have a product of at most (|M|² / (n − 1))^((n−1)/2), as their
    squares add up to |M|² at most; so σ_n is at least |det M| over that. And |M⁻¹| ≤ √n / σ_n.
    """
    square = 0.0
    for i in range(6):
        for j in range(6):
            square += M[i, j] * M[i, j]
    determinant = 1.0
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(M[i, k]) > abs(M[pivot, k]):
                pivot = i
        if not abs(M[pivot, k]) > FLAT:
            return False
        if pivot != k:
            for j in range(6):
                M[k, j], M[pivot, j] = M[pivot, j], M[k, j]
        determinant *= M[k, k]
        factor = 1.0 / M[k, k]
        for i in range(k + 1, n):
            times = factor * M[i, k]
            for j in range(6):
                M[i, j] -= times * M[k, j]
    bound = determinant * determinant / (n * square)  # squared
    for _ in range(n - 1):
        bound *= (n - 1) / square
    return bound > least * least


@compiled(contract=True, inner=True)
def invert_matrix(n: int, M: Array, swaps: Indices) -> float:
    """Overwrite the first n rows and columns of M, (6, 6), with their inverse; outside of them M is 0.

    Return 1 / (|M| |M⁻¹|) in Frobenius' norm, which is at most σ_min/σ_max; 0 where a pivot vanishes. By Gauss and
    Jordan with pivots, in place. swaps is (6,) working space.
    """
    square = 0.0
    for i in range(6):
        for j in range(6):
            square += M[i, j] * M[i, j]
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(M[i, k]) > abs(M[pivot, k]):
                pivot = i
        swaps[k] = pivot
        if not abs(M[pivot, k]) > FLAT:
            return 0.0
        if pivot != k:
            for j in range(6):
                M[k, j], M[pivot, j] = M[pivot, j], M[k, j]
        factor = 1.0 / M[k, k]
        M[k, k] = 1.0
        for j in range(6):
            M[k, j] *= factor
        for i in range(6):
            if i != k:
                factor = M[i, k]
                M[i, k] = 0.0
                for j in range(6):
                    M[i, j] -= factor * M[k, j]
    for k in range(n - 1, -1, -1):
        if swaps[k] != k:
            for i in range(6):
                M[i, k], M[i, swaps[k]] = M[i, swaps[k]], M[i, k]
    other = 0.0
    for i in range(6):
        for j in range(6):
            other += M[i, j] * M[i, j]
    return 1.0 / math.sqrt(square * other)


@compiled(contract=True, inner=True)
def inverse_jacobian(links: Array, rows: Indices, T: Array, axes: Array, M: Array, swaps: Indices) -> float:
    """Write (J⁻¹)ᵀ of the rows of J that count to M, (6, 6), and return the bound of `invert_matrix`."""
    transposed_jacobian(links, rows, T, axes, M)
    return invert_matrix(len(rows), M, swaps)
