from dataclasses import replace
from math import pi

import numpy as np
import pytest
from command import answer, run
from exams.exam_2025_01_13 import answers as exam
from exams.exam_2025_01_13.formulas import formulas_1
from exams.exam_2025_01_13.published import compare
from exams.exam_2025_01_13.worked import work_exam


@pytest.fixture(scope="module")
def worked(tmp_path_factory):
    return work_exam(tmp_path_factory.mktemp("exam"))


def test_every_published_value_is_reproduced_and_only_two_signs_are_print_errors(worked):
    checks = worked.comparison.checks
    assert worked.comparison.failures() == []
    assert len(checks) == 207
    assert len({check.name for check in checks}) == 207
    assert sum(check.agreement == "formula" for check in checks) == 29
    errata = [check.name for check in checks if check.agreement == "erratum"]
    assert errata == ["table 1, k=0, p[3]", "table 1, k=1, p[2]"]
    assert {check.agreement for check in checks} == {"rounded", "truncated", "formula", "erratum"}


def test_a_wrong_answer_is_not_reproduced(worked):
    """The comparison is no formality: each of these faults in an answer is found."""
    one, two, three = worked.one, worked.two, worked.three
    shifted = replace(two, a=replace(two.a, q=two.a.q + 1e-3))
    turned = replace(three, right=three.left)
    fewer = replace(one, point=replace(one.point, branches=one.point.branches[1:]))
    for wrong in ((one, shifted, three), (one, two, turned), (fewer, two, three)):
        assert compare(*wrong, worked.tables).failures()
    assert compare(fewer, two, three, [formulas_1(fewer)]).failures()[0].name == "p is singular where"


def test_exercise_1_holds_in_the_singular_configuration_with_positive_joint_values(worked):
    assert worked.one.q_s == pytest.approx([0.5, pi / 2, pi])
    assert worked.one.torque == pytest.approx([-3, 3 * (0.6 - 0.4), -3 * 0.4])


def test_exercise_3_feedback_recovers_a_small_error_and_a_large_one_wants_replanning(worked):
    assert worked.three.feedback.status.name == "FEEDBACK"
    assert worked.three.feedback.gain == pytest.approx(np.log(np.hypot(0.1, 0.1) / 1e-3) / worked.three.meeting.time)
    assert worked.three.too_far.status.name == "REPLAN"


def test_the_command_prints_the_answers_and_writes_figures_and_pages(tmp_path):
    result = run("exam", "--out", tmp_path / "out")
    assert result.code == 0
    assert "207 of 207 published values and formulas are reproduced" in result.stdout
    assert "SINGULAR after 1 iteration" in result.stdout
    assert "determinant of Jᵣ: det(Jᵣ) = l₂⋅cos(q₂)\n" in result.stdout
    assert (
        "\n    Jₛ = ⎢               ⎥\n         ⎣0     0      0 ⎦\n    = (1, -0.2000, 0.4000), (0, 0, 0)\n"
        in result.stdout
    )
    assert max(len(line.rstrip()) for line in result.stdout.splitlines() if not line.startswith("wrote")) <= 80
    written = sorted(path.name for path in (tmp_path / "out").iterdir())
    assert written == [
        "figure-2-right-arm-joints.svg",
        "figure-3-right-arm-path.svg",
        "figure-4-left-arm-joints.svg",
        "figure-5-left-arm-path.svg",
        "formulas.html",
        "index.html",
        "rendezvous.html",
    ]


def test_the_command_gives_json_of_the_agreed_form(tmp_path):
    found = answer("exam", "--out", tmp_path)
    assert set(found) == {"checks", "files"}
    (det,) = (check for check in found["checks"] if check["name"] == "determinant of Jᵣ")
    assert (det["printed"], det["computed"], det["agreement"]) == ("l2*cos(q2)", "l2*cos(q2)", "formula")
    assert all(set(check) == {"exercise", "name", "printed", "computed", "agreement"} for check in found["checks"])
    assert len(found["files"]) == 7


def test_the_command_exits_with_1_when_a_value_does_not_hold(tmp_path, monkeypatch):
    monkeypatch.setattr(exam, "GOAL", (1, -1, 2.9))
    result = run("exam", "--out", tmp_path)
    assert result.code == 1
    assert "not reproduced: table 1, k=1, q[1], printed 3, computed 2.9" in result.stdout
