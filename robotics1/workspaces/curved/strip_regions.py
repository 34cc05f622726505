"""Strips with as many solutions that touch, as regions: their sizes, a point inside, and the curves around them."""

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.workspaces.curved.image_curves import TURNED
from robotics1.workspaces.curved.strips import Strip, Strips

TOUCHING = 1e-7  # width at which strips above each other touch, when the arm is one long
SAME_PLACE = 1e-5  # distance of ends of edges that are one


@dataclass(frozen=True, eq=False)
class StripRegion:
    """Strips that are one region.

    Attributes:
        strips: the strips.
        count: the number of solutions.
        area: ∮ ρ dh.
        moment: ∮ ½ρ² dh = ∫ ρ dA.
        point: (2,) inside.
        outline: closed curves, (k, 2) each.
    """

    strips: tuple[Strip, ...]
    count: int
    area: float
    moment: float
    point: Array
    outline: tuple[Array, ...]


def strip_regions(whole: Strips) -> list[StripRegion]:
    """Return the regions with an end, those without solutions too, but not what is behind the axis."""
    across = _at_heights(whole)
    labels = _components(whole, across)
    grouped: dict[int, list[Strip]] = {}
    for strip, label in zip(whole.strips, labels, strict=True):
        grouped.setdefault(int(label), []).append(strip)
    with_end = [g for g in grouped.values() if all(s.left is not None and s.right is not None for s in g)]
    integrals = _integrals(whole, {i for g in with_end for s in g for i in (s.left, s.right) if i is not None})
    return [_region(whole, group, across, integrals) for group in with_end]


def _at_heights(whole: Strips) -> Array:
    """Return where each piece is at each height, (pieces, heights); NaN where it is not."""
    table = np.full(whole.parameters.shape, np.nan)
    for i, piece in enumerate(whole.pieces):
        here = ~np.isnan(whole.parameters[i])
        table[i, here] = piece.place(whole.parameters[i, here]) @ TURNED[0]
    return table


def _components(whole: Strips, across: Array) -> npt.NDArray[np.intp]:
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    strips = whole.strips
    rows: list[list[int]] = [[] for _ in range(len(whole.heights) - 1)]
    for number, strip in enumerate(strips):
        rows[strip.level].append(number)
    pairs = [pair for row in rows for pair in itertools.pairwise(row) if _joined(whole, *pair)]
    pairs += [(row[-1], next_row[-1]) for row, next_row in itertools.pairwise(rows)]  # outside
    if not any(piece.image is None for piece in whole.pieces):
        pairs += [(row[0], row[-1]) for row in rows]
    for level, (below, above) in enumerate(itertools.pairwise(rows)):
        for a in below:
            for b in above:
                if strips[a].count == strips[b].count and _overlap(strips[a], strips[b], across[:, level + 1]):
                    pairs.append((a, b))
    if any(piece.image is None for piece in whole.pieces):
        for row in (rows[0], rows[-1]):  # below and above everything only the axis is in the way
            pairs += [(row[k], row[-1]) for k in range(1, len(row)) if strips[row[k]].count == 0]
    at = np.array(pairs, dtype=int).reshape(-1, 2)
    graph = coo_array((np.ones(len(at)), (at[:, 0], at[:, 1])), shape=(len(strips), len(strips)))
    return np.asarray(connected_components(graph, directed=False)[1])


def _joined(whole: Strips, a: int, b: int) -> bool:
    """Return whether nothing divides two strips that are side by side."""
    one, other = whole.strips[a], whole.strips[b]
    axis = one.right is not None and one.left is None and any(p.image is None for p in whole.pieces)
    return one.count == other.count and not axis


def _overlap(a: Strip, b: Strip, across: Array) -> bool:
    left = max(-np.inf if s.left is None else across[s.left] for s in (a, b))
    right = min(np.inf if s.right is None else across[s.right] for s in (a, b))
    return bool(right - left > TOUCHING)


def _integrals(whole: Strips, wanted: set[int]) -> dict[tuple[int, int], Array]:
    """Return ∫ ρ dh and ∫ ½ρ² dh of pieces over levels, by (piece, level)."""
    found = {}
    for i in wanted:
        piece = whole.pieces[i]
        levels = np.flatnonzero((whole.heights[1:] > piece.low + 1e-9) & (whole.heights[:-1] < piece.high - 1e-9))
        if not len(levels):
            continue
        ends = np.clip(whole.heights[levels[0] : levels[-1] + 2], piece.low, piece.high)
        for level, value in zip(levels, piece.integrals(ends), strict=True):
            found[i, int(level)] = value
    return found


def _region(
    whole: Strips, group: Sequence[Strip], across: Array, integrals: dict[tuple[int, int], Array]
) -> StripRegion:
    total = np.zeros(2)
    for s in group:
        for i, sign in ((s.right, 1), (s.left, -1)):
            if i is not None and (i, s.level) in integrals:
                total += sign * integrals[i, s.level]
    outline = tuple(closed_loops(list(_edges(whole, group))))
    area, moment = map(float, total)
    return StripRegion(tuple(group), int(group[0].count), area, moment, _inside(whole, group), outline)


def _inside(whole: Strips, group: Sequence[Strip]) -> Array:
    """Return the middle of the roomiest strip."""
    best, found = -1.0, np.zeros(2)
    for strip in group:
        low, high = whole.heights[strip.level : strip.level + 2]
        a, b = (whole.across[i, strip.level] for i in (strip.left, strip.right) if i is not None)
        room = min(float(b - a), float(high - low))
        if room > best:
            best, found = room, TURNED.T @ np.array([(a + b) / 2, (low + high) / 2])
    return found


def _edges(whole: Strips, group: Sequence[Strip]) -> Iterator[Array]:
    """Yield the points (k, 2) of the edges around strips; what is on both sides of an inner edge is left out."""
    sides: dict[tuple[int, int], int] = {}
    for s in group:
        for i, sign in ((s.left, -1), (s.right, 1)):
            if i is not None:
                sides[i, s.level] = sides.get((i, s.level), 0) + sign
    for (i, level), sign in sides.items():
        if sign == 0:
            continue
        piece = whole.pieces[i]
        t = whole.parameters[i, level : level + 2]
        first, last = min(t), max(t)
        inner = piece.t[(piece.t > first) & (piece.t < last)][::2]
        values = np.concatenate([t[:1], inner, t[1:]])
        points = piece.place(values)
        yield points if sign > 0 else points[::-1]


def closed_loops(edges: list[Array]) -> Iterator[Array]:
    """Yield closed curves made of edges that follow each other."""
    left = dict(enumerate(edges))
    starts = np.array([edge[0] for edge in edges]).reshape(-1, 2)
    while left:
        edge = left.popitem()[1]
        line = [edge]
        while True:
            numbers = np.array(list(left), dtype=int)
            if not len(numbers):
                break
            far = np.linalg.norm(starts[numbers] - line[-1][-1], axis=1)
            near = int(np.argmin(far))
            if far[near] > np.linalg.norm(line[0][0] - line[-1][-1]) + SAME_PLACE:
                break
            line.append(left.pop(int(numbers[near])))
        yield np.vstack(line)
