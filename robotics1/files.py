"""The one way in which this package writes a file: whole or not at all."""

import os
import secrets
import stat
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from robotics1.errors import InputError, shown


def check_suffix(what: str, file: str | Path, suffixes: Iterable[str]) -> None:
    """Refuse a file whose suffix is another than these; none at all is right.

    Raises:
        InputError: the message says which are right.
    """
    if Path(str(file)).suffix.lower() not in ("", *suffixes):
        raise InputError(f"{what} is written as {', '.join(suffixes)}; the file is {shown(str(file))}")


def write_file(path: str | Path, content: str | bytes) -> Path:
    """Write a file as a whole, text as UTF-8, and return its path.

    The content goes to a new file of a random name in the same folder, which then takes the place of the old one. So a
    reader sees the old file or the new one, of two writers the last one wins, and a full disk leaves the old file.
    An existing file keeps its mode and owner, and a symbolic link keeps pointing to it.

    Raises:
        InputError: the path is no name of a file, its folder does not exist, it names something other than a regular
            file, or the file cannot be written, as on a full disk.
    """
    path = _as_path(path)
    data = content.encode("utf-8", "backslashreplace") if isinstance(content, str) else content
    with _target(path) as target:
        _replace(target, data)
    return path


def check_file(path: str | Path) -> None:
    """Refuse a path to which no file can be written, before long work for it begins.

    Raises:
        InputError: as `write_file` has them.
    """
    with _target(_as_path(path)):
        pass


@contextmanager
def _target(path: Path) -> Iterator[Path]:
    """Give the file that a path leads to, if one fits there; what then fails is an InputError."""
    try:
        target = Path(os.path.realpath(path))  # where a link points to
        _refuse_unless_a_file_fits(path, target)
        yield target
    except InputError:
        raise
    except (OSError, ValueError) as error:  # ValueError: a name with a null character
        raise InputError(f"{str(path)!r} cannot be written: {getattr(error, 'strerror', None) or error}") from error


def _as_path(path: str | Path) -> Path:
    try:
        return Path(path)
    except TypeError as error:
        raise InputError(f"a file must be given as its path, such as 'arm.html', not {path!r}") from error


def _refuse_unless_a_file_fits(path: Path, target: Path) -> None:
    if not target.parent.is_dir():
        missing = target.parent if path.is_symlink() else path.parent
        raise InputError(f"there is no folder {missing}, so {path.name} cannot be written there")
    if target.is_dir():
        raise InputError(f"{path} cannot be written: it is a folder; name a file in it")
    if os.path.lexists(target):  # a link that is left here points in a circle
        if not target.is_file():
            raise InputError(f"{path} cannot be written: it is no regular file; name another one")
        if not os.access(target, os.W_OK):
            raise InputError(f"{path} cannot be written: its mode does not allow it; name another one")


def _replace(target: Path, data: bytes) -> None:
    """Put the data in the place of a file, through a new file beside it."""
    unfinished = target.with_name(f".{secrets.token_hex(8)}.part")
    try:
        with open(unfinished, "xb") as file:  # x: it is new, and no link that somebody put there
            file.write(data)
        if target.exists():
            _take_mode_and_owner(unfinished, target.stat())
        unfinished.replace(target)
    except BaseException:
        with suppress(OSError):
            unfinished.unlink(missing_ok=True)
        raise


def _take_mode_and_owner(file: Path, old: os.stat_result) -> None:
    if hasattr(os, "chown"):
        with suppress(PermissionError):  # only root may give a file away
            os.chown(file, old.st_uid, old.st_gid)
    file.chmod(stat.S_IMODE(old.st_mode))  # after chown, which may clear bits
