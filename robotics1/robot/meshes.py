"""Where the meshes and packages of a robot are, and which files its own file may name.

Packages are in the folders that a caller names, and around the robot's file.

A mesh is named by a path from the robot's file, or by `package://pkg/...`. What it leads to, links followed, must
lie in

    - the folder of the robot's file, or its package: the folder above it that holds a `package.xml`, or, where there
      is none, the folder above one that is called `urdf`, `xacro`, `robots` or the like;
    - a folder `meshes` beside the file's folder, or one higher;
    - a folder given as `packages`, or the package that is named, as `package://` or by a path into a folder that has
      a `package.xml` and would be found by its name.

So a file from elsewhere does not make the viewer read, and publish, what lies beside it on this computer. Nothing is
ever fetched from a network.
"""

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator
from itertools import chain
from pathlib import Path
from urllib.parse import unquote

PACKAGE = "package://"
MANIFEST = "package.xml"
NAME = re.compile(r"[A-Za-z][\w-]*")
LONGEST = 100_000  # characters of a package.xml, in which its name stands near the beginning
DEEPEST = 3  # folders below a given one, in which a package is
NEAR = 3  # folders above the file, in which a package may lack its package.xml
FILE = "file://"
SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+:(?!\\)")  # of two letters or more: C: is a drive
PARTS_OF_A_PACKAGE = ("urdf", "xacro", "robot", "robots", "model", "models", "description", "descriptions")
MESH_FOLDERS = ("meshes", "mesh")
UNDRAWN = "undrawn"


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
        named = (c for c in candidates if c.is_dir() and package in (c.name, _name(c)))
        return next((c for c in named if exists(c / holding)), None)

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


def find_meshes(root: ET.Element, path: Path, packages: Iterable[Path], *, trusted: bool = False) -> list[str]:
    """Write the place of every mesh into the tree, leave out those that cannot be drawn, and return why, in sentences.

    A <visual> that is left out becomes <undrawn>, which no reader of URDF takes for a shape. `trusted` allows every
    file of this computer.
    """
    known = Packages(path, packages)
    places: dict[str, Path | str] = {}
    for link in root.findall("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            for mesh in shape.iter("mesh"):
                name = mesh.get("filename", "")
                if name not in places:
                    places[name] = _place(name, known, trusted=trusted)
                if isinstance(places[name], str):
                    if shape.tag == "visual":
                        shape.tag = UNDRAWN
                    else:
                        link.remove(shape)
                    break
                mesh.set("filename", str(places[name]))
    return [place for place in places.values() if isinstance(place, str)]


def _place(name: str, known: Packages, *, trusted: bool) -> Path | str:
    """Return the file of a name, or the sentence that says why there is none.

    `package://pkg/rest` is looked for in the packages; any other name is relative to the robot's file.
    """
    allowed = [] if trusted else _allowed_folders(known)
    if name.startswith(PACKAGE):
        package, _, rest = name.removeprefix(PACKAGE).partition("/")
        folder = known.find(package, holding=rest)
        file = None if folder is None else folder / rest
        allowed += [] if folder is None else [absolute(folder)]
    elif SCHEME.match(name) and not name.startswith(FILE):
        return f"mesh {name!r} was left out: only files, and {PACKAGE} of this computer, are read"
    else:
        file = known.path.parent / (unquote(name.removeprefix(FILE)) if name.startswith(FILE) else name)
    if file is None or not exists(file, as_file=True):
        return f"mesh {name!r} was not found"
    file = absolute(file)
    if not (trusted or any(map(file.is_relative_to, allowed)) or _in_known_package(file, known)):
        return (
            f"mesh {name!r} was left out: it lies outside the folder of the robot's file and its package; "
            f"give its folder as packages=[...], or load the file with trusted=True"
        )
    return file


def _allowed_folders(known: Packages) -> list[Path]:
    """Return the folders in which a file may name others; where it is a link, also those of what it leads to."""
    path, folders = known.path, [*known.folders]
    for file in {path.absolute(), absolute(path)}:
        own, above = absolute(file.parent), list(absolute(file.parent).parents)
        folders.append(own)
        manifest = next((folder for folder in (own, *above) if exists(folder / MANIFEST)), None)
        if manifest is not None:
            folders.append(manifest)
        elif own.name in PARTS_OF_A_PACKAGE:
            folders.append(own.parent)
        folders += [folder / name for folder in above[:2] for name in MESH_FOLDERS]
    return [
        folder for folder in folders if not _is_everything(folder) or folder in (path.absolute().parent, *known.folders)
    ]


def _in_known_package(file: Path, known: Packages) -> bool:
    """Whether a file lies in a package that `package://` finds, as the paths do that xacro makes of $(find pkg)."""
    manifest = next((folder for folder in file.parents if exists(folder / MANIFEST)), None)
    found = None if manifest is None else known.find(manifest.name)
    return found is not None and absolute(found) == manifest


def _is_everything(folder: Path) -> bool:
    """Whether a folder holds more than a package: the root, what lies directly in it, the user's home."""
    return len(folder.parts) <= 2 or Path("~").expanduser().is_relative_to(folder)


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
