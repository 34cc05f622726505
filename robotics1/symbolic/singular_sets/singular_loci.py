"""The singular set of a task in exact form: where all minors of the Jacobian's order vanish together."""

from collections.abc import Hashable, Iterable, Iterator
from itertools import product

import numpy as np

from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.symbolic.polynomials.determinants import minors_of_order
from robotics1.symbolic.polynomials.evaluation import evaluated_part
from robotics1.symbolic.polynomials.laurent import Matrix
from robotics1.symbolic.polynomials.time_limit import OutOfTime
from robotics1.symbolic.singular_sets.configurations import Configurations
from robotics1.symbolic.singular_sets.locus import Locus
from robotics1.symbolic.singular_sets.solving import CaseDistinction

POINTS = 4  # at which one piece is compared with another


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
    real = []
    complete = True
    try:
        for piece in (piece for locus in loci for piece in _with_single_values(locus, cases)):
            cases.limit.check()
            if piece.key not in drawn:
                drawn[piece.key] = _points(piece, box, rng)
            points = drawn[piece.key]
            if points:
                real.append((piece, points))
            elif len(piece.locus.implicit) == 1:
                cases.excluded.extend(zero for zero in piece.locus.zeros if zero.part is not None)
    except OutOfTime:
        complete = False
    real.sort(key=lambda item: (-item[0].dimension(item[1][0]), len(item[0].locus.implicit)))
    kept: list[Configurations] = []
    for piece, points in real:
        if not any(all(larger.contains(q) for q in points) for larger in kept):
            kept.append(piece)
    return kept, complete


def _points(piece: Configurations, box: JointBox, rng: np.random.Generator) -> list[Array]:
    found = [piece.random(box, rng) for _ in range(POINTS)]
    return [q for q in found if q is not None]


def _with_single_values(locus: Locus, cases: CaseDistinction) -> Iterator[Configurations]:
    """Yield the locus once for each choice among the values that an equation in one joint allows."""
    q = locus.frequencies.q
    choices = []
    for part in locus.implicit:
        joints = [i for i, symbol in enumerate(q) if symbol in part.symbols]
        if len(joints) == 1:
            values = evaluated_part(part, cases.parameters).zeros_in(joints[0], np.zeros(len(q)))
            choices.append([(joints[0], value) for value in values])
    for choice in product(*choices):
        yield Configurations(locus, cases.parameters, dict(choice))
