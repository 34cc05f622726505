"""Where branches of D = 0 cross: there ∇D = 0, and a grid cannot tell them apart. Each is led into the crossing.

The curves are cut at an ellipse around the crossing, and each branch is followed from there along ellipses that shrink
to it, as far as it is inside the limits.
"""

from collections.abc import Iterator

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.curved.domain import INSIDE, Domain
from robotics1.workspaces.curved.level_lines import points_of, zeros_between
from robotics1.workspaces.curved.plane_map import PlaneMap

CIRCLE = 720  # samples around a crossing
SHRINKING = 8  # ellipses around it, at least
LEAST_RADIUS = 2.5  # of the largest of them, in steps of the grid
LARGEST_RADIUS = 0.5  # rad
ON_LIMIT = 1e-9  # rad


def crossings_of_branches(mapped: PlaneMap, domain: Domain, lines: list[tuple[Array, bool]], step: Array) -> Array:
    """Return the points (k, 2) at which D = 0 and ∇D = 0, near the lines D = 0: inside, at a limit, or next to one."""
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
    size = max(1e-12, float(np.abs(mapped.determinant(points_of(domain.grid(24)))).max()))
    good = (np.linalg.norm(mapped.gradient(q), axis=1) < 1e-9 * scale) & (np.abs(mapped.determinant(q)) < 1e-9 * size)
    good &= (np.abs(q - some) < 8 * step).all(axis=1) & domain.holds(q, LEAST_RADIUS * step)
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


def cut_at(
    mapped: PlaneMap, domain: Domain, lines: list[tuple[Array, bool]], nodes: Array, step: Array
) -> tuple[list[tuple[Array, bool]], bool]:
    """Return the lines outside small ellipses around the crossings, with each branch led into its crossing.

    And whether each branch goes on as one line.
    """
    radii = [_radius(mapped, domain, nodes, k, step) for k in range(len(nodes))]
    branches = [ray for node, r in zip(nodes, radii, strict=True) for ray in _branches(mapped, node, r * step)]
    parts = [part for branch in branches for part in _inside(domain, branch)]
    rays = [ray for ray, begins in parts if begins]
    found: list[tuple[Array, bool]] = [(ray, False) for ray, begins in parts if not begins]
    used = np.zeros(len(rays), dtype=int)
    for line, closed in lines:
        within = np.zeros(len(line), dtype=bool)
        for node, r in zip(nodes, radii, strict=True):
            within |= np.linalg.norm(domain.difference(line, node) / step, axis=1) < r
        if not within.any():
            found.append((line, closed))
            continue
        for part in _parts(line, within, closed):
            begin, end = (_ray_at(domain, part[i], rays, step) for i in (0, -1))
            found.append((_led_in(domain, part, rays, begin, end), False))
            for k in (begin, end):
                used[k] += k >= 0
    return found, bool((used == 1).all())


def _inside(domain: Domain, branch: Array) -> Iterator[tuple[Array, bool]]:
    """Yield the parts of a branch inside the limits, up to the limits, and whether each is where the branch begins."""
    holds = domain.holds(branch, -INSIDE / 2 * domain.span)
    if len(branch) > 1 and holds[-2]:
        holds[-1] = domain.holds(branch[-1:], ON_LIMIT)[0]
    edges = np.flatnonzero(np.diff(np.concatenate([[False], holds, [False]])))
    for a, b in edges.reshape(-1, 2):
        points = list(branch[a:b])
        if a > 0:
            points.insert(0, _at_limit(domain, branch[a], branch[a - 1]))
        if b < len(branch):
            points.append(_at_limit(domain, branch[b - 1], branch[b]))
        if len(points) > 1:
            yield np.array(points), bool(a == 0)


def _at_limit(domain: Domain, inner: Array, outer: Array) -> Array:
    """Return where the way from a point inside to one outside passes a limit."""
    way = outer - inner
    limit = np.where(way > 0, domain.upper, domain.lower)
    shares = np.divide(limit - inner, way, out=np.full(2, np.inf), where=(way != 0) & ~np.array(domain.circular))
    k = int(np.argmin(shares))
    point = inner + min(max(float(shares[k]), 0.0), 1.0) * way
    point[k] = limit[k]
    return np.asarray(point)


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
