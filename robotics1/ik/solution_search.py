"""The search for solutions from many starts: what differs, what is singular, and how many dimensions a family has."""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from robotics1.ik.descent import REACHED, TaskDescent
from robotics1.inputs import Array
from robotics1.singularities.points import ON_THE_SET, SingularPoints

SAME = 1e-6  # distance of two solutions that are one
NEARLY_SINGULAR = 1e-3  # σ_ρ, beside the usual σ₁, below which a solution may really be a singular one
# steps along the null space that look for other solutions, in units: a solution that stands alone is met with one step
ASIDE = 0.05, 0.007
SMALL = 1e-5  # a step of Newton's method, after which the slopes of J are still good for another
SETTLED = 1e-13  # a step of Newton's method, after which no other is needed
INSIDE = 1e-7  # of a limit, in units
FLAT = 1e-6  # σ beside σ₁ of a direction that may be the tangent of a family
STEEP = 1e-3  # σ beside σ₁ of a direction across all families
CURVED = 1e-3  # of uᵀ (dJ/dv) v, without units: solutions do not go on along v


@dataclass(frozen=True, eq=False)
class SolutionSearch(TaskDescent):
    """The search for the q in a box with f(q) = target; `points` is the singular set of the task."""

    points: SingularPoints | None = None

    def solution(self, q: Array) -> Array | None:
        """Return the solution at the end of a descent; None if there is none."""
        return self._wound(self.at_the_singularity(q)) if self.relative_error(q) <= REACHED else None

    def distinct(self, solutions: Iterable[Array]) -> tuple[list[Array], list[int]]:
        """Return solutions, each once, in ascending order, and how often each was there."""
        found: list[Array] = []
        hits: list[int] = []
        for p in solutions:
            same = next((i for i, other in enumerate(found) if self._apart(p, other) <= SAME), None)
            if same is None:
                found.append(p)
                hits.append(1)
            else:
                hits[same] += 1
        order = sorted(range(len(found)), key=lambda i: [round(float(value), 6) for value in found[i]])
        return [found[i] for i in order], [hits[i] for i in order]

    def singular(self, q: Array) -> bool:
        """Whether J loses rank at q."""
        return self.points is not None and self.points.relative_sigma(q) <= ON_THE_SET

    def dimension(self, q: Array) -> int:
        """Return the dimension of the solutions around one of them.

        Where J has the rank ρ that it has almost everywhere, n joints leave n − ρ dimensions: the rank is the same all
        around (constant rank theorem). Elsewhere, and at a limit, it is in how many independent directions a step along
        the null space of J leads to other solutions.
        """
        moving, units = self.problem.moving, self.problem.box.unit
        if self.points is not None and self._is_inside(q) and self.points.relative_sigma(q) > FLAT:
            return int(np.count_nonzero(moving)) - self.points.rank
        if self.stands_alone(q):
            return 0
        J = self.jacobian(q)[:, moving]
        _, sigma, Vt = np.linalg.svd(J)
        flat = np.ones(len(Vt), dtype=bool)
        flat[: len(sigma)] = sigma < FLAT * sigma[0]
        moves = []
        for tangent in Vt[flat]:
            direction = np.zeros(len(q))
            direction[moving] = tangent
            far = self._neighbours(q, direction * units, ASIDE[0])
            if far and self._neighbours(q, direction * units, ASIDE[1]):
                moves.append(far[0] / ASIDE[0])
        lengths = np.linalg.svd(np.array(moves), compute_uv=False) if moves else np.zeros(0)
        return int(np.count_nonzero(lengths > 0.1))

    def _is_inside(self, q: Array) -> bool:
        """Whether no joint that moves the task is at its limit."""
        box, margin = self.problem.box, INSIDE * self.problem.box.unit
        free = box.circular | ~self.problem.moving
        return bool(np.all(free | ((q > box.lower + margin) & (q < box.upper - margin))))

    def stands_alone(self, q: Array) -> bool:
        """Return whether no curve of solutions goes through a double one: a stretched arm has such a fold.

        With J v = 0 and uᵀ J = 0 a curve q + t v + O(t²) of solutions needs uᵀ (dJ/dv) v = 0.
        """
        if self.points is None:
            return False
        problem, moving = self.problem, self.problem.moving
        J = self.jacobian(q)[:, moving]
        U, sigma, Vt = np.linalg.svd(J)
        if J.shape[0] != J.shape[1] or len(sigma) < 2 or sigma[-2] < STEEP * sigma[0]:
            return False
        units = problem.rows[:, None] * problem.box.unit / self.points.units
        slopes = (units[..., None] * self.points.slopes(q))[:, moving][..., moving]
        return bool(abs(np.einsum("i,ijk,j,k", U[:, -1], slopes, Vt[-1], Vt[-1])) > CURVED)

    def _neighbours(self, q: Array, direction: Array, step: float) -> list[Array]:
        """Return the way to a solution that is about one step along a direction, or against it, if there is one."""
        for side in (step, -step):
            p, _ = self.descend(self.problem.box.nearest(q + side * direction))
            move = self.problem.box.difference(p, q)
            if self.relative_error(p) <= REACHED and 0.2 * step < np.linalg.norm(move) < 2 * step:
                return [move]
        return []

    def _apart(self, p: Array, q: Array) -> float:
        return float(np.abs(self.problem.box.difference(p, q)).max(initial=0.0))

    def _wound(self, q: Array) -> Array | None:
        """Return q with joints turned until f(q) itself is the target; of angles whole turns may be left.

        None if a row that counts turns cannot count as many within the limits.
        """
        problem = self.problem
        e = self.task_error(q)
        wound = problem.turns.wound(q, e, problem.lower, problem.upper)
        if wound is not None:
            return wound
        counting = np.abs(e - problem.turns.wrapped(e)) > 0
        return q if problem.turns.angle[counting].all() else None

    def at_the_singularity(self, q: Array) -> Array:
        """Return the singular solution next to q, if there is one; else q.

        At a double solution, such as a stretched arm, |e| grows only with the square of the distance, so that a
        descent stops 1e-5 away. There Newton's method on e = 0 together with the loss of rank is exact.
        """
        if self.points is None or self.points.relative_sigma(q) > NEARLY_SINGULAR:
            return q
        box, p, size, slopes = self.problem.box, q, np.inf, None
        for _ in range(6):
            if size > SMALL:
                slopes = self.points.slopes(p)
            A, b = self.points.linearised(p, slopes)
            block, J = A * box.unit / self.points.box.unit, self.jacobian(p)
            step = np.linalg.lstsq(np.vstack([J, block]), np.concatenate([self.error(p), -b]), rcond=1e-7)[0]
            p = box.nearest(p + box.unit * step)
            size = np.abs(step).max()
            if size < SETTLED:
                break
        near = self._apart(p, q) < NEARLY_SINGULAR
        reached = self.relative_error(p) <= REACHED and self.points.relative_sigma(p) <= ON_THE_SET
        return p if near and reached else q
