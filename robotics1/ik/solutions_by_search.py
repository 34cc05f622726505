"""The solutions of a target that descents from random starts lead to: some of them, or a proof that there are none."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from robotics1.ik.boundary_distance import BOUNDARY, Root, boundary_distance, distance_of_singular
from robotics1.ik.descent import REACHED, End
from robotics1.ik.families import Families
from robotics1.ik.proof import is_out_of_reach
from robotics1.ik.result import IKStatus
from robotics1.ik.scaled_task import ScaledTask
from robotics1.ik.solution_search import FLAT, NEARLY_SINGULAR, SolutionSearch
from robotics1.ik.solution_set import IKSolutions, solutions_of
from robotics1.ik.surfaces import surfaces
from robotics1.inputs import Array
from robotics1.singularities.points import SingularPoints, singular_points

FEWEST, MOST = 100, 1000  # starts
SAMPLES = 12  # of a set, that tell what stays the same on it
ALONE = 16  # solutions of six joints, at most, if none is on a curve of them
Tried = tuple[End, Array | None]  # the end of a descent, and the solution there


def searched(problem: ScaledTask, target: Any, starts: int | None, seed: int) -> IKSolutions:
    """Return the solutions that descents from random starts lead to.

    Without a number of starts, these go on while w solutions that N of them have led to let expect half a solution
    more: N < 2w² + 3w + 2.

    Source: Boender and Rinnooy Kan, Bayesian stopping rules for multistart global optimization methods, 1987.
    """
    robot, task = problem.robot, problem.task
    rng = np.random.default_rng(seed)
    if not problem.moving.any():
        return _of_a_task_that_nothing_moves(problem, target, problem.box.random(rng, starts or FEWEST))
    points = singular_points(robot, task, problem.box, rng)
    search = SolutionSearch(problem, target, points=points)
    tried = [_tried(search, q) for q in problem.random(rng, starts or FEWEST)]
    found, hits = _distinct(search, tried)
    redundant = np.count_nonzero(problem.moving) > points.rank
    while starts is None and len(tried) < MOST and _more_are_expected(hits):
        if (redundant or len(found) > ALONE) and _dimension(search, found):
            break
        tried += [_tried(search, q) for q in problem.random(rng, FEWEST)]
        found, hits = _distinct(search, tried)
    closest = found[0] if found else search.nearest_miss(min((end for end, _ in tried), key=lambda end: end[1])[0])
    if not found:  # what is nearest may be a solution after all
        found, hits = _distinct(search, [((closest, 0.0), search.solution(closest))])
    dimension = _dimension(search, found)
    if found:
        status, closest = IKStatus.INFINITE if dimension else IKStatus.FINITE, found[0]
    else:
        status = IKStatus.UNREACHABLE if is_out_of_reach(problem, target) else IKStatus.NOT_FOUND
    singular = [search.singular(q) for q in found]
    answer = _answer(problem, target, found, status, closest, dimension, singular)
    if not found:
        return _at_the_boundary(answer, points) or answer
    roots = [Root(q, points.relative_sigma(q), flag) for q, flag in zip(found, singular, strict=True)]
    if dimension:
        near = distance_of_singular(roots, search, points)
        around = Families(problem, search, lambda q: search.descend(problem.box.nearest(q))[0], lambda q: q)
        equations = (surface.equations for surface in surfaces(around, found, SAMPLES))
        families, tangents = tuple(filter(None, equations)), _tangents(found, search, dimension)
        return replace(answer, boundary_distance=near, tangents=tangents, families=families)
    near = boundary_distance(roots, (), search, points)
    status = IKStatus.BOUNDARY if near < np.inf else IKStatus.FINITE
    return replace(answer, status=status, boundary_distance=near, hits=np.array(hits), unseen=unseen_share(hits))


def _tried(search: SolutionSearch, start: Array) -> Tried:
    end = search.descend(start)
    return end, search.solution(end[0])


def _distinct(search: SolutionSearch, tried: Sequence[Tried]) -> tuple[list[Array], list[int]]:
    """Return the solutions, of those that are one the most exact, and how many starts led to each."""
    best_first = sorted(tried, key=lambda one: one[0][1])
    return search.distinct([solution for _, solution in best_first if solution is not None])


def _tangents(found: list[Array], search: SolutionSearch, dimension: int) -> Array:
    """Return the unit tangents of the curves through solutions, (k, nq): N(J); zero where J loses rank more often."""
    n, moving = len(found[0]), search.problem.moving
    if dimension != 1:
        return np.zeros((0, n))
    tangents = np.zeros((len(found), n))
    for tangent, q in zip(tangents, found, strict=True):
        _, sigma, Vt = np.linalg.svd(search.jacobian(q)[:, moving])
        if np.count_nonzero(sigma > FLAT * sigma[0]) == len(Vt) - 1:
            tangent[moving] = search.problem.box.unit[moving] * Vt[-1]
    tangents /= np.maximum(np.linalg.norm(tangents, axis=1, keepdims=True), 1e-300)
    return tangents


def _at_the_boundary(missed: IKSolutions, points: SingularPoints) -> IKSolutions | None:
    """Return the double solution that the target is next to, less than 1e-6 beyond the boundary; None if there is none.

    There J loses rank; where a joint alone is at its limit it does not.
    """
    if missed.error_norm >= BOUNDARY or points.relative_sigma(missed.closest) > NEARLY_SINGULAR:
        return None
    return replace(
        missed,
        q=missed.closest[None],
        singular=np.array([True]),
        status=IKStatus.BOUNDARY,
        complete=False,
        within_limits=np.array([True]),
        boundary_distance=missed.error_norm,
    )


def _more_are_expected(hits: list[int]) -> bool:
    w, reached = len(hits), sum(hits)
    return 0 < reached < 2 * w**2 + 3 * w + 2


def unseen_share(hits: list[int]) -> float:
    """Return the estimated share of starts that lead to solutions not seen yet: w (w + 1) / (N (N − 1)).

    Source: Boender and Rinnooy Kan, 1987: their estimate with no knowledge of the shares.
    """
    w, reached = len(hits), sum(hits)
    return min(1.0, w * (w + 1) / (reached * (reached - 1))) if reached > 1 else 1.0


def _dimension(search: SolutionSearch, found: list[Array]) -> int:
    """Return the dimension of the largest family; where many were found, some of them are asked first."""
    some = found[:: max(1, len(found) // 8)]
    return max((search.dimension(q) for q in some), default=0) or max(
        (search.dimension(q) for q in found if len(found) > len(some)), default=0
    )


def _of_a_task_that_nothing_moves(problem: ScaledTask, target: Any, samples: Array) -> IKSolutions:
    """Return the answer where f(q) is a constant: every q in the box is a solution, or none is."""
    middle = problem.middle
    if problem.relative_error(middle, target) > REACHED:
        proven = is_out_of_reach(problem, target)
        return _answer(problem, target, [], IKStatus.UNREACHABLE if proven else IKStatus.NOT_FOUND, middle, 0, [])
    dimension = int(np.count_nonzero(problem.box.upper > problem.box.lower))
    found = list(samples) if dimension else [middle]
    status = IKStatus.INFINITE if dimension else IKStatus.FINITE
    return _answer(problem, target, found, status, found[0], dimension, [True] * len(found))


def _answer(
    problem: ScaledTask,
    target: Any,
    found: list[Array],
    status: IKStatus,
    closest: Array,
    dimension: int,
    singular: list[bool],
) -> IKSolutions:
    e = problem.task.error(problem.robot, closest, target)
    e = np.where(problem.turns.angle, problem.turns.wrapped(e), e)  # whole turns of an angle are no error
    return solutions_of(
        problem,
        found,
        singular,
        status=status,
        complete=status is IKStatus.UNREACHABLE or not (dimension or problem.moving.any()),
        method="search",
        closest=closest,
        error_norm=float(np.hypot.reduce(e)),
        dimension=dimension,
    )
