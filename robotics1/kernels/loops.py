"""Joints in a loop with finitely many positions by formula: `ik/loops.py` and `ik/subproblems.py`, compiled.

A placement is [R p], (3, 4); Z(x) turns about z by x, or moves along it. Each function writes coordinates to the rows
of `found` and returns how many there are, or UNKNOWN where they are not finitely many or cannot be counted.
"""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import Indices
from robotics1.kernels.compilation import compiled
from robotics1.kernels.equation_pairs import common_roots, function_of_samples, functions_of_samples, sample
from robotics1.kernels.placements import (
    ON_AXIS,
    after_joint,
    first_coordinate,
    place,
    place_back,
    set_to,
    turn,
    turn_back,
)
from robotics1.kernels.real_roots import MANY, UNKNOWN, roots_of_one

WORK = 12  # rows of working space
PARALLEL = 1e-3  # sine of an angle between axes whose common plane is not to be trusted


@compiled()
def point(A: Array, B: Array, slides: Indices, c: Array, t: Array, found: Array) -> int:
    """Solve Z₀ A Z₁ B Z₂ c = t from what the first joint leaves alone; found is (MANY, 3).

    With p = A Z₁ B Z₂ c a first joint that turns leaves p_z and |p|², one that slides leaves p_x and p_y.
    """
    F, G, pairs, T = np.empty((3, 3)), np.empty((3, 3)), np.empty((MANY, 2)), np.empty((3, 4))
    p, moved, end = np.empty(3), np.empty(3), np.empty(3)
    for k in range(3):
        sample(slides[2], k, c, moved)
        place(B, moved, p)
        for i in range(3):
            sample(slides[1], i, p, moved)
            place(A, moved, end)
            if slides[0]:
                F[i, k], G[i, k] = end[0] - t[0], end[1] - t[1]
            else:
                F[i, k], G[i, k] = end[2] - t[2], 0.0
                for j in range(3):
                    G[i, k] += end[j] * end[j] - t[j] * t[j]
    functions_of_samples(slides[1], slides[2], F)
    functions_of_samples(slides[1], slides[2], G)
    count = common_roots(F, G, slides[1], slides[2], pairs)
    for n in range(count):
        set_to(A, T)
        after_joint(T, slides[1], pairs[n, 0], B)
        x = pairs[n, 1]
        if slides[2]:
            moved[0], moved[1], moved[2] = c[0], c[1], c[2] + x
        else:
            moved[0] = math.cos(x) * c[0] - math.sin(x) * c[1]
            moved[1], moved[2] = math.sin(x) * c[0] + math.cos(x) * c[1], c[2]
        place(T, moved, p)
        found[n, 0], determined = first_coordinate(slides[0], p, t)
        found[n, 1], found[n, 2] = pairs[n, 0], x
        if not determined:
            return UNKNOWN
    return count


@compiled()
def orientation(A: Array, B: Array, R: Array, work: Array, found: Array) -> int:
    """Solve Z₀ A Z₁ B Z₂ = R, rotations only; found is (2, 3), work (WORK, 4).

    zᵀ R z leaves two θ₁; then Z₀ turns A Z₁ B z to R z.
    """
    x, m, r, T = work[0], work[1], work[2], work[3:6]
    f0 = A[2, 2] * B[2, 2] - R[2, 2]
    f1 = A[2, 0] * B[0, 2] + A[2, 1] * B[1, 2]
    f2 = A[2, 1] * B[0, 2] - A[2, 0] * B[1, 2]
    if f1 * f1 + f2 * f2 < ON_AXIS * ON_AXIS:
        return UNKNOWN
    count = roots_of_one(0, f0, f1, f2, x)
    for n in range(count):
        set_to(A, T)
        after_joint(T, 0, x[n], B)
        for i in range(3):
            m[i], r[i] = T[i, 2], R[i, 2]
        first, determined = first_coordinate(0, m, r)
        if not determined:
            return UNKNOWN
        c, s = math.cos(first), math.sin(first)
        sine = cosine = 0.0  # of (Z₀ A Z₁ B)⁻¹ R
        for i in range(3):
            back = c * R[0, 0] + s * R[1, 0] if i == 0 else c * R[1, 0] - s * R[0, 0] if i == 1 else R[2, 0]
            cosine += T[i, 0] * back
            sine += T[i, 1] * back
        found[n, 0], found[n, 1], found[n, 2] = first, x[n], math.atan2(sine, cosine)
    return count


@compiled()
def planar_loop(A: Array, B: Array, C: Array, slides: Indices, normal: Array, work: Array, found: Array) -> int:
    """Solve Z₀ A Z₁ B Z₂ C = 1 but for moves along a normal, the normal of all motions.

    found is (2, 3), work (WORK, 4).

    The loop begins behind a joint that turns: the point on that joint's axis is a target for the two others.
    """
    n, back = work[9], work[10]
    if not slides[2]:
        turn_back(A, normal, n)
        turn_back(B, n, back)
        turn_back(C, back, n)
        return plane_behind_a_turn(A, B, C, slides, 0, 1, 2, n, work, found)
    turn_back(A, normal, n)
    if not slides[1]:
        turn_back(B, n, back)
        return plane_behind_a_turn(C, A, B, slides, 2, 0, 1, back, work, found)
    if not slides[0]:
        return plane_behind_a_turn(B, C, A, slides, 1, 2, 0, n, work, found)
    return UNKNOWN


@compiled()
def plane_behind_a_turn(
    A: Array, B: Array, C: Array, slides: Indices, i: int, j: int, k: int, n: Array, work: Array, found: Array
) -> int:
    """Solve Z_i A Z_j B Z_k C = 1 in a plane; joint k turns.

    Z_i A Z_j takes the origin of B to that of C⁻¹: a joint i that turns leaves its distance from the axis alone, one
    that slides leaves its place across.
    """
    c, t, p, moved, values, y, turned, T = work[0], work[1], work[2], work[3], work[4], work[5], work[11], work[6:9]
    for row in range(3):
        c[row] = B[row, 3]
        t[row] = -(C[0, row] * C[0, 3] + C[1, row] * C[1, 3] + C[2, row] * C[2, 3])
    for m in range(3):
        sample(slides[j], m, c, moved)
        place(A, moved, p)
        if slides[i]:  # across: z × n
            values[m] = n[0] * (p[1] - t[1]) - n[1] * (p[0] - t[0])
        else:
            values[m] = p[0] * p[0] + p[1] * p[1] - t[0] * t[0] - t[1] * t[1]
    f0, f1, f2 = function_of_samples(slides[j], values[0], values[1], values[2])
    count = roots_of_one(slides[j], f0, f1, f2, y)
    for m in range(count):
        set_to(A, T)
        after_joint(T, slides[j], y[m], B)
        p[0], p[1], p[2] = T[0, 3], T[1, 3], T[2, 3]
        x, determined = first_coordinate(slides[i], p, t)
        if not determined:
            return UNKNOWN
        cx, sx = (1.0, 0.0) if slides[i] else (math.cos(x), math.sin(x))
        for row in range(2):  # (Z_i A Z_j B)⁻¹ C⁻¹ x, which Z_k takes to x
            u, v = cx * T[0, row] - sx * T[1, row], sx * T[0, row] + cx * T[1, row]
            turned[row] = u * C[0, 0] + v * C[0, 1] + T[2, row] * C[0, 2]
        found[m, i], found[m, j], found[m, k] = x, y[m], math.atan2(turned[1], turned[0])
    return count


@compiled()
def spherical(A: Array, slides: Indices, here: float, there: float, found: Array) -> int:
    """Solve Z₀ A₀ Z₁ A₁ ... Z₅ A₅ = 1 where axes 0 to 2 go through one point; A is (6, 3, 4), found is (MANY, 6).

    The point is `here` on axis 0 and `there` on axis 2: A₂ Z₃ A₃ Z₄ A₄ Z₅ A₅ takes the one to the other.
    """
    c, t, z, R = np.empty(3), np.empty(3), np.zeros(3), np.empty((3, 3))
    rest, turns, T, work = np.empty((MANY, 3)), np.empty((2, 3)), np.empty((3, 4)), np.empty((WORK, 4))
    z[2] = here
    place(A[5], z, c)
    z[2] = there
    place_back(A[2], z, t)
    many = point(A[3], A[4], slides[3:], c, t, rest)
    count = 0
    for n in range(many):
        set_to(A[2], T)
        for k in range(3):
            after_joint(T, slides[3 + k], rest[n, k], A[3 + k])
        for i in range(3):
            for j in range(3):
                R[i, j] = T[j, i]
        some = orientation(A[0], A[1], R, work, turns)
        if some == UNKNOWN or count + 2 > len(found):
            return UNKNOWN
        for m in range(some):
            for k in range(3):
                found[count, k], found[count, 3 + k] = turns[m, k], rest[n, k]
            count += 1
    return count if many != UNKNOWN else UNKNOWN


@compiled()
def beside_a_plane(A: Array, slides: Indices, normal: Array, found: Array) -> int:
    """Solve Z₀ A₀ Z₁ A₁ ... Z₅ A₅ = 1 where joints 0 to 2 move in a plane and joint 3 turns, as `ik/loops.py` says."""
    F, G, pairs, plane = np.empty((3, 3)), np.empty((3, 3)), np.empty((MANY, 2)), np.empty((2, 3))
    work, vectors, T = np.empty((WORK, 4)), np.zeros((8, 3)), np.empty((3, 4))
    n2, wanted, m = vectors[0], vectors[1], vectors[2]
    turn_back(A[0], normal, m)
    turn_back(A[1], m, n2)
    turn_back(A[2], n2, wanted)
    if wanted[0] * wanted[0] + wanted[1] * wanted[1] < PARALLEL * PARALLEL:
        return UNKNOWN
    plane_equations(A, slides, normal, n2, wanted[2], vectors, F, G)
    many = common_roots(F, G, slides[4], slides[5], pairs)
    count = 0
    for n in range(many):
        set_to(A[3], T)
        after_joint(T, slides[4], pairs[n, 0], A[4])
        after_joint(T, slides[5], pairs[n, 1], A[5])
        turn(T, normal, m)
        x, determined = first_coordinate(0, m, wanted)
        if not determined or count + 2 > len(found):
            return UNKNOWN
        set_to(A[2], T)
        after_joint(T, 0, x, A[3])
        after_joint(T, slides[4], pairs[n, 0], A[4])
        after_joint(T, slides[5], pairs[n, 1], A[5])
        some = planar_loop(A[0], A[1], T, slides, normal, work, plane)
        if some == UNKNOWN:
            return UNKNOWN
        for s in range(some):
            for k in range(3):
                found[count, k] = plane[s, k]
            found[count, 3], found[count, 4], found[count, 5] = x, pairs[n, 0], pairs[n, 1]
            count += 1
    return count if many != UNKNOWN else UNKNOWN


@compiled()
def plane_equations(
    A: Array, slides: Indices, normal: Array, n2: Array, wanted: float, vectors: Array, F: Array, G: Array
) -> None:
    """Write the two equations of `beside_a_plane` to F and G, (3, 3); vectors 2 to 6 of (8, 3) are working space."""
    m, p, v, u, zero = vectors[2], vectors[3], vectors[4], vectors[5], vectors[6]
    for i in range(3):
        v[i] = A[1, i, 3]
    place(A[0], v, p)
    level = 0.0
    for i in range(3):
        level += normal[i] * p[i] + n2[i] * A[2, i, 3]
    for i in range(3):
        for k in range(3):
            behind(A, slides, i, k, normal, zero, u, v, m, p)
            F[i, k] = m[2] - wanted
            G[i, k] = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + level
    functions_of_samples(slides[4], slides[5], F)
    functions_of_samples(slides[4], slides[5], G)


@compiled()
def behind(
    A: Array, slides: Indices, i: int, k: int, direction: Array, at: Array, u: Array, v: Array, m: Array, p: Array
) -> None:
    """Write A₃ Z₄ A₄ Z₅ A₅ of a direction to m and of a point to p, at the samples i and k of the two joints.

    u and v, (3,), are working space.
    """
    place(A[5], at, u)
    sample(slides[5], k, u, v)
    place(A[4], v, u)
    sample(slides[4], i, u, v)
    place(A[3], v, p)
    turn(A[5], direction, u)
    sample_turn(slides[5], k, u, v)
    turn(A[4], v, u)
    sample_turn(slides[4], i, u, v)
    turn(A[3], v, m)


@compiled(inline=True)
def sample_turn(slides: int, k: int, p: Array, moved: Array) -> None:
    """Do what `sample` does to a direction."""
    if slides:
        moved[0], moved[1], moved[2] = p[0], p[1], p[2]
    else:
        sample(0, k, p, moved)
