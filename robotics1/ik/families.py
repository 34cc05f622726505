"""Curves of solutions of an arm that is not redundant: followed all around, where they cross too, and cut by limits."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from robotics1.ik.descent import REACHED
from robotics1.ik.family_curve import FamilyCurve, Sample, samples_inside
from robotics1.ik.scaled_task import ScaledTask
from robotics1.ik.solution_search import ASIDE, FLAT, SolutionSearch
from robotics1.inputs import Array

STEP, STEPS = 0.25, 160  # along a curve, to each side
SHORTER, STRAIGHT = 4, 0.9  # steps that are tried, each a third of the one before; cos of the angle to the tangent
LISTED = 0.6 * STEP  # from a sample of a curve, of a solution that is on it
DIFFERENCE = 1e-4  # in units, of a quotient
PLACES, AWAY, ENOUGH = 12, 0.8, 3  # near a solution; how far away, in units; how many where J keeps its rank suffice
SPREAD = 0.2  # of steps beside one that counts
MOST = 24  # curves that cross each other
DIRECTIONS = 24  # in which curves may leave a crossing
CHANGES = 0.999  # of the second smallest σ, from one sample to the next, where there may be a crossing between
CROSSING = 1e-3  # σ beside σ₁ of a second direction that may be the tangent of another curve


@dataclass(eq=False)
class Families:
    """The curves of solutions of one target.

    Attributes:
        problem: the task in its box.
        search: for the target.
        polished: a configuration (nq,) → the solution next to it, with no regard to limits.
        within: a configuration → the same turned into the limits; None if it is outside.
        seen: all samples of the curves so far.
        on_surfaces: solutions around which the set has two dimensions or more.
    """

    problem: ScaledTask
    search: SolutionSearch
    polished: Callable[[Array], Array]
    within: Callable[[Array], Array | None]
    seen: list[Array] = field(default_factory=list)
    on_surfaces: list[Array] = field(default_factory=list)

    def dimension(self, q: Array) -> int:
        """Return in how many independent directions solutions go on from one, with no regard to limits."""
        if self.search.stands_alone(q):
            return 0
        sigma, Vt = self._spectrum(q)
        return sum(all(self._goes_on(q, tangent, step) for step in ASIDE) for tangent in Vt[sigma < FLAT])

    def dimension_around(self, q: Array) -> int:
        """Return the dimension of a family, at least 1, from steps at solutions near one of its own.

        At the solution itself curves may cross, whose tangents span a plane where there is no surface. And all roots of
        a formula may be points of a surface at which J loses more rank than around them. Newton's method leads back to
        such points; damped least squares, from a place aside, leads to the others.
        """
        highest = self._nullity(q)
        if highest < 2:
            return 1
        rng, largest, regular = np.random.default_rng(0), 1, 0
        for _ in range(PLACES):
            p = self._aside(q, rng)
            if p is None or (dimension := self._spread(p, rng)) < 2:
                continue
            self.on_surfaces.append(p)
            largest = max(largest, dimension)
            regular += dimension == self._nullity(p)  # N(J) is all tangents: the dimension is proven there
            if largest == highest or regular == ENOUGH:
                break
        return largest

    def _aside(self, q: Array, rng: np.random.Generator) -> Array | None:
        """Return a solution near one, next to a place in a random direction of all; None if the way leads to none."""
        way, moving = rng.standard_normal(np.count_nonzero(self.problem.moving)), self.problem.moving
        place = q.copy()
        place[moving] += AWAY * self.problem.box.unit[moving] * way / np.linalg.norm(way)
        p, _ = self.search.descend(self.problem.box.nearest(place))
        return p if self.search.relative_error(p) <= REACHED else None

    def _spread(self, q: Array, rng: np.random.Generator) -> int:
        """Return in how many independent directions steps of a solution along N(J) lead to others."""
        steps = 3 * self._nullity(q)
        if steps < 6:
            return 1
        ahead = [self.step(q, rng, ASIDE[0]) for _ in range(steps)]
        moves = [self._way(a, q) / ASIDE[0] for a in ahead if self.search.relative_error(a) <= REACHED]
        lengths = np.linalg.svd(np.array(moves), compute_uv=False) if moves else np.zeros(0)
        return int(np.count_nonzero(lengths > SPREAD * np.sqrt(len(moves))))

    def _nullity(self, q: Array) -> int:
        """Return how many directions J takes to zero."""
        return int(np.count_nonzero(self._spectrum(q)[0] < FLAT))

    def _goes_on(self, q: Array, tangent: Array, step: float) -> bool:
        p = self._ahead(q, tangent, step)
        way = float(np.linalg.norm(self.problem.shortest_difference(p, q)))
        return self.search.relative_error(p) <= REACHED and 0.2 * step < way < 2 * step

    def through(self, q: Array) -> list[FamilyCurve]:
        """Return the curve through a solution, and those that cross it, those outside the limits too; none if the
        solution is on one already.
        """
        if self.is_listed(q):
            return []
        found: list[FamilyCurve] = []
        waiting: list[tuple[Array, Array | None]] = [(q, None)]
        if self._second(q) < FLAT:  # the tangent is somewhere in a plane
            waiting = [(q, p) for p in self._ways_from(q)]
        while waiting and len(found) < MOST:
            start, ahead = waiting.pop()
            if ahead is not None and self.is_listed(ahead):
                continue
            way = None if ahead is None else self._way(ahead, start)
            samples, closed = self._curve(start if ahead is None else ahead, way)
            self.seen += [p for p, _ in samples]
            found.append(self._family_curve(samples, closed=closed, regularity=self._second(start)))
            for crossing in self._crossings([p for p, _ in samples]):
                waiting += [(crossing, p) for p in self._ways_from(crossing)]
        return found

    def is_listed(self, q: Array) -> bool:
        """Return whether a singular solution is on one of the curves so far."""
        return any(np.linalg.norm(self.problem.shortest_difference(p, q)) < LISTED for p in self.seen)

    def step(self, q: Array, rng: np.random.Generator, length: float) -> Array:
        """Return the solution next to a step from one along a random direction of N(J)."""
        sigma, Vt = self._spectrum(q)
        null = Vt[np.count_nonzero(sigma >= FLAT) :]
        way = rng.standard_normal(len(null)) @ null
        return self._ahead(q, way / max(float(np.linalg.norm(way)), 1e-300), length)

    def _spectrum(self, q: Array) -> tuple[Array, Array]:
        """Return σ(J), beside the largest, and the right singular vectors as rows."""
        _, sigma, Vt = np.linalg.svd(self.problem.jacobian(q)[:, self.problem.moving])
        return sigma / max(sigma[0], 1e-300), Vt

    def _ahead(self, q: Array, tangent: Array, step: float) -> Array:
        moved, moving = q.copy(), self.problem.moving
        moved[moving] += step * self.problem.box.unit[moving] * tangent
        return self.polished(moved)

    def _way(self, p: Array, q: Array) -> Array:
        """Return the way from q to p in units, of the joints that move the task."""
        return np.asarray(self.problem.shortest_difference(p, q)[self.problem.moving])

    def _curve(self, q: Array, way: Array | None) -> tuple[list[Sample], bool]:
        """Return the solutions on the curve through q with their tangents, one after the other, and whether it closes.

        Args:
            q: a solution.
            way: about along the curve, where J loses rank more than once; None where that cannot be.
        """
        sigma, Vt = self._spectrum(q)
        tangent = Vt[-1] if way is None else _projected(way, Vt[sigma < FLAT])
        if tangent is None:
            return [(q, Vt[-1])], False
        forward, closed = self._along(q, tangent)
        back = [] if closed else [(p, -t) for p, t in self._along(q, -tangent)[0]]
        return [*back[::-1], (q, tangent), *forward], closed

    def _along(self, q: Array, tangent: Array) -> tuple[list[Sample], bool]:
        """Return the solutions along the curve to one side, and whether it comes home."""
        found: list[Sample] = []
        p = q
        for _ in range(STEPS):
            ahead = self._next(p, tangent)
            if ahead is None:
                break
            if len(found) > 2 and np.abs(self.problem.shortest_difference(ahead, q)).max() < 0.5 * STEP:
                return found, True
            sigma, Vt = self._spectrum(ahead)
            flat = Vt[sigma < FLAT]
            turned = _projected(tangent if len(flat) < 2 else self._way(ahead, p), flat)
            if turned is None:
                break
            p, tangent = ahead, turned
            found.append((p, tangent))
        return found, False

    def _next(self, q: Array, tangent: Array) -> Array | None:
        """Return the solution one step on, or less where the curve turns sharply; None if it ends."""
        for step in STEP / 3.0 ** np.arange(SHORTER):
            ahead = self._ahead(q, tangent, step)
            way = self._way(ahead, q)
            if self.search.relative_error(ahead) <= REACHED and way @ tangent > STRAIGHT * np.linalg.norm(way):
                return ahead
        return None

    def _crossings(self, curve: list[Array]) -> list[Array]:
        """Return where J loses rank once more along a curve: others may cross it there."""
        second = [self._second(p) for p in curve]
        found = []
        for i in range(len(curve) if len(curve) > 2 else 0):
            j = (i + 1) % len(curve)
            besides = second[i - 1], second[j]
            if second[i] > min(besides) or second[i] > CHANGES * max(besides):
                continue
            crossing = self._least(curve[i - 1], curve[i], curve[j])
            if self._second(crossing) < CROSSING:
                found.append(crossing)
        return found

    def _second(self, q: Array) -> float:
        sigma = self._spectrum(q)[0]
        return float(sigma[-2]) if len(sigma) > 1 else 1.0

    def _least(self, before: Array, q: Array, after: Array) -> Array:
        """Return the solution between two others at which the second smallest σ is least."""
        from scipy.optimize import minimize_scalar

        unit = self.problem.box.unit

        def at(place: float) -> Array:
            way = self.problem.shortest_difference(after if place > 0 else before, q)
            return self.polished(q + abs(place) * way * unit)

        options = {"bounds": (-1, 1), "method": "bounded", "options": {"xatol": 1e-9}}
        return at(float(minimize_scalar(lambda x: self._second(at(x)), **options).x))

    def _ways_from(self, crossing: Array) -> list[Array]:
        """Return solutions one step away from one at which J loses rank twice."""
        _, Vt = self._spectrum(crossing)
        angles = 2 * np.pi / DIRECTIONS * np.arange(DIRECTIONS)
        found = []
        for angle in [*self._tangents(crossing), *angles]:
            p = self._ahead(crossing, np.cos(angle) * Vt[-1] + np.sin(angle) * Vt[-2], STEP)
            way = np.linalg.norm(self.problem.shortest_difference(p, crossing))
            if self.search.relative_error(p) <= REACHED and 0.5 * STEP < way < 2 * STEP:
                found.append(p)
        return found

    def _tangents(self, q: Array) -> list[float]:
        """Return the angles of v = cos φ v₁ + sin φ v₂ in a null space of two dimensions that curves may have.

        With J v = 0 and uᵀJ = 0 the curve q + t v + O(t²) of solutions needs uᵀ (dJ/dv) v = 0: a quadratic form.
        """
        moving, unit = self.problem.moving, self.problem.box.unit
        U, sigma, Vt = np.linalg.svd(self.problem.jacobian(q)[:, moving])
        null = Vt[-1], Vt[-2]
        rates = []
        for v in null:
            step = np.zeros(len(q))
            step[moving] = DIFFERENCE * unit[moving] * v
            change = self.problem.jacobian(q + step) - self.problem.jacobian(q - step)
            rates.append(change[:, moving] / (2 * DIFFERENCE))
        found = []
        for u in U[:, len(sigma) - 2 :].T:
            (a, b), (c, d) = ([float(u @ rate @ v) for v in null] for rate in rates)
            size = np.hypot(0.5 * (a - d), 0.5 * (b + c))  # mean + size cos(2φ − middle) = 0
            middle = np.arctan2(0.5 * (b + c), 0.5 * (a - d))
            half = np.arccos(np.clip(-0.5 * (a + d) / max(size, 1e-300), -1, 1))
            found += [0.5 * (middle + side * half) + turn for side in (1, -1) for turn in (0, np.pi)]
        return found

    def _family_curve(self, samples: list[Sample], *, closed: bool, regularity: float) -> FamilyCurve:
        """Return a curve with what is inside the limits, and the solutions at which a joint is at its limit."""
        found = samples_inside(samples, self.problem, self.within, self._solution_inside)
        tangents = np.zeros((len(found), self.problem.robot.nq))
        tangents[:, self.problem.moving] = [t for _, t in found] if found else 0.0
        tangents *= self.problem.box.unit
        tangents /= np.maximum(np.linalg.norm(tangents, axis=1, keepdims=True), 1e-300)
        q = np.array([q for q, _ in found]).reshape(tangents.shape)
        regularity = min(regularity, *(self._second(p) for p, _ in samples))
        return FamilyCurve(q, tangents, np.array([p for p, _ in samples]), closed, regularity)

    def _solution_inside(self, q: Array) -> Array | None:
        """Return the solution next to a configuration, turned into the limits; None if there is none."""
        p = self.polished(q)
        return self.within(p) if self.search.relative_error(p) <= REACHED else None


def _projected(way: Array, flat: Array) -> Array | None:
    """Return the unit vector along a way, as far as it is in the plane of some rows; None if it is across."""
    along = flat.T @ (flat @ way)
    size = float(np.linalg.norm(along))
    return along / size if size > 1e-12 else None
