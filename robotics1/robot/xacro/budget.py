"""What one expansion may use: it is counted, not timed, so that a file is refused on every machine or on none."""

from dataclasses import dataclass, field
from typing import Any
from xml.dom import minidom

LONGEST_TEXT = 100_000  # characters; also of a list with everything in it
LONGEST_LIST = 5_000  # elements
LARGEST_TABLE = 2_000  # elements of a dictionary or a set: numbers of equal hash make it slow
MOST_BITS = 4096  # of an integer
MOST = {
    "steps": 200_000,  # parts of expressions, some microseconds each; the official robots take up to 23 000
    "pieces of XML": 100_000,  # read or copied, some ten microseconds each; the official robots have up to 6 400
    "characters": 20_000_000,  # read or put together
    "files": 500,
}


class Refused(Exception):  # noqa: N818 (it is turned into a RobotFileError)
    """The file asks for something that no robot needs; the message says what."""


class Located(Refused):
    """A refusal that says in which expression."""


def message(error: BaseException) -> str:
    """Return what an exception says, in one line."""
    text = " ".join(str(error).split()) or type(error).__name__
    return f"there is no entry {text}" if isinstance(error, KeyError) else text


def shortened(text: str) -> str:
    """Return a text as an error quotes it."""
    return text if len(text) < 100 else f"{text[:97]}..."


@dataclass
class Budget:
    """What is left to an expansion."""

    left: dict[str, int] = field(default_factory=lambda: dict(MOST))

    def spend(self, what: str, amount: int = 1) -> None:
        """Take an amount of something away.

        Raises:
            Refused: nothing is left of it.
        """
        self.left[what] -= amount
        if self.left[what] < 0:
            raise too_large(f"it needs more than {MOST[what]} {what}")

    @property
    def used(self) -> float:
        """How much of it is used, from 0 to 1, of what most is used of."""
        return max(1 - left / MOST[what] for what, left in self.left.items())

    def weigh(self, value: Any) -> None:
        """Take away the steps that a value costs which was just built.

        A bounded value bounds what one operation on it costs. A list that holds a long text twice has it twice,
        since that is how long it becomes when it is written.

        Raises:
            Refused: the value is too large, or of a type that no expression needs.
        """
        total, rest = 0, [value]
        while rest:
            part = rest.pop()
            kind = type(part)
            if kind not in DATA:
                raise Refused(f"{kind.__name__} is no type of value")
            if kind is int and part.bit_length() > MOST_BITS:
                raise too_large(f"an integer of more than {MOST_BITS} bits")
            total += len(part) if kind in SIZED else 1
            check_length(total)
            if kind in (list, tuple, range):
                check_elements(len(part))
            if kind in (list, tuple, set):
                rest += part
            elif kind is dict:
                rest += [*part.keys(), *part.values()]
            if kind in (set, dict) and len(part) > LARGEST_TABLE:
                raise too_large(f"a dictionary or a set of more than {LARGEST_TABLE} elements")
        self.spend("steps", total // 10)


SIZED = (str, list, tuple, set, dict, range)
DATA = (*SIZED, int, float, bool, type(None))


def check_length(length: int) -> None:
    """Raise Refused if a text would be too long."""
    if length > LONGEST_TEXT:
        raise too_large(f"a text of more than {LONGEST_TEXT} characters")


def check_elements(number: int) -> None:
    """Raise Refused if a list would have too many elements."""
    if number > LONGEST_LIST:
        raise too_large(f"a list of more than {LONGEST_LIST} elements")


def written_length(document: minidom.Document) -> int:
    """Return how many characters a document has when it is written, without its punctuation."""
    total, rest = 0, list(document.childNodes)
    while rest:
        node: Any = rest.pop()
        total += len(node.nodeName) + len(getattr(node, "data", ""))
        total += sum(len(name) + len(value) for name, value in node.attributes.items()) if node.attributes else 0
        rest += node.childNodes
    return total


def too_large(what: str) -> Refused:
    """Return the refusal of what is too large."""
    return Refused(f"it is too large: {what}, which no robot needs")
