"""Symbolic equality of formulas, and each published formula of the exam of 13 January 2025 with a fault in it."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import pytest
import sympy
from exams.comparison import Comparison
from exams.from_file.published import compare
from exams.from_file.worked import work_file
from exams.symbolic_equality import are_equal, formula_of

from robotics1 import InputError

ROOT = Path(__file__).parents[1]
EXAM = ROOT / "examples" / "exams" / "exam_2025_01_13.toml"

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
def worked(tmp_path_factory):
    return work_file(EXAM, tmp_path_factory.mktemp("exam") / "exam.html")


def reproduced(question, answer, what, printed):
    comparison = Comparison()
    try:
        compare(comparison, replace(question, published={what: printed}), answer, variant=False)
    except InputError:  # no formula any more
        return False
    return all(check.holds for check in comparison.checks)


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
    ("q1", "q2"),
]


def formulas_of(worked):
    for question, answer in worked.answers:
        for what, printed in question.published.items():
            if what in answer.formulas:
                yield question, answer, what, printed


def test_each_published_formula_with_a_fault_in_it_is_not_reproduced(worked):
    tried = {}
    for question, answer, what, printed in formulas_of(worked):
        assert reproduced(question, answer, what, printed)
        text = json.dumps(printed)
        faulty = [text.replace(good, bad, 1) for good, bad in FAULTS if good in text]
        name = f"{question.name} {what}"
        tried[name] = len(faulty)
        for wrong in faulty:
            assert not reproduced(question, answer, what, json.loads(wrong)), (name, wrong)
    assert len(tried) == 30
    assert all(tried.values())
    assert sum(tried.values()) > 100


def test_each_published_number_with_another_digit_is_not_reproduced(worked):
    tried = 0
    for question, answer in worked.answers:
        for what, printed in question.published.items():
            if what not in answer.numbers:
                continue
            numbers = printed.split()
            for i, number in enumerate(numbers):
                other = f"{number[:-1]}{(int(number[-1]) + 4) % 10}"
                wrong = " ".join([*numbers[:i], other, *numbers[i + 1 :]])
                assert not reproduced(question, answer, what, wrong), (question.name, what, wrong)
                tried += 1
    assert tried == 88


def test_a_table_with_a_row_too_few_or_another_digit_is_not_reproduced(worked):
    question, answer = next((q, a) for q, a in worked.answers if "table" in q.published)
    table = question.published["table"]
    assert reproduced(question, answer, "table", table.replace("-0.8312 1.1441 2", "-0.8312 1.1441 -2"))
    assert not reproduced(question, answer, "table", table.replace("2.3549", "2.3548"))
    assert not reproduced(question, answer, "table", table[: table.index("\n3 |")])
    assert not reproduced(question, answer, "table", table + "4 | 0 0 0 | 0 0 0 | 0 | 0")
    assert not reproduced(question, answer, "table", table.replace("| -1.4142", ""))


def test_formulas_of_a_robot_whose_file_is_wrong_are_not_reproduced(tmp_path):
    text = (ROOT / "urdf" / "prr.urdf.xacro").read_text(encoding="utf-8")
    assert text.count('xyz="${l3} 0 0"') == 1
    (tmp_path / "prr").write_text(text.replace('xyz="${l3} 0 0"', 'xyz="${l2} 0 0"'), encoding="utf-8")
    (tmp_path / "prr").rename(tmp_path / "prr.urdf.xacro")
    shutil.copy(ROOT / "urdf" / "parts.xacro", tmp_path)
    first = EXAM.read_text(encoding="utf-8").partition('[[exercise.question]]\nname = "1a, 1b')[0]
    (tmp_path / "exam.toml").write_text(first.replace('"prr"', '"prr.urdf.xacro"'), encoding="utf-8")
    found = work_file(tmp_path / "exam.toml", tmp_path / "exam.html")
    assert {"1, r formula", "1 formula"} <= {check.name for check in found.comparison.failures()}


# --- their numbers


def values_of(worked, ask, k=0):
    return [(question, answer) for question, answer in worked.answers if question.ask == ask][k]


def number(formula, values):
    found = formula.subs({sympy.Symbol(name, real=True): value for name, value in values.items()})
    return [float(x) for x in found] if isinstance(found, sympy.MatrixBase) else float(found)


def test_newtons_formula_gives_the_second_row_of_table_1(worked):
    _, answer = values_of(worked, "iteration")
    first, second = answer.numbers["k=0 q"], answer.numbers["k=1 q"]
    values = dict(zip(("q1", "q2", "q3", "x_d", "y_d", "z_d"), [*first, 1, -1, 3], strict=True))
    assert number(answer.formulas["next q"].formula, values) == pytest.approx(second)


def test_the_rendez_vous_in_letters_is_that_in_numbers(worked):
    question, answer = values_of(worked, "rendezvous")
    data = {**question.exercise.names, "delta": sympy.rad(15)}
    assert number(answer.formulas["time formula"].formula, data) == pytest.approx(answer.numbers["time"][0])
    assert number(answer.formulas["position formula"].formula, data) == pytest.approx(answer.numbers["position"])
    assert number(answer.formulas["velocity formula"].formula, data) == pytest.approx(answer.numbers["velocity"])
    for arm in ("right", "left"):
        q, qdot = answer.numbers[f"{arm} q"], answer.numbers[f"{arm} qdot"]
        at_q = {**data, "q1": q[0], "q2": q[1]}
        assert number(answer.formulas["matching qdot"].formula, at_q) == pytest.approx(qdot)
        for joint in range(2):
            at_end = {"q_rv": q[joint], "qdot_rv": qdot[joint], "t_rv": answer.numbers["time"][0], "tau": 1}
            assert number(answer.formulas["q(tau) formula"].formula, at_end) == pytest.approx(q[joint])
            assert number(answer.formulas["qdot(tau) formula"].formula, at_end) == pytest.approx(qdot[joint])


def test_the_torque_of_the_exam_is_that_of_its_lengths_whatever_the_second_force_is(worked):
    _, answer = values_of(worked, "torque")
    torque = answer.formulas["formula"].formula
    assert number(torque, {"F": 3, "l2": 0.6, "l3": 0.4}) == pytest.approx([-3, 3 * (0.6 - 0.4), -3 * 0.4])
    assert sympy.Symbol("phi", real=True) not in torque.free_symbols
