"""The formulas of an exercise: what each is, what was computed, what was published, and its numbers."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import sympy

from robotics1.notation import number, vector
from robotics1.symbolic.writing.printing import unicode_text

from .comparison import Comparison
from .named_formulas import FormulaSection, NamedFormula


@dataclass(frozen=True, eq=False)
class FormulaRow:
    """A computed formula beside the published one.

    Attributes:
        exercise: such as "1a".
        name: what it is; unique in an exam.
        symbol: what is equal to it, in SymPy's spelling; "" of a condition.
        computed: a SymPy expression, matrix, relation or membership.
        published: the same in SymPy's spelling; "" where the solution does not print it.
        unit: of its numbers.
    """

    exercise: str
    name: str
    symbol: str
    computed: Any
    published: str = ""
    unit: str = ""


@dataclass(frozen=True, eq=False)
class FormulaTable:
    """The formulas of an exercise.

    Attributes:
        title: of the exercise.
        rows: the formulas.
        given: the values below, in words.
        values: name → value of what has one.
        numbers: what else comes of the formulas, line by line.
    """

    title: str
    rows: Sequence[FormulaRow]
    given: str
    values: Mapping[str, float] = field(default_factory=dict)
    numbers: Sequence[str] = ()

    def section(self) -> FormulaSection:
        """Return the formulas as they are printed, with the numbers of those that the values leave no symbol in."""
        values = {sympy.Symbol(name, real=True): value for name, value in self.values.items()}
        formulas = []
        for row in self.rows:
            numbers = f"{_numbers(row.computed, values)} {row.unit}".strip()
            formulas.append(NamedFormula(row.name, row.symbol, row.computed, numbers))
        return FormulaSection(self.title, formulas, self.given, self.numbers)

    def check(self, comparison: Comparison) -> None:
        """Compare each formula that was published with the computed one."""
        for row in self.rows:
            if row.published:
                comparison.formula(row.exercise, row.name, row.published, row.computed)


def _numbers(formula: Any, values: Mapping[sympy.Symbol, float]) -> str:
    """Return the numbers of an expression, of a column or the rows of a matrix, or of all multiples of a column."""
    if isinstance(formula, sympy.MatMul):
        factor, (v,) = formula.as_coeff_matrices()
        numbers = _numbers(v, values)
        return numbers and f"{unicode_text(factor)} {numbers}"
    found = formula.subs(values)
    if found.free_symbols or found == formula:
        return ""
    if isinstance(found, sympy.MatrixBase):
        rows = [list(found)] if found.cols == 1 else found.tolist()
        return ", ".join(vector([float(entry) for entry in row]) for row in rows)
    return number(float(found))
