"""The workspace of an arm: in a plane exactly, by arcs and segments; of other arms as their kind allows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import pi, tau

import numpy as np

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.robot.given import RobotLike
from robotics1.robot.model import Robot
from robotics1.symbolic.kinematics.task_at_point import with_frame_at_point
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.workspaces.arrangement import Divider, Loop, area_within, inner_point, outline_of, regions
from robotics1.workspaces.axes import STRAIGHT, Axis
from robotics1.workspaces.critical_curves import CriticalCurve
from robotics1.workspaces.curved.curved_workspace import curved_workspace
from robotics1.workspaces.curved.reading_in_space import without_held
from robotics1.workspaces.distances import extreme_positions
from robotics1.workspaces.flat_section import FlatSection
from robotics1.workspaces.naming import boundary_curve, configuration_in_units, coordinates, names_of_coordinates
from robotics1.workspaces.reading import ReadArm, moving_point, read_arm
from robotics1.workspaces.result import Workspace, WorkspaceRegion
from robotics1.workspaces.revolution import ON_AXIS, HalfPlane, angles_of_sides, half_plane, moment_within
from robotics1.workspaces.sampled.sampled_workspace import sampled_workspace
from robotics1.workspaces.section import Section, section_of

SAME = 1e-9  # of distances that are alike, by the arm's size
SAME_CONFIGURATION = 1e-6  # rad or m; what is stationary is found to the root of the rounding


def workspace(robot: RobotLike, task: TaskLike, *, box: Mapping[str, tuple[float, float]] | None = None) -> Workspace:
    """Return the points r = f(q) with q inside the joint limits: boundary, regions and sizes.

    At a point of the boundary the joints that are not at a limit are singular together. Of an arm in a plane such
    points lie on arcs and segments, each drawn by one joint while the others stand still. These curves cut the plane
    into regions; the number of solutions is the same everywhere in a region, and is counted at both sides of each
    curve. The area is ½ ∮ (x dy − y dx) along the arcs and segments themselves, and the volume of what turns about an
    axis is its angle times ∫ ρ dA (Pappus). So too of such an arm with a slide across its plane (SCARA, cylindrical,
    gantry), or whose plane contains the axis about which its first joint turns it (anthropomorphic, polar).

    Of any other three joints that move a point in space, the first turns or slides a section, and the critical curves
    of the section are the images of D(q2, q3) = 0 and of the limits of q2 and q3, traced. The number of solutions in a
    region is the degree of the map over it. The same holds of two joints that move two coordinates. Joints that do not
    move the point, as those of a spherical wrist about it, do not count.

    Of all other arms the section is sampled by cells: `resolution` is their side, and nothing is proven outside.

    Args:
        robot: the arm.
        task: two or three coordinates of a point, as `PositionTask("xy")`, in world axes.
        box: joint name → (lower, upper) [rad or m], inside the limits; needed for prismatic joints without limits.

    Raises:
        InputError: a prismatic joint has neither limits nor a box, or the box is wrong.
        UnknownNameError: the box names no joint.
        TaskError: the task is no position, or the point moves along a surface or a curve only.

    Source: Kumar, Waldron, The workspaces of a mechanical manipulator, 1981 (boundaries are singular); Wenger, Cuspidal
    and noncuspidal robot manipulators, Robotica, 2007 (regions and cusps of the section).
    """
    robot, task = with_frame_at_point(*robot_and_task(robot, task))
    rows, tip, axes = moving_point(robot, task, box)
    return workspace_of(robot, axes, tip, rows)


def workspace_of(robot: Robot, axes: Sequence[Axis], tip: Array, rows: Array) -> Workspace:
    """Return the workspace of a tip (3,) that joints move: exact if it can be, else sampled."""
    arm = read_arm(robot, axes, tip, rows)
    if arm is not None:
        return flat_workspace(robot, arm)
    moving, at_tip = without_held(axes, tip, STRAIGHT * robot.reach)
    if len(moving) <= len(rows):
        return curved_workspace(robot, axes, tip, rows)
    return sampled_workspace(robot, moving, at_tip, rows)


def flat_workspace(robot: Robot, arm: ReadArm) -> Workspace:
    """Return the workspace of a planar chain."""
    plane = section_of(arm.joints, arm.tip, arm.neutral)
    full_turn = arm.base is not None and arm.base.circular
    section = half_plane(plane, (1, -1), arm.base.number) if arm.base is not None and full_turn else plane
    edges = [d for d in section.divided if 0 in (d.left, d.right) and d.piece.curve.joint != ON_AXIS]
    if not edges:
        raise TaskError(
            f"the workspace of robot {robot.name!r}, or that of its last joints, is too thin: less than a millionth of "
            "the arm's size, which cannot be told from rounding"
        )
    found = [_region(arm, outer, holes, section) for outer, holes in regions(section.divided)]
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
        cusps=np.zeros((0, 2)),
        nodes=_nodes(arm, section),
        coordinates=names_of_coordinates(arm),
        redundant=len(arm.joints) > 2,
        section=FlatSection(arm, section, tuple(divider.piece.curve for divider in edges)),
    )


def _nodes(arm: ReadArm, section: Section | HalfPlane) -> Array:
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
    return np.array([coordinates(arm, z) for z in found]).reshape(-1, 2)


def _region(arm: ReadArm, outer: Loop, holes: list[Loop], section: Section | HalfPlane) -> WorkspaceRegion:
    area = sum(map(area_within, (outer, *holes))) * arm.size**2
    volume = None
    if arm.slide is not None:
        volume = area * (arm.slide.upper - arm.slide.lower)
    elif isinstance(section, HalfPlane):
        volume = tau * sum(map(moment_within, (outer, *holes))) * arm.size**3
    inside = inner_point(outer, holes, list(section.divided))
    outline = tuple(np.array([coordinates(arm, z) for z in outline_of(loop)]) for loop in (outer, *holes))
    return WorkspaceRegion(outer[0].count, area, volume, coordinates(arm, inside), outline)


def _volume(arm: ReadArm, plane: Section, reached: tuple[WorkspaceRegion, ...]) -> float | None:
    """Return the volume; of a turn with limits, by what both sides of the plane sweep, and each alone."""
    if arm.base is None or arm.base.circular:
        return (
            None if arm.base is None and arm.slide is None else float(sum(region.volume or 0.0 for region in reached))
        )
    both, alone = angles_of_sides(arm.base.upper - arm.base.lower)
    number = arm.base.number
    moments = [_moment(half_plane(plane, sides, number)) for sides in ((1, -1), (1,), (-1,))]
    return (both * moments[0] + alone * (moments[1] + moments[2])) * arm.size**3


def _moment(half: HalfPlane) -> float:
    """Return ∫ ρ dA over what is reached."""
    inside = (loops for loops in regions(half.divided) if loops[0][0].count)
    return sum(moment_within(loop) for outer, holes in inside for loop in (outer, *holes))


def _extreme(arm: ReadArm, edges: list[Divider], *, largest: bool) -> tuple[float, Array]:
    """Return the largest or smallest distance of the boundary from the first joint's axis, and where it is attained."""
    found: list[tuple[float, tuple[float, ...]]] = []
    for divider in edges:
        for curve in (divider.piece.curve, *divider.piece.others):
            found += [(_radius(arm, curve.point(t)), curve.configuration(t)) for t in _extreme_positions(arm, curve)]
    best = (max if largest else min)(radius for radius, _ in found)
    there = [configuration_in_units(arm, q) for radius, q in found if abs(radius - best) < SAME]
    return best * arm.size, _distinct(arm, there)


def _extreme_positions(arm: ReadArm, curve: CriticalCurve) -> list[float]:
    """Return t of the ends and of what is stationary; an axis in the plane is like a point far away."""
    if arm.base is None:
        return extreme_positions(curve, _centre(arm))
    if curve.centre is None:
        return [0.0, curve.length] if abs(curve.direction.real) > SAME else [curve.length / 2]
    points = [curve.centre + curve.radius, curve.centre - curve.radius]
    return [0.0, curve.length, *(t for t in map(curve.position, points) if t is not None)]


def _radius(arm: ReadArm, z: complex) -> float:
    return abs(z - _centre(arm)) if arm.base is None else abs(z.real)


def _centre(arm: ReadArm) -> complex:
    """Return where the first joint's axis is in the plane; the world's origin if the joint slides."""
    return arm.joints[0].place if arm.joints[0].revolute else arm.in_plane(np.zeros(3))


def _nearest(arm: ReadArm, section: Section | HalfPlane, edges: list[Divider]) -> tuple[float, Array]:
    """Return the smallest distance from the first joint's axis, and where it is attained: also inside."""
    inside = _reached_on_axis(arm, section)
    if inside is None:
        return _extreme(arm, edges, largest=False)
    whole = section.section if isinstance(section, HalfPlane) else section
    return 0.0, _distinct(arm, [configuration_in_units(arm, q) for q in whole.configurations(inside)])


def _reached_on_axis(arm: ReadArm, section: Section | HalfPlane) -> complex | None:
    """Return a reached point of the first joint's axis."""
    if arm.base is None:
        return _centre(arm) if section.count(_centre(arm)) else None
    if not isinstance(section, HalfPlane):
        section = half_plane(section, (1, -1), arm.base.number)
    axis = [d.piece.curve for d in section.divided if d.piece.curve.joint == ON_AXIS]
    return axis[0].point(axis[0].length / 2) if axis else None


def _distinct(arm: ReadArm, found: list[Array]) -> Array:
    """Return configurations, each once; whole turns apart are one, and so are other values of a turning first joint."""
    first = arm.base if arm.base is not None else arm.joints[0]
    turning = {joint.number for joint in arm.joints if joint.revolute} - {first.number}
    free = {first.number} if first.revolute else set()
    kept: list[Array] = []
    for q in found:
        if all(_apart(q - other, turning, free) > SAME_CONFIGURATION for other in kept):
            kept.append(q)
    return np.array(kept).reshape(len(kept), len(arm.neutral))


def _apart(difference: Array, turning: set[int], free: set[int]) -> float:
    """Return the largest difference of a joint that is not free, the short way round."""
    short = [abs((d + pi) % tau - pi) if i in turning else abs(d) for i, d in enumerate(difference) if i not in free]
    return max(short, default=0.0)
