"""Joints that turn by a fraction of another's angle: their formulas, and singular sets over several turns."""

import pickle
import re
from fractions import Fraction
from math import lcm, pi

import numpy as np
import pytest
import sympy
from hypothesis import assume, given, settings, strategies as st
from joint_kinds import mimic, urdf
from singular_arms import XY
from test_singular_set_edges import COUPLED

import robotics1 as r1

q1, q2 = sympy.symbols("q1 q2", real=True)
FRACTIONS = ("0.5", "-1.5", repr(1 / 3), repr(2 / 3), "-0.25", "1.2")
NONE = ("0.3333", "0.6667", "0.5000001", "0.33333333333", repr(pi / 6), repr(1 / 13))


def load(folder, text):
    path = folder / "arm.urdf"
    path.write_text(text, encoding="utf-8")
    return r1.load_robot(path)


def coupled(folder, multiplier, limits=""):
    text = COUPLED.format(multiplier)
    if limits:
        text = text.replace('name="b" type="continuous"', 'name="b" type="revolute"')
        text = text.replace('<origin xyz="0.5 0 0"/>', f'<origin xyz="0.5 0 0"/>{limits}')
    return load(folder, text)


def det(k, x, l1=0.5, l2=0.4, l3=0.3):
    """Return l1 l2 s2 + (1 + k) l1 l3 s(2 + k2) + k l2 l3 s(k2)."""
    return l1 * l2 * np.sin(x) + (1 + k) * l1 * l3 * np.sin((1 + k) * x) + k * l2 * l3 * np.sin(k * x)


def changes_of_sign(k, lower, upper):
    grid = np.linspace(lower, upper, 40001) + 0.001234
    signs = np.sign(det(k, grid))
    return grid[1:][signs[1:] != signs[:-1]]


@pytest.mark.parametrize("multiplier", FRACTIONS)
def test_a_joint_at_a_fraction_of_another_has_the_formulas_of_its_closed_form(tmp_path, multiplier):
    robot = coupled(tmp_path, multiplier)
    k = sympy.Rational(Fraction(multiplier).limit_denominator(12))
    found = r1.formulas(robot, XY)
    angles = (q1, q1 + q2, q1 + (1 + k) * q2)
    lengths = (sympy.Rational(1, 2), sympy.Rational(2, 5), sympy.Rational(3, 10))
    for entry, wave in zip(found.value, (sympy.cos, sympy.sin), strict=True):
        assert sympy.expand(entry - sum(x * wave(a) for x, a in zip(lengths, angles, strict=True))) == 0
    values = np.linspace(-20, 20, 41)
    ours = sympy.lambdify(q2, found.determinant)(values)
    assert np.abs(ours - det(float(k), values)).max() < 1e-12
    assert (found.jacobian - found.value.jacobian([q1, q2])).expand() == sympy.zeros(2, 2)
    rate = found.jacobian.diff(q1) * found.qdot[0] + found.jacobian.diff(q2) * found.qdot[1]
    at = {q1: 0.3, q2: -7.1, found.qdot[0]: 0.4, found.qdot[1]: -0.6}
    assert np.abs(np.array((found.jacobian_rate - rate).xreplace(at).evalf(), dtype=float)).max() < 1e-14
    product = found.jacobian_rate * sympy.Matrix(found.qdot)
    assert np.abs(np.array((found.velocity_product - product).xreplace(at).evalf(), dtype=float)).max() < 1e-14
    assert r"\cos{\left(" in sympy.latex(found.determinant)


@pytest.mark.parametrize("multiplier", FRACTIONS)
def test_written_python_of_an_arm_with_a_fraction_is_the_jacobian_and_its_rate(tmp_path, multiplier):
    robot = coupled(tmp_path, multiplier)
    found = r1.formulas(robot, XY)
    names = {}
    for name in ("value", "jacobian", "determinant", "jacobian_rate", "velocity_product"):
        exec(found.python(name), names)
    q, qdot = np.array([0.7, 9.3]), np.array([0.5, -0.8])
    J = XY.jacobian(robot, q)
    assert np.allclose(names["value"](q), XY.value(robot, q), rtol=0, atol=1e-12)
    assert np.allclose(names["jacobian"](q), J, rtol=0, atol=1e-12)
    assert names["determinant"](q) == pytest.approx(np.linalg.det(J), abs=1e-12)
    h = 1e-5
    rate = (XY.jacobian(robot, q + h * qdot) - XY.jacobian(robot, q - h * qdot)) / (2 * h)
    assert np.allclose(names["jacobian_rate"](q, qdot), rate, rtol=0, atol=1e-9)
    assert np.allclose(names["velocity_product"](q, qdot), rate @ qdot, rtol=0, atol=1e-9)


@pytest.mark.parametrize("multiplier", FRACTIONS[:4])
def test_a_singular_set_goes_over_all_turns_that_bring_the_followers_back(tmp_path, multiplier):
    found = r1.find_singularities(coupled(tmp_path, multiplier), XY, method="symbolic", samples=10)
    fraction = Fraction(multiplier).limit_denominator(12)
    k, turns = float(fraction), fraction.denominator
    grid = changes_of_sign(k, -turns * pi, turns * pi)
    values = sorted(branch.q[1] for branch in found.branches)
    assert found.complete
    assert np.abs(det(k, np.array(values))).max() < 1e-12
    assert np.allclose(values, grid, rtol=0, atol=2 * turns * 2 * pi / 40000)
    assert f"back after {turns} turns of it" in found.explain()
    for branch in found.branches:
        for equation in branch.conditions:
            number = complex((equation.lhs - equation.rhs).subs(q2, branch.q[1]))
            assert abs(np.exp(1j * number / turns) - 1 if equation.lhs == q2 else number) < 1e-9
        assert branch.contains(branch.q + np.array([0.3, 2 * pi * turns]))
        assert abs(det(k, branch.q[1] + 2 * pi)) < 1e-9 or not branch.contains(branch.q + np.array([0.3, 2 * pi]))


@pytest.mark.parametrize("multiplier", ["0.5", repr(1 / 3)])
def test_numbers_alone_find_the_same_singularities_as_formulas(tmp_path, multiplier):
    robot = coupled(tmp_path, multiplier)
    exact, numeric = (r1.find_singularities(robot, XY, method=m, samples=60) for m in ("symbolic", "numeric"))
    assert np.allclose(*(sorted(b.q[1] for b in each.branches) for each in (exact, numeric)), rtol=0, atol=1e-7)


@pytest.mark.parametrize(("lower", "upper"), [(-pi, pi), (-2 * pi, 2 * pi), (1, 8), (-1, 0.5), (5, 30)])
def test_joint_limits_leave_those_singularities_that_are_inside(tmp_path, lower, upper):
    """Where the limits allow more than the two turns of a circle, each place is listed once."""
    robot = coupled(tmp_path, "0.5", f'<limit lower="{lower}" upper="{upper}" velocity="1" effort="1"/>')
    found = r1.find_singularities(robot, XY, samples=10)
    everywhere = changes_of_sign(0.5, -2 * pi, 2 * pi)
    wanted = {
        round(float(np.angle(np.exp(0.5j * x))), 2)
        for x in everywhere
        for n in (-1, 0, 1, 2, 3)
        if lower - 1e-9 <= x + 4 * pi * n <= upper + 1e-9
    }
    assert found.complete
    assert all(lower <= branch.q[1] <= upper for branch in found.branches)
    ours = {round(float(np.angle(np.exp(0.5j * branch.q[1]))), 2) for branch in found.branches}
    assert len(ours) == len(found.branches) == len(wanted)
    assert np.allclose(np.exp(1j * np.array(sorted(ours, key=abs))).real, np.cos(sorted(wanted, key=abs)), atol=0.02)


@given(
    st.lists(st.fractions(-3, 3, max_denominator=4), min_size=1, max_size=2),
    st.lists(st.integers(0, 2), min_size=4, max_size=4),
    st.sampled_from([0.0, 0.3, pi / 2]),
)
@settings(max_examples=8, deadline=None)
def test_spatial_arms_with_followers_of_any_small_fraction_agree_with_pinocchio(tmp_path_factory, multipliers, axes, b):
    """Every formula is compared with Pinocchio when it is asked for; here once more, many turns away."""
    assume(lcm(*(k.denominator for k in multipliers)) <= 12)
    along = [f'<axis xyz="{" ".join("100010001"[3 * axis :][:3])}"/>' for axis in axes]
    joints = [("a", "continuous", "base", along[0]), ("b", "continuous", "a", along[1])]
    for name, above, axis, k in zip("cd", "bc", along[2:], multipliers, strict=False):
        joints.append((name, "continuous", above, axis, mimic("ab"[len(joints) % 2], repr(float(k)), b)))
    robot = load(
        tmp_path_factory.mktemp("spatial"), re.sub(' rpy="[^"]*"', "", urdf(*joints, ("tool", "fixed", joints[-1][0])))
    )
    task = r1.PositionTask()
    found = r1.formulas(robot, task)
    f = sympy.lambdify(found.q, found.value.row_join(found.jacobian))
    q = np.array([17.3, -23.9])
    ours = np.asarray(f(*q), dtype=float)
    assert np.allclose(ours, np.column_stack([task.value(robot, q), task.jacobian(robot, q)]), rtol=0, atol=1e-9)


@pytest.mark.parametrize("multiplier", NONE)
def test_a_multiplier_that_is_no_small_fraction_is_not_taken_for_one(tmp_path, multiplier):
    """0.3333 is not 1/3: at q2 = 20 rad the follower would be wrong by 7e-4 rad."""
    robot = coupled(tmp_path, multiplier)
    with pytest.raises(r1.FormulaError, match=rf"joint 'c' turns by {float(multiplier):.15g} times the angle of 'b'"):
        r1.formulas(robot, XY)
    with pytest.raises(r1.FormulaError, match="no fraction with a denominator up to 12"):
        r1.find_singularities(robot, XY, method="symbolic")
    found = r1.find_singularities(robot, XY, samples=40)
    k = float(multiplier)
    assert (found.method, found.complete) == ("numeric", False)
    assert [abs(det(k, branch.q[1])) < 1e-9 for branch in found.branches] == [True] * len(found.branches)
    assert max(branch.q[1] for branch in found.branches) > pi
    assert "No number of turns of b" in found.explain()


def test_followers_that_are_back_together_after_too_many_turns_only_are_named(tmp_path):
    text = urdf(
        ("a", "revolute", "base"),
        ("b", "revolute", "a", mimic("a", 0.2)),
        ("c", "revolute", "b", mimic("a", repr(1 / 7))),
        ("tool", "fixed", "c"),
    )
    with pytest.raises(r1.FormulaError, match="follow 'a' are not back together after 12 turns"):
        r1.formulas(load(tmp_path, text), r1.PositionTask())


def test_a_slide_that_follows_a_slide_by_any_multiple_has_formulas(tmp_path):
    text = urdf(
        ("a", "prismatic", "base"),
        ("b", "prismatic", "a", mimic("a", 0.3333, 0.1)),
        ("c", "revolute", "b"),
        ("tool", "fixed", "c"),
    )
    robot = load(tmp_path, text)
    task = r1.PositionTask()
    found = r1.formulas(robot, task)
    q = np.array([0.4, -0.9])
    ours = np.array(found.jacobian.subs(dict(zip(found.q, q, strict=True))).evalf(), dtype=float)
    assert np.allclose(ours, task.jacobian(robot, q), rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("kinds", "words"), [(("revolute", "prismatic"), "slides by 0.2"), (("prismatic", "revolute"), "turns by 0.2")]
)
def test_a_joint_that_follows_one_of_the_other_kind_has_no_formulas_and_is_named(tmp_path, kinds, words):
    text = urdf(("a", kinds[0], "base"), ("b", kinds[1], "a", mimic("a", 0.2)), ("tool", "fixed", "b"))
    with pytest.raises(r1.FormulaError, match=f"joint 'b' {words} times the (angle|length) of 'a'"):
        r1.formulas(load(tmp_path, text), r1.PositionTask())


def test_followers_off_the_way_to_the_tool_do_not_count(tmp_path):
    """A gripper's finger with multiplier 0.3333 on a joint of the arm changes nothing of the arm's formulas."""
    text = COUPLED.format(1).replace("</robot>", "") + (
        '<link name="finger"/><joint name="f" type="continuous"><parent link="1"/><child link="finger"/>'
        '<axis xyz="0 0 1"/><mimic joint="b" multiplier="0.3333"/></joint></robot>'
    )
    path = tmp_path / "arm.urdf"
    path.write_text(text, encoding="utf-8")
    robot = r1.load_robot(path, tool="tool")
    found = r1.find_singularities(robot, XY, method="symbolic", samples=10)
    assert [round(branch.q[1], 3) for branch in found.branches] == [-2.133, 0.0, 2.133, 3.142]
    with pytest.raises(r1.FormulaError, match=r"turns by 0\.3333 times"):
        r1.formulas(robot, r1.PositionTask(reference="finger"))


def test_axes_of_a_link_that_turns_by_a_half_have_formulas(tmp_path):
    text = COUPLED.format(1).replace("</robot>", "") + (
        '<link name="finger"/><joint name="f" type="continuous"><parent link="1"/><child link="finger"/>'
        '<axis xyz="0 0 1"/><mimic joint="b" multiplier="0.5"/></joint></robot>'
    )
    path = tmp_path / "arm.urdf"
    path.write_text(text, encoding="utf-8")
    robot = r1.load_robot(path, tool="tool")
    found = r1.formulas(robot, r1.PositionTask(reference="finger"))
    assert sympy.expand(found.value[0]).has(sympy.cos(q2 / 2))
    assert found.jacobian.shape == (3, 2)


def test_a_function_of_a_half_angle_is_read_where_a_follower_has_it_too(tmp_path):
    robot = coupled(tmp_path, "0.5")
    task = r1.FunctionTask(lambda p, R, q: [p[0] * np.cos(q[1] / 2), p[1]], 2)
    found = r1.formulas(robot, task)
    values = {q1: 0.4, q2: 11.1}
    ours = np.array(found.jacobian.subs(values).evalf(), dtype=float)
    assert np.allclose(ours, task.jacobian(robot, np.array([0.4, 11.1])), rtol=0, atol=1e-8)


def test_bases_and_meetings_of_branches_hold_over_all_turns(tmp_path):
    """N(J) and N(Jᵀ) in half angles, of a last axis that turns back by half, at each branch."""
    found = r1.find_singularities(coupled(tmp_path, "-0.5"), XY, method="symbolic", samples=10)
    for branch in found.branches:
        J = XY.jacobian(found.robot, branch.q)
        at = dict(zip((q1, q2), branch.q, strict=True))
        null, lost = (
            np.array(basis.subs(at).evalf(), dtype=float) for basis in (branch.formulas.null, branch.formulas.left_null)
        )
        assert np.abs(J @ null).max() < 1e-9 * np.abs(null).max()
        assert np.abs(J.T @ lost).max() < 1e-9 * np.abs(lost).max()
    assert r1.singularities.find_intersections(found).branches == ()
    copy = pickle.loads(pickle.dumps(found))
    assert [b.conditions for b in copy.branches] == [b.conditions for b in found.branches]


def test_a_scan_goes_over_all_turns(tmp_path):
    """At q2 = 4.7054, beyond the first turn, the coupled arm is singular: refined configurations come there too."""
    robot = coupled(tmp_path, "0.5")
    scan = r1.scan_singularities(robot, XY, samples=20000, refine=20)
    assert np.abs(scan.worst[:, 1]).max() > pi
