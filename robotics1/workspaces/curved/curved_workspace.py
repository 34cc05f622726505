"""The workspace of an arm whose section has critical curves of any kind: images of D = 0 and of joint limits."""

from collections.abc import Sequence
from math import cos, prod, tau

import numpy as np

from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.workspaces.curved.boundary_parts import BoundaryPart, boundary_parts
from robotics1.workspaces.curved.curved_section import CurvedSection
from robotics1.workspaces.curved.image_curves import TURN, TURNED, ImageCurve, RisingPiece, image_curves
from robotics1.workspaces.curved.limited_volume import volume_with_limits
from robotics1.workspaces.curved.radial_extremes import extreme_radius
from robotics1.workspaces.curved.reading_in_space import SpatialArm, read_in_space
from robotics1.workspaces.curved.rising_pieces import rising_pieces
from robotics1.workspaces.curved.singular_curves import singular_curves
from robotics1.workspaces.curved.strip_regions import StripRegion, strip_regions
from robotics1.workspaces.curved.strips import AXIS, Strips, strips_between
from robotics1.workspaces.moving_point import MovingPoint
from robotics1.workspaces.result import BoundaryCurve, Workspace, WorkspaceRegion, reason_of

CELLS = (160, 320, 640, 1280, 2560)  # a turn: the grid on which D = 0 is looked for
MOST_POINTS = 2_000_000  # of a grid
NO_AREA = 1e-9  # of D
BALANCED = 0.01  # of ∫ |D|: the difference to ∫ N dA that a grid's own error explains


def curved_workspace(robot: Robot, point: MovingPoint) -> Workspace:
    """Return the workspace of three joints that move a point in space, or two joints two of its coordinates.

    The first of three joints moves the section: it turns it about its axis, or slides it. Critical curves of the
    section are the images of D = 0 and of the limits of the other two. The number of solutions in a region is the
    degree of the map over it: Σ over critical curves of the turns that they make around it.

    Raises:
        TaskError: fewer joints move the point, or it only moves on a surface or a curve.
    """
    arm = read_in_space(robot, point)
    images, cusps, strips = _decomposition(robot, arm)
    parts = boundary_parts(strips, images, cusps)
    section = CurvedSection(arm.place, arm, strips, tuple(parts))
    found = strip_regions(strips)
    volume, error = volume_with_limits(section, found)
    r_min, nearest = extreme_radius(section, images, largest=False)
    r_max, farthest = extreme_radius(section, images, largest=True)
    return Workspace(
        robot_name=robot.name,
        area=float(sum(region.area for region in found if region.count)) * arm.size**2,
        volume=volume,
        volume_error=error,
        r_min=r_min,
        r_max=r_max,
        r_bounds=(r_min, r_max),
        nearest=nearest,
        farthest=farthest,
        boundary=tuple(_boundary_curve(robot, section, part) for part in parts),
        regions=tuple(_region(section, region) for region in found if region.count),
        voids=tuple(_region(section, region) for region in found if not region.count),
        cusps=np.array([images[i].at(np.array([t]))[0] * arm.size for i, t in cusps]).reshape(-1, 2),
        nodes=_nodes(strips, images) * arm.size,
        coordinates=arm.place.names,
        redundant=False,
        section=section,
    )


def _decomposition(robot: Robot, arm: SpatialArm) -> tuple[list[ImageCurve], list[tuple[int, float]], Strips]:
    """Return the critical curves, their cusps, and the strips: on a finer grid where the numbers do not agree."""
    sample = np.stack(np.meshgrid(*_middles(arm), indexing="ij"), axis=-1).reshape(-1, 2)
    size = np.abs(arm.mapped.determinant(sample))
    if size.max() < NO_AREA:
        raise TaskError(
            f"robot {robot.name!r} moves the point along a surface or a curve only; its workspace has no "
            f"{'volume' if arm.place.base else 'area'} and no section"
        )
    whole = float(size.mean() * np.prod(arm.domain.span))
    possible = [cells for cells in CELLS if prod(map(len, arm.domain.grid(cells))) <= MOST_POINTS]
    for cells in possible:
        singular, clear = singular_curves(arm.mapped, arm.domain, cells)
        if not clear and cells < possible[-1]:
            continue
        images = image_curves(arm.mapped, arm.domain, singular)
        pieces, cusps = rising_pieces(images)
        if arm.mapped.about_axis:
            pieces.append(_axis(pieces))
        strips = strips_between(pieces)
        if strips.consistent and abs(_total(pieces, arm.mapped.about_axis) - whole) < BALANCED * whole:
            return images, cusps, strips
    raise TaskError(f"the critical curves of robot {robot.name!r} could not be separated, so that nothing is known")


def _middles(arm: SpatialArm) -> tuple[Array, Array]:
    share = (np.arange(240) + 0.5) / 240
    x, y = (arm.domain.lower[k] + share * arm.domain.span[k] for k in range(2))
    return x, y


def _total(pieces: Sequence[RisingPiece], about_axis: bool) -> float:
    """Return ∫ N ρ dA, or ∫ N dA, by Green's theorem; it is ∫ |D| dx dy."""
    return sum(
        piece.jump * float(piece.integrals(np.array([piece.low, piece.high]))[0, int(about_axis)]) for piece in pieces
    )


def _axis(pieces: Sequence[RisingPiece]) -> RisingPiece:
    """Return the axis ρ = 0, from below to above all pieces."""
    low, high = min(p.low for p in pieces) - 0.1, max(p.high for p in pieces) + 0.1
    up = np.array([low, high])
    return RisingPiece(AXIS, up / cos(TURN), up, 0, None)


def _region(section: CurvedSection, region: StripRegion) -> WorkspaceRegion:
    size, base = section.arm.size, section.place.base
    volume = None
    if base is not None and base.circular:
        volume = tau * region.moment * size**3
    outline = tuple(line * size for line in region.outline)
    return WorkspaceRegion(region.count, region.area * size**2, volume, region.point * size, outline)


def _boundary_curve(robot: Robot, section: CurvedSection, part: BoundaryPart) -> BoundaryCurve:
    limit, names = part.image.curve.limit, [joint.name for joint in section.arm.joints]
    limits = {} if limit is None else {names[limit[0]]: limit[1]}
    singular = _singular(section, names) if limit is None else ()
    points = part.points * section.arm.size
    start, end = part.image.q(np.array([part.a, part.b]))
    return BoundaryCurve(
        points=points,
        start=points[0],
        end=points[-1],
        center=None,
        radius=float("inf"),
        angle=0.0,
        q_start=section.arm.configuration(start),
        q_end=section.arm.configuration(end),
        joint="" if limit is None else names[1 - limit[0]],
        limits=limits,
        singular=singular,
        reason=reason_of(limits, singular),
    )


def _singular(section: CurvedSection, names: list[str]) -> tuple[str, ...]:
    return (*names,) if section.place.base is None else (section.place.base.name, *names)


def _nodes(strips: Strips, images: Sequence[ImageCurve]) -> Array:
    """Return where images of D = 0 cross, (k, 2), each once."""
    found: list[Array] = []
    for up, across, i, j in strips.crossings:
        numbers = [strips.pieces[int(k)].number for k in (i, j)]
        if any(n == AXIS or images[n].curve.limit is not None for n in numbers):
            continue
        place = TURNED.T @ np.array([across, up])
        if all(np.linalg.norm(place - other) > 1e-6 for other in found):
            found.append(place)
    return np.array(found).reshape(-1, 2)
