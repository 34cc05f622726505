"""Where in a TOML file something stands: its reader keeps no lines, and an error must name one."""

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import NoReturn

from robotics1.errors import InputError, nearest_names
from robotics1.names import printable

HEADER = re.compile(r"\s*\[\[?\s*([\w.\s]+?)\s*\]\]?\s*(#.*)?$")
KEY = re.compile(r"""\s*(?:"([^"]+)"|'([^']+)'|([\w-]+))\s*[.=]""")
QUOTES = re.compile(r'"""|' + "'''")


WHERE = re.compile(r"(.*) \(at line (\d+), column \d+\)")
WRITTEN = 'texts and formulas stand in quotes, as q = [0, "pi/2"], and numbers have a point, as 0.5'
TWICE = "it is there already; each exercise begins with [[exercise]], each question with [[exercise.question]]"


def meant(name: str, known: Iterable[str]) -> str:
    """Return which of the known names is meant, or all of them."""
    names = list(known)
    close = nearest_names(name, names)
    return f"did you mean {' or '.join(map(repr, close))}?" if close else f"known are {', '.join(names)}"


def not_toml(path: Path, text: str, error: Exception) -> InputError:
    """Return the error of a text that is no TOML, with its line and with what would be right."""
    lines = text.splitlines() or [""]
    found = WHERE.match(str(error))
    number = int(found[2]) if found else len(lines)
    what = found[1] if found else str(error)
    hint = TWICE if what.startswith("Cannot") else WRITTEN
    line = printable(lines[number - 1].strip()[:80])
    return InputError(f"{path}:{number}: it is no TOML: {printable(what)}: {line}; {hint}")


@dataclass
class Place:
    """A table of the file.

    Attributes:
        path: the file.
        line: of its header; of the whole file 1.
        keys: key → its line.
    """

    path: Path
    line: int
    keys: dict[str, int] = field(default_factory=dict)

    def refuse(self, message: str, key: str | None = None) -> NoReturn:
        """Raise InputError with the file and the line of a key, or of the table.

        Raises:
            InputError: always.
        """
        of_table = self.keys.get((key or "").partition(".")[0], self.line)
        line = self.keys.get(key or "", of_table)
        raise InputError(f"{self.path}:{line}: {printable(message)}")


def places_of(path: Path, text: str) -> dict[str, list[Place]]:
    """Return the places of the file ("" → one), of its exercises and of its questions, in order of the file."""
    whole = Place(path, 1)
    found: dict[str, list[Place]] = {"": [whole], "exercise": [], "exercise.question": []}
    here, prefix, inside = whole, "", False
    for number, line in enumerate(text.splitlines(), 1):
        was_inside = inside
        inside ^= len(QUOTES.findall(line)) % 2 == 1
        if was_inside:
            continue
        header, key = HEADER.match(line), KEY.match(line)
        if header and (name := re.sub(r"\s", "", header[1])) in ("exercise", "exercise.question") and "[[" in line:
            here, prefix = Place(path, number), ""
            found[name].append(here)
        elif header:
            prefix = re.sub(r"\s", "", header[1]).rpartition(".")[2]
            here.keys.setdefault(prefix, number)
        elif key:
            name = key[1] or key[2] or key[3]
            here.keys.setdefault(f"{prefix}.{name}" if prefix else name, number)
    return found
