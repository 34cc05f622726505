"""robotics1: the public call, with its checks of the target, its verification and its result."""

import pinocchio as pin

from benchmarks.arms import Arm, Array
from benchmarks.peers import Solver


def make(arm: Arm) -> Solver:
    """Return `IKSolver(robot, PoseTask())`."""
    from robotics1 import IKSolver, PoseTask

    solver = IKSolver(arm.robot, PoseTask())

    def solve(target: pin.SE3, q0: Array) -> Array | None:
        result = solver(target, q0)
        return result.q if result.converged else None

    return Solver(solve, lambda target: target)
