"""A block of matrices, each turned into a bidiagonal one with the same singular values."""

import math

from robotics1.inputs import Array
from robotics1.kernels.block_jacobian import BLOCK
from robotics1.kernels.compilation import compiled

ZERO = 1e-290  # |x|² of a vector that needs no reflection: its inverse would overflow


@compiled(contract=True)
def bidiagonal_squares(A: Array, Q: Array, E: Array, h: Array, w: Array) -> None:
    """Turn each A (k, n), k ≤ n, into a lower bidiagonal B = U A V, U and V orthogonal, and write its squares.

    Householder reflections 1 − h v vᵀ, v = x ± |x| e₁, act on the rows of A from the right and on its columns from
    the left in turn. B is within rounding, 1e-16 |A|, of one with exactly A's singular values; of A Aᵀ this would
    hold for their squares, and σ_min would be known to 1e-8 |A| only.

    Args:
        A: (k, n, BLOCK), overwritten by the vectors v.
        Q: (k, BLOCK), the squares of the diagonal of B, to be written.
        E: (k − 1, BLOCK) or more rows, the squares of what stands below the diagonal, to be written.
        h, w: (BLOCK,), scratch.

    Source: Golub, Van Loan, Matrix Computations, 2013, sections 5.1 and 5.4.
    """
    k, n = A.shape[0], A.shape[1]
    for i in range(k):
        for c in range(BLOCK):
            w[c] = 0.0
        for j in range(i, n):
            for c in range(BLOCK):
                w[c] += A[i, j, c] * A[i, j, c]
        _reflection(w, A[i, i], Q[i], h)
        for row in range(i + 1, k):
            for c in range(BLOCK):
                w[c] = 0.0
            for j in range(i, n):
                for c in range(BLOCK):
                    w[c] += h[c] * A[i, j, c] * A[row, j, c]
            for j in range(i, n):
                for c in range(BLOCK):
                    A[row, j, c] -= w[c] * A[i, j, c]
        if i + 1 == k:
            return
        for c in range(BLOCK):
            w[c] = 0.0
        for row in range(i + 1, k):
            for c in range(BLOCK):
                w[c] += A[row, i, c] * A[row, i, c]
        _reflection(w, A[i + 1, i], E[i], h)
        for j in range(i + 1, n):
            for c in range(BLOCK):
                w[c] = 0.0
            for row in range(i + 1, k):
                for c in range(BLOCK):
                    w[c] += h[c] * A[row, i, c] * A[row, j, c]
            for row in range(i + 1, k):
                for c in range(BLOCK):
                    A[row, j, c] -= w[c] * A[row, i, c]


@compiled(contract=True)
def _reflection(squares: Array, first: Array, kept: Array, h: Array) -> None:
    """Write v₁ = x₁ ± |x|, without cancellation, over x₁, and h = 2/|v|² = 1/(|x|² + |x| |x₁|); keep |x|²."""
    for c in range(BLOCK):
        x, square = first[c], squares[c]
        length = math.sqrt(square)
        half = square + length * abs(x)
        kept[c] = square
        h[c] = 1.0 / half if half > ZERO else 0.0
        first[c] = x + math.copysign(length, x)
