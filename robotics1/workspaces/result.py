"""The workspace of an arm: its regions, its boundary, and what can be asked of a point."""

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from robotics1.errors import TaskError
from robotics1.inputs import Array, real_array
from robotics1.names import printable
from robotics1.notation import vector
from robotics1.results import Frozen
from robotics1.tables import Table, table_of
from robotics1.workspaces.arrangement import Loop
from robotics1.workspaces.critical_curves import CriticalCurve
from robotics1.workspaces.distances import distance_to_curve
from robotics1.workspaces.reading import ReadArm
from robotics1.workspaces.revolution import HalfPlane
from robotics1.workspaces.section import Section

ON_BOUNDARY = 1e-9  # of the arm's size: a point that near belongs to the workspace


@dataclass(frozen=True, eq=False)
class BoundaryCurve(Frozen):
    """An arc or a segment of the boundary, drawn by one joint while the others stand still.

    Attributes:
        start, end: (2,) its ends [m]; an arc goes counter-clockwise.
        center: (2,) of an arc [m]; None of a segment.
        radius: of an arc [m]; infinite of a segment.
        angle: that an arc turns by [rad]; 0 of a segment.
        q_start, q_end: (nq,) a configuration at its ends [rad or m].
        joint: the joint that draws it.
        limits: joint → "lower" or "upper": the joints that are at a limit.
        singular: the joints that are singular together; empty where all joints but one are at a limit.
        reason: the same in words.
    """

    start: Array
    end: Array
    center: Array | None
    radius: float
    angle: float
    q_start: Array
    q_end: Array
    joint: str
    limits: dict[str, str]
    singular: tuple[str, ...]
    reason: str

    def __repr__(self) -> str:
        kind = "segment" if self.center is None else f"arc of radius {self.radius:.6g}"
        return f"BoundaryCurve({kind}, {self.reason})"


@dataclass(frozen=True, eq=False)
class WorkspaceRegion(Frozen):
    """A connected region of the section in which the number of solutions is the same.

    Attributes:
        solutions: their number, by `ik_solutions`; of a redundant arm 1, which stands for infinitely many; 0 in a void.
        area: of the region [m²].
        volume: that it sweeps [m³], if the arm is one in space; else None.
        point: (2,) a point inside.
        outline: the closed curves around it and around its holes, each (k, 2) points to draw.
    """

    solutions: int
    area: float
    volume: float | None
    point: Array
    outline: tuple[Array, ...] = field(repr=False)


@dataclass(frozen=True, eq=False)
class Workspace(Frozen):
    """The points that an arm reaches inside its limits.

    Coordinates of the section are the task's in a plane. Of an arm with a slide they are those of the plane across the
    slide; of an arm that turns its plane about an axis they are ρ, the distance from the axis, and the height along it.
    If the turn has limits, the section is that of the moving plane, and ρ is negative on its other side.

    Attributes:
        robot_name: the robot's name.
        area: of the section [m²].
        volume: [m³], of an arm in space; else None.
        r_min, r_max: the smallest and largest distance from the first joint's axis [m]; from the world's origin if the
            first joint slides.
        nearest, farthest: (k, nq) configurations that attain them; a first joint that turns may have any value instead.
        boundary: the arcs and segments between what is reached and what is not.
        regions: the reached regions.
        voids: the regions around which there is a reached one, and which are not reached.
        cusps: (0, 2): arcs and segments have none.
        coordinates: the names of the section's two coordinates.
        redundant: whether more joints move the point than it has coordinates, so that solutions are not counted.
    """

    robot_name: str
    area: float
    volume: float | None
    r_min: float
    r_max: float
    nearest: Array
    farthest: Array
    boundary: tuple[BoundaryCurve, ...]
    regions: tuple[WorkspaceRegion, ...]
    voids: tuple[WorkspaceRegion, ...]
    cusps: Array
    coordinates: tuple[str, str]
    redundant: bool
    arm: ReadArm = field(repr=False)
    section: Section | HalfPlane = field(repr=False)
    edges: tuple[CriticalCurve, ...] = field(repr=False)

    def __repr__(self) -> str:
        size = f"area={self.area:.6g}" + ("" if self.volume is None else f", volume={self.volume:.6g}")
        return f"Workspace({self.robot_name!r}, {size}, r_min={self.r_min:.6g}, r_max={self.r_max:.6g})"

    def _tables(self) -> tuple[Table, ...]:
        rows = []
        for curve in self.boundary:
            kind = "segment" if curve.center is None else f"arc, r = {curve.radius:.4g}"
            where = [f"{name} {limit}" for name, limit in curve.limits.items()]
            where += [f"{', '.join(curve.singular)} singular"] if curve.singular else []
            rows.append((printable("; ".join(where)), kind, vector(curve.start), vector(curve.end)))
        return (table_of(("where", "curve", "from", "to"), rows, f"boundary, ({', '.join(self.coordinates)}) [m]"),)

    def contains(self, p: npt.ArrayLike) -> bool:
        """Return whether a point is reached; the boundary, to 1e-9 of the arm's size, belongs to the workspace.

        Args:
            p: (m,) the task's coordinates [m].

        Raises:
            InputError: p has another shape or is not finite.
        """
        z, height, sides = self._place(p)
        if not height:
            return False
        whole = self.section.section if isinstance(self.section, HalfPlane) else self.section
        mirrored = [z if side > 0 else -z.conjugate() for side in sides]
        return any(whole.count(w) > 0 for w in mirrored) or (
            any(distance_to_curve(curve, w) < ON_BOUNDARY for curve in self.edges for w in self._drawn(mirrored))
        )

    def _drawn(self, places: list[complex]) -> list[complex]:
        """Return places of a point in the section as its boundary is drawn: mirrored to ρ ≥ 0 in a half plane."""
        return [complex(abs(w.real), w.imag) for w in places] if isinstance(self.section, HalfPlane) else places

    def distance(self, p: npt.ArrayLike) -> float:
        """Return the distance of a point from the boundary [m], whether it is inside or outside.

        Args:
            p: (m,) the task's coordinates [m].

        Raises:
            InputError: p has another shape or is not finite.
            TaskError: the arm turns its plane between limits; the distance from the ends of the turn is not known.
        """
        arm = self.arm
        if arm.base is not None and not arm.base.circular:
            raise TaskError(
                f"the distance is known for a full turn of joint {arm.base.name!r}, and its turn has limits"
            )
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
        around = float(np.arctan2(y, x))
        sides = tuple(side for side in (1, -1) if arm.base.turns_to(around + (0.0 if side > 0 else np.pi)))
        return complex(np.hypot(x, y), offset @ arm.second), True, sides

    def explain(self) -> str:
        """Return size, reach, regions and boundary, in sentences."""
        size = (
            f"area {self.area:.9g} m²"
            if self.volume is None
            else (f"volume {self.volume:.9g} m³; its section has the area {self.area:.9g} m²")
        )
        lines = [f"The workspace of {self.robot_name} has the {size}."]
        lines.append(f"Distances from the axis of the first joint go from {self.r_min:.9g} m to {self.r_max:.9g} m.")
        for region in self.regions:
            many = "reached" if self.redundant else f"{region.solutions} solution{'s' * (region.solutions != 1)}"
            lines.append(f"A region of area {region.area:.6g} m²: {many}.")
        lines += [f"A void of area {void.area:.6g} m²: no solution." for void in self.voids]
        reasons = dict.fromkeys(curve.reason for curve in self.boundary)
        lines += [f"The boundary is where {'; where '.join(reasons)}."]
        return "\n".join(lines)


def outline_of(loop: Loop) -> list[complex]:
    """Return points on a loop, to draw it."""
    points: list[complex] = []
    for edge in loop:
        curve = edge.curve
        count = 2 if curve.centre is None else 2 + int(curve.length / 0.03)
        t = np.linspace(0, curve.length, count)
        points += [curve.point(float(s)) for s in (t if edge.forward else t[::-1])]
    return points
