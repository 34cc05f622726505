"""What is wrong with the folder of a map, in words that say how nothing more is lost."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from robotics1.errors import InputError

SHOWN = 5  # files that a message names


@contextmanager
def readable(folder: Path) -> Iterator[None]:
    """Turn whatever is wrong with a folder into one kind of error: Zarr raises many."""
    try:
        yield
    except InputError:
        raise
    except Exception as error:
        raise InputError(
            f"{str(folder)!r} holds no map, or a damaged one ({type(error).__name__}: {error}); name another folder, "
            f"or delete it and begin anew"
        ) from error


@contextmanager
def whole_parts(folder: Path, arrays: Mapping[str, Any], parts: Sequence[slice]) -> Iterator[None]:
    """Turn an error while chunks are read into one that names the damaged ones, so that the others can be kept."""
    try:
        yield
    except Exception as error:
        damaged = _damaged(folder, arrays, parts)
        if not damaged:
            raise
        more = f" and {len(damaged) - SHOWN} more" if len(damaged) > SHOWN else ""
        raise InputError(
            f"{str(folder)!r} is damaged in {', '.join(damaged[:SHOWN])}{more}; delete these files, and the call of "
            f"reachability_map that made the map does their part again and keeps the rest"
        ) from error


def _damaged(folder: Path, arrays: Mapping[str, Any], parts: Sequence[slice]) -> list[str]:
    """Return the files of the chunks that cannot be read."""
    found = []
    for name, values in arrays.items():
        for number, part in enumerate(parts):
            try:
                values[part]
            except Exception:  # of the codecs: many kinds
                found.append("/".join([name, "c", str(number), *["0"] * (values.ndim - 1)]))
    return [name for name in found if (folder / name).is_file()]
