"""Formulas of workspaces: those of the books, and numbers at other lengths."""

from cmath import exp
from math import atan2, cos, pi, radians

import pytest
import sympy
from planar_chains import XY, XYZ

import robotics1 as r1
from robotics1.workspaces import workspace, workspace_formulas

l1, l2, l3, d = sympy.symbols("l1 l2 l3 d", real=True)
LENGTHS = {"l1": 0.5, "l2": 0.3, "l3": 0.15, "d": 0.2}


def named(rows, **limits):
    names = {word for row in rows for word in row[1:] if isinstance(word, str)}
    return r1.robot_from_dh(rows, parameters={name: LENGTHS[name] for name in names}, **limits)


def links(n, **limits):
    return named([("R", f"l{i}", 0, 0, 0) for i in range(1, n + 1)], **limits)


def test_two_links_have_the_radii_of_their_sum_and_difference_and_the_area_4_pi_l1_l2():
    found = workspace_formulas(links(2), XY)
    assert found.r_max == l1 + l2
    assert found.r_min == sympy.Abs(l1 - l2)
    assert sympy.simplify(found.area - 4 * sympy.pi * l1 * l2) == 0
    assert found.lengths == (l1, l2)
    assert "no hole if l1 = l2" in found.explain()


def test_three_links_have_the_inner_radius_of_the_exam():
    found = workspace_formulas(links(3), XY)
    book = sympy.Max(sympy.Abs(l1 - l2) - l3, sympy.Abs(l2 - l3) - l1, sympy.Abs(l1 - l3) - l2, 0)
    for values in ((1, 0.5, 0.25), (0.25, 0.5, 1), (0.5, 0.4, 0.3), (0.1, 0.9, 0.2)):
        at = dict(zip((l1, l2, l3), values, strict=True))
        assert float(found.r_min.subs(at)) == pytest.approx(float(book.subs(at)))
    assert found.r_max == l1 + l2 + l3


def test_a_scara_with_both_elbows_has_the_area_of_the_exam():
    """Links 0.4 and 0.3 m, |q1| ≤ 130°, |q2| ≤ 145°: 1.24234452 m²."""
    limits = [radians(130), radians(145)]
    rows = [("R", "l1", 0, 0, 0), ("R", "l2", 0, 0, 0)]
    arm = r1.robot_from_dh(rows, parameters={"l1": 0.4, "l2": 0.3}, lower=[-x for x in limits], upper=limits)
    found = workspace_formulas(arm, XY)
    assert found.number(found.area) == pytest.approx(1.24234452, abs=5e-9)
    assert "asin(l2/l1)" in found.explain()


def test_rp_with_an_offset_has_the_radii_of_the_exam():
    rows = [("R", "d", -pi / 2, 0, 0), ("P", 0, 0, 0, 0)]
    found = workspace_formulas(named(rows, lower=[-pi / 2, -0.8], upper=[pi / 2, 0.8]), XY)
    high = sympy.Symbol("q2_max", real=True)
    assert found.r_min == d
    assert found.r_max.subs({sympy.Symbol("q2_min", real=True): -high}) == sympy.sqrt(d**2 + high**2)
    area = pi / 2 * 0.8**2 + (0.2**2 + 0.8**2) * atan2(0.8, 0.2) - 0.2 * 0.8  # ∫ r (Δq1 + 2 acos(d/r)) dr
    assert found.number(found.area) == pytest.approx(area, rel=1e-12)
    assert "The area holds if" in found.explain()


@pytest.mark.parametrize(
    ("rows", "lower", "upper", "task"),
    [
        ([("R", "l1", 0, 0, 0), ("R", "l2", 0, 0, 0)], [-pi, -2], [pi, 2.2], XY),
        ([("R", "l1", 0, 0, 0), ("R", "l2", 0, 0, 0)], [-1, 0.2], [1.4, 2], XY),
        ([("R", "l1", 0, 0, 0), ("R", "l2", 0, 0, 0)], [-1, -0.9], [1.4, 2], XY),
        ([("R", "l1", 0, 0, 0), ("R", "l2", 0, 0, 0)], [-1, -2.5], [1.4, 2.1], XY),
        ([("R", "d", -pi / 2, 0, 0), ("P", 0, 0, 0, 0)], [-1.5, -0.3], [1.5, 0.2], XY),
        ([("R", "d", -pi / 2, 0, 0), ("P", 0, 0, 0, 0)], [-pi, -0.3], [pi, 0.8], XY),
        ([("R", "d", -pi / 2, 0, 0), ("P", 0, 0, 0, 0)], [-1, 0.1], [1, 0.8], XY),
        ([("R", "l1", 0, 0, 0), ("R", "l2", pi, 0, 0), ("P", 0, 0, 0, 0)], [-pi, -pi, 0], [pi, pi, 0.2], XYZ),
        ([("R", 0, pi / 2, "d", 0), ("R", "l1", 0, 0, 0), ("R", "l2", 0, 0, 0)], None, None, XYZ),
        ([("R", 0, pi / 2, "d", 0), ("R", 0, pi / 2, 0, pi / 2), ("P", 0, 0, 0, 0)], [-pi, -pi, 0.3], [pi, pi, 1], XYZ),
        ([("R", 0, pi / 2, 0, 0), ("P", 0, -pi / 2, 0, 0), ("R", "l1", 0, 0, 0)], [-pi, 0.2, -pi], [pi, 0.6, pi], XY),
        ([("R", "l1", 0, 0, 0), ("R", "d", pi / 2, 0, 0), ("P", 0, 0, 0, 0)], [-pi, -pi, 0.2], [pi, pi, 0.4], XY),
        ([("R", "d", pi / 2, 0.1, 0), ("R", "l1", 0, 0, 0), ("R", "l2", 0, 0, 0)], None, None, XYZ),
        ([("R", "l1", pi / 2, 0.1, 0), ("R", "d", 0, 0, 0), ("R", "l3", 0, 0, 0)], None, None, XYZ),
        ([("R", 0, pi / 2, 0.1, 0), ("R", "l1", 0, "d", 0), ("R", "l2", 0, 0, 0)], None, None, XYZ),
        ([("R", 0, pi / 2, "d", 0), ("R", "l1", 0, 0, 0), ("R", "l2", 0, 0, 0)], [-1, -pi, -pi], [1, pi, pi], XYZ),
        ([("R", 0, -pi / 2, 0.1, 0), ("R", 0, pi / 2, "d", 0), ("P", 0, 0, 0, 0)], [-pi, -pi, 0.3], [pi, pi, 1], XYZ),
        ([("R", 0, pi / 2, "d", 0), ("R", 0, pi / 2, 0, 0), ("P", 0, 0, 0, 0)], [-1, 0.3, 0.3], [0.6, 2, 1], XYZ),
    ],
)
def test_numbers_at_other_lengths_are_those_of_the_exact_workspace(rows, lower, upper, task):
    arm = named(rows, lower=lower, upper=upper)
    found = workspace_formulas(arm, task)
    other = {name: 1.37 * value + 0.01 for name, value in arm.parameters.items()}
    exact = workspace(arm.with_parameters(other), task)
    values = dict(found.values) | other
    checked = 0
    for name in ("r_min", "r_max", "area", "volume"):
        formula = getattr(found, name)
        if formula is not None:
            at = {s: values[s.name] for s in formula.free_symbols}
            assert float(formula.subs(at)) == pytest.approx(getattr(exact, name), rel=1e-9, abs=1e-12)
            checked += 1
    assert checked >= 2


@pytest.mark.parametrize("stroke", [0.1, 2.5])
def test_a_circle_along_a_stroke_has_a_void_if_the_stroke_is_short(stroke):
    box = {"q1": (-stroke / 2, stroke / 2)}
    arm = r1.load_robot("prr", parameters={"l2": 0.5, "l3": 0.2})
    found = workspace_formulas(arm, XY, box=box)
    assert found.number(found.area) == pytest.approx(workspace(arm, XY, box=box).area, rel=1e-9)
    assert "no void if the stroke" in found.explain()


def test_a_gantry_has_the_volume_of_its_strokes():
    rows = [("P", 0, pi / 2, 0, 0), ("P", 0, pi / 2, 0, pi / 2), ("P", 0, 0, 0, 0)]
    found = workspace_formulas(r1.robot_from_dh(rows, lower=[0, -1, 2], upper=[0.5, 1, 2.4]), XYZ)
    assert found.number(found.volume) == pytest.approx(0.5 * 2 * 0.4)


def test_a_shoulder_off_the_axis_that_it_does_not_reach_has_the_volume_of_a_ring():
    """Pappus: the annulus of l2 + l3 and l2 − l3 about a circle of radius l1."""
    rows = [("R", "l1", pi / 2, 0, 0), ("R", "l2", 0, 0, 0), ("R", "l3", 0, 0, 0)]
    found = workspace_formulas(named(rows), XYZ)
    assert sympy.simplify(found.volume - 2 * sympy.pi * l1 * 4 * sympy.pi * l2 * l3) == 0
    assert found.r_max == l1 + l2 + l3
    assert "if l2 + l3 <= l1" in found.explain()


def test_a_polar_arm_with_limits_has_the_volume_of_a_sector_of_a_shell():
    rows = [("R", 0, pi / 2, "d", 0), ("R", 0, pi / 2, 0, 0), ("P", 0, 0, 0, 0)]
    found = workspace_formulas(named(rows, lower=[-1, 0.3, 0.3], upper=[0.6, 2, 1]), XYZ)
    assert found.number(found.volume) == pytest.approx(1.6 * (1 - 0.3**3) / 3 * (cos(0.3) - cos(2)))
    assert "one side of the axis" in found.explain()


def test_an_arm_of_skew_axes_has_no_formula_and_is_told_so():
    rows = [("R", "l1", 0.3, 0, 0), ("R", "l2", 0, 0, 0), ("R", "l3", 0, 0, 0)]
    with pytest.raises(r1.TaskError, match="no formula is known"):
        workspace_formulas(named(rows), XYZ)
    limited = [("R", "d", pi / 2, 0, 0), ("R", "l1", 0, 0, 0), ("R", "l2", 0, 0, 0)]
    with pytest.raises(r1.TaskError, match="no formula is known"):
        workspace_formulas(named(limited, lower=[-1, -1, 0.1], upper=[1, 1, 2]), XYZ)


BENT = abs(0.5 + 0.3 * exp(1.2j) + 0.15 * exp(2.4j))  # two joints at 1.2 rad


def test_three_links_with_limits_are_nearest_where_the_last_two_are_bent_most():
    known = workspace_formulas(links(3, lower=[-0.5] * 3, upper=[1.2] * 3), XY)
    assert known.number(known.r_min) == pytest.approx(BENT, rel=1e-12)
    assert str(known.r_max) == "l1 + l2 + l3"
    assert known.area is None
    assert known.conditions[0] == "r_min holds where q2 = q2_max and q3 = q3_max."


def test_three_links_of_which_the_first_turns_fully_have_the_area_of_their_annulus():
    known = workspace_formulas(links(3, lower=[-3.2, -0.5, -0.5], upper=[3.2, 1.2, 1.2]), XY)
    assert known.number(known.area) == pytest.approx(pi * (0.95**2 - BENT**2), rel=1e-12)


def test_a_circle_along_two_strokes_is_a_rounded_rectangle():
    """s t + 2 R (s + t) + π R²."""
    text = """<robot name="ppr"><link name="a"/><link name="b"/><link name="c"/><link name="d"/><link name="tool"/>
    <joint name="q1" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/>
    <limit lower="0" upper="2" velocity="1" effort="1"/></joint>
    <joint name="q2" type="prismatic"><parent link="b"/><child link="c"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="0.5" velocity="1" effort="1"/></joint>
    <joint name="q3" type="continuous"><parent link="c"/><child link="d"/><axis xyz="0 0 1"/></joint>
    <joint name="end" type="fixed"><parent link="d"/><child link="tool"/><origin xyz="0.3 0 0"/></joint></robot>"""
    known = workspace_formulas(r1.load_robot(text), XY)
    assert known.number(known.area) == pytest.approx(2 * 1.5 + 2 * 0.3 * 3.5 + pi * 0.3**2, rel=1e-12)


def test_a_joint_without_room_makes_one_link_of_two():
    """The law of cosines: l = |l1 + l2 e^{iq2}|, and the area 4 π l l3."""
    known = workspace_formulas(links(3, lower=[-pi, 0.5, -pi], upper=[pi, 0.5, pi]), XY)
    assert known.number(known.area) == pytest.approx(4 * pi * abs(0.5 + 0.3 * exp(0.5j)) * 0.15, rel=1e-9)
