"""pink: differential inverse kinematics by quadratic programs, run to convergence, with new random starts.

The limits of the joints are in the program (gain 1), those of velocity are not: only the end counts here.
"""

from time import perf_counter

import numpy as np
import pinocchio as pin

from benchmarks.arms import ANGLE_TOLERANCE, POSITION_TOLERANCE, Arm, Array
from benchmarks.peers import Solver

ITERATIONS = 50  # of one start
TIME_LIMIT = 0.5  # [s]


def make(arm: Arm) -> Solver:
    """Return a loop over pink's `solve_ik` with the QP solver quadprog."""
    import quadprog  # noqa: F401 (absent as the peer itself is)
    from pink import Configuration, solve_ik
    from pink.exceptions import PinkError
    from pink.limits import ConfigurationLimit
    from pink.tasks import FrameTask

    model, lower, upper = arm.robot.model, arm.robot.lower, arm.robot.upper
    limits = [ConfigurationLimit(model, config_limit_gain=1.0)]
    task = FrameTask(arm.tool, position_cost=1.0, orientation_cost=1.0, lm_damping=1e-2)
    configuration = Configuration(model, model.createData(), (lower + upper) / 2)
    rng = np.random.default_rng(0)

    def descend(q: Array) -> Array | None:
        for _ in range(ITERATIONS):
            configuration.update(q)
            e = task.compute_error(configuration)
            if np.linalg.norm(e[:3]) < POSITION_TOLERANCE / 2 and np.linalg.norm(e[3:]) < ANGLE_TOLERANCE / 2:
                return q
            try:
                v = solve_ik(configuration, [task], 1.0, solver="quadprog", limits=limits, safety_break=False)
            except PinkError:
                return None
            q = np.clip(q + v, lower, upper)
        return None

    def solve(target: pin.SE3, q0: Array) -> Array | None:
        task.set_target(target)
        q, end = q0, perf_counter() + TIME_LIMIT
        while perf_counter() < end:
            answer = descend(q)
            if answer is not None:
                return answer
            q = rng.uniform(lower, upper)
        return None

    return Solver(solve, lambda target: target)
