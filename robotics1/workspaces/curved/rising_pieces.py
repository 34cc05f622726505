"""Critical curves cut at their cusps, their highest and their lowest points."""

import itertools
from collections.abc import Sequence

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.curved.image_curves import TURNED, ImageCurve, RisingPiece

SHORTEST = 1e-12  # of `up`, below which a piece is a point
FINE = 4  # parts of each span of a spline
AROUND = 6 * FINE  # parts, before and behind a cusp: there the speed is |t − t₀|, but for a factor
UNLIKE = 10.0  # ratio of speeds before and behind


def rising_pieces(curves: Sequence[ImageCurve]) -> tuple[list[RisingPiece], list[tuple[int, float]]]:
    """Return the pieces, and the cusps as (number of the curve, t)."""
    pieces: list[RisingPiece] = []
    found: list[tuple[int, float]] = []
    for number, curve in enumerate(curves):
        knots = curve.knots
        t = np.concatenate(
            [[knots[0]], (knots[:-1, None] + np.diff(knots)[:, None] * (1 + np.arange(FINE)) / FINE).ravel()]
        )
        velocity = curve.velocity(t)
        if np.abs(curve.at(t) - curve.at(t[:1])).max() < 1e-10:
            continue  # the image is a point
        cusps = _cusps(curve, t, velocity) if curve.curve.limit is None else []
        found += [(number, c) for c in cusps]
        t = np.unique(np.concatenate([t, cusps])) if cusps else t
        ends = [t[0], *cusps, *_turns(curve, t), t[-1]]
        ends = sorted(set(map(float, ends)))
        for a, b in itertools.pairwise(ends):
            pieces += _piece(number, curve, t, a, b)
    return pieces, found


def _cusps(curve: ImageCurve, t: Array, velocity: Array) -> list[float]:
    """Return t where a singular curve is tangent to the direction that does not move the point: it turns back."""
    length = np.linalg.norm(velocity, axis=1)
    scale = max(float(length.max()), 1e-300)
    if scale < 1e-9:
        return []
    good = np.flatnonzero(length > 1e-9 * scale)
    back = np.flatnonzero((velocity[good[1:]] * velocity[good[:-1]]).sum(axis=1) < 0)
    found = []
    for i, j in zip(good[back], good[back + 1], strict=True):
        direction = velocity[i] / length[i]
        at = float(curve.roots(lambda s, d=direction: curve.velocity(s) @ d, t[i], t[j])[0])
        there = np.linalg.norm(curve.velocity(np.array([at]))[0])
        before, after = length[max(i - AROUND, 0)], length[min(j + AROUND, len(t) - 1)]
        alike = max(before, after) < UNLIKE * min(before, after)  # else two branches nearly meet, and make a corner
        if there < 1e-5 * scale and alike:  # else it is a corner on the axis
            found.append(at)
    return found


def _turns(curve: ImageCurve, t: Array) -> list[float]:
    rate = curve.velocity(t) @ TURNED[1]
    changed = np.flatnonzero((rate[1:] > 0) != (rate[:-1] > 0))
    return list(curve.roots(lambda s: curve.velocity(s) @ TURNED[1], t[changed], t[changed + 1]))


def _piece(number: int, curve: ImageCurve, t: Array, a: float, b: float) -> list[RisingPiece]:
    inside = t[(t > a + 1e-12) & (t < b - 1e-12)]
    s = np.concatenate([[a], inside, [b]])
    if len(s) < 6:
        s = np.unique(np.concatenate([s, np.linspace(a, b, 9)]))
    up = curve.at(s) @ TURNED[1]
    falls = up[-1] < up[0]
    if falls:
        s, up = s[::-1], up[::-1]
    if up[-1] - up[0] < SHORTEST:
        return []
    up = np.maximum.accumulate(up)
    keep = np.concatenate([[True], np.diff(up) > 0])
    keep[-1] = True
    s, up = s[keep], up[keep]
    weight = curve.curve.weight
    return [RisingPiece(number, s, up, -weight if falls else weight, curve)]
