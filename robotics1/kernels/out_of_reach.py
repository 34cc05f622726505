"""The proof that a goal is out of reach: joint boxes are halved until none of them can hold a solution."""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.compilation import compiled
from robotics1.kernels.pose import forward_kinematics, pose_error, task_parts

OPEN = -1  # instead of a number of boxes: the proof does not succeed
ROUNDING = 1e-12  # of a pose, in units: boxes are not halved below
SPLITS = 48  # of the range of each joint: the depth of the stack of boxes


@compiled()
def exclude(
    links: Array, task: Array, goal: Array, speeds: Array, tolerance: Array, boxes: Array, count: int, most: int
) -> int:
    """Exclude joint boxes as long as there are some; return how many are left, 0 for a proof, or OPEN.

    In a box with centre c and half widths h the frame moves away from its place at c by Σ h_j ρ_j at most, and it
    turns by Σ h_j σ_j at most. If that is less than what is missing at c, no q of the box is a solution; else the box
    is halved where that helps most.

    Args:
        links: of the chain, lengths in units; task: as for `inverse.solve`; goal: [R p] in units, (3, 4).
        speeds: (2, n), ρ_j ≥ |∂p/∂x_j| in units, and σ_j ≥ |ω| of each coordinate, for all configurations.
        tolerance: (2,) of a solution, on the position in units and on the turn [rad].
        boxes: (s, 2 n) a stack of centres and half widths, changed in place; count: how many there are.
        most: how many boxes are looked at.

    Source: Moore, Kearfott, Cloud, Introduction to Interval Analysis, 2009, chapter 5 (the branching), with
    Lipschitz constants for the bounds.
    """
    n = speeds.shape[1]
    T, joint_axes, M, e = np.empty((3, 4)), np.empty((len(links) - 1, 6)), np.empty((3, 3)), np.empty(6)
    counted, axis, _, _ = task_parts(task)
    for _ in range(most):
        if count == 0:
            break
        box = boxes[count - 1]
        forward_kinematics(links, box[:n], T, joint_axes)
        pose_error(goal, axis, T, M, e)
        linear = math.sqrt(counted[0] * e[0] * e[0] + counted[1] * e[1] * e[1] + counted[2] * e[2] * e[2])
        angular = math.sqrt(counted[3] * e[3] * e[3] + counted[4] * e[4] * e[4] + counted[5] * e[5] * e[5])
        moved, turned, widest, most_moved = 0.0, 0.0, 0, -1.0
        for j in range(n):
            by = box[n + j] * speeds[0, j]
            turn = box[n + j] * speeds[1, j]
            moved += by
            turned += turn
            if by + turn > most_moved:
                widest, most_moved = j, by + turn
        if linear > moved + tolerance[0] + ROUNDING or angular > turned + tolerance[1] + ROUNDING:
            count -= 1
            continue
        missing = linear > tolerance[0] or angular > tolerance[1]
        if not missing or most_moved < ROUNDING or count == len(boxes):
            return OPEN
        half = 0.5 * box[n + widest]
        for j in range(2 * n):
            boxes[count, j] = box[j]
        boxes[count - 1, widest] -= half
        boxes[count, widest] += half
        boxes[count - 1, n + widest] = half
        boxes[count, n + widest] = half
        count += 1
    return count
