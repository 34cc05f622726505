"""Critical curves of a section, swept by a first joint with limits.

A point is on the boundary where it is in no interval of a solution that there is beyond the curve.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import tau

import numpy as np

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.curved.base_range import ALIKE, FINER, ROUNDS, BaseRange, Candidate, least_of
from robotics1.workspaces.curved.image_curves import TURNED, ImageCurve

SAMPLES = 24  # of a part of a critical curve
ASIDE = 1e-7  # how far beside a critical curve the solutions beyond it are looked for
NARROW = 1e-7  # of an interval that is none


@dataclass(frozen=True, eq=False)
class _Curve:
    """Samples of a part of a critical curve.

    Attributes:
        image: the curve.
        jump: by how many solutions its left side has more, seen upwards.
        t, z: (k,) values along it, and (k, 2) the section's coordinates there.
        open: (k, 2) from where to where it is on the boundary, see `_open_part`.
    """

    image: ImageCurve
    jump: int
    t: Array
    z: Array
    open: Array


@dataclass(frozen=True, eq=False)
class SweptCurves:
    """The swept curves of a section."""

    range: BaseRange

    def candidates(self, local: Array) -> list[Candidate]:
        """Return the parts of the swept curves that may be the nearest to a point (3,) of the section's frame."""
        found = []
        for curve in self._curves:
            far = self._far(curve.z, curve.open, local)
            chord = np.linalg.norm(np.diff(curve.z, axis=0), axis=1)
            for i in least_of(far, far - np.maximum(np.append(chord, 0.0), np.append(0.0, chord)), (len(far), 1)):
                t, least = _closer(partial(self._far_from_curve, curve, local, True), curve.t, curve.t[i])
                found.append(Candidate(least, partial(self._followed_on_curve, curve, i, local, t, least)))
        return found

    def clearance(self, local: Array) -> float:
        """Return what the distances of the samples, less the longest chord of each curve, are at least."""
        least = np.inf
        for curve in self._curves:
            chord = np.linalg.norm(np.diff(curve.z, axis=0), axis=1).max()
            least = min(least, float((self._far(curve.z, curve.open, local) - chord).min()))
        return least

    @cached_property
    def _curves(self) -> list[_Curve]:
        found = []
        for piece in self.range.section.strips.pieces:
            if piece.image is None or piece.jump == 0:
                continue
            t = np.linspace(float(piece.t[0]), float(piece.t[-1]), SAMPLES)
            found.append(
                _Curve(piece.image, piece.jump, t, piece.place(t), self._open_part(piece.image, piece.jump, t))
            )
        return found

    def _open_part(self, image: ImageCurve, jump: int, t: Array) -> Array:
        """Return from where to where no solution beyond a curve goes over it, at t (k,): (k, 2), or NaN."""
        length, around = self.range.length, self.range.turns
        found = np.tile([0.0, length], (len(t), 1))
        q = image.q(t)
        for row, offset in zip(found, self.range.offsets(q, self._beyond(image, jump, t)), strict=True):
            before = offset - tau if around else offset[offset < 0]
            after = offset if around else offset[offset >= 0]
            row[0] = max(0.0, float((before + length).max(initial=0.0)))
            row[1] = min(length, float(after.min(initial=length)))
        found[found[:, 1] - found[:, 0] < NARROW] = np.nan
        return np.asarray(self.range.whole(q)[:, :1] + found)

    def _beyond(self, image: ImageCurve, jump: int, t: Array) -> list[Array]:
        """Return the solutions at t (k,) that there are on the side of a curve where there are fewer."""
        section, v = self.range.section, image.velocity(t)
        upwards = np.sign(v @ TURNED[1]) * np.sign(jump)
        right = np.column_stack([v[:, 1], -v[:, 0]]) / (np.linalg.norm(v, axis=1) + 1e-300)[:, None]
        z = image.at(t)
        beside = z + ASIDE * upwards[:, None] * right
        found = section.solutions_each(beside, section.counts(beside))
        there = section.newton_at(np.vstack(found), np.repeat(z, [len(one) for one in found], axis=0))
        return np.split(there, np.cumsum([len(one) for one in found])[:-1])

    def _far(self, z: Array, open_part: Array, local: Array) -> Array:
        """Return how far a point (3,) is from curves at z (k, 2), swept from one w to another (k, 2); inf of NaN."""
        low, high = open_part.T
        if not self.range.turns:
            beyond = np.maximum(np.maximum(low - local[2], local[2] - high), 0.0)
            far = np.sqrt(((z - local[:2]) ** 2).sum(axis=1) + beyond**2)
            return np.asarray(np.where(np.isnan(far), np.inf, far))
        rho, angle = np.hypot(local[0], local[1]), np.arctan2(local[1], local[0])
        within = (angle - low) % tau
        turn = np.where(within <= high - low, 0.0, np.minimum(tau - within, within - (high - low)))
        across = z[:, 0] ** 2 + rho**2 - 2 * rho * z[:, 0] * np.cos(turn)
        far = np.sqrt(np.maximum(across, 0.0) + (z[:, 1] - local[2]) ** 2)
        return np.asarray(np.where(np.isnan(far), np.inf, far))

    def _far_from_curve(self, curve: _Curve, local: Array, whole: bool, t: Array) -> Array:
        part = self.range.whole(curve.image.q(t)) if whole else self._open_part(curve.image, curve.jump, t)
        return self._far(curve.image.at(t), part, local)

    def _followed_on_curve(self, curve: _Curve, i: int, local: Array, t: float, least: float, best: float) -> float:
        """Return the least distance from the open part of a swept curve, near its sample i that is open."""
        far = partial(self._far_from_curve, curve, local, False)
        at_best = float(far(np.array([t]))[0])
        return at_best if at_best <= least + ALIKE else _closer(far, curve.t, curve.t[i])[1]


def _closer(far: Callable[[Array], Array], samples: Array, t: float) -> tuple[float, float]:
    """Return t beside a sample at which `far` is least, and what it is there."""
    low, high = sorted((samples[0], samples[-1]))
    step, least = 2 * abs(samples[1] - samples[0]) / FINER, np.inf
    for _ in range(ROUNDS):
        near = np.clip(t + np.arange(-FINER, FINER + 1) * step, low, high)
        values = far(near)
        i = int(np.argmin(values))
        if values[i] < least:
            t, least = float(near[i]), float(values[i])
        step /= 2
    return t, least
