"""Determinants of matrices of trigonometric polynomials."""

from collections.abc import Callable, Iterator
from functools import cache
from itertools import combinations

from robotics1.symbolic.polynomials.time_limit import UNLIMITED, TimeLimit
from robotics1.symbolic.polynomials.trig_polynomial import Matrix, TrigPolynomial


def determinant(M: Matrix, limit: TimeLimit = UNLIMITED) -> TrigPolynomial:
    """Return det M of a square matrix."""
    return _minors_of(M, limit)(tuple(range(len(M))))


def minors(M: Matrix, limit: TimeLimit = UNLIMITED) -> dict[tuple[int, ...], TrigPolynomial]:
    """Return the largest minors of a wide or tall matrix: the columns (or rows) that are left out → the minor."""
    wide = M if M.shape[0] <= M.shape[1] else M.T
    m, n = wide.shape
    minor = _minors_of(wide, limit)
    return {out: minor(tuple(j for j in range(n) if j not in out)) for out in combinations(range(n), n - m)}


def minors_of_order(M: Matrix, r: int, limit: TimeLimit = UNLIMITED) -> Iterator[TrigPolynomial]:
    """Yield the minors of r rows and r columns."""
    for rows in combinations(range(M.shape[0]), r):
        minor = _minors_of(M[list(rows)], limit)
        for columns in combinations(range(M.shape[1]), r):
            yield minor(columns)


def _minors_of(M: Matrix, limit: TimeLimit) -> Callable[[tuple[int, ...]], TrigPolynomial]:
    """Return the function columns → det M[:, columns], expanded along the rows; each minor of the lower rows is
    found once.
    """
    zero = M[0, 0].trig_ring.constant(0)

    @cache
    def minor(columns: tuple[int, ...]) -> TrigPolynomial:
        """The minor of these columns and of as many rows, the last ones."""
        limit.check()
        row = M[len(M) - len(columns)]
        if len(columns) == 1:
            return row[columns[0]]  # type: ignore[no-any-return]
        total: TrigPolynomial = zero
        for place, column in enumerate(columns):
            if row[column]:
                term = row[column] * minor(columns[:place] + columns[place + 1 :])
                total = total - term if place % 2 else total + term
        return total

    return minor
