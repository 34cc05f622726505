"""Where packages are: in the folders that a caller names, and around the robot's file."""

import re
from collections.abc import Iterable, Iterator
from itertools import chain
from pathlib import Path

PACKAGE = "package://"
MANIFEST = "package.xml"
NAME = re.compile(r"[A-Za-z][\w-]*")
LONGEST = 100_000  # characters of a package.xml, in which its name stands near the beginning
DEEPEST = 3  # folders below a given one, in which a package is
NEAR = 3  # folders above the file, in which a package may lack its package.xml


class Packages:
    """The packages that a robot's file may name.

    Args:
        path: the robot's file.
        folders: the folders that the caller gives.
    """

    def __init__(self, path: Path, folders: Iterable[Path]):
        self.path = path
        self.folders = [absolute(folder) for folder in folders]
        self._inside: dict[Path, list[Path]] = {}

    def find(self, package: str, holding: str = "") -> Path | None:
        """Return the folder of a package that holds a file or folder, or None.

        A package is in one of the given folders, or is that folder; else it is a folder above the robot's file, or
        lies beside one. It has the package's name as its own, or in its package.xml. Around the file it must have a
        package.xml, unless it is near and not in a home or a system's folder: whoever wrote the file chose the name.
        """
        if not NAME.fullmatch(package):
            return None
        candidates = chain(self._given(package), self._around(package))
        return next((c for c in candidates if _is_it(c, package) and exists(c / holding)), None)

    def _given(self, package: str) -> Iterator[Path]:
        for folder in self.folders:
            yield from (folder / package, folder)
            if folder not in self._inside:
                self._inside[folder] = list(_inside(folder))
            yield from self._inside[folder]

    def _around(self, package: str) -> Iterator[Path]:
        for height, folder in enumerate(absolute(self.path).parents):
            near = height < NEAR and not _is_private(folder)
            yield from (c for c in (folder / package, folder) if near or exists(c / MANIFEST))


def own_package(path: Path) -> Path | None:
    """Return the folder of the package in which a file is, or None: the nearest one above it with a package.xml."""
    for folder in absolute(path).parents:
        if exists(folder / MANIFEST) and not _is_private(folder):
            return folder
    return None


def _inside(folder: Path) -> Iterator[Path]:
    """Return the packages in a folder of packages, also in repositories that hold several."""
    for depth in range(1, DEEPEST + 1):
        for manifest in sorted(folder.glob("*/" * depth + MANIFEST)):
            yield manifest.parent


def _is_it(folder: Path, package: str) -> bool:
    return folder.is_dir() and package in (folder.name, _name(folder))


def _name(folder: Path) -> str | None:
    """Return the name in a package.xml, or None."""
    try:
        with (folder / MANIFEST).open(encoding="utf-8", errors="replace") as file:
            found = re.search(r"<name>\s*([\w-]+)\s*</name>", file.read(LONGEST))
    except OSError:
        return None
    return found and found[1]


def absolute(path: Path) -> Path:
    """Return a path with all links followed, where they do not go in a circle."""
    try:
        return path.resolve()
    except (OSError, RuntimeError, ValueError):
        return path.absolute()


def exists(path: Path, *, as_file: bool = False) -> bool:
    """Return whether there is such a file or folder; a name that is too long, or hidden from us, is none."""
    try:
        return path.is_file() if as_file else path.exists()
    except (OSError, ValueError):
        return False


def _is_private(folder: Path) -> bool:
    """Return whether a folder is the home folder, or holds it, or is the root of the file system."""
    return Path("~").expanduser().is_relative_to(folder) or folder == folder.parent
