"""Names that a file or a user gives, as plain text: whatever they hold, they only are read, and do nothing."""

import re
import unicodedata

from robotics1.errors import InputError

NO_NUMBERS = ("nan", "inf", "infinity")  # in small or capital letters: `float` reads these
LONGEST_FILE_NAME = 100  # characters, well below the 255 bytes of most file systems


def printable(text: str, keep: str = "") -> str:
    r"""Return a text for a terminal or a page: its control and format characters written as \x1b, \u202e, \n.

    Such characters move the cursor, change colours, or turn the direction of what follows.

    Args:
        text: any text.
        keep: characters that stay, as "\n" in a text of several lines.
    """
    return "".join(c if c.isprintable() or c in keep else c.encode("unicode_escape").decode() for c in str(text))


def file_stem(name: str) -> str:
    """Return a file name without suffix that is made of a name's letters, digits, _ and -: never another folder."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
    return re.sub(r"[^A-Za-z0-9_-]+", "_", plain).strip("_-")[:LONGEST_FILE_NAME] or "robot"


def refuse_no_number(where: str, name: str) -> None:
    """Raise InputError for a word such as nan or inf: it is neither a name nor a finite number."""
    if name.lower() in NO_NUMBERS:
        raise InputError(f"{where} must be a finite number or a name; {name!r} is neither")
