"""Polylines: straight from point to point, with the corners cut by arcs or parabolas; and motions along them."""

from __future__ import annotations

from itertools import pairwise
from typing import Literal

import numpy as np
import numpy.typing as npt

from robotics1.curves.arcs import PARALLEL, SAME_POINT, line_path, turning
from robotics1.curves.curve import Curve
from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.curves.sequence import CurveSequence
from robotics1.errors import InputError
from robotics1.inputs import LARGEST, Array, moderate, moderate_array, non_negative_numbers, one_of, positive_numbers

Blend = Literal["circular", "parabolic"]
SHORT = 1e-9  # of a segment: what is left of it between two blends, if it is less, is rounding


def polyline_path(
    points: npt.ArrayLike,
    *,
    blend: npt.ArrayLike = 0.0,
    radius: npt.ArrayLike | None = None,
    kind: Blend = "circular",
) -> Curve:
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
    points, steps = points_apart(points)
    one_of("kind", kind, ("circular", "parabolic"))
    directions = np.diff(points, axis=0) / steps[:, None]
    angles = np.array([_turning_angle(t1, t2) for t1, t2 in pairwise(directions)])
    d = _distances(blend, radius, kind, angles)
    d = np.where(d > PARALLEL * np.minimum(steps[:-1], steps[1:]), d, 0.0)  # none so small that it is rounding
    if kind == "parabolic":
        return _with_parabolas(points, steps, np.ones(len(steps)), 2 * d)
    _refuse_overlap(steps, d, d)
    pieces: list[Curve] = []
    cuts = np.concatenate([[0.0], d, [0.0]])
    for i, (t, step) in enumerate(zip(directions, steps, strict=True)):
        start, end = points[i] + cuts[i] * t, points[i + 1] - cuts[i + 1] * t
        if step - cuts[i] - cuts[i + 1] > SHORT * step:
            pieces.append(line_path(start, end))
        if i < len(angles) and d[i] > 0:
            pieces.append(_arc(end, t, directions[i + 1], float(d[i]), float(angles[i])))
    return CurveSequence(tuple(pieces))


def parabolic_blends(points: npt.ArrayLike, speeds: npt.ArrayLike, blend_times: npt.ArrayLike) -> PiecewisePolynomial:
    """Return the motion that passes near the inner points: v₁ on the first segment, v₂ on the second, and so on, with a
    constant acceleration (v₂ − v₁)/T_b during the blend time T_b in between.

    The blend is a parabola: p = p_a + v₁ t + (v₂ − v₁) t²/2T_b, which leaves the first segment at the distance
    |v₁| T_b/2 before the point, and reaches the second at |v₂| T_b/2 behind it. The motion begins with v₁ and ends
    with the last velocity: it is not at rest there.

    Args:
        points: (m, n) in order [m or rad], m ≥ 3.
        speeds: (m − 1,) on the segments [m/s or rad/s], or one for all.
        blend_times: (m − 2,) T_b at the inner points [s], or one for all.

    Raises:
        InputError: consecutive points are the same, a speed or a time is not positive, or a blend is longer than a
            segment.

    Source: Biagiotti, Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, chapter 8.
    """
    points, steps = points_apart(points)
    if len(points) < 3:
        raise InputError("parabolic_blends takes three points at least: there is none to pass over between two")
    speeds = positive_numbers("speeds", speeds, len(steps))
    return _with_parabolas(points, steps, speeds, positive_numbers("blend_times", blend_times, len(steps) - 1))


def _with_parabolas(points: Array, steps: Array, speeds: Array, blend_times: Array) -> PiecewisePolynomial:
    """Return straight segments at these speeds, and parabolas of these times, which may be zero, in between."""
    _refuse_overlap(steps, speeds[:-1] * blend_times / 2, speeds[1:] * blend_times / 2)
    v = np.diff(points, axis=0) * (speeds / steps)[:, None]
    halves = np.concatenate([[0.0], blend_times / 2, [0.0]])
    straight = steps / speeds - halves[1:] - halves[:-1]
    pieces: list[tuple[npt.ArrayLike, float]] = []
    for i, v1 in enumerate(v):
        if straight[i] > SHORT * steps[i] / speeds[i]:
            pieces.append(([points[i] + v1 * halves[i], v1 * straight[i]], float(straight[i])))
        if i < len(blend_times) and blend_times[i] > 0:
            T = float(blend_times[i])
            pieces.append(([points[i + 1] - v1 * T / 2, v1 * T, (v[i + 1] - v1) * T / 2], T))
    return PiecewisePolynomial.from_pieces(pieces)


def points_apart(points: npt.ArrayLike) -> tuple[Array, Array]:
    """Return points as (m, n), m ≥ 2, and the distances between consecutive ones, (m − 1,).

    Raises:
        InputError: there are fewer than two points, or two consecutive ones are the same.
    """
    rows = moderate_array("points", points, (None, None), "one point a row")
    if len(rows) < 2 or not rows.shape[1]:
        raise InputError(f"points must be two at least, with coordinates; they have the shape {rows.shape}")
    steps = np.linalg.norm(np.diff(rows, axis=0), axis=1)
    still = np.flatnonzero(steps <= max(SAME_POINT * float(np.abs(rows).max()), 1 / LARGEST))
    if still.size:
        i = int(still[0])
        raise InputError(f"consecutive points must differ; points {i} and {i + 1} are both {rows[i].tolist()}")
    return rows, np.asarray(steps)


def _refuse_overlap(steps: Array, before: Array, after: Array) -> None:
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
    given = moderate(name, non_negative_numbers(name, blend if radius is None else radius, len(angles)))
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


def _arc(start: Array, t1: Array, t2: Array, d: float, angle: float) -> Curve:
    """Return the arc that leaves a segment at a point and meets the next at the same distance from the corner."""
    r = d / np.tan(angle / 2)
    inward = t2 - np.cos(angle) * t1
    inward = r * inward / np.linalg.norm(inward)
    return turning(start + inward, -inward, r * t1, np.zeros_like(t1), angle)
