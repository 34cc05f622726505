"""The worked page of an exam's file: each answer with its formulas, numbers, tables and figures, and the checks."""

import html
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import sympy
from rich.console import Console

from robotics1.data_sheet.markup import Part, equation, escaped, figure, laid_out, note, paragraphs, sentences, table
from robotics1.files import check_file, write_file
from robotics1.notation import count
from robotics1.symbolic.writing.printing import line_text

from ..comparison import Comparison
from .answer import Answer, Branches, Line, Names, NotZero, Shown
from .kinds import answered
from .printed import drawn, missed, numbers_text, print_answers, print_checks, verdict
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
        print_answers(console, self.answers)
        print_checks(console, self.comparison)
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
        parts.append(Part("checks", "Published values", _checks(comparison), verdict(comparison)))
    subtitle = "Worked answers." if exam.seed is None else f"Worked answers of variant {exam.seed}."
    return laid_out(exam.title, subtitle, parts)


def _given(exercise: Exercise) -> str:
    values = ", ".join(f"{name} = {value:g}" for name, value in exercise.names.items())
    drawn = f"Drawn for this variant: {', '.join(exercise.drawn)}." if exercise.drawn else ""
    return paragraphs(exercise.text, f"Given: {values}." if values else "") + (note(drawn) if drawn else "")


def _answer(question: Question, answer: Answer, comparison: Comparison) -> str:
    text = f"<h3>{escaped(question.name)} · {escaped(question.ask)}</h3>" + paragraphs(question.text)
    values = {sympy.Symbol(name, real=True): value for name, value in question.exercise.names.items()}
    text += "".join(_formula(name, shown, values) for name, shown in answer.formulas.items())
    listed = [(name, numbers_text(found)) for name, found in answer.numbers.items() if name not in answer.tabled]
    listed += [(name, ", ".join(words)) for name, words in answer.words.items()]
    text += table(("", "numbers"), listed) if listed else ""
    text += "".join(table(t.headings, t.rows, t.title) for t in answer.tables)
    text += sentences(answer.text) if answer.text else ""
    text += "".join(_figure(axes, f"{question.name}: {question.ask}") for axes in answer.figures)
    if answer.page:
        text += f'<iframe title="to play with" srcdoc="{html.escape(answer.page)}" loading="lazy"></iframe>'
    mine = [check for check in comparison.checks if check.exercise == question.name]
    wrong = [check for check in mine if not check.holds]
    text += note(f"{len(mine) - len(wrong)} of {count(len(mine), 'published value')} reproduced.") if mine else ""
    return text + "".join(note(missed(check)) for check in wrong)


def _figure(axes: Any, caption: str) -> str:
    return figure(lambda: axes, caption)


def _formula(name: str, shown: Shown, values: Mapping[sympy.Symbol, float]) -> str:
    if isinstance(shown.formula, Branches):
        rows = [(str(i), ", ".join(map(line_text, branch))) for i, branch in enumerate(shown.formula.conditions, 1)]
        return table(("branch", "where"), rows)
    if isinstance(shown.formula, Names):
        return paragraphs(f"{name}: {drawn(shown)}")
    label = f"<p>{escaped(name)}</p>" if name != "formula" else ""
    if isinstance(shown.formula, Line):
        return label + equation(shown.symbol, shown.formula.vector).replace(" =</p>", " = ν</p>", 1)
    if isinstance(shown.formula, NotZero):
        return label + equation("", sympy.Ne(shown.formula.expression, 0))
    return label + equation(shown.symbol, shown.formula) + _in_numbers(shown.formula, values)


def _in_numbers(formula: Any, values: Mapping[sympy.Symbol, float]) -> str:
    """Return a formula with the values of lengths and data, if nothing else is in it."""
    found = formula.subs(values)
    if found.free_symbols or not formula.free_symbols:
        return ""
    return equation(" ", found.applyfunc(sympy.N) if isinstance(found, sympy.MatrixBase) else sympy.N(found))


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
