"""ssik: solutions in closed form (7R arms: of sampled redundancy), in C++, where its list has the arm."""

from importlib import import_module
from typing import Any

import numpy as np
import pinocchio as pin

from benchmarks.arms import Arm, Array
from benchmarks.peers import NotThisArmError, Solver

ARMS = {"Panda": "franka_panda_ik", "UR5": "ur5_ik", "iiwa": "iiwa14_ik"}
SAME = 1e-9  # [m, rad]


def make_nearest(arm: Arm) -> Solver:
    """Return the solver of the one solution nearest to the start."""
    artifact, convert = artifact_of(arm)

    def solve(target: Array, q0: Array) -> Array | None:
        answers = artifact.solve(target, q_seed=q0, max_solutions=1)
        return answers[0].q if answers else None

    return Solver(solve, convert)


def make_all(arm: Arm) -> Solver:
    """Return the solver of all solutions, each geometric one told once; the first is verified."""
    artifact, convert = artifact_of(arm)

    def solve(target: Array, q0: Array) -> Array | None:
        answers = artifact.solve(target, enumerate_windings=False)
        return answers[0].q if answers else None

    return Solver(solve, convert)


def artifact_of(arm: Arm) -> tuple[Any, Any]:
    """Return the peer's module of the arm and the conversion of targets: its tool may be turned against ours.

    Raises:
        NotThisArmError: its tool does not stand still in ours.
    """
    import ssik

    listed = {entry.name: entry.import_path for entry in ssik.list_arms()}
    artifact = import_module(listed[ARMS[arm.name]])
    rng = np.random.default_rng(0)
    turns = [np.linalg.inv(arm.pose(q).homogeneous) @ artifact.fk(q) for q in (arm.random(rng) for _ in range(9))]
    spread = max(np.abs(turn - turns[0]).max() for turn in turns)
    if spread > SAME:
        raise NotThisArmError(f"its arm of this name is another: the tools differ by up to {spread:.0e} m")

    def convert(target: pin.SE3) -> Array:
        return target.homogeneous @ turns[0]

    return artifact, convert
