"""What a terminal and a notebook show: one line, sentences with tables, HTML and LaTeX."""

import re
from functools import cache
from html.parser import HTMLParser
from math import pi

import numpy as np
import pytest
import sympy
from hypothesis import assume, example, given, strategies as st
from public_objects import INSTANCES
from sweeps import core_first

import robotics1 as r1

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


@pytest.mark.parametrize("number", [1, 2, 5])
def test_meshes_that_were_not_found_are_one_line(number):
    links = "".join(
        f'<link name="{i}"><visual><geometry><mesh filename="{i}.stl"/></geometry></visual></link>'
        for i in range(number)
    )
    joints = "".join(
        f'<joint name="q{i}" type="continuous"><parent link="{i - 1}"/><child link="{i}"/></joint>'
        for i in range(1, number)
    )
    robot = r1.load_robot(f'<robot name="arm">{links}{joints}</robot>')
    assert sum("was not found" in sentence for sentence in robot.warnings) == number
    shown = [line for line in str(robot).splitlines() if "mesh" in line]
    assert shown == [
        "warning: mesh '0.stl' was not found"
        + (f"; and {number - 1} more about meshes, in robot.warnings" if number > 1 else "")
    ]


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


@pytest.mark.parametrize(("rows", "columns"), [(2, 4), (3, 3), (5, 2), (101, 1)])
def test_a_result_without_sentences_prints_its_arrays_of_up_to_a_hundred_numbers(rows, columns):
    values = np.arange(rows * columns, dtype=float).reshape(rows, columns) / 8
    shown = str(r1.orientation.UnitQuaternions(values, 0.0))
    numbers = [float(word) for word in re.findall(r"[0-9]+\.[0-9]*", shown)]
    assert numbers == (values.ravel().tolist() if values.size <= 100 else [])
    assert ("array>" in shown) == (values.size > 100)


def test_a_least_time_prints_which_limits_are_reached():
    found = r1.minimum_time([0, 0], [1, 3], r1.MotionLimits(velocity=[1, 2], acceleration=[1, 2]))
    assert "duration: 2.5\n" in str(found)
    assert str(found).count("LimitUse(") == len(found.active)


def test_coefficients_are_lengths_of_the_arm_the_largest_first():
    text = r1.find_singularities("ur5", "pose").explain()
    assert "0.425·cos(q2) + 0.39225·cos(q2 + q3) − 0.09465·sin(q2 + q3 + q4) = 0" in text
    assert "joint velocities along (0, 0.39225, −0.81725, 0.425, 0, 0) do not move the task" in text  # 0.81725 is a sum
    assert re.search(r"3–4\. q5 = 0 or π, whatever q1, q2, q3, q4 and q6", text)
    assert not re.search(r"\d{6}", text)


def test_other_coefficients_are_relative_to_the_largest():
    q1, q2, a = sympy.symbols("q1 q2 a", real=True)
    e = 3000 * sympy.cos(q1) - 12000 * sympy.sin(q1 + q2)
    short, long = (
        r1.formulas(r1.textbook_robots.planar_arm("RR", lengths=x), "position:xy") for x in ([7, 9], [0.3, 1.2])
    )

    def shown(left, found):
        return str(found.readable(sympy.Eq(left, 0)).lhs)

    assert shown(e, short) == "sin(q1 + q2) - 0.25*cos(q1)"
    assert shown(e, long) == "1.2*sin(q1 + q2) - 0.3*cos(q1)"
    assert shown(3 * sympy.cos(q1) + 2, short) == "3*cos(q1) + 2"
    assert shown(a * sympy.cos(q1) + 1, short) == "a*cos(q1) + 1"
    half = r1.formulas(r1.textbook_robots.planar_arm("RR", lengths=[0.5, 1.2]), "position:xy")
    assert shown(sympy.cos(q2 / 2) + sympy.Rational(1, 2), half) == "cos(q2/2) + 0.5"  # 0.5 is a length, not q2/2
    assert shown(sympy.cos(5 * q2 / 12) + sympy.Rational(1, 2), half) == "cos(5*q2/12) + 0.5"


TENTHS = st.integers(1, 15)  # of a metre


@given(a1=st.integers(0, 4), a2=TENTHS, a3=TENTHS, height=TENTHS, offset=st.integers(0, 3))
@example(a1=0, a2=8, a3=7, height=4, offset=0)
@example(a1=0, a2=6, a3=3, height=2, offset=1)  # 0.2 and 0.1 have the same ratio, but other joints carry them
def test_small_whole_coefficients_are_the_lengths_that_the_joints_carry(a1, a2, a3, height, offset):
    rows = [("R", a1 / 10, pi / 2, height / 10, 0), ("R", a2 / 10, 0, offset / 10, 0), ("R", a3 / 10, 0, 0, 0)]
    assume(a2 != a3)
    sizes = [(a2, "·cos(q2)"), (a3, "·cos(q2 + q3)"), *([(a1, "")] if a1 else [])]
    found = r1.find_singularities(r1.robot_from_dh(rows), "position").explain()
    (equation,) = re.findall(r"^\d\. (.*cos\(q2 \+ q3\).*) = 0", found, re.MULTILINE)
    said = {term if term[0].isdigit() else f"1·{term}" for term in re.split(r" \+ (?!q3)", equation)}
    assert said == {f"{size / 10:g}{wave}" for size, wave in sizes}


def test_coefficients_of_angles_alone_are_no_lengths():
    wrist = [("R", 0, pi / 2, 0.2, 0), ("R", 0.1, pi / 2, 0, 0), ("R", 0, 0, 0, 0)]
    found = r1.formulas(r1.robot_from_dh(wrist), "orientation")
    whole = sympy.Eq(2 * sympy.cos(sympy.Symbol("q2", real=True)) + 1, 0)
    assert found.readable(whole) == whole


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


PUMA = [("R", 0, pi / 2, 0, 0), ("R", 0.4318, 0, 0, 0), ("R", 0.0203, -pi / 2, 0.15005, 0), ("R", 0, pi / 2, 0.4318, 0)]
PUMA += [("R", 0, -pi / 2, 0, 0), ("R", 0, 0, 0.056, 0)]
STANFORD = [("R", 0, -pi / 2, 0.412, 0), ("R", 0, pi / 2, 0.154, 0), ("P", 0, 0, 0, -pi / 2), ("R", 0, -pi / 2, 0, 0)]
STANFORD += [("R", 0, pi / 2, 0, 0), ("R", 0, 0, 0.263, 0)]
DETERMINANTS = {
    "ur5": "-0.16671⋅(0.425⋅cos(q₂) + 0.39225⋅cos(q₂ + q₃) - 0.09465⋅sin(q₂ + q₃ + q₄))⋅sin(q₃)⋅sin(q₅)",
    "ur10": "-0.35025⋅(0.612⋅cos(q₂) + 0.5723⋅cos(q₂ + q₃) - 0.1157⋅sin(q₂ + q₃ + q₄))⋅sin(q₃)⋅sin(q₅)",
    "puma": "-0.4318⋅(0.4318⋅cos(q₃) + 0.0203⋅sin(q₃))"
    "⋅(0.4318⋅sin(q₂ + q₃) - 0.4318⋅cos(q₂) - 0.0203⋅cos(q₂ + q₃))⋅sin(q₅)",
    "prr": "l₂⋅cos(q₂)",
}


@cache
def known_arm(name):
    rows = {"puma": PUMA, "stanford": STANFORD}.get(name)
    return r1.load_robot(name) if rows is None else r1.robot_from_dh(rows)


@pytest.mark.parametrize("name", DETERMINANTS)
def test_a_determinant_has_the_lengths_of_the_file_and_common_factors_out(name):
    found = r1.formulas(known_arm(name), "planar-pose" if name == "prr" else "pose")
    assert str(found).endswith(f"det J =\n{DETERMINANTS[name]}")
    shown = found.readable(found.determinant)
    if name != "prr":
        q = dict(zip(found.q, np.linspace(0.4, 1.9, 6), strict=True))
        assert float(shown.subs(q)) == pytest.approx(float(found.determinant.subs(q)), rel=1e-4)  # its five digits


FOLLOWING = [
    ["Rz(q1)", "Tz(0.3)", "Rx(0.7)", "Rz(q2)", "Tx(0.4)", "Rx(0.4)", "Rz(0.5*q2+0.2)", "Tx(0.3)", "Ry(q3)", "Tx(0.25)"],
    ["Rz(q1)", "Tx(0.3)", "Rx(pi/4)", "Rz(q2)", "Tx(0.4)", "Rx(pi/3)", "Rz(0.5*q2)", "Tx(0.2)", "Rz(q3)", "Tx(0.3)"],
    ["Rz(q1)", "Tx(0.3)", "Rx(0.7)", "Rz(q2)", "Tx(0.4)", "Rx(pi/3)", "Rz(q3)", "Tx(0.3)"],
]


@pytest.mark.parametrize("transforms", FOLLOWING)
def test_a_determinant_of_many_terms_has_coefficients_of_the_size_of_lengths(transforms):
    found = r1.formulas(r1.textbook_robots.robot_from_transforms(transforms), "position")
    shown = found.readable(found.determinant)
    outside = shown.replace(lambda e: isinstance(e, sympy.sin | sympy.cos), lambda _: sympy.Integer(1))
    assert not outside.has(sympy.Pow)
    assert all(1e-5 < abs(term.as_coeff_Mul()[0]) < 1 for term in sympy.Add.make_args(shown))
    assert not re.search(r"[1-9]\d{5}", str(found).rpartition("det J")[2])
    q = np.array([0.3, 0.7, -1.1])
    exact = np.linalg.det(found.task.jacobian(found.robot, q))
    assert float(shown.subs(dict(zip(found.q, q, strict=True)))) == pytest.approx(exact, rel=1e-3)


def test_a_wide_matrix_is_written_entry_by_entry_and_folded_in_a_notebook():
    found = r1.formulas(known_arm("ur5"), "pose")
    lines = str(found).splitlines()
    assert lines[0] == "r, 4 × 4:"
    assert "  r[3,3] = −sin(q5)·sin(q2 + q3 + q4)" in lines
    assert "  its other entries are 0" in lines
    height = next(line for line in lines if line.startswith("  r[3,4]"))
    assert height.startswith("  r[3,4] = −0.425·sin(q2) − 0.39225·sin(q2 + q3) − 0.09465·cos(q2 + q3 + q4) + 0.089159")
    assert found._repr_html_().count("<details>") == 2  # r and J, but not det J
    assert "8500" not in found._repr_html_() + found._repr_latex_()


def test_long_factors_of_an_expression_get_names():
    turned = ["Rz(q1)", "Tx(0.5)", "Rz(q2)", "Tx(0.4)", "Rz(1.2*q2)", "Tx(0.3)"]
    found = r1.formulas(r1.textbook_robots.robot_from_transforms(turned), "position:xy")
    determinant, factor = str(found).rpartition("det J = ")[2].splitlines()
    assert sorted(determinant.split("·")[1:]) == ["f1", "sin(q2/5)"]
    assert factor.startswith("  where f1 = ")


def test_equations_of_a_singular_set_are_in_metres_in_latex_too():
    found = r1.find_singularities(known_arm("ur5"), "pose")
    assert (
        r"0.425 \cos{\left(q_{2} \right)} + 0.39225 \cos{\left(q_{2} + q_{3} \right)} - 0.09465" in found._repr_latex_()
    )


def test_values_of_joints_have_four_decimals_where_they_are_no_simple_angles():
    text = str(r1.find_singularities(known_arm("puma"), "pose"))
    assert "1–2. q3 = -1.5238 or 1.6178, whatever" in text  # −atan(0.4318 / 0.0203), and half a turn more
    assert "3–4. q5 = 0 or π, whatever" in text


def test_the_coordinate_of_a_slide_stands_among_lengths():
    text = str(r1.find_singularities(known_arm("stanford"), "pose"))
    assert "(q3·sin(q5), 0.154·sin(q5), 0, −q3·sin(q5) − 0.154·cos(q4)·cos(q5), " in text
