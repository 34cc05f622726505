"""Loops of three joints in a plane, and the kernels of all solutions run by Python itself."""

import json
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, strategies as st
from scipy.spatial.transform import Rotation

from robotics1 import PoseTask, load_robot
from robotics1.ik import SolutionSolver
from robotics1.ik.subproblems import inverse, motion, planar_loop


def drawn_loop(seed):
    """Return placements, kinds of joints and coordinates that close a loop in the plane across z, some folded."""
    rng = np.random.default_rng(seed)
    prismatic = [bool(draw < 0.3) for draw in rng.random(3)]
    prismatic[int(rng.integers(3))] = False
    x, stretched = rng.uniform(-2, 2, 3), rng.random() < 0.3
    if stretched:
        x[int(rng.integers(3))] = 0.0
    turns = [0.0 if stretched else rng.uniform(-3, 3) for _ in range(3)]
    lying = [Rotation.from_euler("x", np.pi / 2) if slides else Rotation.identity() for slides in prismatic]
    frames = [(Rotation.from_euler("z", turn) * lies).as_matrix() for turn, lies in zip(turns, lying, strict=True)]
    places = [np.array([rng.uniform(0.2, 1), 0.0 if stretched else rng.uniform(-1, 1), 0.0]) for _ in range(2)]
    B = []
    for i in range(2):
        T = np.eye(4)
        T[:3, :3], T[:3, 3] = frames[i].T @ frames[i + 1], frames[i].T @ places[i]
        B.append(T)
    through = motion(prismatic[0], x[0]) @ B[0] @ motion(prismatic[1], x[1]) @ B[1] @ motion(prismatic[2], x[2])
    return [*B, inverse(through)], prismatic, x, frames[0].T @ [0.0, 0.0, 1.0]


@given(st.integers(0, 100_000))
def test_the_coordinates_of_a_loop_in_a_plane_close_it_and_the_drawn_ones_are_among_them(seed):
    B, prismatic, drawn, normal = drawn_loop(seed)
    found = planar_loop(B, prismatic, normal)
    if found is None:  # two parallel slides, or a joint above another: not finitely many
        return
    for x in found:
        T = np.eye(4)
        for placement, slides, value in zip(B, prismatic, x, strict=True):
            T = T @ motion(slides, value) @ placement
        across = T[:3, 3] - normal * (normal @ T[:3, 3])
        assert np.abs(across).max() < 1e-6
        assert T[:3, :3] == pytest.approx(np.eye(3), abs=1e-6)
    ways = np.where(prismatic, found - drawn, np.angle(np.exp(1j * (found - drawn))))
    assert np.abs(ways).max(axis=1).min() < 1e-6


PROGRAM = """
import json, sys
import numpy as np
from robotics1 import PoseTask, load_robot
from robotics1.ik import SolutionSolver
target = PoseTask().value(load_robot("ur5"), np.array(json.loads(sys.argv[1])))
print(json.dumps(SolutionSolver(load_robot("ur5"), PoseTask())(target).q.tolist()))
"""


def test_the_kernels_of_all_solutions_answer_the_same_with_the_compiler_switched_off(monkeypatch):
    robot, task, q = load_robot("ur5"), PoseTask(), [0.3, -1.1, 1.4, 0.2, 0.8, -0.5]
    compiled = SolutionSolver(robot, task)(task.value(robot, q)).q
    monkeypatch.setenv("NUMBA_DISABLE_JIT", "1")
    program = [sys.executable, "-c", PROGRAM, json.dumps(q)]
    run = subprocess.run(program, check=True, capture_output=True, text=True, timeout=300)
    assert len(compiled) == 8
    assert np.array(json.loads(run.stdout)) == pytest.approx(compiled, abs=1e-11)
