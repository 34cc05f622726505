"""How far a point is from the boundary of a plane's workspace that is turned about an axis between limits.

What the plane reaches on its own side of the axis is turned through the joint's range, what it reaches behind the axis
through the range half a turn on. Between the ends of the two ranges the half plane (ρ, h) of all that is reached is the
same. So the boundary is made of the edges of these half planes, turned from one end to the next; and, at each end, of
the wall of what is reached before it or after it only.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import cos, hypot, pi, sin, tau

from robotics1.workspaces.axes import Axis
from robotics1.workspaces.critical_curves import CriticalCurve
from robotics1.workspaces.distances import distance_to_curve
from robotics1.workspaces.planar_joints import CLOSED
from robotics1.workspaces.revolution import ON_AXIS, HalfPlane, half_plane
from robotics1.workspaces.section import Section


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
        sides = tuple(side for side in (1, -1) if base.turns_to(middle + (0.0 if side > 0 else pi)))
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
    flat = min((distance_to_curve(curve, seen) for curve in sector.edges), default=float("inf"))
    return hypot(flat, z.real * sin(turn))


def _from_wall(before: Sector, after: Sector, z: complex, angle: float) -> float:
    """Return the distance from a wall where its nearest point is not at an edge of a half plane."""
    turn = angle - after.start
    seen = complex(max(z.real * cos(turn), 0.0), z.imag)
    if (before.half.count(seen) > 0) == (after.half.count(seen) > 0):
        return float("inf")
    return hypot(z.real * cos(turn) - seen.real, z.real * sin(turn))
