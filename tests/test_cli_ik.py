import re
from math import pi

import numpy as np
import pytest
import sympy
from arms import ROBOTS
from command import answer, run

from robotics1 import PositionTask, load_robot

XY = ["ik", "planar_2r", "--task", "position:xy"]
UNIT = ["-p", "l1=1", "-p", "l2=1"]


def test_ik_gives_all_solutions_or_the_table_of_a_method():
    found = answer("ik", "cylindrical", "--target", "1,-1,3")
    assert np.array(found["solutions"]) == pytest.approx(
        np.array([[3, -pi / 4, 2**0.5], [3, 3 * pi / 4, -(2**0.5)]]), abs=1e-9
    )
    newton = ["--method", "newton", "--q0", "-2,0.7pi,1.4142135623730951"]
    found = answer("ik", "cylindrical", "--target", "1,-1,3", *newton)
    assert (found["status"], found["iterations"]) == ("CONVERGED", 3)
    assert len(found["table"]) == 4


def test_ik_exits_with_1_when_there_is_no_solution_or_no_convergence():
    found = answer(*XY, "--target", "3,0", code=1)
    assert found["status"] == "UNREACHABLE"
    assert found["error_norm"] == pytest.approx(1.0, abs=1e-6)
    found = answer("ik", "cylindrical", "--target", "1,-1,3", "--method", "newton", "--q0", "2,pi/4,0", code=1)
    assert found["status"] == "SINGULAR"


def test_ik_of_a_pose_takes_the_matrix_row_by_row():
    eye = "1,0,0,2, 0,1,0,0, 0,0,1,0, 0,0,0,1"
    found = answer("ik", "planar_2r", "--task", "pose", "--target", eye)
    assert found["solutions"][0] == pytest.approx([0, 0], abs=1e-6)


def test_ik_solves_one_target_inside_the_limits_from_the_start_that_is_told():
    """(1, 1) of the 2R: cos q2 = (p² − 2)/2 = 0, so q2 = ±π/2; the start chooses the elbow."""
    words = [*XY, "--target", "1,1", "--method", "solve"]
    for q0, q in (("0.1,1.2", [0, pi / 2]), ("1.4,-1.2", [pi / 2, -pi / 2])):
        found = answer(*words, *UNIT, "--q0", q0, "--tolerance", "1e-9")
        assert (found["status"], found["starts"]) == ("CONVERGED", 1)
        assert found["q"] == pytest.approx(q, abs=1e-8)
        assert found["error_norm"] <= 1e-9
    printed = run(*words, *UNIT, "--q0", "5,70", "--degrees").stdout
    assert "90.000" in printed
    assert "by forward kinematics" in printed


def test_ik_solve_exits_with_1_and_tells_the_nearest_miss():
    words = [*XY, "--target", "0,2.5", "--method", "solve"]
    found = answer(*words, *UNIT, code=1)
    assert found["status"] == "UNREACHABLE"
    assert found["error_norm"] == pytest.approx(0.5, abs=1e-6)
    assert found["q"] == pytest.approx([pi / 2, 0], abs=1e-2)
    hole = [*XY, "--target", "0.2,0", "--method", "solve", "--time-limit", "0.01"]
    result = run(*hole, "-p", "l1=1", "-p", "l2=0.5")
    assert result.code == 1
    assert "UNREACHABLE" in result.stdout
    assert "|e| = 0.3 at" in result.stdout


def test_ik_prefers_the_middle_of_the_ranges_of_a_redundant_arm():
    """Of the q with z(q) = 1.1 it tells one nearer to the middle than the first it finds."""
    path = str(ROBOTS / "redundant.urdf")
    words = ["ik", path, "--task", "position:z", "--target", "1.1", "--method", "solve"]
    middle, first = (answer(*words, "--prefer", wish)["q"] for wish in ("middle", "any"))
    robot = load_robot(path)
    ranges = 0.5 * (robot.lower + robot.upper)
    assert np.linalg.norm(middle - ranges) < np.linalg.norm(first - ranges)


def test_ik_answers_every_target_of_a_file_in_its_order(tmp_path):
    """Degrees are read too: the planar pose (x, y, φ) has one angle."""
    path = tmp_path / "targets.csv"
    path.write_text("# x, y\n1, 1\n3, 0   # too far\n\n0.5 -0.5\n", encoding="utf-8")
    words = [*XY, "--targets", str(path), *UNIT]
    found = answer(*words, code=1)
    assert [one["status"] for one in found] == ["CONVERGED", "UNREACHABLE", "CONVERGED"]
    assert [one["error_norm"] for one in found] == pytest.approx([0, 1, 0], abs=1e-6)
    for one, target in zip(found, ([1, 1], [2, 0], [0.5, -0.5]), strict=True):
        (a, b) = one["q"]
        assert [np.cos(a) + np.cos(a + b), np.sin(a) + np.sin(a + b)] == pytest.approx(target, abs=1e-4)
    path.write_text("0.5,0.6,90\n", encoding="utf-8")
    (turned,) = answer("ik", "prr", "--task", "planar-pose", "--targets", str(path), "--degrees")
    assert np.sum(turned["q"][1:]) == pytest.approx(pi / 2, abs=1e-6)


def test_of_many_targets_those_that_were_missed_are_printed(tmp_path):
    path = tmp_path / "targets.csv"
    path.write_text("1,1\n" * 30 + "9,9\n", encoding="utf-8")
    printed = run(*XY, "--targets", str(path)).stdout
    assert "30 of 31 targets reached" in printed
    assert "│     31 │ UNREACHABLE" in printed
    assert "and 11 more" in printed


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ([], "give either --target"),
        (["--target", "1,1", "--targets", "some.csv"], "give either --target"),
        (["--targets", "some.csv"], "there is no file some.csv"),
        (["--targets", "FILE"], "targets.csv, line 2: the target must have shape \\(2,\\)"),
        (["--targets", "FILE", "--method", "newton"], "--targets is for --method solve"),
        (["--target", "1,1", "--prefer", "near"], "--prefer near is for --method solve"),
        (["--target", "1,1", "--method", "best"], "--method must be one of 'solve', 'newton'"),
        (["--target", "1,1", "--method", "solve", "--tolerance", "0"], "tolerance must be a positive number"),
        (["--target", "1,1", "--method", "solve", "--q0", "1"], "q must have shape \\(2,\\)"),
    ],
)
def test_ik_refuses_what_it_cannot_read(words, message, tmp_path):
    path = tmp_path / "targets.csv"
    path.write_text("1,1\n1,1,1\n", encoding="utf-8")
    words = [str(path) if word == "FILE" else word for word in words]
    assert re.search(message, run(*XY, *words).refusal)


def test_a_file_without_targets_or_not_of_text_is_refused(tmp_path):
    path = tmp_path / "targets.csv"
    for content, message in ((b"# none\n", "there is no target in"), (b"\xff\xfe1,1", "is no text file in UTF-8")):
        path.write_bytes(content)
        assert message in run("ik", "planar_2r", "--targets", str(path)).refusal


def test_the_bar_is_on_the_stderr_of_a_terminal_only_and_not_with_json(tmp_path, monkeypatch):
    path = tmp_path / "targets.csv"
    path.write_text("1,1\n3,0\n0.5,-0.5\n", encoding="utf-8")
    words = [*XY, "--targets", str(path), *UNIT]
    piped = run(*words)
    assert "2 of 3 targets reached" in piped.stdout
    assert "solving" not in piped.stdout + piped.stderr
    monkeypatch.setenv("FORCE_COLOR", "1")
    terminal = run(*words)
    assert "solving" in terminal.stderr
    assert "3/3" in terminal.stderr
    assert "solving" not in terminal.stdout
    assert "solving" not in str(run(*words, "--json"))


def test_a_file_of_poses_has_their_sixteen_numbers_on_each_line(tmp_path):
    """The 2R at q = (π/2, 0) points along y: R = Rz(π/2), p = (0, 2, 0)."""
    path = tmp_path / "poses.csv"
    path.write_text("0,-1,0,0, 1,0,0,2, 0,0,1,0, 0,0,0,1\n", encoding="utf-8")
    (found,) = answer("ik", "planar_2r", "--task", "pose", "--targets", str(path), *UNIT)
    assert found["status"] == "CONVERGED"
    assert found["q"] == pytest.approx([pi / 2, 0], abs=1e-5)
    path.write_text("1,0,0,2, 0,2,0,0, 0,0,1,0, 0,0,0,1\n", encoding="utf-8")
    assert "line 1: " in run("ik", "planar_2r", "--task", "pose", "--targets", str(path)).refusal


def test_misuse_ends_with_2_and_a_word_on_the_line(tmp_path):
    path = tmp_path / "targets.csv"
    path.write_text("1,1\n1,x\n", encoding="utf-8")
    assert "targets.csv, line 2: 'x' is not a number" in run(*XY, "--targets", path).refusal


def test_ik_names_the_posture_of_each_solution_and_lists_those_outside_the_limits(tmp_path):
    found = answer(*XY, *UNIT, "--target", "1,1")
    assert np.array(found["solutions"]) == pytest.approx(np.array([[0, pi / 2], [pi / 2, -pi / 2]]), abs=1e-9)
    assert found["labels"] == [["elbow down"], ["elbow up"]]
    assert found["within_limits"] == [True, True]
    assert "elbow down" in run(*XY, *UNIT, "--target", "1,1").stdout
    path = tmp_path / "limited.urdf"
    path.write_text((ROBOTS / "elbow_limited.urdf").read_text(encoding="utf-8"), encoding="utf-8")
    robot = load_robot(str(path))
    target = ",".join(map(str, np.round(r1_position(robot, [0.2, robot.upper[1] - 0.2]), 12)))
    found = answer("ik", str(path), "--task", "position:xy", "--target", target)
    assert len(found["outside_limits"]) == 1
    assert "outside the limits" in run("ik", str(path), "--task", "position:xy", "--target", target).stdout


def r1_position(robot, q):
    return PositionTask("xy").value(robot, q)


def test_ik_prints_the_formulas_of_all_solutions():
    """The 2R of lengths l1 and l2: cos q2 = (x² + y² − l1² − l2²)/(2 l1 l2), and two signs of q2."""
    printed = run(*XY, "--formulas").stdout
    assert "2 solutions" in printed
    assert "q2 = ±acos(c2)" in printed
    found = answer(*XY, "--formulas")
    names = {"x": 1.0, "y": 1.0, "l1": 1.0, "l2": 1.0}
    values = [[number(branch[q], names) for q in ("q1", "q2")] for branch in found["branches"]]
    assert sorted(values) == pytest.approx(np.array([[0, pi / 2], [pi / 2, -pi / 2]]), abs=1e-12)
    assert "--target 1,1 changes nothing for --formulas" in run(*XY, "--formulas", "--target", "1,1").refusal


def number(formula, values):
    symbols = {name: sympy.Symbol(name) for name in values}
    return float(sympy.sympify(formula, locals=symbols).subs(values))


def test_ik_writes_a_page_of_all_solutions_with_their_names(tmp_path):
    page = tmp_path / "solutions.html"
    assert f"wrote {page}" in run(*XY, *UNIT, "--target", "1,1", "--page", str(page)).stdout.replace("\n", "")
    text = page.read_text(encoding="utf-8")
    assert text.count("elbow up") == text.count("elbow down") == 1
    assert "for all solutions" in run(*XY, "--target", "1,1", "--method", "solve", "--out", str(page)).refusal
