"""An arm that is known only by its direct kinematics: every question that a task answers."""

import pickle
from math import cos, pi, sin

import numpy as np
import pytest
import sympy
from arms import arm
from differences import derivative

import robotics1 as r1
from robotics1.textbook_robots import robot_from_formula

CYLINDRICAL = robot_from_formula(["q2*cos(q1)", "q2*sin(q1)", "q3"], joints="RPP")
TWO_R = robot_from_formula(
    ["l1*cos(q1) + l2*cos(q1 + q2)", "l1*sin(q1) + l2*sin(q1 + q2)"], joints="RR", values={"l1": 0.8, "l2": 0.5}
)
Q = [0.4, 0.6, -0.2]


def test_value_and_jacobian_are_those_of_the_formula():
    task = CYLINDRICAL.task
    assert task.value(CYLINDRICAL, Q) == pytest.approx([0.6 * cos(0.4), 0.6 * sin(0.4), -0.2], abs=1e-15)
    J = task.jacobian(CYLINDRICAL, Q)
    wanted = [[-0.6 * sin(0.4), cos(0.4), 0], [0.6 * cos(0.4), sin(0.4), 0], [0, 0, 1]]
    assert pytest.approx(np.array(wanted), abs=1e-15) == J
    assert derivative(lambda q: task.value(CYLINDRICAL, q), Q) == pytest.approx(J, abs=1e-10)


def test_formulas_are_read_back_with_their_determinant():
    q1, q2, q3 = sympy.symbols("q1:4", real=True)
    found = r1.formulas(CYLINDRICAL, CYLINDRICAL.task)
    assert list(found.value) == [q2 * sympy.cos(q1), q2 * sympy.sin(q1), q3]
    assert found.determinant == -q2
    turned = robot_from_formula(["q2*cos(q1 + pi/2)", "q2*sin(q1 + pi/2)"], joints="RP")
    assert list(r1.formulas(turned, turned.task).value) == [-q2 * sympy.sin(q1), q2 * sympy.cos(q1)]


def test_singularities_of_the_cylindrical_arm_are_at_q2_zero():
    found = r1.find_singularities(CYLINDRICAL, CYLINDRICAL.task)
    assert found.method == "symbolic"
    assert [branch.values for branch in found.branches] == [{"q2": 0.0}]
    assert found.branches[0].rank == 2


def test_a_2r_given_by_its_formula_is_the_2r_with_links():
    robot, plane = arm("planar_2r", l1=0.8, l2=0.5), r1.PositionTask("xy")
    q = [0.3, -1.1]
    assert TWO_R.task.jacobian(TWO_R, q) == pytest.approx(plane.jacobian(robot, q), abs=1e-15)
    target = plane.value(robot, q)
    found = r1.solve_ik(TWO_R, TWO_R.task, target).require()
    assert TWO_R.task.value(TWO_R, found.q) == pytest.approx(target, abs=1e-6)
    ours, wanted = (r1.ik_solutions(*case, target).q for case in ((TWO_R, TWO_R.task), (robot, plane)))
    assert np.sort(ours, axis=0) == pytest.approx(np.sort(wanted, axis=0), abs=1e-6)
    newton = r1.iterate_ik(TWO_R, TWO_R.task, target, [0.2, -1.0], tolerance=1e-10)
    assert newton.q == pytest.approx(q, abs=1e-8)
    assert r1.singularities.manipulability(TWO_R, TWO_R.task, q).measure == pytest.approx(0.4 * sin(1.1))


def test_a_row_in_radians_counts_up_to_whole_turns():
    robot = robot_from_formula(["cos(q1) + cos(q1 + q2)", "q1 + q2"], joints="RR", units=("1", "rad"))
    assert robot.task.error(robot, [3.0, 0.0], [0.0, -3.0])[1] == pytest.approx(2 * pi - 6)


def test_rates_limits_and_copies():
    moved = r1.trajectories.joint_velocity(CYLINDRICAL, CYLINDRICAL.task, [0.1, 0, 0.2], Q)
    assert CYLINDRICAL.task.jacobian(CYLINDRICAL, Q) @ moved.qdot == pytest.approx([0.1, 0, 0.2])
    bounded = robot_from_formula(["q1**2"], joints="P", lower=[0], upper=[2])
    assert r1.solve_ik(bounded, bounded.task, [2.25]).require().q == pytest.approx([1.5], abs=1e-6)
    assert r1.solve_ik(bounded, bounded.task, [9.0], time_limit=0.2).status.name != "CONVERGED"
    other = pickle.loads(pickle.dumps(TWO_R))
    assert np.array_equal(other.task.value(other, [0.3, 1]), TWO_R.task.value(TWO_R, [0.3, 1]))


@pytest.mark.parametrize("question", [r1.forward_kinematics, r1.frame_jacobian, r1.PositionTask("xy").value])
def test_a_frame_is_refused_for_there_is_none(question):
    with pytest.raises(r1.InputError, match=r"has no frames: use its task, arm\.task"):
        question(CYLINDRICAL, Q)


@pytest.mark.parametrize(
    ("arguments", "options", "error", "words"),
    [
        ((["l1*cos(q1)"], "R"), {}, r1.InputError, "'l1' is neither a joint, q1 to q1, nor has it a value"),
        ((["q3"], "RR"), {}, r1.InputError, "'q3' is neither a joint, q1 to q2"),
        ((["q1"], "R"), {"values": {"l1": 2}}, r1.UnknownNameError, "no name with a value in the formulas: 'l1'"),
        ((["q1"], "R"), {"values": {"q1": 2}}, r1.UnknownNameError, "'q1'"),
        ((["a*q1"], "R"), {"values": {"a": np.nan}}, r1.InputError, "the value of 'a' must be a finite number"),
        ((["__import__('os')"], "R"), {}, r1.InputError, "a formula is made of"),
        ((["9**9**9"], "R"), {}, r1.InputError, "exponent"),
        ((["sqrt(-1)*q1"], "R"), {}, r1.InputError, "real and finite"),
        (("q1", "R"), {}, r1.InputError, "formulas must be one for each row"),
        (([], "R"), {}, r1.InputError, "they are \\[\\]"),
        ((["q1"], "X"), {}, r1.InputError, "letters R .revolute. and P"),
        ((["q1"], "R"), {"units": ("deg",)}, r1.InputError, "units must hold"),
        ((["q1"], "R"), {"lower": [1], "upper": [0]}, r1.InputError, "lower ≤ upper"),
    ],
)
def test_what_is_no_direct_kinematics_is_refused(arguments, options, error, words):
    with pytest.raises(error, match=words):
        robot_from_formula(*arguments, **options)


def test_a_formula_without_a_real_value_at_q_is_named():
    robot = robot_from_formula(["sqrt(q1)"], joints="P")
    with pytest.raises(r1.TaskError, match="finite numbers"):
        robot.task.value(robot, [-1.0])
