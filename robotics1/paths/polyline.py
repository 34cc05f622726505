"""Polylines: straight from point to point, with the corners cut by arcs or parabolas."""

from itertools import pairwise

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, one_of, per_joint
from robotics1.paths.harmonic import PARALLEL, line_path, turning
from robotics1.paths.path import Path
from robotics1.paths.path_sequence import PathSequence
from robotics1.paths.points import moderate, point, steps_between
from robotics1.paths.polynomial_path import PolynomialPath


def polyline_path(
    points: npt.ArrayLike,
    *,
    blend: npt.ArrayLike = 0.0,
    radius: npt.ArrayLike | None = None,
    kind: str = "circular",
) -> PathSequence:
    """Return the polyline through the points, each corner passed over by a blend that begins and ends at a distance d.

    At a corner of the turning angle α (0 where it is straight), with unit directions t₁ and t₂:
    a circular blend has the radius r = d/tan(α/2), and passes the corner at r (1/cos(α/2) − 1); s is the arc length.
    A parabolic blend is p = p₁ + t₁ u + (t₂ − t₁) u²/4d, 0 ≤ u ≤ 2d, and passes at (d/2) sin(α/2); there s = u is not
    the arc length: |p'| goes down to cos(α/2).

    Args:
        points: (m, n) in order [m], m ≥ 2.
        blend: d [m] of all corners, or (m − 2,) one for each; 0 leaves the corner, where p' jumps.
        radius: r [m] of circular blends in place of d, likewise.
        kind: "circular" or "parabolic".

    Raises:
        InputError: consecutive points are the same, blends are longer than a segment, or a path that turns back
            is to be blended by an arc.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, chapter 8.
    """
    points = point("points", points, (None, None), "one point a row")
    steps = steps_between(points)
    one_of("kind", kind, ("circular", "parabolic"))
    directions = np.diff(points, axis=0) / steps[:, None]
    angles = np.array([_turning_angle(t1, t2) for t1, t2 in pairwise(directions)])
    d = _distances(blend, radius, kind, angles)
    d = np.where(d > PARALLEL * np.minimum(steps[:-1], steps[1:]), d, 0.0)  # none so small that it is rounding
    refuse_overlap(steps, d, d)
    pieces: list[Path] = []
    cuts = np.concatenate([[0.0], d, [0.0]])
    for i, (t, step) in enumerate(zip(directions, steps, strict=True)):
        start, end = points[i] + cuts[i] * t, points[i + 1] - cuts[i + 1] * t
        if step - cuts[i] - cuts[i + 1] > 1e-9 * step:
            pieces.append(line_path(start, end))
        if i < len(angles) and d[i] > 0:
            pieces.append(_blend(kind, end, t, directions[i + 1], float(d[i]), float(angles[i])))
    return PathSequence(tuple(pieces))


def refuse_overlap(steps: Array, before: Array, after: Array) -> None:
    """Raise InputError where blends need more than a segment has.

    Args:
        steps: (m,) lengths of the segments.
        before, after: (m − 1,) how far each blend reaches from its corner into the segment before and after it.
    """
    needed = np.concatenate([before, [0.0]]) + np.concatenate([[0.0], after])
    for i, (need, step) in enumerate(zip(needed, steps, strict=True)):
        if need > step * (1 + 1e-9):
            raise InputError(
                f"the blends must fit in the segments; from point {i} to point {i + 1} there is {step:.6g}, "
                f"and they need {need:.6g}: make them shorter"
            )


def _distances(blend: npt.ArrayLike, radius: npt.ArrayLike | None, kind: str, angles: Array) -> Array:
    """Return d of each corner; a corner that is straight has none."""
    name = "blend" if radius is None else "radius"
    given = moderate(name, per_joint(name, blend if radius is None else radius, len(angles)))
    if (given < 0).any():
        raise InputError(f"{name} must not be negative; it is {given.tolist()}")
    if kind == "circular" and (given[angles > np.pi - PARALLEL] > 0).any():
        raise InputError("a path that turns back has no circular blend; blend that corner with 0, or parabolically")
    if radius is None:
        return np.where(angles > PARALLEL, given, 0.0)
    if kind != "circular":
        raise InputError(f"only circular blends have a radius; give blend= of {kind} ones")
    return np.asarray(given * np.tan(angles / 2))


def _turning_angle(t1: Array, t2: Array) -> float:
    """Return the angle from t1 to t2, in [0, π], exact also near 0 and π."""
    return float(2 * np.arctan2(np.linalg.norm(t2 - t1), np.linalg.norm(t2 + t1)))


def _blend(kind: str, start: Array, t1: Array, t2: Array, d: float, angle: float) -> Path:
    if kind == "parabolic":
        return PolynomialPath(np.array([start, t1, (t2 - t1) / (4 * d)])[:, None], np.array([0.0, 2 * d]))
    r = d / np.tan(angle / 2)
    inward = t2 - np.cos(angle) * t1
    inward = r * inward / np.linalg.norm(inward)
    return turning(start + inward, -inward, r * t1, np.zeros_like(t1), angle)
