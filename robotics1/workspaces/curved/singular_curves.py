"""The curves D(x, y) = 0 on which two joints are singular, followed between limits and the points where they cross.

D changes its sign across such a curve. Where ∇D = 0 on it, branches cross: the curves are cut there, and each branch is
followed into the point along circles that shrink to it.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.curved.domain import INSIDE, Domain
from robotics1.workspaces.curved.level_lines import level_lines, zeros_between
from robotics1.workspaces.curved.plane_map import PlaneMap

EXACT = 1e-8  # rad between a curve and its spline; the image's error is its square
ROUNDS = 9  # of refinement
CIRCLE = 720  # samples around a crossing
SHRINKING = 8  # circles around it, at least
LEAST_RADIUS = 2.5  # of the largest of them, in steps of the grid
LARGEST_RADIUS = 0.5  # rad


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
    values = mapped.determinant(_on(grid)).reshape(len(grid[0]), len(grid[1]))
    values[values == 0] = 1e-300
    lines = level_lines(mapped.determinant, grid, values, domain.circular)
    step = np.array([np.diff(grid[0]).max(), np.diff(grid[1]).max()])
    nodes = crossings_of_branches(mapped, domain, lines, step)
    clear = True
    if len(nodes):
        lines, clear = _cut_at(mapped, domain, lines, nodes, step)
    curves = []
    for line, closed in lines:
        points = _refined(mapped, line, closed)
        curves.append(JointCurve(_with_positive_left(mapped, points), closed, 2))
    return curves, clear


def _on(grid: tuple[Array, Array]) -> Array:
    return np.stack(np.meshgrid(*grid, indexing="ij"), axis=-1).reshape(-1, 2)


def crossings_of_branches(mapped: PlaneMap, domain: Domain, lines: list[tuple[Array, bool]], step: Array) -> Array:
    """Return the points (k, 2) at which D = 0 and ∇D = 0, near the lines D = 0."""
    if not lines:
        return np.zeros((0, 2))
    slopes = [np.linalg.norm(mapped.gradient(line), axis=1) for line, _ in lines]
    slope = np.concatenate(slopes)
    some = np.vstack([line[_is_least(values)] for (line, _), values in zip(lines, slopes, strict=True)])
    q = some.copy()
    for _ in range(14):
        change = -np.einsum("kij,kj->ki", np.linalg.pinv(_hessian(mapped, q), rcond=1e-8), mapped.gradient(q))
        q += np.clip(change, -0.3, 0.3)
    scale = max(1e-12, float(slope.max()))
    size = max(1e-12, float(np.abs(mapped.determinant(_on(domain.grid(24)))).max()))
    good = (np.linalg.norm(mapped.gradient(q), axis=1) < 1e-9 * scale) & (np.abs(mapped.determinant(q)) < 1e-9 * size)
    good &= (np.abs(q - some) < 8 * step).all(axis=1) & domain.holds(q, -INSIDE * float(domain.span.max()))
    found: list[Array] = []
    for p in q[good]:
        if all(np.abs(domain.difference(p, other)).max() > 1e-5 for other in found):
            found.append(p)
    return np.array(found).reshape(-1, 2)


def _is_least(values: Array) -> Array:
    """Return which values along a line are not larger than those beside them."""
    padded = np.concatenate([[np.inf], values, [np.inf]])
    return np.asarray((values <= padded[:-2]) & (values <= padded[2:]))


def _hessian(mapped: PlaneMap, q: Array) -> Array:
    h = 1e-5
    columns = [(mapped.gradient(q + h * e) - mapped.gradient(q - h * e)) / (2 * h) for e in np.eye(2)]
    H = np.stack(columns, axis=-1)
    return np.asarray((H + H.transpose(0, 2, 1)) / 2)


def _cut_at(
    mapped: PlaneMap, domain: Domain, lines: list[tuple[Array, bool]], nodes: Array, step: Array
) -> tuple[list[tuple[Array, bool]], bool]:
    """Return the lines outside small ellipses around the crossings, with each branch led into its crossing.

    And whether each branch goes on as one line.
    """
    radii = [_radius(mapped, domain, nodes, k, step) for k in range(len(nodes))]
    rays = [ray for node, r in zip(nodes, radii, strict=True) for ray in _branches(mapped, node, r * step)]
    used = np.zeros(len(rays), dtype=int)
    found: list[tuple[Array, bool]] = []
    for line, closed in lines:
        inside = np.zeros(len(line), dtype=bool)
        for node, r in zip(nodes, radii, strict=True):
            inside |= np.linalg.norm(domain.difference(line, node) / step, axis=1) < r
        if not inside.any():
            found.append((line, closed))
            continue
        for part in _parts(line, inside, closed):
            begin, end = (_ray_at(domain, part[i], rays, step) for i in (0, -1))
            found.append((_led_in(domain, part, rays, begin, end), False))
            for k in (begin, end):
                used[k] += k >= 0
    return found, bool((used == 1).all())


def _radius(mapped: PlaneMap, domain: Domain, nodes: Array, k: int, step: Array) -> float:
    """Return the radius of the ellipse around a crossing, in steps of the grid.

    It is so large that the branches are apart there: they cross at the angle at which the form of the Hessian is 0.
    """
    others = np.delete(nodes, k, axis=0)
    apart = np.linalg.norm(domain.difference(others, nodes[k]) / step, axis=1) if len(others) else np.array([np.inf])
    low, high = np.linalg.eigvalsh(_hessian(mapped, nodes[k : k + 1])[0] * np.outer(step, step))
    half = np.arctan(np.sqrt(-low / high)) if low < 0 < high else np.pi / 4
    half = max(min(half, np.pi / 2 - half), 1e-6)
    wanted = max(LEAST_RADIUS, 0.8 / np.sin(half))
    return float(min(wanted, LARGEST_RADIUS / float(step.max()), 0.45 * apart.min()))


def _branches(mapped: PlaneMap, node: Array, radii: Array) -> list[Array]:
    """Return the branches (k, 2) of D = 0 from an ellipse around a crossing into it."""

    def around(angle: Array, share: float) -> Array:
        return np.asarray(node + share * radii * np.column_stack([np.cos(angle), np.sin(angle)]))

    angles = 0.001 + np.arange(CIRCLE + 1) * 2 * np.pi / CIRCLE
    signs = mapped.determinant(around(angles, 1.0)) > 0
    changed = np.flatnonzero(signs[1:] != signs[:-1])
    circles = max(SHRINKING, int(radii.max() / 0.02))
    found = []
    for a, b in zip(angles[changed], angles[changed + 1], strict=True):
        low, high, line = a, b, []
        for share in np.linspace(1, 0, circles + 1)[:-1]:

            def value(x: Array, share: float = share) -> Array:
                return mapped.determinant(around(x[:, 0], share))

            reach = (high - low) / 2 + (0.0 if share == 1 else 0.3)
            centre = (low + high) / 2
            trial = centre + np.linspace(-reach, reach, 41 if share < 1 else 2)[:, None]
            flips = np.flatnonzero(np.diff(value(trial) > 0))
            if not len(flips):
                break
            k = flips[np.argmin(np.abs(trial[flips, 0] - centre))]
            root = float(zeros_between(value, trial[k : k + 1], trial[k + 1 : k + 2])[0, 0])
            low = high = root
            line.append(around(np.array([root]), share)[0])
        found.append(np.array([*line, node]))
    return found


def _parts(line: Array, inside: Array, closed: bool) -> list[Array]:
    """Return the runs of points that are outside."""
    if closed:
        start = int(np.flatnonzero(inside)[0])
        jump = line[-1] - line[0]
        line = np.vstack([line[start:-1], line[: start + 1] + jump])
        inside = np.concatenate([inside[start:-1], inside[: start + 1]])
    found: list[Array] = []
    run: list[Array] = []
    for p, within in zip(line, inside, strict=True):
        if within:
            if run:
                found.append(np.array(run))
            run = []
        else:
            run.append(p)
    return [*found, np.array(run)] if run else found


def _led_in(domain: Domain, part: Array, rays: list[Array], begin: int, end: int) -> Array:
    """Return a run of points with the branches from its ends into the crossings that it comes from and goes to."""
    pieces = [part]
    if begin >= 0:
        pieces.insert(0, (part[0] + domain.difference(rays[begin], part[0]))[::-1])
    if end >= 0:
        pieces.append(part[-1] + domain.difference(rays[end], part[-1]))
    return np.vstack(pieces)


def _ray_at(domain: Domain, p: Array, rays: list[Array], step: Array) -> int:
    """Return the number of the branch that begins next to a point, or −1."""
    far = np.array([np.linalg.norm(domain.difference(ray[0], p) / step) for ray in rays])
    nearest = int(np.argmin(far))
    return nearest if far[nearest] < 2.0 else -1


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
