"""The command `robotics1 workspace`."""

import json
from math import pi

import pytest
from command import run


def answer(*arguments):
    ended = run("workspace", *arguments, "--json")
    assert ended.code == 0, ended
    return json.loads(ended.stdout)


def test_json_of_a_2r_has_the_numbers_of_its_annulus():
    found = answer("planar_2r", "--param", "l1=0.5", "--param", "l2=0.2")
    assert (found["area"], found["r_min"], found["r_max"]) == pytest.approx((pi * (0.49 - 0.09), 0.3, 0.7))
    assert found["volume"] is None
    assert [region["solutions"] for region in found["regions"]] == [2]
    assert {curve["kind"] for curve in found["boundary"]} == {"arc"}
    assert sorted(curve["radius"] for curve in found["boundary"]) == pytest.approx([0.3, 0.7])


def test_a_table_names_the_joints_and_limits_of_the_boundary():
    ended = run("workspace", "planar_2r", "--box", "q1=-1:1", "--box", "q2=0.5:pi/2")
    assert ended.code == 0
    rows = [[cell.strip() for cell in line.split("│")[1:3]] for line in ended.stdout.splitlines() if "│" in line]
    assert ["q2 upper", "arc, r = 1.442"] in rows
    assert {row[0] for row in rows} == {"q1 lower", "q1 upper", "q2 lower", "q2 upper"}
    assert "1 solution" in ended.stdout


def test_a_picture_is_written(tmp_path):
    assert run("workspace", "planar_2r", "--figure", str(tmp_path / "a.svg")).code == 0
    assert "</svg>" in (tmp_path / "a.svg").read_text()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["planar_2r", "--box", "q1"], "write it like q2=0.2:1.5"),
        (["planar_2r", "--box", "q7=0:1"], "q7"),
        (["planar_2r", "--task", "pose"], "PositionTask"),
    ],
)
def test_misuse_is_told_in_one_line(arguments, words):
    assert words in run("workspace", *arguments).refusal
