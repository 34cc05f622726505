"""The workspace of arms whose boundary is not known exactly: by cells of a stated side."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from math import tau
from time import monotonic

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.robot.model import Robot
from robotics1.workspaces.axes import Axis
from robotics1.workspaces.certified.extremes import Measure, extremes_of
from robotics1.workspaces.certified.objective import Objective
from robotics1.workspaces.certified.search import Search
from robotics1.workspaces.chain import Chain, chain_of
from robotics1.workspaces.curved.strip_regions import closed_loops
from robotics1.workspaces.moving_point import MovingPoint
from robotics1.workspaces.placed_section import SectionFrame, frame_of_section
from robotics1.workspaces.result import Workspace, WorkspaceRegion
from robotics1.workspaces.sampled.sampled_place import SampledPlace
from robotics1.workspaces.sampled.sampled_section import SampledSection, sampled_section

CELLS = 120  # along the longer side of the section
STARTS = 12
SMALL = 1e-9  # of the arm's reach: a distance that is none
# the shift that brings the cell beside, and the ends of the side between, with the first cell on the left
SIDES = (((0, 1), (0, 0), (1, 0)), ((-1, 0), (1, 0), (1, 1)), ((0, -1), (1, 1), (0, 1)), ((1, 0), (0, 1), (0, 0)))
SECONDS, TOLERANCE = 2.0, 1e-6  # to prove the smallest and the largest distance each; the tolerance by the reach
ROUNDING = 1e-10  # by which their bounds are moved outwards, by the reach
POINTS = 1500  # of the section, turned at random, where the first joint has limits


def sampled_workspace(robot: Robot, point: MovingPoint, *, seed: int = 0) -> Workspace:
    """Return the workspace of any arm by cells."""
    base = point.axes[0] if len(point.rows) == 3 else None
    frame, origin = frame_of_section(base, point.rows)
    at = SectionFrame(point.rows, origin, frame, base, point.neutral)
    whole = _placed(point.axes, point.tip, frame, origin)
    chain = chain_of(whole.axes[1:], whole.tip) if base is not None else whole
    section = sampled_section(chain, at.about_axis, CELLS, seed)
    place = SampledPlace(at, section, whole, seed)
    regions, voids = _components(section)
    area = float(section.reached.sum()) * section.side**2
    volume, error = _volume(place)
    (r_min, nearest, least), (r_max, farthest, most) = (
        _extreme(robot, place, largest=largest) for largest in (False, True)
    )
    return Workspace(
        robot_name=robot.name,
        area=area,
        volume=volume,
        volume_error=error,
        r_min=r_min,
        r_max=r_max,
        nearest=nearest,
        farthest=farthest,
        regions=regions,
        voids=voids,
        coordinates=at.names,
        redundant=True,
        section=place,
        resolution=section.side,
        r_bounds=(min(least, r_min), most),
    )


def _placed(axes: Sequence[Axis], tip: Array, frame: Array, origin: Array) -> Chain:
    """Return the joints in the section's frame."""
    moved = [replace(axis, direction=frame @ axis.direction, point=frame @ (axis.point - origin)) for axis in axes]
    return chain_of(moved, frame @ (tip - origin))


def _components(section: SampledSection) -> tuple[tuple[WorkspaceRegion, ...], tuple[WorkspaceRegion, ...]]:
    """Return the regions of reached cells, and the voids that cells around them enclose."""
    from scipy.ndimage import label

    reached, n_reached = label(section.reached)
    around = ((0 if section.about_axis else 1, 1), (1, 1))
    empty, n_empty = label(np.pad(~section.reached, around, constant_values=True))
    edges = [empty[-1], empty[:, 0], empty[:, -1]] + ([] if section.about_axis else [empty[0]])
    outside = set(np.concatenate(edges).tolist())
    inner = empty[0 if section.about_axis else 1 : -1, 1:-1]
    return (
        tuple(_region(section, reached == k, 1) for k in range(1, n_reached + 1)),
        tuple(_region(section, inner == k, 0) for k in range(1, n_empty + 1) if k not in outside),
    )


def _region(section: SampledSection, cells: npt.NDArray[np.bool_], solutions: int) -> WorkspaceRegion:
    from scipy.ndimage import distance_transform_edt

    depth = distance_transform_edt(np.pad(cells, 1))[1:-1, 1:-1]
    deepest = np.unravel_index(int(np.argmax(depth)), depth.shape)
    area = float(cells.sum()) * section.side**2
    sum_of_rho = float(section.middle(np.argwhere(cells))[:, 0].sum())
    volume = tau * sum_of_rho * section.side**2 if section.about_axis else None
    outline = tuple(closed_loops(list(_sides(section, cells))))
    return WorkspaceRegion(solutions, area, volume, section.middle(np.array([deepest]))[0], outline)


def _sides(section: SampledSection, cells: npt.NDArray[np.bool_]) -> Iterator[Array]:
    """Yield the sides of cells that are beside others, each (2, 2), with the cells on the left."""
    padded = np.pad(cells, 1)
    for beside, start, end in SIDES:
        other = np.roll(padded, beside, axis=(0, 1))
        for cell in np.argwhere(padded & ~other) - 1:
            yield section.corner + section.side * np.array([cell + start, cell + end])


def _volume(place: SampledPlace) -> tuple[float | None, float]:
    """Return the volume and about how wrong it is: half of the cells at the edge, and the share that is sampled."""
    section, base = place.section, place.place.base
    if base is None:
        return None, 0.0
    cells = np.argwhere(section.reached)
    weights = section.middle(cells)[:, 0] if section.about_axis else np.ones(len(cells))
    padded = np.pad(section.reached, 1)
    inner = padded[:-2, 1:-1] & padded[2:, 1:-1] & padded[1:-1, :-2] & padded[1:-1, 2:]
    at_edge = ~inner[section.reached]
    full = float(weights.sum()) * section.side**2
    doubt = float(weights[at_edge].sum()) / 2 * section.side**2
    if base.circular:  # only a joint that turns
        return tau * full, tau * doubt
    rng = np.random.default_rng(place.seed + 2)
    chosen = rng.choice(len(cells), POINTS, p=weights / weights.sum())
    z = section.middle(cells[chosen]) + (rng.random((POINTS, 2)) - 0.5) * section.side
    if base.revolute:
        around = tau
        turn = rng.uniform(0, tau, POINTS)
        points = np.column_stack([z[:, 0] * np.cos(turn), z[:, 0] * np.sin(turn), z[:, 1]])
    else:
        heights = place.whole.point(place.whole.drawn(rng, 20_000))[:, 2]
        low, around = float(heights.min()), float(np.ptp(heights))
        points = np.column_stack([z, low + around * rng.random(POINTS)])
    share = float(place.reaches(points).mean())
    sampled = 2 * np.sqrt(max(share * (1 - share), 1 / POINTS) / POINTS)
    return around * full * share, around * (doubt * share + full * sampled)


def _extreme(robot: Robot, place: SampledPlace, *, largest: bool) -> tuple[float, Array, float]:
    """Return the largest or smallest distance from the first joint's axis, a configuration (1, nq), and its bound."""
    sign, whole = 1.0 if largest else -1.0, place.whole
    objective = Objective(whole, Measure(np.diag([1.0, 1.0, 0.0]), np.zeros(3)), sign)
    values, found = extremes_of(whole, objective.measure, STARTS, largest=largest)
    best = int(np.argmax(sign * values))
    search = Search(objective, TOLERANCE * robot.reach, monotonic() + SECONDS)
    sure, _ = search.run(float(values[best]), found[best])
    q = place.place.neutral.copy()
    q[whole.numbers] = sure.q
    value, bound = (objective.meant(F) for F in (sure.value, sure.bound))
    bound = max(bound + sign * ROUNDING * robot.reach, 0.0)
    return value if value > SMALL * robot.reach else 0.0, q[None], bound
