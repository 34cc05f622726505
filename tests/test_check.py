import json

import command
import pytest

from robotics1 import check_robot
from robotics1.dh import dh_to_urdf

BAD = """<robot name="bad">
  <link name="base"/>
  <link name="arm"/>
  <joint name="q1" type="revolute">
    <parent link="base"/>
    <child link="arm"/>
    <axis xyz="0 0 0"/>
    <limit lower="1" upper="0" velocity="1" effort="1"/>
  </joint>
</robot>
"""


@pytest.fixture
def bad(tmp_path):
    path = tmp_path / "bad.urdf"
    path.write_text(BAD)
    return path


def run(*words):
    return command.run("check", *words)


def test_every_error_is_told_with_its_line_and_the_exit_code_is_1(bad):
    result = run(bad)
    assert result.code == 1
    assert "error line 7: joint 'q1' has the axis '0 0 0', which gives no direction" in result.stdout
    assert "error line 8: joint 'q1' has its limits the wrong way round: lower 1 is above upper 0" in result.stdout
    assert "is no robot: 2 errors." in result.stdout
    answer = json.loads(run(bad, "--json").stdout)
    assert answer["sound"] is False
    assert [(error["line"], error["element"]) for error in answer["errors"]] == [(7, "q1"), (8, "q1")]


def test_a_robot_is_told_as_it_was_understood_and_agrees_with_the_other_parser():
    result = run("prr")
    assert result.code == 0
    for piece in (
        "link3 (q3)",
        "prismatic along x",
        "revolute about z",
        "tips: tool; tool: tool",
        "3 degrees of freedom",
    ):
        assert piece in result.stdout
    answer = json.loads(run("prr", "--json", "-p", "l2=0.5").stdout)
    assert answer["sound"] is True
    assert answer["fk_difference"] < 1e-14
    assert answer["joints"] == ["q1", "q2", "q3"]
    assert answer["parameters"] == {"l2": 0.5, "l3": 0.4}


def test_a_dh_table_that_is_the_robots_agrees_and_another_one_does_not(tmp_path):
    table = tmp_path / "table.csv"
    table.write_text("type,a,alpha,d,theta\nR,1.2,0,0,0\nR,0.8,0,0,0\n")
    answer = json.loads(run("planar_2r", "--dh", table, "--json").stdout)
    assert answer["dh_difference"] < 1e-14
    table.write_text("type,a,alpha,d,theta\nR,1.2,pi/2,0,0\nR,0.8,0,0,0\n")
    result = run("planar_2r", "--dh", table)
    assert result.code == 1
    assert "differs from the DH table" in result.stdout


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("a,alpha\n", "must begin with the line type,a,alpha,d,theta"),
        ("type,a,alpha,d,theta\nR,1,0\n", "has 3 values instead of 5: R,1,0"),
        ("type,a,alpha,d,theta\nR,1,0,x,0\n", "'x' is not a number"),
        (None, "there is no file"),
    ],
)
def test_a_dh_file_of_another_form_is_an_input_error(tmp_path, text, sentence):
    path = tmp_path / "table.csv"
    if text is not None:
        path.write_text(text)
    assert sentence in run("planar_2r", "--dh", path).refusal


def test_a_difference_of_the_parsers_makes_a_file_unsound(monkeypatch):
    monkeypatch.setattr("robotics1.robot.loading.difference_from_yourdfpy", lambda robot, text: 1e-3)
    found = check_robot("prr")
    assert found.fk_difference == 1e-3
    assert not found.sound
    assert found.explain() == "prr.urdf.xacro: another parser finds other poses, by up to 1.0e-03"


def test_ill_formed_xml_is_one_error_with_its_line(tmp_path):
    path = tmp_path / "arm.urdf"
    path.write_text("<robot name='a'>\n<link name='b'>\n</robot>")
    found = check_robot(path)
    (error,) = found.errors
    assert (error.line, error.message) == (3, "it is not well-formed XML: mismatched tag")
    assert found.explain() == "arm.urdf is no robot\nerror: line 3: it is not well-formed XML: mismatched tag"
    assert check_robot("planar_2r").explain() == "planar_2r.urdf.xacro is the robot 'planar_2r'"


def test_rounding_of_an_arm_of_a_million_metres_is_no_difference_of_the_parsers(tmp_path):
    """Its coordinates are known to 1e-10 m only; a metre too much is a difference of any arm."""
    file, table = tmp_path / "crane.urdf", tmp_path / "crane.csv"
    dh_to_urdf([("R", 1e6, 0.3, 7e5, 0.1), ("R", 8e5, -0.7, 0, 0.2), ("R", 1e6, 0, 3e5, 0)], file)
    assert check_robot(file).fk_difference < 1e-12
    for a, code in (("1e6", 0), ("1000001", 1)):
        table.write_text(f"type,a,alpha,d,theta\nR,{a},0.3,7e5,0.1\nR,8e5,-0.7,0,0.2\nR,1e6,0,3e5,0\n")
        assert run(file, "--dh", table).code == code
