"""Chunks that the workers write themselves, if they see the folder of the map: so little goes through one client."""

from functools import lru_cache
from pathlib import Path
from typing import Any

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.workspaces.reachability.chunk import ChunkOfMap, chunk_of_map
from robotics1.workspaces.reachability.saved import arrays_of, token_of, write_part


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
