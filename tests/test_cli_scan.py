import json

import numpy as np
import pytest
from arms import arm
from command import run

from robotics1 import PositionTask, scan_singularities

SCAN = ["scan", "planar_2r", "--task", "position:xy", "--samples", "2e4"]


def test_the_answer_is_that_of_the_function_in_sentences_with_the_worst_and_a_histogram():
    result = run(*SCAN, "--refine", "5")
    scan = scan_singularities(arm("planar_2r"), PositionTask("xy"), samples=20_000, refine=5)
    assert result.code == 0
    assert result.stdout.startswith(scan.explain())
    assert "The 5 nearest to singular, σ_min and q:" in result.stdout
    rows = [line.split("│")[1:4] for line in result.stdout.splitlines() if line.startswith("│")]
    assert sum(int(row[2]) for row in rows) == 20_000
    assert len(rows) <= 13


def test_the_progress_is_on_stderr_only():
    result = run(*SCAN, "--json")
    assert json.loads(result.stdout)["count"] == 20_000


def test_json_has_all_that_the_scan_has():
    measures = ["--measure", "condition", "--measure", "sigma_min"]
    answer = json.loads(run(*SCAN, *measures, "--refine", "4", "--seed", "7", "--json").stdout)
    scan = scan_singularities(
        arm("planar_2r"), PositionTask("xy"), samples=2e4, measures=("condition", "sigma_min"), refine=4, seed=7
    )
    assert (answer["rows"], answer["seed"], answer["rank"], answer["undefined"]) == (["x", "y"], 7, 2, 0)
    assert list(answer["measures"]) == ["condition", "sigma_min"]
    assert answer["worst"] == scan.worst.tolist()
    assert answer["worst_values"] == scan.worst_values.tolist()
    assert answer["measures"]["sigma_min"]["quantiles"]["0.5"] == scan.quantile(0.5, "sigma_min")
    assert sum(answer["measures"]["condition"]["histogram"]["counts"]) == 20_000
    groups = answer["refined"]["groups"]
    assert sorted(start for group in groups for start in group["starts"]) == [0, 1, 2, 3]
    assert {tuple(group["conditions"]) for group in groups} <= {("Eq(q2, 0)",), ("Eq(q2, pi)",)}


def test_the_condition_has_its_rare_values_in_the_last_row():
    result = run(*SCAN, "--measure", "condition")
    rows = [line.split("│") for line in result.stdout.splitlines() if line.startswith("│")]
    assert len(rows) == 13
    assert float(rows[-1][2]) > 1e4
    assert sum(int(row[3]) for row in rows) == 20_000


def test_a_box_in_degrees_and_the_reach_as_length():
    result = run(*SCAN, "--box", "q2=30:60", "--degrees", "--length", "reach", "--json")
    robot = arm("planar_2r")
    box = {"q2": (np.radians(30), np.radians(60))}
    scan = scan_singularities(robot, PositionTask("xy"), samples=2e4, box=box, length=robot.reach)
    answer = json.loads(result.stdout)
    assert answer["worst_values"] == scan.worst_values.tolist()
    assert answer["length"] == robot.reach


def test_several_workers_say_the_same():
    one, two = (run(*SCAN, "--json", "--workers", workers).stdout for workers in ("1", "2"))
    assert one == two


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--samples", "0"), "samples must be an integer of at least 1; it is 0"),
        (("--samples", "many"), "'many' is not a number"),
        (("--method", "gird"), "method must be one of 'random', 'sobol', 'grid'; it is 'gird'"),
        (("--measure", "sigma"), "must be one of 'sigma_min', 'condition', 'manipulability'"),
        (("--box", "q2"), "'q2' is not an interval; write it like q1=-1:pi/2"),
        (("--box", "q2=1:2:3"), "is not an interval"),
        (("--box", "q7=1:2"), "no joint named 'q7'"),
        (("--workers", "0"), "--workers must be an integer of at least 1"),
        (("--length", "-1"), "length must be a positive number"),
        (("--task", "position:z"), "no joint moves the task at all"),
    ],
)
def test_misuse_is_one_line_on_stderr_and_exit_code_2(words, message):
    assert message in run(*SCAN, *words).refusal
