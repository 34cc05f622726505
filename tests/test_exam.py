"""The command `robotics1 exam` and what it says of the exam of 13 January 2025."""

import re
from html import unescape
from math import hypot, log
from pathlib import Path

import pytest
from command import answer, run
from exams.from_file.worked import work_file

EXAM = Path(__file__).parents[1] / "examples" / "exams" / "exam_2025_01_13.toml"


@pytest.fixture(scope="module")
def worked(tmp_path_factory):
    return work_file(EXAM, tmp_path_factory.mktemp("exam") / "exam.html")


def test_every_published_value_is_reproduced_and_only_two_signs_are_print_errors(worked):
    checks = worked.comparison.checks
    assert [check.name for check in worked.comparison.failures()] == []
    assert len(checks) == len({check.name for check in checks}) == 211
    assert sum(check.agreement == "formula" for check in checks) == 30
    assert [check.name for check in checks if check.agreement == "erratum"] == ["2a k=0 r[3]", "2a k=1 r[2]"]
    assert {check.agreement for check in checks} == {"rounded", "truncated", "formula", "word", "erratum"}


def test_feedback_recovers_a_small_error_and_a_large_one_wants_replanning(worked):
    near, far = (answer for question, answer in worked.answers if question.ask == "feedback gain")
    meeting = next(answer for question, answer in worked.answers if question.ask == "rendezvous")
    assert near.numbers["gain"] == pytest.approx([log(hypot(0.1, 0.1) / 1e-3) / meeting.numbers["time"][0]])
    assert (near.words["verdict"], far.words["verdict"]) == (["feedback"], ["replan"])


def test_the_page_has_pictures_the_two_arms_to_play_with_and_numbers_beside_formulas(worked):
    html = worked.files[0].read_text(encoding="utf-8")
    assert html.count("<figure>") == 4
    assert html.count("<iframe") == 1
    text = re.sub(r"\s+", " ", unescape(re.sub("<[^>]*>", " ", re.sub(r'srcdoc="[^"]*"', "", html))))
    assert "status singular" in text
    assert "time formula t rv =" in text


def test_the_command_solves_the_exam_and_writes_its_page(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run("exam")
    assert result.code == 0
    assert "211 of 211 published values reproduced" in result.stdout
    assert "Print error: 2a k=0 r[3] is printed 2, and is -2.0000." in result.stdout
    assert [path.name for path in tmp_path.iterdir()] == ["exam_2025_01_13.html"]


def test_the_command_gives_json_of_the_agreed_form(tmp_path):
    found = answer("exam", "--out", tmp_path / "a.html")
    assert set(found) == {"numbers", "checks", "files"}
    (det,) = (check for check in found["checks"] if check["name"] == "1, det formula")
    assert (det["printed"], det["computed"], det["agreement"]) == ("l2*cos(q2)", "l2*cos(q2)", "formula")
    assert all(set(check) == {"exercise", "name", "printed", "computed", "agreement"} for check in found["checks"])
    assert found["numbers"]["3"]["time"] == pytest.approx([1.3803675])


def test_the_command_exits_with_1_when_a_value_does_not_hold(tmp_path):
    text = EXAM.read_text(encoding="utf-8").replace("target = [1, -1, 3]", "target = [1, -1, 2.9]", 1)
    (tmp_path / "exam.toml").write_text(text, encoding="utf-8")
    result = run("exam", tmp_path / "exam.toml", "-o", tmp_path / "exam.html")
    assert result.code == 1
    assert "Not reproduced: 2a k=1 q[1], printed 3, computed 2.9" in result.stdout
