"""Where arcs and segments meet, and the pieces into which they cut each other."""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations, pairwise
from math import sqrt

import numpy as np

from robotics1.workspaces.flat.critical_curves import TOLERANCE, CriticalCurve

TOUCHING = 1e-7  # half the distance of two crossings that count as one point of contact, when the arm is one long
SAME_PLACE = 2e-8  # distance of points that are one
SHORTEST = 1e-6  # a loop of one piece that is shorter is a point


@dataclass(frozen=True)
class Piece:
    """A part of critical curves between two vertices.

    Attributes:
        curve: the part, on the first of the curves.
        others: the same part on the other curves, with their own configurations.
        start, end: the numbers of its vertices.
    """

    curve: CriticalCurve
    others: tuple[CriticalCurve, ...]
    start: int
    end: int


def meeting_points(a: CriticalCurve, b: CriticalCurve) -> list[complex]:
    """Return the points in which two curves meet; where they run together, the ends of both."""
    return [z for z in _of_whole_curves(a, b) if a.position(z) is not None and b.position(z) is not None]


def _of_whole_curves(a: CriticalCurve, b: CriticalCurve) -> list[complex]:
    """Return where two circles or lines meet."""
    if a.centre is not None and b.centre is not None:
        return _of_circles(a, a.centre, b, b.centre)
    if a.centre is not None:
        return _of_line_and_circle(b, a, a.centre)
    if b.centre is not None:
        return _of_line_and_circle(a, b, b.centre)
    sine = (a.direction.conjugate() * b.direction).imag
    apart = (b.start - a.start) * a.direction.conjugate()
    if abs(sine) > TOLERANCE:
        return [b.start - b.direction * apart.imag / sine]
    return _ends_of_both(a, b) if abs(apart.imag) < TOLERANCE else []


def _of_circles(a: CriticalCurve, c: complex, b: CriticalCurve, m: complex) -> list[complex]:
    """Return c + (x ± i h) u, with u the unit vector from centre to centre and r² = x² + h²."""
    distance, r, s = abs(m - c), a.radius, b.radius
    if distance < TOLERANCE:
        return _ends_of_both(a, b) if abs(r - s) < TOLERANCE else []
    u = (m - c) / distance
    x = (distance + (r - s) * (r + s) / distance) / 2
    return _pair(c, u, x, (r - x) * (r + x), r)


def _of_line_and_circle(line: CriticalCurve, circle: CriticalCurve, c: complex) -> list[complex]:
    """Return c + (x ± i h) u, with u normal to the line."""
    u = 1j * line.direction
    x, r = ((line.start - c) * u.conjugate()).real, circle.radius
    return _pair(c, u, x, (r - x) * (r + x), r)


def _pair(c: complex, u: complex, x: float, squared: float, r: float) -> list[complex]:
    if squared < -(TOUCHING**2):
        return []
    if squared < TOUCHING**2:
        return [c + (r if x > 0 else -r) * u]
    h = sqrt(squared)
    return [c + complex(x, h) * u, c + complex(x, -h) * u]


def _ends_of_both(a: CriticalCurve, b: CriticalCurve) -> list[complex]:
    return [curve.point(t) for curve in (a, b) for t in (0.0, curve.length)]


def cut(curves: Iterable[CriticalCurve]) -> list[Piece]:
    """Return the pieces into which curves cut each other; what lies on several curves is one piece."""
    listed = list(curves)
    positions = [{0.0, curve.length} for curve in listed]
    boxes = [_box(curve) for curve in listed]
    for i, j in combinations(range(len(listed)), 2):
        (x, y, r), (u, v, s) = boxes[i], boxes[j]
        if abs(x - u) > r + s or abs(y - v) > r + s:
            continue
        for z in meeting_points(listed[i], listed[j]):
            positions[i].add(listed[i].position(z) or 0.0)
            positions[j].add(listed[j].position(z) or 0.0)
    parts = [
        curve.part(a, b)
        for curve, at in zip(listed, positions, strict=True)
        for a, b in pairwise(sorted(at))
        if (b - a) * min(curve.radius, 1.0) > 1e-12
    ]
    return _joined(parts)


def _box(curve: CriticalCurve) -> tuple[float, float, float]:
    """Return the centre and half the side of a square around a curve."""
    middle = curve.point(curve.length / 2)
    if curve.centre is None or curve.size < curve.radius:
        return middle.real, middle.imag, curve.size / 2 + TOUCHING
    return curve.centre.real, curve.centre.imag, curve.radius + TOUCHING


def _joined(parts: list[CriticalCurve]) -> list[Piece]:
    """Return the parts with numbered vertices, those that coincide as one, and those that are points left out."""
    if not parts:
        return []
    places = [z for part in parts for z in (part.start, part.point(part.length), part.point(part.length / 2))]
    numbers = _numbered(places)
    found: dict[tuple[int, int, int], list[CriticalCurve]] = {}
    for part, start, end, middle in zip(parts, numbers[::3], numbers[1::3], numbers[2::3], strict=True):
        if start == end and part.size < SHORTEST:
            continue
        key = (min(start, end), max(start, end), middle)
        found.setdefault(key, []).append(part)
    ends = {id(part): (a, b) for part, a, b in zip(parts, numbers[::3], numbers[1::3], strict=True)}
    return [Piece(same[0], tuple(same[1:]), *ends[id(same[0])]) for same in found.values()]


def _numbered(places: list[complex]) -> list[int]:
    """Return a number for each point, the same for points that are one."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree

    z = np.array(places)
    pairs = cKDTree(np.column_stack([z.real, z.imag])).query_pairs(SAME_PLACE, output_type="ndarray")
    graph = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(z), len(z)))
    return [int(number) for number in connected_components(graph, directed=False)[1]]
