"""Inverse kinematics of one target or of many: descents from a start, and from new starts until one arrives."""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import ChainArrays, Indices
from robotics1.kernels.compilation import compiled, prange
from robotics1.kernels.descent import copy, descend
from robotics1.kernels.forward import place_joints

NO_POSE, NO_START = -1, -2  # instead of a number of starts: the goal is no pose, the start is not finite
ORTHONORMAL = 1e-6  # |RᵀR − 1| of a matrix that is taken for a rotation
TURN = 2.0 * math.pi


@compiled()
def is_pose(goal: Array) -> bool:
    """Return whether [R p], (3, 4) or more rows, is finite and R is a rotation to within 1e-6."""
    for i in range(3):
        if not math.isfinite(goal[i, 3]):
            return False
        for j in range(i + 1):
            product = goal[0, i] * goal[0, j] + goal[1, i] * goal[1, j] + goal[2, i] * goal[2, j]
            if not abs(product - (1.0 if i == j else 0.0)) <= ORTHONORMAL:
                return False
    x = goal[1, 0] * goal[2, 1] - goal[2, 0] * goal[1, 1]
    y = goal[2, 0] * goal[0, 1] - goal[0, 0] * goal[2, 1]
    z = goal[0, 0] * goal[1, 1] - goal[1, 0] * goal[0, 1]
    return bool(x * goal[0, 2] + y * goal[1, 2] + z * goal[2, 2] > 0.0)


@compiled()
def in_units(target: Array, unit: float, goal: Array) -> None:
    """Write a target, [R p] in metres, to goal, (3, 4), with p in units."""
    for i in range(3):
        for j in range(3):
            goal[i, j] = target[i, j]
        goal[i, 3] = target[i, 3] / unit


@compiled(contract=True)
def nearest_start(counted: Array, goal: Array, poses: Array, first: int, last: int) -> int:
    """Return which of the poses first, ..., last − 1, each (12,) row by row, is nearest to the goal.

    Near means a small |p_d − p|² + ½ |R_d − R|², which for small angles is |p_d − p|² + θ²; of the position, just the
    coordinates that count.
    """
    turns = 0.5 if counted[3] + counted[4] + counted[5] > 0.0 else 0.0
    nearest, least = first, np.inf
    for s in range(first, last):
        square = 0.0
        for i in range(3):
            for j in range(3):
                d = goal[i, j] - poses[s, 4 * i + j]
                square += turns * d * d
            d = goal[i, 3] - poses[s, 4 * i + 3]
            square += counted[i] * d * d
        if square < least:
            nearest, least = s, square
    return nearest


@compiled()
def pose_table(chain: ChainArrays, starts: Array) -> Array:
    """Return the poses at the starts, (s, n), each (12,) row by row."""
    poses, T, lines = np.empty((len(starts), 12)), np.empty((3, 4)), np.empty((len(chain[2]), 6))
    for s in range(len(starts)):
        place_joints(chain, starts[s], T, lines)
        for i in range(3):
            for j in range(4):
                poses[s, 4 * i + j] = T[i, j]
    return poses


@compiled()
def wind(limits: Array, around: Array, x: Array) -> None:
    """Turn joints that can make whole turns to the value nearest to `around`, (n,), inside the limits."""
    for j in range(len(x)):
        if limits[2, j] == 0.0:
            continue
        x[j] -= TURN * np.round((x[j] - around[j]) / TURN)
        if x[j] < limits[0, j]:
            x[j] += TURN * math.ceil((limits[0, j] - x[j]) / TURN)
        if x[j] > limits[1, j]:
            x[j] -= TURN * math.ceil((x[j] - limits[1, j]) / TURN)


@compiled()
def solve(
    chain: ChainArrays, limits: Array, active: Indices, units: Array, box: Array, counted: Array, axis: Array,
    unit: float, tolerance: float, target: Array, q0: Array, starts: Array, poses: Array,
    group: int, first: int, q: Array,
) -> tuple[int, float]:  # fmt: skip
    """Write to q, (nq,), the solution, or the best that was found; return how many starts were tried, and |e|.

    Start −1 is q0, and start i the one of the i-th group of the table whose pose is nearest to the target.

    Args:
        chain: lengths in units of `unit` [m].
        limits: (3, n): lower and upper limits in units, and 1 for joints that can make whole turns.
        active: (n,) which entries of q move the chain; units: (n,) what counts as one of each.
        box: (2, nq) the limits of q.
        counted: (6,) 1 for the rows of the error that count; axis: (3,) the axis that is pointed, or zero.
        tolerance: on |e| [m, rad].
        target: [R p], (3, 4) or more rows [m].
        q0: (nq,) the start, and the value of the joints that do not move the chain.
        starts: (s, n) in units; poses: (s, 12); group: how many starts share a group.
        first: the first start.
        q: (nq,) the result.
    """
    n = len(active)
    x, x0, best, found, goal = np.empty(n), np.empty(n), np.empty(n), np.empty(n), np.empty((3, 4))
    if not is_pose(target):
        return NO_POSE, np.nan
    in_units(target, unit, goal)
    for j in range(len(q)):
        q[j] = min(max(q0[j], box[0, j]), box[1, j])
        if not math.isfinite(q0[j]):
            return NO_START, np.nan
    for j in range(n):
        x0[j] = q[active[j]] / units[j]
        best[j] = x0[j]
    least, tried = np.inf, 0
    for start in range(first, len(starts) // group):
        if start < 0:
            copy(x0, x)
        else:
            copy(starts[nearest_start(counted, goal, poses, group * start, group * (start + 1))], x)
        error = descend(chain, limits, counted, axis, unit, tolerance, goal, x, found)
        tried += 1
        if error < least:
            least = error
            copy(found, best)
        if least <= tolerance:
            break
    wind(limits, x0, best)
    for j in range(n):
        q[active[j]] = min(max(best[j] * units[j], box[0, active[j]]), box[1, active[j]])
    return tried, least


@compiled(parallel=True)
def solve_all(
    chain: ChainArrays, limits: Array, active: Indices, units: Array, box: Array, counted: Array, axis: Array,
    unit: float, tolerance: float, targets: Array, q0: Array, starts: Array,
    poses: Array, group: int, first: int, q: Array, tried: Indices, errors: Array,
) -> None:  # fmt: skip
    """Do what `solve` does for every target, (k, 4, 4), on all cores; q0 is (k, nq)."""
    for i in prange(len(targets)):
        number, error = solve(
            chain, limits, active, units, box, counted, axis, unit, tolerance, targets[i], q0[i],
            starts, poses, group, first, q[i],
        )  # fmt: skip
        tried[i] = number
        errors[i] = error
