"""Where branches of a singular set meet, and where the rank falls further inside one."""

from collections.abc import Hashable, Iterable, Iterator, Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import real_number
from robotics1.singularities.points import SingularPoints, singular_points
from robotics1.singularities.result import Intersections, SingularBranch, SingularSet
from robotics1.singularities.symbolic import branch_of, samples_of
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.symbolic.singular_sets.branch_formulas import SymbolicJacobian
from robotics1.symbolic.singular_sets.common_zeros import CommonZeros, singular_loci
from robotics1.symbolic.singular_sets.locus import Locus
from robotics1.symbolic.singular_sets.pieces import POINTS, Drawn, largest_pieces


def find_intersections(found: SingularSet, *, time_limit: float | None = None) -> Intersections:
    """Return where two branches meet, and where the rank falls further inside one.

    Branches must be in exact form. A piece of another one is there only if the rank is lower on it.

    Args:
        found: a singular set.
        time_limit: [s], by default that of the set.

    Raises:
        InputError: `found` is no singular set, or the time limit is not positive.
    """
    if not isinstance(found, SingularSet):
        raise InputError(f"find_intersections wants the answer of find_singularities, not {found!r}")
    seconds = found.time_limit if time_limit is None else real_number("time_limit", time_limit, positive=True)
    if found.jacobian is None:
        return Intersections((), complete=False)
    rng = np.random.default_rng(0)
    met: list[SingularBranch] = []
    complete = True
    try:
        with TimeLimit(seconds).kept():
            points = singular_points(found.jacobian.robot, found.task, found.box, np.random.default_rng(0))
            search = _Search(points, found.jacobian, CommonZeros(found.jacobian.parameters), rng, {})
            for pieces in search.crossings(found.branches):
                met += pieces
    except OutOfTime:
        complete = False
    kept: list[SingularBranch] = []
    for piece in sorted(met, key=lambda part: -part.dimension):
        if not any(other.rank == piece.rank and all(map(other.contains, piece.samples)) for other in kept):
            kept.append(piece)
    return Intersections(tuple(kept), complete)


class _Search(NamedTuple):
    """What the search needs throughout; `known` is that of `largest_pieces`."""

    points: SingularPoints
    jacobian: SymbolicJacobian
    cases: CommonZeros
    rng: np.random.Generator
    known: dict[Hashable, Drawn]

    def crossings(self, branches: Sequence[SingularBranch]) -> Iterator[list[SingularBranch]]:
        """Yield the pieces that two branches share, and step by step those of lower rank; some more than once.

        Raises:
            OutOfTime: the time is over.
        """
        exact = [branch for branch in branches if branch.formulas is not None]
        for a, b in combinations(exact, 2):
            yield self._pieces(self.cases.common_zeros(_locus(b).equations, _locus(a)), (a, b))
        deeper = exact
        while deeper:
            next_level: dict[Hashable, SingularBranch] = {}
            for branch in (branch for branch in deeper if branch.rank):
                loci = singular_loci(self.jacobian.rows.M, branch.rank, _locus(branch), self.cases)
                parts = self._pieces(loci, (branch,))
                yield parts
                next_level |= {part.require_formulas().piece.key: part for part in parts}
            deeper = list(next_level.values())

    def _pieces(self, loci: Iterable[Locus], within: tuple[SingularBranch, ...]) -> list[SingularBranch]:
        """Return the pieces that are part of all these branches, with samples."""
        found = []
        pieces, all_drawn = largest_pieces(loci, self.cases, self.points.box, self.rng, self.known)
        for sampler in pieces:
            samples = samples_of(self.points, sampler, self.rng, POINTS)
            if samples and all(branch.contains(q) for q in samples for branch in within):
                found.append(branch_of(self.points, self.jacobian, sampler, self.rng))
        if not all_drawn:
            raise OutOfTime
        return found


def _locus(branch: SingularBranch) -> Locus:
    return branch.require_formulas().piece.locus
