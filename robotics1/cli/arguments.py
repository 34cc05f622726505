"""What is typed at the command line, turned into numbers, vectors and names."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from robotics1.errors import InputError

if TYPE_CHECKING:
    from robotics1.inputs import Array

NUMBER = re.compile(  # with one way only to read each text: else a long one takes the square of its length
    r"([+-]?)((?:\d+(?:\.\d*)?|\.\d+)?(?:e[+-]?\d+)?)\s*(?:\*\s*)?(pi|π)?(?:/(\d+(?:\.\d*)?))?", re.IGNORECASE
)

DEGREES = re.compile(r"(°|º|deg(rees?)?)\s*\Z", re.IGNORECASE)


def parse_number(text: str) -> float:
    """Return a number as typed: 1.5, -2e-3, pi, 0.7pi, -3pi/4, 1/2.

    Raises:
        InputError: it is none of these.
    """
    match = NUMBER.fullmatch(text.strip().replace("−", "-"))
    if match is None or not (match[2] or match[3]):
        unit = "; degrees are meant with --degrees" if DEGREES.search(text) else ""
        raise InputError(f"{text[:100]!r} is not a number; write it like 1.5, 0.7pi or -pi/4{unit}")
    try:
        value = float(match[2] or 1) * (math.pi if match[3] else 1.0) / float(match[4] or 1)
    except (ValueError, ZeroDivisionError) as error:
        raise InputError(f"{text!r} is not a number; write it like 1.5, 0.7pi or -pi/4") from error
    if not math.isfinite(value):
        raise InputError(f"a number must be finite; {text[:100]!r} is beyond 1e308")
    return -value if match[1] == "-" else value


def parse_vector(text: str, degrees: bool = False) -> Array:
    """Return numbers separated by commas or blanks.

    Raises:
        InputError: one of them is no number; or one has pi in it, where angles are typed in degrees.
    """
    import numpy as np

    return np.array([parse_number(without_pi(part) if degrees else part) for part in parse_names(text)])


def without_pi(text: str) -> str:
    """Return a number as typed in degrees.

    Raises:
        InputError: it has pi in it, and is an angle in radians then.
    """
    if "pi" in text.lower() or "π" in text:
        raise InputError(f"{text[:100]!r} is an angle in radians; leave out --degrees, or type degrees, as 90")
    return text


def named_texts(texts: Iterable[str] | None, what: str, example: str) -> Iterator[tuple[str, str]]:
    """Yield the name and the text behind it of each name=text.

    Raises:
        InputError: one is not of this form; it is no `what`, which is written like the example.
    """
    for text in texts or ():
        name, sign, value = text.partition("=")
        if not sign:
            raise InputError(f"{text[:100]!r} is {what}; write it like {example}")
        yield name.strip(), value


def parse_parameters(texts: Iterable[str] | None) -> dict[str, float | str]:
    """Return the parameters typed as l2=0.5, or as ur_type=ur5e: what is no number is a word.

    Raises:
        InputError: one is not name=value.
    """
    values: dict[str, float | str] = {}
    for name, value in named_texts(texts, "not a parameter", "l2=0.5"):
        try:
            values[name] = parse_number(value)
        except InputError:
            values[name] = value
    return values


def parse_point(text: str) -> tuple[float | str, ...]:
    """Return coordinates separated by commas or blanks: numbers, and names such as d."""
    words = parse_names(text)
    return tuple(word if word.isidentifier() and word != "pi" else parse_number(word) for word in words)


def parse_names(text: str) -> tuple[str, ...]:
    """Return names separated by commas or blanks, with or without brackets around them all."""
    inside = re.fullmatch(r"\s*[(\[](.*)[)\]]\s*", text, re.DOTALL)
    return tuple(part for part in re.split(r"[,\s]+", (inside[1] if inside else text).strip()) if part)


def read_text(path: Path) -> str:
    """Return the text of a file in UTF-8, with a byte order mark or without.

    Raises:
        InputError: there is no such file, or it is no such text.
    """
    if not path.is_file():
        raise InputError(f"there is no file {path}")
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise InputError(f"{path} is no text file in UTF-8") from error
    except OSError as error:
        raise InputError(f"{path} cannot be read: {error.strerror}") from error
