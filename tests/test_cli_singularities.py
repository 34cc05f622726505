import json

import numpy as np
import pytest
import sympy
from command import run

from robotics1 import PlanarPoseTask, load_robot

POSE = ["singularities", "prr", "--task", "planar-pose"]


def test_the_answer_is_in_sentences_with_symbols():
    result = run(*POSE, "--intersections")
    assert result.code == 0
    assert "1–2. q2 = −π/2 or π/2, whatever q1 and q3: the rank is 2 instead of 3." in result.stdout
    assert "joint velocities along (l2, 1, −1) do not move the task" in result.stdout
    assert "These are all singular configurations." in result.stdout
    assert "No two branches meet, and nowhere does the rank fall further." in result.stdout


def test_latex_has_conditions_and_bases():
    text = run(*POSE, "--latex").stdout
    assert r"q_{2} = \frac{\pi}{2}\quad\Rightarrow\quad \mathrm{rank}\,J = 2" in text
    assert r"\mathcal{N}(J^T) = \mathrm{span}" in text
    assert text.count(r"\mathcal{R}(J)") == 2


def test_python_functions_vanish_on_the_branch_and_span_the_null_spaces():
    namespace = {}
    exec(run(*POSE, "--python").stdout, namespace)
    robot, task = load_robot("prr"), PlanarPoseTask("xy")
    q = np.array([0.3, np.pi / 2, 0.7])
    J = task.jacobian(robot, q)
    assert namespace["conditions_2"](q) == pytest.approx([0], abs=1e-15)
    assert np.abs(namespace["conditions_1"](q)).max() > 1
    assert J @ namespace["null_2"](q) == pytest.approx(np.zeros((3, 1)), abs=1e-12)
    assert namespace["left_null_2"](q).T @ J == pytest.approx(np.zeros((1, 3)), abs=1e-12)
    assert np.linalg.matrix_rank(np.hstack([namespace["range_2"](q), J]), tol=1e-9) == 2


def test_json_holds_the_branches_and_their_formulas():
    answer = json.loads(run(*POSE, "--intersections", "--json").stdout)
    assert (answer["method"], answer["complete"], answer["generic_rank"]) == ("symbolic", True, 3)
    assert answer["branches"][1]["formulas"]["left_null"] == [["0", "1", "l3*sin(q3)"]]
    assert [sympy.sympify(text) for text in answer["branches"][1]["formulas"]["null"][0]] == [sympy.Symbol("l2"), 1, -1]
    assert answer["intersections"] == answer["outside_limits"] == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--method", "numeric", "--latex"), "found by numbers, so there are no formulas"),
        (("--latex", "--python"), "choose one of --latex and --python"),
        (("--method", "guess"), "guess"),
        (("--time-limit", "-1"), "time_limit"),
    ],
)
def test_misuse_is_one_line_on_stderr_and_exit_code_2(words, message):
    assert message in run(*POSE, *words).refusal
