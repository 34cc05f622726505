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

from robotics1.robot.packages import MANIFEST, PACKAGE, Packages, absolute, exists

FILE = "file://"
SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+:(?!\\)")  # of two letters or more: C: is a drive
PARTS_OF_A_PACKAGE = ("urdf", "xacro", "robot", "robots", "model", "models", "description", "descriptions")
MESH_FOLDERS = ("meshes", "mesh")


def find_meshes(root: ET.Element, path: Path, packages: Iterable[Path], *, trusted: bool = False) -> list[str]:
    """Write the place of every mesh into the tree, leave out those that cannot be drawn, and return why, in sentences.

    `trusted` allows every file of this computer.
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
