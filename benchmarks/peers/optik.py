"""optik: SLSQP with restarts, in Rust; one thread, at most 0.5 s, tol_f = 1e-12 of ½ |log(T⁻¹ T_d)|²."""

import numpy as np

from benchmarks.arms import Arm, Array
from benchmarks.peers import Solver


def make(arm: Arm) -> Solver:
    """Return optik's solver in its mode "speed"."""
    from optik import Robot, SolverConfig

    robot = Robot.from_urdf_file(str(arm.path), arm.base, arm.tool)
    robot.set_parallelism(1)
    config = SolverConfig(solution_mode="speed", max_time=0.5, tol_f=1e-12)

    def solve(target: Array, q0: Array) -> Array | None:
        answer = robot.ik(config, target, q0)
        return None if answer is None else np.array(answer[0])

    return Solver(solve, lambda target: target.homogeneous)
