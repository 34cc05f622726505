"""The curves D(x, y) = 0 on which two joints are singular, followed between limits and the points where they cross.

D changes its sign across such a curve. Where branches cross, the curves are cut (`branch_crossings`).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.curved.branch_crossings import crossings_of_branches, cut_at
from robotics1.workspaces.curved.domain import Domain
from robotics1.workspaces.curved.level_lines import level_lines, points_of
from robotics1.workspaces.curved.plane_map import PlaneMap

EXACT = 1e-8  # rad between a curve and its spline; the image's error is its square
ROUNDS = 9  # of refinement


@dataclass(frozen=True, eq=False)
class JointCurve:
    """A curve in the domain: a cubic spline through points that are exact.

    Attributes:
        points: (k, 2) from its start to its end.
        closed: whether it comes back to its start.
        weight: by how many solutions its left side has more than its right side, in the section.
        limit: (place of the joint, "lower" or "upper") if a joint is at a limit; None where the joints are singular.
    """

    points: Array
    closed: bool
    weight: int
    limit: tuple[int, str] | None = None


def singular_curves(mapped: PlaneMap, domain: Domain, cells: int) -> tuple[list[JointCurve], bool]:
    """Return the curves on which D changes its sign, with D > 0 on their left, and whether they are sure.

    They are not where a branch at a crossing is not one of the lines that the grid shows: it is too coarse then.
    """
    grid = domain.grid(cells)
    values = mapped.determinant(points_of(grid)).reshape(len(grid[0]), len(grid[1]))
    values[values == 0] = 1e-300
    lines = level_lines(mapped.determinant, grid, values, domain.circular)
    step = np.array([np.diff(grid[0]).max(), np.diff(grid[1]).max()])
    nodes = crossings_of_branches(mapped, domain, lines, step)
    clear = True
    if len(nodes):
        lines, clear = cut_at(mapped, domain, lines, nodes, step)
    curves = []
    for line, closed in lines:
        points = _refined(mapped, line, closed)
        curves.append(JointCurve(_with_positive_left(mapped, points), closed, 2))
    return curves, clear


def _refined(mapped: PlaneMap, points: Array, closed: bool) -> Array:
    """Return the points of a curve with as many more as its spline needs, all on D = 0."""
    points = points[np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-9])]
    for _ in range(ROUNDS):
        spline, t = spline_through(points, closed)
        middle = spline((t[:-1] + t[1:]) / 2)
        on = onto_singular(mapped, middle)
        far = np.linalg.norm(on - middle, axis=1)
        chord = np.diff(t)
        wanted = (far > EXACT) & (far < 0.5 * chord) & (chord > 1e-6)
        if not wanted.any() or len(points) > 20_000:
            break
        points = np.insert(points, np.flatnonzero(wanted) + 1, on[wanted], axis=0)
    return points


def onto_singular(mapped: PlaneMap, q: Array) -> Array:
    """Return the points of D = 0 next to q (k, 2), by Newton's method across the curve."""
    for _ in range(4):
        gradient = mapped.gradient(q)
        square = (gradient**2).sum(axis=1)
        q = q - (mapped.determinant(q) / np.where(square > 1e-30, square, np.inf))[:, None] * gradient
    return q


def spline_through(points: Array, closed: bool) -> tuple[Any, Array]:
    """Return a cubic spline by the length of its chords, and its values at the points (k,)."""
    from scipy.interpolate import CubicSpline

    t = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    if closed and len(points) > 8:
        jump = points[-1] - points[0]
        wide = np.vstack([points[-5:-1] - jump, points, points[1:5] + jump])
        at = np.concatenate([t[-5:-1] - t[-1], t, t[1:5] + t[-1]])
        return CubicSpline(at, wide), t
    return CubicSpline(t, points), t


def _with_positive_left(mapped: PlaneMap, points: Array) -> Array:
    """Return the points in the direction in which D > 0 is on the left."""
    middle, along = (points[1:] + points[:-1]) / 2, np.diff(points, axis=0)
    slope = mapped.gradient(middle)
    return points if (slope[:, 1] * along[:, 0] - slope[:, 0] * along[:, 1]).sum() > 0 else points[::-1].copy()
