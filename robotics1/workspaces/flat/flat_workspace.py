"""The workspace of a planar chain: regions between arcs and segments."""

from collections.abc import Sequence
from math import tau

import numpy as np

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.workspaces.axes import distinct
from robotics1.workspaces.flat.arrangement import Divider, Loop, area_within, inner_point, outline_of, regions
from robotics1.workspaces.flat.critical_curves import CriticalCurve
from robotics1.workspaces.flat.flat_arm import PlanarArm
from robotics1.workspaces.flat.flat_section import FlatSection
from robotics1.workspaces.flat.revolution import ON_AXIS, HalfPlane, angles_of_sides, half_plane, moment_within
from robotics1.workspaces.flat.section import Section, section_of
from robotics1.workspaces.result import BoundaryCurve, Workspace, WorkspaceRegion, reason_of

SAME = 1e-9  # of distances that are alike, by the arm's size
SAME_CONFIGURATION = 1e-6  # rad or m; what is stationary is found to the root of the rounding
STEP = 0.03  # rad between drawn points of an arc


def flat_workspace(robot: Robot, arm: PlanarArm) -> Workspace:
    """Return the workspace of a planar chain."""
    plane = section_of(arm.joints, arm.tip, tuple(arm.place.neutral))
    full_turn = arm.turn is not None and arm.turn.circular
    section = half_plane(plane, (1, -1), arm.turn.number) if arm.turn is not None and full_turn else plane
    edges = [d for d in section.divided if 0 in (d.left, d.right) and d.piece.curve.joint != ON_AXIS]
    if not edges:
        raise TaskError(
            f"the workspace of robot {robot.name!r}, or that of its last joints, is too thin: less than a millionth of "
            "the arm's size, which cannot be told from rounding"
        )
    turned = isinstance(section, HalfPlane)
    found = [region_of(arm, *loops, section.divided, turned=turned) for loops in regions(section.divided)]
    reached = tuple(region for region in found if region.solutions)
    r_min, nearest = _nearest(arm, section, edges)
    r_max, farthest = _extreme(arm, edges, largest=True)
    return Workspace(
        robot_name=robot.name,
        area=float(sum(region.area for region in reached)),
        volume=_volume(arm, plane, reached),
        r_min=r_min,
        r_max=r_max,
        r_bounds=(r_min, r_max),
        nearest=nearest,
        farthest=farthest,
        boundary=tuple(boundary_curve(robot, arm, divider.piece.curve) for divider in edges),
        regions=reached,
        voids=tuple(region for region in found if not region.solutions),
        nodes=_nodes(arm, section),
        coordinates=arm.place.names,
        redundant=len(arm.joints) > 2,
        section=FlatSection(arm.place, arm, section, tuple(divider.piece.curve for divider in edges)),
    )


def _nodes(arm: PlanarArm, section: Section | HalfPlane) -> Array:
    """Return where two curves cross on which the joints are singular, (k, 2), but on the axis of a turn."""
    ends: dict[int, list[complex]] = {}
    on_axis: set[int] = set()
    for divider in section.divided:
        piece = divider.piece
        if piece.curve.joint == ON_AXIS:
            on_axis |= {piece.start, piece.end}
        elif len(arm.joints) - len(piece.curve.limits) > 1:
            ends.setdefault(piece.start, []).append(piece.curve.start)
            ends.setdefault(piece.end, []).append(piece.curve.point(piece.curve.length))
    found = [places[0] for vertex, places in ends.items() if len(places) > 3 and vertex not in on_axis]
    return np.array([arm.coordinates(z) for z in found]).reshape(-1, 2)


def region_of(
    arm: PlanarArm, outer: Loop, holes: Sequence[Loop], divided: Sequence[Divider], *, turned: bool = False
) -> WorkspaceRegion:
    """Return the region between a loop and those around its holes, with a volume if a base moves it."""
    loops = (outer, *holes)
    area, volume = sum(map(area_within, loops)) * arm.size**2, None
    if arm.slide is not None:
        volume = area * (arm.slide.upper - arm.slide.lower)
    elif turned:
        volume = tau * sum(map(moment_within, loops)) * arm.size**3
    inside = arm.coordinates(inner_point(outer, list(holes), list(divided)))
    outline = tuple(np.array([arm.coordinates(z) for z in outline_of(loop)]) for loop in loops)
    return WorkspaceRegion(outer[0].count, area, volume, inside, outline)


def _volume(arm: PlanarArm, plane: Section, reached: tuple[WorkspaceRegion, ...]) -> float | None:
    """Return the volume; of a turn with limits, by what both sides of the plane sweep, and each alone."""
    if arm.place.base is None:
        return None
    if arm.turn is None or arm.turn.circular:
        return float(sum(region.volume or 0.0 for region in reached))
    both, alone = angles_of_sides(arm.turn.upper - arm.turn.lower)
    number = arm.turn.number
    moments = [_moment(half_plane(plane, sides, number)) for sides in ((1, -1), (1,), (-1,))]
    return (both * moments[0] + alone * (moments[1] + moments[2])) * arm.size**3


def _moment(half: HalfPlane) -> float:
    """Return ∫ ρ dA over what is reached."""
    inside = (loops for loops in regions(half.divided) if loops[0][0].count)
    return sum(moment_within(loop) for outer, holes in inside for loop in (outer, *holes))


def _extreme(arm: PlanarArm, edges: list[Divider], *, largest: bool) -> tuple[float, Array]:
    """Return the largest or smallest distance of the boundary from the first joint's axis, and where it is attained."""
    found: list[tuple[float, tuple[float, ...]]] = []
    for divider in edges:
        for curve in (divider.piece.curve, *divider.piece.others):
            found += [(_radius(arm, curve.point(t)), curve.configuration(t)) for t in _extreme_positions(arm, curve)]
    best = (max if largest else min)(radius for radius, _ in found)
    there = [arm.in_units(q) for radius, q in found if abs(radius - best) < SAME]
    return best * arm.size, _distinct(arm, there)


def _extreme_positions(arm: PlanarArm, curve: CriticalCurve) -> list[float]:
    """Return t of the ends and of what is stationary; an axis in the plane is like a point far away."""
    if arm.turn is None:
        return curve.extreme_positions(_centre(arm))
    if curve.centre is None:
        return [0.0, curve.length] if abs(curve.direction.real) > SAME else [curve.length / 2]
    points = [curve.centre + curve.radius, curve.centre - curve.radius]
    return [0.0, curve.length, *(t for t in map(curve.position, points) if t is not None)]


def _radius(arm: PlanarArm, z: complex) -> float:
    return abs(z - _centre(arm)) if arm.turn is None else abs(z.real)


def _centre(arm: PlanarArm) -> complex:
    """Return where the first joint's axis is in the plane; the world's origin if the joint slides."""
    return arm.joints[0].place if arm.joints[0].revolute else arm.in_plane(np.zeros(3))


def _nearest(arm: PlanarArm, section: Section | HalfPlane, edges: list[Divider]) -> tuple[float, Array]:
    """Return the smallest distance from the first joint's axis, and where it is attained: also inside."""
    inside = _reached_on_axis(arm, section)
    if inside is None:
        return _extreme(arm, edges, largest=False)
    return 0.0, _distinct(arm, [arm.in_units(q) for q in section.whole.configurations(inside)])


def _reached_on_axis(arm: PlanarArm, section: Section | HalfPlane) -> complex | None:
    """Return a reached point of the first joint's axis."""
    if arm.turn is None:
        return _centre(arm) if section.count(_centre(arm)) else None
    if not isinstance(section, HalfPlane):
        section = half_plane(section, (1, -1), arm.turn.number)
    axis = [d.piece.curve for d in section.divided if d.piece.curve.joint == ON_AXIS]
    return axis[0].point(axis[0].length / 2) if axis else None


def _distinct(arm: PlanarArm, found: list[Array]) -> Array:
    """Return configurations, each once; whole turns apart are one, and so are other values of a turning first joint."""
    q = np.array(found).reshape(len(found), len(arm.place.neutral))
    first, compared, turning = arm.turn or arm.joints[0], q.copy(), np.zeros(q.shape[1], dtype=bool)
    turning[[joint.number for joint in arm.joints if joint.revolute]] = True
    if first.revolute:
        compared[:, first.number] = 0.0
    return q[distinct(compared, turning, SAME_CONFIGURATION)]


def boundary_curve(robot: Robot, arm: PlanarArm, curve: CriticalCurve) -> BoundaryCurve:
    """Return a critical curve as a part of the boundary."""
    names = robot.joint_names
    limits = {names[number]: limit for number, limit in sorted(curve.limits)}
    free = [joint.name for joint in arm.joints if joint.name not in limits]
    singular = tuple(free) if len(free) > 1 else ()
    end = curve.point(curve.length)
    count = 2 if curve.centre is None else 2 + int(curve.length / STEP)
    return BoundaryCurve(
        points=np.array([arm.coordinates(curve.point(float(t))) for t in np.linspace(0, curve.length, count)]),
        start=arm.coordinates(curve.start),
        end=arm.coordinates(end),
        center=None if curve.centre is None else arm.coordinates(curve.centre),
        radius=curve.radius * arm.size,
        angle=0.0 if curve.centre is None else curve.length,
        q_start=arm.in_units(curve.q),
        q_end=arm.in_units(curve.configuration(curve.length)),
        joint=names[curve.joint],
        limits=limits,
        singular=singular,
        reason=reason_of(limits, singular),
    )
