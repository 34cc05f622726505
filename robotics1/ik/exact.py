"""All solutions of a target by formula, polished on the real robot: how many there are, and where two of them meet."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from robotics1.caching import cached_property
from robotics1.ik.descent import REACHED
from robotics1.ik.result import IKStatus
from robotics1.ik.scaled_task import ScaledTask
from robotics1.ik.solution_search import NEARLY_SINGULAR, SAME, SolutionSearch
from robotics1.ik.solution_set import IKSolutions
from robotics1.ik.structure import ClosedForm
from robotics1.inputs import Array
from robotics1.robot.box import nearest_turn
from robotics1.singularities.points import SingularPoints, singular_points

STEPS = 20  # of Newton's method
RANK = 1e-9  # σ beside σ₁, in one of its steps
BOUNDARY = 0.999e-6  # [m, rad] from a target with a double solution, that is at the boundary
AS_FORMULA = 1e-9  # deviation of an arm for which its formula is exact
REGULAR = 1e-2  # σ_ρ, beside the usual σ₁, at which rounding of the axes cannot add or remove a solution
AT_LIMIT = 1e-9, 1e-7  # outside of a limit, in units, by rounding; and of a double solution
FAMILY_STEP, FAMILY_STEPS = 0.25, 26  # along a family, to each side


@dataclass(frozen=True, eq=False)
class ExactSolver:
    """Solves f(q) = r_d for a robot and a task whose solutions are known by formula.

    Attributes:
        problem: the task without units, in its box.
        form: the way to all solutions.
    """

    problem: ScaledTask
    form: ClosedForm

    @cached_property
    def points(self) -> SingularPoints:
        """The singular set of the task."""
        problem = self.problem
        return singular_points(problem.robot, problem.task, problem.box, np.random.default_rng(0))

    def solve(self, target: Any, otherwise: Callable[[], IKSolutions]) -> IKSolutions:
        """Return all solutions.

        Args:
            target: in the form of the task's value.
            otherwise: gives the answer of a search, for targets that the formula cannot serve, and for the nearest miss.
        """
        form_map = self.problem.task.frame_map()
        if form_map is None or form_map.pose_error is None:
            return otherwise()
        found = self.form.solve(form_map.pose_error.goal(self.problem.robot, target))
        if found is None:
            return otherwise()
        search = SolutionSearch(self.problem, target, points=self.points)
        candidates = [self._polished(self._whole(x), search) for x in found]
        roots, regular = self._roots([q for q, error in candidates if error <= REACHED], search)
        inside, outside = self._by_limits(roots, search)
        dimension = max((search.dimension(q) for q in inside if search.singular(q)), default=0)
        regular = regular and all(error <= REACHED for _, error in candidates)
        proven = regular or self.form.deviation < AS_FORMULA
        if dimension > 1:
            return otherwise()
        if dimension == 1:
            inside, proven = self._with_families(inside, search), False
        near = self._distance_to_boundary(inside, search)
        if not inside:
            return self._miss([q for q, _ in candidates], outside, search, otherwise, proven=proven)
        meets = near < np.inf or any(search.singular(q) for q in inside)
        status = IKStatus.INFINITE if dimension else IKStatus.BOUNDARY if meets else IKStatus.FINITE
        return self._answer(inside, outside, status, search, dimension=dimension, proven=proven, near=near)

    def _whole(self, x: Array) -> Array:
        """Return q (nq,) from the coordinates that the formula gives; free joints stand in the middle."""
        q = self.problem.middle.copy()
        q[list(self.form.joints)] = x
        return q

    def _polished(self, q: Array, search: SolutionSearch) -> tuple[Array, float]:
        """Return q after Newton's method, with no regard to limits, and its |e| relative to the arm."""
        moving, unit = self.problem.moving, self.problem.box.unit
        best, least = q, np.inf
        for _ in range(STEPS):
            e = search.error(q)
            size = float(np.hypot.reduce(e))
            if size < least:
                best, enough, least = q, size > 0.5 * least, size
            if size > least or enough or least < 1e-15:
                break
            J = self.problem.jacobian(q)[:, moving]
            q = q.copy()
            q[moving] += unit[moving] * np.linalg.lstsq(J, e, rcond=RANK)[0]
        return best, search.relative_error(best)

    def _roots(self, candidates: list[Array], search: SolutionSearch) -> tuple[list[Array], bool]:
        """Return the solutions, each once, in ascending order, and whether all are far from singularities."""
        roots: list[Array] = []
        regular = True
        for candidate in candidates:
            q = self._turned(candidate)
            sigma = self.points.relative_sigma(q)
            regular = regular and sigma > REGULAR
            if sigma < NEARLY_SINGULAR:
                q = search.at_the_singularity(q)
            if all(np.abs(self._difference(q, other)).max(initial=0.0) > SAME for other in roots):
                roots.append(q)
        return sorted(roots, key=lambda q: [round(float(value), 6) for value in q]), regular

    def _difference(self, p: Array, q: Array) -> Array:
        """Return p − q in units, angles the short way round."""
        d = p - q
        return np.asarray(np.where(self.problem.robot.revolute, np.angle(np.exp(1j * d)), d / self.problem.box.unit))

    def _turned(self, q: Array) -> Array:
        """Return q with joints turned into the box, or into their limits if there is such a turn."""
        problem, box = self.problem, self.problem.box
        turned = nearest_turn(q, problem.middle, problem.lower, problem.upper)
        turned = np.where(problem.robot.revolute & problem.moving, turned, q)
        return np.where(box.circular, box.nearest(q), turned)

    def _by_limits(self, roots: list[Array], search: SolutionSearch) -> tuple[list[Array], list[Array]]:
        """Return the solutions inside the limits, and those outside."""
        lower, upper, unit = self.problem.lower, self.problem.upper, self.problem.box.unit
        inside, outside = [], []
        for q in roots:
            margin = AT_LIMIT[search.singular(q)] * unit
            if np.all(q >= lower - margin) and np.all(q <= upper + margin):
                inside.append(np.clip(q, lower, upper))
            else:
                outside.append(q)
        return inside, outside

    def _with_families(self, roots: list[Array], search: SolutionSearch) -> list[Array]:
        """Return the solutions with others along each curve of them."""
        listed = list(roots)
        for q in roots:
            if search.singular(q) and search.dimension(q):
                for side in (1.0, -1.0):
                    listed += self._along(q, side, search)
        found: list[Array] = []
        for q in listed:
            if all(np.abs(self._difference(q, other)).max() > SAME for other in found):
                found.append(q)
        return sorted(found, key=lambda q: [round(float(value), 6) for value in q])

    def _along(self, q: Array, side: float, search: SolutionSearch) -> list[Array]:
        """Return solutions along the curve through q, to one side, up to a limit or all around."""
        moving, unit = self.problem.moving, self.problem.box.unit
        found: list[Array] = []
        p, before = q, None
        for _ in range(FAMILY_STEPS):
            _, sigma, Vt = np.linalg.svd(self.problem.jacobian(p)[:, moving])
            flat = Vt[np.append(sigma, np.zeros(len(Vt) - len(sigma))) < 1e-6 * sigma[0]]
            if not len(flat):
                break
            tangent = side * flat[-1] if before is None else flat.T @ (flat @ before)
            tangent /= max(np.linalg.norm(tangent), 1e-12)
            ahead = p.copy()
            ahead[moving] += FAMILY_STEP * unit[moving] * tangent
            ahead, error = self._polished(ahead, search)
            inside, _ = self._by_limits([self._turned(ahead)], search)
            home = len(found) > 2 and np.abs(self._difference(ahead, q)).max() < 0.5 * FAMILY_STEP
            if error > REACHED or not inside or home:
                break
            found += inside
            p, before = ahead, tangent
        return found

    def _distance_to_boundary(self, roots: list[Array], search: SolutionSearch) -> float:
        """Return how far the target is from the value at the nearest singular configuration, if that is at hand."""
        near = np.inf
        for q in roots:
            if search.singular(q):
                return 0.0
            if self.points.relative_sigma(q) < NEARLY_SINGULAR:
                p = self.points.project(q)
                near = near if p is None else min(near, search.error_norm(p))
        return near if near < BOUNDARY else np.inf

    def _miss(
        self,
        candidates: list[Array],
        outside: list[Array],
        search: SolutionSearch,
        otherwise: Callable[[], IKSolutions],
        *,
        proven: bool,
    ) -> IKSolutions:
        """Return the answer where none is inside the limits: the boundary if it is at hand, or the nearest miss."""
        nearest = [search.nearest_miss(self.problem.box.nearest(q)) for q in candidates if not outside]
        near = min(nearest, key=search.error_norm, default=None)
        if near is not None and search.error_norm(near) < BOUNDARY:
            distance = search.error_norm(near)
            answer = self._answer([near], outside, IKStatus.BOUNDARY, search, proven=proven, near=distance)
            return replace(answer, singular=np.array([True]))
        searched = otherwise()
        if len(searched) or not proven:
            return searched
        return replace(
            searched,
            status=IKStatus.UNREACHABLE,
            complete=True,
            method=self.form.method,
            outside_limits=np.array(outside).reshape(len(outside), self.problem.robot.nq),
        )

    def _answer(
        self,
        inside: list[Array],
        outside: list[Array],
        status: IKStatus,
        search: SolutionSearch,
        *,
        proven: bool,
        near: float,
        dimension: int = 0,
    ) -> IKSolutions:
        robot = self.problem.robot
        return IKSolutions(
            q=np.array(inside).reshape(len(inside), robot.nq),
            singular=np.array([search.singular(q) for q in inside], dtype=bool),
            status=status,
            complete=proven,
            method=self.form.method,
            closest=inside[0],
            error_norm=search.error_norm(inside[0]),
            free_joints=self.problem.free_joints,
            dimension=dimension,
            within_limits=np.ones(len(inside), dtype=bool),
            outside_limits=np.array(outside).reshape(len(outside), robot.nq),
            boundary_distance=near,
        )
