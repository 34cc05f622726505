"""Closed formulas of every solution: against the formulas of textbooks, and against the numbers."""

import pickle
import re
import shutil
import subprocess
from functools import cache
from math import pi
from time import process_time

import numpy as np
import pinocchio as pin
import pytest
import sympy
from arms import arm
from dh_arms import (
    POLAR_ARM,
    SCARA,
    ZYZ,
    H,
    P,
    R,
    dh,
    five,
    offset_arm,
    orthogonal,
    planar_rpr,
    puma,
    shoulder_arm,
    stanford,
    ur5,
)
from hypothesis import given, settings, strategies as st

from robotics1 import (
    FormulaError,
    FunctionTask,
    InputError,
    OrientationTask,
    PlanarPoseTask,
    PoseTask,
    PositionTask,
    TaskError,
    forward_kinematics,
    ik_solutions,
    load_robot,
    robot_from_dh,
)
from robotics1.ik import ik_formulas

XYZ, XY, PLANE = PositionTask(), PositionTask("xy"), PlanarPoseTask()
x, y, z, phi = sympy.symbols("x y z phi", real=True)


def anthropomorphic():
    return dh(R(0, H, "d1"), R("a2", 0, 0), R("a3", 0, 0), d1=0.5, a2=1.5, a3=1.0)


ARMS = {
    "2R": (lambda: arm("planar_2r"), XY, 2),
    "PP": (lambda: dh(P(H, H), P(0)), PositionTask("xz"), 1),
    "RP": (lambda: dh(R("l", -H, 0), P(0), l=0.5), XY, 2),
    "PR": (lambda: dh(P(-H), R("l", 0, 0), l=0.5), PositionTask("xz"), 2),
    "3R": (lambda: dh(R("l1", 0, 0), R("l2", 0, 0), R("l3", 0, 0), l1=1, l2=0.7, l3=0.4), PLANE, 2),
    "PRR": (lambda: arm("prr"), PLANE, 2),
    "RPR": (planar_rpr, PLANE, 2),
    "RRP": (lambda: dh(R("l1", 0, 0), R(0, H, 0), P(0), l1=0.5), PLANE, 2),
    "PPP": (lambda: dh(P(H, H), P(H, H), P(0)), XYZ, 1),
    "cylindrical": (lambda: arm("cylindrical"), XYZ, 2),
    "polar": (lambda: dh(*POLAR_ARM), XYZ, 4),
    "SCARA": (lambda: dh(*SCARA, a1=0.5, a2=0.4, d1=0.3), XYZ, 2),
    "anthropomorphic": (anthropomorphic, XYZ, 4),
    "shoulder offset": (lambda: shoulder_arm(0.1), XYZ, 4),
    "first axis offset": (offset_arm, XYZ, 4),
    "orthogonal": (lambda: orthogonal(0.4, 0.3), XYZ, 4),
    "ZYZ wrist": (lambda: dh(*ZYZ, d6=0.2), OrientationTask(), 2),
    "5R": (five, PoseTask(), 4),
}


@cache
def formulas(name):
    build, task, _ = ARMS[name]
    return ik_formulas(build(), task)


def numbers(fam, target, branch):
    """q of a branch at a target, from the expressions alone."""
    flat = np.asarray(getattr(target, "homogeneous", target), dtype=float).ravel()
    at = {symbol: flat[place] for symbol, (place, _) in zip(fam.target, fam.places, strict=True)}
    at |= {sympy.Symbol(key, real=True): value for key, value in fam.robot.parameters.items()}
    return {name: complex(e.subs(at)) for name, e in branch.q.items()}, branch.exists_if.subs(at)


def same_turns(robot, p, q):
    d = np.asarray(p) - q
    return np.abs(np.where(robot.revolute, (d + pi) % (2 * pi) - pi, d)).max() < 1e-5


@pytest.mark.parametrize("name", ARMS)
def test_the_expressions_of_all_branches_are_the_solutions(name):
    fam, (_, task, count) = formulas(name), ARMS[name]
    robot, rng = fam.robot, np.random.default_rng(3)
    assert len(fam) == len(fam.branches) == count
    assert len({tuple(branch.sign.items()) for branch in fam.branches}) == count
    q = rng.uniform(-1.5, 1.5, robot.nq)
    q[[robot.joint_names.index(joint) for joint in fam.free_joints]] = 0
    target = task.value(robot, q)
    found = []
    for branch in fam.branches:
        values, exists = numbers(fam, target, branch)
        if max(abs(value.imag) for value in values.values()) < 1e-9:
            p = [values[joint].real if joint in values else 0.0 for joint in robot.joint_names]
            assert np.abs(task.error(robot, p, target)).max() < 1e-6
            assert exists == sympy.true or fam.constraints
            found.append(p)
        else:
            assert exists == sympy.false
    assert any(same_turns(robot, p, q) for p in found)
    assert len(fam.at(target)) == len(found)


@pytest.mark.parametrize("name", ["2R", "3R", "anthropomorphic"])
def test_there_are_as_many_as_a_search_finds(name):
    fam, (_, task, _) = formulas(name), ARMS[name]
    target = task.value(fam.robot, [0.4, 0.9, 0.5][: fam.robot.nq])
    limits = [(a, b) for a, b in zip(fam.robot.lower, fam.robot.upper, strict=True)]
    inside = [q for q in fam.at(target) if all(a <= v <= b for v, (a, b) in zip(q, limits, strict=True))]
    found = ik_solutions(fam.robot, task, target)
    assert len(found) >= len(inside) > 0


def test_2r_has_the_cosine_of_the_elbow_and_two_terms_of_the_shoulder():
    fam = formulas("2R")
    l1, l2 = sympy.symbols("l1 l2", real=True)
    c2 = (x**2 + y**2 - l1**2 - l2**2) / (2 * l1 * l2)
    for branch in fam.branches:
        sign = branch.sign["q2"]
        assert sympy.simplify(branch.q["q2"] - sign * sympy.acos(c2)) == 0
        theirs = sympy.atan2(y, x) - sympy.atan2(l2 * sympy.sin(sign * sympy.acos(c2)), l1 + l2 * c2)
        at = {l1: 1.2, l2: 0.8, x: 0.7, y: 1.1}
        assert abs(sympy.exp(sympy.I * (branch.q["q1"] - theirs)).subs(at).evalf() - 1) < 1e-12
    assert {(str(case.condition), case.joint) for case in fam.singular_if if case.is_free} == {
        ("Eq(x**2 + y**2, 0)", "q1")
    }
    assert [fam.branches[0].exists_if.subs({l1: 1, l2: 1, x: 0, y: r}) for r in (1, 3)] == [sympy.true, sympy.false]


def test_prr_has_the_sine_of_the_second_joint():
    fam = formulas("PRR")
    l2, l3 = sympy.symbols("l2 l3", real=True)
    s2 = (y - l3 * sympy.sin(phi)) / l2
    q2 = {branch.sign["q2"]: branch.q["q2"] for branch in fam.branches}
    assert sympy.simplify(q2[1] - sympy.asin(s2)) == 0
    assert sympy.simplify(q2[-1] - sympy.pi + sympy.asin(s2)) == 0
    for branch in fam.branches:
        assert sympy.simplify(branch.q["q3"] - phi + branch.q["q2"]) == 0
        theirs = x - l3 * sympy.cos(phi) - l2 * sympy.cos(branch.q["q2"])
        assert sympy.simplify(branch.q["q1"] - theirs) == 0


def test_cylindrical_has_two_radii():
    fam = formulas("cylindrical")
    assert {branch.q["q3"] for branch in fam.branches} == {sympy.sqrt(x**2 + y**2), -sympy.sqrt(x**2 + y**2)}
    assert all(branch.q["q1"] == z for branch in fam.branches)
    assert {case.joint for case in fam.singular_if if case.is_free} == {"q2"}


def test_anthropomorphic_has_the_four_solutions_of_an_examination():
    fam = formulas("anthropomorphic")
    found = np.sort(np.round(fam.at([0, 1.0607, 2.5607])[:, 2], 3))
    assert found == pytest.approx([-0.785, -0.785, 0.785, 0.785], abs=1e-3)
    expected = [
        [0.785398, -0.523628, 1.047271],
        [0.785398, 0.293702, -1.047271],
        [-2.356194, 2.847891, 1.047271],
        [-2.356194, -2.617965, -1.047271],
    ]
    for q in expected:
        assert any(np.abs((p - q + pi) % (2 * pi) - pi).max() < 1e-4 for p in fam.at([1.5309, 1.5309, 0.25]))


def test_planar_2r_has_both_solutions_of_an_examination():
    fam = ik_formulas(dh(R("l1", 0, 0), R("l2", 0, 0), l1=0.6, l2=0.5), XY)
    assert np.sort(fam.at([-0.3, 0]), axis=0) == pytest.approx(
        np.array([[-2.1598, -2.6193], [2.1598, 2.6193]]), abs=1e-3
    )
    assert len(fam.at([0, 1.2])) == 0


def test_rp_with_an_offset_has_the_root_of_the_radius():
    fam = formulas("RP")
    length = sympy.Symbol("l", real=True)
    assert {branch.q["q2"] for branch in fam.branches} == {
        sign * sympy.sqrt(-(length**2) + x**2 + y**2) for sign in (1, -1)
    }
    assert fam.at([0.6, 0.7]) == pytest.approx(np.array([[-0.135423, 0.774597], [1.859763, -0.774597]]), abs=1e-5)
    assert fam.branches[0].exists_if.subs({length: 0.5, x: 0.1, y: 0}) == sympy.false


def test_a_zyz_wrist_has_two_solutions_and_loses_one_angle_where_sin_q2_is_zero():
    fam = formulas("ZYZ wrist")
    r33 = sympy.Symbol("r33", real=True)
    assert {branch.q["q2"] for branch in fam.branches} == {sympy.acos(r33), -sympy.acos(r33)}
    assert {case.joint for case in fam.singular_if if case.is_free} == {"q1"}


@pytest.mark.parametrize("alphas", [(H, -H, 0), (-H, H, H), (H, H, 0.3)])
def test_a_wrist_of_any_sequence_and_constant_factor_has_two_solutions(alphas):
    robot = dh(*(R(0, alpha, 0, theta) for alpha, theta in zip(alphas, (0, H, 0), strict=True)))
    assert len(ik_formulas(robot, OrientationTask())) == 2


def test_scara_with_all_of_its_pose_says_what_the_target_must_have():
    robot = dh(*SCARA, a1=0.5, a2=0.4, d1=0.3)
    fam = ik_formulas(robot, PoseTask())
    assert {str(e) for e in fam.constraints} >= {"r13", "r23", "r33 + 1"}
    assert formulas("SCARA").free_joints == ("q4",)
    with_angle = FunctionTask(lambda p, R, q: [*p, np.arctan2(R[1, 0], R[0, 0])], 4)
    q = np.array([0.3, 0.7, 0.1, -0.4])
    target = forward_kinematics(robot, q)
    r = [*target.translation, np.arctan2(target.rotation[1, 0], target.rotation[0, 0])]
    assert any(same_turns(robot, p, q) for p in ik_formulas(robot, with_angle).at(r))
    assert any(same_turns(robot, p, q) for p in fam.at(target))


@settings(max_examples=25, deadline=None)
@given(st.lists(st.floats(-3, 3), min_size=3, max_size=3))
def test_every_configuration_is_among_the_solutions_of_its_target(q):
    fam = formulas("first axis offset")
    robot, q = fam.robot, np.array(q)
    p = XYZ.value(robot, q)
    if np.abs(np.linalg.det(XYZ.jacobian(robot, q))) > 1e-4:
        assert any(same_turns(robot, other, q) for other in fam.at(p))


@pytest.mark.parametrize("build", [puma, stanford, ur5])
def test_a_6r_arm_has_eight_solutions_each_with_the_pose(build):
    robot = build()
    fam = ik_formulas(robot, PoseTask())
    assert len(fam) == 8
    assert len({tuple(branch.sign.values()) for branch in fam.branches}) == 8
    q = np.array([0.3, -0.8, 0.9, 0.4, 0.7, -0.5])
    target = forward_kinematics(robot, q)
    found = fam.at(target)
    assert any(same_turns(robot, p, q) for p in found)
    for p in found:
        assert forward_kinematics(robot, p).homogeneous == pytest.approx(target.homogeneous, abs=1e-7)


def test_without_a_closed_formula_the_error_says_so():
    robot = dh(R("a1", -H, 0), R("a2", H, "d2"), R("a3", 0, 0), a1=1, a2=2, a3=1.5, d2=1)
    with pytest.raises(FormulaError, match="no closed formula"):
        ik_formulas(robot, XYZ)


def test_the_error_says_what_finds_the_solutions():
    robot = dh(R("a1", -H, 0), R("a2", H, "d2"), R("a3", 0, 0), a1=1, a2=2, a3=1.5, d2=1)
    with pytest.raises(FormulaError, match="ik_solutions finds the numbers, by elimination to a polynomial"):
        ik_formulas(robot, XYZ)
    general = dh(*(R(0.1 + 0.05 * k, (-1) ** k * (0.6 + 0.1 * k), 0.1 + 0.02 * k) for k in range(6)))
    begin = process_time()
    with pytest.raises(FormulaError, match=r"polynomial of degree 16 at most.*which ik_solutions finds by elimination"):
        ik_formulas(general, PoseTask(), time_limit=1)
    assert process_time() - begin < 20  # without a limit it is minutes
    with pytest.raises(InputError, match="time_limit must be a positive number"):
        ik_formulas(general, PoseTask(), time_limit=0)


def test_more_joints_than_rows_are_refused():
    with pytest.raises(TaskError, match="infinitely many"):
        ik_formulas(arm("prr"), XY)


@pytest.mark.parametrize("name", ["x", "phi", "r11", "sin", "E", "target", "solutions", "np", "q", "机"])
def test_a_length_may_have_any_name(name):
    robot = robot_from_dh([("R", name, 0, 0, 0), ("R", "l2", 0, 0, 0)], parameters={name: 0.6, "l2": 0.5})
    fam = ik_formulas(robot, XY)
    q = np.array([0.3, 0.8])
    assert any(same_turns(robot, p, q) for p in fam.at(XY.value(robot, q)))
    assert sympy.Symbol(name, real=True) in fam.branches[0].q["q2"].free_symbols
    assert fam.explain()
    assert fam.latex()
    assert fam.c()
    assert fam.matlab().isascii()


def test_the_source_in_python_takes_other_lengths():
    fam = formulas("2R")
    scope = {}
    exec(fam.python(), scope)
    other = arm("planar_2r", l1=0.5, l2=0.4)
    found = scope["inverse_kinematics"]([0.3, 0.6], l1=0.5, l2=0.4)
    assert len(found) == 2
    for q in found:
        assert XY.value(other, q) == pytest.approx([0.3, 0.6])


def from_matlab(source):
    """Return a function of Python that does what MATLAB's does, as far as it is made of loops, ifs and assignments."""
    lines, depth = [], 0
    for line in source.splitlines():
        text = re.sub(r"\.([*/^])", r"\1", line.strip().rstrip(";")).replace("^", "**")
        if head := re.fullmatch(r"function (\w+) = (\w+)\((.*)\)", text):
            arguments = ", ".join(f"{argument}=None" for argument in head[3].split(", "))
            lines += [f"def {head[2]}({arguments}):"]
            depth, answer = 1, head[1]
        elif short := re.fullmatch(r"if (.*), (\w+) = (.*); end", text):
            where = f"{short[2]} is None" if short[1].startswith("nargin") else short[1]
            lines.append(f"    if {where}: {short[2]} = {short[3]}")
        elif short := re.fullmatch(r"if ~\((.*)\), return; end", text):
            lines.append(f"    if not ({short[1]}): return {answer}")
        elif text == "end":
            depth -= 1
            lines += [f"    return {answer}"] if depth == 0 else []
        elif text and not text.startswith("%"):
            text = re.sub(r"^for (\w+) = (.*)", r"for \1 in \2:", re.sub(r"^if (.*)", r"if \1:", text))
            text = re.sub(r"zeros\(0, \d\)", "[]", text)
            text = re.sub(r"solutions\(end . 1, :\) = (.*)", r"solutions.append(\1)", text)
            lines.append("    " * depth + text)
            depth += text.endswith(":")
    scope = {name: getattr(np, name) for name in ("sqrt", "sin", "cos", "isfinite", "all", "abs", "pi")}
    scope |= {"acos": np.arccos, "asin": np.arcsin, "atan2": np.arctan2, "NaN": np.nan}
    exec("\n".join(lines), scope)
    return scope["inverse_kinematics"]


@pytest.mark.parametrize("name", ["2R", "anthropomorphic"])
def test_the_source_in_matlab_gives_the_same_numbers(name):
    fam = formulas(name)
    q = np.linspace(0.4, 0.9, fam.robot.nq)
    target = fam.task.value(fam.robot, q)
    wanted = fam.at(target)
    solve = from_matlab(fam.matlab())
    assert np.array(solve(*target)) == pytest.approx(np.array(wanted), abs=1e-12)
    assert solve(*(100 * target)) == []  # out of reach, and no complex number


@pytest.mark.skipif(shutil.which("cc") is None, reason="there is no C compiler")
@pytest.mark.parametrize("name", ["anthropomorphic", "PRR", "ZYZ wrist"])  # acos; π − asin; entries of R
def test_the_source_in_c_gives_the_same_numbers(name, tmp_path):
    fam = formulas(name)
    target = fam.task.value(fam.robot, [0.4, 0.9, 0.7])
    flat = np.asarray(target, dtype=float).ravel()
    given_numbers = [*(sign * flat[place] for place, sign in fam.places), *fam.robot.parameters.values()]
    call = f"inverse_kinematics({', '.join(repr(float(value)) for value in given_numbers)}, q)"
    main = (
        f"#include <stdio.h>\n{fam.c()}\nint main(void) {{ double q[{len(fam)}][3]; int n = {call};"
        ' for (int i = 0; i < n; i++) printf("%.12f %.12f %.12f\\n", q[i][0], q[i][1], q[i][2]); return 0; }\n'
    )
    (tmp_path / "main.c").write_text(main)
    strict = ["-std=c99", "-pedantic", "-Wall", "-Werror"]
    subprocess.run(["cc", *strict, "main.c", "-lm", "-o", "main"], cwd=tmp_path, check=True)
    printed = subprocess.run([tmp_path / "main"], capture_output=True, text=True, check=True).stdout
    assert np.loadtxt(printed.splitlines()) == pytest.approx(fam.at(target))


def test_latex_and_words_have_a_line_for_each_joint():
    fam = formulas("PRR")
    assert fam.latex().count(r"\\") == 2
    assert re.search(r"q2 = asin\(.*\) or π − asin", fam.explain())


def test_formulas_can_be_pickled():
    fam = pickle.loads(pickle.dumps(formulas("2R")))
    assert fam.branches[0].q == formulas("2R").branches[0].q
    assert fam.explain() == formulas("2R").explain()


def test_a_pose_target_is_an_se3():
    fam = formulas("5R")
    T = forward_kinematics(fam.robot, [0.1, 0.4, 0.6, -0.3, 0.2])
    assert isinstance(T, pin.SE3)
    assert any(same_turns(fam.robot, q, [0.1, 0.4, 0.6, -0.3, 0.2]) for q in fam.at(T))


def test_a_task_that_no_joint_moves_is_refused():
    with pytest.raises(TaskError, match="no joint of robot 'planar_2r' moves the task"):
        ik_formulas(arm("planar_2r"), PositionTask("z"))


def test_conditions_are_written_as_in_a_book():
    """Bars for the absolute value, and no sign before all of what is zero."""
    text = ik_formulas(load_robot("prr"), PlanarPoseTask()).explain()
    assert "|(l3·sin(phi) − y)/l2| ≤ 1" in text
    assert "Abs" not in text
    assert "q2 is free where q3 = 0" in ik_formulas(load_robot("cylindrical"), PositionTask()).explain()


def test_long_formulas_have_names_and_two_solutions_a_sign():
    lines = ik_formulas(arm("planar_2r"), XY).explain().splitlines()
    assert lines[1:4] == [
        "  q2 = ±acos(c2), where |c2| ≤ 1",
        "    c2 = −(l1² + l2² − x² − y²)/(2·l1·l2)",
        "    the two are one where |c2| = 1",
    ]
    text = ik_formulas(ur5(), PoseTask()).explain()
    assert max(map(len, text.splitlines())) < 160
    offset = ik_formulas(dh(R(0, H, 0.4), R(0.8, 0, 0.2), R(0.7, 0, 0)), XYZ)
    assert "q1 = atan2(−x, y) ± acos(−0.2/sqrt(x² + y²)), where x² + y² ≥ 0.04" in offset.explain()
    assert r"\pm \operatorname{acos}" in offset.latex()
    assert "(0.8 + 0.7·cos(q3))" in offset.explain()  # metres, as in the table
    assert "q2 is free" not in offset.explain()  # 0.8² + 0.7² + 2 · 0.8 · 0.7 cos q3 has no zero
