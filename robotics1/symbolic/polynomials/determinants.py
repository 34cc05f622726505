"""Determinants of matrices of polynomials, of any kind that adds and multiplies."""

from collections.abc import Callable, Iterator
from functools import cache
from itertools import combinations
from typing import Any

from robotics1.symbolic.polynomials.time_limit import check_time
from robotics1.symbolic.polynomials.trig_polynomial import Matrix


def minors(M: Matrix) -> dict[tuple[int, ...], Any]:
    """Return the largest minors of a wide or tall matrix: the columns (or rows) that are left out → the minor."""
    wide = M if M.shape[0] <= M.shape[1] else M.T
    m, n = wide.shape
    minor = _minors_of(wide)
    return {out: minor(tuple(j for j in range(n) if j not in out)) for out in combinations(range(n), n - m)}


def minors_of_order(M: Matrix, r: int) -> Iterator[Any]:
    """Yield the minors of r rows and r columns."""
    for rows in combinations(range(M.shape[0]), r):
        minor = _minors_of(M[list(rows)])
        for columns in combinations(range(M.shape[1]), r):
            yield minor(columns)


def _minors_of(M: Matrix) -> Callable[[tuple[int, ...]], Any]:
    """Return the function columns → det M[:, columns], expanded along the rows; each minor of the lower rows is
    found once.
    """

    @cache
    def minor(columns: tuple[int, ...]) -> Any:
        """The minor of these columns and of as many rows, the last ones."""
        check_time()
        row = M[len(M) - len(columns)]
        if len(columns) == 1:
            return row[columns[0]]
        total = row[0] - row[0]
        for place, column in enumerate(columns):
            if row[column]:
                term = row[column] * minor(columns[:place] + columns[place + 1 :])
                total = total - term if place % 2 else total + term
        return total

    return minor
