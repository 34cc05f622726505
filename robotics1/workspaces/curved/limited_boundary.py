"""The boundary of what three joints reach where the first one, the base, has limits; and how far a point is from it.

At a place of the section each solution of the two other joints leads to an interval of the base's coordinate w, an
angle or a height; what is reached there is the union of these. The boundary is made of sheets of two kinds:
- a wall, with the base at an end of its range: the surface p(x, y) that the two joints draw. A point of it is on the
  boundary unless the interval of another solution goes over it;
- a critical curve of the section, swept by the base. A point of it is on the boundary where it is in no interval of a
  solution that there is beyond the curve.

The nearest point of a sheet is looked for on a grid of its parameters, and then on ever finer ones.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from math import tau

import numpy as np

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.curved.base_range import BaseRange
from robotics1.workspaces.curved.image_curves import TURNED, ImageCurve, RisingPiece

ALIKE = 1e-9  # of ends of intervals, and of distances
NARROW = 1e-7  # of an interval that is none
ASIDE = 1e-7  # how far beside a critical curve the solutions beyond it are looked for
FINER, ROUNDS = 4, 60  # samples to each side of the best one, and how often other ones are taken, at most
SMOOTH, SHARP = 1e-8, 1e-11  # rad or sizes: the last steps, on a whole sheet and on a part of it
SAMPLES = 24  # of a part of a critical curve

Candidate = tuple[float, Callable[[float], float]]  # how near at least, and what tells how near if that is the best


@dataclass(frozen=True, eq=False)
class _Sheet(ABC):
    """A part of the boundary, over parameters u (k, d)."""

    range: BaseRange

    @abstractmethod
    def grid(self) -> list[Array]:
        """Return the values of each parameter at which the sheet is known first."""

    @abstractmethod
    def q(self, u: Array) -> Array:
        """Return the values of the two joints (k, 2); u that goes on beyond an end is that end."""

    @abstractmethod
    def whole(self, u: Array) -> Array:
        """Return from which w to which the sheet goes, (k, 2)."""

    @abstractmethod
    def open(self, u: Array) -> Array:
        """Return from which w to which it is on the boundary, (k, 2), or NaN."""

    def open_samples(self, u: Array) -> Array:
        """Return the same at the samples."""
        return self.open(u)

    @abstractmethod
    def chords(self, u: Array) -> Array:
        """Return how far samples (k,) are from those beside them, at most."""

    def candidates(self, local: Array) -> list[Candidate]:
        """Return what may be nearest to a point (3,)."""
        u, shape, part, chords = self._samples
        far = self._far(u, part, local)
        padded = np.pad(far.reshape(shape), 1, constant_values=np.inf)
        around = [padded[i : i + shape[0], j : j + shape[1]] for i in range(3) for j in range(3)]
        lowest = np.isfinite(far) & (far <= np.min(around, axis=0).ravel()) & (far - chords < far.min())
        return [self._candidate(start, local) for start in u[lowest]]

    def clearance(self, local: Array) -> float:
        """Return what the distances of the samples on the boundary, less their chords, are at least."""
        u, _, part, chords = self._samples
        return float((self._far(u, part, local) - chords).min())

    @cached_property
    def _samples(self) -> tuple[Array, tuple[int, int], Array, Array]:
        values = self.grid()
        u = np.stack(np.meshgrid(*values, indexing="ij"), axis=-1).reshape(-1, len(values))
        return u, (len(values[0]), len(u) // len(values[0])), self.open_samples(u), self.chords(u)

    def _far(self, u: Array, w: Array, local: Array) -> Array:
        return self.range.far(self.range.section.arm.mapped.image(self.q(u)), w, local)

    def _candidate(self, start: Array, local: Array) -> Candidate:
        at, least = self._closer(start, local)

        def follow(best: float) -> float:
            here = float(self._far(at[None], self.open(at[None]), local)[0])
            return here if here <= least + ALIKE else self._closer(start, local, self.open, best)[1]

        return least, follow

    def _closer(
        self, u: Array, local: Array, part: Callable[[Array], Array] | None = None, best: float = np.inf
    ) -> tuple[Array, float]:
        """Return where beside u (d,) the sheet, or a part of it, is nearest to a point, and how near, if not too far.

        A whole sheet is smooth there, so that the error of the distance is of the order of the last step's square.
        """
        step = np.array([abs(values[1] - values[0]) for values in self.grid()]) * 2 / FINER
        side = [np.arange(-FINER, FINER + 1)] * len(u)
        around = np.stack(np.meshgrid(*side, indexing="ij"), axis=-1).reshape(-1, len(u))
        least = np.inf
        for _ in range(ROUNDS):
            near, finer = u + around * step, True
            promised = self._far(near, self.whole(near), local)
            if promised.min() >= best or step.max() < (SMOOTH if part is None else SHARP):
                break
            closer = np.flatnonzero(promised < least)
            far = promised[closer] if part is None else self._far(near[closer], part(near[closer]), local)
            if len(far) and far.min() < least:
                i = closer[np.argmin(far)]
                u, least, finer = near[i], float(far.min()), np.abs(around[i]).max() <= FINER / 2
            step = step / 2 if finer else step
        return u, least


@dataclass(frozen=True, eq=False)
class _Wall(_Sheet):
    """What the two joints draw when the base is at an end of its range; u = (x, y)."""

    upper: bool

    def grid(self) -> list[Array]:
        return self.range.values_on_walls

    def q(self, u: Array) -> Array:
        domain = self.range.section.arm.domain
        return np.asarray(np.where(domain.circular, u, np.clip(u, domain.lower, domain.upper)))

    def whole(self, u: Array) -> Array:
        end = self.range.upper if self.upper else self.range.lower
        return np.repeat(self.range.coordinate(self.q(u))[:, None] + end, 2, axis=1)

    def open(self, u: Array) -> Array:
        return self._open(u, self.range.others(self.q(u)))

    def open_samples(self, u: Array) -> Array:
        return self._open(u, self.range.others_on_walls)

    def _open(self, u: Array, others: list[Array]) -> Array:
        length, turns, part = self.range.length, self.range.turns, self.whole(u)
        end, low, high = (length, -ALIKE, length - ALIKE) if self.upper else (0.0, ALIKE, length + ALIKE)
        for row, offset in zip(part, self.range.offsets(self.q(u), others), strict=True):
            within = (end - offset) % tau if turns else end - offset
            alike = np.abs(np.mod(offset + 1.0, tau) - 1.0) < ALIKE if turns else np.abs(offset) < ALIKE
            if ((within > low) & (within < high) & ~alike).any():
                row[:] = np.nan
        return part

    def chords(self, u: Array) -> Array:
        shape = [len(values) for values in self.grid()]
        p, most = self.range.section.arm.mapped.point(u).reshape(*shape, 3), np.zeros(shape)
        for axis in (0, 1):
            far = np.linalg.norm(np.diff(p, axis=axis), axis=-1)
            for beside in ((0, 1), (1, 0)):
                most = np.maximum(most, np.pad(far, [beside if k == axis else (0, 0) for k in (0, 1)]))
        return np.asarray(most.ravel())


@dataclass(frozen=True, eq=False)
class _SweptCurve(_Sheet):
    """A part of a critical curve that the base sweeps; u = (t,)."""

    piece: RisingPiece
    image: ImageCurve

    def grid(self) -> list[Array]:
        return [np.linspace(self.piece.t.min(), self.piece.t.max(), SAMPLES)]

    def _t(self, u: Array) -> Array:
        return np.asarray(np.clip(u[:, 0], self.piece.t.min(), self.piece.t.max()))

    def q(self, u: Array) -> Array:
        return self.image.q(self._t(u))

    def whole(self, u: Array) -> Array:
        return np.asarray(self.range.coordinate(self.q(u))[:, None] + np.array([self.range.lower, self.range.upper]))

    def open(self, u: Array) -> Array:
        length, turns = self.range.length, self.range.turns
        found = np.tile([0.0, length], (len(u), 1))
        for row, offset in zip(found, self.range.offsets(self.q(u), self._beyond(self._t(u))), strict=True):
            before, after = (offset - tau, offset) if turns else (offset[offset < 0], offset[offset >= 0])
            row[0] = max(0.0, float((before + length).max(initial=0.0)))
            row[1] = min(length, float(after.min(initial=length)))
        found[found[:, 1] - found[:, 0] < NARROW] = np.nan
        return np.asarray(self.whole(u)[:, :1] + found)

    def _beyond(self, t: Array) -> list[Array]:
        """Return the solutions at t (k,) that there are on the side of the curve where there are fewer."""
        section, v, z = self.range.section, self.image.velocity(t), self.image.at(t)
        upwards = np.sign(v @ TURNED[1]) * np.sign(self.piece.jump)
        right = np.column_stack([v[:, 1], -v[:, 0]]) / (np.linalg.norm(v, axis=1) + 1e-300)[:, None]
        beside = z + ASIDE * upwards[:, None] * right
        found = section.solutions_each(beside, section.counts(beside))
        there = section.newton_at(np.vstack(found), np.repeat(z, [len(one) for one in found], axis=0))
        return np.split(there, np.cumsum([len(one) for one in found])[:-1])

    def chords(self, u: Array) -> Array:
        return np.full(len(u), np.linalg.norm(np.diff(self.image.at(self._t(u)), axis=0), axis=1).max())


@dataclass(frozen=True, eq=False)
class LimitedBoundary:
    """Where the boundary is; lengths are shares of the arm's size."""

    range: BaseRange

    def distance(self, local: Array) -> float:
        """Return the distance of a point (3,) of the section's frame from the boundary."""
        best = np.inf
        candidates = [candidate for sheet in self._sheets for candidate in sheet.candidates(local)]
        for least, follow in sorted(candidates, key=lambda one: one[0]):
            if least >= best:
                break
            best = min(best, follow(best))
        return best

    def clearance(self, local: Array) -> float:
        """Return a length that the distance of a point (3,) is not below, but for what the grid does not show."""
        return max(0.0, min(sheet.clearance(local) for sheet in self._sheets))

    @cached_property
    def _sheets(self) -> list[_Sheet]:
        walls = [_Wall(self.range, upper) for upper in (False, True)]
        pieces = self.range.section.strips.pieces
        return [*walls, *(_SweptCurve(self.range, p, p.image) for p in pieces if p.jump and p.image is not None)]
