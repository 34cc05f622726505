"""How near to singular a Jacobian is: by its determinant, which is quick, and by its inverse."""

import math

from robotics1.inputs import Array
from robotics1.kernels.chain import Indices
from robotics1.kernels.compilation import compiled
from robotics1.kernels.pose import geometric_jacobian

FLAT = 1e-14  # of a pivot


@compiled(contract=True, inner=True)
def rows_that_count(J: Array, rows: Indices, M: Array) -> None:
    """Write the rows of J, (6, n), that count to M, (6, 6); outside of its first n rows and columns M is set to 0, so
    that loops have a constant length, which the compiler writes out.
    """
    n = len(rows)
    for i in range(6):
        for j in range(6):
            M[i, j] = J[rows[i], j] if i < n and j < n else 0.0


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
def invert_matrix(n: int, J: Array, swaps: Indices) -> float:
    """Overwrite the first n rows and columns of J, (6, 6), with their inverse.

    Return 1 / (|J| |J⁻¹|) in Frobenius' norm, which is at most σ_min/σ_max; 0 where a pivot vanishes. By Gauss and
    Jordan with pivots, in place; outside of its first n rows and columns J is set to 0, so that the loops have a
    constant length, which the compiler writes out. swaps is (6,) working space.
    """
    square = 0.0
    for i in range(6):
        for j in range(6):
            if i >= n or j >= n:
                J[i, j] = 0.0
            square += J[i, j] * J[i, j]
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(J[i, k]) > abs(J[pivot, k]):
                pivot = i
        swaps[k] = pivot
        if not abs(J[pivot, k]) > FLAT:
            return 0.0
        if pivot != k:
            for j in range(6):
                J[k, j], J[pivot, j] = J[pivot, j], J[k, j]
        factor = 1.0 / J[k, k]
        J[k, k] = 1.0
        for j in range(6):
            J[k, j] *= factor
        for i in range(6):
            if i != k:
                factor = J[i, k]
                J[i, k] = 0.0
                for j in range(6):
                    J[i, j] -= factor * J[k, j]
    for k in range(n - 1, -1, -1):
        if swaps[k] != k:
            for i in range(6):
                J[i, k], J[i, swaps[k]] = J[i, swaps[k]], J[i, k]
    other = 0.0
    for i in range(6):
        for j in range(6):
            other += J[i, j] * J[i, j]
    return 1.0 / math.sqrt(square * other)


@compiled(contract=True, inner=True)
def inverse_jacobian(links: Array, rows: Indices, T: Array, axes: Array, J: Array, M: Array, swaps: Indices) -> float:
    """Write the inverse of the rows of J that count to M, and return the bound of `invert_matrix`."""
    geometric_jacobian(links, T, axes, J)
    rows_that_count(J, rows, M)
    return invert_matrix(len(rows), M, swaps)
