"""What results have in common: they cannot be changed, they explain themselves, and they can be insisted on."""

from collections.abc import Callable, Iterable, Iterator, Sequence, Sized
from dataclasses import fields
from enum import Enum
from typing import Any, ClassVar, Generic, Protocol, TypeVar

import numpy as np

from robotics1.errors import InputError, NotConverged, shown
from robotics1.other_words import names_what_is_meant
from robotics1.tables import Table, in_html, in_text


class Explained(Protocol):
    """A result that says in sentences what came out."""

    def explain(self) -> str:
        """Return the outcome with its numbers, in sentences."""


Outcome = TypeVar("Outcome", bound=Explained)
Kind = TypeVar("Kind", bound=type)
Entry = TypeVar("Entry")


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


@names_what_is_meant
class Shown:
    """A base of what is looked at: `str` gives sentences and tables, a notebook shows the same as HTML."""

    def __str__(self) -> str:
        return in_text(self._sentences(), self._tables())

    def _repr_html_(self) -> str:
        return in_html(self._sentences(), self._tables(), *self._drawings())

    def _sentences(self) -> str:
        """Return what the result explains, else its repr."""
        explain = getattr(self, "explain", None)
        return repr(self) if explain is None else str(explain())

    def _tables(self) -> Sequence[Table]:
        """Return the tables below the sentences."""
        return ()

    def _drawings(self) -> Sequence[str]:
        """Return what a notebook shows below the tables, as HTML."""
        return ()


class Frozen(Shown):
    """A base of frozen dataclasses whose arrays are read-only, also in copies and after unpickling.

    Their `repr` has one line: what it is, short values, and how many there are of the others. `str` of one that does
    not explain itself has a line for each value that is not short.
    """

    def __init_subclass__(cls, **options: Any) -> None:
        """Give the class this repr before `dataclass` would write another."""
        super().__init_subclass__(**options)
        if "__repr__" not in vars(cls):
            cls.__repr__ = Frozen.__repr__  # type: ignore[method-assign]

    def __repr__(self) -> str:
        shown = [field.name for field in fields(self) if field.repr]  # type: ignore[arg-type]
        return f"{type(self).__name__}({', '.join(f'{name}={_short(getattr(self, name))}' for name in shown)})"

    def _sentences(self) -> str:
        line = super()._sentences()
        if "<" not in line or hasattr(self, "explain") or type(self)._tables is not Shown._tables:
            return line
        shown = [field.name for field in fields(self) if field.repr]  # type: ignore[arg-type]
        return "\n".join([type(self).__name__, *(f"  {name}:{_whole(getattr(self, name))}" for name in shown)])

    def __post_init__(self) -> None:
        """Make the arrays read-only."""
        read_only(vars(self).values())

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update(state)
        read_only(state.values())


class Listed(Frozen, Generic[Entry]):
    """A base of results that hold several of one kind, which have numbers: they can be counted and iterated."""

    entries_in: ClassVar[str]  # the attribute that holds them

    def __len__(self) -> int:
        return len(getattr(self, self.entries_in))

    def __iter__(self) -> Iterator[Entry]:
        return iter(getattr(self, self.entries_in))

    def __getitem__(self, i: int) -> Entry:
        last = f"the last of {type(self).__name__} is {len(self) - 1}" if len(self) else "it is empty"
        if not isinstance(i, int | slice | np.integer):
            raise InputError(f"there is no entry {shown(i)}: they have numbers, and {last}")
        try:
            found: Entry = getattr(self, self.entries_in)[i]
        except IndexError:
            raise IndexError(f"there is no entry {i}: {last}") from None
        return found


FEW = 6  # numbers, or entries, that are written out
MANY = 100  # numbers of an array that are written out on lines of their own
LONG = 60  # characters of a text, or of what has a repr of its own


def _whole(value: Any) -> str:
    """Return " value", or below it what it holds, where that is few lines."""
    short = _short(value)
    if "<" not in short:
        return f" {short}"
    if isinstance(value, np.ndarray) and value.size <= MANY:
        lines = np.array2string(value, precision=6, suppress_small=True, separator=", ").splitlines()
    elif isinstance(value, tuple) and len(value) <= FEW:
        lines = [" ".join(repr(part).split()) for part in value]
    elif isinstance(value, Shown):
        lines = [repr(value)]
    else:
        lines = [short]
    return "".join(f"\n    {line}" for line in lines)


def _short(value: Any) -> str:
    """Return a value on one line, or what it is and how many there are of it."""
    match value:
        case Enum():
            return str(value.name)
        case np.ndarray():
            few = value.ndim < 2 and value.size <= FEW
            return f"[{', '.join(map(_short, value.tolist()))}]" if few else f"<{value.shape} array>"
        case tuple() if len(value) <= FEW:
            return f"({', '.join(map(_short, value))}{',' if len(value) == 1 else ''})"
        case Shown():
            return f"<{type(value).__name__}>"
    text = f"{value:.6g}" if isinstance(value, float) else repr(value)
    if len(text) <= LONG and "\n" not in text:
        return text
    return f"<{type(value).__name__}{f' of {len(value)}' if isinstance(value, Sized) else ''}>"
