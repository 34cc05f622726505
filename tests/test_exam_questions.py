"""The page that lists questions of exams: its tests exist, are short, and its numbers are those of its tables."""

import ast
import re
from pathlib import Path
from types import ModuleType

import pytest

import robotics1 as r1

HERE = Path(__file__).parent
TEXT = (HERE.parent / "docs" / "exam_questions.md").read_text(encoding="utf-8")
ANSWERED, NOT_ANSWERED = (
    re.findall(r"^\| (?!question |---)(.+) \|$", part, re.M) for part in TEXT.split("## Not answered")
)
NAMED = sorted(set(re.findall(r"`(test_\w+)::(test_\w+)`", TEXT)))


def body_of(file, name):
    """The statements of a test function, without its docstring."""
    tree = ast.parse((HERE / f"{file}.py").read_text(encoding="utf-8"))
    (function,) = (node for node in tree.body if isinstance(node, ast.FunctionDef) and node.name == name)
    return function.body[1:] if ast.get_docstring(function) else function.body


@pytest.mark.parametrize(("file", "name"), NAMED)
def test_a_named_test_exists_and_has_ten_lines_or_fewer(file, name):
    body = body_of(file, name)
    assert body[-1].end_lineno - body[0].lineno < 10


def test_each_answered_question_names_its_call_and_its_tests():
    for row in ANSWERED:
        when, question, call, tests = row.split(" | ")
        assert all((when, question)), row
        assert "`" in call, row
        assert re.fullmatch(r"`test_\w+::test_\w+`(, `test_\w+::test_\w+`)*", tests), row


def test_the_calls_are_those_of_public_names():
    spaces = [r1, *(getattr(r1, name) for name in r1.__all__ if getattr(r1, name).__class__ is ModuleType)]
    for row in ANSWERED:
        for name in re.findall(r"(?<![.\w])([A-Za-z_]\w+)\(", row.split(" | ")[2]):
            assert any(hasattr(space, name) for space in spaces), name


def test_the_numbers_at_the_top_are_those_of_the_tables():
    sentence = r"Of (\d+) questions, (\d+) of Robotics 1 .+ and (\d+) of other .+, (\d+) are answered, (\d+) are not"
    total, exams, others, answered, rest = map(int, re.search(sentence, TEXT).groups())
    assert (answered, rest) == (len(ANSWERED), len(NOT_ANSWERED))
    assert total == exams + others == answered + rest
    of_exams = [row for row in (*ANSWERED, *NOT_ANSWERED) if re.match(r"20\d\d-\d\d-\d\d", row)]
    assert len(of_exams) == exams


def test_no_question_stands_twice():
    rows = [row.split(" | ")[:2] for row in (*ANSWERED, *NOT_ANSWERED)]
    assert len(set(map(tuple, rows))) == len(rows)
