"""The section of a workspace in space with any plane: a horizontal slice, a vertical one, or one through a table.

A plane across the axis of a first joint that turns fully cuts the workspace in rings, whose radii are those where a ray
from the axis crosses the boundary. In any other plane points of a grid are looked at, coarse ones first: a cell is cut
into quarters where its corners differ, or where the boundary is nearer to its middle than they are. On each side of the
smallest cells that the boundary crosses, the crossing is found by halving.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import pi

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, real_array
from robotics1.notation import count
from robotics1.results import Frozen
from robotics1.workspaces.axes import across
from robotics1.workspaces.curved.level_lines import Function, level_lines
from robotics1.workspaces.questions.passages import crossings
from robotics1.workspaces.result import Workspace, check_workspace

COARSE = 16  # cells along the longer side, at first
HALVINGS = (3, 2)  # of a cell; the second where the workspace is sampled
ENDS = 14  # halvings of a side, down to a sixteen-thousandth of it
ALONG = 1 - 1e-9  # cos of an angle between lines that are one
OFF_CENTRE = 0.381966  # of a cell, so that no point of the grid lies on a line of symmetry
ASKED = 15  # parts of a curve that are asked on which side it is reached
AROUND = 2 * pi * np.arange(181) / 180  # of a ring that is drawn


@dataclass(frozen=True, eq=False)
class PlaneSection(Frozen):
    """What an arm reaches in a plane.

    Attributes:
        robot_name: the robot's name.
        area: [m²].
        area_error: about how wrong it may be [m²]; 0 of rings that are exact.
        outlines: closed curves (k, 2) in the plane's coordinates [m], with what is reached on their left.
        radii: (k, 2) of rings about the first joint's axis, from which to which distance [m]; else (0, 2).
        point: (3,) the origin of the plane's coordinates, in world axes [m]; the centre of rings.
        axes: (2, 3) the directions of the coordinates in world axes: (u, v) is at point + u axes[0] + v axes[1].
        resolution: the side of the cells [m], 0 of rings that are exact; what is smaller may be missed.
    """

    robot_name: str
    area: float
    area_error: float
    outlines: tuple[Array, ...] = field(repr=False)
    radii: Array
    point: Array
    axes: Array
    resolution: float

    def explain(self) -> str:
        """Return the area, and the rings or the curves, in sentences."""
        if not len(self.outlines):
            return f"{self.robot_name} reaches nothing in this plane."
        size = f"{self.area:.6g} m², to about {self.area_error:.1g} m²," if self.area_error else f"{self.area:.9g} m²"
        lines = [f"{self.robot_name} reaches an area of {size} in this plane."]
        where = ", ".join(f"{x:.6g}" for x in self.point)
        lines += [f"It is the ring from {a:.9g} m to {b:.9g} m about ({where}) m." for a, b in self.radii]
        if not len(self.radii):
            lines.append(f"Its boundary is {count(len(self.outlines), 'closed curve')}.")
        if self.resolution:
            lines.append(f"What is smaller than {self.resolution:.2g} m may be missed.")
        return "\n".join(lines)


def plane_section(ws: Workspace, point: npt.ArrayLike, normal: npt.ArrayLike) -> PlaneSection:
    """Return what an arm in space reaches in the plane n·(P − point) = 0.

    Args:
        ws: what `workspace(robot, PositionTask())` returns.
        point: (3,) a point of the plane in world axes [m].
        normal: (3,) the plane's normal n in world axes, of any length: (0, 0, 1) for a horizontal plane.

    Raises:
        InputError: ws is no workspace, or the point or the normal has another form.
        TaskError: the workspace is one in a plane.
    """
    check_workspace(ws)
    p = real_array("point", point, (3,), "a point in world axes [m]")
    n = real_array("normal", normal, (3,), "a direction in world axes")
    length = float(np.linalg.norm(n))
    if length == 0:
        raise InputError("normal must not be zero; a horizontal plane has (0, 0, 1)")
    if ws.volume is None:
        raise TaskError("the workspace is one in a plane: its regions are what a section of one in space would be")
    n = n / length
    first = across(n)
    axes = np.array([first, np.cross(n, first)])
    turn = ws.section.full_turn()
    if turn is not None and abs(turn[1] @ n) > ALONG:
        centre = turn[0] + turn[1] * ((p - turn[0]) @ n) / (turn[1] @ n)
        return _rings(ws, centre, axes)
    return _outlines(ws, p, axes)


def _rings(ws: Workspace, centre: Array, axes: Array) -> PlaneSection:
    """Return the rings about an axis: where a ray from it is inside."""
    end = 1.01 * ws.r_max
    radii = np.clip(crossings(ws, [centre, centre + end * axes[0]]).intervals * end, 0, None)
    circle = np.column_stack([np.cos(AROUND), np.sin(AROUND)])
    drawn = [r * line for a, b in radii for r, line in ((b, circle), (a, circle[::-1])) if r > 0]
    area = float(pi * (radii[:, 1] ** 2 - radii[:, 0] ** 2).sum())
    error = pi * ws.resolution * float(radii.sum())  # half a cell at each circle
    return PlaneSection(ws.robot_name, area, error, tuple(drawn), radii, centre, axes, ws.resolution)


def _outlines(ws: Workspace, p: Array, axes: Array) -> PlaneSection:
    """Return the curves around what is reached in any plane."""
    places = (ws.section.corners() - p) @ axes.T
    low, high = places.min(axis=0), places.max(axis=0)
    halvings = HALVINGS[int(ws.resolution > 0)]
    side = float((high - low).max()) / (COARSE * 2**halvings)
    cells = np.ceil((high - low) / side / 2**halvings + 1).astype(int) * 2**halvings
    u, v = (low[k] + (np.arange(cells[k] + 1) - OFF_CENTRE) * side for k in range(2))

    def sign(z: Array) -> Array:
        return np.where(ws.section.contains_each(p + z @ axes), 1.0, -1.0)

    values = _signs(ws, sign, (u, v), p, axes, 2**halvings)
    lines = level_lines(sign, (u, v), values, (False, False), _by_halving)
    loops = [_with_inside_left(line, sign, side) for line, _ in lines]
    areas = np.array([_area(loop) for loop in loops])
    rough = np.array([_area(loop[::2]) for loop in loops])
    error = float(np.abs(areas - rough).sum()) / 3  # chords of half the length have a quarter of the error
    return PlaneSection(
        ws.robot_name, float(areas.sum()), error, tuple(loops), np.zeros((0, 2)), p, axes, side,
    )  # fmt: skip


def _signs(ws: Workspace, sign: Function, grid: tuple[Array, Array], p: Array, axes: Array, step: int) -> Array:
    """Return 1 where points of a grid are reached and −1 elsewhere; what is between is filled where cells are alike."""
    u, v = grid
    values = np.zeros((len(u), len(v)))

    def need(i: Array, j: Array) -> None:
        new = values[i, j] == 0
        i, j = i[new], j[new]
        if len(i):
            values[i, j] = sign(np.column_stack([u[i], v[j]]))

    cells = [(i, j) for i in range(0, len(u) - 1, step) for j in range(0, len(v) - 1, step)]
    while cells:
        at = np.array(cells)
        for di, dj in ((0, 0), (step, 0), (0, step), (step, step)):
            need(*np.unique(at + np.array([di, dj]), axis=0).T)
        left = []
        for i, j in cells:
            corners = values[[i, i + step, i, i + step], [j, j, j + step, j + step]]
            middle = np.array([(u[i] + u[i + step]) / 2, (v[j] + v[j + step]) / 2])
            if abs(corners.sum()) == 4 and ws.section.clearance(p + middle @ axes) > (u[i + step] - u[i]) * 0.5**0.5:
                block = values[i : i + step + 1, j : j + step + 1]
                block[block == 0] = corners[0]
            elif step > 1:
                half = step // 2
                left += [(i + a, j + b) for a in (0, half) for b in (0, half)]
        cells, step = left, step // 2
    return values


def _by_halving(sign: Function, a: Array, b: Array) -> Array:
    """Return where points change from reached to not reached between a and b (k, 2)."""
    start = sign(a)
    for _ in range(ENDS):
        middle = (a + b) / 2
        same = (sign(middle) == start)[:, None]
        a, b = np.where(same, middle, a), np.where(same, b, middle)
    return np.asarray((a + b) / 2)


def _with_inside_left(line: Array, sign: Function, side: float) -> Array:
    """Return a closed curve in the direction in which what is reached is on its left."""
    closed = line if np.array_equal(line[0], line[-1]) else np.vstack([line, line[:1]])
    steps = np.diff(closed, axis=0)
    some = np.argsort(-np.linalg.norm(steps, axis=1))[:ASKED]
    normals = np.column_stack([-steps[some, 1], steps[some, 0]]) / np.linalg.norm(steps[some], axis=1)[:, None]
    middle, beside = (closed[some] + closed[some + 1]) / 2, 0.2 * side * normals
    return closed if (sign(middle + beside) - sign(middle - beside)).sum() > 0 else closed[::-1].copy()


def _area(line: Array) -> float:
    """Return ½ ∮ (u dv − v du) of a closed line."""
    u, v = np.vstack([line, line[:1]]).T
    return float((u[:-1] * v[1:] - u[1:] * v[:-1]).sum() / 2)
