"""What a terminal and a notebook show: one line, sentences with tables, HTML and LaTeX."""

import re
from html.parser import HTMLParser
from math import pi

import numpy as np
import pytest
from public_objects import INSTANCES
from sweeps import core_first

import robotics1 as r1
from robotics1.symbolic.writing.decimals import in_decimals

LONG = {"Intersections", "FollowedTrajectory", "PathTiming"}
EVIL = "<script>alert(1)</script>"


def test_the_repr_of_a_robot_is_one_line():
    robot = r1.load_robot("prr")
    assert repr(robot) == "Robot('prr', 3 joints PRR, tool='tool', l2=0.6, l3=0.4)"


def test_a_robot_is_a_table_of_its_joints_and_limits():
    text = str(r1.load_robot("prr"))
    assert "lengths: l2 = 0.6 m, l3 = 0.4 m" in text
    assert re.search(r"q1 +prismatic along x +-2 +2 ", text)
    assert re.search(r"q2 +revolute about z +−π +π ", text)


def test_solutions_are_a_table_with_postures_and_iterate():
    found = r1.ik_solutions("planar_2r", "position:xy", [1.2, 0.8])
    rows = str(found).splitlines()[2:]
    assert len(rows) == 1 + len(found) == 3
    assert re.search(r"0 +.*elbow (up|down)", rows[1])
    assert [tuple(q) for q in found] == [tuple(found[0]), tuple(found[1])]


def test_an_iteration_is_the_table_of_the_exam_and_iterates():
    run = r1.iterate_ik("cylindrical", "position", [1, -1, 3], [-2, 0.7 * pi, 2**0.5])
    lines = str(run).splitlines()[2:]
    assert lines[0].split() == ["k", "q", "r", "|e|", "det", "J"]
    assert len(lines) == 1 + len(run)
    assert [row.k for row in run] == list(range(len(run)))


def test_a_singular_set_iterates_and_has_latex():
    found = r1.find_singularities("prr", "planar")
    assert [branch.rank for branch in found] == [2, 2]
    assert found[1] is found.branches[1]
    assert found._repr_latex_() == (
        r"$$\begin{aligned} q_{2} = - \frac{\pi}{2} &\Rightarrow \mathrm{rank}\,J = 2 \\ "
        r"q_{2} = \frac{\pi}{2} &\Rightarrow \mathrm{rank}\,J = 2 \end{aligned}$$"
    )


def test_formulas_are_shown_as_text_latex_and_mathml():
    f = r1.formulas("prr", "planar")
    assert "det J =\nl₂⋅cos(q₂)" in str(f)
    assert r"\det J &= l_{2} \cos{\left(q_{2} \right)}" in f._repr_latex_()
    assert f._repr_html_().count("<math ") == 3


def test_a_polynomial_is_its_formula_with_a_drawing():
    cubic = r1.cubic([0, 1], [1, 2], 2.0)  # 3τ² − 2τ³ with τ = t/2
    assert str(cubic).splitlines()[:2] == [
        "x1(t) = 0.75 t² − 0.25 t³, 0 ≤ t ≤ 2",
        "x2(t) = 1 + 0.75 t² − 0.25 t³, 0 ≤ t ≤ 2",
    ]
    html = cubic._repr_html_()
    assert html.count("<polyline") == 2
    points = re.search(r'points="([^"]*)"', html)[1].split()
    assert len(points) == 200


def test_a_dh_table_is_html_and_latex():
    table = r1.dh.urdf_to_dh(r1.load_robot("planar_2r"))
    assert "<caption>standard DH table</caption>" in table._repr_html_()
    assert r"\text" not in table._repr_latex_()
    assert table._repr_latex_().count(r"\\") == 2


class Reading(HTMLParser):
    """The elements of a page."""

    def __init__(self):
        super().__init__()
        self.tags, self.open = set(), []

    def handle_starttag(self, tag, attrs):
        self.tags.add(tag)
        self.open.append(tag)

    def handle_endtag(self, tag):
        while self.open and self.open.pop() != tag:
            pass


def test_names_of_a_file_are_no_markup():
    text = r1.load_robot("planar_2r").urdf.replace('"tool"', f'"{EVIL}"'.replace("<", "&lt;").replace(">", "&gt;"))
    robot = r1.load_robot(text.replace("q1", "&lt;img src=x&gt;"))
    assert EVIL in str(robot)
    shown = [robot, r1.ik_solutions(robot, "position:xy", [1.2, 0.8]), r1.dh.urdf_to_dh(robot)]
    for one in (*shown, r1.formulas(robot, "position:xy"), r1.find_singularities(robot, "position:xy")):
        html = one._repr_html_()
        assert "<script" not in html
        assert "<img" not in html


@pytest.mark.parametrize("name", core_first(sorted(INSTANCES), set(INSTANCES) - LONG))
def test_every_public_object_has_a_repr_of_one_line_and_whole_html(name):
    for one in INSTANCES[name]():
        if not hasattr(one, "_repr_html_"):
            continue
        assert "\n" not in repr(one)
        reading = Reading()
        reading.feed(one._repr_html_())
        assert set(reading.open) <= {"rect", "polyline", "line", "mprescripts", "none", "mspace"}  # which hold nothing
        assert "script" not in reading.tags


# --- numbers


def test_coefficients_are_lengths_of_the_arm_the_largest_first():
    text = r1.find_singularities("ur5", "pose").explain()
    assert "0.425·cos(q2) + 0.39225·cos(q2 + q3) − 0.09465·sin(q2 + q3 + q4) = 0" in text
    assert "joint velocities along (0, 0.39225, −0.81725, 0.425, 0, 0) do not move the task" in text  # 0.81725 is a sum
    assert re.search(r"3–4\. q5 = 0 or π, whatever q1, q2, q3, q4 and q6", text)
    assert not re.search(r"\d{6}", text)


def test_other_coefficients_are_relative_to_the_largest():
    import sympy

    q1, q2, a = sympy.symbols("q1 q2 a", real=True)
    e = 3000 * sympy.cos(q1) - 12000 * sympy.sin(q1 + q2)
    assert in_decimals(e, []) == "sin(q1 + q2) − 0.25·cos(q1)"
    assert in_decimals(e, [0.3, 1.2]) == "1.2·sin(q1 + q2) − 0.3·cos(q1)"
    assert in_decimals(sympy.Matrix([e, 600]), [0.06, 0.3, 1.2]) == "(−1.2·sin(q1 + q2) + 0.3·cos(q1), 0.06)"
    assert in_decimals(3 * sympy.cos(q1) + 2, []) is None
    assert in_decimals(500 * a * sympy.cos(q1), []) is None


def test_one_of_several_directions_is_meant_with_or():
    text = r1.find_singularities("prr", "position:xy").explain()
    assert "joint velocities along (l2 + l3, 1, 0) or (l3, 0, 1) do not move the task" in text


def test_the_version_is_a_text():
    assert re.fullmatch(r"\d+\.\d+\.\d+.*", r1.__version__)
    assert np.size(r1.__version__) == 1


def test_a_robot_in_a_notebook_has_its_dh_tables_of_both_conventions():
    shown = r1.load_robot("ur5")._repr_html_()
    assert "standard DH table" in shown
    assert "modified DH table" in shown
    assert "0.3922" in shown
    assert "tips: base, ee_link, tool0" in shown
    assert "DH table" not in r1.load_robot("panda")._repr_html_()  # its tool is open
