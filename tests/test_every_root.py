"""The real ones of all 16 complex roots, found without elimination, are all solutions of a general arm."""

import sys
from pathlib import Path

import numpy as np
import pytest
from test_all_solutions import H, R, robot_of

sys.path.insert(0, str(Path(__file__).parents[1]))

from benchmarks.all_solutions import ROWS
from benchmarks.every_root import every_root, jacobian, links
from benchmarks.root_counts import against_the_roots
from robotics1 import PoseTask, ik_solutions

POSE = PoseTask()
ARMS = ["Jaco-like 6R", "random 6R"]


def robot(rows):
    return robot_of([R(a, alpha, d) for a, alpha, d in rows])


@pytest.mark.parametrize("name", ARMS)
@pytest.mark.parametrize("seed", range(3))
def test_a_general_arm_has_the_real_ones_of_sixteen_roots(name, seed):
    q = np.random.default_rng(seed).uniform(-np.pi, np.pi, 6)
    roots, arm = every_root(ROWS[name], q), robot(ROWS[name])
    found = ik_solutions(arm, POSE, POSE.value(arm, q))
    assert (roots.certain, found.complete) == (True, True)
    assert len(found) == len(roots.real)
    for p in roots.real:
        assert np.abs(np.exp(1j * (found.q - p)) - 1).max(axis=1).min() < 1e-6


def test_the_arm_of_manocha_and_canny_has_sixteen_real_roots():
    degree = np.pi / 180
    rows = [(0.3, H, 0), (1, degree, 0), (0, H, 0.2), (1.5, degree, 0), (0, H, 0), (1, degree, 0)]
    q = np.array([2.1444256595, -2.7984865481, 1.3779326786, -1.9460662764, 2.1790735341, 0.2487673215])
    roots = every_root(rows, q)
    assert (roots.count, len(roots.real)) == (16, 16)


def test_a_wrong_count_is_wrong_in_the_table():
    q = np.random.default_rng(0).uniform(-np.pi, np.pi, (2, 6))
    right = {i: len(every_root(ROWS["random 6R"], p).real) for i, p in enumerate(q)}
    lines, figures = against_the_roots(ROWS["random 6R"], q, {"a": right, "b": right | {1: right[1] + 1}}, "a")
    assert lines == [["a", "2", "2", "1", "1"], ["b", "2", "1", "1", "0"]]
    assert figures == {"a": 100.0, "b": 50.0}


@pytest.mark.parametrize("side", [1, -1])
def test_real_roots_that_nearly_meet_are_real(side):
    """Beside a singularity along N(J) there is a second real root, about as far on the other side."""
    rows = ROWS["random 6R"]
    q = singular(rows)
    null = np.linalg.svd(jacobian(links(rows, q[None] + 0j))[0].real)[2][-1]
    roots = every_root(rows, q + side * 1e-4 * null)
    apart = np.sort(np.abs(np.exp(1j * (roots.real - q)) - 1).max(axis=1))
    assert apart[1] < 2e-4
    assert roots.certain


def singular(rows):
    """A configuration at which J loses rank, by bisection along a segment on which det J changes its sign."""
    rng = np.random.default_rng(5)

    def det(q):
        return np.linalg.det(jacobian(links(rows, q[None] + 0j))[0]).real

    while True:
        a, b = rng.uniform(-np.pi, np.pi, (2, 6))
        if det(a) * det(b) < 0:
            break
    for _ in range(60):
        middle = 0.5 * (a + b)
        a, b = (middle, b) if det(middle) * det(a) > 0 else (a, middle)
    return a
