"""Published values of a file beside the computed ones."""

from collections.abc import Sequence
from typing import Any

import sympy

from robotics1.errors import InputError

from ..comparison import Comparison
from ..symbolic_equality import are_equal
from .answer import Answer, Branches, Line, Names, NotZero
from .reading import Question
from .values import conditions_of, formula_of


def compare(comparison: Comparison, question: Question, answer: Answer, *, variant: bool) -> None:
    """Add the checks of a question; of a variant the formulas alone, as its numbers are others.

    Raises:
        InputError: a published value cannot be read; with the file and the line.
    """
    comparison.errata |= {f"{question.name} {entry}" for entry in question.errata}
    for what, printed in question.published.items():
        try:
            for name, value in _rows(printed, answer) if what == "table" else [(what, printed)]:
                _compare_one(comparison, question.name, name, value, answer, variant=variant)
        except ArithmeticError:  # of a decimal
            message = f"question {question.name}, published {what}: {printed!r} is not made of numbers"
            question.place.refuse(message, f"published.{what}")
        except (InputError, ValueError) as error:
            question.place.refuse(f"question {question.name}, published {what}: {error}", f"published.{what}")


def _compare_one(
    comparison: Comparison, question: str, what: str, printed: Any, answer: Answer, *, variant: bool
) -> None:
    name = f"{question} {what}"
    if what in answer.formulas:
        shown = answer.formulas[what].formula
        comparison.compared(question, name, _text(printed), str(_plain(shown)), _agree(printed, shown))
    elif variant:
        return
    elif what in answer.words:
        computed = answer.words[what]
        agree = _same_names(printed, computed)
        comparison.compared(question, name, printed, ", ".join(computed), agree, kind="word")
    else:
        comparison.numbers(question, name, _digits(printed), answer.numbers[what])


def _same_names(printed: Any, computed: Sequence[str]) -> bool:
    return sorted(part.strip() for part in _digits(printed).split(",") if part.strip()) == sorted(computed)


def _rows(printed: Any, answer: Answer) -> list[tuple[str, str]]:
    """Return the values of a printed table, whose lines are "k | q | r | ...", by their names, and their number.

    Raises:
        InputError: it is no such text, or has a row that was not computed.
    """
    lines = [line for line in _digits(printed).splitlines() if line.strip()]
    heading = " | ".join(("k", *answer.columns))
    values = [("rows", str(len(lines)))]
    for line in lines:
        k, *cells = (cell.strip() for cell in line.split("|"))
        if len(cells) != len(answer.columns):
            raise InputError(f"a line of the table is {heading}; this one is {line.strip()!r}")
        names = [f"k={k} {column}" for column in answer.columns]
        if names[0] not in answer.numbers:
            raise InputError(f"no row was computed for {line.strip()!r}")
        values += zip(names, cells, strict=True)
    return values


def _agree(printed: Any, shown: Any) -> bool:
    """Return whether a printed formula, direction or set of branches is the computed one."""
    if isinstance(shown, Branches):
        return _same_branches([conditions_of(text) for text in printed], list(shown.conditions))
    if isinstance(shown, Line):
        factor = sympy.Symbol("nu", real=True)
        return are_equal(sympy.MatMul(factor, formula_of(printed)), sympy.MatMul(factor, shown.vector))
    if isinstance(shown, Names):
        return _same_names(printed, shown.names)
    if isinstance(shown, NotZero):
        return are_equal(sympy.Ne(formula_of(printed), 0), sympy.Ne(shown.expression, 0))
    return are_equal(formula_of(printed), shown)


def _same_branches(printed: list[tuple[sympy.Eq, ...]], computed: list[tuple[sympy.Eq, ...]]) -> bool:
    """Return whether each printed branch is one of the computed ones, and none is left."""
    left = list(computed)
    for branch in printed:
        same = [other for other in left if len(other) == len(branch) and all(_is_in(e, other) for e in branch)]
        if not same:
            return False
        left = [other for other in left if other is not same[0]]
    return not left


def _is_in(equation: sympy.Eq, branch: tuple[sympy.Eq, ...]) -> bool:
    return any(are_equal(equation, other) for other in branch)


def _digits(printed: Any) -> str:
    """Return numbers as they are printed: with all their digits, which a number of TOML would lose.

    Raises:
        InputError: it is no text.
    """
    if not isinstance(printed, str):
        raise InputError(f'numbers are written as text, with the digits as printed, such as "1.380"; it is {printed!r}')
    return printed


def _plain(shown: Any) -> Any:
    if isinstance(shown, Branches):
        return ["; ".join(", ".join(f"{c.lhs} = {c.rhs}" for c in branch) for branch in shown.conditions)]
    if isinstance(shown, Names):
        return ", ".join(shown.names)
    if isinstance(shown, NotZero):
        return f"{shown.expression} != 0"
    return shown.vector if isinstance(shown, Line) else shown


def _text(printed: Any) -> str:
    return printed if isinstance(printed, str) else str(printed)
