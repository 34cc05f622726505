"""The section of a planar chain: where a point is in it, whether it is reached, and how far the boundary is."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.inputs import Array, real_array
from robotics1.workspaces.critical_curves import CriticalCurve
from robotics1.workspaces.distances import distance_to_curve, largest_distance
from robotics1.workspaces.extents import corners_of_box
from robotics1.workspaces.limited_turn import Sector, distance_from, sectors
from robotics1.workspaces.naming import configuration_in_units
from robotics1.workspaces.reading import ReadArm
from robotics1.workspaces.revolution import HalfPlane
from robotics1.workspaces.section import Section

DRAWN = 24  # points of a curve
ON_BOUNDARY = 1e-9  # of the arm's size: a point that near belongs to the workspace


@dataclass(frozen=True, eq=False)
class FlatSection:
    """A planar chain, its section, and the curves of its boundary."""

    arm: ReadArm
    section: Section | HalfPlane
    edges: tuple[CriticalCurve, ...]

    def contains(self, p: npt.ArrayLike) -> bool:
        """Return whether a point (m,) is reached."""
        z, height, sides = self._place(p)
        if not height:
            return False
        whole = self.section.section if isinstance(self.section, HalfPlane) else self.section
        mirrored = [z if side > 0 else -z.conjugate() for side in sides]
        return any(whole.count(w) > 0 for w in mirrored) or (
            any(distance_to_curve(curve, w) < ON_BOUNDARY for curve in self.edges for w in self._drawn(mirrored))
        )

    def configurations(self, p: npt.ArrayLike) -> Array:
        """Return configurations (k, nq) that reach a point (m,); some, if there are infinitely many."""
        arm = self.arm
        z, height, sides = self._place(p)
        whole = self.section.section if isinstance(self.section, HalfPlane) else self.section
        found = []
        for side in sides if height else ():
            for q in whole.configurations(z if side > 0 else -z.conjugate()):
                values = configuration_in_units(arm, q)
                if arm.slide is not None:
                    values[arm.slide.number] = self._height(p)
                if arm.base is not None:
                    turn = self._around(p) + (0.0 if side > 0 else np.pi)
                    values[arm.base.number] = arm.base.lower + (turn - arm.base.lower) % (2 * np.pi)
                found.append(values)
        return np.array(found).reshape(-1, len(arm.neutral))

    @cached_property
    def _sectors(self) -> list[Sector]:
        arm, section = self.arm, self.section
        if arm.base is None or isinstance(section, HalfPlane):
            return []
        return sectors(section, arm.base)

    def _around(self, p: npt.ArrayLike) -> float:
        """Return the angle of a point about the axis of the base, from the plane at q = 0 [rad]."""
        arm = self.arm
        offset = arm.rows.T @ real_array("p", p, (len(arm.rows),)) - arm.origin
        return float(np.arctan2(offset @ np.cross(arm.second, arm.first), offset @ arm.first))

    def _drawn(self, places: list[complex]) -> list[complex]:
        """Return places of a point in the section as its boundary is drawn: mirrored to ρ ≥ 0 in a half plane."""
        return [complex(abs(w.real), w.imag) for w in places] if isinstance(self.section, HalfPlane) else places

    def distance(self, p: npt.ArrayLike) -> float:
        """Return the distance of a point (m,) from the boundary [m]."""
        arm = self.arm
        if arm.base is not None and not arm.base.circular:
            return arm.size * distance_from(self._sectors, self._place(p)[0], self._around(p))
        z, _, _ = self._place(p)
        flat = arm.size * min(distance_to_curve(curve, z) for curve in self.edges)
        if arm.slide is None:
            return flat
        h = self._height(p)
        beyond = max(arm.slide.lower - h, h - arm.slide.upper)
        inside = self.section.count(z) > 0
        if inside:
            return min(flat, -beyond) if beyond < 0 else beyond
        return float(np.hypot(flat, max(beyond, 0.0)))

    def clearance(self, p: npt.ArrayLike) -> float:
        """Return the distance of a point (m,) from the boundary [m]."""
        return self.distance(p)

    def contains_each(self, points: Array) -> npt.NDArray[np.bool_]:
        """Return which points (k, m) are reached."""
        return np.array([self.contains(p) for p in points], dtype=bool)

    def full_turn(self) -> tuple[Array, Array] | None:
        """Return a point (3,) and the direction (3,) of the axis about which a first joint turns fully; or None."""
        base = self.arm.base
        return (base.point, base.direction) if base is not None and base.circular else None

    def sphere_ranges(self, place: Array) -> list[tuple[float, float]]:
        """Return the smallest and largest distance of a point at (ρ, h) [m] from each turned part of the boundary."""
        size, z = self.arm.size, self._at(place)
        behind = -z.conjugate()
        return [(size * distance_to_curve(curve, z), size * largest_distance(curve, behind)) for curve in self.edges]

    def corners(self) -> Array:
        """Return the corners (8, 3) of a box around what is reached, in world axes [m]."""
        arm = self.arm
        ends = [curve.point(t) for curve in self.edges for t in np.linspace(0, curve.length, DRAWN)]
        z = arm.size * np.array([(w.real, w.imag) for w in ends])
        axis = arm.second if arm.base is not None else arm.normal
        frame = np.array([arm.first, np.cross(axis, arm.first), axis])
        if arm.slide is None:
            return corners_of_box(z, None if arm.base is not None else (0.0, 0.0), frame, arm.origin)
        way = float(np.sign(arm.slide.direction @ arm.normal))
        low, high = sorted((way * arm.slide.lower + arm.height, way * arm.slide.upper + arm.height))
        return corners_of_box(z, (low, high), frame, arm.origin)

    def depth(self, place: Array) -> float:
        """Return the distance of a place (2,) of the section from its boundary [m]; negative outside."""
        arm, z = self.arm, self._at(place)
        far = arm.size * min(distance_to_curve(curve, z) for curve in self.edges)
        return far if self.section.count(z) else -far

    def _at(self, place: Array) -> complex:
        """Return z of a place (2,) in the section's coordinates [m]."""
        arm = self.arm
        start = 0.0 if arm.base is not None else float(arm.origin @ arm.first)
        return complex(place[0] - start, place[1] - arm.origin @ arm.second) / arm.size

    def _height(self, p: npt.ArrayLike) -> float:
        """Return the value of the slide at which the tip is as high as a point."""
        arm = self.arm
        if arm.slide is None:
            return 0.0
        point = arm.rows.T @ real_array("p", p, (len(arm.rows),))
        h = float((point - arm.origin) @ arm.normal) - arm.height
        return h * float(np.sign(arm.slide.direction @ arm.normal))

    def _place(self, p: npt.ArrayLike) -> tuple[complex, bool, tuple[int, ...]]:
        """Return where a point is in the section, whether the slide is long enough, and the sides that come there."""
        arm = self.arm
        point = arm.rows.T @ real_array("p", p, (len(arm.rows),), "the task's coordinates [m]")
        if arm.slide is not None:
            h, near = self._height(p), ON_BOUNDARY * arm.size
            return arm.in_plane(point), arm.slide.lower - near <= h <= arm.slide.upper + near, (1,)
        if arm.base is None:
            return arm.in_plane(point), True, (1,)
        offset = (point - arm.origin) / arm.size
        x, y = offset @ arm.first, offset @ np.cross(arm.second, arm.first)
        around = self._around(p)
        sides = tuple(side for side in (1, -1) if arm.base.turns_to(around + (0.0 if side > 0 else np.pi)))
        return complex(np.hypot(x, y), offset @ arm.second), True, sides
