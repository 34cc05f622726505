"""How far a target is from one at which two solutions meet, or at which a family of them begins."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from robotics1.ik.scaled_task import ScaledTask
from robotics1.ik.solution_search import SolutionSearch
from robotics1.inputs import Array
from robotics1.singularities.points import SingularPoints

NEARLY_SINGULAR = 5e-3  # σ_min/σ_max of a solution that may be within 1e-6 m of a boundary of an arm of 1 m
ALMOST_LOST = 1e-5  # σ_min/σ_max of one that may be within 1e-6 m of a family
CLOSE = 0.05  # distance of two solutions that may meet within 1e-6 m
STEPS, RANK = 4, 1e-6  # along the singular set, and σ beside σ₁ in one of them
BOUNDARY = 0.999e-6  # [m, rad] from a target with a double solution, that is at the boundary


class Root(NamedTuple):
    """A solution q (nq,), σ_min/σ_max of J there, and whether J loses rank."""

    q: Array
    sigma: float
    singular: bool


def shortness(problem: ScaledTask) -> float:
    """Return how many of the arm make a metre, at least 1: beside a short arm, 1e-6 m is long."""
    return max(1.0, 1.0 / problem.length) if "m" in problem.task.row_units else 1.0


def boundary_distance(
    roots: Sequence[Root], outside: Sequence[Root], search: SolutionSearch, points: SingularPoints
) -> float:
    """Return how far the target is from the value at the nearest singular configuration [m, rad]; ∞ if not at hand.

    Args:
        roots: the solutions inside the limits.
        outside: those outside, which may meet one that is inside: J loses rank between them.
        search: for the target.
        points: the singular set of the task.
    """
    if any(root.singular for root in roots):
        return 0.0
    short = shortness(search.problem)
    near = np.inf
    for root in roots:
        if root.sigma < ALMOST_LOST * short:
            near = min(near, _to_the_singular_set(root.q, search, points))
        if root.sigma < NEARLY_SINGULAR * np.sqrt(short):
            others = [other.q for other in (*roots, *outside) if other is not root]
            apart = [np.abs(search.problem.shortest_difference(root.q, q)).max() for q in others]
            close = [q for q, distance in zip(others, apart, strict=True) if distance < CLOSE * np.sqrt(short)]
            near = min([near, *(distance_of_meeting(root.q, q, search) for q in close)])
    return near if near < BOUNDARY else np.inf


def distance_of_singular(roots: Sequence[Root], search: SolutionSearch, points: SingularPoints) -> float:
    """Return how far the target is from the value at a singular configuration near one of infinitely many solutions."""
    short = shortness(search.problem)
    some = [root.q for root in roots if not root.singular and root.sigma < NEARLY_SINGULAR * np.sqrt(short)]
    near = min((_to_the_singular_set(q, search, points) for q in some), default=np.inf)
    return near if near < BOUNDARY else np.inf


def _to_the_singular_set(q: Array, search: SolutionSearch, points: SingularPoints) -> float:
    """Return how far the target is from the nearest value of the singular configurations near q; ∞ if there are none.

    From the one next to q, Gauss and Newton's method goes along the set A Δq = 0: Δq = N (J N)⁺ e, with A N = 0.
    """
    near, p, box = np.inf, points.project(q), search.problem.box
    for _ in range(STEPS):
        if p is None or search.error_norm(p) >= near:
            break
        near = search.error_norm(p)
        A = points.linearised(p)[0] * box.unit / points.box.unit
        sigma, Vt = np.linalg.svd(A)[1:]
        along = Vt[np.count_nonzero(sigma > RANK * sigma[0]) :].T
        step = along @ np.linalg.lstsq(search.jacobian(p) @ along, search.error(p), rcond=RANK)[0]
        p = points.project(box.nearest(p + box.unit * step))
    return near


def distance_of_meeting(p: Array, q: Array, search: SolutionSearch) -> float:
    """Return how far the target is from one at which two close solutions p and q meet [m, rad].

    Halfway, at m, J has a left null vector u: e = r_d − f(m) leaves the boundary by uᵀ e. The rest of e is a way along
    the boundary.
    """
    problem = search.problem
    halfway = q + 0.5 * problem.shortest_difference(p, q) * problem.box.unit
    U, sigma, _ = np.linalg.svd(problem.task.jacobian(problem.robot, halfway)[:, problem.moving])
    u = U[:, len(sigma) - 1]
    return float(abs(u @ problem.turns.wrapped(search.task_error(halfway))))
