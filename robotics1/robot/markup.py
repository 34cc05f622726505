"""XML with the line of each element, and nothing that XML can do beyond that."""

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import cast
from xml.parsers import expat

from robotics1.errors import RobotFileError

LARGEST_FILE = 20_000_000  # characters
DEEPEST = 100  # elements inside each other: writing them out again recurses


class Element(ET.Element):
    """An element that knows the line it starts on."""

    line: int = 0

    @property
    def label(self) -> str:
        """How messages call it: joint 'q1', or <limit>."""
        name = self.get("name")
        return f"{self.tag} {name!r}" if name else f"<{self.tag}>"


def parse_xml(text: str, path: Path) -> Element:
    """Return the root element of an XML text.

    No DOCTYPE is taken, so no entity is expanded and nothing is read from elsewhere. Prefixes stay in the tags.

    Raises:
        RobotFileError: it is not well-formed, has a DOCTYPE, or is too large or too deep.
    """
    if len(text) > LARGEST_FILE:
        raise RobotFileError(f"it has {len(text)} characters; at most {LARGEST_FILE} are read", path=path)
    builder = ET.TreeBuilder(element_factory=Element)
    parser = expat.ParserCreate("utf-8")  # whatever the file declares, this is what it is now

    def start(tag: str, attributes: dict[str, str]) -> None:
        element = cast("Element", builder.start(tag, attributes))
        element.line = parser.CurrentLineNumber

    def doctype(*_: object) -> None:
        raise RobotFileError("it has a DOCTYPE, which no robot needs", path=path, line=parser.CurrentLineNumber)

    parser.StartElementHandler = start
    parser.EndElementHandler = builder.end
    parser.CharacterDataHandler = builder.data
    parser.StartDoctypeDeclHandler = doctype
    try:
        parser.Parse(text.lstrip("\ufeff").encode("utf-8", errors="replace"), True)
    except expat.ExpatError as error:
        message = f"it is not well-formed XML: {expat.errors.messages[error.code]}"
        raise RobotFileError(message, path=path, line=error.lineno) from error
    root = cast("Element", builder.close())
    _check_depth(root, path)
    return root


def _check_depth(root: Element, path: Path) -> None:
    level = [root]
    for _ in range(DEEPEST):
        level = [cast("Element", child) for element in level for child in element]
    if level:
        raise RobotFileError(f"its elements are nested more than {DEEPEST} deep", path=path, line=level[0].line)
