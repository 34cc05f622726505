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
        text: sentences.
        tables, figures: to look at; a figure is the axes of a plot.
    """

    formulas: Mapping[str, Shown] = field(default_factory=dict)
    numbers: Mapping[str, npt.ArrayLike] = field(default_factory=dict)
    text: str = ""
    tables: Sequence[ShownTable] = ()
    figures: Sequence[Any] = ()
