"""Arms of three joints in a plane at a pose, and the kernels of all solutions run by Python itself."""

import json
import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, strategies as st

from robotics1 import PlanarPoseTask, PoseTask, ik_solutions, load_robot
from robotics1.ik import SolutionSolver
from robotics1.textbook_robots import planar_arm

LETTERS = ("RRR", "RRP", "RPR", "PRR", "RPP", "PRP", "PPR")
PLANE = PlanarPoseTask()


@given(st.sampled_from(LETTERS), st.integers(0, 100_000), st.booleans())
def test_each_solution_of_an_arm_in_a_plane_has_the_pose_and_the_drawn_one_is_among_them(letters, seed, straight):
    """Some arms are straight, where two solutions are one; of PRP both slides would be parallel there."""
    rng, upper = np.random.default_rng(seed), [4.0 if letter == "P" else None for letter in letters]
    lengths = rng.uniform(0.2, 1.5, letters.count("R")).tolist()
    robot = planar_arm(letters, lengths, lower=[high and -high for high in upper], upper=upper)
    drawn = rng.uniform(-3, 3, 3)
    if straight and letters != "PRP":
        drawn[1:] = 0.0
    target = PLANE.value(robot, drawn)
    found = ik_solutions(robot, PLANE, target)
    assert found.complete
    for q in found.q:
        assert np.abs(PLANE.error(robot, q, target)).max() < 1e-9
    ways = np.where(robot.revolute, np.angle(np.exp(1j * (found.q - drawn))), found.q - drawn)
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
