"""Where packages are: in the folders that a caller names, and around the robot's file."""

import re
from collections.abc import Iterable, Iterator
from itertools import chain
from pathlib import Path

MANIFEST = "package.xml"
NAME = re.compile(r"[A-Za-z][\w-]*")
LONGEST = 100_000  # characters of a package.xml, in which its name stands near the beginning
DEEPEST = 3  # folders below a given one, in which a package is
NEAR = 3  # folders above the file, in which a package may lack its package.xml


def find_package(package: str, path: Path, packages: Iterable[Path], holding: str = "") -> Path | None:
    """Return the folder of a package that holds a file or folder, or None.

    A package is in one of the given folders, or is that folder; else it is a folder above the robot's file, or lies
    beside one. It has the package's name as its own, or in its package.xml. Around the file it must have a
    package.xml, unless it is near and not in a home or a system's folder: whoever wrote the file chose the name.
    """
    if not NAME.fullmatch(package):
        return None
    given = [folder.resolve() for folder in packages]
    for folder in given:
        for candidate in chain((folder / package, folder), _inside(folder)):
            if _is_it(candidate, package) and (candidate / holding).exists():
                return candidate
    for height, folder in enumerate(path.resolve().parents):
        for candidate in (folder / package, folder):
            near = height < NEAR and not _is_private(folder)
            if (
                (near or (candidate / MANIFEST).is_file())
                and _is_it(candidate, package)
                and (candidate / holding).exists()
            ):
                return candidate
    return None


def own_package(path: Path) -> Path | None:
    """Return the folder of the package in which a file is, or None: the nearest one above it with a package.xml."""
    for folder in path.resolve().parents:
        if (folder / MANIFEST).is_file() and not _is_private(folder):
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


def _is_private(folder: Path) -> bool:
    """Return whether a folder is the home folder, or holds it, or is the root of the file system."""
    return Path("~").expanduser().is_relative_to(folder) or folder == folder.parent
