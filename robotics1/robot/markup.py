"""From the bytes of an XML file to a tree with the line of each element, and nothing that XML can do beyond that.

The encoding is the one that the first bytes and the declaration give (XML 1.0, appendix F).
"""

import codecs
import re
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

DECLARATION = re.compile(r"""\s*<\?xml[^>]*?\sencoding\s*=\s*["']([^"'>]*)["']""")
COMMENT = re.compile("<!--.*?-->", re.DOTALL)
NO_CHARACTER = "\ufffd"  # what Python writes for bytes that are none
MARKS = (  # the longer first: UTF-32's begins with UTF-16's
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF32_BE, "utf-32-be"),
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)
FIRST = ((b"<\0\0\0", "utf-32-le"), (b"\0\0\0<", "utf-32-be"), (b"<\0", "utf-16-le"), (b"\0<", "utf-16-be"))
OF_FILES = re.compile(r"utf-(8|16|32)|ascii|iso(8859|2022)|cp\d|koi8|gb|big5|shift_jis|euc_|mac-|johab|tis-")
FIT_ANY_BYTES = ("ascii", "cp1252", "iso8859-1", "iso8859-15")


class Element(ET.Element):
    """An element that knows the line it starts on."""

    line: int = 0

    @property
    def label(self) -> str:
        """How messages call it: joint 'q1', or <limit>."""
        name = self.get("name")
        return f"{self.tag} {name!r}" if name else f"<{self.tag}>"


def parse_xml(text: str, path: Path, *, largest: int = LARGEST_FILE) -> Element:
    """Return the root element of an XML text.

    No DOCTYPE is taken, so no entity is expanded and nothing is read from elsewhere. Prefixes stay in the tags.

    Args:
        text: the text.
        path: the file from which it is.
        largest: the most characters that it may have.

    Raises:
        RobotFileError: it is not well-formed, has a DOCTYPE, or exceeds a limit of size, which is counted while it
            is read.
    """
    if len(text) > largest:
        raise RobotFileError(f"it has {len(text)} characters; at most {largest} are read", path=path)
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


def children(parent: ET.Element, tag: str) -> list[Element]:
    """Return the children of a tag."""
    return cast("list[Element]", parent.findall(tag))


def child(parent: ET.Element, tag: str) -> Element | None:
    """Return the first child of a tag, or None."""
    return cast("Element | None", parent.find(tag))


def linked(joint: ET.Element, end: str) -> str | None:
    """Return the link at an end of a joint, "parent" or "child", or None when the joint names none."""
    element = joint.find(end)
    return None if element is None else element.get("link")


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


def decoded(data: bytes, path: Path) -> str:
    """Return the text of an XML file: a byte order mark gives its encoding, else the declaration, else it is UTF-8.

    Bytes that are no character of the encoding may stand in comments only. Bytes that are UTF-8 are read as such
    where the declaration names an encoding that any bytes fit.

    Raises:
        RobotFileError: the declared encoding is unknown, or is not that of the bytes; with the line.
    """
    mark, found = next(((mark, name) for mark, name in MARKS if data.startswith(mark)), (b"", ""))
    data = data[len(mark) :]
    found = found or next((name for start, name in FIRST if data.startswith(start)), "")
    declared = _declared(data[:1000].decode(found or "latin-1", errors="replace"), path)
    if declared and _width(declared) != _width(found) and (found or _width(declared) != "utf-8"):
        seen = f"those of {found}" if found else "not of it"
        raise _wrong(f"it declares the encoding {declared}, and its first bytes are {seen}", path)
    encoding = found or declared or "utf-8"
    if encoding in FIT_ANY_BYTES and _is_whole(data, "utf-8"):
        encoding = "utf-8"
    text = data.decode(encoding, errors="replace")
    if NO_CHARACTER in text and not _is_whole(data, encoding):
        bare = COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), text)
        if NO_CHARACTER in bare:
            line = bare.count("\n", 0, bare.index(NO_CHARACTER)) + 1
            means = f"its encoding is {encoding}" if found or declared else "it declares no encoding, which means UTF-8"
            raise _wrong(f"{means}, and line {line} has bytes that are no character of it", path, line)
    return text


def undeclared(text: str) -> str:
    """Return an XML text without its declaration, which is wrong once the text is encoded again."""
    return re.sub(r"^\s*<\?xml\b.*?\?>", "", text.lstrip("\ufeff"), count=1, flags=re.DOTALL)


def _declared(beginning: str, path: Path) -> str:
    """Return Python's name of the declared encoding, or "".

    Python knows more encodings than files have; some of them are slow or read escapes.
    """
    declaration = DECLARATION.match(beginning)
    if declaration is None:
        return ""
    try:
        name = codecs.lookup(declaration[1]).name
    except (LookupError, ValueError):
        name = ""
    if not OF_FILES.match(name):
        raise _wrong(f"it declares the unknown encoding {declaration[1]!r}", path)
    return name


def _width(encoding: str) -> str:
    """Return "utf-16" or "utf-32" for characters of several bytes each, else "utf-8"."""
    return encoding[:6] if encoding.startswith(("utf-16", "utf-32")) else "utf-8"


def _is_whole(data: bytes, encoding: str) -> bool:
    try:
        data.decode(encoding)
    except UnicodeError:
        return False
    return True


def _wrong(what: str, path: Path, line: int = 1) -> RobotFileError:
    message = f"it is not well-formed XML: {what}; declare the true one, or save the file as UTF-8"
    return RobotFileError(message, path=path, line=line)
