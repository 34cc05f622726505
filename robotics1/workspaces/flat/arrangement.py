"""The regions into which critical curves divide the plane, each with the number of its solutions."""

from cmath import phase
from collections import Counter
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from math import tau

import numpy as np

from robotics1.workspaces.flat.critical_curves import CriticalCurve
from robotics1.workspaces.flat.pieces import Piece, meeting_points

BESIDE = 1e-6  # how far from a piece its sides are looked at, when the arm is one long
NEARER = (0.1, 0.01, 0.001, 10.0, 0.3)  # times that distance, one after the other where the numbers do not agree
PARALLEL = 1e-5  # rad between tangents that count as one


@dataclass(frozen=True)
class Divider:
    """A piece of a critical curve with the number of solutions on both sides of it."""

    piece: Piece
    left: int
    right: int


@dataclass(frozen=True)
class Edge:
    """A divider, passed in one direction: what is on the left of it belongs to the loop that it is part of."""

    divider: Divider
    forward: bool

    @property
    def curve(self) -> CriticalCurve:
        """The arc or segment, in its own direction."""
        return self.divider.piece.curve

    @property
    def count(self) -> int:
        """The number of solutions on the left."""
        return self.divider.left if self.forward else self.divider.right

    @property
    def vertices(self) -> tuple[int, int]:
        """The numbers of the vertices that it goes from and to."""
        ends = self.divider.piece.start, self.divider.piece.end
        return ends if self.forward else ends[::-1]

    def departure(self) -> tuple[float, float]:
        """Return the direction [rad] and the curvature, positive to the left, with which it leaves its first vertex."""
        curve = self.curve
        if self.forward:
            return phase(curve.tangent(0.0)), 1 / curve.radius
        return phase(-curve.tangent(curve.length)), -1 / curve.radius


Loop = tuple[Edge, ...]


def dividers(pieces: Iterable[Piece], count: Callable[[complex], int]) -> list[Divider]:
    """Return the pieces on whose two sides the numbers of solutions differ.

    Once around a vertex the changes of the number make up 0. Where they do not, another curve is nearer to a piece than
    the points at which its sides were looked at, or these are too near to it; so other points are taken there.
    """
    listed = list(pieces)
    found = [_divider(piece, count, 1.0) for piece in listed]
    for nearer in NEARER:
        open_at = _unbalanced(found)
        if not open_at:
            break
        for i, piece in enumerate(listed):
            if piece.start in open_at or piece.end in open_at:
                found[i] = _divider(piece, count, nearer)
    return [divider for divider in found if divider.left != divider.right]


def _divider(piece: Piece, count: Callable[[complex], int], nearer: float) -> Divider:
    curve = piece.curve
    middle, across = curve.point(curve.length / 2), 1j * curve.tangent(curve.length / 2)
    step = nearer * min(BESIDE, 0.01 * curve.size**2 / min(curve.radius, 1.0))
    return Divider(piece, count(middle + step * across), count(middle - step * across))


def _unbalanced(divided: Iterable[Divider]) -> set[int]:
    """Return the vertices around which the changes of the number of solutions do not make up 0."""
    change: Counter[int] = Counter()
    for divider in divided:
        change[divider.piece.start] += divider.left - divider.right
        change[divider.piece.end] -= divider.left - divider.right
    return {vertex for vertex, total in change.items() if total}


def loops(divided: Iterable[Divider]) -> list[Loop]:
    """Return the closed loops of edges that have one region on their left.

    At each vertex a loop goes on with the edge that is next, clockwise, to the one by which it came.
    """
    edges = [Edge(divider, forward) for divider in divided for forward in (True, False)]
    leaving: dict[int, list[int]] = {}
    for i, edge in enumerate(edges):
        leaving.setdefault(edge.vertices[0], []).append(i)
    following: dict[int, int] = {}
    for around in leaving.values():
        order = _counter_clockwise(around, edges)
        for place, i in enumerate(order):
            following[i ^ 1] = order[place - 1]  # i ^ 1 is the same divider in the other direction
    found, left = [], set(range(len(edges)))
    while left:
        first = i = min(left)
        loop = []
        while True:
            left.discard(i)
            loop.append(edges[i])
            i = following[i]
            if i == first:
                break
        found.append(tuple(loop))
    return found


def _counter_clockwise(around: list[int], edges: list[Edge]) -> list[int]:
    """Return edges that leave a vertex in the order of their directions; what touches, in that of curvature."""
    known = sorted((*edges[i].departure(), i) for i in around)
    gaps = [(known[k][0] - known[k - 1][0]) % tau for k in range(len(known))]
    first = max(range(len(known)), key=gaps.__getitem__)
    turned = [((known[k][0] - known[first][0]) % tau, *known[k][1:]) for k in range(len(known))]
    turned = [(angle if angle < tau - PARALLEL else 0.0, bend, i) for angle, bend, i in turned]
    turned.sort()
    order: list[tuple[float, float, int]] = []
    start = 0
    for k in range(1, len(turned) + 1):
        if k == len(turned) or turned[k][0] - turned[k - 1][0] > PARALLEL:
            order += sorted(turned[start:k], key=lambda entry: entry[1])
            start = k
    return [entry[2] for entry in order]


def area_within(loop: Loop) -> float:
    """Return ½ ∮ (x dy − y dx), exact on arcs and segments; negative where the loop goes round clockwise."""
    return sum(_area_under(edge.curve) if edge.forward else -_area_under(edge.curve) for edge in loop)


def _area_under(curve: CriticalCurve) -> float:
    start, end = curve.start, curve.point(curve.length)
    if curve.centre is None:
        return (start.conjugate() * end).imag / 2
    return ((curve.centre.conjugate() * (end - start)).imag + curve.radius**2 * curve.length) / 2


def winds_around(loop: Loop, z: complex) -> bool:
    """Return whether a point is inside a loop: a ray from it crosses the loop an odd number of times."""
    ray = CriticalCurve(None, z, complex(0.6180339887, 0.7861513778), 100.0, (0.0,), 0, 1)
    return sum(len(meeting_points(ray, edge.curve)) for edge in loop) % 2 == 1


def regions(divided: Iterable[Divider]) -> list[tuple[Loop, list[Loop]]]:
    """Return the regions with an end: the loop around each, and the loops around its holes."""
    found = loops(divided)
    outer = sorted((loop for loop in found if area_within(loop) > 0), key=area_within)
    holes: list[list[Loop]] = [[] for _ in outer]
    for loop in found:
        if area_within(loop) > 0:
            continue
        curve = loop[0].curve
        inside = curve.point(curve.length / 2)
        place = next((k for k, around in enumerate(outer) if _lies_in(loop, inside, around)), None)
        if place is not None:
            holes[place].append(loop)
    return list(zip(outer, holes, strict=True))


def _lies_in(loop: Loop, z: complex, around: Loop) -> bool:
    """Return whether a hole is inside an outer loop that is not the hole's own other side."""
    own = {id(edge.divider) for edge in loop}
    return not any(id(edge.divider) in own for edge in around) and winds_around(around, z)


def inner_point(outer: Loop, holes: list[Loop], divided: list[Divider]) -> complex:
    """Return a point of a region, as far beside one of its edges as nothing else is in between."""
    candidates = []
    for edge in (*outer, *(edge for hole in holes for edge in hole)):
        curve = edge.curve
        middle, size = curve.point(curve.length / 2), min(curve.size, 1.0)
        across = (1j if edge.forward else -1j) * curve.tangent(curve.length / 2)
        step = min(BESIDE, 0.01 * curve.size**2)
        while step < size / 2 and not _crossed(middle, across, step, 4 * step, divided):
            step *= 2
        candidates.append((step, middle + step * across))
    return max(candidates, key=lambda entry: entry[0])[1]


def _crossed(middle: complex, across: complex, start: float, end: float, divided: list[Divider]) -> bool:
    way = CriticalCurve(None, middle + start * across, across, end - start, (0.0,), 0, 1)
    return any(meeting_points(way, divider.piece.curve) for divider in divided)


def outline_of(loop: Loop) -> list[complex]:
    """Return points on a loop, to draw it."""
    points: list[complex] = []
    for edge in loop:
        curve = edge.curve
        count = 2 if curve.centre is None else 2 + int(curve.length / 0.03)
        t = np.linspace(0, curve.length, count)
        points += [curve.point(float(s)) for s in (t if edge.forward else t[::-1])]
    return points
