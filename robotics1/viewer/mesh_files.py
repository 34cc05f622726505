"""From a mesh file to pieces of one colour, by trimesh.

A mesh may come from anywhere, and its formats can say more than triangles. Before trimesh and pycollada see a file:

- a DOCTYPE is refused, and a zip file that is called .dae is no XML;
- what the instances of COLLADA's nodes and the accessors of glTF would take in memory is counted from the text;
- files that it names are read by `Neighbours`, from few folders, and never from a network.
"""

import io
import json
import logging
import struct
import warnings
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError, MissingExtraError, RobotFileError
from robotics1.inputs import Array
from robotics1.robot.markup import Element, decoded, parse_xml, undeclared
from robotics1.robot.visuals import Color
from robotics1.viewer.mesh_colors import color_of
from robotics1.viewer.mesh_neighbours import LARGEST_FILE, Neighbours

MOST_TRIANGLES = 5_000_000
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}


@dataclass
class Piece:
    """Triangles of one colour: vertices (n, 3), faces (m, 3)."""

    vertices: Array
    faces: npt.NDArray[np.int_]
    color: Color | None


def read_pieces(path: Path) -> list[Piece]:
    """Return the pieces of a mesh file, placed.

    Raises:
        InputError: it is no mesh, too large, or names a file elsewhere.
        MissingExtraError: trimesh is not installed.
    """
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise InputError(f"mesh {str(path)!r} has none of the suffixes that are read: {', '.join(READERS)}")
    neighbours = Neighbours(path)
    try:
        import trimesh  # noqa: F401
    except ImportError as error:
        raise MissingExtraError("trimesh", "viewer") from error
    _silence_loggers()
    data = neighbours.own()
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            warnings.filterwarnings("error", "string or file could not be read")  # numbers with something else between
            pieces = list(_pieces(reader(data, path, neighbours)))
    except MissingExtraError:
        raise
    except InputError as error:
        raise InputError(f"mesh {str(path)!r} {error}") from error
    except Exception as error:  # of whatever kind: these readers were not written for hostile files
        neighbours.refuse()
        raise InputError(f"mesh {str(path)!r} cannot be read as {path.suffix[1:]}: {error or type(error)}") from error
    neighbours.refuse()
    return pieces


def _silence_loggers() -> None:
    """Let no warning of the readers go to standard error, where nobody has set up logging."""
    for name in ("trimesh", "PIL"):
        logger = logging.getLogger(name)
        if not logger.handlers:
            logger.addHandler(logging.NullHandler())


def _pieces(loaded: Mapping[str, Any]) -> Iterator[Piece]:
    """Return what trimesh has read: geometries, and a graph of nodes of which some place one; parents come first."""
    geometries = loaded.get("geometry", {"": loaded})
    graph = loaded.get("graph") or [{"geometry": name, "frame_to": name} for name in geometries]
    worlds: dict[Any, Array] = {}
    colors: dict[int, Color] = {}
    total = 0
    for edge in graph:
        T = worlds.get(edge.get("frame_from"), np.eye(4)) @ edge.get("matrix", np.eye(4))
        worlds[edge["frame_to"]] = T
        geometry = geometries.get(edge.get("geometry"), {})
        vertices, faces = (np.asarray(geometry.get(name, np.zeros((0, 3)))) for name in ("vertices", "faces"))
        total += len(faces)
        if total > MOST_TRIANGLES:
            raise InputError(f"has more than {MOST_TRIANGLES} triangles")
        if not len(faces):
            continue
        faces = faces.astype(np.int64).reshape(-1, 3)
        if faces.min() < 0 or faces.max() >= len(vertices):
            raise InputError("has a triangle with a corner that is not there")
        if np.linalg.det(T[:3, :3]) < 0:
            faces = faces[:, ::-1]
        yield Piece(vertices @ T[:3, :3].T + T[:3, 3], faces, color_of(geometry, colors))


# --- the formats


def _stl(data: bytes, path: Path, neighbours: Neighbours) -> Mapping[str, Any]:
    from trimesh.exchange.stl import load_stl

    if len(data) < 84 or len(data) != 84 + 50 * int.from_bytes(data[80:84], "little"):
        data = data.decode("utf-8", errors="replace").encode()
    loaded: Mapping[str, Any] = load_stl(io.BytesIO(data))
    return loaded if "vertices" in loaded or "geometry" in loaded else {"geometry": loaded}


def _obj(data: bytes, path: Path, neighbours: Neighbours) -> Mapping[str, Any]:
    from trimesh.exchange.obj import load_obj

    text = data.decode("utf-8", errors="replace").encode()
    loaded: Mapping[str, Any] = load_obj(io.BytesIO(text), resolver=neighbours)
    return loaded


def _dae(data: bytes, path: Path, neighbours: Neighbours) -> Mapping[str, Any]:
    from trimesh.exchange.dae import load_collada

    try:
        import collada  # noqa: F401
    except ImportError as error:
        raise MissingExtraError("pycollada", "viewer") from error
    try:
        text = undeclared(decoded(data, path))
        root = parse_xml(text, path, largest=LARGEST_FILE)
    except RobotFileError as error:
        raise InputError(f"cannot be read as dae: {error.message}") from error
    if not root.tag.endswith("COLLADA"):
        raise InputError("cannot be read as dae: its root is no <COLLADA>")
    if _placed_text(root) > LARGEST_FILE:
        raise InputError("cannot be read as dae: its nodes place its geometries too often")
    loaded: Mapping[str, Any] = load_collada(io.BytesIO(text.encode()), resolver=neighbours)
    return loaded


def _placed_text(root: Element) -> int:
    """Return the length of the text of all geometries that the nodes place, of some more than once."""
    within = root.tag[: -len("COLLADA")]
    geometries = {g.get("id", ""): _text_of(g, within) for g in root.iter(f"{within}geometry")}
    nodes = {node.get("id", ""): node for node in root.iter(f"{within}node")}
    found: dict[int, int] = {}

    def size(node: Any) -> int:
        if id(node) not in found:
            found[id(node)] = LARGEST_FILE + 1  # of a node in itself
            total = 1
            for child in node:
                kind, target = child.tag.removeprefix(within), child.get("url", "#")[1:]
                if kind == "node":
                    total += size(child)
                elif kind == "instance_node" and target in nodes:
                    total += size(nodes[target])
                elif kind == "instance_geometry":
                    total += 1 + geometries.get(target, 0)
            found[id(node)] = total
        return found[id(node)]

    scenes = root.iter(f"{within}visual_scene")
    return sum(size(node) for scene in scenes for node in scene if node.tag == f"{within}node")


def _text_of(geometry: Any, within: str) -> int:
    """Return the length of the lists of corners; what the numbers of corners of polygons add up to must fit."""
    lengths = sum(len(p.text or "") for p in geometry.iter(f"{within}p"))
    corners = sum(sum(map(int, (counts.text or "").split())) for counts in geometry.iter(f"{within}vcount"))
    if corners > lengths:
        raise InputError("cannot be read as dae: it has polygons with more corners than it lists")
    return lengths


def _glb(data: bytes, path: Path, neighbours: Neighbours) -> Mapping[str, Any]:
    from trimesh.exchange.gltf import load_glb

    magic, version, _, length, kind = struct.unpack_from("<4sIII4s", data)
    if (magic, version, kind) != (b"glTF", 2, b"JSON"):
        raise InputError("cannot be read as glb: it does not begin as a glTF 2.0 file does")
    _check_sizes(json.loads(data[20 : 20 + length]))
    return _screen_colors(load_glb(io.BytesIO(data), resolver=neighbours))


def _gltf(data: bytes, path: Path, neighbours: Neighbours) -> Mapping[str, Any]:
    from trimesh.exchange.gltf import load_gltf

    _check_sizes(json.loads(data))
    return _screen_colors(load_gltf(io.BytesIO(data), resolver=neighbours))


def _check_sizes(header: Mapping[str, Any]) -> None:
    """Refuse a glTF file whose views and accessors, which may all show the same bytes, take too much memory."""
    size = sum(int(view["byteLength"]) for view in header.get("bufferViews", ()))
    size += sum(8 * int(a["count"]) * COMPONENTS[a["type"]] for a in header.get("accessors", ()))
    if size > 4 * LARGEST_FILE:
        raise InputError("cannot be read as glTF: its buffers are used too often")


def _screen_colors(loaded: Mapping[str, Any]) -> Mapping[str, Any]:
    """Mark the geometries of glTF, whose colours are linear in the light."""
    for geometry in loaded.get("geometry", {}).values():
        geometry["linear_colors"] = True
    return loaded


READERS: dict[str, Callable[[bytes, Path, Neighbours], Mapping[str, Any]]] = {
    ".stl": _stl,
    ".obj": _obj,
    ".dae": _dae,
    ".glb": _glb,
    ".gltf": _gltf,
}
