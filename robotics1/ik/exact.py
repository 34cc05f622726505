"""All solutions of a target by formula, polished on the real robot: how many there are, and where two of them meet."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from robotics1.caching import cached_property
from robotics1.errors import TaskError
from robotics1.ik.boundary_distance import BOUNDARY, Root, boundary_distance, distance_of_meeting
from robotics1.ik.descent import REACHED
from robotics1.ik.families import Families
from robotics1.ik.joint_relations import joint_relations
from robotics1.ik.linkages import are_all
from robotics1.ik.result import IKStatus
from robotics1.ik.scaled_task import ScaledTask
from robotics1.ik.solution_search import SAME, SolutionSearch
from robotics1.ik.solution_set import IKSolutions, solutions_of
from robotics1.ik.structure import ClosedForm
from robotics1.ik.surfaces import with_surfaces
from robotics1.inputs import Array
from robotics1.robot.box import nearest_turn
from robotics1.singularities.points import SingularPoints, singular_points
from robotics1.tasks.task import PoseError

SINGULAR = 1e-4  # σ_min/σ_max of a solution that may be a double one: rounding splits these by 1e-8 or more
SPLIT = 1e-3  # distance by which rounding may split a double solution, where the target is near a joint axis
AS_FORMULA = 1e-9  # deviation of an arm for which its formula is exact
REGULAR = 1e-2  # σ_min/σ_max at which rounding of the axes cannot add or remove a solution
AT_LIMIT = 1e-9, 1e-7  # outside of a limit, in units, by rounding; and of a double solution
NEAREST = 8  # starts that look for the nearest miss, where it is proven that there is no solution


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

    @property
    def is_regular(self) -> bool:
        """Whether the joints move the task in independent ways almost everywhere, so that solutions stand alone."""
        return self.points.rank == np.count_nonzero(self.problem.moving)

    def solve(self, target: Any, otherwise: Callable[[int | None], IKSolutions]) -> IKSolutions:
        """Return all solutions.

        Args:
            target: in the form of the task's value.
            otherwise: the number of starts, or None → the answer of a search, for targets that the formula cannot serve
                and for nearest misses.
        """
        goal = self.pose_error.goal(self.problem.robot, target)
        found = self.form.candidates(goal)
        if found is None:
            return otherwise(None)
        search = SolutionSearch(self.problem, target, points=self.points)
        candidates, sigma = self._polished(np.array([self._whole(x) for x in found.x]), goal)
        reached = np.array([search.relative_error(q) <= REACHED for q in candidates], dtype=bool)
        sure = found.proven and bool(reached[found.real].all())
        if not sure and not reached.any():
            return otherwise(None)
        proven = sure and (self.form.deviation < AS_FORMULA or bool((reached & (sigma > REGULAR)).all()))
        every = self._roots(candidates[reached], sigma[reached], search)
        inside, outside = self._by_limits(every)
        families = Families(self.problem, search, lambda q: self._polished(q[None], goal)[0][0], self._within)
        dimensions = [self._dimension(root, families) for root in every]
        if max(dimensions, default=0) > 1:
            return with_surfaces(otherwise(None), max(dimensions), families)
        if any(dimensions):
            answer = self._with_families(every, dimensions, families, proven=proven)
            if answer is not None:
                return answer
        if not inside:
            return self._miss(candidates[~reached], outside, search, otherwise, proven=proven)
        near = boundary_distance(inside, outside, search, self.points)
        status = IKStatus.BOUNDARY if near < np.inf else IKStatus.FINITE
        proven = proven and (status is IKStatus.FINITE or self.is_short)
        return self._answer(inside, outside, status, search, proven=proven, near=near)

    @property
    def is_short(self) -> bool:
        """Whether rounding hides no solution beside a double one: of six joints it may."""
        return len(self.form.chain.coordinate) <= 3

    @cached_property
    def pose_error(self) -> PoseError:
        """How the task's error follows from that of its frame's pose."""
        form = self.problem.task.frame_map()
        if form is None or form.pose_error is None:
            raise TaskError("all solutions by formula are of a task on one frame")
        return form.pose_error

    def _whole(self, x: Array) -> Array:
        """Return q (nq,) from the coordinates that the formula gives; free joints stand in the middle."""
        q = self.problem.middle.copy()
        q[list(self.form.chain.coordinate)] = x
        return q

    def _polished(self, q: Array, goal: Array) -> tuple[Array, Array]:
        """Return configurations (k, nq) after Newton's method, with no regard to limits, and σ_min/σ_max of J, (k,)."""
        if not len(q):
            return np.zeros((0, self.problem.robot.nq)), np.zeros(0)
        moving = list(self.form.chain.coordinate)
        q = q.copy()
        q[:, moving], sigma = self.form.chain.polished(q[:, moving], goal, sorted(self.pose_error.rows))
        return q, sigma

    def _roots(self, candidates: Array, sigma: Array, search: SolutionSearch) -> list[Root]:
        """Return the solutions, each once, in ascending order.

        Of a double solution rounding makes two, one to each side: their mean is more exact than either.
        """
        groups: list[tuple[list[Array], float]] = []
        for candidate, ratio in zip(candidates, sigma, strict=True):
            q = self._turned(candidate)
            for i, (group, least) in enumerate(groups):
                if self._are_one(q, group[0], max(ratio, least), search):
                    groups[i] = [*group, q], min(ratio, least)
                    break
            else:
                groups.append(([q], float(ratio)))
        roots: list[Root] = []
        for group, ratio in groups:
            root = self._root(group, ratio, search)
            if not any(self._apart(root.q, other.q) < SAME for other in roots):
                roots.append(root)
        return sorted(roots, key=lambda root: [round(float(value), 6) for value in root.q])

    def _are_one(self, p: Array, q: Array, sigma: float, search: SolutionSearch) -> bool:
        """Whether two solutions are one but for rounding: so they are if the target is where they meet."""
        apart, rounded = self._apart(p, q), REACHED * max(1.0, self.problem.length)
        meet = sigma < SINGULAR and apart < SPLIT and distance_of_meeting(p, q, search) <= rounded
        return bool(apart < SAME or meet)

    def _apart(self, p: Array, q: Array) -> float:
        return float(np.abs(self.problem.shortest_difference(p, q)).max(initial=0.0))

    def _root(self, group: list[Array], sigma: float, search: SolutionSearch) -> Root:
        """Return the solution that a group of nearly the same ones stands for."""
        q = group[0]
        if sigma > SINGULAR:
            return Root(q, sigma, False)
        mean = np.mean([self.problem.shortest_difference(p, q) for p in group], axis=0)
        refined = search.at_the_singularity(self._turned(q + mean * self.problem.box.unit))
        wide = max(self._apart(p, q) for p in group) > SAME
        return Root(refined, sigma, bool(wide or search.singular(refined)))

    def _turned(self, q: Array) -> Array:
        """Return q with joints turned into the box, or into their limits if there is such a turn."""
        problem, box = self.problem, self.problem.box
        turned = nearest_turn(q, problem.middle, problem.lower, problem.upper)
        turned = np.where(problem.robot.revolute & problem.moving, turned, q)
        return np.where(box.circular, box.nearest(q), turned)

    def _by_limits(self, roots: list[Root]) -> tuple[list[Root], list[Root]]:
        """Return the solutions inside the limits, and those outside."""
        lower, upper, unit = self.problem.lower, self.problem.upper, self.problem.box.unit
        inside, outside = [], []
        for root in roots:
            margin = AT_LIMIT[root.singular] * unit
            if np.all(root.q >= lower - margin) and np.all(root.q <= upper + margin):
                inside.append(root._replace(q=np.clip(root.q, lower, upper)))
            else:
                outside.append(root)
        return inside, outside

    def _within(self, q: Array) -> Array | None:
        """Return a configuration turned into the limits; None if it is outside."""
        inside, _ = self._by_limits([Root(self._turned(q), 0.0, True)])
        return inside[0].q if inside else None

    def _dimension(self, root: Root, families: Families) -> int:
        """Return the dimension of the solutions around one of them."""
        if not root.singular:
            return 0
        found = families.search.dimension(root.q) if self._within(root.q) is not None else families.dimension(root.q)
        return families.dimension_around(root.q) if found else 0

    def _with_families(
        self, roots: list[Root], dimensions: list[int], families: Families, *, proven: bool
    ) -> IKSolutions | None:
        """Return the answer where there are curves of solutions; None if none of them is inside the limits.

        Curves are followed from outside the limits too: they may come within.
        """
        curves = [
            curve
            for root, dimension in zip(roots, dimensions, strict=True)
            for curve in (families.through(root.q) if dimension else ())
        ]
        alone = [
            root
            for root, dimension in zip(roots, dimensions, strict=True)
            if not dimension and not (root.singular and families.is_listed(root.q))
        ]
        if not any(len(curve.q) for curve in curves):
            return None
        inside, outside = self._by_limits(alone)
        robot = self.problem.robot
        found = [(root, np.zeros(robot.nq)) for root in inside]
        for curve in curves:
            found += [(Root(q, 0.0, True), t) for q, t in zip(curve.q, curve.tangents, strict=True)]
        found.sort(key=lambda pair: [round(float(value), 6) for value in pair[0].q])
        proven = proven and not any(root.singular for root in alone) and are_all(curves, self.form.chain)
        listed = [root for root, _ in found]
        answer = self._answer(listed, outside, IKStatus.INFINITE, families.search, dimension=1, proven=proven, near=0.0)
        relations = tuple(joint_relations(curve.q, self.problem) for curve in curves if len(curve.q))
        return replace(answer, families=relations, tangents=np.array([t for _, t in found]))

    def _miss(
        self,
        candidates: Array,
        outside: list[Root],
        search: SolutionSearch,
        otherwise: Callable[[int | None], IKSolutions],
        *,
        proven: bool,
    ) -> IKSolutions:
        """Return the answer where none is inside the limits: the boundary if it is at hand, or the nearest miss."""
        nearest = [search.nearest_miss(self.problem.box.nearest(q)) for q in candidates if not outside]
        near = min(nearest, key=search.error_norm, default=None)
        if near is not None and search.error_norm(near) < BOUNDARY:
            distance = search.error_norm(near)
            root = Root(near, 0.0, True)
            proven = proven and self.is_short
            return self._answer([root], outside, IKStatus.BOUNDARY, search, proven=proven, near=distance)
        searched = otherwise(NEAREST if proven else None)
        if len(searched) or not proven:
            return otherwise(None) if proven else searched
        return replace(
            searched,
            status=IKStatus.UNREACHABLE,
            complete=True,
            method=self.form.method,
            outside_limits=np.reshape([root.q for root in outside], (len(outside), self.problem.robot.nq)),
        )

    def _answer(
        self,
        inside: list[Root],
        outside: list[Root],
        status: IKStatus,
        search: SolutionSearch,
        *,
        proven: bool,
        near: float,
        dimension: int = 0,
    ) -> IKSolutions:
        return solutions_of(
            self.problem,
            [root.q for root in inside],
            [root.singular for root in inside],
            [root.q for root in outside],
            status=status,
            complete=proven,
            method=self.form.method,
            closest=inside[0].q,
            error_norm=search.error_norm(inside[0].q),
            dimension=dimension,
            boundary_distance=near,
        )
