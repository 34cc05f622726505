"""The arguments of a xacro file: what its `xacro:arg` elements declare, and what the caller gives for them."""

import re
from typing import Any

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import real_number

NUMBER = re.compile(r"\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?\s*", re.ASCII)


def is_number(text: str | None) -> bool:
    """Return whether a text is a finite decimal number."""
    return text is not None and NUMBER.fullmatch(text) is not None and np.isfinite(float(text))


def argument(name: str, value: Any, default: str | None) -> tuple[str, float | None]:
    """Return the text of an argument, and its number when it is a named length.

    A number is a length. A text stays as it is, and is none: so "6" is a count of joints that formulas do not vary.
    True and False are written as the default writes them. Where the default is a number, a value must be one.

    Raises:
        InputError: the value is none of these.
    """
    if isinstance(value, str) and (is_number(value) or not is_number(default)):
        return value, None
    if isinstance(value, bool | np.bool_) and not is_number(default):
        return str(bool(value)) if default in ("True", "False") else str(bool(value)).lower(), None
    if isinstance(value, str):
        raise InputError(f"parameter {name!r} must be a finite number, not {value!r}; its default is {default}")
    number = real_number(f"parameter {name!r}", value)
    return number_text(number), number


def number_text(value: float) -> str:
    """Return a number as it is put into the file; a whole number without a point, so that it is also a condition."""
    return str(int(value)) if value.is_integer() and abs(value) < 1e15 else repr(value)


def typed(text: str) -> Any:
    """Return an argument as `$(eval ...)` sees it: a number or a truth value if it looks like one, else a text."""
    try:
        return float(text) if "." in text else int(text)
    except ValueError:
        return {"true": True, "false": False}.get(text.lower(), text)
