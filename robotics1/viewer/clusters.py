"""Vertex clustering: meshes of millions of triangles become such that quadric decimation takes seconds."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.viewer.mesh_parts import Indices, MeshPart, box_of, compact

FINE = 400_000  # triangles of a mesh that quadric decimation takes as they are
CELLS = 128  # along the longest side of the mesh
NEAR = 1e-3  # of the longest side of the mesh: as near the box of a part
ALONE = 100_000  # triangles that are kept where they share no corners


def clustered(parts: Sequence[MeshPart]) -> list[MeshPart]:
    """Return a mesh of at most some 400 000 triangles.

    The corners in one cell of a grid become one, their mean, and the triangles with two corners in one cell vanish
    (Rossignac, Borrel: Multi-resolution 3D approximations for rendering complex scenes, 1993). Where that changes
    little, the triangles are no surface, and the largest ones are kept. Each part keeps its box.

    Args:
        parts: the parts, all corners finite.
    """
    parts, cells = [part for part in parts if len(part.faces)], CELLS
    count = _count(parts)
    while count > FINE:
        box = box_of(parts)
        coarse = [_in_cells(part, box, cells) for part in parts]
        if _count(coarse) > count / 2:
            size = np.ptp(box, axis=0).max()
            return [_largest(part, max(1, round(ALONE * len(part.faces) / count)), size) for part in parts]
        parts = coarse
        count, cells = _count(parts), cells // 2
    return parts


def _count(parts: Sequence[MeshPart]) -> int:
    return sum(len(part.faces) for part in parts)


def _in_cells(part: MeshPart, box: Array, cells: int) -> MeshPart:
    """Return a part with one corner for each cell that has some; the outermost stay on the part's own box."""
    low, size = box[0], max(np.ptp(box, axis=0).max(), 1e-300)
    at = np.minimum((part.vertices - low) * (cells / size), cells - 1).astype(np.int32)
    cell = (at[:, 0] * cells + at[:, 1]) * cells + at[:, 2]
    count = np.bincount(cell, minlength=cells**3)
    sums = [np.bincount(cell, weights=axis, minlength=cells**3) for axis in part.vertices.T]
    filled = np.flatnonzero(count)
    number = np.zeros(cells**3, dtype=np.int32)
    number[filled] = np.arange(len(filled))
    corners = np.stack([axis[filled] for axis in sums], axis=1) / count[filled, None]
    for axis in range(3):
        corners[corners[:, axis].argmin(), axis] = part.vertices[:, axis].min()
        corners[corners[:, axis].argmax(), axis] = part.vertices[:, axis].max()
    coarse = compact(replace(part, vertices=corners, faces=_distinct(number[cell][part.faces])))
    if len(coarse.faces) and np.abs(box_of([coarse]) - box_of([part])).max() <= NEAR * size:
        return coarse
    rim = compact(replace(part, faces=part.faces[_outermost(part, size)]))  # what lies alone in a cell has vanished
    vertices, faces = np.vstack([coarse.vertices, rim.vertices]), rim.faces + len(coarse.vertices)
    return replace(part, vertices=vertices, faces=np.vstack([coarse.faces, faces]))


def _distinct(faces: Indices) -> Indices:
    """Return the triangles with three corners, each once."""
    a, b, c = faces.T
    faces = faces[(a != b) & (b != c) & (c != a)]
    a, b, c = faces.T.astype(np.int64)
    low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
    middle = a + b + c - low - high
    _, first = np.unique((low << 42) | (middle << 21) | high, return_index=True)  # a cell's number has 21 bits
    return faces[np.sort(first)]


def _largest(part: MeshPart, most: int, size: float) -> MeshPart:
    """Return the triangles of the largest area, and those that touch the box of the part."""
    kept = (
        np.argpartition(_area(part, part.faces), -most)[-most:]
        if most < len(part.faces)
        else np.arange(len(part.faces))
    )
    return compact(replace(part, faces=part.faces[np.union1d(kept, _outermost(part, size))]))


def _outermost(part: MeshPart, size: float) -> npt.NDArray[np.intp]:
    """Return the numbers of the largest triangles near each of the six sides of the box of a part."""
    low, high = box_of([part])
    near = [part.vertices <= low + NEAR * size, part.vertices >= high - NEAR * size]
    sides = np.packbits(np.hstack(near), axis=1)[:, 0]  # a bit for each side
    a, b, c = part.faces.T
    sides = sides[a] | sides[b] | sides[c]
    found = []
    for bit in range(2, 8):
        touching = np.flatnonzero(sides & (1 << bit))
        found.append(touching[_area(part, part.faces[touching]).argmax()])
    return np.unique(found)


def _area(part: MeshPart, faces: Indices) -> Array:
    """Return twice the area of each triangle, (m,)."""
    a, b, c = (part.vertices[corner] for corner in faces.T)
    area: Array = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return area
