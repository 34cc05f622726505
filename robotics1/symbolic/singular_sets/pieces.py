"""The pieces that loci consist of: each once, none inside another, none that is empty.

Equations may touch zero, without a change of sign or touching each other. (q1 − 1/2)² + q2² = 0 is one equation in two
joints, and holds at one point. There its derivatives vanish too; with them the equations fall into factors that
show it: q1 = 1/2, q2 = 0. Where no factor shows it, the values are found in numbers: multiples of π/12 for angles, zero
for slides. With √2 and √3 rounded there may be no exact common zero at all.
"""

from collections.abc import Hashable, Iterable
from dataclasses import replace
from itertools import product

import numpy as np

from robotics1.angles import without_turns
from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.symbolic.polynomials.determinants import minors_of_order
from robotics1.symbolic.polynomials.evaluation import evaluated_factor
from robotics1.symbolic.polynomials.time_limit import OutOfTime, check_time
from robotics1.symbolic.polynomials.trig_polynomial import TrigPolynomial
from robotics1.symbolic.singular_sets.common_zeros import CommonZeros
from robotics1.symbolic.singular_sets.emptiness import have_no_zero
from robotics1.symbolic.singular_sets.locus import Locus, Piece, pieces_of
from robotics1.symbolic.singular_sets.locus_sampler import LocusSampler
from robotics1.symbolic.singular_sets.zeros import Substitution, Zero, angle_zero

POINTS = 4  # at which one piece is compared with another
TOUCHES = 1e-3  # of a gradient, beside the sum of the terms: configurations are within 1e-4 of a zero of order three
NEAR = 1e-6  # of an equation, beside the sum of its terms, for the same reason
DEEPEST = 4  # times that derivatives are added
ROUNDED = 1e-14  # of an equation, beside the sum of its terms: zero but for √2 and √3, which are fractions to 1e-16
MOST_JOINTS = 3  # that the equations tie together
DRAWN = 12  # configurations; none of them may be elsewhere
BESIDE = 0.02  # from a zero, where σ is rounding already, in rad and reaches

Drawn = tuple[LocusSampler, list[Array]]


def largest_pieces(
    loci: Iterable[Locus],
    cases: CommonZeros,
    box: JointBox,
    rng: np.random.Generator,
    known: dict[Hashable, Drawn] | None = None,
) -> tuple[list[LocusSampler], bool]:
    """Return the pieces that have configurations in the box and are part of no other, the larger first, each with what
    draws from it; and whether the time was enough to look at all of them. Pieces in which no configuration was found
    and that are not proven to have none are in `cases.unproven`.

    `known` keeps what was drawn of each piece, for calls that meet the same pieces in the same box again.
    """
    met = {} if known is None else known
    real: list[Drawn] = []
    complete = True
    try:
        pieces = [piece for locus in loci for piece in pieces_of(locus, cases.parameters)]
        for piece in sorted(pieces, key=lambda piece: len(piece.locus.implicit)):
            check_time()
            if piece.key not in met:
                met[piece.key] = _drawn(piece, box, rng)
            sampler, points = met[piece.key]
            inside = points and any(all(map(other.piece.contains, points)) for other, _ in real)
            found = [] if inside else _finer(sampler, points, cases, rng)
            real += found
            if not points and not found:
                _prove_empty(piece, box, cases)
                if len(piece.locus.implicit) == 1:
                    cases.excluded.extend(zero for zero in piece.locus.zeros if zero.part is not None)
    except OutOfTime:
        complete = False
    real.sort(key=lambda item: (-item[0].piece.dimension(item[1][0]), len(item[0].piece.locus.implicit)))
    kept: list[LocusSampler] = []
    for sampler, points in real:
        if not any(all(larger.piece.contains(q) for q in points) for larger in kept):
            kept.append(sampler)
    return kept, complete


def _drawn(piece: Piece, box: JointBox, rng: np.random.Generator) -> Drawn:
    """Return some configurations of a piece in the box, with what draws them."""
    sampler = LocusSampler(piece, box)
    found = [sampler.draw(rng) for _ in range(POINTS)]
    return sampler, [q for q in found if q is not None]


def _prove_empty(piece: Piece, box: JointBox, cases: CommonZeros) -> None:
    """Try to prove that a piece has no configuration in the box, and note it in `cases` if that fails."""
    fixed = piece.with_pinned(np.zeros(len(piece.angles)))
    joints = [i for i in _tied(piece) if i not in piece.pinned]
    if not have_no_zero(piece.equations, box, fixed, joints):
        cases.unproven.append(piece.locus)


def _tied(piece: Piece) -> list[int]:
    """Return the joints that the implicit equations tie together."""
    locus = piece.locus
    return [i for i, symbol in enumerate(locus.trig_ring.q) if any(symbol in p.symbols for p in locus.implicit)]


def _finer(
    sampler: LocusSampler, points: list[Array], cases: CommonZeros, rng: np.random.Generator, depth: int = 0
) -> list[Drawn]:
    """Return the piece with the configurations that were drawn of it; or, if its equations hold at single values, or
    have no independent gradients at any of them, if there are any, the smaller pieces that it consists of, with theirs.

    Raises:
        OutOfTime: the time is over.
    """
    piece, box = sampler.piece, sampler.box
    single = [_drawn(found, box, rng) for found in _at_single_values(sampler, cases, rng)]
    if single:
        return [(found, at) for found, at in single if at]
    whole = [(sampler, points)] if points else []
    seen = points or len(piece.locus.implicit) == 1  # with several, a search that finds nothing is believed
    if not seen or depth == DEEPEST or piece.is_regular or not all(piece.is_degenerate(q, TOUCHES) for q in points):
        return whole
    smaller: list[Drawn] = []
    apart = replace(cases, excluded=[])  # what derivatives exclude is no condition on lengths
    for locus in apart.common_zeros(_dependence(piece.locus), piece.locus):
        for part in pieces_of(locus, cases.parameters):
            smaller += _finer(*_drawn(part, box, rng), cases, rng, depth + 1)
    holds = all(any(part.piece.contains(q, NEAR) for part, _ in smaller) for q in points)
    return smaller if smaller and holds else whole


def _dependence(locus: Locus) -> list[TrigPolynomial]:
    """Return what vanishes where the gradients of the implicit equations are dependent: the minors of the matrix of
    their derivatives.
    """
    equations = [part.whole for part in locus.implicit]
    joints = [symbol for symbol in locus.trig_ring.q if any(symbol in f.symbols for f in equations)]
    slopes = np.array([[f.derivative(symbol) for symbol in joints] for f in equations], dtype=object)
    if len(equations) > len(joints):
        return list(slopes.flat)
    return list(minors_of_order(slopes, len(equations)))


def _at_single_values(sampler: LocusSampler, cases: CommonZeros, rng: np.random.Generator) -> list[Piece]:
    """Return the pieces at which the joints of all implicit equations have a value, if these are all configurations of
    the piece; nothing if the equations hold elsewhere too, or at other values. Where it is not proven that they are
    all, the piece is in `cases.unproven`.
    """
    piece, box = sampler.piece, sampler.box
    locus = piece.locus
    joints = _tied(piece)
    if not 1 < len(joints) <= min(MOST_JOINTS, len(locus.implicit)) or piece.pinned:
        return []
    values = _special_zeros(piece, joints)
    if not len(values):
        return []
    drawn = [q for q in map(sampler.nearest, box.random(rng, DRAWN)) if q is not None]
    for q in drawn:
        apart = q[joints] - values
        apart = np.where(piece.angles[joints], without_turns(apart), apart / box.unit[joints])
        if np.abs(apart).max(axis=1).min() > BESIDE:
            return []
    known = np.zeros((len(values), len(piece.angles)))
    known[:, joints] = values
    if not have_no_zero(piece.equations, box, known[0], joints, apart_from=known, beside=BESIDE):
        cases.unproven.append(locus)
    return [Piece(_with_values(locus, joints, value), piece.parameters, {}) for value in values]


def _special_zeros(piece: Piece, joints: list[int]) -> Array:
    """Return the multiples of π/12, and zeros of slides, at which all implicit equations hold, (k, joints)."""
    choices = [range(-11, 13) if piece.angles[i] else (0,) for i in joints]
    values = np.array(list(product(*choices))) * np.pi / 12
    q = np.zeros((len(values), len(piece.angles)))
    q[:, joints] = values
    for part in piece.locus.implicit:
        f = evaluated_factor(part, piece.parameters)
        q = q[np.abs(f.at_many(q)) <= ROUNDED * f.size]
    return q[:, joints]


def _with_values(locus: Locus, joints: list[int], values: Array) -> Locus:
    F = locus.trig_ring
    for i, value in zip(joints, values, strict=True):
        symbol = F.q[i]
        if symbol in F.angles:
            zero = angle_zero(symbol, F.turn(round(value * 12 / np.pi)))
        else:
            zero = Zero(F.constant(F.ring(symbol)), Substitution(symbol, F.constant(0)))
        locus, _ = locus.where(zero)  # the equations hold, but for rounding
    return replace(locus, in_numbers=True)
