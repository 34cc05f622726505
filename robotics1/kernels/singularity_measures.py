"""How near to singular a task is, at many configurations: σ_min, σ_max and the product of the singular values of J."""

import math
from typing import NamedTuple

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.array_jacobian import task_jacobians
from robotics1.kernels.bidiagonal import bidiagonal_squares
from robotics1.kernels.block_jacobian import BLOCK, jacobian_block, place_block, task_rows_block
from robotics1.kernels.chain import ChainArrays, Indices
from robotics1.kernels.compilation import COMPILED, compiled
from robotics1.kernels.extreme_singular_values import largest_eigenvalues, smallest_eigenvalues


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
    measure_blocks(*chain, rows, columns, given, squares, answer.smallest, answer.product)
    if largest:
        largest_blocks(squares, answer.largest)
    return answer


def measures_of(J: Array, rank: int) -> SingularityMeasures:
    """Return the measures of the first `rank` singular values of each J, (m, n, N), by LAPACK."""
    sigma = np.linalg.svd(np.moveaxis(J, 2, 0), compute_uv=False)[:, :rank]
    return SingularityMeasures(sigma[:, -1], np.prod(sigma, axis=1), sigma[:, 0])


@compiled()
def measure_blocks(
    placements: Array,
    prismatic: Indices,
    coordinate: Indices,
    ratio: Array,
    S: Array,
    q: Array,
    J: Array,
    squares: Array,
    smallest: Array,
    product: Array,
) -> None:
    """Go through the configurations block by block; the last block is filled up with its last configuration.

    J (m, n, N), and squares (2 k, N), those of the bidiagonal matrix, are written unless they are empty.
    """
    n, count, m = q.shape[0], q.shape[1], S.shape[0]
    k = min(m, n)
    T, joint_axes, work = np.empty((3, 4, BLOCK)), np.empty((len(coordinate), 6, BLOCK)), np.empty((6, BLOCK))
    block, frame, A = np.empty((n, BLOCK)), np.empty((6, n, BLOCK)), np.empty((k, max(m, n), BLOCK))
    Q, E = np.empty((k, BLOCK)), np.zeros((k, BLOCK))
    for start in range(0, count, BLOCK):
        size = min(BLOCK, count - start)
        for i in range(n):
            for c in range(BLOCK):
                block[i, c] = q[i, start + min(c, size - 1)]
        place_block(placements, prismatic, coordinate, ratio, block, T, joint_axes, work)
        jacobian_block(prismatic, coordinate, ratio, T, joint_axes, frame)
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


@compiled()
def _keep(A: Array, start: int, size: int, J: Array) -> None:
    """Copy a block of Jacobians, or of their transposes, to its place among all."""
    m, n = J.shape[0], J.shape[1]
    for i in range(m):
        for j in range(n):
            a, b = (i, j) if m <= n else (j, i)
            for c in range(size):
                J[i, j, start + c] = A[a, b, c]
