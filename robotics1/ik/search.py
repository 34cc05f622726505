"""The search for inverse kinematics solutions: descents from random starts, and what they have found."""

from dataclasses import dataclass

import numpy as np

from robotics1.analysis.singular_points import ON_THE_SET, SingularPoints
from robotics1.ik.descent import REACHED, Descent, End
from robotics1.inputs import Array
from robotics1.tasks.units import unitless_jacobian

SAME = 1e-6  # distance of two solutions that are one
NEARLY_SINGULAR = 1e-3  # σ_ρ, beside the usual σ₁, below which a solution may really be a singular one
ASIDE = 0.05  # step along the null space that looks for a neighbouring solution, in units


@dataclass(frozen=True, eq=False)
class SolutionSearch(Descent):
    """The search for the q in a box with f(q) = target; `points` is the singular set of the task."""

    points: SingularPoints

    def distinct(self, ends: list[End]) -> list[Array]:
        """Return the solutions among the ends, each once, in ascending order."""
        found: list[Array] = []
        for q, error in sorted(ends, key=lambda end: end[1]):
            if error > REACHED:
                break
            p = self._at_the_singularity(q)
            if all(np.abs(self.box.difference(p, other)).max() > SAME for other in found):
                found.append(p)
        return sorted(found, key=lambda q: [round(float(value), 6) for value in q])

    def in_a_family(self, q: Array) -> bool:
        """Whether a step along the null space of J leads to a neighbouring solution."""
        _, sigma, Vt = np.linalg.svd(unitless_jacobian(self.robot, self.task, q))
        flat = np.ones(self.robot.nv, dtype=bool)
        flat[: len(sigma)] = sigma < 1e-6 * sigma[0]
        for direction in Vt[flat]:
            for side in (ASIDE, -ASIDE):
                p, error = self.descend(self.box.nearest(q + side * self.robot.units * direction))
                if error <= REACHED and 0.2 * ASIDE < np.linalg.norm(self.box.difference(p, q)) < 2 * ASIDE:
                    return True
        return False

    def _at_the_singularity(self, q: Array) -> Array:
        """Return the singular solution next to q, if there is one; else q.

        At a double solution, such as a stretched arm, |e| grows only with the square of the distance, so that a
        descent stops 1e-5 away. There Newton's method on e = 0 together with the loss of rank is exact.
        """
        if self.points.gap(q) > NEARLY_SINGULAR:
            return q
        p = q
        for _ in range(6):
            A, b = self.points.linearised(p)
            J = unitless_jacobian(self.robot, self.task, p)
            step = np.linalg.lstsq(np.vstack([J, A]), np.concatenate([self.error(p), -b]), rcond=1e-7)[0]
            p = self.box.nearest(p + self.robot.units * step)
        near = np.abs(self.box.difference(p, q)).max() < NEARLY_SINGULAR
        reached = np.linalg.norm(self.error(p)) <= REACHED and self.points.gap(p) <= ON_THE_SET
        return p if near and reached else q
