"""Inverse kinematics of one target or of many: descents from a start, and from new starts until one arrives."""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import CIRCULAR, LOWER, UNIT, UPPER, Indices
from robotics1.kernels.compilation import compiled
from robotics1.kernels.descent import copy, descend
from robotics1.kernels.pose import forward_kinematics, task_parts

NO_POSE, NO_START = -1, -2  # instead of a number of starts: the goal is no pose, the start is not finite
ORTHONORMAL = 1e-6 + 1e-12  # |RᵀR − 1| of what is taken for a rotation: 1e-6, as everywhere, and room for rounding
ENDLESS = 1e5  # of a start [rad]: beyond, whole turns are left out, since its last digits are no longer 1e-10
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


@compiled(inner=True)
def in_units(target: Array, unit: float, goal: Array) -> None:
    """Write a target, [R p] in metres, to goal, (3, 4), with p in units."""
    for i in range(3):
        for j in range(3):
            goal[i, j] = target[i, j]
        goal[i, 3] = target[i, 3] / unit


@compiled(contract=True)
def nearest_start(counted: Array, goal: Array, table: Array, first: int, last: int) -> int:
    """Return which of the rows first, ..., last − 1 of a table of starts has the pose nearest to the goal.

    Near means a small |p_d − p|² + ½ |R_d − R|², which for small angles is |p_d − p|² + θ²; of the position, just the
    coordinates that count.
    """
    turns = 0.5 if counted[3] + counted[4] + counted[5] > 0.0 else 0.0
    nearest, least = first, np.inf
    for s in range(first, last):
        square = 0.0
        for i in range(3):
            for j in range(3):
                d = goal[i, j] - table[s, 4 * i + j]
                square += turns * d * d
            d = goal[i, 3] - table[s, 4 * i + 3]
            square += counted[i] * d * d
        if square < least:
            nearest, least = s, square
    return nearest


@compiled()
def start_table(links: Array, starts: Array) -> Array:
    """Return (s, 12 + n): the poses at the starts, (s, n), row by row, and the starts."""
    table = np.empty((len(starts), 12 + starts.shape[1]))
    T, joint_axes = np.empty((3, 4)), np.empty((len(links) - 1, 6))
    for s in range(len(starts)):
        forward_kinematics(links, starts[s], T, joint_axes)
        for i in range(3):
            for j in range(4):
                table[s, 4 * i + j] = T[i, j]
        copy(starts[s], table[s, 12:])
    return table


@compiled(inner=True)
def inside(lower: float, upper: float, circular: float, x: float) -> float:
    """Return a joint value inside its limits: turned there if it can make whole turns, else at the nearer limit."""
    if circular != 0.0 and x < lower:
        x += TURN * math.ceil((lower - x) / TURN)
    if circular != 0.0 and x > upper:
        x -= TURN * math.ceil((x - upper) / TURN)
    return min(max(x, lower), upper)


@compiled()
def wind(limits: Array, around: Array, x: Array) -> bool:
    """Turn joints that can make whole turns to the value nearest to `around`, (n,), inside the limits.

    Return whether one was turned: that rounds its value, and |e| is another.
    """
    turned = False
    for j in range(len(x)):
        if limits[CIRCULAR, j] == 0.0:
            continue
        before = x[j]
        x[j] -= TURN * math.floor((x[j] - around[j]) / TURN + 0.5)
        x[j] = inside(limits[LOWER, j], limits[UPPER, j], 1.0, x[j])
        turned = turned or x[j] != before
    return turned


@compiled(inner=True)
def to_units(coordinates: Array, active: Indices, q: Array, x: Array, limits: Array) -> None:
    """Write what moves the chain, in units: of q, (nq,), to x, (n,), and of the limits to limits, (3, n).

    Of joints that have turned endlessly the whole turns are left out.
    """
    for j in range(len(active)):
        own = active[j]
        unit = coordinates[own, UNIT]
        x[j] = q[own] / unit
        limits[LOWER, j], limits[UPPER, j] = coordinates[own, LOWER] / unit, coordinates[own, UPPER] / unit
        limits[CIRCULAR, j] = coordinates[own, CIRCULAR]
        if limits[CIRCULAR, j] != 0.0 and abs(x[j]) > ENDLESS:
            x[j] %= TURN


@compiled(inner=True)
def from_units(coordinates: Array, active: Indices, x: Array, q: Array) -> None:
    """Write x, (n,), to the entries of q that move the chain."""
    for j in range(len(active)):
        own = active[j]
        q[own] = min(max(x[j] * coordinates[own, UNIT], coordinates[own, LOWER]), coordinates[own, UPPER])


@compiled()
def solve(
    links: Array, coordinates: Array, active: Indices, task: Array, table: Array, group: int, target: Array,
    q0: Array, from_q0: bool, q: Array,
) -> tuple[int, float]:  # fmt: skip
    """Write to q, (nq,), the solution, or the best that was found; return how many starts were tried, and |e|.

    The first start is q0, if it is wanted; then comes of each group of the table the start whose pose is nearest to
    the target. The arguments are few, since passing an array into a kernel takes a tenth of the time of a step.

    Args:
        links: of the chain, lengths in units.
        coordinates: (nq, 4) of each entry of q its LOWER and UPPER limit, CIRCULAR 1 if it can make whole turns, and
            the UNIT that counts as one.
        active: (n,) which entries of q move the chain.
        task: (11,) as `task_parts` has it.
        table: (s, 12 + n) of `start_table`; group: how many starts share a group.
        target: [R p], (3, 4) or more rows [m].
        q0: (nq,) the values of the joints that do not move the chain, moved inside the limits, and, from_q0, a start.
        q: (nq,) the result.
    """
    n = len(active)
    x, x0, best, found, goal = np.empty(n), np.empty(n), np.empty(n), np.empty(n), np.empty((3, 4))
    limits = np.empty((3, n))
    counted, axis, unit, tolerance = task_parts(task)
    if not is_pose(target):
        return NO_POSE, np.nan
    for j in range(len(q)):
        q[j] = inside(coordinates[j, LOWER], coordinates[j, UPPER], coordinates[j, CIRCULAR], q0[j])
        if not math.isfinite(q0[j]):
            return NO_START, np.nan
    in_units(target, unit, goal)
    to_units(coordinates, active, q, x0, limits)
    copy(x0, best)
    least, tried = np.inf, 0
    for start in range(-1 if from_q0 else 0, len(table) // group):
        if start < 0:
            copy(x0, x)
        else:
            copy(table[nearest_start(counted, goal, table, group * start, group * (start + 1)), 12:], x)
        error = descend(links, limits, counted, axis, unit, tolerance, goal, x, found)
        tried += 1
        if error < least:
            least = error
            copy(found, best)
        if least <= tolerance:
            break
    if wind(limits, x0, best):
        copy(best, x)
        least = descend(links, limits, counted, axis, unit, tolerance, goal, x, best)
    from_units(coordinates, active, best, q)
    return tried, least


@compiled()
def solve_all(
    links: Array, coordinates: Array, active: Indices, task: Array, table: Array, group: int, targets: Array,
    q0: Array, from_q0: bool, q: Array, tried: Indices, errors: Array,
) -> None:  # fmt: skip
    """Do what `solve` does for every target, (k, 4, 4); q0 is (k, nq)."""
    for i in range(len(targets)):
        tried[i], errors[i] = solve(
            links, coordinates, active, task, table, group, targets[i], q0[i], from_q0, q[i]
        )  # fmt: skip
