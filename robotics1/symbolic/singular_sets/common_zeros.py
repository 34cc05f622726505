"""Common zeros of trigonometric polynomials, by cases: one factor after the other is taken to be zero."""

from collections.abc import Hashable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field

import numpy as np
import sympy

from robotics1.symbolic.polynomials.determinants import minors_of_order
from robotics1.symbolic.polynomials.time_limit import check_time
from robotics1.symbolic.polynomials.trig_polynomial import Matrix, TrigPolynomial
from robotics1.symbolic.singular_sets.locus import Locus
from robotics1.symbolic.singular_sets.zeros import Zero, coincidences, zeros


@dataclass(frozen=True, eq=False)
class CommonZeros:
    """The search for common zeros at given lengths.

    Attributes:
        parameters: the lengths.
        excluded: equations that were met and have no solution at these lengths, such as a2 − a3.
        unproven: what may have common zeros that were not found.
    """

    parameters: Mapping[sympy.Symbol, float]
    excluded: list[Zero] = field(default_factory=list)
    unproven: list[Locus] = field(default_factory=list)

    def common_zeros(self, polynomials: Iterable[TrigPolynomial], locus: Locus) -> Iterator[Locus]:
        """Yield pieces of the locus that together hold all points at which every polynomial vanishes.

        A product vanishes where one of its factors does: the polynomial with the fewest factors is chosen, and each
        of them is set to zero in turn, which leaves simpler polynomials. Pieces may hold others.

        Raises:
            OutOfTime: the time of a limit that is kept is over before the last piece was found.
        """
        yield from self._common_zeros(polynomials, locus, set())

    def _common_zeros(self, polynomials: Iterable[TrigPolynomial], locus: Locus, met: set[Hashable]) -> Iterator[Locus]:
        """Yield as `common_zeros`; what has been met, by setting the same factors to zero in another order, once."""
        left = {frozenset(f.terms.items()): f for f in map(locus.reduced, polynomials) if f}
        case = locus.key, frozenset(left)
        if case in met:
            return
        met.add(case)
        if not left:
            yield from self._at_equal_lengths(locus, met)
            return
        for zero in min(map(self._cases, left.values()), key=_cost):
            if not zero.real:
                self.excluded.append(zero)
                continue
            part, reopened = locus.where(zero)
            yield from self._common_zeros([*left.values(), *reopened], part, met)

    def _at_equal_lengths(self, locus: Locus, met: set[Hashable]) -> Iterator[Locus]:
        """Yield the locus, in pieces if one of its equations falls into factors because two lengths are equal:
        a cos(q2) + a cos(q2 + q3) = 2 a cos(q2 + q3/2) cos(q3/2).
        """
        for part in locus.implicit:
            relations = coincidences(part.trig_ring, self.parameters, part.symbols)
            g = part.whole
            for relation in relations:
                g = relation.substitution(g) if relation.substitution is not None else g
            cases = [zero for zero in self._cases(g) if zero.real] if relations else []
            if len(cases) > 1 or any(zero.substitution is not None for zero in cases):
                reopened: list[TrigPolynomial] = []
                for relation in relations:
                    locus, changed = locus.where(relation)
                    reopened += changed
                yield from self._common_zeros(map(locus.reduced, reopened), locus, met)
                return
        yield locus

    def _cases(self, f: TrigPolynomial) -> list[Zero]:
        check_time()
        return zeros(f, self.parameters)


def singular_loci(M: Matrix, rank: int, where: Locus, cases: CommonZeros) -> Iterator[Locus]:
    """Yield pieces of a locus that together hold all its points at which the rank of M is below `rank`: there all
    minors of that order vanish.

    Raises:
        OutOfTime: the time of a limit that is kept is over.
    """
    M = np.array([row for row in ([where.reduced(entry) for entry in row] for row in M) if any(row)], dtype=object)
    if len(M) < rank:
        return iter([where])  # J has fewer rows than the rank that is looked for: all of the locus
    M = M[:, [j for j in range(M.shape[1]) if any(M[:, j])]]
    return cases.common_zeros(list(minors_of_order(M, rank)), where)


def _cost(cases: list[Zero]) -> tuple[int, int, int]:
    """Values of joints first, then few cases, then short equations."""
    real = [zero for zero in cases if zero.real]
    implicit = [zero for zero in real if zero.substitution is None]
    return len(implicit), len(real), sum(len(zero.equation.terms) for zero in implicit)
