"""Inverse kinematics of one target: damped least squares from a start, and from new starts until one arrives."""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import CIRCULAR, LOWER, UPPER
from robotics1.kernels.compilation import compiled
from robotics1.kernels.damped_step import damped_step
from robotics1.kernels.pose import forward_kinematics, geometric_jacobian, leave_out, pose_error

DAMPING = 1e-9  # λ² at the target: small beside σ_min² of what still counts as regular
DAMPING_SLOPE = 0.05  # λ² = DAMPING + DAMPING_SLOPE |e|²: far away a short step, near the target Newton's
FAR = 10.0  # |e|², some half turn or three reaches, beyond which λ² grows no more: the way may be long
STEPS = 40  # of one descent
PATIENCE = 5  # steps without progress, after which the descent is given up
PROGRESS = 0.9  # what counts as progress: |e| falls below 0.9 of the least so far


@compiled()
def descend(
    links: Array, limits: Array, counted: Array, axis: Array, unit: float, tolerance: float, goal: Array,
    x: Array, best: Array,
) -> float:  # fmt: skip
    """Move x, (n,), towards the goal; write the best configuration on the way to best, (n,), and return its |e|.

    x ← x + Jᵀ (J Jᵀ + λ² 1)⁻¹ e with λ² = 1e-9 + 0.05 min(|e|², 10), inside the limits, until |e| is within the
    tolerance, the steps are used up, or no progress is made. Lengths are in units; |e| and tolerance in [m, rad].

    Source: Sugihara, IEEE Trans. Robotics 27 (2011): a damping that fades with the error converges like Newton's
    method and passes singularities.
    """
    n = len(x)
    T, joint_axes, M, columns = np.empty((3, 4)), np.empty((len(links) - 1, 6)), np.empty((3, 3)), np.empty((n, 6))
    e, A, y, held, wish, step = np.empty(6), np.empty((6, 6)), np.empty(6), np.empty(n), np.empty(n), np.empty(n)
    for j in range(n):
        wish[j] = 0.0
    least, stuck = np.inf, 0
    for _ in range(STEPS):
        forward_kinematics(links, x, T, joint_axes)
        pose_error(goal, axis, T, M, e)
        linear = counted[0] * e[0] * e[0] + counted[1] * e[1] * e[1] + counted[2] * e[2] * e[2]
        angular = counted[3] * e[3] * e[3] + counted[4] * e[4] * e[4] + counted[5] * e[5] * e[5]
        error = math.sqrt(unit * unit * linear + angular)
        stuck = 0 if error < PROGRESS * least else stuck + 1
        if error < least:
            least = error
            copy(x, best)
        if error <= tolerance or stuck == PATIENCE:
            break
        geometric_jacobian(links, T, joint_axes, columns.T)
        leave_out(counted, axis, T, columns, e)
        damped_step(columns, e, wish, DAMPING + DAMPING_SLOPE * min(linear + angular, FAR), limits, x, held, A, y, step)
        move(limits, step, x)
    return least


@compiled(inner=True)
def move(limits: Array, step: Array, x: Array) -> None:
    """Add a step to x, (n,), and put joints that it takes past a limit on the limit."""
    for j in range(len(x)):
        x[j] += step[j]
        if limits[CIRCULAR, j] == 0.0:
            x[j] = min(max(x[j], limits[LOWER, j]), limits[UPPER, j])


@compiled(inner=True)
def copy(source: Array, x: Array) -> None:
    """Write the entries of source to x: NumPy's assignment takes longer to compile than all the rest."""
    for j in range(len(x)):
        x[j] = source[j]
