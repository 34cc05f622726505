"""Formulas with their names, for the terminal and for a page."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import sympy

from robotics1.symbolic.writing.printing import unicode_text

BETWEEN_ROWS = r"\s*⎢\s*⎥\s*"  # a line of a drawn matrix that has nothing in it


@dataclass(frozen=True, eq=False)
class NamedFormula:
    """A formula with its name.

    Attributes:
        name: what it is, in words.
        symbol: what is equal to the formula, in SymPy's spelling, as "J_r", "qdot" or "det(J)"; "" of a condition.
        formula: a SymPy expression, matrix, relation or membership.
        number: its numbers, where it has some.
    """

    name: str
    symbol: str
    formula: Any
    number: str = ""

    @property
    def equation(self) -> Any:
        """The symbol and the formula as a SymPy equation; a condition stands for itself."""
        if not self.symbol:
            return self.formula
        function, _, argument = self.symbol.rstrip(")").rpartition("(")
        left = sympy.Symbol(argument, real=True)
        return sympy.Eq(sympy.Function(function)(left) if function else left, self.formula, evaluate=False)

    def text(self) -> str:
        """Return the name and the equation drawn with characters, on one line where that is enough; and its numbers."""
        drawn = [line.rstrip() for line in unicode_text(self.equation).splitlines()]
        lines = [line for line in drawn if not re.fullmatch(BETWEEN_ROWS, line)]
        number = f"= {self.number}" if self.number else ""
        if len(lines) == 1:
            return f"{self.name}: {lines[0]} {number}".rstrip()
        return "\n".join([f"{self.name}:", *(f"    {line}" for line in (*lines, number) if line)])


@dataclass(frozen=True, eq=False)
class FormulaSection:
    """Formulas under a title.

    Attributes:
        title: of the section.
        formulas: in order.
        given: the values of the lengths, and of what else has one.
        numbers: what comes of the formulas with these values, line by line.
    """

    title: str
    formulas: Sequence[NamedFormula]
    given: str = ""
    numbers: Sequence[str] = ()
