"""Sets of solutions with two dimensions: told as such, spread over the set, with what stays the same on it."""

from math import pi

import numpy as np
import pytest
from brute_force import all_solutions, apart
from hypothesis import assume, given, settings, strategies as st
from test_all_solutions import POSE, XYZ, H, R, robot_of
from test_families import ELBOW

from robotics1 import PositionTask, ik_solutions, robot_from_dh
from robotics1.ik import IKStatus, SolutionSolver

EQUAL = [R(0, H, 0.4), R(0.5, 0, 0), R(0.5, 0, 0)]
FOLDING = [R(0, H, 0.4), R(0.5, 0, 0), R(0, H, 0), R(0, -H, 0.5), R(0, H, 0), R(0, 0, 0.1)]
COAXIAL = [R(0, 0, 0.3), R(0, 0, 0.2), R(0, H, 0.1), R(0.5, 0, 0)]
CASES = {  # rows, task, q, equations of the sets
    "folded onto the shoulder": (EQUAL, XYZ, [0.3, 0.4, 2 * H], {("q3 = π",)}),
    "a wrist's centre on the shoulder": (FOLDING, POSE, [0.3, 0.7, -H, 0.5, 0.7, 0.2], {("q3 = −π/2",)}),
    "straight up": (
        ELBOW,
        POSE,
        [0.3, H, H, 0.5, 0, 0.2],
        {("q2 = π/2", "q3 = π/2", "q5 = 0", "q1 + q4 + q6 = 1")},
    ),
    "three axes in a line": (
        COAXIAL,
        XYZ,
        [0.1, 0.2, 0.3, 0.4],
        {("q4 = 0.4000", "q1 + q2 + q3 = 0.6000"), ("q4 = 2.7416", "q1 + q2 + q3 = -2.5416")},
    ),
}


@pytest.mark.parametrize("case", CASES)
def test_a_set_of_two_dimensions_is_told_with_its_equations(case):
    rows, task, q, equations = CASES[case]
    robot = robot_of(rows)
    target = task.value(robot, np.array(q))
    found = ik_solutions(robot, task, target, starts=60)
    assert (found.status, found.dimension, found.complete) == (IKStatus.INFINITE, 2, False)
    assert len(found) >= 60
    assert set(found.families) == equations
    assert max(np.abs(task.error(robot, p, target)).max() for p in found.q) < 2e-9
    for equation in next(iter(equations)):
        assert equation in found.explain()


LENGTHS, ANGLES = st.floats(0.1, 0.6), st.floats(-2, 2)
WRIST_TURNS = {  # q2, q3 and q5 with axes 1, 4 and 6 in one line: how far q4 and q6 turn the tool as q1 does
    "up": (H, H, 0, 1, 1),
    "down": (-H, H, 0, -1, -1),
    "folded": (H, -H, 0, -1, -1),
    "back": (H, H, pi, 1, -1),
}


@pytest.mark.parametrize("posture", WRIST_TURNS)
@settings(max_examples=2)
@given(lengths=st.tuples(LENGTHS, LENGTHS, LENGTHS, LENGTHS), angles=st.tuples(ANGLES, ANGLES, ANGLES))
def test_three_axes_in_a_line_leave_two_dimensions_in_which_their_turns_add_up(posture, lengths, angles):
    """n − rank J = 2 all over the set, but where axes 2, 3 and 5 are parallel: the formula finds q4 = 0 or π only."""
    (d1, a2, d4, d6), (q1, q4, q6) = lengths, angles
    assume(abs(a2 - d4) > 0.01)  # else the wrist's centre may be on the shoulder
    q2, q3, q5, fourth, sixth = WRIST_TURNS[posture]
    robot = robot_of([R(0, H, d1), R(a2, 0, 0), R(0, H, 0), R(0, -H, d4), R(0, H, 0), R(0, 0, d6)])
    found = ik_solutions(robot, POSE, POSE.value(robot, np.array([q1, q2, q3, q4, q5, q6])), starts=2)
    assert (found.status, found.dimension, found.complete) == (IKStatus.INFINITE, 2, False)
    turn = found.q @ [1, 0, 0, fourth, 0, sixth] - (q1 + fourth * q4 + sixth * q6)
    here = np.abs(np.exp(1j * found.q[:, [1, 2, 4]]) - np.exp(1j * np.array([q2, q3, q5]))).max(axis=1) < 1e-4
    assert np.count_nonzero(here) > 40
    assert np.abs(np.exp(1j * turn[here]) - 1).max() < 1e-4
    q1_q4 = found.q[here][:, [0, 3]]
    assert np.linalg.svd(np.hstack([np.cos(q1_q4), np.sin(q1_q4)]))[1][-1] > 1  # they fill a surface, no curve


@pytest.mark.parametrize("case", ["a wrist's centre on the shoulder", "straight up"])
def test_a_prepared_solver_says_so_too(case):
    rows, task, q, equations = CASES[case]
    robot = robot_of(rows)
    found = SolutionSolver(robot, task, starts=60)(task.value(robot, np.array(q)))
    assert (found.status, found.dimension, set(found.families)) == (IKStatus.INFINITE, 2, equations)


@pytest.mark.parametrize("case", ["folded onto the shoulder", "a wrist's centre on the shoulder"])
def test_what_brute_force_finds_is_near_a_sample(case):
    rows, task, q, _ = CASES[case]
    robot = robot_of(rows)
    target = task.value(robot, np.array(q))
    T = POSE.value(robot, np.array(q)).homogeneous
    found = ik_solutions(robot, task, target, starts=60)
    kinds = "RRR"
    some = all_solutions(rows, T, range(6 if task is POSE else 3), starts=60)
    assert len(some) > 10
    assert max(apart(kinds, p[:3], found.q[:, :3]).min() for p in some) < 0.9


def test_no_equation_is_told_of_a_joint_that_does_not_move_the_task():
    arm = robot_from_dh([("R", 1, 0, 0, 0), ("R", 0.7, 0, 0, 0), ("R", 0, 0, 0, 0)])
    still = ik_solutions(robot_of(COAXIAL[:3]), PositionTask("z"), [0.6])
    assert still.dimension == 3
    found = ik_solutions(arm, PositionTask("x"), [0.6])
    assert (found.dimension, found.free_joints, found.families) == (1, ("q3",), ())
