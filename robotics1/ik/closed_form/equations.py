"""The equations of a chain between two of its links, whose pose in one another is known.

Of the joints between them some are moved to the side of the target: the a first and the b last. Then, with L the side
of the target and M that of the joints,

    directions      L d = M d
    positions       L o = M o
    distances       |L o − f|² = |M o − f|²
    from an axis    |L o − f|² − (n·(L o − f))² = ...
    along a line    (L o − f)·L d = (M o − f)·M d

for points o and f that are fixed in the last and in the first link, directions d, and the axis n of the next joint.
This is the procedure of Paul, with the distances of Pieper.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.ik.closed_form.links import Links, Step
from robotics1.symbolic.kinematics.chain import Chain, cross
from robotics1.symbolic.polynomials.trig_polynomial import Matrix, TrigPolynomial

SIDES = ((0, 0), (1, 0), (0, 1), (1, 1), (2, 0), (0, 2))  # joints that are moved to the side of the target


@dataclass(frozen=True, eq=False)
class PartOfChain:
    """The joints i + 1, ..., j that are still between two links, and the pose of link j in link i.

    Attributes:
        R: (3, 3) axes of link j in link i.
        p: (3,) where the point `point` of link j is in link i.
    """

    chain: Chain
    links: Links
    i: int
    j: int
    R: Matrix
    p: Matrix
    point: Matrix

    def equations(self, a: int, b: int) -> Iterator[TrigPolynomial]:
        """Return the equations f = 0 with the first a and the last b joints on the side of the target."""
        if a + b > self.j - self.i:
            return
        yield from self._directions(a, b)
        for point in self._points(b):
            L = self._in_first_link(point, b)
            M = point
            for step in reversed(self._steps(a, b)):
                M = step.point(M)
            yield from self._positions(a, L, M)
            yield from self._distances(a, b, L, M)

    def _points(self, b: int) -> list[Matrix]:
        if b == 0:
            others = [point for point in self.links.points[self.j] if any(point - self.point)]
            return [self.point, *others]
        return list(self.links.points[self.j - b])

    def _steps(self, a: int, b: int) -> list[Step]:
        return list(self.links.steps[self.i + a : self.j - b])

    def _in_first_link(self, point: Matrix, b: int) -> tuple[Matrix, Matrix]:
        """Return v = (point, from the known one) in link j, and p + R v in link i."""
        v = point
        for step in self.links.steps[self.j - b : self.j]:
            v = step.point_behind(v)
        v = v - self.point
        return v, self.p + self.R @ v

    def _directions(self, a: int, b: int) -> Iterator[TrigPolynomial]:
        d = self.chain.still[0]
        right = d
        for step in self.links.steps[self.j - b : self.j]:
            right = step.direction_behind(right)
        L = self.R @ right
        for step in self.links.steps[self.i : self.i + a]:
            L = step.direction_behind(L)
        M = d
        for step in reversed(self._steps(a, b)):
            M = step.direction(M)
        yield from (L - M).flat
        axes = self.links.steps
        first = axes[self.i + a].R @ axes[self.i + a].axis if self.i + a < self.j - b else None
        last = axes[self.j - b - 1].axis if self.i + a < self.j - b else None
        if first is not None:
            yield from first @ (L - M)
            yield from (L - M) @ last
            yield first @ (L - M) @ last

    def _positions(self, a: int, L: tuple[Matrix, Matrix], M: Matrix) -> Iterator[TrigPolynomial]:
        point = L[1]
        for step in self.links.steps[self.i : self.i + a]:
            point = step.point_behind(point)
        e = point - M
        yield from e
        if self.i + a < self.j:
            step = self.links.steps[self.i + a]
            yield (step.R @ step.axis) @ e
            if not step.turns:  # what is normal to a slide's axis does not change
                yield from cross(step.R @ step.axis, e)

    def _distances(self, a: int, b: int, L: tuple[Matrix, Matrix], M: Matrix) -> Iterator[TrigPolynomial]:
        """Return the equations with squares and products, with RᵀR = 1 used."""
        two, v, turned = self.chain.trig_ring.constant(2), L[0], L[1] - self.p
        inner, still = self.links.steps[self.i + a : self.j - b], not any(v)
        if inner:
            d, right, along = self._line(inner, b, v)
        for f_last in self.links.points[self.i + a]:
            f = f_last
            for step in reversed(self.links.steps[self.i : self.i + a]):
                f = step.point(f)
            u, m = self.p - f, M - f_last
            square = u @ u - m @ m
            if not still:
                square = square + two * (u @ turned) + v @ v
            yield square
            if inner:
                yield u @ right + along - m @ d
                if still and a == 0:
                    n = inner[0].R @ inner[0].axis
                    yield square - ((n @ u) * (n @ u) - (n @ m) * (n @ m))

    def _line(self, inner: Sequence[Step], b: int, v: Matrix) -> tuple[Matrix, Matrix, TrigPolynomial]:
        """Return the last axis d between the links as M d and L d, and v·d."""
        d = right = inner[-1].axis
        for step in self.links.steps[self.j - b : self.j]:
            right = step.direction_behind(right)
        for step in reversed(inner):
            d = step.direction(d)
        along: Any = v @ right
        return d, np.asarray(self.R @ right), along
