"""Parts of critical curves between what is reached and what is not."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.curved.image_curves import ImageCurve, RisingPiece
from robotics1.workspaces.curved.strips import TOGETHER, Strips

SAMPLES = 24  # at least, along a part
JOINED = 1e-9  # of t


@dataclass(frozen=True, eq=False)
class BoundaryPart:
    """A critical curve from t = a to t = b.

    Attributes:
        image: the curve.
        a, b: its ends.
    """

    image: ImageCurve
    a: float
    b: float

    @cached_property
    def t(self) -> Array:
        """Values along it, at the knots of its spline and between them."""
        knots = self.image.knots
        inner = knots[(knots > self.a + JOINED) & (knots < self.b - JOINED)]
        return np.asarray(np.unique(np.concatenate([inner, np.linspace(self.a, self.b, SAMPLES)])))

    @cached_property
    def points(self) -> Array:
        """The section's coordinates at `t`: (k, 2)."""
        return self.image.at(self.t)

    @cached_property
    def chord(self) -> float:
        """The largest distance of `points` that follow each other."""
        return float(np.linalg.norm(np.diff(self.points, axis=0), axis=1).max())

    def is_at(self, z: Array, near: float) -> bool:
        """Return whether a point (2,) of the section is on the curve, but for a distance."""
        return bool(np.linalg.norm(self.points - z, axis=1).min() <= self.chord + near and self.distance(z) < near)

    def distance(self, z: Array) -> float:
        """Return the least distance of a point (2,) of the section."""
        return self._extreme(z, 1)

    def farthest(self, z: Array) -> float:
        """Return the largest distance of a point (2,) of the section."""
        return -self._extreme(z, -1)

    def _extreme(self, z: Array, sign: int) -> float:
        """Return the least value of the distance times a sign: at a sample, or where its slope changes beside one."""
        far = sign * np.linalg.norm(self.points - z, axis=1)
        best = float(far.min())
        padded = np.concatenate([[np.inf], far, [np.inf]])
        least = np.flatnonzero((far <= padded[:-2]) & (far <= padded[2:]) & (far < best + 2 * self.chord))

        def slope(t: Array) -> Array:
            return np.asarray(sign * ((self.image.at(t) - z) * self.image.velocity(t)).sum(axis=1))

        for k in map(int, least):
            a, b = float(self.t[max(k - 1, 0)]), float(self.t[min(k + 1, len(self.t) - 1)])
            for low, high in ((a, float(self.t[k])), (float(self.t[k]), b)):
                at_ends = slope(np.array([low, high]))
                if at_ends[0] < 0 < at_ends[1]:
                    t = self.image.roots(slope, np.array([low]), np.array([high]))
                    best = min(best, sign * float(np.linalg.norm(self.image.at(t)[0] - z)))
        return best


def boundary_parts(
    strips: Strips, images: Sequence[ImageCurve], cusps: Sequence[tuple[int, float]]
) -> list[BoundaryPart]:
    """Return the parts of curves on whose one side nothing is reached; on the axis, ρ = 0, there is no boundary."""
    spans: dict[int, list[tuple[float, float]]] = {}
    for before, after in zip(strips.strips[:-1], strips.strips[1:], strict=True):
        if before.level != after.level or before.right is None or (before.count > 0) == (after.count > 0):
            continue
        piece = strips.pieces[before.right]
        if piece.image is None:
            continue
        t = strips.parameters[before.right, before.level : before.level + 2]
        if piece.image.mapped.about_axis and piece.image.at(t.mean(keepdims=True))[0, 0] < TOGETHER:
            continue
        spans.setdefault(before.right, []).append((float(t.min()), float(t.max())))
    joined: dict[int, list[tuple[float, float]]] = {}
    for i, found in spans.items():
        joined.setdefault(strips.pieces[i].number, []).extend(_snapped(strips.pieces[i], found))
    sharp: dict[int, set[float]] = {}
    for number, cusp in cusps:
        sharp.setdefault(number, set()).add(cusp)
    return [
        BoundaryPart(images[number], a, b)
        for number, found in sorted(joined.items())
        for a, b in _merged(found, sharp.get(number, set()))
    ]


def _snapped(piece: RisingPiece, found: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return intervals with ends that are those of the piece exactly, where the levels are its own ends."""
    low, high = sorted((float(piece.t[0]), float(piece.t[-1])))
    near = 1e-4 * (high - low)
    return [(low if a - low < near else a, high if high - b < near else b) for a, b in found]


def _merged(found: list[tuple[float, float]], cusps: set[float]) -> list[tuple[float, float]]:
    """Return intervals of t that touch as one, but at cusps."""
    merged: list[tuple[float, float]] = []
    for a, b in sorted(found):
        if merged and a - merged[-1][1] < 1e-6 and not any(abs(a - c) < 1e-6 for c in cusps):
            merged[-1] = (merged[-1][0], max(b, merged[-1][1]))
        else:
            merged.append((a, b))
    return merged
