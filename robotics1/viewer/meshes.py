"""Meshes for the page: few triangles, in parts of one colour each."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from robotics1.errors import InputError, MissingExtraError
from robotics1.robot.visuals import Color
from robotics1.viewer.clusters import FINE, clustered
from robotics1.viewer.mesh_formats.files import read_parts
from robotics1.viewer.mesh_parts import MeshPart, box_of, compact, with_places

MOST_FACES = 20_000
CELLS = 2**20  # along the longest side of a mesh: corners in one cell are one corner
SIZE_CHANGE = 0.01  # of the longest side of its box
FEWEST = 12  # faces that a part keeps: those of a box


def read_mesh(path: str | Path, *, most_faces: int = MOST_FACES) -> tuple[MeshPart, ...]:
    """Return the triangles of a mesh file: STL, OBJ, COLLADA (.dae) or glTF (.glb, .gltf).

    The nodes of the file are placed, mirrored ones with their triangles turned. As in Pinocchio's own reader, the unit
    and the upward axis that a COLLADA file declares change nothing. Parts of one colour are joined, a texture becomes
    its mean colour, and triangles without an area or with corners that are not finite are left out.

    Args:
        path: the file. It may name images and materials in its folder, below, or in a folder beside its own, and
            buffers in its folder or below.
        most_faces: with more, the triangles are made fewer by quadric decimation (Garland, Heckbert: Surface
            simplification using quadric error metrics, 1997), of millions after vertex clustering.

    Raises:
        InputError: it is no mesh, or one without triangles, too large, or one that names a file elsewhere.
        MissingExtraError: trimesh is not installed.
    """
    path = Path(path)
    parts = list(map(with_places, _joined(read_parts(path))))
    if most_faces < FINE:
        parts = clustered(parts)
    parts = [part for part in map(_welded, parts) if len(part.faces)]
    if not parts:
        raise InputError(f"mesh {str(path)!r} has no triangle with an area")
    return tuple(_fewer(parts, most_faces))


def _joined(parts: Sequence[MeshPart]) -> list[MeshPart]:
    """Return one part for each colour."""
    by_color: dict[Color | None, list[MeshPart]] = {}
    for part in parts:
        by_color.setdefault(part.color, []).append(part)
    joined = []
    for color, same in by_color.items():
        starts = np.cumsum([0] + [len(part.vertices) for part in same[:-1]])
        faces = np.vstack([part.faces + start for part, start in zip(same, starts, strict=True)])
        joined.append(MeshPart(np.vstack([part.vertices for part in same]), faces.astype(np.int32), color))
    return joined


def _welded(part: MeshPart) -> MeshPart:
    """Return a part whose triangles share corners, without those that have no area."""
    vertices = part.vertices
    if not len(vertices):
        return part
    low = vertices.min(axis=0)
    cells = ((vertices - low) * (CELLS / max(np.ptp(vertices, axis=0).max(), 1e-300))).round().astype(np.int64)
    keys = (cells[:, 0] * (2 * CELLS) + cells[:, 1]) * (2 * CELLS) + cells[:, 2]
    _, first, inverse = np.unique(keys, return_index=True, return_inverse=True)
    faces = inverse[part.faces]
    a, b, c = faces.T
    return compact(replace(part, vertices=vertices[first], faces=faces[(a != b) & (b != c) & (c != a)]))


def _fewer(parts: list[MeshPart], most: int) -> list[MeshPart]:
    """Return about as many triangles as wanted, or more, where the size of the mesh would change by more than 1 %."""
    share = most / sum(len(part.faces) for part in parts)
    box = box_of(parts)
    while share < 1:
        fewer = [_decimated(part, max(FEWEST, round(len(part.faces) * share))) for part in parts]
        if np.abs(box_of(fewer) - box).max() <= SIZE_CHANGE * np.ptp(box, axis=0).max():
            return fewer
        share *= 1.5
    return parts


def _decimated(part: MeshPart, faces: int) -> MeshPart:
    if len(part.faces) <= faces:
        return part
    try:
        from fast_simplification import simplify
    except ImportError as error:
        raise MissingExtraError("fast-simplification", "viewer") from error
    fewer, triangles = simplify(np.array(part.vertices), np.array(part.faces), target_count=faces)[:2]
    return compact(replace(part, vertices=np.asarray(fewer, float), faces=np.asarray(triangles)))
