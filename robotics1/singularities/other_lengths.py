"""Conditions on lengths: equations between them that would make more configurations singular."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import sympy

from robotics1.errors import InputError
from robotics1.inputs import real_number
from robotics1.robot.box import JointBox
from robotics1.symbolic.polynomials.evaluation import Evaluated
from robotics1.symbolic.polynomials.factoring import factors
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.symbolic.singular_sets.common_zeros import CommonZeros, singular_loci
from robotics1.symbolic.singular_sets.locus import Locus, Piece
from robotics1.symbolic.singular_sets.locus_sampler import LocusSampler
from robotics1.symbolic.singular_sets.pieces import largest_pieces
from robotics1.symbolic.singular_sets.zeros import Zero, value_of_length
from robotics1.symbolic.writing.sums_of_angles import written_product

if TYPE_CHECKING:
    from robotics1.singularities.result import SingularSet
    from robotics1.symbolic.singular_sets.branch_formulas import SymbolicJacobian

MOST = 6  # equations that are tried
DRAWS = 20  # lengths that are tried for one of them

Parameters = Mapping[sympy.Symbol, float]


def parameter_conditions(found: "SingularSet", *, time_limit: float | None = None) -> tuple[sympy.Eq, ...]:
    """Return the equations that have no solution at the robot's lengths, and bring more singularities at others.

    Each equation that the search has met is tried: of one between lengths, such as a2 − a3 = 0, one length is set so
    that it holds; for one in a joint, such as a2 cos(q3) + a3 = 0 with a2 < a3, lengths are drawn until it has a
    solution. Then the singular set is found again. Those that were not tried in time are left out.

    Args:
        found: a singular set; one that was found by numbers has no equations.
        time_limit: [s], by default that of the set.

    Raises:
        InputError: the set is none, or the time limit is not positive.
    """
    if not hasattr(found, "without_solution") or isinstance(found, type):
        raise InputError(f"parameter_conditions wants the answer of find_singularities, not {found!r}")
    seconds = found.time_limit if time_limit is None else real_number("time_limit", time_limit, positive=True)
    if found.jacobian is None:
        return ()
    limit = TimeLimit(seconds)
    J = found.jacobian
    met: dict[sympy.Expr, Zero] = {}
    try:
        with limit.kept():
            for zero in found.without_solution:
                met[written_product(factors(zero.equation), J.groups)] = zero
    except OutOfTime:
        pass  # the others are left out
    unsigned = {-x if x.could_extract_minus_sign() else x: zero for x, zero in met.items()}
    known = [branch.formulas.piece for branch in (*found.branches, *found.outside) if branch.formulas is not None]
    more = []
    try:
        with limit.kept():
            for x, zero in list(unsigned.items())[:MOST]:
                other = _lengths_with_a_solution(zero, J.parameters, J.box)
                if other is not None and _adds_branches(J, found.generic_rank, *other, known):
                    more.append(sympy.Eq(x, 0))
    except OutOfTime:
        pass  # what has been tried stands
    return tuple(more)


def _lengths_with_a_solution(zero: Zero, parameters: Parameters, box: JointBox) -> tuple[Locus, Parameters] | None:
    """Return lengths of the same signs at which g = 0 has a solution, and the relation between them."""
    g = zero.equation
    F = g.trig_ring
    if not g.symbols & set(F.q):
        solution = value_of_length(g)
        terms = Evaluated(g, parameters).amplitudes.real
        if solution is None or not terms.min() < 0 < terms.max():
            return None
        value = Evaluated(solution.value, parameters)(np.zeros(len(F.q)))
        return Locus(F).where(Zero(g, solution))[0], {**parameters, solution.symbol: value}
    rng = np.random.default_rng(0)
    used = sorted(g.symbols - set(F.q), key=str)
    for _ in range(DRAWS if used else 0):
        other = {**parameters, **{length: parameters[length] * rng.uniform(0.2, 2.0) for length in used}}
        where, _ = Locus(F).where(zero)
        if LocusSampler(Piece(where, other, {}), box).draw(rng) is not None:
            return Locus(F), other
    return None


def _adds_branches(
    J: "SymbolicJacobian", rank: int, where: Locus, parameters: Parameters, known: Sequence[Piece]
) -> bool:
    """Whether there are branches at other lengths that are no part of the known ones."""
    rng = np.random.default_rng(0)
    cases = CommonZeros(parameters)
    pieces, _ = largest_pieces(singular_loci(J.rows.M, rank, where, cases), cases, J.box, rng)
    there = [replace(piece, parameters=parameters) for piece in known]
    samples = [sampler.draw(rng) for sampler in pieces]
    return any(q is not None and not any(old.contains(q) for old in there) for q in samples)
