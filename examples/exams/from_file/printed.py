"""The answers to an exam's file as text, and the verdict on its published values."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import sympy
from rich.console import Console

from robotics1.notation import count, number
from robotics1.symbolic.writing.printing import line_text, unicode_text
from robotics1.terminal_tables import table

from ..comparison import Check, Comparison
from .answer import Answer, Branches, Line, Names, NotZero, Shown
from .reading import Question


def print_answers(console: Console, answers: Iterable[tuple[Question, Answer]]) -> None:
    """Print each question with its formulas, numbers, words, tables and sentences."""
    for question, answer in answers:
        console.rule(f"{question.name}  {question.ask}")
        lines = [f"{name}: {drawn(shown)}" for name, shown in answer.formulas.items()]
        lines += [f"{name}: {numbers_text(x)}" for name, x in answer.numbers.items() if name not in answer.tabled]
        lines += [f"{name}: {', '.join(words)}" for name, words in answer.words.items()]
        for line in lines:
            console.print(line, soft_wrap=True)
        for t in answer.tables:
            console.print(table(t.headings, t.rows, t.title))
        console.print(answer.text, soft_wrap=True)


def print_checks(console: Console, comparison: Comparison) -> None:
    """Print the print errors, what is not reproduced, and the verdict."""
    for check in comparison.checks:
        if check.agreement == "erratum":
            told = f"Print error: {check.name} is printed {check.printed}, and is {check.computed:.4f}."
            console.print(told, soft_wrap=True)
    for check in comparison.failures():
        console.print(missed(check), style="red", soft_wrap=True)
    console.print(verdict(comparison), style="bold")


def drawn(shown: Shown) -> str:
    """Return a formula on one line, a matrix drawn below."""
    if isinstance(shown.formula, Branches):
        return "; ".join(", ".join(map(line_text, branch)) for branch in shown.formula.conditions)
    if isinstance(shown.formula, Names):
        return ", ".join(shown.formula.names) or "none"
    if isinstance(shown.formula, NotZero):
        return f"{line_text(shown.formula.expression)} ≠ 0"
    formula = shown.formula.vector if isinstance(shown.formula, Line) else shown.formula
    if isinstance(formula, sympy.MatrixBase) and formula.cols > 1:
        return "\n" + unicode_text(formula)
    return line_text(formula)


def numbers_text(values: Any) -> str:
    """Return numbers with four decimals."""
    return ", ".join(number(float(value)) for value in np.ravel(values))


def missed(check: Check) -> str:
    """Return the sentence about a published value that is not reproduced."""
    shown = check.computed if isinstance(check.computed, str) else f"{check.computed:.10g}"
    return f"Not reproduced: {check.name}, printed {check.printed}, computed {shown}."


def verdict(comparison: Comparison) -> str:
    """Return how many of the published values are reproduced."""
    if not comparison.checks:
        return "The file publishes no values."
    held = sum(check.holds for check in comparison.checks)
    return f"{held} of {count(len(comparison.checks), 'published value')} reproduced"
