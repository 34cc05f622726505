"""What results have in common: they cannot be changed, they explain themselves, and they can be insisted on."""

from collections.abc import Callable, Iterable
from typing import Any, Protocol, TypeVar

import numpy as np

from robotics1.errors import NotConverged


class Explained(Protocol):
    """A result that says in sentences what came out."""

    def explain(self) -> str:
        """Return the outcome with its numbers, in sentences."""


Outcome = TypeVar("Outcome", bound=Explained)
Kind = TypeVar("Kind", bound=type)


def require(result: Outcome, success: bool) -> Outcome:
    """Return a result that is a success.

    Raises:
        NotConverged: it is none; the message is what the result explains.
    """
    if not success:
        raise NotConverged(result.explain(), result)
    return result


def read_only(values: Iterable[Any]) -> None:
    """Make those of the values that are arrays, alone or in tuples, read-only."""
    for value in values:
        if isinstance(value, np.ndarray):
            value.flags.writeable = False
        elif isinstance(value, tuple):
            read_only(value)


def tuple_with_arrays(kind: Kind) -> Kind:
    """Let named tuples be compared entry by entry, and keep their arrays read-only in copies and after unpickling."""
    methods: dict[str, Callable[..., Any]] = {
        "__eq__": _same_entries,
        "__ne__": lambda a, b: not _same_entries(a, b),
        "__hash__": lambda a: hash(tuple(a)),  # which says that an array has none
        "__reduce__": lambda a: (_made_again, (type(a), *a)),
    }
    for name, method in methods.items():
        setattr(kind, name, method)
    return kind


def _same_entries(a: Any, b: Any) -> bool:
    """Return whether two named tuples are the same; a plain tuple would ask an array whether it is true."""
    return type(a) is type(b) and all(map(np.array_equal, a, b))


def _made_again(kind: Callable[..., Any], *values: Any) -> Any:
    """Return a named tuple of results from its copied or unpickled values, whose arrays are made read-only."""
    read_only(values)
    return kind(*values)


class Frozen:
    """A base of frozen dataclasses whose arrays are read-only, also in copies and after unpickling."""

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        read_only(vars(self).values())

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state)
        read_only(state.values())
