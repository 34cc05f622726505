"""What an MJCF file means, as MuJoCo reads it: included files, units, default classes, and places of its elements."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pinocchio as pin

from robotics1.errors import RobotFileError
from robotics1.inputs import Array
from robotics1.robot.findings import LARGEST
from robotics1.robot.markup import Element, children, decoded, parse_xml

ZERO = 1e-14  # length of a vector that has no direction for MuJoCo
MAIN = "main"  # the class of defaults that holds where no other is named
UNREAD = ("attach", "replicate", "composite", "flexcomp")  # they make bodies that do not stand in the file


def with_included(root: Element, path: Path) -> Element:
    """Return the root of a file with the contents of the files that it includes in their places.

    Their names are relative to the folder of `path`; as in MuJoCo, a file is included once.

    Raises:
        RobotFileError: such a file cannot be read, or is included twice.
    """
    seen: set[Path] = set()

    def expand(parent: Element) -> None:
        whole: list[Element] = []
        for part in _parts(parent):
            if part.tag != "include":
                expand(part)
                whole.append(part)
                continue
            file = path.parent / part.get("file", "")
            if file.resolve() in seen:
                raise RobotFileError(f"it includes {file.name!r} twice", path=path, line=part.line)
            seen.add(file.resolve())
            if not file.is_file():
                raise RobotFileError(f"it includes {file.name!r}, and there is no such file", path=path, line=part.line)
            try:
                text = decoded(file.read_bytes(), file)
            except OSError as error:
                message = f"the file {file.name!r}, which it includes, cannot be read: {error.strerror}"
                raise RobotFileError(message, path=path, line=part.line) from error
            included = parse_xml(text, file)
            expand(included)
            whole += _parts(included)
        parent[:] = whole

    expand(root)
    return root


def _parts(element: Element) -> list[Element]:
    return [part for part in element if isinstance(part, Element)]


@dataclass
class Meaning:
    """How the attributes of a file are read.

    Attributes:
        path: the file, for messages.
        root: its root, with the files that it includes.
        degrees: whether its angles are in degrees.
        sequence: the axes of Euler angles; small letters turn with the body, capital ones stay.
        autolimits: whether a range alone limits a joint.
        classes: class → tag → the attributes that hold by default.
    """

    path: Path
    root: Element
    degrees: bool = True
    sequence: str = "xyz"
    autolimits: bool = True
    classes: dict[str, dict[str, dict[str, str]]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Read the settings and the default classes."""
        for compiler in self.root.findall("compiler"):
            self.degrees = compiler.get("angle", "degree" if self.degrees else "radian") != "radian"
            self.sequence = compiler.get("eulerseq", self.sequence)
            self.autolimits = compiler.get("autolimits", "true" if self.autolimits else "false") != "false"
        self.classes[MAIN] = {}
        for default in children(self.root, "default"):
            self._add_class(default, MAIN, {})

    def _add_class(self, default: Element, name: str, above: dict[str, dict[str, str]]) -> None:
        """Add a class, which has what the class above it has, and those inside it."""
        here = self.classes.setdefault(name, {tag: dict(values) for tag, values in above.items()})
        parts = _parts(default)
        for part in parts:
            if part.tag != "default":
                here.setdefault(part.tag, {}).update(part.attrib)
        for part in parts:
            if part.tag == "default":
                self._add_class(part, part.get("class", MAIN), here)

    def attributes(self, element: Element, childclass: str) -> dict[str, str]:
        """Return the attributes of an element, with the defaults of its class."""
        name = element.get("class", childclass)
        if name not in self.classes:
            raise self.error(element, f"there is no default class {name!r}")
        return self.classes[name].get(element.tag, {}) | dict(element.attrib)

    def parts(self, body: Element, T: pin.SE3, childclass: str) -> Iterator[tuple[Element, pin.SE3, str]]:
        """Yield the parts of a body, each with the place and the class that the <frame> around it gives."""
        for part in _parts(body):
            if part.tag in UNREAD:
                raise self.error(part, "makes bodies that are not in the file; write them out, as MuJoCo saves a model")
            if part.tag == "frame":
                place = T * self.place(part, dict(part.attrib))
                yield from self.parts(part, place, part.get("childclass", childclass))
            else:
                yield part, T, childclass

    def place(self, element: Element, attributes: Mapping[str, str]) -> pin.SE3:
        """Return the place of an element in the body around it, by its `pos` and one of five forms of orientation."""
        return pin.SE3(self._rotation(element, attributes), self.numbers(element, attributes, "pos", 3, "0 0 0"))

    def _rotation(self, element: Element, attributes: Mapping[str, str]) -> Array:
        if "quat" in attributes:
            w, x, y, z = self._unit(element, attributes, "quat", 4)
            return np.asarray(pin.Quaternion(w, x, y, z).toRotationMatrix())
        if "axisangle" in attributes:
            x, y, z, angle = self.numbers(element, attributes, "axisangle", 4)
            return np.asarray(pin.exp3(self.angle(angle) * self._direction(element, "axisangle", np.array([x, y, z]))))
        if "euler" in attributes:
            R = np.eye(3)
            for letter, angle in zip(self.sequence, self.numbers(element, attributes, "euler", 3), strict=True):
                turn = pin.exp3(self.angle(angle) * np.eye(3)["xyz".index(letter.lower())])
                R = R @ turn if letter.islower() else turn @ R
            return R
        if "xyaxes" in attributes:
            first, second = np.split(self.numbers(element, attributes, "xyaxes", 6), 2)
            x = self._direction(element, "xyaxes", first)
            y = self._direction(element, "xyaxes", second - (x @ second) * x)
            return np.column_stack([x, y, np.cross(x, y)])
        if "zaxis" in attributes:
            z = self._unit(element, attributes, "zaxis", 3)
            both = pin.Quaternion.FromTwoVectors(np.array([0.0, 0.0, 1.0]), z)
            return np.asarray(both.toRotationMatrix())
        return np.eye(3)

    def angle(self, value: float) -> float:
        """Return an angle in radians."""
        return math.radians(value) if self.degrees else value

    def numbers(
        self, element: Element, attributes: Mapping[str, str], key: str, count: int, default: str = ""
    ) -> Array:
        """Return the numbers of an attribute.

        Raises:
            RobotFileError: they are not so many finite numbers of a size that can be computed with.
        """
        text = attributes.get(key, default)
        try:
            values = np.array([float(word) for word in text.split()])
        except ValueError:
            values = np.array([])
        if len(values) != count or not np.all(np.abs(values) <= LARGEST):
            raise self.error(element, f"must have {count} finite numbers as {key!r}, not {text!r}")
        return values

    def _unit(self, element: Element, attributes: Mapping[str, str], key: str, count: int) -> Array:
        return self._direction(element, key, self.numbers(element, attributes, key, count))

    def _direction(self, element: Element, key: str, v: Array) -> Array:
        length = float(np.linalg.norm(v))
        if not length > ZERO:
            raise self.error(element, f"has a {key!r} of length 0, which gives no direction")
        return v / length

    def axis(self, element: Element, attributes: Mapping[str, str]) -> Array:
        """Return the axis of a joint, a unit vector; z where the file gives none."""
        return self._unit(element, {"axis": "0 0 1"} | dict(attributes), "axis", 3)

    def error(self, element: Element, message: str) -> RobotFileError:
        """Return the error of an element, with its line."""
        name = element.get("name")
        return RobotFileError(f"{element.label} {message}", path=self.path, line=element.line, element=name)
