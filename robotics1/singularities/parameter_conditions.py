"""Conditions on lengths: equations between them that would make more configurations singular."""

from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np
import sympy

from robotics1.robot.box import JointBox
from robotics1.singularities.result import SingularBranch
from robotics1.singularities.symbolic import SymbolicSearch
from robotics1.symbolic.polynomials.evaluation import Evaluated
from robotics1.symbolic.polynomials.factoring import factors
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.symbolic.singular_sets.configurations import Configurations
from robotics1.symbolic.singular_sets.locus import Locus
from robotics1.symbolic.singular_sets.singular_loci import largest_pieces, singular_loci
from robotics1.symbolic.singular_sets.zeros import Zero, value_of_length
from robotics1.symbolic.writing.sums_of_angles import written_product

MOST = 6  # equations that are tried
DRAWS = 20  # lengths that are tried for one of them

Parameters = Mapping[sympy.Symbol, float]


def conditions_on_lengths(search: SymbolicSearch, branches: Iterable[SingularBranch]) -> tuple[sympy.Eq, ...]:
    """Return the equations that have no solution at the robot's lengths, and bring more singularities at others.

    Each is tried: of an equation between lengths, such as a2 − a3 = 0, one length is set so that it holds; for one
    in a joint, such as a2 cos(q3) + a3 = 0 with a2 < a3, lengths are drawn until it has a solution. Then the singular
    set is found again.
    """
    search = replace(search, cases=replace(search.cases, limit=TimeLimit(search.cases.limit.seconds)))
    met: dict[sympy.Expr, Zero] = {}
    try:
        with search.cases.limit.kept():
            for zero in search.cases.excluded:
                met[written_product(factors(zero.equation), search.groups)] = zero
    except OutOfTime:
        pass  # the others are left out
    unsigned = {-x if x.could_extract_minus_sign() else x: zero for x, zero in met.items()}
    known = list(branches)
    telling = []
    try:
        with search.cases.limit.kept():
            for x, zero in list(unsigned.items())[:MOST]:
                other = _lengths_with_a_solution(zero, search.cases.parameters, search.anywhere)
                if other is not None and _adds_branches(search, *other, known):
                    telling.append(sympy.Eq(x, 0))
    except OutOfTime:
        pass  # what has been tried stands
    return tuple(telling)


def _lengths_with_a_solution(zero: Zero, parameters: Parameters, box: JointBox) -> tuple[Locus, Parameters] | None:
    """Return lengths of the same signs at which g = 0 has a solution, and the relation between them."""
    g = zero.equation
    F = g.frequencies
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
        if Configurations(where, other, {}).random(box, rng) is not None:
            return Locus(F), other
    return None


def _adds_branches(
    search: SymbolicSearch, where: Locus, parameters: Parameters, branches: list[SingularBranch]
) -> bool:
    """Whether there are branches at other lengths that are no part of the known ones."""
    rng = np.random.default_rng(0)
    cases = replace(search.cases, parameters=parameters, excluded=[])
    loci = singular_loci(search.rows.M, search.points.rank, where, cases)
    pieces, _ = largest_pieces(loci, cases, search.anywhere, rng)
    known = [
        replace(branch.formulas.configurations, parameters=parameters)
        for branch in branches
        if branch.formulas is not None
    ]
    samples = [piece.random(search.anywhere, rng) for piece in pieces]
    return any(q is not None and not any(old.contains(q) for old in known) for q in samples)
