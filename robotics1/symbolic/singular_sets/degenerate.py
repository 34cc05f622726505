"""Pieces on which equations touch zero, without a change of sign or touching each other: what they are in truth.

(q1 − 1/2)² + q2² = 0 is one equation in two joints, and holds at one point. There its derivatives vanish too; with them
the equations fall into factors that say so: q1 = 1/2, q2 = 0.
"""

from collections.abc import Iterator
from dataclasses import replace
from itertools import product

import numpy as np

from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.symbolic.polynomials.determinants import minors_of_order
from robotics1.symbolic.polynomials.evaluation import evaluated_part
from robotics1.symbolic.polynomials.laurent import Laurent
from robotics1.symbolic.singular_sets.configurations import Configurations
from robotics1.symbolic.singular_sets.isolated_zeros import at_single_values
from robotics1.symbolic.singular_sets.locus import Locus
from robotics1.symbolic.singular_sets.solving import CaseDistinction

POINTS = 4  # at which one piece is compared with another
TOUCHES = 1e-3  # of a gradient, beside the sum of the terms: configurations are within 1e-4 of a zero of order three
NEAR = 1e-6  # of an equation, beside the sum of its terms, for the same reason
DEEPEST = 4  # times that derivatives are added

Drawn = tuple[Configurations, list[Array]]


def points_of(piece: Configurations, box: JointBox, rng: np.random.Generator) -> list[Array]:
    """Return some configurations of a piece in the box."""
    found = [piece.random(box, rng) for _ in range(POINTS)]
    return [q for q in found if q is not None]


def finer(
    piece: Configurations,
    points: list[Array],
    cases: CaseDistinction,
    box: JointBox,
    rng: np.random.Generator,
    depth: int = 0,
) -> list[Drawn]:
    """Return the piece with the configurations that were drawn of it; or, if its equations hold at single values, or
    have no independent gradients at any of them, if there are any, the smaller pieces that it consists of, with theirs.

    Raises:
        OutOfTime: the time is over.
    """
    single = [(found, points_of(found, box, rng)) for found in at_single_values(piece, box, rng)]
    if single:
        return [(found, at) for found, at in single if at]
    whole = [(piece, points)] if points else []
    seen = points or len(piece.locus.implicit) == 1  # with several, a search that finds nothing is believed
    if not seen or depth == DEEPEST or piece.is_regular or not all(piece.is_degenerate(q, TOUCHES) for q in points):
        return whole
    smaller: list[Drawn] = []
    apart = replace(cases, excluded=[])  # what derivatives exclude says nothing of lengths
    for locus in apart.common_zeros(_dependence(piece.locus), piece.locus):
        for part in with_single_values(locus, cases):
            at = points_of(part, box, rng)
            smaller += finer(part, at, cases, box, rng, depth + 1)
    holds = all(any(part.contains(q, NEAR) for part, _ in smaller) for q in points)
    return smaller if smaller and holds else whole


def _dependence(locus: Locus) -> list[Laurent]:
    """Return what vanishes where the gradients of the implicit equations are dependent: the minors of the matrix of
    their derivatives.
    """
    equations = [part.whole for part in locus.implicit]
    joints = [symbol for symbol in locus.frequencies.q if any(symbol in f.symbols for f in equations)]
    slopes = np.array([[f.derivative(symbol) for symbol in joints] for f in equations], dtype=object)
    if len(equations) > len(joints):
        return list(slopes.flat)
    return list(minors_of_order(slopes, len(equations)))


def with_single_values(locus: Locus, cases: CaseDistinction) -> Iterator[Configurations]:
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
