"""Exams written as a TOML file: the exam of 13 January 2025, variants of it, and files in which something is wrong."""

import re
from html import unescape
from pathlib import Path

import pytest
from command import answer, run
from exams.from_file.kinds import KINDS
from exams.from_file.reading import read_exam
from exams.from_file.worked import work_file
from pages import OpenPage

from robotics1 import InputError

EXAM = Path(__file__).parents[1] / "examples" / "exams" / "exam_2025_01_13.toml"
QUESTION = """[[exercise]]
robot = "planar_2r"
lengths = { l1 = 0.7 }
data = { v = 1.5 }
[[exercise.question]]
ask = "jacobian"
task = "position:xy"
"""


@pytest.fixture(scope="module")
def worked(tmp_path_factory):
    return work_file(EXAM, tmp_path_factory.mktemp("exam") / "exam.html")


def file_of(folder, text):
    path = folder / "exam.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_rendez_vous_is_that_of_a_hand_calculation(worked):
    meeting = next(answer for question, answer in worked.answers if question.ask == "rendezvous")
    assert meeting.numbers["time"] == pytest.approx([2 / (1.5 * 0.9659258262890683)])
    assert meeting.numbers["position"] == pytest.approx([0, 1 + 2 * 0.2679491924311227])


def test_the_page_has_each_question_with_its_formulas_and_the_verdict(worked):
    html = worked.files[0].read_text(encoding="utf-8")
    text = unescape(re.sub("<[^>]*>", " ", html))
    for question, _ in worked.answers:
        assert f"{question.name} · {question.ask}" in text
    assert html.count("<math") >= 15
    assert f"{len(worked.comparison.checks)} of {len(worked.comparison.checks)} published values reproduced" in text
    assert "default-src 'none'" in html


def test_a_browser_shows_the_page_without_a_fault(browser, worked):
    page = OpenPage(browser, worked.files[0], 390, 844, sheet=True)
    assert page.tab.evaluate("document.documentElement.scrollWidth") <= 390
    assert page.faults == []
    page.keep("exam-390")


def test_a_variant_depends_on_its_seed_alone_stays_in_its_ranges_and_keeps_the_formulas(tmp_path):
    first, again, other = (work_file(EXAM, tmp_path / "v.html", seed) for seed in (3, 3, 4))
    values = [[exercise.names for exercise in one.exam.exercises] for one in (first, again, other)]
    assert values[0] == values[1] != values[2]
    assert 0.4 <= values[0][0]["l2"] <= 0.8
    assert values[0][2]["v"] != 1.5 or values[0][2]["delta"] != 15
    assert first.all_hold
    assert {check.agreement for check in first.comparison.checks} == {"formula"}
    assert len(first.comparison.checks) == 30
    assert first.exam.exercises[0].robot.parameters["l2"] == values[0][0]["l2"]


def test_a_value_that_is_not_reproduced_is_a_negative_verdict(tmp_path):
    path = file_of(tmp_path, QUESTION + 'q = [0, "pi/2"]\npublished = { value = "-0.8 -0.8 0.75 0", rank = "2" }\n')
    ended = run("exam", path, "-o", tmp_path / "page.html")
    assert ended.code == 1
    assert "Not reproduced: 1.1 value[3], printed 0.75, computed 0.7" in ended.stdout
    assert "4 of 5 published values reproduced" in ended.stdout


def test_each_kind_of_question_has_an_answer(tmp_path):
    planar = 'robot = "planar_2r"\n'
    asked = {
        "inverse kinematics": 'task = "position:xy"\ntarget = [0.5, "l1/2"]\npublished = { count = "2" }',
        "least time": 'from = [0, 0]\nto = [1, 0.5]\nmax_velocity = [1, 1]\nmax_acceleration = [2, 2]\n'
        'published = { time = "1.5" }',
        "cubic": 'from = [0, 0]\nto = [1, 2]\ntime = 2\npublished = { coefficients = "0 0 3 -2 0 0 6 -4" }',
        "workspace": 'task = "position:xy"\npublished = { "largest reach" = "2" }',
        "torque": 'task = "position:xy"\nforce = [1, 0]\nq = [0, "pi/2"]\npublished = { value = "0.8 0.8" }',
    }  # fmt: skip
    text = f"[[exercise]]\n{planar}" + "".join(
        f'[[exercise.question]]\nask = "{kind}"\n{given}\n' for kind, given in asked.items()
    )
    found = answer("exam", file_of(tmp_path, text), "-o", tmp_path / "page.html")
    assert all(check["agreement"] for check in found["checks"])
    assert set(asked) <= set(KINDS)


BAD = {
    "no TOML": ("[[exercise]\n", ":1: it is no TOML"),
    "a formula without quotes": (QUESTION + "q = [0, pi/2]\n", ":8: it is no TOML: Invalid value: q = "),
    "one pair of brackets": (QUESTION.replace("[[exercise]]", "[exercise]"), ":1: one pair of brackets is too few"),
    "nothing": ("", ":1: there is no [[exercise]] here"),
    "no question": ('[[exercise]]\nrobot = "prr"\n', ":1: there is no [[exercise.question]] here"),
    "another key": ('titel = "x"\n' + QUESTION, ":1: the exam has 'titel'; did you mean 'title'"),
    "a key of an exercise": (QUESTION.replace("lengths", "length"), ":3: exercise 1 has 'length'; did you mean"),
    "a key of a question": (QUESTION + "goal = 1\n", ":8: question 1.1 has 'goal'; known are name"),
    "a robot that is not there": (QUESTION.replace("planar_2r", "puma"), ":2: "),
    "a length that it has not": (QUESTION.replace("l1", "l7"), ":2: "),
    "a robot and a table": (QUESTION.replace("lengths", 'dh = [["R", 1, 0, 0, 0]]\nlengths'), ":3: give a robot or"),
    "a wrong table": (QUESTION.replace('robot = "planar_2r"', "dh = [[1, 2]]"), ":2: "),
    "no robot": (QUESTION.replace('robot = "planar_2r"\n', ""), ":4: question 1.1 (jacobian) needs a robot"),
    "no kind": (QUESTION.replace('ask = "jacobian"\n', ""), ":5: question 1.1 needs a kind"),
    "another kind": (QUESTION.replace('"jacobian"', '"jakobian"'), ":6: question 1.1 asks 'jakobian'; did you m"),
    "no task": (QUESTION.replace('task = "position:xy"\n', ""), ":5: question 1.1 needs a task"),
    "another task": (QUESTION.replace("position:xy", "position:uv"), ":7: question 1.1, task: "),
    "no list": (QUESTION + "q = 3\n", ":8: question 1.1, q: a list of numbers is wanted"),
    "too few joints": (QUESTION + "q = [3]\n", ":8: question 1.1, q: q must have shape (2,)"),
    "a name without a value": (QUESTION + 'q = ["w", 0]\n', ":8: question 1.1, q: 'w' has the name 'w'; known are l1"),
    "no real number": (QUESTION + 'q = ["sqrt(-1)", 0]\n', ":8: question 1.1, q: 'sqrt(-1)' is no real number"),
    "code": (QUESTION + "q = [\"__import__('os').getcwd()\", 0]\n", ":8: question 1.1, q: a formula is made of"),
    "an enormous power": (QUESTION + 'q = ["9**9**9", 0]\n', ":8: question 1.1, q: a formula must not have an exp"),
    "an unknown value": (QUESTION + 'published = { det = "1" }\n', ":8: question 1.1: nothing is called 'det'; to pub"),
    "a number as published": (QUESTION + "q = [0, 1]\npublished = { rank = 2 }\n", ":9: question 1.1, published rank"),
    "a word as published": (QUESTION + 'q = [0, 1]\npublished = { rank = "two" }\n', ":9: question 1.1, published "),
    "code as published": (QUESTION + 'published = { formula = "().__class__" }\n', ":8: question 1.1, published form"),
    "another size": (QUESTION + 'q = [0, 1]\npublished = { value = "1 2" }\n', ":9: question 1.1, published value: "),
    "a range": (QUESTION.replace("data", "vary = { l1 = [1] }\ndata"), ":4: vary: l1 must be [lowest, highest, step]"),
    "a range of nothing": (QUESTION.replace("data", "vary = { w = [1, 2, 1] }\ndata"), ":4: vary has 'w', which is"),
    "errata": (QUESTION + "errata = 3\n", ":8: question 1.1: errata must be names of published numbers"),
    "no equations": (QUESTION + 'where = "q2"\n', ":8: question 1.1, where: 'q2' is no equation"),
}  # fmt: skip


@pytest.mark.parametrize(("text", "sentence"), BAD.values(), ids=BAD)
def test_what_is_wrong_in_a_file_is_told_with_its_line(tmp_path, text, sentence):
    path = file_of(tmp_path, text)
    refusal = run("exam", path, "-o", tmp_path / "page.html").refusal
    assert refusal.startswith(f"{path}{sentence}"), refusal
    assert not (tmp_path / "page.html").exists()


def test_a_header_inside_a_text_of_several_lines_is_text(tmp_path):
    text = QUESTION.replace("[[exercise]]", '[[exercise]]\ntext = """\n[[exercise.question]]\n"""', 1) + "goal = 1\n"
    with pytest.raises(InputError, match=r"exam\.toml:11: question 1\.1 has 'goal'"):
        work_file(file_of(tmp_path, text), tmp_path / "page.html")


def test_the_command_says_what_is_missing(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert "there is no file nothing.toml" in run("exam", "nothing.toml").refusal
    assert read_exam(file_of(tmp_path, QUESTION)).title == "exam"


def test_the_file_of_the_page_on_exams_is_answered_and_its_variant_too(tmp_path):
    page = (EXAM.parents[2] / "docs" / "exams.md").read_text(encoding="utf-8")
    (text,) = re.findall(r"```toml\n(.*?)```", page, flags=re.DOTALL)
    path = file_of(tmp_path, text)
    worked = work_file(path, tmp_path / "page.html")
    assert worked.all_hold
    assert len(worked.comparison.checks) == 7
    assert work_file(path, tmp_path / "v.html", 7).exam.exercises[1].names["F"] in (5, 10, 15, 20)
    asked = set(re.findall(r"^\| `([a-z ]+)` \|", page, flags=re.MULTILINE))
    assert asked - {"ask"} == set(KINDS)
