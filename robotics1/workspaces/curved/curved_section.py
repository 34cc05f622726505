"""The section of an arm whose critical curves are no arcs: solutions at a point, and where it is in the section."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.axes import distinct
from robotics1.workspaces.curved.base_range import BaseRange
from robotics1.workspaces.curved.boundary_parts import BoundaryPart
from robotics1.workspaces.curved.image_curves import TURNED
from robotics1.workspaces.curved.limited_boundary import LimitedBoundary
from robotics1.workspaces.curved.reading_in_space import SpatialArm
from robotics1.workspaces.curved.strips import Strips
from robotics1.workspaces.placed_section import PlacedSection, in_section

ON_BOUNDARY = 1e-9  # of the arm's size: a point that near belongs to the workspace
SAME = 1e-6  # of solutions that are one
SOLVED = 1e-11  # of a point, when the arm is one long
NEAREST = (12, 100)  # of them, on each side of D = 0, for many points; the second where solutions are missing
EVERY = 10**6  # of them: all
STEPS = 20
SINGULAR = 1e-4  # of D, at which a double solution is known to the root of its error only
STUCK = 1e-13  # rad: a step of Newton's method that does not move
STARTS = 64  # cells a turn of the grid from which solutions are looked for


@dataclass(frozen=True, eq=False)
class CurvedSection(PlacedSection):
    """Two joints that move a point in a section.

    Attributes:
        arm: the joints.
        strips: the section, cut into strips.
        boundary: the parts of critical curves that are the boundary.
    """

    arm: SpatialArm
    strips: Strips
    boundary: tuple[BoundaryPart, ...]

    def _placed(self, p: npt.ArrayLike) -> tuple[Array, Array]:
        """Return a point (m,) in the section, (2,), and in its frame, (3,) [sizes]."""
        local = self.place.local(p) / self.arm.size
        return in_section(local, self.place.about_axis), local

    def counts(self, z: Array) -> npt.NDArray[np.intp]:
        """Return the numbers of solutions at points (k, 2) of the section, whatever the base's limits are."""
        turned = z @ TURNED.T
        total = np.zeros(len(z), dtype=np.intp)
        for piece in self.strips.pieces:
            here = np.flatnonzero((turned[:, 1] >= piece.low) & (turned[:, 1] < piece.high))
            if piece.jump and len(here):
                passed = piece.is_left_of(turned[here])
                total[here[passed]] -= piece.jump
        return np.maximum(total, 0)

    def _is_reached(self, z: Array) -> bool:
        """Return whether a point (2,) of the section is reached, whatever the base's limits are."""
        return bool(self.counts(z[None])[0]) or any(part.is_at(z, ON_BOUNDARY) for part in self.boundary)

    def solutions(self, z: Array) -> Array:
        """Return the values (n, 2) of the two joints at a point (2,) of the section."""
        if not self._is_reached(z):
            return np.zeros((0, 2))
        expected = np.maximum(self.counts(z[None]), 1)
        return self.solutions_each(z[None], expected, (*NEAREST, EVERY))[0]

    @cached_property
    def _starts(self) -> tuple[Array, Array]:
        grid = self.arm.domain.grid(STARTS)
        q = np.stack(np.meshgrid(*grid, indexing="ij"), axis=-1).reshape(-1, 2)
        return q, self.arm.mapped.image(q)

    def _at(self, q: Array, z: Array) -> Array:
        """Return those of q (k, 2) that lead to a point (2,), each once."""
        there = q[np.linalg.norm(z - self.arm.mapped.image(q), axis=1) < ON_BOUNDARY]
        return self.arm.domain.wrapped(there[distinct(there, self.arm.domain.circular, SAME)])

    def newton_at(self, q: Array, z: Array) -> Array:
        """Return where Newton's method, kept inside the limits, ends from q (k, 2) for points (k, 2)."""
        mapped, domain = self.arm.mapped, self.arm.domain
        q, left = q.copy(), np.arange(len(q))
        for _ in range(STEPS):
            image, J = mapped.image_and_jacobian(q[left])
            e = z[left] - image
            off = np.abs(e).max(axis=1) > SOLVED
            left, at, e, J = left[off], q[left[off]], e[off], J[off]
            if not len(left):
                break
            H = J.transpose(0, 2, 1) @ J + 1e-14 * np.eye(2)
            step = np.clip(np.linalg.solve(H, J.transpose(0, 2, 1) @ e[..., None])[..., 0], -0.4, 0.4)
            q[left] = np.where(domain.circular, at + step, np.clip(at + step, domain.lower, domain.upper))
            left = left[np.abs(q[left] - at).max(axis=1) > STUCK]
        return q

    def contains(self, p: npt.ArrayLike) -> bool:
        """Return whether a point is reached inside the limits; the boundary belongs to the workspace."""
        z, local = self._placed(p)
        if not self.place.limited:
            return self._is_reached(z)
        return any(self._base_values(q, local) for q in self.solutions(z))

    def configurations(self, p: npt.ArrayLike) -> Array:
        """Return the configurations (k, nq) that reach a point inside the limits."""
        z, local = self._placed(p)
        found = [self.arm.configuration(q, value) for q in self.solutions(z) for value in self._base_values(q, local)]
        return np.array(found).reshape(-1, len(self.place.neutral))

    def _base_values(self, q: Array, local: Array) -> list[float]:
        """Return the values of the base at which the two joints reach a point (3,) of the frame [sizes]."""
        base, size = self.place.base, self.arm.size
        if base is None:
            return [0.0]
        own = self.arm.mapped.point(q[None])[0]
        near = ON_BOUNDARY / max(abs(float(self.arm.mapped.determinant(q[None])[0])), SINGULAR)
        if base.revolute and np.hypot(own[0], own[1]) < ON_BOUNDARY:
            return [min(max(0.0, base.lower), base.upper)]
        if base.revolute:
            value = base.value_at(float(np.arctan2(local[1], local[0]) - np.arctan2(own[1], own[0])), near)
        else:
            value = base.value_at(float(local[2] - own[2]) * size, near * size)
        return [] if value is None else [value]

    def distance(self, p: npt.ArrayLike) -> float:
        """Return the distance of a point from the boundary [m]."""
        z, local = self._placed(p)
        limited = self._limited
        return self.arm.size * (self.distance_in_section(z) if limited is None else limited.distance(local))

    def clearance(self, p: npt.ArrayLike) -> float:
        """Return a length [m] that the distance is not below: the distance itself, or what a grid tells of it."""
        limited = self._limited
        return self.distance(p) if limited is None else self.arm.size * limited.clearance(self._placed(p)[1])

    @cached_property
    def _limited(self) -> LimitedBoundary | None:
        base = self.place.base
        if base is None or base.circular:
            return None
        unit = 1.0 if base.revolute else self.arm.size
        return LimitedBoundary(BaseRange(self, base.lower / unit, base.upper / unit))

    def contains_each(self, points: Array) -> npt.NDArray[np.bool_]:
        """Return which points (k, m) are reached; those on the boundary may be or not."""
        places = [self._placed(p) for p in points]
        z = np.array([flat for flat, _ in places]).reshape(-1, 2)
        counts = self.counts(z)
        if not self.place.limited:
            return np.asarray(counts > 0)
        solved = self.solutions_each(z, counts)
        return np.array(
            [
                any(self._base_values(one, local) for one in q) or (len(q) < count and self.contains(p))
                for q, count, (_, local), p in zip(solved, counts, places, points, strict=True)
            ],
            dtype=bool,
        )

    def sphere_ranges(self, place: Array) -> list[tuple[float, float]]:
        """Return the smallest and largest distance of a point at (ρ, h) [m] from each turned part of the boundary."""
        z = place / self.arm.size
        behind = np.array([-z[0], z[1]])
        return [(self.arm.size * part.distance(z), self.arm.size * part.farthest(behind)) for part in self.boundary]

    def _extent(self) -> tuple[Array, tuple[float, float]]:
        z, base = self.arm.size * np.vstack([part.points for part in self.boundary]), self.place.base
        own = self.arm.size * self.arm.mapped.point(self._starts[0])[:, 2]
        low, high = (0.0, 0.0) if base is None else (base.lower, base.upper)
        return z, (float(own.min()) + low, float(own.max()) + high)

    def depth(self, place: Array) -> float:
        """Return the distance of a place (2,) of the section from its boundary [m]; negative outside."""
        z = place / self.arm.size
        far = self.arm.size * self.distance_in_section(z)
        return far if self.counts(z[None])[0] else -far

    def distance_in_section(self, z: Array) -> float:
        """Return the distance of a point (2,) of the section from its boundary."""
        return min((part.distance(z) for part in self.boundary), default=np.inf)

    def solutions_each(
        self, z: Array, expected: npt.NDArray[np.intp], nearest: tuple[int, ...] = NEAREST
    ) -> list[Array]:
        """Return the values (n, 2) of the two joints at points (k, 2) of the section, from the nearest ones of a grid.

        Args:
            z: the points.
            expected: (k,) their numbers of solutions; where fewer were found, farther ones of the grid are tried.
            nearest: how many of the grid on each side of D = 0, and then where solutions are missing.
        """
        from scipy.spatial import cKDTree

        starts, images = self._starts
        positive = self.arm.mapped.determinant(starts) > 0
        sides = [np.flatnonzero(positive), np.flatnonzero(~positive)]
        trees = [(side, cKDTree(images[side])) for side in sides if len(side)]
        solved: list[Array] = [np.zeros((0, 2))] * len(z)
        left = np.flatnonzero(expected > 0)
        for most in nearest:
            if not len(left):
                break
            near = [side[np.atleast_2d(tree.query(z[left], min(most, len(side)))[1])] for side, tree in trees]
            k = np.hstack([numbers.reshape(len(left), -1) for numbers in near])
            ends = self.newton_at(starts[k.ravel()], np.repeat(z[left], k.shape[1], axis=0)).reshape(*k.shape, 2)
            for i, found in zip(left, ends, strict=True):
                solved[i] = self._at(found, z[i])
            left = np.array([i for i in left if len(solved[i]) < expected[i]], dtype=int)
        return solved
