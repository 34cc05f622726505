"""The files that a xacro may read: those of its own folder, of its package, and of the given packages.

Of YAML it reads numbers, texts, lists and dictionaries, and the units that xacro knows.
"""

import math
import os
import re
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import yaml

from robotics1.caching import cached_property
from robotics1.robot.markup import LARGEST_FILE, decoded
from robotics1.robot.meshes import PACKAGE, Packages, own_package
from robotics1.robot.xacro.budget import Budget, Refused, too_large

SCHEME = re.compile(r"[A-Za-z][\w+.-]*:/")
WILD = re.compile(r"[*?\[]")
LONGEST_YAML = 100_000  # characters: PyYAML reads some 100 000 a second
UNITS = {
    "!radians": 1.0,
    "!degrees": math.pi / 180,
    "!meters": 1.0,
    "!millimeters": 0.001,
    "!foot": 0.3048,
    "!inches": 0.0254,
}


class Files:
    """The files of one expansion.

    Args:
        path: the robot's file.
        packages: the folders that the caller gives.
        trusted: whether any file may be read.
        budget: what the expansion may use.
    """

    def __init__(self, path: Path, packages: Iterable[Path], trusted: bool, budget: Budget):
        self._path = path
        self._packages = Packages(path, packages)
        self._trusted = trusted
        self._budget = budget
        self._found: dict[str, Path] = {}

    @cached_property
    def _folders(self) -> list[Path]:
        own = own_package(self._path)
        beside = (self._path.parent.resolve(), self._path.resolve().parent)  # of a link, and of what it leads to
        return [*beside, *([] if own is None else [own]), *self._packages.folders]

    def need_trust(self, what: str) -> None:
        """Raise if the file is not trusted.

        Raises:
            Refused: it is not.
        """
        if not self._trusted:
            raise Refused(f"it uses {what}, which reads this computer; load it with trusted=True if you trust it")

    def find(self, package: str) -> Path:
        """Return the folder of a package.

        Raises:
            Refused: it is in none of the folders.
        """
        if package not in self._found:
            folder = self._packages.find(package)
            if folder is None:
                raise Refused(
                    f"package {package!r} is in none of the folders given as packages, nor around the file; "
                    f"give the folder that holds it, as in packages=['ros/src']"
                )
            self._found[package] = folder
        return self._found[package]

    def named(self, name: str, beside: Path) -> list[Path]:
        """Return the files of a name, which stands in a file; of a pattern such as parts/*.xacro, all that fit.

        Raises:
            Refused: it is none that may be read.
        """
        file = self.place(name, beside)
        if not WILD.search(file.name) or file.exists():
            self._allowed(file, name)
            return [file]
        if WILD.search(name.removesuffix(file.name)) and not file.parent.is_dir():
            raise Refused(f"{name!r} has a * in the name of a folder, where no robot needs one")
        return sorted(self._allowed(found, name) for found in self._allowed(file.parent, name).glob(file.name))

    def text(self, file: Path, name: str) -> str:
        """Return the text of a file.

        Raises:
            Refused: it may not be read, or is too large, or not a regular file.
            FileNotFoundError: there is none.
        """
        file = self._allowed(file, name)
        self._budget.spend("files")
        if not file.exists():
            raise FileNotFoundError(f"No such file: {str(file)!r}")
        if not file.is_file():
            raise Refused(f"{name!r} is no file, but a folder or a device")
        self._budget.spend("characters", file.stat().st_size)
        return decoded(file.read_bytes(), file)[:LARGEST_FILE]

    def yaml_values(self, name: str, beside: Path, evaluate: Callable[[str], Any]) -> Any:
        """Return what a YAML file holds.

        Args:
            name: of the file.
            beside: the file in which the name stands.
            evaluate: gives the value of an expression, for the units of numbers such as `!degrees 90`.

        Raises:
            Refused: it may not be read, is not well-formed or too large, or holds more than numbers, texts, lists and
                dictionaries.
        """
        text = self.text(self.place(name, beside), name)
        if len(text) > LONGEST_YAML:
            raise too_large(f"{name!r} has {len(text)} characters")
        self._budget.spend("steps", len(text) // 2)
        loader = _Loader(text)
        loader.evaluate, loader.budget = evaluate, self._budget
        try:
            value = loader.get_single_data()
        except yaml.YAMLError as error:
            raise Refused(f"{name!r} is no YAML of plain values: {' '.join(str(error).split())}") from error
        self._budget.weigh(value)
        return value

    def place(self, name: str, beside: Path) -> Path:
        """Return where a name leads, whether or not there is a file, and whether or not it may be read."""
        if name.startswith(PACKAGE):
            package, _, rest = name.removeprefix(PACKAGE).partition("/")
            return self.find(package) / rest
        if SCHEME.match(name) and not (self._trusted and name.startswith("file://")):
            raise Refused(
                f"{name!r} begins with {name.partition(':')[0]}://; files are named by relative paths, "
                f"$(find ...) or package://"
            )
        return beside.parent / name.removeprefix("file://")

    def _allowed(self, file: Path, name: str) -> Path:
        """Return the file behind all links, if it is in a folder that may be read."""
        real = file.resolve()
        folders = [*self._folders, *self._found.values()]
        if self._trusted or any(real.is_relative_to(folder) for folder in folders):
            return real
        straight = Path(os.path.normpath(file.absolute()))
        if any(straight.is_relative_to(folder) for folder in folders):
            why = "is a symbolic link that leads out of"
        elif ".." in Path(name).parts:
            why = "leads by '..' out of"
        else:
            why = "is an absolute path out of" if Path(name).is_absolute() else "is out of"
        raise Refused(
            f"{name!r} {why} the file's own folder and the packages; give its folder in packages=[...], "
            f"or load the file with trusted=True if you trust it"
        )


class _Loader(yaml.SafeLoader):  # type: ignore[misc]
    """PyYAML's loader of plain values, with units, and with a limit for what aliases (*name) repeat."""

    evaluate: Callable[[str], Any]
    budget: Budget

    def unit(self, suffix: str, node: yaml.ScalarNode) -> float:
        """Return a number with a unit, in metres or radians."""
        return float(self.evaluate(self.construct_scalar(node))) * UNITS[f"!{suffix}"]

    def flatten_mapping(self, node: yaml.MappingNode) -> None:
        """Put merged mappings (<<: *name) in place; repeated ones grow tenfold from line to line."""
        super().flatten_mapping(node)
        self.budget.spend("steps", len(node.value))


for _unit in UNITS:
    _Loader.add_constructor(_unit, lambda loader, node, suffix=_unit[1:]: loader.unit(suffix, node))
_Loader.add_constructor("tag:yaml.org,2002:timestamp", yaml.SafeLoader.construct_yaml_str)  # no date is a length
