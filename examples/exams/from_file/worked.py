"""The worked page of an exam's file: each answer with its formulas, numbers, tables and figures, and the checks."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import sympy
from rich.console import Console

from robotics1.data_sheet.layout import Part, laid_out
from robotics1.data_sheet.markup import equation, escaped, figure, note, paragraphs, sentences, table
from robotics1.files import check_file, write_file
from robotics1.notation import count, number
from robotics1.symbolic.writing.printing import line_text, unicode_text
from robotics1.terminal_tables import table as text_table

from ..comparison import Check, Comparison
from .answer import Answer, Branches, Line, Shown
from .kinds import answered
from .published import compare
from .reading import Exam, Exercise, Question, read_exam


@dataclass(frozen=True, eq=False)
class WorkedFile:
    """An exam's file with its answers.

    Attributes:
        exam: what the file asks.
        answers: of each question, in order.
        comparison: the published values beside the computed ones.
        files: what was written.
    """

    exam: Exam
    answers: list[tuple[Question, Answer]]
    comparison: Comparison
    files: tuple[Path, ...]

    @property
    def all_hold(self) -> bool:
        """Whether every published value is reproduced."""
        return not self.comparison.failures()

    def as_json(self) -> dict[str, Any]:
        """Return the numbers, the checks and the files."""
        numbers = {q.name: {key: np.ravel(x) for key, x in answer.numbers.items()} for q, answer in self.answers}
        checks = [vars(check) for check in self.comparison.checks]
        return {"numbers": numbers, "checks": checks, "files": [str(file) for file in self.files]}

    def print(self, console: Console) -> None:
        """Print the answers and the verdict on the published values."""
        for question, answer in self.answers:
            console.rule(f"{question.name}  {question.ask}")
            for name, shown in answer.formulas.items():
                console.print(f"{name}: {_drawn(shown)}", soft_wrap=True)
            for name, values in answer.numbers.items():
                if not _in_tables(name, answer):
                    console.print(f"{name}: {_numbers(values)}", soft_wrap=True)
            for t in answer.tables:
                console.print(text_table(t.headings, t.rows, t.title))
            console.print(answer.text, soft_wrap=True)
        for check in self.comparison.failures():
            console.print(_missed(check), style="red", soft_wrap=True)
        console.print(_verdict(self.comparison), style="bold")
        for file in self.files:
            console.print(f"wrote {file}", soft_wrap=True)


def work_file(
    path: Path, page: Path, seed: int | None = None, progress: Callable[[int, int], None] | None = None
) -> WorkedFile:
    """Answer the questions of a file, compare what it publishes, and write the worked page.

    Args:
        path: the exam's file.
        page: the page to write.
        seed: of a variant, whose lengths and data are drawn from the file's ranges.
        progress: called with the numbers of questions answered, and of all.

    Raises:
        InputError: something in the file is wrong, with its line, or the page cannot be written there.
    """
    check_file(page)
    exam = read_exam(path, seed)
    questions = [question for exercise in exam.exercises for question in exercise.questions]
    comparison, answers = Comparison(), []
    for done, question in enumerate(questions):
        if progress is not None:
            progress(done, len(questions))
        answers.append((question, answered(question)))
        compare(comparison, question, answers[-1][1], variant=seed is not None)
    if progress is not None:
        progress(len(questions), len(questions))
    written = write_file(page, _page(exam, answers, comparison))
    return WorkedFile(exam, answers, comparison, (written,))


def _page(exam: Exam, answers: list[tuple[Question, Answer]], comparison: Comparison) -> str:
    parts = []
    for i, exercise in enumerate(exam.exercises, 1):
        mine = [(question, answer) for question, answer in answers if question.exercise is exercise]
        content = _given(exercise) + "".join(_answer(question, answer, comparison) for question, answer in mine)
        checks = [check for q, _ in mine for check in comparison.checks if check.exercise == q.name]
        held = sum(check.holds for check in checks)
        fact = f"{count(len(mine), 'question')}; {held} of {count(len(checks), 'published value')} reproduced"
        parts.append(Part(f"exercise-{i}", exercise.title, content, fact if checks else count(len(mine), "question")))
    if comparison.checks:
        parts.append(Part("checks", "Published values", _checks(comparison), _verdict(comparison)))
    subtitle = "Worked answers." if exam.seed is None else f"Worked answers of variant {exam.seed}."
    return laid_out(exam.title, subtitle, parts)


def _given(exercise: Exercise) -> str:
    values = ", ".join(f"{name} = {value:g}" for name, value in exercise.names.items())
    drawn = f"Drawn for this variant: {', '.join(exercise.drawn)}." if exercise.drawn else ""
    return paragraphs(exercise.text, f"Given: {values}." if values else "") + (note(drawn) if drawn else "")


def _answer(question: Question, answer: Answer, comparison: Comparison) -> str:
    text = f"<h3>{escaped(question.name)} · {escaped(question.ask)}</h3>" + paragraphs(question.text)
    text += "".join(_formula(name, shown) for name, shown in answer.formulas.items())
    listed = [(name, _numbers(values)) for name, values in answer.numbers.items() if not _in_tables(name, answer)]
    text += table(("", "numbers"), listed) if listed else ""
    text += "".join(table(t.headings, t.rows, t.title) for t in answer.tables)
    text += sentences(answer.text) if answer.text else ""
    text += "".join(_figure(axes, f"{question.name}: {question.ask}") for axes in answer.figures)
    mine = [check for check in comparison.checks if check.exercise == question.name]
    wrong = [check for check in mine if not check.holds]
    text += note(f"{len(mine) - len(wrong)} of {count(len(mine), 'published value')} reproduced.") if mine else ""
    return text + "".join(note(_missed(check)) for check in wrong)


def _figure(axes: Any, caption: str) -> str:
    return figure(lambda: axes, caption)


def _in_tables(name: str, answer: Answer) -> bool:
    return bool(answer.tables) and name.startswith("k=")


def _formula(name: str, shown: Shown) -> str:
    if isinstance(shown.formula, Branches):
        rows = [(str(i), ", ".join(map(line_text, branch))) for i, branch in enumerate(shown.formula.conditions, 1)]
        return table(("branch", "where"), rows)
    label = f"<p>{escaped(name)}</p>" if name != "formula" else ""
    if isinstance(shown.formula, Line):
        return label + equation(f"{shown.symbol} = ν", shown.formula.vector).replace(" =</p>", "</p>")
    return label + equation(shown.symbol, shown.formula)


def _drawn(shown: Shown) -> str:
    if isinstance(shown.formula, Branches):
        return "; ".join(", ".join(map(line_text, branch)) for branch in shown.formula.conditions)
    formula = shown.formula.vector if isinstance(shown.formula, Line) else shown.formula
    if isinstance(formula, sympy.MatrixBase) and formula.cols > 1:
        return "\n" + unicode_text(formula)
    return line_text(formula)


def _numbers(values: Any) -> str:
    return ", ".join(number(float(value)) for value in np.ravel(values))


def _missed(check: Check) -> str:
    return f"Not reproduced: {check.name}, printed {check.printed}, computed {check.computed}."


def _checks(comparison: Comparison) -> str:
    rows = [
        (
            check.exercise,
            check.name,
            check.printed,
            check.computed if isinstance(check.computed, str) else f"{check.computed:.6g}",
            check.agreement or "differs",
        )
        for check in comparison.checks
    ]
    return table(("question", "what", "published", "computed", "agreement"), rows)


def _verdict(comparison: Comparison) -> str:
    if not comparison.checks:
        return "The file publishes no values."
    held = sum(check.holds for check in comparison.checks)
    return f"{held} of {count(len(comparison.checks), 'published value')} reproduced"
