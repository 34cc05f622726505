"""Maps as folders of Zarr arrays: written chunk by chunk, so that a map that was interrupted goes on, and read again.

Each chunk of an array is a file with a checksum, which takes its place as a whole. A part of the map is done when all
arrays have its chunk; so it does not matter when a process is killed.
"""

import hashlib
import os
import secrets
import shutil
from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np

from robotics1.chunks.identity import Identity, refuse_another
from robotics1.errors import InputError, MissingExtraError
from robotics1.inputs import Array
from robotics1.workspaces.reachability.chunk import (
    ChunkOfMap,
    Description,
    chunk_of_map,
    empty_chunk,
    positions_in_a_chunk,
)
from robotics1.workspaces.reachability.damage import readable, whole_parts
from robotics1.workspaces.reachability.result import ReachabilityMap

NAME = "robotics1"  # of the attribute that says what the arrays are
FORMAT = 1
NOT_DONE = {  # no answer is one of these; Zarr writes no chunk that is full of them
    "status": 254, "solutions": 254, "manipulability": -2.0, "limit_margin": -2.0, "q": -np.inf, "orientation": -2
}  # fmt: skip


class MapFolder:
    """The folder of a map that is being made.

    Attributes:
        path: the folder.
        description: what the map is of.
        token: by which a worker knows the folder again.
    """

    def __init__(self, path: Path, description: Description) -> None:
        self.path, self.description = path, description
        with readable(path):
            self._arrays, self.token = arrays_of(path), token_of(path)

    def left(self) -> list[slice]:
        """Return the parts that are not done."""
        done = self.done()
        return [part for number, part in enumerate(self.description.parts) if number not in done]

    def tidy(self) -> None:
        """Remove what processes that were killed have left half written."""
        for rest in self.path.rglob("*.partial"):
            rest.unlink(missing_ok=True)

    def done(self) -> set[int]:
        """Return the numbers of the parts that are done."""
        chunks = [self.path / name / "c" for name in ChunkOfMap._fields]
        deep = [("0",) * (values.ndim - 1) for values in self._arrays.values()]  # the folders below the first number
        return {
            number
            for number in range(len(self.description.parts))
            if all(c.joinpath(str(number), *rest).is_file() for c, rest in zip(chunks, deep, strict=True))
        }

    def write(self, part: slice, found: ChunkOfMap) -> None:
        """Write what is known of a part.

        Raises:
            InputError: it cannot be written, as on a full disk; what was written before stays.
        """
        write_part(self.path, self._arrays, part, found)

    def read(self) -> ChunkOfMap:
        """Return what is known of all positions.

        Raises:
            InputError: a chunk is damaged.
        """
        with readable(self.path), whole_parts(self.path, self._arrays, self.description.parts):
            return ChunkOfMap(*(np.asarray(self._arrays[name][:]) for name in ChunkOfMap._fields))


def arrays_of(folder: Path) -> dict[str, Any]:
    """Return the arrays of a folder that the chunks of a map are written to."""
    root = _opened(folder)
    return {name: root[name] for name in ChunkOfMap._fields}


def token_of(folder: Path) -> str:
    """Return a digest of what a folder says of its map."""
    return hashlib.sha256((folder / "zarr.json").read_bytes()).hexdigest()


def write_part(folder: Path, arrays: dict[str, Any], part: slice, found: ChunkOfMap) -> None:
    """Write what is known of a part of the positions to the arrays of a folder.

    Raises:
        InputError: it cannot be written, as on a full disk; what was written before stays.
    """
    try:
        for name, values in zip(ChunkOfMap._fields, found.arrays, strict=True):
            arrays[name][part] = values
    except OSError as error:
        raise InputError(
            f"the checkpoint {str(folder)!r} cannot be written: {error.strerror or error}; what was written before is "
            f"kept, and the same call goes on from there"
        ) from error


def map_folder(path: str | Path, identity: Identity, description: Description) -> MapFolder:
    """Return the folder of a map: a new one, or one that was begun by the same question.

    Raises:
        MissingExtraError: Zarr is not installed.
        InputError: it is of another question, is damaged, or cannot be made.
    """
    _zarr()
    folder = Path(os.path.realpath(_path(path)))
    if not os.path.lexists(folder):
        _make(folder, identity, description)
    kept = _attributes(folder)
    refuse_another(path, kept.get("question"), identity)
    made = MapFolder(folder, description)
    made.tidy()
    return made


def read_map(path: str | Path) -> ReachabilityMap:
    """Return a map from the folder that `reachability_map(..., checkpoint=path)` or `save_map` has written.

    Raises:
        MissingExtraError: Zarr is not installed.
        InputError: there is none, it is not finished, or it is damaged.
    """
    _zarr()
    folder = _path(path)
    if not folder.is_dir():
        raise InputError(f"there is no folder {str(path)!r} with a map")
    kept = _attributes(folder)
    with readable(folder):
        root = _opened(folder)
        positions, orientations = (np.asarray(root[name][:]) for name in ("positions", "orientations"))
        names = (kept["robot"], tuple(kept["joint_names"]), tuple(kept["task"]), kept["coordinates"])
        grid = None if kept["grid"] is None else tuple(np.array(axis) for axis in kept["grid"])
        description = Description(*names, positions, orientations, grid, kept["counts"])
    made = MapFolder(folder, description)
    left = len(made.left())
    if left:
        raise InputError(
            f"the map in {str(path)!r} is not finished, {left} of {len(description.parts)} parts are missing; the "
            f"call of reachability_map that began it goes on from there"
        )
    return description.finished(made.read())


def save_map(known: ReachabilityMap, path: str | Path) -> Path:
    """Write a map to a new folder of Zarr arrays, and return its path.

    Raises:
        MissingExtraError: Zarr is not installed.
        InputError: it is no map, something has that name already, or it cannot be written.
    """
    if not isinstance(known, ReachabilityMap):
        raise InputError(f"a map is what reachability_map returns, not {known!r}")
    _zarr()
    folder = _path(path)
    if os.path.lexists(folder):
        raise InputError(f"{str(path)!r} exists already; name a new folder")
    solutions = np.zeros_like(known.status) if known.solutions is None else known.solutions
    found = ChunkOfMap(known.status, solutions, known.manipulability, known.limit_margin, known.q, known.orientation)
    names = (known.robot, known.joint_names, known.task, known.coordinates)
    description = Description(*names, known.positions, known.orientations, known.grid, known.solutions is not None)
    _make(folder, {"what": "a map that was saved"}, description, found)
    return folder


def _make(folder: Path, identity: Identity, description: Description, found: ChunkOfMap | None = None) -> None:
    """Make the folder, which takes its name when it is complete: without any part, or with all of them."""
    if not folder.parent.is_dir():
        raise InputError(f"there is no folder {folder.parent}, so {folder.name} cannot be made there")
    unfinished = folder.with_name(f".{folder.name}.{secrets.token_hex(8)}.part")
    try:
        _write_description(
            unfinished, identity, description, len(description.joint_names) if found is None else found.q.shape[1]
        )
        if found is not None:
            begun = MapFolder(unfinished, description)
            for part in description.parts:
                begun.write(part, found.part(part))
        unfinished.rename(folder)
    except OSError as error:
        raise InputError(f"the folder {str(folder)!r} cannot be made: {error.strerror or error}") from error
    finally:
        shutil.rmtree(unfinished, ignore_errors=True)


def _write_description(folder: Path, identity: Identity, description: Description, nq: int) -> None:
    zarr = _zarr()
    root = zarr.open_group(str(folder), mode="w-", zarr_format=3)
    names = ("robot", "joint_names", "task", "coordinates", "grid", "counts")
    kept = {name: _plain(getattr(description, name)) for name in names}
    root.attrs[NAME] = {"format": FORMAT, "question": identity} | kept
    for name in ("positions", "orientations"):
        given = getattr(description, name)
        root.create_array(name, data=given, compressors=_codecs(), chunks=given.shape)
    size = positions_in_a_chunk(len(description.positions), len(description.orientations))
    for name, values in zip(ChunkOfMap._fields, empty_chunk(1, len(description.orientations), nq).arrays, strict=True):
        root.create_array(
            name,
            shape=(len(description.positions), *values.shape[1:]),
            chunks=(min(size, len(description.positions)), *(max(1, n) for n in values.shape[1:])),
            dtype=values.dtype,
            compressors=_codecs(),
            fill_value=NOT_DONE[name],
        )


def _codecs() -> list[Any]:
    from zarr.codecs import Crc32cCodec, ZstdCodec

    return [ZstdCodec(level=3), Crc32cCodec()]


def _plain(value: Any) -> Any:
    if isinstance(value, tuple):
        return [_plain(entry) for entry in value]
    return value.tolist() if isinstance(value, np.ndarray) else value


def _opened(folder: Path) -> Any:
    return _zarr().open_group(str(folder), mode="r+", zarr_format=3)


def _attributes(folder: Path) -> dict[str, Any]:
    """Return what a folder says of its map."""
    with readable(folder):
        kept: Any = _opened(folder).attrs[NAME]
        if kept["format"] != FORMAT:
            raise ValueError(f"it has format {kept['format']}")
        return dict(kept)


def _zarr() -> Any:
    try:
        import zarr
    except ImportError as error:
        raise MissingExtraError("zarr", "zarr") from error
    return zarr


def _path(path: str | Path) -> Path:
    try:
        return Path(path)
    except TypeError as error:
        raise InputError(f"a checkpoint is the path of a folder, such as 'reach.zarr', not {path!r}") from error


def chunk_kept(
    packed: bytes, coordinates: str, orientations: Array, folder: str, token: str, place: tuple[int, Array]
) -> ChunkOfMap | None:
    """Write what is known of some positions to the folder of the map, or return it if the folder is not seen here.

    Raises:
        InputError: the folder cannot be written to, as on a full disk.
    """
    found = chunk_of_map(packed, coordinates, orientations, place)
    arrays = _arrays_seen(folder, token)
    if arrays is None:
        return found
    start, positions = place
    write_part(Path(folder), arrays, slice(start, start + len(positions)), found)
    return None


@lru_cache(maxsize=4)
def _arrays_seen(folder: str, token: str) -> dict[str, Any] | None:
    """Return the arrays of a folder; None if there is none of this name here, or another one."""
    try:
        return arrays_of(Path(folder)) if token_of(Path(folder)) == token else None
    except (OSError, ImportError, InputError):
        return None
