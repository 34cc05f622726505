"""The singular set of a task in exact form: where all minors of the Jacobian's order vanish together."""

from collections.abc import Hashable, Iterable, Iterator

import numpy as np

from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.symbolic.polynomials.determinants import minors_of_order
from robotics1.symbolic.polynomials.laurent import Matrix
from robotics1.symbolic.polynomials.time_limit import OutOfTime
from robotics1.symbolic.singular_sets.configurations import Configurations
from robotics1.symbolic.singular_sets.degenerate import Drawn, finer, points_of, with_single_values
from robotics1.symbolic.singular_sets.locus import Locus
from robotics1.symbolic.singular_sets.solving import CaseDistinction


def singular_loci(M: Matrix, rank: int, where: Locus, cases: CaseDistinction) -> Iterator[Locus]:
    """Yield pieces of a locus that together hold all its points at which the rank of M is below `rank`.

    Raises:
        OutOfTime: the time is over.
    """
    M = np.array([row for row in ([where.reduced(entry) for entry in row] for row in M) if any(row)], dtype=object)
    if len(M) < rank:
        return iter([where])  # J has fewer rows than the rank that is looked for: all of the locus
    M = M[:, [j for j in range(M.shape[1]) if any(M[:, j])]]
    return cases.common_zeros(list(minors_of_order(M, rank, cases.limit)), where)


def largest_pieces(
    loci: Iterable[Locus],
    cases: CaseDistinction,
    box: JointBox,
    rng: np.random.Generator,
    known: dict[Hashable, list[Array]] | None = None,
) -> tuple[list[Configurations], bool]:
    """Return the pieces that have configurations in the box and are part of no other, the larger first; and whether
    the time was enough to look at all of them.

    `known` keeps configurations of each piece, for calls that meet the same pieces in the same box again.
    """
    drawn = {} if known is None else known
    real: list[Drawn] = []
    complete = True
    try:
        pieces = [piece for locus in loci for piece in with_single_values(locus, cases)]
        for piece in sorted(pieces, key=lambda piece: len(piece.locus.implicit)):
            cases.limit.check()
            if piece.key not in drawn:
                drawn[piece.key] = points_of(piece, box, rng)
            points = drawn[piece.key]
            inside = points and any(all(map(other.contains, points)) for other, _ in real)
            found = [] if inside else finer(piece, points, cases, box, rng)
            real += found
            if not points and not found and len(piece.locus.implicit) == 1:
                cases.excluded.extend(zero for zero in piece.locus.zeros if zero.part is not None)
    except OutOfTime:
        complete = False
    real.sort(key=lambda item: (-item[0].dimension(item[1][0]), len(item[0].locus.implicit)))
    kept: list[Configurations] = []
    for piece, points in real:
        if not any(all(larger.contains(q) for q in points) for larger in kept):
            kept.append(piece)
    return kept, complete
