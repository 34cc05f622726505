"""Newton's method to a goal, how near to singular it ends, and how near two solutions are to meeting."""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import PRISMATIC, Indices
from robotics1.kernels.compilation import compiled
from robotics1.kernels.conditioning import inverse_jacobian, is_far_from_singular, transposed_jacobian
from robotics1.kernels.pose import after_turn, forward_kinematics

STEPS = 10  # of Newton's method
EXACT, REACHED = 1e-14, 1e-12  # |e| at which it ends, and that of a solution
ASIDE, LINEAR = 1e-8, 0.02  # step of differences, and how far they are followed
NEARBY = 4e-6  # [m, rad] from a singularity, where it is to be looked at


@compiled(contract=True, inner=True)
def missing(T: Array, goal: Array, rows: Indices, e: Array) -> float:
    """Write the rows of (p_d − p, skew part of R_d Rᵀ) that count to e, (n,), return the largest; ∞ for a half turn."""
    largest, turns = 0.0, False
    for k in range(len(rows)):
        i = rows[k]
        if i < 3:
            e[k] = goal[i, 3] - T[i, 3]
        else:
            a, b = (i - 2) % 3, (i - 1) % 3  # the other two axes, in order
            e[k] = 0.0
            for j in range(3):
                e[k] += 0.5 * (goal[b, j] * T[a, j] - goal[a, j] * T[b, j])
            turns = True
        largest = max(largest, abs(e[k]))
    cosine = 1.0
    if turns:
        cosine = -1.0
        for i in range(3):
            for j in range(3):
                cosine += goal[i, j] * T[i, j]
    return largest if cosine > 0.0 else np.inf


@compiled(contract=True, inner=True)
def polish(
    links: Array, goal: Array, rows: Indices, x: Array, T: Array, axes: Array, M: Array, swaps: Indices, e: Array,
    step: Array,
) -> tuple[float, float]:  # fmt: skip
    """Move x, (n,), by Newton's method to f(x) = goal; return the largest entry of the error, which is the least on the
    way where x does not get there, and a bound of σ_min/σ_max.
    """
    n = len(rows)
    error, sigma, least = np.inf, 0.0, np.inf
    for k in range(STEPS):
        forward_kinematics(links, x, T, axes)
        before, error = error, missing(T, goal, rows, e)
        least = min(least, error)
        if k > 0 and (error <= EXACT or (error <= REACHED and error > 0.5 * before)):
            break
        sigma = inverse_jacobian(links, rows, T, axes, M, swaps)
        if error <= EXACT or sigma == 0.0:
            break
        longest = 1.0
        for i in range(n):
            step[i] = 0.0
            for j in range(n):
                step[i] += M[j, i] * e[j]
            longest = max(longest, 2.0 * abs(step[i]))
        for i in range(n):
            x[i] += step[i] / longest
    return (error if error <= REACHED else max(least, 2.0 * REACHED)), sigma


@compiled(contract=True, inner=True)
def verified(
    links: Array, goal: Array, rows: Indices, least: float, x: Array, c: int, trig: Array, T: Array, axes: Array,
    M: Array, swaps: Indices, e: Array, step: Array,
) -> tuple[float, float]:  # fmt: skip
    """Do what `polish` does for x[c], (n,), with cosines and sines as `trigonometry` writes them.

    Where x[c] needs no step, it takes a fifth of the time; the bound of σ_min/σ_max is then ∞ where the determinant
    of J tells that it is above `least`.
    """
    place_solution(links, x, c, trig, T, axes)
    error = missing(T, goal, rows, e)
    if not error <= EXACT:
        return polish(links, goal, rows, x[c], T, axes, M, swaps, e, step)
    transposed_jacobian(links, rows, T, axes, M)
    if is_far_from_singular(len(rows), M, least):
        return error, np.inf
    return error, inverse_jacobian(links, rows, T, axes, M, swaps)


@compiled(contract=True, inline=True, inner=True)
def place_solution(links: Array, x: Array, c: int, trig: Array, T: Array, axes: Array) -> None:
    """Do what `forward_kinematics` does at x[c], for joints that each have a coordinate of their own."""
    n = x.shape[1]
    for i in range(3):
        for j in range(4):
            T[i, j] = links[0, 4 * i + j]
    for joint in range(n):
        for i in range(3):
            axes[joint, i], axes[joint, 3 + i] = T[i, 2], T[i, 3]
        if links[joint, PRISMATIC] != 0.0:
            for i in range(3):
                T[i, 3] += x[c, joint] * T[i, 2]
            after_turn(links, joint, 1.0, 0.0, T)
        else:
            after_turn(links, joint, trig[1, c * n + joint], trig[2, c * n + joint], T)


@compiled(contract=True, inner=True)
def norm(e: Array, rows: Indices, unit: float) -> float:
    """Return |e| in metres and radians."""
    square = 0.0
    for k in range(len(rows)):
        entry = unit * e[k] if rows[k] < 3 else e[k]
        square += entry * entry
    return math.sqrt(square)


@compiled(contract=True, inner=True)
def distance_of_meeting(
    links: Array, goal: Array, rows: Indices, unit: float, M: Array, x: Array, y: Array, T: Array, axes: Array, e: Array
) -> float:
    """Return how far the goal is from one at which two close solutions x and z meet [m, rad], y being z − x.

    Where they meet J has a left null vector u. Nearby it is the longest row of J⁻¹ = Mᵀ, (6, 6), at x. Halfway between
    them e = goal − f leaves the boundary by uᵀ e; the rest of e is a way along the boundary.
    """
    n = len(x)
    for i in range(n):
        y[i] = x[i] + 0.5 * y[i]
    forward_kinematics(links, y, T, axes)
    missing(T, goal, rows, e)
    longest, across = 0.0, np.inf
    for i in range(n):
        square = product = 0.0
        for j in range(n):
            u = M[j, i] / unit if rows[j] < 3 else M[j, i]
            square += u * u
            product += M[j, i] * e[j]
        if square > longest:
            longest, across = square, abs(product) / math.sqrt(square)
    return across


@compiled(contract=True, inner=True)
def near_singular(
    links: Array, rows: Indices, unit: float, x: Array, T: Array, axes: Array, M: Array, swaps: Indices, e: Array,
    step: Array,
) -> bool:  # fmt: skip
    """Whether a singular configuration near x may have a value f nearer than NEARBY to f(x).

    s = 1/|J⁻¹| is linear near a singularity, up to its sign: the nearest is Δx = −s ∇s / |∇s|² away, by differences,
    and J Δx is what f changes by.
    """
    n = len(rows)
    here = there = square = 0.0
    for j in range(-1, n):
        if j >= 0:
            x[j] += ASIDE
        forward_kinematics(links, x, T, axes)
        bound = inverse_jacobian(links, rows, T, axes, M, swaps)
        if bound == 0.0:
            return True
        there = 0.0
        for a in range(n):
            for b in range(n):
                there += M[a, b] * M[a, b]
        there = 1.0 / math.sqrt(there)
        if j < 0:
            here = there
        else:
            x[j] -= ASIDE
            step[j] = (there - here) / ASIDE
            square += step[j] * step[j]
    if square * LINEAR * LINEAR < here * here:
        return True
    forward_kinematics(links, x, T, axes)
    transposed_jacobian(links, rows, T, axes, M)
    for i in range(n):
        e[i] = 0.0
        for j in range(n):
            e[i] -= M[j, i] * step[j] * here / square
    return norm(e, rows, unit) < NEARBY
