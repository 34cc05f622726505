"""XML with the line of each element, and nothing that XML can do beyond that."""

import xml.etree.ElementTree as ET
from pathlib import Path
from typing import cast
from xml.parsers import expat

from robotics1.errors import RobotFileError

LARGEST_FILE = 20_000_000  # characters
DEEPEST = 100  # elements inside each other: writing them out again recurses
MOST_ELEMENTS = 200_000  # the largest robot of example-robot-data has 4000
MOST_ATTRIBUTES = 100  # of one element
LONGEST = 20_000  # characters of a name or a value


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
        RobotFileError: it is not well-formed, has a DOCTYPE, or exceeds a limit of size, which is counted while it
            is read.
    """
    if len(text) > LARGEST_FILE:
        raise RobotFileError(f"it has {len(text)} characters; at most {LARGEST_FILE} are read", path=path)
    parser = expat.ParserCreate("utf-8")  # whatever the file declares, this is what it is now
    reader = _Reader(parser, path)
    parser.StartElementHandler = reader.start
    parser.EndElementHandler = reader.end
    parser.CharacterDataHandler = reader.builder.data
    parser.StartDoctypeDeclHandler = reader.doctype
    try:
        parser.Parse(text.lstrip("\ufeff").encode("utf-8", errors="replace"), True)
    except expat.ExpatError as error:
        message = f"it is not well-formed XML: {expat.errors.messages[error.code]}"
        raise RobotFileError(message, path=path, line=error.lineno) from error
    return cast("Element", reader.builder.close())


class _Reader:
    """Builds the tree from what the parser meets."""

    def __init__(self, parser: expat.XMLParserType, path: Path):
        self.builder = ET.TreeBuilder(element_factory=Element)
        self._parser, self._path = parser, path
        self._elements = self._depth = 0

    def start(self, tag: str, attributes: dict[str, str]) -> None:
        self._elements += 1
        self._depth += 1
        if self._elements > MOST_ELEMENTS:
            self._refuse(f"it has more than {MOST_ELEMENTS} elements")
        if self._depth > DEEPEST:
            self._refuse(f"its elements are nested more than {DEEPEST} deep")
        if len(attributes) > MOST_ATTRIBUTES:
            self._refuse(f"an element has {len(attributes)} attributes; at most {MOST_ATTRIBUTES} are read")
        if max(map(len, (tag, *attributes, *attributes.values()))) > LONGEST:
            self._refuse(f"a name or a value has more than {LONGEST} characters")
        element = cast("Element", self.builder.start(tag, attributes))
        element.line = self._parser.CurrentLineNumber

    def end(self, tag: str) -> None:
        self._depth -= 1
        self.builder.end(tag)

    def doctype(self, *_: object) -> None:
        self._refuse("it has a DOCTYPE, which no robot needs")

    def _refuse(self, why: str) -> None:
        raise RobotFileError(why, path=self._path, line=self._parser.CurrentLineNumber)
