"""Six joints of which two slide, in every order: as many solutions as a scan counts, those that brute force finds."""

from itertools import combinations

import mpmath as mp
import numpy as np
import pytest
from brute_force import all_solutions, apart, link, pose_and_jacobian
from hypothesis import given, settings, strategies as st
from sweeps import core_first, some_of
from test_all_solutions import POSE, H, robot_of

from robotics1 import ik_solutions
from robotics1.ik import IKStatus, SolutionSolver

ORDERS = ["".join("P" if k in pair else "R" for k in range(6)) for pair in combinations(range(6), 2)]
THREE_SLIDE = ["RPRPRP", "PRPRPR", "RRPPPR", "PPRRPR"]
METHOD = "elimination to a polynomial"
GRID = 5_000  # angles of a scan
SEED_OF_EIGHT = 61  # of an arm RPRRPR with eight solutions at a pose


def drawn(order, seed):
    """DH rows, and q: twists, offsets and lengths of any size."""
    rng = np.random.default_rng([seed, *order.encode()])

    def row(kind):
        a, alpha, d, theta = rng.uniform(-1, 1), rng.uniform(-3, 3), rng.uniform(-1, 1), rng.uniform(-3, 3)
        return (kind, a, alpha, d, 0.0) if kind == "R" else (kind, a, alpha, 0.0, theta)

    return [row(kind) for kind in order], rng.uniform(-1, 1, 6) * np.where(np.array(list(order)) == "R", 3, 1)


def checked(rows, q):
    """The solutions inside and outside the limits, proven, verified, and q among them; and the target's pose."""
    robot, kinds = robot_of(rows), [row[0] for row in rows]
    target = POSE.value(robot, q)
    found = ik_solutions(robot, POSE, target, starts=2)
    assert (found.complete, found.status) == (True, IKStatus.FINITE)
    every = np.vstack([found.q, found.outside_limits])
    assert apart(kinds, q, found.q).min() < 1e-7
    T, _ = pose_and_jacobian(rows, every, np.zeros(3))
    assert np.abs(T - target.homogeneous).max() < 1e-10
    assert all(apart(kinds, p, np.delete(every, i, axis=0)).min(initial=9) > 1e-5 for i, p in enumerate(every))
    return found, every, target.homogeneous


def about_z(x):
    return link("R", 0, 0, 0, 0, np.atleast_1d(x))[:, :3, :3]


def count_by_scan(rows, T):
    """How many solutions there are: the first angle is scanned; the others that turn follow, in two ways each.

    The rotations are B₀ Z₁ B₁ Z₂ B₂ Z₃ B₃ Z₄ B₄ = R: axis 4 is known, and B₂ᵀ Z₂ᵀ turns it so that its height above
    axis 3 is right. Sought are the changes of sign of det(u, u', p_d − p), p being without slides, along the closed
    curve that both ways make: they join where there is none beyond.
    """
    still = [link("R", a, alpha, d, theta, np.zeros(1))[0] for _, a, alpha, d, theta in rows]
    turning = [i for i, row in enumerate(rows) if row[0] == "R"]
    B = [np.eye(3)] * 5
    for i in range(6):
        k = sum(j <= i for j in turning)
        B[k] = B[k] @ still[i][:3, :3]
    x = np.linspace(-np.pi, np.pi, GRID, endpoint=False) + 1e-5
    m = np.einsum("kji,j->ki", B[0] @ about_z(x) @ B[1], (T[:3, :3] @ B[4].T)[:, 2])
    w = B[2][:, 2]
    a, b = w[0] * m[:, 0] + w[1] * m[:, 1], w[0] * m[:, 1] - w[1] * m[:, 0]
    side = (B[3][2, 2] - w[2] * m[:, 2]) / np.hypot(a, b)
    middle, apart_by = np.arctan2(b, a), np.arccos(np.clip(side, -1, 1))
    f, g = (determinant(rows, T, B, turning, x, middle + sign * apart_by) for sign in (1, -1))
    there = np.abs(side) < 1
    along = there & np.roll(there, -1)
    ends = there & ~(np.roll(there, -1) & np.roll(there, 1))
    changes = [along & (h * np.roll(h, -1) < 0) for h in (f, g)] + [ends & (f * g < 0)]
    return int(np.sum(changes))


def determinant(rows, T, B, turning, x, y):
    front = B[0] @ about_z(x) @ B[1] @ about_z(y) @ B[2]
    to, of = np.einsum("kji,j->ki", front, (T[:3, :3] @ B[4].T)[:, 2]), B[3][:, 2]
    third = np.arctan2(to[:, 1], to[:, 0]) - np.arctan2(of[1], of[0])
    rest = np.swapaxes(front @ about_z(third) @ B[3], 1, 2) @ T[:3, :3] @ B[4].T
    q = np.zeros((len(x), 6))
    q[:, turning] = np.column_stack([x, y, third, np.arctan2(rest[:, 1, 0], rest[:, 0, 0])])
    end, J = pose_and_jacobian(rows, q, np.zeros(3))
    u, v = (J[:, :3, i] for i in range(6) if i not in turning)
    return ((T[:3, 3] - end[:, :3, 3]) * np.cross(u, v)).sum(axis=1)


@pytest.mark.parametrize("order", ORDERS)
def test_every_order_has_as_many_solutions_as_a_scan_counts(order):
    for seed in range(3):
        rows, q = drawn(order, seed)
        found, every, T = checked(rows, q)
        assert found.method == METHOD
        assert len(every) == count_by_scan(rows, T) <= 8


def test_solutions_are_exact_to_the_last_digits():
    rows, q = drawn("RRPRPR", 0)
    _, every, T = checked(rows, q)
    with mp.workdps(40):
        for p in every:
            exact = mp.findroot(lambda *x: misses(rows, x, T), [mp.mpf(float(v)) for v in p], tol=1e-30)
            assert max(abs(float(a - b)) for a, b in zip(exact, p, strict=True)) < 1e-12


def misses(rows, q, T):
    """Six differences from the target that are zero at a solution, in as many digits as mpmath counts."""
    M = mp.eye(4)
    for (kind, a, alpha, d, theta), x in zip(rows, q, strict=True):
        angle, height = (theta + x, d) if kind == "R" else (mp.mpf(theta), d + x)
        c, s, ca, sa = mp.cos(angle), mp.sin(angle), mp.cos(alpha), mp.sin(alpha)
        M *= mp.matrix([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, height], [0, 0, 0, 1]])
    goal = exact_pose(T)
    turned = M[:3, :3].T * goal[:3, :3]
    return [M[i, 3] - goal[i, 3] for i in range(3)] + [turned[2, 1], turned[0, 2], turned[1, 0]]


def exact_pose(T):
    """A pose whose rotation is one to the last digit."""
    goal = mp.matrix(T.tolist())
    Q, _ = mp.qr(goal[:3, :3])
    for i in range(3):
        for j in range(3):
            goal[i, j] = Q[i, j] * mp.sign(Q[i, j] * T[i, j])
    return goal


def assert_that_brute_force_finds_no_other(order, seed, starts):
    rows, q = drawn(order, seed)
    _, every, T = checked(rows, q)
    for p in all_solutions(rows, T, range(6), seed=seed, starts=starts):
        assert apart(order, p, every).min() < 1e-4


@pytest.mark.parametrize("order", core_first(ORDERS, ["PPRRRR", "RPRRPR", "RRPRPR"], 3))
def test_brute_force_finds_no_other(order):
    assert_that_brute_force_finds_no_other(order, 0, 300)


@pytest.mark.parametrize("seed", some_of(range(3, 10), 1))
@pytest.mark.parametrize("order", some_of(ORDERS, 3))
def test_ten_thousand_starts_find_no_other(order, seed):
    assert_that_brute_force_finds_no_other(order, seed, 10_000)


@pytest.mark.parametrize("order", THREE_SLIDE)
def test_three_turns_and_three_slides_have_two_solutions(order):
    rows, q = drawn(order, 1)
    found, every, T = checked(rows, q)
    assert (found.method, len(every)) == ("three turns in sequence", 2)
    assert len(all_solutions(rows, T, range(6), starts=100)) == 2
    batch = SolutionSolver(robot_of(rows), POSE).solve_batch([POSE.value(robot_of(rows), q)])
    assert (batch.complete[0], batch.counts[0] + batch.outside_counts[0]) == (True, 2)


def test_an_arm_of_which_two_slide_has_eight_solutions():
    rows, q = drawn("RPRRPR", SEED_OF_EIGHT)
    _, every, T = checked(rows, q)
    assert len(every) == count_by_scan(rows, T) == 8


@given(st.integers(0, 100_000), st.sampled_from(ORDERS))
@settings(max_examples=8)
def test_no_solution_is_missing_at_right_angles_where_they_are_said_to_be_all(seed, order):
    rng = np.random.default_rng(seed)
    rows = [
        (kind, float(rng.choice([0, 0.5, rng.uniform(-1, 1)])), float(rng.choice([0, H, -H, rng.uniform(-3, 3)])))
        for kind in order
    ]
    rows = [(*row, *((rng.uniform(-1, 1), 0.0) if row[0] == "R" else (0.0, float(rng.choice([0, H]))))) for row in rows]
    robot, q = robot_of(rows), rng.uniform(-1, 1, 6) * np.where(np.array(list(order)) == "R", 3, 1)
    target = POSE.value(robot, q)
    found = ik_solutions(robot, POSE, target, starts=2)
    if not found.complete:
        return
    every = np.vstack([found.q, found.outside_limits])
    for p in [q, *all_solutions(rows, target.homogeneous, range(6), starts=50)]:
        assert np.abs(p[np.array(list(order)) == "P"]).max() > 50 or apart(order, p, every).min() < 1e-4


def test_the_solver_answers_as_the_function_does():
    rows, q = drawn("RPRRPR", 2)
    robot, rng = robot_of(rows), np.random.default_rng(1)
    solver = SolutionSolver(robot, POSE)
    for target in (POSE.value(robot, q + 0.1 * rng.uniform(-1, 1, 6)) for _ in range(3)):
        expected = ik_solutions(robot, POSE, target)
        found = solver(target)
        assert (found.status, found.complete, found.method) == (expected.status, expected.complete, METHOD)
        assert found.q == pytest.approx(expected.q, abs=1e-8)


def test_out_of_reach_is_proven():
    rows, q = drawn("RPRRRP", 0)
    robot = robot_of(rows, slide=0.5)
    target = POSE.value(robot, q)
    target.translation = np.array([5.0, 0, 0])
    found = ik_solutions(robot, POSE, target)
    assert (found.status, found.complete) == (IKStatus.UNREACHABLE, True)
