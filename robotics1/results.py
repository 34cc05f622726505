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


def same_entries(a: Any, b: Any) -> bool:
    """Return whether two named tuples are the same; a plain tuple would ask an array whether it is true."""
    return type(a) is type(b) and all(np.array_equal(x, y) for x, y in zip(a, b, strict=True))


def made_again(kind: Callable[..., Any], *values: Any) -> Any:
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
