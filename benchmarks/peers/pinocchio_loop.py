"""The loop that most people write: Pinocchio's calls and NumPy, damped least squares, new random starts.

Δq = Jᵀ (J Jᵀ + (10⁻⁶ + 0.05 |e|²) I)⁻¹ e with e = log(T⁻¹ T_d), cut at the limits; a new start after 30 iterations.
"""

from time import perf_counter

import numpy as np
import pinocchio as pin

from benchmarks.arms import ANGLE_TOLERANCE, POSITION_TOLERANCE, Arm, Array
from benchmarks.peers import Solver

ITERATIONS = 30  # of one start
TIME_LIMIT = 0.5  # [s]


def make(arm: Arm) -> Solver:
    """Return the loop."""
    model, lower, upper = arm.robot.model, arm.robot.lower, arm.robot.upper
    data, frame = model.createData(), model.getFrameId(arm.tool)
    rng = np.random.default_rng(0)
    identity = np.eye(6)

    def solve(target: pin.SE3, q0: Array) -> Array | None:
        q, end = q0, perf_counter() + TIME_LIMIT
        while perf_counter() < end:
            for _ in range(ITERATIONS):
                pin.computeJointJacobians(model, data, q)
                e = pin.log6(pin.updateFramePlacement(model, data, frame).actInv(target)).vector
                if np.linalg.norm(e[:3]) < POSITION_TOLERANCE / 2 and np.linalg.norm(e[3:]) < ANGLE_TOLERANCE / 2:
                    return q
                J = pin.getFrameJacobian(model, data, frame, pin.LOCAL)
                damping = 1e-6 + 0.05 * (e @ e)
                q = np.clip(q + J.T @ np.linalg.solve(J @ J.T + damping * identity, e), lower, upper)
            q = rng.uniform(lower, upper)
        return None

    return Solver(solve, lambda target: target)
