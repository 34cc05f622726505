"""Newton's method to a goal, how near to singular it ends, and how near two solutions are to meeting."""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import Indices
from robotics1.kernels.compilation import compiled
from robotics1.kernels.pose import forward_kinematics, geometric_jacobian

STEPS = 10  # of Newton's method
EXACT, REACHED = 1e-14, 1e-12  # |e| at which it ends, and that of a solution
FLAT = 1e-14  # of a pivot
ASIDE, LINEAR = 1e-8, 0.02  # step of differences, and how far they are followed
NEARBY = 4e-6  # [m, rad] from a singularity, where it is to be looked at


@compiled(contract=True)
def invert_matrix(n: int, J: Array, swaps: Indices) -> float:
    """Overwrite the first n rows and columns of J, (6, 6), with their inverse.

    Return 1 / (|J| |J⁻¹|) in Frobenius' norm, which is at most σ_min/σ_max; 0 where a pivot vanishes. By Gauss and
    Jordan with pivots, in place; outside of its first n rows and columns J is set to 0, so that the loops have a
    constant length, which the compiler writes out. swaps is (6,) working space.
    """
    square = 0.0
    for i in range(6):
        for j in range(6):
            if i >= n or j >= n:
                J[i, j] = 0.0
            square += J[i, j] * J[i, j]
    for k in range(n):
        pivot = k
        for i in range(k + 1, n):
            if abs(J[i, k]) > abs(J[pivot, k]):
                pivot = i
        swaps[k] = pivot
        if not abs(J[pivot, k]) > FLAT:
            return 0.0
        if pivot != k:
            for j in range(6):
                J[k, j], J[pivot, j] = J[pivot, j], J[k, j]
        factor = 1.0 / J[k, k]
        J[k, k] = 1.0
        for j in range(6):
            J[k, j] *= factor
        for i in range(6):
            if i != k:
                factor = J[i, k]
                J[i, k] = 0.0
                for j in range(6):
                    J[i, j] -= factor * J[k, j]
    for k in range(n - 1, -1, -1):
        if swaps[k] != k:
            for i in range(6):
                J[i, k], J[i, swaps[k]] = J[i, swaps[k]], J[i, k]
    other = 0.0
    for i in range(6):
        for j in range(6):
            other += J[i, j] * J[i, j]
    return 1.0 / math.sqrt(square * other)


@compiled(contract=True)
def inverse_jacobian(links: Array, rows: Indices, T: Array, axes: Array, J: Array, M: Array, swaps: Indices) -> float:
    """Write the inverse of the rows of J that count to M, and return the bound of `invert_matrix`."""
    n = len(rows)
    geometric_jacobian(links, T, axes, J)
    for i in range(n):
        for j in range(n):
            M[i, j] = J[rows[i], j]
    return invert_matrix(n, M, swaps)


@compiled(contract=True)
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


@compiled(contract=True)
def polish(
    links: Array, goal: Array, rows: Indices, x: Array, T: Array, axes: Array, J: Array, M: Array, swaps: Indices,
    e: Array, step: Array,
) -> tuple[float, float]:  # fmt: skip
    """Move x, (n,), by Newton's method to f(x) = goal; return the largest entry of the error, which is the least on the
    way where x does not get there, and a bound of σ_min/σ_max.

    J is (6, n), M (6, 6).
    """
    n = len(rows)
    error, sigma, least = np.inf, 0.0, np.inf
    for k in range(STEPS):
        forward_kinematics(links, x, T, axes)
        before, error = error, missing(T, goal, rows, e)
        least = min(least, error)
        if k > 0 and (error <= EXACT or (error <= REACHED and error > 0.5 * before)):
            break
        sigma = inverse_jacobian(links, rows, T, axes, J, M, swaps)
        if error <= EXACT or sigma == 0.0:
            break
        longest = 1.0
        for i in range(n):
            step[i] = 0.0
            for j in range(n):
                step[i] += M[i, j] * e[j]
            longest = max(longest, 2.0 * abs(step[i]))
        for i in range(n):
            x[i] += step[i] / longest
    return (error if error <= REACHED else max(least, 2.0 * REACHED)), sigma


@compiled(contract=True)
def norm(e: Array, rows: Indices, unit: float) -> float:
    """Return |e| in metres and radians."""
    square = 0.0
    for k in range(len(rows)):
        square += (unit * e[k] if rows[k] < 3 else e[k]) ** 2
    return math.sqrt(square)


@compiled(contract=True)
def distance_of_meeting(
    links: Array, goal: Array, rows: Indices, unit: float, M: Array, x: Array, y: Array, T: Array, axes: Array, e: Array
) -> float:
    """Return how far the goal is from one at which two close solutions x and z meet [m, rad], y being z − x.

    Where they meet J has a left null vector u. Nearby it is the longest row of M = J⁻¹, (6, 6), at x. Halfway between
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
            u = M[i, j] / unit if rows[j] < 3 else M[i, j]
            square += u * u
            product += M[i, j] * e[j]
        if square > longest:
            longest, across = square, abs(product) / math.sqrt(square)
    return across


@compiled(contract=True)
def near_singular(
    links: Array, rows: Indices, unit: float, x: Array, T: Array, axes: Array, J: Array, M: Array, swaps: Indices,
    e: Array, step: Array,
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
        bound = inverse_jacobian(links, rows, T, axes, J, M, swaps)
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
    geometric_jacobian(links, T, axes, J)
    for i in range(n):
        e[i] = 0.0
        for j in range(n):
            e[i] -= J[rows[i], j] * step[j] * here / square
    return norm(e, rows, unit) < NEARBY
