"""From a mesh file to parts of one colour.

A mesh may come from anywhere, and its formats can say more than triangles. So

- files that it names are read by `Neighbours`, from few folders, and never from a network;
- of XML, a DOCTYPE is refused, and what is zipped is none;
- what the instances of COLLADA's nodes, and the accessors of glTF, would take in memory is counted beforehand.
"""

import io
import json
import logging
import re
import struct
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

from robotics1.errors import InputError, MissingExtraError
from robotics1.inputs import Array
from robotics1.robot.visuals import Color
from robotics1.viewer.mesh_formats.collada import collada_parts
from robotics1.viewer.mesh_formats.colors import color_of
from robotics1.viewer.mesh_formats.neighbours import LARGEST_FILE, Neighbours
from robotics1.viewer.mesh_parts import MeshPart, part_at

MOST_TRIANGLES = 5_000_000
COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
STL = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
STL_HEADER = 84  # bytes
DRACO = "KHR_draco_mesh_compression"
GLB_HEADER = struct.Struct("<4sIII4s")  # of the file: magic, version, length; of its first chunk: length, kind
VERTEX = re.compile(rb"\bvertex\s+(\S+)\s+(\S+)\s+(\S+)", re.IGNORECASE)


def read_parts(path: Path) -> list[MeshPart]:
    """Return the parts of a mesh file, one for each place of a node.

    Raises:
        InputError: it is no mesh, too large, or names a file elsewhere.
        MissingExtraError: a reader is not installed.
    """
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise InputError(f"mesh {str(path)!r} has none of the suffixes that are read: {', '.join(READERS)}")
    _silence_loggers()
    neighbours = Neighbours(path)
    data = neighbours.own()
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            warnings.filterwarnings("error", "string or file could not be read")  # numbers with something else between
            parts, total = [], 0
            for part in reader(data, neighbours):
                parts.append(part)
                total += len(part.faces)
                if total > MOST_TRIANGLES:
                    raise ValueError(f"it has more than {MOST_TRIANGLES} triangles")
    except MissingExtraError:
        raise
    except Exception as error:  # of whatever kind: the readers were not written for hostile files
        neighbours.refuse()
        reason = str(error) or type(error).__name__
        raise InputError(f"mesh {str(path)!r} cannot be read as {path.suffix[1:]}: {reason}") from error
    neighbours.refuse()
    return parts


def _silence_loggers() -> None:
    """Let no warning of the readers go to standard error, where nobody has set up logging."""
    for name in ("trimesh", "PIL"):
        logger = logging.getLogger(name)
        if not logger.handlers:
            logger.addHandler(logging.NullHandler())


# --- STL


def _stl(data: bytes, neighbours: Neighbours) -> Iterator[MeshPart]:
    count = int.from_bytes(data[STL_HEADER - 4 : STL_HEADER], "little")
    end = STL_HEADER + count * STL.itemsize
    if len(data) == end or (len(data) > end > STL_HEADER and not data.startswith(b"solid")):
        corners = np.frombuffer(data, STL, count, STL_HEADER)["corners"].reshape(-1, 3)
    else:
        corners = np.array(VERTEX.findall(data), dtype=float).reshape(-1, 3)
        if not len(corners) and not data.lstrip().startswith(b"solid"):
            raise ValueError("it is neither a binary file of the length that it says, nor begins with 'solid'")
    yield part_at(corners, np.arange(len(corners)).reshape(-1, 3), np.eye(4), None)


# --- OBJ and glTF


def _obj(data: bytes, neighbours: Neighbours) -> Iterator[MeshPart]:
    if data.count(b"\nf") > MOST_TRIANGLES:
        raise ValueError(f"it has more than {MOST_TRIANGLES} faces")
    load = _trimesh("load_obj")
    return _parts(load(io.BytesIO(data.decode("utf-8", errors="replace").encode()), resolver=neighbours))


def _gltf(data: bytes, neighbours: Neighbours) -> Iterator[MeshPart]:
    return _parts(_trimesh("load_gltf")(io.BytesIO(_plain(data)), resolver=neighbours), linear=True)


def _glb(data: bytes, neighbours: Neighbours) -> Iterator[MeshPart]:
    magic, version, _, length, kind = GLB_HEADER.unpack_from(data)
    if (magic, version, kind) != (b"glTF", 2, b"JSON"):
        raise ValueError("it does not begin as a glTF 2.0 file does")
    head, rest = _plain(data[GLB_HEADER.size : GLB_HEADER.size + length]), data[GLB_HEADER.size + length :]
    head += b" " * (-len(head) % 4)
    begin = GLB_HEADER.pack(magic, version, GLB_HEADER.size + len(head) + len(rest), len(head), kind)
    return _parts(_trimesh("load_glb")(io.BytesIO(begin + head + rest), resolver=neighbours), linear=True)


def _plain(text: bytes) -> bytes:
    """Return the JSON of a glTF file without the extensions of its materials, for which trimesh opens whole images.

    Raises:
        ValueError: its views and accessors, which may all show the same bytes, take too much memory, or its
            triangles are compressed.
    """
    tree = json.loads(text)
    sizes = [int(view["byteLength"]) for view in tree.get("bufferViews", ())]
    sizes += [8 * int(a["count"]) * COMPONENTS[a["type"]] for a in tree.get("accessors", ())]
    if sum(sizes) > 4 * LARGEST_FILE or min(sizes, default=0) < 0:
        raise ValueError("its buffers are used too often")
    _refuse_compression(tree.get("extensionsUsed", ()))
    for material in tree.get("materials", ()):
        material.pop("extensions", None)
    return json.dumps(tree).encode()


def _refuse_compression(extensions: Iterable[str]) -> None:
    """Refuse triangles that are compressed, but for Draco's where DracoPy is installed, by which trimesh reads them.

    Raises:
        ValueError: they are compressed otherwise, or DracoPy is not installed.
    """
    for name in extensions:
        if name == DRACO and find_spec("DracoPy") is None:
            raise ValueError(f"it is compressed by {name}; to read it, pip install 'robotics1[draco]'")
        if name != DRACO and "compression" in name:
            raise ValueError(f"it is compressed by {name}, which is not read")


def _trimesh(name: str) -> Callable[..., Mapping[str, Any]]:
    """Return a reader of trimesh."""
    try:
        from trimesh.exchange import gltf, obj
    except ImportError as error:
        raise MissingExtraError("trimesh", "viewer") from error
    reader: Callable[..., Mapping[str, Any]] = getattr(obj if name == "load_obj" else gltf, name)
    return reader


def _parts(loaded: Mapping[str, Any], *, linear: bool = False) -> Iterator[MeshPart]:
    """Return what trimesh has read: geometries, and a graph of nodes of which some place one; parents come first.

    `linear` says that its colours are amounts of light.
    """
    geometries = loaded.get("geometry", {"": loaded})
    graph = loaded.get("graph") or [{"geometry": name, "frame_to": name} for name in geometries]
    worlds: dict[Any, Array] = {}
    means: dict[int, Array | None] = {}
    for edge in graph:
        T = worlds.get(edge.get("frame_from"), np.eye(4)) @ edge.get("matrix", np.eye(4))
        worlds[edge["frame_to"]] = T
        geometry = geometries.get(edge.get("geometry"), {})
        if "faces" in geometry:
            color: Color | None = color_of(geometry, means, linear=linear)
            yield part_at(geometry["vertices"], geometry["faces"], T, color)


READERS: dict[str, Callable[[bytes, Neighbours], Iterable[MeshPart]]] = {
    ".stl": _stl,
    ".obj": _obj,
    ".dae": collada_parts,
    ".glb": _glb,
    ".gltf": _gltf,
}
