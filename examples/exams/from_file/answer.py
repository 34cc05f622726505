"""An answer to a question of a file: formulas and numbers with names, sentences, tables and figures."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy.typing as npt
import sympy


class Shown(NamedTuple):
    """A formula with the symbol that is equal to it; "" of a condition."""

    symbol: str
    formula: Any


class Line(NamedTuple):
    """All multiples of a vector, as a null space of dimension one is."""

    vector: sympy.Matrix


class NotZero(NamedTuple):
    """What is not zero, as of velocities that cannot be realised; any multiple says the same."""

    expression: Any


class Names(NamedTuple):
    """Names of joints, in any order."""

    names: Sequence[str]


class Branches(NamedTuple):
    """Where something is singular: equations that hold together, branch by branch."""

    conditions: Sequence[tuple[sympy.Eq, ...]]


class ShownTable(NamedTuple):
    """A table of texts."""

    title: str
    headings: Sequence[str]
    rows: Sequence[Sequence[str]]


@dataclass(frozen=True, eq=False)
class Answer:
    """What a question's answer is made of.

    Attributes:
        formulas: name → formula; the name is what `published` calls it.
        numbers: name → numbers, likewise.
        words: name → words, likewise, such as how an iteration ended.
        columns: of the rows that `published.table` has: what "k=0 q", "k=0 r", ... are called behind "k=0".
        text: sentences.
        tables, figures: to look at; a figure is the axes of a plot.
        tabled: the names of numbers that a table has too.
        page: to play with; a page of HTML.
    """

    formulas: Mapping[str, Shown] = field(default_factory=dict)
    numbers: Mapping[str, npt.ArrayLike] = field(default_factory=dict)
    words: Mapping[str, Sequence[str]] = field(default_factory=dict)
    columns: Sequence[str] = ()
    text: str = ""
    tables: Sequence[ShownTable] = ()
    figures: Sequence[Any] = ()
    tabled: Sequence[str] = ()
    page: str = ""

    @property
    def names(self) -> list[str]:
        """What can be published."""
        return [*self.formulas, *self.numbers, *self.words, *(["table", "rows"] if self.columns else [])]
