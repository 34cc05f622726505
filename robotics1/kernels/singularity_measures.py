"""How near to singular a task is, at many configurations: σ_min, σ_max and the product of the singular values of J."""

import math
from typing import NamedTuple

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.block_jacobian import BLOCK, jacobian_block, place_block, task_rows_block
from robotics1.kernels.chain import ChainArrays
from robotics1.kernels.compilation import COMPILED, compiled
from robotics1.kernels.extreme_singular_values import largest_eigenvalues, smallest_eigenvalues

ZERO = 1e-290  # |x|² of a vector that needs no reflection: its inverse would overflow


class SingularityMeasures(NamedTuple):
    """Of each of N configurations; `largest` is empty where it was not asked for.

    Attributes:
        smallest: (N,) σ_min of J.
        product: (N,) √det(J Jᵀ), the product of the singular values; of a tall J √det(JᵀJ).
        largest: (N,) σ_max.
    """

    smallest: Array
    product: Array
    largest: Array


def singularity_measures(
    chain: ChainArrays, S: Array, q: Array, *, largest: bool = False, J: Array | None = None
) -> SingularityMeasures:
    """Return σ_min and more of J = S J_frame at many configurations, to 3e-14 of |J| at worst.

    Args:
        chain: the constants of the chain.
        S: (m, 6) the rows of the task, m ≤ 6: ṙ = S V.
        q: (n, N) configurations, one a column.
        largest: whether σ_max is wanted.
        J: (m, n, N), to be written, if it is wanted.
    """
    count = q.shape[1]
    if not COMPILED:
        jacobians = task_jacobians(chain, S, q)
        if J is not None:
            J[:] = jacobians
        return measures_of(jacobians, min(jacobians.shape[:2]))
    k = min(len(S), len(q))
    answer = SingularityMeasures(np.empty(count), np.empty(count), np.empty(count if largest else 0))
    squares = np.empty((2 * k, count if largest else 0))
    rows, columns = np.ascontiguousarray(S), np.ascontiguousarray(q)  # other layouts would be compiled anew
    given = np.empty((0, 0, 0)) if J is None else J
    measure_blocks(chain, rows, columns, given, squares, answer.smallest, answer.product)
    if largest:
        largest_blocks(squares, answer.largest)
    return answer


def measures_of(J: Array, rank: int) -> SingularityMeasures:
    """Return the measures of the first `rank` singular values of each J, (m, n, N), by LAPACK."""
    sigma = np.linalg.svd(np.moveaxis(J, 2, 0), compute_uv=False)[:, :rank]
    return SingularityMeasures(sigma[:, -1], np.prod(sigma, axis=1), sigma[:, 0])


@compiled()
def measure_blocks(
    chain: ChainArrays, S: Array, q: Array, J: Array, squares: Array, smallest: Array, product: Array
) -> None:
    """Go through the configurations block by block; the last block is filled up with its last configuration.

    J (m, n, N), and squares (2 k, N), those of the bidiagonal matrix, are written unless they are empty.
    """
    n, count, m = q.shape[0], q.shape[1], S.shape[0]
    k = min(m, n)
    T, joint_axes, work = np.empty((3, 4, BLOCK)), np.empty((len(chain.ratio), 6, BLOCK)), np.empty((6, BLOCK))
    block, frame, A = np.empty((n, BLOCK)), np.empty((6, n, BLOCK)), np.empty((k, max(m, n), BLOCK))
    Q, E = np.empty((k, BLOCK)), np.zeros((k, BLOCK))
    for start in range(0, count, BLOCK):
        size = min(BLOCK, count - start)
        for i in range(n):
            for c in range(BLOCK):
                block[i, c] = q[i, start + min(c, size - 1)]
        place_block(chain, block, T, joint_axes, work)
        jacobian_block(chain, T, joint_axes, frame)
        task_rows_block(S, frame, A)
        if J.size > 0:
            _keep(A, start, size, J)
        bidiagonal_squares(A, Q, E, work[0], work[1])
        for c in range(size):
            product[start + c] = 1.0
        for i in range(k):
            for c in range(size):
                product[start + c] *= math.sqrt(Q[i, c])
        if squares.size > 0:
            for i in range(k):
                for c in range(size):
                    squares[i, start + c], squares[k + i, start + c] = Q[i, c], E[i, c]
        smallest_eigenvalues(Q, E, k, work[0], work[1:])
        for c in range(size):
            smallest[start + c] = math.sqrt(work[0, c])


@compiled()
def largest_blocks(squares: Array, largest: Array) -> None:
    """Write σ_max, (N,), of bidiagonal matrices: a kernel of its own, since few need it and it compiles long."""
    k, count = squares.shape[0] // 2, squares.shape[1]
    Q, E, work = np.empty((k, BLOCK)), np.empty((k, BLOCK)), np.empty((7, BLOCK))
    for start in range(0, count, BLOCK):
        size = min(BLOCK, count - start)
        for i in range(k):
            for c in range(BLOCK):
                place = start + min(c, size - 1)
                Q[i, c], E[i, c] = squares[i, place], squares[k + i, place]
        largest_eigenvalues(Q, E, k, work[0], work[1:])
        for c in range(size):
            largest[start + c] = math.sqrt(work[0, c])


@compiled(inner=True)
def _keep(A: Array, start: int, size: int, J: Array) -> None:
    """Copy a block of Jacobians, or of their transposes, to its place among all."""
    m, n = J.shape[0], J.shape[1]
    for i in range(m):
        for j in range(n):
            a, b = (i, j) if m <= n else (j, i)
            for c in range(size):
                J[i, j, start + c] = A[a, b, c]


@compiled(contract=True, inner=True)
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


@compiled(contract=True, inner=True)
def _reflection(squares: Array, first: Array, kept: Array, h: Array) -> None:
    """Write v₁ = x₁ ± |x|, without cancellation, over x₁, and h = 2/|v|² = 1/(|x|² + |x| |x₁|); keep |x|²."""
    for c in range(BLOCK):
        x, square = first[c], squares[c]
        length = math.sqrt(square)
        half = square + length * abs(x)
        kept[c] = square
        h[c] = 1.0 / half if half > ZERO else 0.0
        first[c] = x + math.copysign(length, x)


def task_jacobians(chain: ChainArrays, S: Array, q: Array) -> Array:
    """Return S J_frame, (m, n, N), at the configurations q (n, N).

    Args:
        chain: the constants of the chain.
        S: (m, 6) the rows of the task.
        q: (n, N) configurations, one a column.
    """
    n, count = q.shape
    T = np.repeat(chain.placements[0][:, :, None], count, axis=2)
    axes, points = [], []
    motions = chain.ratio[:, None] * q[chain.coordinate]
    for P, prismatic, motion in zip(chain.placements[1:], chain.prismatic, motions, strict=True):
        axes.append(T[:, 2].copy())
        points.append(T[:, 3].copy())
        if prismatic:
            T[:, 3] += motion * T[:, 2]
        else:
            c, s = np.cos(motion), np.sin(motion)
            T[:, 0], T[:, 1] = c * T[:, 0] + s * T[:, 1], c * T[:, 1] - s * T[:, 0]
        p = T[:, 3]
        T = np.einsum("ijc,jk->ikc", T[:, :3], P)
        T[:, 3] += p
    J = np.zeros((6, n, count))
    for joint, (z, o) in enumerate(zip(axes, points, strict=True)):
        column, factor = chain.coordinate[joint], chain.ratio[joint]
        if chain.prismatic[joint]:
            J[:3, column] += factor * z
        else:
            J[:3, column] += factor * np.cross(z, T[:, 3] - o, axis=0)
            J[3:, column] += factor * z
    return np.asarray(np.einsum("ir,rjc->ijc", S, J))
