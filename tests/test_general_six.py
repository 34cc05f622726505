"""Six joints of any geometry: as many solutions as brute force finds, sixteen of a known arm, never a false claim."""

import numpy as np
import pytest
from brute_force import all_solutions, apart
from hypothesis import given, settings, strategies as st
from test_all_solutions import POSE, H, R, robot_of

from robotics1 import ik_solutions
from robotics1.ik import IKStatus, SolutionSolver

ONE_DEGREE = np.pi / 180
SIXTEEN = [R(0.3, H, 0), R(1, ONE_DEGREE, 0), R(0, H, 0.2), R(1.5, ONE_DEGREE, 0), R(0, H, 0), R(1, ONE_DEGREE, 0)]
Q16 = np.array([2.1444256595, -2.7984865481, 1.3779326786, -1.9460662764, 2.1790735341, 0.2487673215])
METHOD = "elimination to an eigenvalue problem"


def drawn(seed, slides):
    rng = np.random.default_rng(seed)
    rows = [R(*rng.uniform(-1, 1, 3)) for _ in range(6)]
    for j in rng.choice(6, slides, replace=False):
        rows[j] = ("P", 0, float(rng.uniform(-3, 3)), 0, float(rng.uniform(-3, 3)))
    q = rng.uniform(-1, 1, 6) * np.where([row[0] == "R" for row in rows], 3, 1)
    return rows, q


@given(st.integers(0, 100_000), st.sampled_from([0, 0, 1]))
@settings(max_examples=10)
def test_a_general_arm_has_what_brute_force_finds(seed, slides):
    rows, q = drawn(seed, slides)
    robot, kinds = robot_of(rows), [row[0] for row in rows]
    target = POSE.value(robot, q)
    found = ik_solutions(robot, POSE, target, starts=2)
    if not found.complete:
        return
    assert found.method == METHOD
    assert found.status is IKStatus.FINITE
    assert apart(kinds, q, found.q).min() < 1e-6
    for p in found.q:
        assert np.abs(POSE.error(robot, p, target)).max() < 1e-11
    for p in all_solutions(rows, target.homogeneous, range(6), seed=3, starts=200):
        assert np.abs(p[np.array(kinds) == "P"]).max(initial=0.0) > 50 or apart(kinds, p, found.q).min() < 1e-4


def test_most_targets_of_general_arms_are_proven():
    complete = 0
    for seed in range(12):
        rows, q = drawn(seed, seed % 2)
        robot = robot_of(rows)
        complete += ik_solutions(robot, POSE, POSE.value(robot, q), starts=2).complete
    assert complete >= 9


def test_the_arm_of_manocha_and_canny_has_sixteen_solutions():
    robot = robot_of(SIXTEEN)
    target = POSE.value(robot, Q16)
    found = ik_solutions(robot, POSE, target, starts=2)
    assert (len(found), found.complete, found.method) == (16, True, METHOD)
    assert apart("RRRRRR", Q16, found.q).min() < 1e-9
    distances = [apart("RRRRRR", p, np.delete(found.q, i, axis=0)).min() for i, p in enumerate(found.q)]
    assert min(distances) > 1e-2


@pytest.mark.parametrize("seed", [0, 1])
def test_the_solver_answers_as_the_function_does(seed):
    rows, q = drawn(seed, seed)
    robot = robot_of(rows)
    solver, rng = SolutionSolver(robot, POSE, starts=2), np.random.default_rng(seed)
    targets = [POSE.value(robot, q + 0.1 * rng.uniform(-1, 1, 6)) for _ in range(4)]
    batch = solver.solve_batch(targets)
    for i, target in enumerate(targets):
        expected = ik_solutions(robot, POSE, target, starts=2)
        for found in (solver(target), batch[i]):
            assert (found.status, found.complete) == (expected.status, expected.complete)
            assert found.q == pytest.approx(expected.q, abs=1e-8)


def test_a_target_near_a_singularity_is_not_claimed_to_be_complete_where_roots_meet():
    rows, _ = drawn(0, 0)
    robot = robot_of(rows)
    for i in range(6):  # walk to det J = 0 along joint 3
        q = np.random.default_rng(i).uniform(-3, 3, 6)
        x = np.linspace(-3, 3, 400)
        det = [np.linalg.det(POSE.jacobian(robot, np.r_[q[:2], v, q[3:]])) for v in x]
        change = np.flatnonzero(np.diff(np.sign(det)))
        if not change.size:
            continue
        low, high = x[change[0]], x[change[0] + 1]
        for _ in range(60):
            q[2] = 0.5 * (low + high)
            same = np.sign(np.linalg.det(POSE.jacobian(robot, q))) == np.sign(det[change[0]])
            low, high = (q[2], high) if same else (low, q[2])
        found = ik_solutions(robot, POSE, POSE.value(robot, q), starts=2)
        assert not found.complete
        assert len(found) >= 1
