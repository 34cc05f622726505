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


def test_a_spatial_arm_is_answered_in_space_and_a_planar_one_in_its_plane():
    space = answer("cylindrical", "--box", "q1=-1:1")
    assert space["coordinates"] != ["x", "y"] or space["volume"] is not None
    assert space["volume"] > 0
    assert answer("planar_2r")["coordinates"] == ["x", "y"]


def test_points_lines_and_circles_are_answered_in_sentences_and_numbers():
    asked = ("planar_2r", "--param", "l1=0.4", "--param", "l2=0.3", "--point", "0.3,0.2", "--point", "0.05,0")
    asked = (*asked, "--line=-1,0.05:1,0.05", "--circle")
    found = answer(*asked)
    assert found["point 0.3,0.2"]["inside"] is True
    assert len(found["point 0.3,0.2"]["q"]) == 2
    assert found["point 0.05,0"]["inside"] is False
    assert found["point 0.05,0"]["distance"] == pytest.approx(0.05)
    assert found["line"]["entering"] == [True, False, True, False]
    assert found["circle"]["radius"] == pytest.approx(0.3, rel=2e-3)
    sentences = " ".join(run("workspace", *asked).stdout.split())
    assert "The point is reached, as with q = (" in sentences
    assert "The point is not reached." in sentences
    assert "It enters at t = 0.15" in sentences
    assert "fits; none with a radius above" in sentences


def test_a_slice_is_answered_with_its_rings():
    found = answer("ur5", "--slice", "0,0,0.3:0,0,1")["slice 0,0,0.3:0,0,1"]
    (inner, outer), *more = found["radii"]
    assert not more
    assert found["area"] == pytest.approx(pi * (outer**2 - inner**2))
    assert outer == pytest.approx(0.926, abs=0.02)
    assert "It is the ring from" in found["explanation"]


def test_every_orientation_is_answered_with_radii():
    found = answer(
        "prr", "--param", "l2=0.5", "--param", "l3=0.05", "--task", "position:xy", "--box", "q1=-0.1:0.1", "--dexterous"
    )["dexterous"]
    assert found["area"] > 0
    assert "every orientation" in found["explanation"] or "dexterous" in found["explanation"]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["planar_2r", "--box", "q1"], "write it like q1=-1:pi/2"),
        (["planar_2r", "--box", "q7=0:1"], "q7"),
        (["planar_2r", "--task", "pose"], "PositionTask"),
        (["planar_2r", "--line", "1,2"], "is not a line"),
        (["planar_2r", "--point", "1,2,3"], "2"),
        (["planar_2r", "--slice", "0,0,1"], "is not a plane"),
        (["planar_2r", "--slice", "0,0,0:0,0,1"], "one in a plane"),
        (["planar_2r", "--dexterous"], "three joints or more"),
    ],
)
def test_misuse_is_told_in_one_line(arguments, words):
    assert words in run("workspace", *arguments).refusal
