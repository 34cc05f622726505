"""Paths on which det J keeps its sign: straight lines between random configurations, joined to a roadmap.

Source: Kavraki, Švestka, Latombe, Overmars, Probabilistic roadmaps for path planning, IEEE Trans. Robotics and
Automation, 1996.
"""

from dataclasses import dataclass, field, replace
from itertools import pairwise, product

import numpy as np
import numpy.typing as npt
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components, dijkstra
from scipy.spatial import cKDTree

from robotics1.angles import TURN, without_turns
from robotics1.ik.postures.determinant import Determinant
from robotics1.inputs import Array

NEIGHBOURS = 10  # to which a configuration is joined
CHECKS = 24  # configurations at which a line is looked at first
BLOCK = 500  # lines that are looked at together
NEAR_ZERO = 1e-4  # |det J|, beside its largest value, of configurations that are left out
CLEAR = 0.05  # of the smaller |det J| at the ends, which det J keeps along a line
SPACING = 0.05  # of the samples of a path, in rad or reaches
MOST_PARTS = 200_000  # segments that a path may be cut into for its proof
MOST_TURNED = 5  # joints that are tried both ways round on the line from one end to the other


@dataclass(frozen=True, eq=False)
class Region:
    """The configurations at which det J has one sign.

    Attributes:
        determinant: det J.
        sign: its sign there.
        lower, upper: (nq,) the limits that are kept; of joints that make whole turns they do not matter.
        circular: (nq,) the joints that make whole turns.
        nodes: (k, nq) the configurations of the roadmap; the first are those that are asked about.
        edges: pairs of nodes that are joined, and the steps from one to the other.
    """

    determinant: Determinant
    sign: float
    lower: Array
    upper: Array
    circular: npt.NDArray[np.bool_]
    nodes: Array
    edges: dict[tuple[int, int], Array] = field(default_factory=dict)

    @property
    def ranges(self) -> tuple[Array, Array]:
        """(nq,) and (nq,) from where to where each joint goes: one turn, or its limits in the box of det J."""
        box = self.determinant.problem.box
        low = np.where(self.circular, -np.pi, np.maximum(self.lower, box.lower))
        return low, np.where(self.circular, np.pi, np.minimum(self.upper, box.upper))

    def step(self, a: Array, b: Array) -> Array:
        """Return b − a, (..., nq), the short way round."""
        d = b - a
        return np.where(self.circular, without_turns(d), d)

    def are_clear(self, q: Array, step: Array) -> npt.NDArray[np.bool_]:
        """Return whether det J keeps its sign, away from zero, at configurations on segments q + t step: (k,)."""
        t = np.linspace(0, 1, CHECKS + 1)[:, None]
        at = q[:, None] + t * step[:, None]
        values = self.sign * self.determinant(at.reshape(-1, q.shape[1])).reshape(len(q), -1)
        return np.asarray(values.min(axis=1) > CLEAR * np.minimum(values[:, 0], values[:, -1]))

    def grown(self, count: int, rng: np.random.Generator) -> "Region":
        """Return the region with `count` more random configurations on its roadmap, or as many as are found."""
        (low, high), found, size = self.ranges, [], 0
        for _ in range(20):
            q = np.where(self.determinant.active, rng.uniform(low, high, (4 * count, len(low))), self.nodes[:1])
            found.append(q[self.sign * self.determinant(q) > NEAR_ZERO][: count - size])
            size += len(found[-1])
            if size >= count:
                break
        return self.with_nodes(np.vstack(found))

    def with_nodes(self, q: Array) -> "Region":
        """Return the region with more configurations (k, nq) on its roadmap, each joined to its neighbours.

        Two are joined if the line between them is clear.
        """
        nodes = np.vstack([self.nodes, q])
        pairs = self._neighbours(nodes)
        start, step = nodes[pairs[:, 0]], self.step(nodes[pairs[:, 0]], nodes[pairs[:, 1]])
        step = np.where(self.determinant.active, step, 0.0)
        parts = range(0, len(pairs), BLOCK)
        clear = [self.are_clear(start[i : i + BLOCK], step[i : i + BLOCK]) for i in parts]
        edges = dict(self.edges)
        for i in np.flatnonzero(np.concatenate(clear)) if clear else ():
            edges[int(pairs[i, 0]), int(pairs[i, 1])] = step[i]
        return replace(self, nodes=nodes, edges=edges)

    def _neighbours(self, nodes: Array) -> Array:
        """Return pairs of nodes (j, 2) that are near one another, one of each being new."""
        active, unit = self.determinant.active, self.determinant.problem.box.unit
        columns = []
        for j in np.flatnonzero(active):
            x = nodes[:, j] / unit[j]
            columns += [np.cos(x), np.sin(x)] if self.circular[j] else [x]
        places = np.column_stack(columns)
        old = len(self.nodes) if self.edges or len(self.nodes) == len(nodes) else 0
        new = np.arange(old, len(nodes))
        _, near = cKDTree(places).query(places[new], k=min(NEIGHBOURS + 1, len(nodes)))
        found = {
            (min(i, j), max(i, j)) for i, row in zip(new.tolist(), near.tolist(), strict=True) for j in row if i != j
        }
        return np.array(sorted(found), dtype=int).reshape(-1, 2)

    def _graph(self) -> coo_matrix:
        unit, k = self.determinant.problem.box.unit, len(self.nodes)
        if not self.edges:
            return coo_matrix((k, k))
        i, j = np.array(list(self.edges)).reshape(-1, 2).T
        lengths = [np.linalg.norm(d / unit) + 1e-9 for d in self.edges.values()]
        return coo_matrix((lengths, (i, j)), shape=(k, k))

    def components(self) -> Array:
        """Return the number of the connected part that each node belongs to."""
        return np.asarray(connected_components(self._graph(), directed=False)[1])

    def path(self, a: int, b: int) -> Array | None:
        """Return the corners (k, nq) of the shortest way from node a to node b on the roadmap; None if none."""
        length, before = dijkstra(self._graph(), directed=False, indices=a, return_predecessors=True)
        if not np.isfinite(length[b]):
            return None
        way = [b]
        while way[-1] != a:
            way.append(int(before[way[-1]]))
        way.reverse()
        corners = [self.nodes[a]]
        for i, j in pairwise(way):
            d = self.edges.get((i, j))
            corners.append(corners[-1] + (d if d is not None else -self.edges[j, i]))
        return self._shortened(np.array(corners))

    def _shortened(self, corners: Array) -> Array:
        """Return the corners without those that a clear line leaves out."""
        kept, i = [0], 0
        while i < len(corners) - 1:
            ahead = np.arange(i + 1, len(corners))
            clear = self.are_clear(np.repeat(corners[i : i + 1], len(ahead), axis=0), corners[ahead] - corners[i])
            clear[0] = True
            i = int(ahead[np.flatnonzero(clear)[-1]])
            kept.append(i)
        return corners[kept]

    def direct(self, a: Array, b: Array) -> Array | None:
        """Return the corners (2, nq) of a clear straight line from a to b, perhaps the long way round; None if none."""
        short = np.where(self.determinant.active, self.step(a, b), 0.0)
        turning = np.flatnonzero(self.circular & self.determinant.active)[:MOST_TURNED]
        steps = []
        for turned in product((False, True), repeat=len(turning)):
            d = short.copy()
            d[turning] -= np.where(turned, TURN * np.where(short[turning] >= 0, 1.0, -1.0), 0.0)
            steps.append(d)
        steps = sorted(steps, key=lambda d: float(np.linalg.norm(d / self.determinant.problem.box.unit)))
        inside = [d for d in steps if self._inside(a + d)]
        if not inside:
            return None
        clear = self.are_clear(np.repeat(a[None], len(inside), axis=0), np.array(inside))
        return np.array([a, a + inside[int(np.argmax(clear))]]) if clear.any() else None

    def _inside(self, q: Array) -> bool:
        return bool(np.all(self.circular | ((q >= self.lower - 1e-9) & (q <= self.upper + 1e-9))))


def least_along(determinant: Determinant, corners: Array, sign: float) -> tuple[Array, float] | None:
    """Return samples (k, nq) of a path of straight lines, and a bound below which sign · det J never falls on it.

    Between two configurations det J is at least half of the sum of its values minus the bound of its change. Where that
    is less than half of the least value seen, the line is halved. None where det J vanishes, or nearly so.
    """
    starts, steps = corners[:-1], np.diff(corners, axis=0)
    moving = np.abs(steps).max(axis=1) > 0
    starts, steps = starts[moving], steps[moving]
    path = _sampled(starts, steps, corners[-1], determinant.problem.box.unit)
    q, step = path[:-1], np.diff(path, axis=0)
    bound = least = float(sign * determinant(path[-1:])[0])
    looked_at = 0
    while len(q):
        ends = sign * np.stack([determinant(q), determinant(q + step)])
        least, looked_at = min(least, float(ends.min())), looked_at + len(q)
        if least <= 0 or looked_at > MOST_PARTS:
            return None
        bounds = 0.5 * (ends.sum(axis=0) - determinant.change(q, step))
        loose = bounds < 0.5 * least
        bound = min(bound, float(bounds[~loose].min(initial=np.inf)))
        half = 0.5 * step[loose]
        q, step = np.vstack([q[loose], q[loose] + half]), np.vstack([half, half])
    return path, bound


def _sampled(starts: Array, steps: Array, end: Array, unit: Array) -> Array:
    """Return samples (k, nq) of straight lines, at most `SPACING` apart, and the end."""
    samples = []
    for q, step in zip(starts, steps, strict=True):
        parts = max(1, int(np.ceil(np.abs(step / unit).max() / SPACING)))
        samples.append(q + np.arange(parts)[:, None] / parts * step)
    return np.vstack([*samples, end[None]])
