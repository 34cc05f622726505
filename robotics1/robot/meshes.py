"""Where the meshes of a robot are: relative to its file, or in a package."""

import xml.etree.ElementTree as ET
from collections.abc import Iterable
from pathlib import Path

PACKAGE = "package://"


def find_meshes(root: ET.Element, path: Path, packages: Iterable[Path]) -> list[str]:
    """Write the place of every mesh into the tree, leave out those that are missing, and return their names."""
    missing = []
    folders = list(packages)
    for link in root.findall("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            for mesh in shape.iter("mesh"):
                found = find_file(mesh.get("filename", ""), path, folders)
                if found is None:
                    missing.append(mesh.get("filename", ""))
                    link.remove(shape)
                else:
                    mesh.set("filename", str(found))
    return list(dict.fromkeys(missing))


def find_file(name: str, path: Path, packages: Iterable[Path]) -> Path | None:
    """Return the file of a name such as a mesh has, or None.

    `package://pkg/rest` is looked for in the given folders and in those above the robot's file, where a folder is
    the package itself or holds it; any other name is relative to the robot's file.
    """
    if not name.startswith(PACKAGE):
        file = path.parent / name.removeprefix("file://")
        return file.resolve() if file.is_file() else None
    package, _, rest = name.removeprefix(PACKAGE).partition("/")
    folder = find_package(package, path, packages, holding=rest)
    return None if folder is None else (folder / rest).resolve()


def find_package(package: str, path: Path, packages: Iterable[Path], holding: str = "") -> Path | None:
    """Return the folder of a package that holds a file or folder, or None."""
    for folder in [*packages, *path.resolve().parents]:
        for candidate in (folder / package, folder):
            if candidate.name == package and (candidate / holding).exists():
                return candidate
    return None
