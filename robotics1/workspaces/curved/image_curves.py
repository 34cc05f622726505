"""Critical curves in the section: the images of singular curves and of limits, and their pieces that rise all the way.

The section is looked at in coordinates (across, up), a little turned, so that nothing is level by symmetry.
"""

import itertools
from dataclasses import dataclass
from math import cos, sin
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.curved.domain import INSIDE, Domain
from robotics1.workspaces.curved.level_lines import zeros_between
from robotics1.workspaces.curved.plane_map import PlaneMap
from robotics1.workspaces.curved.singular_curves import JointCurve, spline_through

TURN = 0.3819660113  # rad
TURNED = np.array([[cos(TURN), -sin(TURN)], [sin(TURN), cos(TURN)]])  # (ρ, h) → (across, up)
GAUSS = np.polynomial.legendre.leggauss(12)


@dataclass(frozen=True, eq=False)
class ImageCurve:
    """A critical curve: q(t) on a curve of the domain, and its image.

    Attributes:
        mapped: the map from the domain to the section.
        curve: the curve in the domain.
    """

    mapped: PlaneMap
    curve: JointCurve

    @cached_property
    def _spline(self) -> tuple[Any, Array]:
        return spline_through(self.curve.points, self.curve.closed)

    @property
    def knots(self) -> Array:
        """The values of t at the points of the curve."""
        return self._spline[1]

    def q(self, t: Array) -> Array:
        """Return (x, y) at t (k,): (k, 2)."""
        return np.asarray(self._spline[0](t))

    def at(self, t: Array) -> Array:
        """Return the section's coordinates at t (k,): (k, 2)."""
        return self.mapped.image(self.q(t))

    def velocity(self, t: Array) -> Array:
        """Return the derivative of `at` by t: (k, 2)."""
        return self.mapped.velocity(self.q(t), np.asarray(self._spline[0](t, 1)))

    def roots(self, f: Any, a: Array, b: Array) -> Array:
        """Return where f of t changes its sign between values a (k,) and b (k,)."""
        return zeros_between(lambda t: f(t[:, 0]), np.reshape(a, (-1, 1)), np.reshape(b, (-1, 1)))[:, 0]


@dataclass(frozen=True, eq=False)
class RisingPiece:
    """A part of a critical curve along which `up` only grows.

    Attributes:
        number: of the image curve.
        t: (k,) values along it, in the direction in which it rises.
        up: (k,) at t.
        jump: by how many solutions the side to the left of it has more than that to the right.
        image: the image curve; None of the axis, ρ = 0.
    """

    number: int
    t: Array
    up: Array
    jump: int
    image: ImageCurve | None

    @property
    def low(self) -> float:
        """The lowest `up`."""
        return float(self.up[0])

    @property
    def high(self) -> float:
        """The highest `up`."""
        return float(self.up[-1])

    def parameter(self, up: Array) -> Array:
        """Return t where the piece is at heights `up` (k,), clipped to its ends."""
        k = np.clip(np.searchsorted(self.up, up, side="right") - 1, 0, len(self.up) - 2)
        a, b = self.t[k], self.t[k + 1]
        image = self.image
        if image is None:
            return np.asarray(a + (up - self.up[k]) / (self.up[k + 1] - self.up[k]) * (b - a))
        inside = (up > self.up[k]) & (up < self.up[k + 1])
        t = np.where(up <= self.up[k], a, b)
        t[inside] = image.roots(lambda t: image.at(t) @ TURNED[1] - up[inside], a[inside], b[inside])
        return t

    def is_left_of(self, turned: Array) -> npt.NDArray[np.bool_]:
        """Return whether the piece is left of points (k, 2), given as (across, up), at their heights."""
        k = np.clip(np.searchsorted(self.up, turned[:, 1], side="right") - 1, 0, len(self.up) - 2)
        a, b = self._across_at_t[k], self._across_at_t[k + 1]
        room = np.abs(b - a) + self.up[k + 1] - self.up[k]
        left = np.asarray(np.maximum(a, b) + room < turned[:, 0])
        unsure = np.flatnonzero(~left & (np.minimum(a, b) - room < turned[:, 0]))
        left[unsure] = self.across(turned[unsure, 1]) < turned[unsure, 0]
        return left

    @cached_property
    def _across_at_t(self) -> Array:
        return np.asarray(self.place(self.t) @ TURNED[0])

    def place(self, t: Array) -> Array:
        """Return the section's coordinates at t."""
        if self.image is None:
            return np.column_stack([np.zeros(len(t)), t])
        return self.image.at(t)

    def across(self, up: Array) -> Array:
        """Return the other coordinate where the piece is at heights `up`."""
        return np.asarray(self.place(self.parameter(up)) @ TURNED[0])

    def integrals(self, up: Array) -> Array:
        """Return ∫ ρ dh and ∫ ½ρ² dh between heights that follow each other, (k − 1, 2), exact for smooth pieces."""
        if self.image is None:
            return np.zeros((len(up) - 1, 2))
        t = self.parameter(up)
        nodes, weights = GAUSS
        inner = [np.concatenate([[a], self._between(a, b), [b]]) for a, b in itertools.pairwise(t)]
        ends = np.concatenate(inner)
        keep = np.concatenate([np.concatenate([np.ones(len(e) - 1, bool), [False]]) for e in inner])[:-1]
        a, half = ends[:-1][keep], np.diff(ends)[keep] / 2
        at = (a[:, None] + half[:, None] * (1 + nodes)).ravel()
        rho, dh = self.image.at(at)[:, 0], self.image.velocity(at)[:, 1]
        density = np.column_stack([rho * dh, rho**2 / 2 * dh]).reshape(len(a), len(nodes), 2)
        parts = np.einsum("kgi,g,k->ki", density, weights, half)
        owner = np.repeat(np.arange(len(inner)), [len(e) - 1 for e in inner])
        total = np.zeros((len(up) - 1, 2))
        np.add.at(total, owner, parts)
        return total

    def _between(self, a: float, b: float) -> Array:
        """Return every eighth value of `t` strictly between two."""
        inside = self.t[(self.t > min(a, b)) & (self.t < max(a, b))][::8]
        return inside


def image_curves(mapped: PlaneMap, domain: Domain, singular: list[JointCurve]) -> list[ImageCurve]:
    """Return the images of the singular curves, and of the limits, cut where D changes its sign."""
    limits, snapped = _limit_curves(mapped, domain, singular)
    return [ImageCurve(mapped, curve) for curve in (*snapped, *limits)]


def _limit_curves(
    mapped: PlaneMap, domain: Domain, singular: list[JointCurve]
) -> tuple[list[JointCurve], list[JointCurve]]:
    """Return the sides of the domain in pieces, and the singular curves with their ends moved onto the sides."""
    points = [curve.points.copy() for curve in singular]
    found = []
    for k, name in ((1, "lower"), (0, "upper"), (1, "upper"), (0, "lower")):
        if domain.circular[k]:
            continue
        value = (domain.lower if name == "lower" else domain.upper)[k]
        along, forward = 1 - k, (name == "lower") == (k == 1)
        cuts = []
        for curve in points:
            for end in (0, -1):
                if abs(curve[end, k] - value) < 2 * INSIDE * domain.span[k]:
                    on_side = curve[end].copy()
                    on_side[k] = value
                    curve[end] = _root_along(mapped, on_side, along)
                    cuts.append(float(curve[end, along]))
        low, high = domain.lower[along], domain.upper[along]
        if domain.circular[along]:
            cuts = [low + (c - low) % (high - low) for c in cuts]
        ends = sorted({low, high, *cuts}) if not domain.circular[along] or not cuts else _around(sorted(cuts))
        for a, b in itertools.pairwise(ends):
            if b - a < 1e-12:
                continue
            whole = domain.circular[along] and len(ends) == 2
            found.append(_side(mapped, domain, k, name, (a, b) if forward else (b, a), whole))
    closed = [c.closed for c in singular]
    snapped = [JointCurve(p, c, 2) for p, c in zip(points, closed, strict=True)]
    return found, snapped


def _around(cuts: list[float]) -> list[float]:
    return [*cuts, cuts[0] + 2 * np.pi]


def _root_along(mapped: PlaneMap, q: Array, along: int) -> Array:
    """Return the point on a side of the domain at which D = 0, next to q; q itself if D = 0 all along the side."""
    p = q.copy()
    for _ in range(6):
        slope = mapped.gradient(p[None])[0, along]
        value = mapped.determinant(p[None])[0]
        if abs(slope) < 1e-9 or abs(value) > 1e-3 * abs(slope):
            return q
        p[along] -= value / slope
    return p if abs(p[along] - q[along]) < 1e-4 else q


def _side(mapped: PlaneMap, domain: Domain, k: int, name: str, ends: tuple[float, float], whole: bool) -> JointCurve:
    """Return a part of a side; its weight is the sign of D just inside."""
    sign = 1 if name == "lower" else -1
    value = (domain.lower if name == "lower" else domain.upper)[k]
    count = max(9, int(abs(ends[1] - ends[0]) / 0.03))
    points = np.empty((count, 2))
    points[:, 1 - k] = np.linspace(*ends, count)
    points[:, k] = value
    inside = points[1:-1].copy()
    inside[:, k] += sign * INSIDE * domain.span[k]
    weight = 1 if np.median(np.sign(mapped.determinant(inside))) > 0 else -1
    return JointCurve(points, whole, weight, (k, name))
