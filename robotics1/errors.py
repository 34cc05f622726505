"""What can go wrong, as one tree.

::

    Robotics1Error
    ├── RobotFileError (ValueError)     a robot file is wrong: .path, .line, .element
    ├── UnknownNameError (LookupError)  no such robot, frame, parameter ...: .candidates
    ├── InputError (ValueError)         an argument has the wrong shape, type or value
    ├── TaskError (ValueError)          the task does not fit the robot
    ├── FormulaError (RuntimeError)     no verified formula can be given
    ├── NotConverged (RuntimeError)     an answer was insisted upon: .result
    └── MissingExtraError (ImportError) an optional package is not installed

    RobotWarning (UserWarning)          something in a file, an angle, or work of hours is probably not meant

Misuse raises. An unreachable target is not misuse: it is an outcome, reported in the result's status.
"""

import re
import reprlib
import sys
import warnings
from collections.abc import Iterable
from difflib import get_close_matches
from pathlib import Path
from typing import Any, cast

LONG_WORD = r"\S{301,}"


class Robotics1Error(Exception):
    """The root of every error this package raises on purpose.

    An error can be pickled and copied, so that it comes back from another process with its data: it is made again
    from its message and its attributes, whatever arguments its class has.
    """

    def __reduce__(self) -> tuple[Any, ...]:
        _, message, *attributes = cast(tuple[Any, ...], super().__reduce__())
        return (_made_again, (type(self), message), *attributes)


def _made_again(kind: type[Robotics1Error], message: tuple[Any, ...]) -> Robotics1Error:
    """Return an error of a kind with a message, without the arguments from which its class writes the message."""
    error = kind.__new__(kind, *message)
    super(Robotics1Error, error).__init__(*message)
    return error


class RobotFileError(Robotics1Error, ValueError):
    """A robot file cannot be read as a robot; the message says what is wrong and where."""

    def __init__(
        self, message: str, *, path: str | Path | None = None, line: int | None = None, element: str | None = None
    ):
        where = ":".join(str(part) for part in (path, line) if part is not None)
        super().__init__(f"{where}: {message}" if where else message)
        self.path = path
        self.message = message
        self.line = line
        self.element = element


_SHORT = reprlib.Repr()
_SHORT.maxlist = _SHORT.maxtuple = _SHORT.maxdict = 12
_SHORT.maxstring = _SHORT.maxother = 120


def shown(value: Any) -> str:
    """Return a value on one line of a message; of a long one what it begins with, of an array its shape."""
    shape = getattr(value, "shape", None)
    if isinstance(shape, tuple) and shape and hasattr(value, "tolist"):
        return f"{value.tolist()}" if len(shape) == 1 and shape[0] <= _SHORT.maxlist else f"an array of shape {shape}"
    return " ".join(_SHORT.repr(value).split())


def _sentence(message: str) -> str:
    """Return a message on one line, its longest words cut."""
    line = " ".join(part.strip() for part in message.splitlines())
    return re.sub(LONG_WORD, lambda word: f"{word[0][:100]}...", line)


def nearest_names(name: str, candidates: Iterable[str], alike: float = 0.6) -> list[str]:
    """Return up to three candidates that resemble a name, the nearest first; if one has the same letters, that alone.

    Args:
        name: what was written.
        candidates: what there is.
        alike: the least similarity, as `difflib` measures it, from 0 to 1.
    """
    written = {candidate: candidate.casefold() for candidate in sorted(candidates)}
    same = [candidate for candidate, text in written.items() if text == name.casefold()]
    close = get_close_matches(name.casefold(), dict.fromkeys(written.values()), n=3, cutoff=alike)
    return same or [candidate for text in close for candidate in written if written[candidate] == text][:3]


class UnknownNameError(Robotics1Error, LookupError):
    """A name that is not among those that exist; the message lists them, or the nearest."""

    def __init__(self, kind: str, name: object, candidates: Iterable[str], note: str = ""):
        self.candidates = tuple(candidates)
        close = nearest_names(str(name), self.candidates)
        if close:
            hint = f"did you mean {' or '.join(map(repr, close))}?"
        elif self.candidates:
            more = f" and {len(self.candidates) - 12} more" if len(self.candidates) > 12 else ""
            hint = f"there is {', '.join(map(repr, self.candidates[:12]))}{more}"
        else:
            hint = "there is none"
        super().__init__(_sentence(f"no {kind} {name!r}; {hint}{note}"))


class InputError(Robotics1Error, ValueError):
    """An argument has the wrong shape, type or value; the message says what would be right, on one line."""

    def __init__(self, message: str):
        super().__init__(_sentence(message))


class TaskError(Robotics1Error, ValueError):
    """The task asks for something this robot cannot be asked."""


class FormulaError(Robotics1Error, RuntimeError):
    """No formula can be given that agrees with the numbers.

    Attributes:
        polynomial: where no closed formula of inverse kinematics is found, a polynomial that remains: a `sympy.Poly` in
            t, which is tan(q/2) of a joint that turns and q of one that slides; None where there is none.
        joint: the name of that joint.
    """

    polynomial: Any = None
    joint: str = ""


class NotConverged(Robotics1Error, RuntimeError):  # noqa: N818 (the contract's name)
    """A result was required to be a success and is not; `.result` is that result."""

    def __init__(self, message: str, result: object):
        super().__init__(message)
        self.result = result


class MissingExtraError(Robotics1Error, ImportError):
    """An optional package is needed here."""

    def __init__(self, package: str, extra: str):
        super().__init__(f"{package} is needed for this; install it with: pip install 'robotics1[{extra}]'")


class RobotWarning(UserWarning):
    """Something in a robot's file, an angle that a caller hands in, or work of hours is probably not meant."""


def warn(sentence: str) -> None:
    """Give a `RobotWarning` of the user's own line, wherever in the package it is found."""
    level, frame = 1, sys._getframe()
    while frame.f_back is not None and frame.f_globals.get("__name__", "").partition(".")[0] == "robotics1":
        level, frame = level + 1, frame.f_back
    warnings.warn(sentence, RobotWarning, stacklevel=level)
