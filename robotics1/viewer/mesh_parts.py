"""Triangles of one colour, and what is measured of them."""

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.results import Frozen
from robotics1.robot.findings import LARGEST
from robotics1.robot.visuals import Color

Indices = npt.NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class MeshPart(Frozen):
    """Triangles of one colour.

    Attributes:
        vertices: (n, 3) the corners, in the units and axes of the file.
        faces: (m, 3) the numbers of the corners of each triangle, anticlockwise as seen from outside.
        color: red, green, blue and opacity from 0 to 1, as the screen shows them (sRGB), or None.
    """

    vertices: Array
    faces: Indices
    color: Color | None


def part_at(vertices: Any, faces: Any, T: Array, color: Color | None) -> MeshPart:
    """Return a part moved by T (4, 4); the triangles are turned where T mirrors them.

    Args:
        vertices: (n, 3) its corners.
        faces: (m, k) the numbers of the corners of triangles, or of polygons, which become fans.
        T: (4, 4) where it is placed.
        color: its colour.

    Raises:
        ValueError: a triangle has a corner that is not there.
    """
    polygons = np.asarray(faces).astype(np.int64)
    fans = [polygons[:, [0, corner, corner + 1]] for corner in range(1, polygons.shape[1] - 1)]
    faces = np.concatenate(fans) if fans else np.zeros((0, 3), np.int64)
    if len(faces) and (faces.min() < 0 or faces.max() >= len(vertices)):
        raise ValueError("a triangle has a corner that is not there")
    if np.linalg.det(T[:3, :3]) < 0:
        faces = faces[:, ::-1]
    return MeshPart(np.asarray(vertices, float) @ T[:3, :3].T + T[:3, 3], faces.astype(np.int32), color)


def with_places(part: MeshPart) -> MeshPart:
    """Return a part without the triangles that have a corner at no place: not finite, or too far."""
    if np.abs(part.vertices).max(initial=0) <= LARGEST:  # which NaN is not
        return compact(part)
    there = np.all(np.abs(part.vertices) <= LARGEST, axis=1)
    return compact(replace(part, faces=part.faces[there[part.faces].all(axis=1)]))


def compact(part: MeshPart) -> MeshPart:
    """Return a part with the corners that its triangles use."""
    used = np.zeros(len(part.vertices), dtype=bool)
    used[part.faces] = True
    number = np.cumsum(used, dtype=np.int32) - 1
    return replace(part, vertices=part.vertices[used], faces=number[part.faces].reshape(-1, 3))


def box_of(parts: list[MeshPart]) -> Array:
    """Return the lowest and the highest x, y and z of the corners, (2, 3)."""
    points = np.vstack([part.vertices for part in parts])
    return np.array([points.min(axis=0), points.max(axis=0)])
