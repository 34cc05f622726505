"""The configuration inside the joint limits whose pose misses a goal by least: Newton's method on ½ |e|²."""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import CIRCULAR, COORDINATE, LOWER, PRISMATIC, RATIO, UPPER, Indices
from robotics1.kernels.compilation import compiled
from robotics1.kernels.descent import copy
from robotics1.kernels.inverse import from_units, in_units, inside, to_units
from robotics1.kernels.pose import forward_kinematics, pose_error, task_parts

STEPS = 60
STATIONARY = 1e-14  # relative decrease of |e|² that is rounding
LEAST, MOST = 1e-12, 1e12  # damping μ, beside the largest curvature
WEAK = 1e-3  # μ to begin with


@compiled(inner=True)
def half_square(
    links: Array, counted: Array, axis: Array, unit: float, goal: Array, x: Array, T: Array, joint_axes: Array,
    M: Array, e: Array,
) -> float:  # fmt: skip
    """Return ½ |e|² at x, and write e, (6,): its linear rows in metres, and zero where they do not count."""
    forward_kinematics(links, x, T, joint_axes)
    pose_error(goal, axis, T, M, e)
    total = 0.0
    for i in range(6):
        e[i] *= counted[i] * (unit if i < 3 else 1.0)
        total += 0.5 * e[i] * e[i]
    return total


@compiled(inner=True)
def slope_and_curvature(
    links: Array, counted: Array, axis: Array, unit: float, T: Array, joint_axes: Array, e: Array, g: Array, H: Array,
    moves: Array,
) -> None:  # fmt: skip
    """Write the gradient g, (n,), and the Hessian H, (n, n), of ½ |e|².

    With the columns (v_j, ω_j) of J: g_j = −e·J_j and H_jk = J_j·J_k − e·∂J_j/∂x_k. A joint j before k carries k's
    motion along: ∂v_k/∂x_j = ω_j × v_k; of the rotation the symmetric part ½ ω_j × ω_k counts, and J·J is
    weighted with ½θ cot ½θ across the axis of the missing turn θ.
    """
    k, n = len(links) - 1, len(g)
    for j in range(n):
        g[j] = 0.0
        for i in range(n):
            H[i, j] = 0.0
    pointing = axis[0] != 0.0 or axis[1] != 0.0 or axis[2] != 0.0
    a = np.zeros(3)
    if pointing:
        for i in range(3):
            a[i] = T[i, 0] * axis[0] + T[i, 1] * axis[1] + T[i, 2] * axis[2]
    theta = math.sqrt(e[3] * e[3] + e[4] * e[4] + e[5] * e[5])
    across = 1.0
    if theta > 1e-4 and counted[3] + counted[4] + counted[5] > 2.5:
        half = theta if pointing else 0.5 * theta
        across = half / math.tan(half) if half < 3.0 else -3.0 / math.tan(0.14159)
    joint_motions(links, unit, T, joint_axes, moves)
    for j in range(k):
        own = int(links[j, COORDINATE])
        for i in range(6):
            g[own] -= e[i] * moves[j, i]
        for m in range(j, k):
            other = int(links[m, COORDINATE])
            h = product(counted, e, a, theta, across, moves[j], moves[m])
            h -= change(e, moves[j], moves[m], m > j)
            H[own, other] += h
            if m > j:
                H[other, own] += h


@compiled(inner=True)
def joint_motions(links: Array, unit: float, T: Array, joint_axes: Array, moves: Array) -> None:
    """Write the columns (v_j, ω_j) of J, (k, 6), one for each joint on the way, followers included."""
    for j in range(len(links) - 1):
        r = links[j, RATIO]
        dx, dy, dz = T[0, 3] - joint_axes[j, 3], T[1, 3] - joint_axes[j, 4], T[2, 3] - joint_axes[j, 5]
        for i in range(3):
            moves[j, 3 + i] = 0.0 if links[j, PRISMATIC] != 0.0 else r * joint_axes[j, i]
        if links[j, PRISMATIC] != 0.0:
            for i in range(3):
                moves[j, i] = r * unit * joint_axes[j, i]
        else:
            moves[j, 0] = r * unit * (joint_axes[j, 1] * dz - joint_axes[j, 2] * dy)
            moves[j, 1] = r * unit * (joint_axes[j, 2] * dx - joint_axes[j, 0] * dz)
            moves[j, 2] = r * unit * (joint_axes[j, 0] * dy - joint_axes[j, 1] * dx)


@compiled(inner=True)
def product(counted: Array, e: Array, a: Array, theta: float, across: float, one: Array, other: Array) -> float:
    """Return J_j·J_k: of positions, and of rotations weighted by `across` but along the axis of the missing turn."""
    h, dot, along, other_along, on_a, other_on_a = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(3):
        h += counted[i] * one[i] * other[i]
        dot += counted[3 + i] * one[3 + i] * other[3 + i]
        on_a += a[i] * one[3 + i]  # a is zero, but for a task that points an axis
        other_on_a += a[i] * other[3 + i]
        if theta > 1e-4:
            along += e[3 + i] * one[3 + i] / theta
            other_along += e[3 + i] * other[3 + i] / theta
    total: float = h + across * (dot - on_a * other_on_a) + (1.0 - across) * along * other_along
    return total


@compiled(inner=True)
def change(e: Array, one: Array, other: Array, before: bool) -> float:
    """Return e·∂J_j/∂x_k of a joint j that carries joint k, or is it."""
    x, y, z = one[3], one[4], one[5]
    h: float = (
        e[0] * (y * other[2] - z * other[1])
        + e[1] * (z * other[0] - x * other[2])
        + e[2] * (x * other[1] - y * other[0])
    )
    if before:
        h += 0.5 * e[3] * (y * other[5] - z * other[4])
        h += 0.5 * e[4] * (z * other[3] - x * other[5])
        h += 0.5 * e[5] * (x * other[4] - y * other[3])
    return h


@compiled(inner=True)
def solve_positive(H: Array, held: Array, damping: float, g: Array, L: Array, step: Array) -> bool:
    """Write to step the solution of (H + μ diag) step = −g for the joints that are not held; zero for the others.

    Return whether the matrix is positive definite: if not, nothing is written. Cholesky's decomposition, row by row.
    """
    n = len(g)
    for i in range(n):
        for j in range(i + 1):
            total = 1.0 if i == j else 0.0
            if held[i] == 0.0 and held[j] == 0.0:
                total = H[i, j] + (damping if i == j else 0.0)
            for m in range(j):
                total -= L[i, m] * L[j, m]
            if i == j:
                if not total > 0.0:
                    return False
                L[i, i] = math.sqrt(total)
            else:
                L[i, j] = total / L[j, j]
    for i in range(n):
        total = -g[i] if held[i] == 0.0 else 0.0
        for m in range(i):
            total -= L[i, m] * step[m]
        step[i] = total / L[i, i]
    for i in range(n - 1, -1, -1):
        total = step[i]
        for m in range(i + 1, n):
            total -= L[m, i] * step[m]
        step[i] = total / L[i, i]
    return True


@compiled(inner=True)
def least_miss(links: Array, limits: Array, counted: Array, axis: Array, unit: float, goal: Array, x: Array) -> float:
    """Move x, (n,), inside the limits to a stationary point of |e|², in [m, rad]; return |e|.

    x ← x − (H + μ 1)⁻¹ g; a joint that stands at a limit and would leave it is held. μ grows until the matrix is
    positive definite and |e| falls, and fades where it does.

    Source: Nocedal, Wright, Numerical Optimization, 2006, sections 3.4 and 16.7 (the projection); Bertsekas, SIAM J.
    Control and Optimization 20 (1982).
    """
    n, k = len(x), len(links) - 1
    T, joint_axes, M, e = np.empty((3, 4)), np.empty((k, 6)), np.empty((3, 3)), np.empty(6)
    g, H, L, step, held = np.empty(n), np.empty((n, n)), np.empty((n, n)), np.empty(n), np.empty(n)
    ahead, moves, trial = np.empty(n), np.empty((k, 6)), np.empty(6)
    value = half_square(links, counted, axis, unit, goal, x, T, joint_axes, M, e)
    if not math.isfinite(value) or value > 1e200:
        return math.sqrt(2.0 * value)
    mu = WEAK
    for _ in range(STEPS):
        half_square(links, counted, axis, unit, goal, x, T, joint_axes, M, e)
        slope_and_curvature(links, counted, axis, unit, T, joint_axes, e, g, H, moves)
        largest = 0.0
        for j in range(n):
            largest = max(largest, abs(H[j, j]))
            below, above = x[j] <= limits[LOWER, j] and g[j] > 0.0, x[j] >= limits[UPPER, j] and g[j] < 0.0
            held[j] = 1.0 if limits[CIRCULAR, j] == 0.0 and (below or above) else 0.0
        better = False
        while mu < MOST:
            if solve_positive(H, held, mu * max(largest, 1e-300), g, L, step):
                for j in range(n):
                    ahead[j] = x[j] + step[j]
                    if limits[CIRCULAR, j] == 0.0:
                        ahead[j] = min(max(ahead[j], limits[LOWER, j]), limits[UPPER, j])
                new = half_square(links, counted, axis, unit, goal, ahead, T, joint_axes, M, trial)
                if new < value:
                    better = True
                    break
            mu = max(4.0 * mu, 1e-8)
        if not better:
            break
        gain, value = value - new, new
        copy(ahead, x)
        mu = max(0.1 * mu, LEAST)
        if gain <= STATIONARY * value:
            break
    return math.sqrt(2.0 * value)


@compiled()
def nearest_misses(
    links: Array, coordinates: Array, active: Indices, task: Array, targets: Array, q: Array, errors: Array
) -> None:
    """Move each configuration q, (k, nq), to the least miss of its target, (k, 4, 4), near it, with its |e|, (k,).

    The other arguments are those of `inverse.solve`.
    """
    n = len(active)
    x, limits, goal = np.empty(n), np.empty((3, n)), np.empty((3, 4))
    counted, axis, unit, _ = task_parts(task)
    for i in range(len(targets)):
        in_units(targets[i], unit, goal)
        to_units(coordinates, active, q[i], x, limits)
        found = least_miss(links, limits, counted, axis, unit, goal, x)
        if found < errors[i]:
            for j in range(n):
                x[j] = inside(limits[LOWER, j], limits[UPPER, j], limits[CIRCULAR, j], x[j])
            from_units(coordinates, active, x, q[i])
            errors[i] = found
