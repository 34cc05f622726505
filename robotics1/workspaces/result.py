"""The workspace of an arm: its regions, its boundary, and what can be asked of a point."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.names import printable
from robotics1.notation import vector
from robotics1.results import Frozen
from robotics1.tables import Table, table_of
from robotics1.workspaces.placed_section import PlacedSection


@dataclass(frozen=True, eq=False)
class BoundaryCurve(Frozen):
    """A part of the boundary: an arc or a segment, drawn by one joint while the others stand still; or another curve.

    Attributes:
        points: (k, 2) from its start to its end, to draw it [m].
        start, end: (2,) its ends [m]; an arc goes counter-clockwise.
        center: (2,) of an arc [m]; else None.
        radius: of an arc [m]; else infinite.
        angle: that an arc turns by [rad]; else 0.
        q_start, q_end: (nq,) a configuration at its ends [rad or m].
        joint: the joint that draws it; empty where several move along it.
        limits: joint → "lower" or "upper": the joints that are at a limit.
        singular: the joints that are singular together; empty where all joints but one are at a limit.
        reason: the same in words.
    """

    points: Array = field(repr=False)
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

    @property
    def kind(self) -> str:
        """What it is: "arc", "segment" or "curve"."""
        if self.center is not None:
            return "arc"
        return "segment" if len(self.points) == 2 else "curve"

    def __repr__(self) -> str:
        kind = f"arc of radius {self.radius:.6g}" if self.kind == "arc" else self.kind
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
        nearest, farthest: (k, nq) all configurations that attain them, but for the first joint: one that turns, or that
            slides in space, may have any value instead. Where infinitely many attain them, some.
        boundary: the arcs and segments between what is reached and what is not.
        regions: the reached regions.
        voids: the regions around which there is a reached one, and which are not reached.
        cusps: (k, 2) points of the section [m] in which three solutions meet: critical curves turn back there. A 3R arm
            with cusps changes its posture without a singularity. Arcs and segments have none.
        nodes: (k, 2) points inside [m] in which curves cross on which the joints are singular.
        coordinates: the names of the section's two coordinates.
        volume_error: about how wrong the volume may be [m³]; 0 where it is exact to rounding. It is integrated
            numerically where the first joint has limits and several solutions reach a point.
        resolution: the side of the cells [m] where the workspace is sampled; 0 where it is exact. A cell is reached if
            a configuration was found that reaches its middle; that there is none is not proven. Then `boundary` is
            empty, and `nearest` and `farthest` are one configuration each, found by optimization; see `r_bounds`.
        r_bounds: what no point is nearer, and none is farther than [m]: r_min and r_max, or where these were found by
            optimization, what is proven of them.
        redundant: whether more joints move the point than it has coordinates, so that solutions are not counted.
    """

    robot_name: str
    area: float
    volume: float | None
    r_min: float
    r_max: float
    nearest: Array
    farthest: Array
    regions: tuple[WorkspaceRegion, ...]
    voids: tuple[WorkspaceRegion, ...]
    coordinates: tuple[str, str]
    redundant: bool
    section: PlacedSection = field(repr=False)
    boundary: tuple[BoundaryCurve, ...] = ()
    cusps: Array = field(default_factory=lambda: np.zeros((0, 2)))
    nodes: Array = field(default_factory=lambda: np.zeros((0, 2)))
    volume_error: float = 0.0
    resolution: float = 0.0
    r_bounds: tuple[float, float] = field(default=(0.0, float("inf")), repr=False)

    def __repr__(self) -> str:
        size = f"area={self.area:.6g}" + ("" if self.volume is None else f", volume={self.volume:.6g}")
        return f"Workspace({self.robot_name!r}, {size}, r_min={self.r_min:.6g}, r_max={self.r_max:.6g})"

    def _tables(self) -> tuple[Table, ...]:
        rows = []
        for curve in self.boundary:
            kind = curve.kind if curve.center is None else f"arc, r = {curve.radius:.4g}"
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
        return self.section.contains(p)

    def configurations(self, p: npt.ArrayLike) -> Array:
        """Return configurations (k, nq) that reach a point inside the limits [rad or m]: they prove that it is reached.

        Of a redundant arm they are some of infinitely many, and there may be none where the others are not critical.

        Args:
            p: (m,) the task's coordinates [m].

        Raises:
            InputError: p has another shape or is not finite.
        """
        return self.section.configurations(p)

    def distance(self, p: npt.ArrayLike) -> float:
        """Return the distance of a point from the boundary [m], whether it is inside or outside.

        Args:
            p: (m,) the task's coordinates [m].

        Raises:
            InputError: p has another shape or is not finite.
        """
        return self.section.distance(p)

    def explain(self) -> str:
        """Return size, reach, regions and boundary, in sentences."""
        size = (
            f"area {self.area:.9g} m²"
            if self.volume is None
            else (f"volume {self.volume:.9g} m³; its section has the area {self.area:.9g} m²")
        )
        lines = [f"The workspace of {self.robot_name} has the {size}."]
        if self.resolution:
            lines.append(
                f"It is sampled in cells of {self.resolution:.3g} m. Each reached cell has a configuration that "
                "reaches its middle; that the others have none is not proven."
            )
        if self.volume_error:
            how = "sampled" if self.resolution else "integrated numerically"
            lines.append(f"The volume is {how}, to about {self.volume_error:.1g} m³.")
        lines.append(
            f"Its distances from the first joint's axis, or from the world's origin if that joint slides, go from "
            f"{self.r_min:.9g} m to {self.r_max:.9g} m."
        )
        if self.resolution:
            least, most = self.r_bounds
            lines.append(f"No point is nearer than {least:.9g} m, and none farther than {most:.9g} m: that is proven.")
        for region in self.regions:
            many = "reached" if self.redundant else f"{region.solutions} solution{'s' * (region.solutions != 1)}"
            lines.append(f"A region of area {region.area:.6g} m²: {many}.")
        none = "none found" if self.resolution else "no solution"
        lines += [f"A void of area {void.area:.6g} m²: {none}." for void in self.voids]
        if len(self.cusps):
            where = ", ".join(f"({x:.6g}, {y:.6g})" for x, y in self.cusps)
            lines.append(f"Three solutions meet at {len(self.cusps)} cusps, ({', '.join(self.coordinates)}) = {where}.")
            lines.append("Around a cusp the arm changes its posture without a singularity: it is cuspidal.")
        if len(self.nodes):
            where = ", ".join(f"({x:.6g}, {y:.6g})" for x, y in self.nodes)
            lines.append(f"Singular curves cross at ({', '.join(self.coordinates)}) = {where}.")
        reasons = dict.fromkeys(curve.reason for curve in self.boundary)
        lines += [f"The boundary is where {'; where '.join(reasons)}."] if reasons else []
        return "\n".join(lines)


def check_workspace(ws: Workspace) -> None:
    """Raise InputError if it is none."""
    if not isinstance(ws, Workspace):
        raise InputError(f"ws must be what workspace(robot, task) returns, not {ws!r}")


def reason_of(limits: dict[str, str], singular: tuple[str, ...]) -> str:
    """Return in words which joints are at a limit, and which are singular together."""
    parts = [f"{name} is at its {limit} limit" for name, limit in limits.items()]
    if singular:
        parts.append(f"{', '.join(singular[:-1])} and {singular[-1]} are singular together")
    return " and ".join(parts)
