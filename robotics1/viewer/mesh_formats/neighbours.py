"""The files that a mesh file may name."""

import re
from pathlib import Path
from urllib.parse import unquote

from robotics1.errors import InputError
from robotics1.robot.meshes import absolute

LARGEST_FILE = 200_000_000  # bytes of a mesh, and of all files that it names together
SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")  # also C:
PICTURES = re.compile(r".*\.(mtl|png|jpe?g|bmp|tga|tiff?|webp|gif|dds)", re.IGNORECASE)


class Neighbours:
    """Where trimesh gets the files that a mesh names.

    These are materials and images in the folder of the mesh, below it, and, as `../textures/a.png`, in a folder
    beside it, and other files in the folder of the mesh or below it. So what lies elsewhere on this computer never
    becomes part of a page: a picture from elsewhere, such as a maker's `C:/textures`, is left out, and a mesh that
    wants its corners from elsewhere is refused.
    """

    def __init__(self, path: Path):
        self.path = path
        self._left = LARGEST_FILE
        self._read: dict[str, bytes] = {}
        self._refused = ""

    def own(self) -> bytes:
        """Return the mesh file itself.

        Raises:
            InputError: it cannot be read, or is too large.
        """
        try:
            return self._bytes(self.path)
        except (OSError, ValueError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            raise InputError(f"mesh {str(self.path)!r} cannot be read: {reason}") from error

    def get(self, name: str) -> bytes:
        """Return the bytes of a file that the mesh names.

        Raises:
            OSError: it is not there, or may not be read.
        """
        if name not in self._read:
            file = self._place(name)
            if file is None:
                if not PICTURES.fullmatch(name):
                    self._refused = self._refused or name
                raise OSError(f"{name!r} may not be read")
            self._read[name] = self._bytes(file)
        return self._read[name]

    __getitem__ = get

    def refuse(self) -> None:
        """Raise InputError if the mesh has named a file that it may not."""
        if self._refused:
            raise InputError(
                f"mesh {str(self.path)!r} names the file {self._refused!r}; only files of its own folder are read"
            )

    def _place(self, name: str) -> Path | None:
        """Return the file of a name, or None where it may not be read."""
        plain = unquote(name).replace("\\", "/")
        if SCHEME.match(plain) or plain.startswith("/"):
            return None
        folder = absolute(self.path).parent
        file = absolute(folder / plain)
        if file.is_relative_to(folder):
            return file
        beside = PICTURES.fullmatch(file.name) and file.parent != folder.parent and len(folder.parts) > 2
        return file if beside and file.is_relative_to(folder.parent) else None

    def _bytes(self, file: Path) -> bytes:
        if not file.is_file():
            raise OSError("it is no file")
        too_large = OSError(f"it has more than {LARGEST_FILE // 1_000_000} MB")
        if file.stat().st_size > self._left:
            raise too_large
        with file.open("rb") as opened:
            data = opened.read(self._left + 1)
        if len(data) > self._left:  # it has grown
            raise too_large
        self._left -= len(data)
        return data
