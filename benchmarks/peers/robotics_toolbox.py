"""Robotics Toolbox for Python: its C++ Levenberg–Marquardt, with at most 100 searches of 30 iterations (its default).

Its tolerance is of ½ eᵀe; the default of 1e-6 would let 1.4 mm pass, 1e-11 is 4.5 µm or µrad.
"""

import warnings
from typing import Any

from benchmarks.arms import Arm, Array
from benchmarks.peers import Solver

TOLERANCE = 1e-11


def make_chan_01(arm: Arm) -> Solver:
    """Return `ik_LM` with Chan's damping λ = 0.1."""
    return _make(arm, 0.1)


def make_chan_1(arm: Arm) -> Solver:
    """Return `ik_LM` with Chan's damping λ = 1."""
    return _make(arm, 1.0)


def elementary_transforms(arm: Arm) -> Any:
    """Return the arm as the peer's elementary transform sequence, without the overhead of its Robot class."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # it tells that no QP solver is installed
        import roboticstoolbox

    return roboticstoolbox.Robot.URDF(str(arm.path)).ets(start=arm.base, end=arm.tool)


def _make(arm: Arm, damping: float) -> Solver:
    ets = elementary_transforms(arm)

    def solve(target: Array, q0: Array) -> Array | None:
        answer = ets.ik_LM(target, q0, tol=TOLERANCE, joint_limits=True, k=damping, method="chan")
        return answer.q if answer.success else None

    return Solver(solve, lambda target: target.homogeneous)
