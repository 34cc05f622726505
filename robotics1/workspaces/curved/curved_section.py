"""The section of an arm whose critical curves are no arcs: solutions at a point, and where it is in the section."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi, tau

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.inputs import Array, real_array
from robotics1.workspaces.axes import Axis
from robotics1.workspaces.curved.base_range import BaseRange
from robotics1.workspaces.curved.boundary_parts import BoundaryPart
from robotics1.workspaces.curved.domain import Domain
from robotics1.workspaces.curved.image_curves import TURNED
from robotics1.workspaces.curved.limited_boundary import LimitedBoundary
from robotics1.workspaces.curved.plane_map import PlaneMap
from robotics1.workspaces.curved.strips import Strips
from robotics1.workspaces.extents import corners_of_box

ON_BOUNDARY = 1e-9  # of the arm's size: a point that near belongs to the workspace
SAME = 1e-6  # of solutions that are one
SOLVED = 1e-11  # of a point, when the arm is one long
NEAREST = (12, 100)  # of them, on each side of D = 0, for many points; the second where solutions are missing
STEPS = 20
SINGULAR = 1e-4  # of D, at which a double solution is known to the root of its error only
STUCK = 1e-13  # rad: a step of Newton's method that does not move
STARTS = 64  # cells a turn of the grid from which solutions are looked for


@dataclass(frozen=True, eq=False)
class CurvedSection:
    """Two joints that move a point in a section, and a joint before them that moves the section.

    Attributes:
        mapped, domain: the map, and the values of the two joints.
        strips: the section, cut into strips.
        boundary: the parts of critical curves that are the boundary.
        joints: the two joints.
        base: the joint before them; None of a task with two coordinates.
        rows: (m, 3) the rows of the task.
        origin, frame: of the section: p = frame (P − origin) / size, with the last row along the base.
        size: a length of the size of the arm [m].
        neutral: (nq,) the values of the joints that do not move the point.
    """

    mapped: PlaneMap
    domain: Domain
    strips: Strips
    boundary: tuple[BoundaryPart, ...]
    joints: tuple[Axis, Axis]
    base: Axis | None
    rows: Array
    origin: Array
    frame: Array
    size: float
    neutral: Array

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

    def solutions(self, z: Array) -> Array:
        """Return the values (n, 2) of the two joints at a point (2,) of the section."""
        expected = int(self.counts(z[None])[0])
        starts, images = self._starts
        distance = np.linalg.norm(images - z, axis=1)
        order = np.argsort(distance)
        found: Array = np.zeros((0, 2))
        for count in (48, 400, len(order)):
            found = self._distinct(self._newton(starts[order[:count]], z))
            if len(found) >= max(expected, 1):
                break
        return found

    @cached_property
    def _starts(self) -> tuple[Array, Array]:
        grid = self.domain.grid(STARTS)
        q = np.stack(np.meshgrid(*grid, indexing="ij"), axis=-1).reshape(-1, 2)
        return q, self.mapped.image(q)

    def _newton(self, q: Array, z: Array) -> Array:
        """Return the values to which Newton's method leads from q (k, 2), where it ends at the point and inside."""
        ends = self.newton_at(q, np.broadcast_to(z, q.shape))
        return np.asarray(ends[np.linalg.norm(z - self.mapped.image(ends), axis=1) < ON_BOUNDARY])

    def newton_at(self, q: Array, z: Array) -> Array:
        """Return where Newton's method, kept inside the limits, ends from q (k, 2) for points (k, 2)."""
        limited = ~np.array(self.domain.circular)
        q, left = q.copy(), np.arange(len(q))
        for _ in range(STEPS):
            e = z[left] - self.mapped.image(q[left])
            left = left[np.abs(e).max(axis=1) > SOLVED]
            if not len(left):
                break
            at, e = q[left], z[left] - self.mapped.image(q[left])
            a, b = (self.mapped.velocity(at, np.broadcast_to(d, at.shape)) for d in np.eye(2))
            ab = (a * b).sum(1)
            H = np.stack([np.stack([(a * a).sum(1), ab], 1), np.stack([ab, (b * b).sum(1)], 1)], 1)
            g = np.stack([(a * e).sum(1), (b * e).sum(1)], 1)
            step = np.clip(np.linalg.solve(H + 1e-14 * np.eye(2), g[..., None])[..., 0], -0.4, 0.4)
            ahead = np.where(limited, np.clip(at + step, self.domain.lower, self.domain.upper), at + step)
            q[left] = ahead
            left = left[np.abs(ahead - at).max(axis=1) > STUCK]
        return q

    def _distinct(self, q: Array) -> Array:
        """Return the values (k, 2) that are not those of one before them."""
        apart = np.abs(self.domain.difference(q[:, None], q[None])).max(axis=-1)
        return self.domain.wrapped(q[~np.tril(apart < SAME, -1).any(axis=1)])

    def place(self, p: npt.ArrayLike) -> tuple[Array, Array]:
        """Return a point (m,) in the section, (2,), and in its frame, (3,)."""
        point = self.rows.T @ real_array("p", p, (len(self.rows),), "the task's coordinates [m]")
        local = self.frame @ (point - self.origin) / self.size
        flat = np.array([np.hypot(local[0], local[1]), local[2]]) if self.mapped.about_axis else local[:2]
        return flat, local

    def contains(self, p: npt.ArrayLike) -> bool:
        """Return whether a point is reached inside the limits; the boundary belongs to the workspace."""
        z, _ = self.place(p)
        reached = bool(self.counts(z[None])[0]) or any(part.is_at(z, ON_BOUNDARY) for part in self.boundary)
        if not reached or self.base is None or self.base.circular:
            return reached
        return len(self.configurations(p)) > 0

    def configurations(self, p: npt.ArrayLike) -> Array:
        """Return the configurations (k, nq) that reach a point inside the limits."""
        z, local = self.place(p)
        found = [self.configuration(q, value) for q in self.solutions(z) for value in self._base_values(q, local)]
        return np.array(found).reshape(-1, len(self.neutral))

    def _base_values(self, q: Array, local: Array) -> list[float]:
        """Return the values of the base at which the two joints reach a point."""
        base = self.base
        if base is None:
            return [0.0]
        own = self.mapped.point(q[None])[0]
        near = ON_BOUNDARY / max(abs(float(self.mapped.determinant(q[None])[0])), SINGULAR)
        if not base.revolute:
            value = float(local[2] - own[2]) * self.size
            return [value] if base.lower - near * self.size <= value <= base.upper + near * self.size else []
        if np.hypot(own[0], own[1]) < ON_BOUNDARY:
            return [min(max(0.0, base.lower), base.upper)]
        angle = float(np.arctan2(local[1], local[0]) - np.arctan2(own[1], own[0]))
        beyond = (angle - base.lower) % tau
        if near < beyond - (base.upper - base.lower) and beyond < tau - near:
            return []
        return [base.lower + (beyond if beyond < tau - near else beyond - tau)]

    def configuration(self, q: Array, base: float | None = None) -> Array:
        """Return all joints' values (nq,) [rad or m] of values (2,) of the two joints."""
        values = self.neutral.copy()
        for joint, value in zip(self.joints, self.domain.wrapped(q), strict=True):
            centred = (value + pi) % tau - pi
            if joint.circular and joint.lower <= centred <= joint.upper:
                values[joint.number] = centred
            else:
                values[joint.number] = value if joint.revolute else value * self.size
        if self.base is not None and base is not None:
            values[self.base.number] = base
        return values

    def distance(self, p: npt.ArrayLike) -> float:
        """Return the distance of a point from the boundary [m]."""
        z, local = self.place(p)
        limited = self._limited
        return self.size * (self.distance_in_section(z) if limited is None else limited.distance(local))

    def clearance(self, p: npt.ArrayLike) -> float:
        """Return a length [m] that the distance is not below: the distance itself, or what a grid tells of it."""
        limited = self._limited
        return self.distance(p) if limited is None else self.size * limited.clearance(self.place(p)[1])

    @cached_property
    def _limited(self) -> LimitedBoundary | None:
        base = self.base
        if base is None or base.circular:
            return None
        unit = 1.0 if base.revolute else self.size
        return LimitedBoundary(BaseRange(self, base.lower / unit, base.upper / unit))

    def contains_each(self, points: Array) -> npt.NDArray[np.bool_]:
        """Return which points (k, m) are reached; those on the boundary may be or not."""
        places = [self.place(p) for p in points]
        z = np.array([flat for flat, _ in places]).reshape(-1, 2)
        counts = self.counts(z)
        if self.base is None or self.base.circular:
            return np.asarray(counts > 0)
        solved = self.solutions_each(z, counts)
        return np.array(
            [
                any(self._base_values(one, local) for one in q) or (len(q) < count and self.contains(p))
                for q, count, (_, local), p in zip(solved, counts, places, points, strict=True)
            ],
            dtype=bool,
        )

    def full_turn(self) -> tuple[Array, Array] | None:
        """Return a point (3,) and the direction (3,) of the axis about which a first joint turns fully; or None."""
        base = self.base
        return (base.point, base.direction) if base is not None and base.circular else None

    def sphere_ranges(self, place: Array) -> list[tuple[float, float]]:
        """Return the smallest and largest distance of a point at (ρ, h) [m] from each turned part of the boundary."""
        z = place / self.size
        behind = np.array([-z[0], z[1]])
        return [(self.size * part.distance(z), self.size * part.farthest(behind)) for part in self.boundary]

    def corners(self) -> Array:
        """Return the corners (8, 3) of a box around what is reached, in world axes [m]."""
        z = self.size * np.vstack([part.points for part in self.boundary])
        heights = None
        if not self.mapped.about_axis:
            own = self.size * self.mapped.point(self._starts[0])[:, 2]
            low, high = (0.0, 0.0) if self.base is None else (self.base.lower, self.base.upper)
            heights = (float(own.min()) + low, float(own.max()) + high)
        return corners_of_box(z, heights, self.frame, self.origin)

    def depth(self, place: Array) -> float:
        """Return the distance of a place (2,) of the section from its boundary [m]; negative outside."""
        z = place / self.size
        far = self.size * self.distance_in_section(z)
        return far if self.counts(z[None])[0] else -far

    def distance_in_section(self, z: Array) -> float:
        """Return the distance of a point (2,) of the section from its boundary."""
        return min((part.distance(z) for part in self.boundary), default=np.inf)

    def reached_shares(self, z: Array, expected: int) -> Array:
        """Return how far [rad, or sizes] the base leads the solutions at points (k, 2) of the section: (k,)."""
        return np.array([self._share(q) for q in self.solutions_each(z, np.full(len(z), expected))])

    def solutions_each(self, z: Array, expected: npt.NDArray[np.intp]) -> list[Array]:
        """Return the values (n, 2) of the two joints at points (k, 2) of the section, from the nearest ones of a grid.

        Args:
            z: the points.
            expected: (k,) their numbers of solutions; where fewer were found, farther ones of the grid are tried.
        """
        from scipy.spatial import cKDTree

        starts, images = self._starts
        positive = self.mapped.determinant(starts) > 0
        sides = [np.flatnonzero(positive), np.flatnonzero(~positive)]
        trees = [(side, cKDTree(images[side])) for side in sides if len(side)]
        solved: list[Array] = [np.zeros((0, 2))] * len(z)
        left = np.flatnonzero(expected > 0)
        for nearest in NEAREST:
            if not len(left):
                break
            near = [side[np.atleast_2d(tree.query(z[left], min(nearest, len(side)))[1])] for side, tree in trees]
            k = np.hstack([numbers.reshape(len(left), -1) for numbers in near])
            ends = self.newton_at(starts[k.ravel()], np.repeat(z[left], k.shape[1], axis=0)).reshape(*k.shape, 2)
            for i, found in zip(left, ends, strict=True):
                solved[i] = self._distinct(found[np.linalg.norm(self.mapped.image(found) - z[i], axis=1) < ON_BOUNDARY])
            left = np.array([i for i in left if len(solved[i]) < expected[i]], dtype=int)
        return solved

    def _share(self, q: Array) -> float:
        """Return the length of the union of what the base reaches with solutions (n, 2)."""
        base = self.base
        if base is None:
            return 1.0
        span, p = base.upper - base.lower, self.mapped.point(q)
        if base.revolute:
            return _union_on_circle(np.arctan2(p[:, 1], p[:, 0]), span)
        return _union(p[:, 2], span / self.size)


def _union(starts: Sequence[float] | Array, span: float) -> float:
    """Return the length of the union of intervals of one length."""
    gaps = np.diff(np.sort(starts))
    return float(np.minimum(gaps, span).sum() + span) if len(starts) else 0.0


def _union_on_circle(starts: Array, span: float) -> float:
    if not len(starts):
        return 0.0
    around = np.sort(starts % tau)
    gaps = np.diff(np.append(around, around[0] + tau))
    return float(np.minimum(gaps, span).sum())
