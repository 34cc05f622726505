"""Where the meshes of a robot are, and which of them a file may name.

A name is relative to the robot's file, or `package://pkg/...`. What it leads to, links followed, must lie in

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
from collections.abc import Iterable
from pathlib import Path
from urllib.parse import unquote

PACKAGE, FILE = "package://", "file://"
SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+:(?!\\)")  # of two letters or more: C: is a drive
MANIFEST = "package.xml"
PARTS_OF_A_PACKAGE = ("urdf", "xacro", "robot", "robots", "model", "models", "description", "descriptions")
MESH_FOLDERS = ("meshes", "mesh")


def find_meshes(root: ET.Element, path: Path, packages: Iterable[Path], *, trusted: bool = False) -> list[str]:
    """Write the place of every mesh into the tree, leave out those that cannot be drawn, and return why, in sentences.

    `trusted` allows every file of this computer.
    """
    folders = list(packages)
    places: dict[str, Path | str] = {}
    for link in root.findall("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            for mesh in shape.iter("mesh"):
                name = mesh.get("filename", "")
                if name not in places:
                    places[name] = _place(name, path, folders, trusted=trusted)
                if isinstance(places[name], str):
                    link.remove(shape)
                    break
                mesh.set("filename", str(places[name]))
    return [place for place in places.values() if isinstance(place, str)]


def find_file(name: str, path: Path, packages: Iterable[Path], *, trusted: bool = False) -> Path | None:
    """Return the file of a name such as a mesh has, or None where there is none or it may not be named.

    `package://pkg/rest` is looked for in the given folders and in those above the robot's file, where a folder is
    the package itself or holds it; any other name is relative to the robot's file.
    """
    place = _place(name, path, list(packages), trusted=trusted)
    return place if isinstance(place, Path) else None


def find_package(package: str, path: Path, packages: Iterable[Path], holding: str = "") -> Path | None:
    """Return the folder of a package that holds a file or folder, or None.

    The root of the file system, what lies directly in it, and the user's home are no packages, and hold none.
    """
    if package in ("", ".", "..") or Path(package).name != package:
        return None
    given = list(packages)
    for folder in [*given, *(folder for folder in _absolute(path).parents if not _is_everything(folder))]:
        for candidate in (folder / package, folder):
            if candidate.name == package and _exists(candidate / holding):
                return candidate
    return None


def _place(name: str, path: Path, packages: list[Path], *, trusted: bool) -> Path | str:
    """Return the file of a name, or the sentence that says why there is none."""
    allowed = [] if trusted else _allowed_folders(path, packages)
    if name.startswith(PACKAGE):
        package, _, rest = name.removeprefix(PACKAGE).partition("/")
        folder = find_package(package, path, packages, holding=rest)
        file = None if folder is None else folder / rest
        allowed += [] if folder is None else [_absolute(folder)]
    elif SCHEME.match(name) and not name.startswith(FILE):
        return f"mesh {name!r} was left out: only files, and {PACKAGE} of this computer, are read"
    else:
        file = path.parent / (unquote(name.removeprefix(FILE)) if name.startswith(FILE) else name)
    if file is None or not _exists(file, as_file=True):
        return f"mesh {name!r} was not found"
    file = _absolute(file)
    if not (trusted or any(map(file.is_relative_to, allowed)) or _in_known_package(file, path, packages)):
        return (
            f"mesh {name!r} was left out: it lies outside the folder of the robot's file and its package; "
            f"give its folder as packages=[...], or load the file with trusted=True"
        )
    return file


def _allowed_folders(path: Path, packages: list[Path]) -> list[Path]:
    """Return the folders in which a file may name others; where it is a link, also those of what it leads to."""
    folders = [_absolute(package) for package in packages]
    for file in {path.absolute(), _absolute(path)}:
        own, above = _absolute(file.parent), list(_absolute(file.parent).parents)
        folders.append(own)
        manifest = next((folder for folder in (own, *above) if _exists(folder / MANIFEST)), None)
        if manifest is not None:
            folders.append(manifest)
        elif own.name in PARTS_OF_A_PACKAGE:
            folders.append(own.parent)
        folders += [folder / name for folder in above[:2] for name in MESH_FOLDERS]
    return [folder for folder in folders if not _is_everything(folder) or folder in (path.absolute().parent, *packages)]


def _in_known_package(file: Path, path: Path, packages: list[Path]) -> bool:
    """Whether a file lies in a package that `package://` finds, as the paths do that xacro makes of $(find pkg)."""
    manifest = next((folder for folder in file.parents if _exists(folder / MANIFEST)), None)
    found = None if manifest is None else find_package(manifest.name, path, packages)
    return found is not None and _absolute(found) == manifest


def _is_everything(folder: Path) -> bool:
    """Whether a folder holds more than a package: the root, what lies directly in it, the user's home."""
    return len(folder.parts) <= 2 or Path("~").expanduser().is_relative_to(folder)


def _absolute(path: Path) -> Path:
    try:
        return path.resolve()
    except (OSError, RuntimeError, ValueError):  # RuntimeError: links in a circle
        return path.absolute()


def _exists(path: Path, *, as_file: bool = False) -> bool:
    try:
        return path.is_file() if as_file else path.exists()
    except (OSError, ValueError):  # a name that is too long, or a folder that may not be read
        return False
