"""A piece of a mesh: triangles of one colour, where a node of the file places them."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.robot.visuals import Color

MOST_TRIANGLES = 5_000_000


@dataclass
class Piece:
    """Triangles of one colour: vertices (n, 3), faces (m, 3)."""

    vertices: Array
    faces: npt.NDArray[np.int_]
    color: Color | None


def placed(vertices: Any, faces: Any, T: Array, color: Color | None) -> Piece:
    """Return a piece moved by T (4, 4); the triangles are turned where T mirrors them.

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
    return Piece(np.asarray(vertices, float) @ T[:3, :3].T + T[:3, 3], faces, color)


def few(pieces: Iterable[Piece]) -> Iterator[Piece]:
    """Return the pieces, as long as they are not too many for a page.

    Raises:
        ValueError: they have more than five million triangles.
    """
    total = 0
    for piece in pieces:
        total += len(piece.faces)
        if total > MOST_TRIANGLES:
            raise ValueError(f"it has more than {MOST_TRIANGLES} triangles")
        yield piece
