"""The arguments of a xacro file, and what stands in round brackets: `$(arg length)`, `$(find pkg)`, `$(eval ...)`."""

import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from robotics1.errors import InputError, shown
from robotics1.inputs import real_number
from robotics1.robot.xacro.budget import Budget, Refused
from robotics1.robot.xacro.evaluator import evaluate
from robotics1.robot.xacro.functions import MATH, PYTHON
from robotics1.robot.xacro.reading import Files

NUMBER = re.compile(r"\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d{1,3})?\s*", re.ASCII)


class Substitutions:
    """The commands of one expansion.

    Args:
        argument: gives the text of an argument, or raises KeyError.
        files: what may be read.
        budget: what the expansion may use.
    """

    def __init__(self, argument: Callable[[str], str], files: Files, budget: Budget):
        self._argument, self._files, self._budget = argument, files, budget
        self._commands: dict[str, Callable[..., str]] = {
            "arg": self._declared,
            "find": lambda package: str(files.find(package)),
            "env": self._environment,
            "optenv": lambda name, *default: self._environment(name, " ".join(default)),
            "cwd": self._working_folder,
        }
        functions = {name: PYTHON[name] for name in ("list", "dict", "map", "str", "float", "int")} | MATH
        known = functions | self._commands | {"true": True, "false": False}
        self._names = _Names(known | {"arg": lambda name: typed(self._declared(name))}, argument)

    def value(self, text: str) -> str:
        """Return the text that stands for what is in the brackets.

        Raises:
            Refused: it is no command, or may not be used.
        """
        command, _, rest = text.strip().partition(" ")
        if command == "eval":
            return str(evaluate(rest, self._names, self._budget))
        if command not in self._commands:
            raise Refused(f"Unknown substitution command {command!r}; there is eval, {', '.join(self._commands)}")
        return self._commands[command](*rest.split())

    def _declared(self, name: str) -> str:
        try:
            return self._argument(name)
        except KeyError:
            raise NameError(f"argument {name!r} is not declared by a xacro:arg") from None

    def _environment(self, name: str, default: str | None = None) -> str:
        self._files.need_trust("$(env)" if default is None else "$(optenv)")
        value = os.environ.get(name, default)
        if value is None:
            raise NameError(f"there is no environment variable {name!r}")
        return value

    def _working_folder(self) -> str:
        self._files.need_trust("$(cwd)")
        return str(Path.cwd())


class _Names(dict[str, Any]):
    """What a name stands for in `$(eval ...)`: a function, else an argument."""

    def __init__(self, functions: dict[str, Any], argument: Callable[[str], str]):
        super().__init__(functions)
        self._argument = argument

    def __missing__(self, name: str) -> Any:
        return typed(self._argument(name))


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
        raise InputError(f"parameter {name!r} must be a finite number, not {shown(value)}; its default is {default}")
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
