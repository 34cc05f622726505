"""The section of a planar chain: where a point is in it, whether it is reached, and how far the boundary is."""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, pi

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.inputs import Array
from robotics1.workspaces.axes import CLOSED
from robotics1.workspaces.flat.critical_curves import CriticalCurve
from robotics1.workspaces.flat.flat_arm import PlanarArm
from robotics1.workspaces.flat.revolution import HalfPlane, Sector, distance_from, sectors
from robotics1.workspaces.flat.section import Section
from robotics1.workspaces.placed_section import PlacedSection, in_section

DRAWN = 24  # points of a curve
ON_BOUNDARY = 1e-9  # of the arm's size: a point that near belongs to the workspace


@dataclass(frozen=True, eq=False)
class FlatSection(PlacedSection):
    """A planar chain, its section, and the curves of its boundary."""

    arm: PlanarArm
    section: Section | HalfPlane
    edges: tuple[CriticalCurve, ...]

    def contains(self, p: npt.ArrayLike) -> bool:
        """Return whether a point (m,) is reached."""
        z, sides = self._placed(self.place.local(p))
        places = [_on_side(z, side) for side in sides]
        if any(self.section.whole.count(w) > 0 for w in places):
            return True
        if isinstance(self.section, HalfPlane):  # the boundary is drawn at ρ ≥ 0
            places = [complex(abs(w.real), w.imag) for w in places]
        return any(curve.distance(w) < ON_BOUNDARY for curve in self.edges for w in places)

    def configurations(self, p: npt.ArrayLike) -> Array:
        """Return configurations (k, nq) that reach a point (m,); some, if there are infinitely many."""
        z, sides = self._placed(self.place.local(p))
        found = []
        for side, value in sides.items():
            for q in self.section.whole.configurations(_on_side(z, side)):
                found.append(self.arm.in_units(q))
                if self.place.base is not None:
                    found[-1][self.place.base.number] = value
        return np.array(found).reshape(-1, len(self.place.neutral))

    def distance(self, p: npt.ArrayLike) -> float:
        """Return the distance of a point (m,) from the boundary [m]."""
        arm, local = self.arm, self.place.local(p)
        z, _ = self._placed(local)
        if self._sectors:
            return arm.size * distance_from(self._sectors, z, atan2(local[1], local[0]))
        flat = arm.size * min(curve.distance(z) for curve in self.edges)
        if arm.slide is None:
            return flat
        h = local[2] - arm.height
        beyond = max(arm.slide.lower - h, h - arm.slide.upper)
        if self.section.count(z) > 0:
            return min(flat, -beyond) if beyond < 0 else float(beyond)
        return float(np.hypot(flat, max(beyond, 0.0)))

    def depth(self, place: Array) -> float:
        """Return the distance of a place (2,) of the section from its boundary [m]; negative outside."""
        z = self.arm.at(place)
        far = self.arm.size * min(curve.distance(z) for curve in self.edges)
        return far if self.section.count(z) else -far

    def sphere_ranges(self, place: Array) -> list[tuple[float, float]]:
        """Return the smallest and largest distance of a point at (ρ, h) [m] from each turned part of the boundary."""
        size, z = self.arm.size, self.arm.at(place)
        behind = _on_side(z, -1)
        return [(size * curve.distance(z), size * curve.farthest(behind)) for curve in self.edges]

    def _extent(self) -> tuple[Array, tuple[float, float]]:
        arm, slide = self.arm, self.arm.slide
        ends = [curve.point(t) for curve in self.edges for t in np.linspace(0, curve.length, DRAWN)]
        z = arm.size * np.array([(w.real, w.imag) for w in ends])
        return z, (0.0, 0.0) if slide is None else (slide.lower + arm.height, slide.upper + arm.height)

    @cached_property
    def _sectors(self) -> list[Sector]:
        turn, section = self.arm.turn, self.section
        return [] if turn is None or isinstance(section, HalfPlane) else sectors(section, turn)

    def _placed(self, local: Array) -> tuple[complex, dict[int, float]]:
        """Return z of a point (3,) of the frame, and by the sides of the plane that come there those of the base."""
        arm, base = self.arm, self.place.base
        z = complex(*in_section(local, self.place.about_axis)) / arm.size
        if base is None:
            return z, {1: 0.0}
        if base.revolute:
            angle = atan2(local[1], local[0])
            values = {side: base.value_at(angle + (0.0 if side > 0 else pi), CLOSED) for side in (1, -1)}
        else:
            values = {1: base.value_at(local[2] - arm.height, ON_BOUNDARY * arm.size)}
        return z, {side: value for side, value in values.items() if value is not None}


def _on_side(z: complex, side: int) -> complex:
    """Return where a place of the half plane ρ ≥ 0 is in the whole plane, on its positive or its negative side."""
    return z if side > 0 else -z.conjugate()
