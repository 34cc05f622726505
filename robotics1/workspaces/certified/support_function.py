"""How far any number of joints reach in every direction, at most: the support function, joint by joint.

hᵢ(u) = max u · p over the values of the joints i, ..., m. It is convex and homogeneous, and follows from that of the
joints after it: hᵢ(u) = u · o + max [hᵢ₊₁(w) − w · o] with w = Rᵢ(v)ᵀ u, o a point of the axis. It is kept on a grid on
the faces of a cube. Between the values of a convex function, straight lines are never below it; so what is read from
the grid is never too small. Each joint adds an error of the order of the cell's square. A joint that mimics another
one is taken to be free, which makes h larger.

Source: Schneider, Convex Bodies: The Brunn–Minkowski Theory, 2nd edition, 2014, section 1.7; Bellman, Dynamic
Programming, 1957.
"""

from collections.abc import Callable
from dataclasses import dataclass
from time import monotonic

import numpy as np

from robotics1.inputs import Array
from robotics1.workspaces.axes import Axis
from robotics1.workspaces.chain import Chain

ARCS, PARTS, ROUNDS, KEPT = 32, 8, 3, 2  # of a turn; into which the best so many are cut, so many times
AT_ONCE = 4096  # directions
CIRCLE = 4096  # directions of a plane

Support = Callable[[Array], Array]  # directions (k, 3), of any length, → (k,)


@dataclass(frozen=True, eq=False)
class _Grid:
    """Values on the faces of a cube, (3, 2, n, n): the axis, its sign, and the other coordinates over the first."""

    values: Array

    def __call__(self, u: Array) -> Array:
        """Return what a convex homogeneous function is at most at u (k, 3)."""
        k = np.arange(len(u))
        axis = np.argmax(np.abs(u), axis=1)
        size, cells = np.abs(u[k, axis]), self.values.shape[2] - 1
        x, y = (((u[k, (axis + i) % 3] / size) + 1) * cells / 2 for i in (1, 2))
        i, j = (np.clip(z.astype(int), 0, cells - 1) for z in (x, y))
        s, t = x - i, y - j
        sign = (u[k, axis] > 0).astype(int)
        F = self.values
        low = (1 - t) * F[axis, sign, i, j] + t * F[axis, sign, i, j + 1]
        high = (1 - t) * F[axis, sign, i + 1, j] + t * F[axis, sign, i + 1, j + 1]
        return np.asarray(size * ((1 - s) * low + s * high))


def corners(cells: int) -> Array:
    """Return the directions (3, 2, n, n, 3) of the grid, with so many cells along a side of a face."""
    side = np.linspace(-1, 1, cells + 1)
    u = np.empty((3, 2, cells + 1, cells + 1, 3))
    for axis in range(3):
        u[axis, 0, ..., axis], u[axis, 1, ..., axis] = -1.0, 1.0
        u[axis, ..., (axis + 1) % 3] = side[:, None]
        u[axis, ..., (axis + 2) % 3] = side
    return u


def support_function(chain: Chain, first: int, cells: int, seconds: float) -> Support | None:
    """Return what u · p is at most, of the joints from the first one on; None if there is not enough time.

    Args:
        chain: the joints.
        first: the number of the first one.
        cells: along a side of a face of the cube.
        seconds: after which no more joint is begun.
    """
    ends = chain.A[:, :, None] * np.stack([chain.lower, chain.upper], axis=1)
    lower, upper = ends.min(axis=2).sum(axis=1), ends.max(axis=2).sum(axis=1)
    tip, u, end = chain.tip, corners(cells), monotonic() + seconds

    def of_tip(w: Array) -> Array:
        return np.asarray(w @ tip)

    found: Support = of_tip
    for i in range(len(lower) - 1, first - 1, -1):
        if monotonic() > end:
            return None
        found = moved(chain.axes[i], float(lower[i]), float(upper[i]), found)
        if i > first:
            found = _Grid(found(u.reshape(-1, 3)).reshape(u.shape[:-1]))
    return found


def moved(axis: Axis, lower: float, upper: float, after: Support) -> Support:
    """Return the support function with one more joint before the others."""

    def slid(u: Array) -> Array:
        along = u @ axis.direction
        return np.asarray(after(u) + np.maximum(along * lower, along * upper))

    def turned(u: Array) -> Array:
        parts = [u[k : k + AT_ONCE] for k in range(0, len(u), AT_ONCE)]
        return np.concatenate([_largest_on_arcs(part, axis, lower, upper, after) for part in parts])

    return turned if axis.revolute else slid


def _largest_on_arcs(u: Array, axis: Axis, lower: float, upper: float, after: Support) -> Array:
    """Return u · o + the most of h(w) − w · o on the arcs w = R(v)ᵀ u, of directions (k, 3).

    A short arc lies in the triangle of its ends and of the point at which its tangents meet; a convex function on it is
    at most what it is at one of these.
    """
    a, o = axis.direction, axis.point
    if upper - lower > 2 * np.pi:
        lower, upper = -np.pi, np.pi
    along, across = (u @ a)[:, None] * a, np.cross(a, u)
    radial = u - along

    def value(v: Array, stretched: float) -> Array:
        cos, sin = stretched * np.cos(v)[..., None], stretched * np.sin(v)[..., None]
        w = along[:, None] + cos * radial[:, None] - sin * across[:, None]
        flat = w.reshape(-1, 3)
        return np.asarray((after(flat) - flat @ o).reshape(v.shape))

    half = (upper - lower) / (2 * ARCS)
    middle = np.tile(lower + half * (2 * np.arange(ARCS) + 1), (len(u), 1))
    settled = np.full(len(u), -np.inf)
    for i in range(ROUNDS):
        most = np.maximum(value(middle, 1 / np.cos(half)), np.maximum(value(middle - half, 1), value(middle + half, 1)))
        if i == ROUNDS - 1:
            break
        order = np.argpartition(most, -KEPT, axis=1)
        rest = np.take_along_axis(most, order[:, :-KEPT], axis=1)
        settled = np.maximum(settled, rest.max(axis=1))
        half /= PARTS
        inner = half * (2 * np.arange(PARTS) + 1 - PARTS)
        middle = (np.take_along_axis(middle, order[:, -KEPT:], axis=1)[..., None] + inner).reshape(len(u), -1)
    return np.asarray(u @ o + np.maximum(settled, most.max(axis=1)))


def farthest_of(h: Support, centre: Array, rows: Array, cells: int) -> float:
    """Return what |P (p − c)| is at most: the most of h(n) − n · c over the unit vectors n of the space of the rows."""
    if len(rows) == 2:
        angle = np.linspace(0, 2 * np.pi, CIRCLE + 1)
        n = np.column_stack([np.cos(angle), np.sin(angle)]) @ rows
        W = h(n) - n @ centre
        return _most_over(np.stack([n[:-1], n[1:]], axis=1), np.stack([W[:-1], W[1:]], axis=1))
    u = corners(cells)
    flat = u.reshape(-1, 3)
    W = (h(flat) - flat @ centre).reshape(u.shape[:-1])
    four = [np.s_[:, :, i : i + cells, j : j + cells] for i in (0, 1) for j in (0, 1)]
    edges, values = np.stack([u[some] for some in four], axis=-2), np.stack([W[some] for some in four], axis=-1)
    return _most_over(edges.reshape(-1, 4, 3), values.reshape(-1, 4))


def _most_over(u: Array, W: Array) -> float:
    """Return what a convex homogeneous W is at most at a unit vector in one of the cones of vectors (k, s, 3).

    W ≤ a · u + r at the edges of a cone, with a by least squares and r ≥ 0. A unit vector n in the cone is a sum of
    edges with factors that make up 1 at most, since these are no shorter; so W(n) ≤ a · n + r.
    """
    a = np.einsum("kds,ks->kd", np.linalg.pinv(u), W)
    rest = np.maximum(W - np.einsum("ksd,kd->ks", u, a), 0.0).max(axis=1)
    edges = u / np.linalg.norm(u, axis=2, keepdims=True)
    middle = edges.sum(axis=1)
    middle /= np.linalg.norm(middle, axis=1, keepdims=True)
    wide = np.arccos(np.clip(np.einsum("ksd,kd->ks", edges, middle).min(axis=1), -1, 1))
    length = np.linalg.norm(a, axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        away = np.arccos(np.clip(np.nan_to_num(np.einsum("kd,kd->k", a, middle) / length), -1, 1))
    return float((length * np.cos(np.maximum(away - wide, 0.0)) + rest).max())
