"""Points on the singular set, found by Newton's method on the part of J that loses rank."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from robotics1.caching import cached_property
from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.least_squares import numeric_rank
from robotics1.notation import enumeration
from robotics1.robot.box import JointBox
from robotics1.robot.model import Robot
from robotics1.singularities.jacobian_slopes import jacobian_slopes
from robotics1.singularities.result import SingularBranch
from robotics1.singularities.spaces import vanishing_block
from robotics1.symbolic.polynomials.time_limit import check_time
from robotics1.tasks.rows import unitless_factors, unitless_jacobian
from robotics1.tasks.task import Task

ON_THE_SET = 1e-10  # σ_ρ of a configuration that is called singular, beside the usual σ₁
MOVES = 1e-12  # σ₁ of a Jacobian without units that is not rounding
LONGEST_STEP = 0.5  # of one iteration, in the box's units
INDEPENDENT = 1e-10  # of a singular value of the linearised block, beside its largest; differences are exact to 1e-13
EXACT = 1e-9  # of a step, in the box's units: near a zero of order m, σ is 1e-15 already at 1e-15^(1/m)
SHRINKS = (0.4, 0.9)  # ratios of two steps towards a zero of order 2 to 10, or nearly so
STRAIGHT = 0.98  # cosine between these steps
OF_ORDER_3 = 0.6  # a ratio that is larger: 2/3 and more
NEAR = 1e-6  # from a limit, in units: rad, or reaches of the arm; a limit such as 3.14159265 is meant to be π
ROUNDING = 1e-9  # outside of a limit by less than this is at the limit, in units
ASIDE = 1e-3  # from which the steps towards such a zero are exact enough, in the box's units


@dataclass(frozen=True, eq=False)
class SingularPoints:
    """The set {q : rank J(q) < ρ}, where ρ is the rank of J almost everywhere.

    The Newton step of `vanishing_block` moves q straight to the set and hardly along it, so it is a projection.

    J is taken without units: lengths are divided by the arm's reach. `scale` is the usual σ₁.
    """

    robot: Robot
    task: Task
    box: JointBox
    rank: int
    scale: float

    def require_motion(self) -> "SingularPoints":
        """Return self if a joint moves the task, or there is none.

        Raises:
            TaskError: J is zero everywhere.
        """
        if self.rank == 0 and self.robot.nv > 0:
            raise TaskError("no joint moves the task at all: its Jacobian is zero everywhere")
        return self

    def jacobian(self, q: Array) -> Array:
        """Return J(q), (m, n), without units."""
        return np.asarray(self.units * self.task.jacobian(self.robot, q))

    @cached_property
    def units(self) -> Array:
        """(m, n) factors that take the units out of J."""
        return unitless_factors(self.robot, self.task)

    def relative_sigma(self, q: Array) -> float:
        """Return σ_ρ relative to the σ₁ that is usual for the robot; it is zero on the set, and infinite where the
        task has no Jacobian, or no singular value that could vanish.
        """
        if self.rank == 0:
            return np.inf
        try:
            J = self.jacobian(q)
        except TaskError:
            return np.inf
        return float(np.linalg.svd(J, compute_uv=False)[self.rank - 1] / self.scale)

    def rank_at(self, q: Array) -> int:
        """Return the rank of J(q); singular values that are rounding beside the usual σ₁ count as zero."""
        return numeric_rank(np.append(self.scale, np.linalg.svd(self.jacobian(q), compute_uv=False))) - 1

    def moved(self, q: Array, step: Array) -> Array:
        """Return the configuration in the box that is nearest to q plus a step, in the box's units."""
        return self.box.nearest(q + self.box.unit * step)

    def neighbour(self, q: Array, step: Array) -> Array | None:
        """Return a configuration on the set near one of its points, q, and a step from it; None as `project`."""
        return self.project(self.moved(q, step), iterations=12)

    def project(self, q: Array, iterations: int = 60) -> Array | None:
        """Return a configuration on the set near q, or None when Newton's method finds none inside the box, or meets
        one at which the task has no Jacobian.

        Raises:
            OutOfTime: the time of a limit that is kept is over.
        """
        try:
            return self._projected(q, iterations)
        except TaskError:
            return None

    def _projected(self, q: Array, iterations: int) -> Array | None:
        best, best_gap = q, np.inf
        before, multiple = None, None
        for _ in range(iterations):
            check_time()
            gap = self.relative_sigma(q)
            if gap < best_gap:
                best, best_gap = q, gap
            step = self._newton_step(q)
            longest = float(np.abs(step).max())
            if (gap < 1e-15 and longest < EXACT) or (best_gap < ON_THE_SET and gap > best_gap):
                break  # exact, or at the level of rounding
            step *= min(1.0, LONGEST_STEP / max(longest, 1e-300))
            ahead = self.moved(q, step)
            ratio = _shrinking(before, step)
            before = step
            if ratio is not None:
                further = self.moved(q, step / (1 - ratio))
                multiple = step if ratio > OF_ORDER_3 else multiple
                if self.relative_sigma(further) < self.relative_sigma(ahead):
                    ahead, before = further, None
            q = ahead
        if best_gap > ON_THE_SET:
            return None
        return best if multiple is None else self._polished(best, multiple)

    def _newton_step(self, q: Array) -> Array:
        A, b = self.linearised(q)
        return np.asarray(np.linalg.lstsq(A, -b, rcond=INDEPENDENT)[0])

    def _polished(self, q: Array, direction: Array) -> Array:
        """Return a zero of order m ≥ 3 to about 1e-7, q being near it: there σ is rounding, so that the steps are
        taken from a little aside, and followed to where they lead.
        """
        at = self.moved(q, -ASIDE * direction / np.linalg.norm(direction))
        before = None
        for _ in range(3):
            step = self._newton_step(at)
            ratio = _shrinking(before, step)
            if ratio is None:
                at, before = self.moved(at, step), step
            else:
                found = self.moved(at, step / (1 - ratio))
                near = np.abs(self.box.difference(found, q)).max() < 0.1 * ASIDE
                return found if near and self.relative_sigma(found) <= ON_THE_SET else q
        return q

    def tangent(self, q: Array, rng: np.random.Generator, radius: float = 3e-3) -> Array:
        """Return an orthonormal basis (n, d) of the set's tangent space at q, in the box's units.

        Small random displacements, projected back on the set, stay in the tangent space up to radius².
        They do so also where the derivative of the block vanishes.
        """
        n = len(q)
        moves = []
        for direction in rng.standard_normal((2 * n, n)):
            p = self.neighbour(q, radius * direction)
            if p is not None:
                moves.append(self.box.difference(p, q))
        if not moves:
            return np.zeros((n, 0))
        _, lengths, Vt = np.linalg.svd(np.array(moves), full_matrices=False)
        return np.asarray(Vt[lengths > 0.03 * radius].T)

    def branch(
        self, samples: Sequence[Array], dimension: int, values: Mapping[int, float], free: list[int], limits: JointBox
    ) -> SingularBranch:
        """Return a branch from samples in the box, constant joint → value, and the free joints. Its bases are those at
        the first sample of the largest rank; `limits` are those of the joints.
        """
        names = self.robot.joint_names
        ranks = list(map(self.rank_at, samples))
        best = int(np.argmax(ranks))
        return SingularBranch(
            robot=self.robot,
            task=self.task,
            box=self.box,
            generic_rank=self.rank,
            dimension=dimension,
            values={names[i]: float(value) for i, value in values.items()},
            free_joints=tuple(names[i] for i in free),
            samples=np.array(samples),
            q=samples[best],
            rank=ranks[best],
            note=_note_on_limits(np.array(samples), limits, names),
        )

    def slopes(self, q: Array) -> Array:
        """Return ∂J/∂x, (m, n, n), with x in the box's units."""
        check_time()
        return self.units[..., None] * jacobian_slopes(self.robot, self.task, q) * self.box.unit

    def linearised(self, q: Array, slopes: Array | None = None) -> tuple[Array, Array]:
        """Return (A, b): near q the block that vanishes on the set is b + A dx, with dx in the box's units.

        Args:
            q: where.
            slopes: of J next to q, which are good enough for a small step.
        """
        return vanishing_block(self.jacobian(q), self.slopes(q) if slopes is None else slopes, self.rank - 1)


def _shrinking(before: Array | None, step: Array) -> float | None:
    """Return the ratio of two steps that shrink as they do towards a zero of order m ≥ 2, by 1 − 1/m each time: the
    zero is then at step / (1 − ratio). None of other steps.
    """
    size = float(np.linalg.norm(step))
    if before is None or size == 0:
        return None
    last = float(np.linalg.norm(before))
    straight = float(step @ before) >= STRAIGHT * size * last
    return size / last if straight and SHRINKS[0] <= size / last <= SHRINKS[1] else None


def singular_points(robot: Robot, task: Task, box: JointBox, rng: np.random.Generator) -> SingularPoints:
    """Return the singular set of a task: ρ and the usual σ₁ are the largest at 16 random configurations."""
    if robot.nv == 0:
        return SingularPoints(robot, task, box, 0, 0.0)
    sigmas = [np.linalg.svd(unitless_jacobian(robot, task, q), compute_uv=False) for q in box.random(rng, 16)]
    rank = max(numeric_rank(sigma) if sigma[0] > MOVES else 0 for sigma in sigmas)
    return SingularPoints(robot, task, box, rank, max(float(sigma[0]) for sigma in sigmas))


def _note_on_limits(samples: Array, limits: JointBox, names: Sequence[str]) -> str:
    """Return which limits all samples (k, n) are at; or, if none of them is inside, which they are outside of, by less
    than 1e-6. "" if neither.
    """
    sides = (("lower", samples - limits.lower), ("upper", limits.upper - samples))
    at: list[str] = []
    outside: list[str] = []
    none_inside = not any(limits.contains(q, ROUNDING) for q in samples)
    for word, distances in sides:
        inside = distances / limits.unit
        beyond = (inside < -ROUNDING).any(axis=0) & ~limits.circular & none_inside
        near = (np.abs(inside).max(axis=0) <= NEAR) & ~limits.circular & ~beyond
        at += [f"the {word} limit of {names[int(i)]}" for i in np.flatnonzero(near)]
        outside += [f"the {word} limit of {names[int(i)]}" for i in np.flatnonzero(beyond)]
    lines = [f"It lies at {enumeration(at)}."] if at else []
    if outside:
        lines.append(f"It lies outside {enumeration(outside)} by less than {NEAR:g}, so that the arm can come to it.")
    return " ".join(lines)
