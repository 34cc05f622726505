"""Null spaces and ranges of matrices of trigonometric polynomials, by elimination without fractions.

A row is multiplied by powers of 1 + tⱼ², which never vanish, so that its entries are polynomials in the half-angle
tangents and the lengths. There greatest common divisors are cheap, and each row is kept without one.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import reduce

import numpy as np
import sympy
from flint import fmpq, fmpq_mpoly

from robotics1.symbolic.polynomials.half_tangents import (
    context,
    from_numerator,
    highest_multiples,
    highest_powers,
    is_multiple,
    numerator,
    without_squares,
)
from robotics1.symbolic.polynomials.time_limit import check_time, check_time_to_divide
from robotics1.symbolic.polynomials.trig_polynomial import Matrix, TrigPolynomial, TrigRing
from robotics1.symbolic.singular_sets.locus import Locus
from robotics1.symbolic.singular_sets.zeros import Zero, vanishing_lengths

Row = list[fmpq_mpoly]


@dataclass(frozen=True, eq=False)
class Echelon:
    """The reduced echelon form of a matrix on a locus: in the column of a pivot all other rows have zero.

    Attributes:
        trig_ring: of the entries.
        rows: the rows that do not vanish, numerators without common divisor.
        pivots: the column of the pivot of each row.
        columns: n.
    """

    trig_ring: TrigRing
    rows: list[Row]
    pivots: list[int]
    columns: int

    @property
    def row_space(self) -> list[Matrix]:
        """A basis of the row space, each vector (n,)."""
        return [self._vector(row) for row in self.rows]

    @property
    def null(self) -> list[Matrix]:
        """A basis of the null space: one vector (n,) for each column without pivot."""
        one = context(self.trig_ring).constant(1)
        found = []
        for free in (j for j in range(self.columns) if j not in self.pivots):
            vector = [one - one] * self.columns
            vector[free] = one
            for row, j in zip(self.rows, self.pivots, strict=True):
                solved = -vector[free] * row[free]
                vector = [without_squares(self.trig_ring, entry * row[j]) for entry in vector]
                vector[j] = without_squares(self.trig_ring, solved)
                vector = primitive(vector)
            found.append(self._vector(vector))
        return found

    def _vector(self, row: Row) -> Matrix:
        return in_whole_angles(self.trig_ring, row)


def echelon_form(M: Matrix, locus: Locus, parameters: Mapping[sympy.Symbol, float]) -> Echelon:
    """Return the reduced echelon form of M on the locus, at given lengths; the simplest entry that is left is the
    next pivot. What only these lengths make zero, such as a2 − a3, is taken as zero.

    Raises:
        OutOfTime: the time of a limit that is kept is over.
    """
    while True:
        form, relation = _at_lengths(M, locus, parameters)
        if relation is None:
            return form
        locus, _ = locus.where(relation)


def _at_lengths(M: Matrix, locus: Locus, parameters: Mapping[sympy.Symbol, float]) -> tuple[Echelon, Zero | None]:
    """Return the echelon form; or the relation between lengths that makes a pivot zero."""
    F = locus.trig_ring
    equations = [part.numerator for part in locus.implicit]
    left = [_over_common_denominator([locus.reduced(entry) for entry in row]) for row in M]
    done: list[tuple[int, Row]] = []
    relation = None
    while relation is None:
        entries = [(i, j) for i, row in enumerate(left) for j, entry in enumerate(row) if not entry.is_zero()]
        if not entries:
            break
        check_time()
        i, j = min(entries, key=lambda place: (_cost(F, left[place[0]][place[1]]), place))
        pivot = left.pop(i)
        relation = _relation(F, [pivot[j]], parameters)
        pivot = primitive(pivot)
        left = [_eliminated(F, row, pivot, j, equations) for row in left]
        left = [row if _relation(F, row, parameters) else primitive(row) for row in left]
        done = [(k, primitive(_eliminated(F, row, pivot, j, equations))) for k, row in done]
        done.append((j, pivot))
    done.sort(key=lambda item: item[0])
    return Echelon(F, [row for _, row in done], [j for j, _ in done], M.shape[1]), relation


def _relation(F: TrigRing, row: Row, parameters: Mapping[sympy.Symbol, float]) -> Zero | None:
    """Return the relation between lengths that makes the whole row zero, if there is one."""
    alone = _lengths_alone(F, row)
    if alone.is_constant():
        return None
    return vanishing_lengths(from_numerator(F, alone, (0,) * len(F.angles)), parameters)


def primitive_row(vector: Sequence[TrigPolynomial], locus: Locus) -> Row:
    """Return the numerators of a vector on a locus without the greatest common divisor of its entries; the shorter of
    those that stand there and of their remainders after division by the equations of the locus.
    """
    row = _over_common_denominator(vector)
    rest = row
    for part in locus.implicit:
        if not part.numerator.is_constant():
            rest = [_remainder(entry, part.numerator) for entry in rest]
    candidates = [primitive(row)]
    if rest is not row and any(not entry.is_zero() for entry in rest):
        candidates.append(primitive(rest))
    return min(candidates, key=lambda entries: sum(map(len, entries)))


def _remainder(entry: fmpq_mpoly, equation: fmpq_mpoly) -> fmpq_mpoly:
    check_time_to_divide(entry, equation)
    return entry % equation


def in_whole_angles(F: TrigRing, row: Row) -> Matrix:
    """Return numerators over the least powers of 1 + tⱼ² that make all of them polynomials of whole angles."""
    halves = tuple((power + 1) // 2 for power in highest_powers(F, row))
    return np.array([from_numerator(F, entry, halves) for entry in row], dtype=object)


def _over_common_denominator(row: Sequence[TrigPolynomial]) -> Row:
    F = row[0].trig_ring
    generators = context(F).gens()[len(F.ring.symbols) :]
    multiples = [highest_multiples(entry) for entry in row]
    d = [max(column) for column in zip(*multiples, strict=True)]
    found = []
    for entry, own in zip(row, multiples, strict=True):
        N = numerator(entry)
        for t, most, mine in zip(generators, d, own, strict=True):
            N = N * (1 + t**2) ** (most - mine)
        found.append(N)
    return found


def _cost(F: TrigRing, entry: fmpq_mpoly) -> tuple[bool, int]:
    """Entries that cannot vanish are the best pivots, then short ones."""
    used = [bool(e) for e in entry.degrees()]
    joints = [symbol in F.q for symbol in F.ring.symbols] + [True] * len(F.angles)
    return any(a and b for a, b in zip(used, joints, strict=True)), len(entry)


def _eliminated(F: TrigRing, row: Row, pivot: Row, j: int, equations: list[fmpq_mpoly]) -> Row:
    """Return the row with zero in column j; what an implicit equation divides is zero too."""
    if row[j].is_zero():
        return row
    a, b = primitive([pivot[j], row[j]])
    combined = [without_squares(F, a * entry - b * other) for entry, other in zip(row, pivot, strict=True)]
    zero = a - a
    return [zero if any(is_multiple(F, entry, g) for g in equations) else entry for entry in combined]


def primitive(row: Row) -> Row:
    """Return the polynomials divided by their greatest common divisor."""
    nonzero = [entry for entry in row if not entry.is_zero()]
    if not nonzero:
        return row
    divisor = reduce(_common_divisor, nonzero)
    return [entry // divisor for entry in row]


def _common_divisor(a: fmpq_mpoly, b: fmpq_mpoly) -> fmpq_mpoly:
    check_time_to_divide(a, b)
    return a.gcd(b)


def _lengths_alone(F: TrigRing, row: Row) -> fmpq_mpoly:
    """Return the greatest divisor of a row that has lengths alone: that of the coefficients of all else."""
    lengths = len(F.ring.symbols)
    places = [
        *(i for i, symbol in enumerate(F.ring.symbols) if symbol in F.q),
        *range(lengths, lengths + len(F.angles)),
    ]
    coefficients: dict[tuple[int, ...], dict[tuple[int, ...], fmpq]] = {}
    for number, entry in enumerate(row):
        for powers, a in entry.to_dict().items():
            m = tuple(map(int, powers))
            alone = tuple(0 if i in places else e for i, e in enumerate(m))
            coefficients.setdefault((number, *(m[i] for i in places)), {})[alone] = a
    found = context(F).constant(0)
    for terms in coefficients.values():
        found = found.gcd(context(F).from_dict(terms))
        if found.is_constant():
            break
    return found
