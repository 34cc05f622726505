"""A plane that turns about an axis in it: its two halves sweep the same space, one half a turn after the other.

With limits, what the plane reaches on its own side of the axis is turned through the joint's range, what it reaches
behind the axis through the range half a turn on. Between the ends of the two ranges the half plane (ρ, h) of all that
is reached is the same. So the boundary is made of the edges of these half planes, turned from one end to the next; and,
at each end, of the wall of what is reached before it or after it only.
"""

from cmath import phase
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from math import cos, hypot, pi, sin, tau

from robotics1.workspaces.axes import CLOSED, Axis
from robotics1.workspaces.flat.arrangement import Divider, Loop, dividers
from robotics1.workspaces.flat.critical_curves import CriticalCurve
from robotics1.workspaces.flat.pieces import cut
from robotics1.workspaces.flat.section import Section

ON_AXIS = -1  # in place of the joint that draws the axis


@dataclass(frozen=True)
class HalfPlane:
    """The workspace in one half plane from the axis, ρ ≥ 0, z = ρ + i h.

    Attributes:
        whole: the section of the whole plane.
        sides: 1 for what the plane's positive side reaches, −1 for the negative one, which is mirrored.
        base: the place in q of the joint that turns the plane.
        divided: the pieces on whose sides the number of solutions differs; those on the axis are no boundary.
    """

    whole: Section
    sides: tuple[int, ...]
    base: int
    divided: tuple[Divider, ...] = ()

    def count(self, z: complex) -> int:
        """Return the number of solutions at (ρ, h); of a redundant arm, whether there is one."""
        if z.real < 0:
            return 0
        found = sum(self.whole.count(z if side > 0 else -z.conjugate()) for side in self.sides)
        return found if len(self.whole.joints) == 2 else min(found, 1)


def half_plane(section: Section, sides: Sequence[int], base: int) -> HalfPlane:
    """Return the workspace in a half plane of what one side of the plane, or both, reach."""
    whole = [divider.piece.curve for divider in section.divided]
    far = 1 + max((abs(curve.point(t)) for curve in whole for t in (0.0, curve.length / 2, curve.length)), default=0.0)
    q = tuple(whole[0].q) if whole else (0.0,)
    curves = [CriticalCurve(None, complex(0, -2 * far), 1j, 4 * far, q, ON_AXIS, 0)]
    for side in sides:
        curves += whole if side > 0 else [_mirrored(curve, base) for curve in whole]
    half = HalfPlane(section, tuple(sides), base)
    return replace(half, divided=tuple(dividers(cut(curves), half.count)))


def _mirrored(curve: CriticalCurve, base: int) -> CriticalCurve:
    """Return the curve on the other side of the axis, in counter-clockwise direction, with the base half a turn on."""
    q = list(curve.configuration(curve.length))
    q[base] += pi
    return replace(
        curve,
        centre=None if curve.centre is None else -curve.centre.conjugate(),
        start=-curve.point(curve.length).conjugate(),
        direction=curve.direction.conjugate(),
        q=tuple(q),
        rate=-curve.rate,
    )


def angles_of_sides(range_of_base: float) -> tuple[float, float]:
    """Return the angle [rad] that both sides of the plane sweep, and that which each side sweeps alone."""
    both = max(0.0, 2 * (range_of_base - pi)) if range_of_base < tau else tau
    return both, min(range_of_base, tau) - both


def moment_within(loop: Loop) -> float:
    """Return ∫ x dA = ½ ∮ x² dy of what a loop goes around, exact on arcs and segments."""
    return sum(_moment_under(edge.curve) if edge.forward else -_moment_under(edge.curve) for edge in loop)


def _moment_under(curve: CriticalCurve) -> float:
    start, end = curve.start, curve.point(curve.length)
    if curve.centre is None:
        a, b = start.real, end.real
        return (end.imag - start.imag) * (a * a + a * b + b * b) / 6
    c, r = curve.centre.real, curve.radius
    begin = phase(start - curve.centre)

    def primitive(t: float) -> float:
        return (c * c * r * sin(t) + c * r * r * (t + sin(t) * cos(t)) + r**3 * (sin(t) - sin(t) ** 3 / 3)) / 2

    return primitive(begin + curve.length) - primitive(begin)


@dataclass(frozen=True, eq=False)
class Sector:
    """The half planes between two angles, which are all alike.

    Attributes:
        start, end: the angles about the axis [rad].
        half: what is reached there.
        edges: its boundary.
    """

    start: float
    end: float
    half: HalfPlane
    edges: tuple[CriticalCurve, ...]


def sectors(section: Section, base: Axis) -> list[Sector]:
    """Return the sectors around the axis, one turn of them."""
    ends = sorted((end + turn - base.lower) % tau for end in (base.lower, base.upper) for turn in (0.0, pi))
    apart = [end for k, end in enumerate(ends) if k == 0 or end - ends[k - 1] > CLOSED]
    known: dict[tuple[int, ...], HalfPlane] = {}
    found = []
    for start, end in pairwise([*apart, apart[0] + tau]):
        middle = base.lower + (start + end) / 2
        sides = tuple(side for side in (1, -1) if base.value_at(middle + (0.0 if side > 0 else pi), CLOSED) is not None)
        half = known.setdefault(sides, half_plane(section, sides, base.number))
        edges = [d.piece.curve for d in half.divided if 0 in (d.left, d.right) and d.piece.curve.joint != ON_AXIS]
        found.append(Sector(base.lower + start, base.lower + end, half, tuple(edges)))
    return found


def distance_from(around: Sequence[Sector], z: complex, angle: float) -> float:
    """Return the distance of the point z = ρ + i h at an angle about the axis from the boundary."""
    found = [_from_edges(sector, z, angle) for sector in around]
    found += [_from_wall(before, after, z, angle) for before, after in pairwise([*around, around[0]])]
    return min(found)


def _from_edges(sector: Sector, z: complex, angle: float) -> float:
    """Return the distance from the edges, turned through the sector: the nearest half plane has the nearest point."""
    within = (angle - sector.start) % tau
    turn = 0.0 if within <= sector.end - sector.start else min(tau - within, within - (sector.end - sector.start))
    seen = complex(z.real * cos(turn), z.imag)
    flat = min((curve.distance(seen) for curve in sector.edges), default=float("inf"))
    return hypot(flat, z.real * sin(turn))


def _from_wall(before: Sector, after: Sector, z: complex, angle: float) -> float:
    """Return the distance from a wall where its nearest point is not at an edge of a half plane."""
    turn = angle - after.start
    seen = complex(max(z.real * cos(turn), 0.0), z.imag)
    if (before.half.count(seen) > 0) == (after.half.count(seen) > 0):
        return float("inf")
    return hypot(z.real * cos(turn) - seen.real, z.real * sin(turn))
