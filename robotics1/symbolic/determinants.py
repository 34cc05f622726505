"""Determinants of matrices of trigonometric polynomials."""

from functools import cache
from itertools import combinations

from robotics1.symbolic.chain import Matrix
from robotics1.symbolic.laurent import Laurent


def determinant(M: Matrix) -> Laurent:
    """Return det M of a square matrix, expanded along its rows; each minor of the lower rows is found once."""
    n = len(M)
    zero = M[0, 0].frequencies.constant(0)

    @cache
    def minor(row: int, columns: tuple[int, ...]) -> Laurent:
        """The minor of the rows from `row` on and of these columns."""
        if row == n - 1:
            last: Laurent = M[row, columns[0]]
            return last
        total: Laurent = zero
        for place, column in enumerate(columns):
            if M[row, column]:
                term = M[row, column] * minor(row + 1, columns[:place] + columns[place + 1 :])
                total = total - term if place % 2 else total + term
        return total

    return minor(0, tuple(range(n)))


def minors(M: Matrix) -> dict[tuple[int, ...], Laurent]:
    """Return the largest minors of a wide or tall matrix: the columns (or rows) that are left out → the minor."""
    m, n = M.shape
    order = range(max(m, n))
    found = {}
    for left_out in combinations(order, abs(n - m)):
        kept = [i for i in order if i not in left_out]
        found[left_out] = determinant(M[:, kept] if n > m else M[kept, :])
    return found
