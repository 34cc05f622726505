"""The formulas of the exam: symbolic equality, the published ones, and their numbers."""

import shutil
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import sympy
from exams.comparison import Comparison
from exams.exam_2025_01_13 import answers as exam
from exams.exam_2025_01_13.formulas import formula_tables, formulas_1
from exams.formula_table import FormulaRow, FormulaTable
from exams.symbolic_equality import are_equal, formula_of

from robotics1 import load_robot

URDF = Path(__file__).parents[1] / "urdf"

# --- symbolic equality


@pytest.mark.parametrize(
    ("printed", "computed", "equal"),
    [
        ("sin(q1)**2 + cos(q1)**2", "1", True),
        ("l2*sin(q1 + q2)", "l2*(sin(q1)*cos(q2) + cos(q1)*sin(q2))", True),
        ("l2*cos(q2)", "l2*sin(q2)", False),
        ("l2*cos(q2)", "-l2*cos(q2)", False),
        ("l2*cos(q2)", "l3*cos(q2)", False),
        ("Matrix([[1, q1], [0, 2*sin(q1)*cos(q1)]])", "Matrix([[1, q1], [0, sin(2*q1)]])", True),
        ("Matrix([[1, q1], [0, sin(2*q1)]])", "Matrix([[1, q1], [0, cos(2*q1)]])", False),
        ("Matrix([1, q1])", "Matrix([[1, q1]])", False),
        ("Matrix([1])", "1", False),
        ("MatMul(nu, Matrix([l2, 1, -1]))", "MatMul(mu, Matrix([-2*l2, -2, 2]))", True),
        ("MatMul(nu, Matrix([0, 1, l3*sin(q3)]))", "MatMul(nu, Matrix([0, -1, -l3*sin(q3)]))", True),
        ("MatMul(nu, Matrix([l2, 1, -1]))", "MatMul(nu, Matrix([l2, -1, 1]))", False),
        ("MatMul(nu, Matrix([0, 1]))", "MatMul(nu, Matrix([0, sin(q3)]))", False),  # not where q3 = 0
        ("MatMul(nu, Matrix([0, 1]))", "MatMul(nu, Matrix([0, 0]))", False),
        ("MatMul(nu, Matrix([0, 0]))", "MatMul(nu, Matrix([0, 1]))", False),
        ("MatMul(nu, Matrix([0, 1]))", "MatMul(nu, Matrix([1, 0]))", False),
        ("MatMul(nu, Matrix([0, 1]))", "MatMul(nu, Matrix([0, 1, 0]))", False),
        ("MatMul(nu, Matrix([0, 1]))", "Matrix([0, 1])", False),
        ("MatMul(nu, Matrix([0, 1]))", "nu", False),
        ("Ne(rdot2 + l3*rdot3, 0)", "Ne(-2*l3*rdot3, 2*rdot2)", True),
        ("Ne(rdot2 + l3*rdot3, 0)", "Ne(rdot2 - l3*rdot3, 0)", False),
        ("Ne(rdot2 + rdot3, 0)", "Ne(sin(q3)*(rdot2 + rdot3), 0)", False),
        ("Ne(rdot2, 0)", "Eq(rdot2, 0)", False),
        ("Ne(rdot2, 0)", "rdot2", False),
        ("Contains(q2, FiniteSet(pi/2, -pi/2))", "Contains(q2, FiniteSet(-pi/2, pi/2))", True),
        ("Contains(q2, FiniteSet(pi/2, -pi/2))", "Contains(q2, FiniteSet(pi/2))", False),
        ("Contains(q2, FiniteSet(pi/2, -pi/2))", "Contains(q3, FiniteSet(pi/2, -pi/2))", False),
        ("Contains((q2, q3), FiniteSet((0, pi), (pi, 0)))", "Contains((q2, q3), FiniteSet((pi, 0), (0, pi)))", True),
        ("Contains((q2, q3), FiniteSet((0, pi), (pi, 0)))", "Contains((q3, q2), FiniteSet((0, pi), (pi, 0)))", False),
    ],
)
def test_formulas_are_equal_for_every_value_of_their_symbols_or_they_are_not(printed, computed, equal):
    assert are_equal(formula_of(printed), formula_of(computed)) is equal
    assert are_equal(formula_of(computed), formula_of(printed)) is equal


def test_the_symbols_of_a_text_are_the_real_ones_of_the_computed_formulas():
    assert formula_of("l2*cos(q2)").free_symbols == set(sympy.symbols("l2 q2", real=True))
    assert formula_of("pi*sin(t_rv)").free_symbols == {sympy.Symbol("t_rv", real=True)}


# --- the exam


@pytest.fixture(scope="module")
def solved():
    return exam.exercise_1(), exam.exercise_2(), exam.exercise_3()


@pytest.fixture(scope="module")
def tables(solved):
    return formula_tables(*solved)


@pytest.fixture(scope="module")
def rows(tables):
    return {row.name: row for table in tables for row in table.rows}


def checked(row):
    comparison = Comparison()
    FormulaTable("", [row], "").check(comparison)
    (check,) = comparison.checks
    return check


def test_all_published_formulas_are_equal_to_the_computed_ones(rows):
    published = [row for row in rows.values() if row.published]
    assert len(published) == 29
    assert [row.name for row in published if not checked(row).holds] == []
    assert [row.name for row in rows.values() if not row.published] == [
        "position of the target, as given",
        "p(q) of the 2R robot",
        "Jacobian of the 2R robot",
        "velocity J⁻¹ ṗ_T that matches the target's",
    ]


FAULTS = [
    ("sin(", "cos("),
    ("cos(", "sin("),
    ("l2", "l3"),
    ("l3", "l2"),
    ("q2", "q3"),
    (" + ", " - "),
    (" - ", " + "),
    ("-1", "1"),
    ("-l", "l"),
    ("-q", "q"),
    ("-x", "x"),
    ("-pi", "pi"),
    ("[1", "[2"),
    ("3*", "2*"),
    ("2*", "3*"),
    ("tau**2", "tau**3"),
    ("x0", "y0"),
    ("0", "1"),
    ("pi", "2*pi"),
]


def test_each_published_formula_with_a_fault_in_it_is_not_reproduced(rows):
    tried = dict.fromkeys(rows, 0)
    for row in rows.values():
        for good, bad in FAULTS:
            if good in row.published:
                wrong = replace(row, published=row.published.replace(good, bad, 1))
                assert not checked(wrong).holds, wrong.published
                tried[row.name] += 1
    assert all(tried[name] for name, row in rows.items() if row.published)
    assert sum(tried.values()) > 100


def test_formulas_of_a_robot_whose_file_is_wrong_are_not_reproduced(solved, tmp_path):
    text = (URDF / "prr.urdf.xacro").read_text(encoding="utf-8")
    assert text.count('xyz="${l3} 0 0"') == 1
    (tmp_path / "prr.urdf.xacro").write_text(text.replace('xyz="${l3} 0 0"', 'xyz="${l2} 0 0"'), encoding="utf-8")
    shutil.copy(URDF / "parts.xacro", tmp_path)
    wrong = replace(solved[0], robot=load_robot(tmp_path / "prr.urdf.xacro"))
    comparison = Comparison()
    formulas_1(wrong).check(comparison)
    assert {"r = (p, φ)", "Jacobian of p", "minor of Jₚ without column 1"} <= {c.name for c in comparison.failures()}


def test_a_formula_that_the_solution_does_not_print_is_no_check():
    comparison = Comparison()
    FormulaTable("", [FormulaRow("1", "p", "p", sympy.S.One)], "").check(comparison)
    assert comparison.checks == []


# --- their numbers


def numbers(formula, values):
    found = formula.subs({sympy.Symbol(name, real=True): value for name, value in values.items()})
    return np.array(found, dtype=float).ravel() if isinstance(found, sympy.MatrixBase) else float(found)


def test_J_s_and_the_torque_are_those_of_pinocchio(solved, rows):
    one = solved[0]
    J = exam.POINT.jacobian(one.robot, one.q_s)
    assert numbers(rows["Jₚ at qₛ = (q₁, π/2, π)"].computed, one.robot.parameters) == pytest.approx(J.ravel())
    assert numbers(rows["τ that balances (3, 1)"].computed, one.robot.parameters) == pytest.approx(one.torque)


def test_newtons_formula_gives_the_second_row_of_table_1(solved, rows):
    first, second = solved[1].a.table[:2]
    values = dict(zip(("q1", "q2", "q3", "x_d", "y_d", "z_d"), [*first.q, *exam.GOAL], strict=True))
    assert numbers(rows["Newton's next q, q + J⁻¹ (p_d − p)"].computed, values) == pytest.approx(second.q)


def test_the_target_of_the_formulas_is_that_of_the_rendezvous(solved, tables, rows):
    values = tables[2].values
    for time in (0.0, 0.7, 1.38):
        p = numbers(rows["position of the target, as given"].computed, {**values, "t": time})
        assert p == pytest.approx(exam.TARGET(time))
    meeting = solved[2].meeting
    assert numbers(rows["velocity of the target"].computed, values) == pytest.approx(meeting.velocity)
    assert numbers(rows["time of the rendez-vous, x = 0"].computed, values) == pytest.approx(meeting.time)
    assert numbers(rows["y at the rendez-vous"].computed, values) == pytest.approx(meeting.position[1])


@pytest.mark.parametrize("arm", ["right", "left"])
def test_the_matching_velocity_and_the_cubic_are_those_of_both_arms(solved, tables, rows, arm):
    three = solved[2]
    branch, values = getattr(three, arm), tables[2].values
    at_q = {**values, "q1": branch.q[0], "q2": branch.q[1]}
    found = numbers(rows["velocity J⁻¹ ṗ_T that matches the target's"].computed, at_q)
    assert found == pytest.approx(branch.qdot)
    for time in (0.0, 0.5, three.meeting.time):
        for joint in range(2):
            data = {"q_rv": branch.q[joint], "qdot_rv": branch.qdot[joint], "t_rv": three.meeting.time}
            data["tau"] = time / three.meeting.time
            q = numbers(rows["cubic from rest at 0, τ = t/tᵣᵥ"].computed, data)
            qdot = numbers(rows["velocity of the cubic"].computed, data)
            assert q == pytest.approx(branch.trajectory(time)[joint], abs=1e-12)
            assert qdot == pytest.approx(branch.trajectory.velocity(time)[joint], abs=1e-12)


def test_the_kinematics_of_the_2R_are_the_usual_ones(rows):
    l1, l2, a, b = sympy.symbols("l1 l2 q1 q2", real=True)
    p = sympy.Matrix([l1 * sympy.cos(a) + l2 * sympy.cos(a + b), l1 * sympy.sin(a) + l2 * sympy.sin(a + b)])
    assert are_equal(p, rows["p(q) of the 2R robot"].computed)
    assert are_equal(p.jacobian([a, b]), rows["Jacobian of the 2R robot"].computed)


def test_numbers_stand_beside_the_formulas_that_have_some(tables):
    shown = {formula.name: formula.number for table in tables for formula in table.section().formulas if formula.number}
    assert shown == {
        "null space of Jᵣ at q₂ = π/2": "ν (0.6000, 1, -1)",
        "null space of Jᵣ at q₂ = −π/2": "ν (0.6000, -1, 1)",
        "Jₚ at qₛ = (q₁, π/2, π)": "(1, -0.2000, 0.4000), (0, 0, 0)",
        "τ that balances (3, 1)": "(-3, 0.6000, -1.2000) [N, N m, N m]",
        "τ that balances (3, φ), for any φ": "(-3, 0.6000, -1.2000) [N, N m, N m]",
        "velocity of the target": "(1.4489, 0.3882) m/s",
        "time of the rendez-vous, x = 0": "1.3804 s",
        "y at the rendez-vous": "1.5359 m",
    }
