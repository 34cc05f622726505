from math import pi

import numpy as np
import pytest
from arms import ROBOTS
from command import answer, run

import robotics1 as r1


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("1.5", 1.5),
        ("-2e-3", -2e-3),
        ("pi", pi),
        ("-pi/4", -pi / 4),
        ("0.7pi", 0.7 * pi),
        ("3*π/4", 3 * pi / 4),
        ("1/2", 0.5),
        ("−1", -1.0),
    ],
)
def test_a_number_may_be_a_multiple_of_pi(text, value):
    assert answer("fk", ROBOTS / "one_joint.urdf", "--q", text)["q"] == pytest.approx([value], rel=1e-15)


@pytest.mark.parametrize("text", ["", "x", "1,5,", "--1", "1/0", "nan", "inf", "pipi", "e5"])
def test_what_is_no_number_is_refused(text):
    assert "write it like" in run("scan", "planar_2r", "--samples", text).refusal


def test_a_vector_is_separated_by_commas_or_blanks():
    assert answer("fk", "prr", "--q", "1, pi 3")["q"] == [1, pi, 3]


def test_fk_of_the_2r_is_l1_c1_plus_l2_c12():
    found = answer("fk", "planar_2r", "--q", "30,60", "--degrees", "-p", "l1=1", "-p", "l2=2")
    assert found["position"] == pytest.approx([np.cos(pi / 6), 0.5 + 2, 0])


def test_jacobian_of_the_prr_has_det_l2_c2_and_loses_rank_at_pi_half():
    assert answer("jacobian", "prr", "--task", "planar-pose", "--q", "0,1,2")["determinant"] == pytest.approx(
        0.6 * np.cos(1)
    )
    found = answer("jacobian", "prr", "--task", "planar-pose", "--q", "0,pi/2,2")
    assert found["rank"] == 2
    assert np.cross(found["null"][0], [0.6, 1, -1]) == pytest.approx(np.zeros(3), abs=1e-12)


def test_symbolic_jacobian_of_the_prr_has_its_minors_in_formulas():
    found = answer("jacobian", "prr", "--task", "position:xy", "--symbolic")
    assert found["value"] == ["l2*cos(q2) + l3*cos(q2 + q3) + q1", "l2*sin(q2) + l3*sin(q2 + q3)"]
    assert found["minors"]["det J without q1"] == "l2*l3*sin(q3)"
    latex = run("jacobian", "cylindrical", "--task", "position", "--latex")
    assert "\\cos{\\left(q_{2} \\right)}" in latex.stdout
    text = run("jacobian", "cylindrical", "--task", "position", "--symbolic")
    assert "det J =\n-q₃" in text.stdout


def test_rows_y_and_wz_of_a_2r_have_the_determinant_l1_c1():
    """ẏ = (l1 c1 + l2 c12) q̇1 + l2 c12 q̇2, ωz = q̇1 + q̇2: det = l1 c1; in symbols and in numbers."""
    words = ["jacobian", "planar_2r", "--task", "pose", "--rows", "y,wz", "-p", "l1=1.5"]
    found = answer(*words, "--q", "0.4,0.9")
    assert found["jacobian"][1] == [1, 1]
    assert found["determinant"] == pytest.approx(1.5 * np.cos(0.4))
    assert answer(*words, "--symbolic")["minors"] == {"det J": "l1*cos(q1)"}
    printed = run(*words, "--q", "0.4,0.9").stdout
    assert "ωz" in printed
    assert "ωx" not in printed


def test_a_point_of_the_tool_is_a_longer_last_link():
    """0, 0.3, 0 in the tool's axes: p = p_tool + 0.3 (−s12, c12); a name that has no value is for formulas only."""
    q = "0.4,0.9"
    words = ["jacobian", "planar_2r", "--task", "position:xy", "--point"]
    moved, plain = answer(*words, "0,0.3,0", "--q", q), answer(*words[:-1], "--q", q)
    turned = -0.3 * np.array([np.cos(1.3), np.sin(1.3)])
    assert np.subtract(moved["jacobian"], plain["jacobian"]) == pytest.approx(np.column_stack([turned, turned]))
    value = answer(*words, "0,d,0", "--symbolic")["value"]
    assert value == ["-d*sin(q1 + q2) + l1*cos(q1) + l2*cos(q1 + q2)", "d*cos(q1 + q2) + l1*sin(q1) + l2*sin(q1 + q2)"]


def test_angles_give_the_analytic_jacobian_of_a_pose():
    """The arm lifts by q2 + q3 and turns by q1: yaw φ1 = q1, pitch φ2 = −(q2 + q3), roll 0."""
    words = ["jacobian", str(ROBOTS / "anthropomorphic.urdf.xacro"), "--task", "orientation", "--angles", "ZYX"]
    found = answer(*words, "--q", "0.4,0.9,-0.3")
    assert np.array(found["jacobian"]) == pytest.approx(np.array([[1, 0, 0], [0, -1, -1], [0, 0, 0]]), abs=1e-12)
    assert answer(*words, "--symbolic", "--rows", "φ1")["jacobian"] == [["1", "0", "0"]]


def test_statics_balances_minus_J_transposed_f():
    found = answer("statics", "prr", "--task", "position:xy", "--q", "0.5,pi/2,pi", "--force", "3,1")
    assert found["torque"] == pytest.approx([-3, 0.6, -1.2])
    assert found["within_limits"] == [True, True, True]


def test_manipulability_of_the_2r_is_l1_l2_sin_q2_with_its_ellipse(tmp_path):
    """J J^T of l1 = 1.2, l2 = 0.8 by hand; at full speeds of the joints the corner (1, 1) or (1, -1) is the fastest."""
    q, picture = np.array([0.3, 1.1]), tmp_path / "ellipses.svg"
    x, y = 1.2 * np.cos(0.3) + 0.8 * np.cos(1.4), 1.2 * np.sin(0.3) + 0.8 * np.sin(1.4)
    J = np.array([[-y, -0.8 * np.sin(1.4)], [x, 0.8 * np.cos(1.4)]])
    words = ["manipulability", "planar_2r", "--q", "0.3,1.1", "--along", "1,0", "--figure", str(picture)]
    found = answer(*words)
    assert found["measure"] == pytest.approx(1.2 * 0.8 * np.sin(q[1]))
    assert found["velocity_lengths"] == pytest.approx(np.linalg.svd(J)[1])
    assert np.multiply(found["force_lengths"], found["velocity_lengths"]) == pytest.approx(np.ones(2))
    assert found["transmission"]["force"] == pytest.approx(1 / np.linalg.norm(J.T @ [1, 0]))
    V = r1.load_robot("planar_2r").max_velocity
    assert found["largest_speed"] == pytest.approx(max(np.linalg.norm(J @ (V * [1, s])) for s in (1, -1)))
    assert picture.read_text(encoding="utf-8").startswith("<?xml")
    assert "along u: velocity" in run(*words).stdout


def test_singularities_of_the_2r_are_q2_zero_and_pi():
    found = answer("singularities", "planar_2r", "--task", "position:xy")
    assert [branch["values"]["q2"] for branch in found["branches"]] == [0, pi]
    assert [branch["conditions"] for branch in found["branches"]] == [["Eq(q2, 0)"], ["Eq(q2, pi)"]]


def test_view_writes_a_page(tmp_path):
    page = tmp_path / "prr.html"
    assert answer("view", "prr", "--q", "0.1,0.2,0.3", "--out", str(page))["files"] == [str(page)]
    assert "<title>prr</title>" in page.read_text(encoding="utf-8")


def test_a_configuration_outside_the_limits_is_said_and_answered():
    result = run("fk", "prr", "--q", "5,0,0")
    assert result.code == 0
    assert "q1 = 5 is outside its limits [-2, 2]" in result.stdout


@pytest.mark.parametrize(
    "words",
    [
        ["fk", "prr", "--q", "0.5,1,2"],
        ["jacobian", "prr", "--task", "position:xy", "--q", "0,pi/2,0"],
        ["statics", "prr", "--task", "position:xy", "--q", "0,pi/2,0", "--force", "900,1"],
        ["singularities", "planar_2r", "--task", "position:xy"],
        ["ik", "prr", "--task", "position:xy", "--target", "0.4,0.5"],
        ["ik", "planar_2r", "--task", "position:xy", "--target", "1,1", "--method", "gradient", "--q0", "1,1"],
        ["view", "cylindrical", "--out", "page.html"],
    ],
)
def test_every_command_prints_for_people(words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result = run(*words)
    assert result.code == 0, result
    assert result.stdout.strip()


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        (["fk", "prrr"], "no robot named 'prrr'; did you mean 'prr'"),
        (["fk", "prr", "--frame", "tol"], "no frame of robot 'prr' named 'tol'; did you mean 'tool'?"),
        (["fk", "prr", "--q", "1,2"], "q must have shape (3,), one number for each of q1, q2, q3; it has shape (2,)"),
        (["fk", "prr", "-p", "l9=3"], "no parameter of prr.urdf.xacro named 'l9'; there is 'l2', 'l3'"),
        (["fk", "prr", "-p", "l2"], "'l2' is not a parameter; write it like l2=0.5"),
        (["fk", "nowhere/arm.urdf"], "nowhere/arm.urdf: there is no such file"),
        (["jacobian", "prr", "--task", "poze"], "there is no task 'poze'; there is position"),
        (["jacobian", "cylindrical", "--task", "planar-pose"], "robot 'cylindrical' leaves the xy plane"),
        (["jacobian", "prr", "--rows", "wq"], "no row of the task named 'wq'"),
        (["jacobian", "prr", "--rows", "x,x"], "rows must be distinct"),
        (["jacobian", "prr", "--rows", ","], "rows must be names such as"),
        (["jacobian", "prr", "--point", "0,0,d"], "d of the point has no value; type a number, or ask for --symbolic"),
        (["jacobian", "prr", "--point", "0,1"], "point must have shape (3,)"),
        (["jacobian", "prr", "--point", "0,1,2d"], "'2d' is not a number"),
        (["jacobian", "prr", "--angles", "XXY"], "XXY"),
        (["jacobian", "prr", "--task", "position", "--angles", "ZYZ"], "has no angles; orientation and pose have"),
        (["ik", "prr", "--target", "1,2"], "for a position add --task position:xy"),
        (["ik", "prr", "--task", "pose", "--target", "1,2"], "or 4 × 4 numbers row by row; it has 2 numbers"),
        (["view", "prr", "--out", "nowhere/page.html"], "there is no folder nowhere"),
    ],
)
def test_misuse_is_one_line_on_stderr_and_exit_code_2(words, sentence):
    assert sentence in run(*words).refusal


@pytest.mark.parametrize("speed", [0, 1e-3, 2])
def test_a_file_whose_velocity_limits_are_zero_has_a_manipulability_without_a_largest_speed(tmp_path, speed):
    """w = l1 l2 |sin q2| of a planar 2R; a limit of 0 says nothing of how fast the joint is."""
    joint = (
        '<joint name="q{0}" type="revolute"><parent link="{0}"/><child link="{1}"/><origin xyz="{2} 0 0"/>'
        '<axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="{3}"/></joint>'
    )
    file = tmp_path / "arm.urdf"
    file.write_text(
        '<robot name="arm"><link name="1"/><link name="2"/><link name="3"/><link name="tool"/>'
        + joint.format(1, 2, 0, speed)
        + joint.format(2, 3, 0.5, speed)
        + '<joint name="t" type="fixed"><parent link="3"/><child link="tool"/><origin xyz="0.4 0 0"/></joint></robot>'
    )
    found = answer("manipulability", file, "--q", "0.3,pi/2", "--json")
    assert found["measure"] == pytest.approx(0.2)
    assert (found["largest_speed"] is None) == (speed == 0)
