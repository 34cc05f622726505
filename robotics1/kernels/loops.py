"""Joints in a loop with finitely many positions by formula: `ik/loops.py` and `ik/subproblems.py`, compiled.

A placement is [R p], (3, 4); Z(x) turns about z by x, or moves along it. Each function writes coordinates to the rows
of `found` and returns how many there are, or UNKNOWN where they are not finitely many or cannot be counted.
"""

import math

from robotics1.inputs import Array
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
    turn_to,
    turned_back,
)
from robotics1.kernels.real_roots import MANY, UNKNOWN, roots_of_one
from robotics1.kernels.scratch import scratch

PARALLEL = 1e-3  # sine of an angle between axes whose common plane is not to be trusted


@compiled(inner=True)
def point(A: Array, B: Array, slides: Array, c: Array, t: Array, found: Array) -> int:
    """Solve Z₀ A Z₁ B Z₂ c = t from what the first joint leaves alone; found is (MANY, 3).

    With p = A Z₁ B Z₂ c a first joint that turns leaves p_z and |p|², one that slides leaves p_x and p_y.
    """
    F, G, pairs, T = scratch((3, 3)), scratch((3, 3)), scratch((MANY, 2)), scratch((3, 4))
    p, moved, end = scratch(3), scratch(3), scratch(3)
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


@compiled(inner=True)
def orientation(A: Array, B: Array, R: Array, T: Array, x: Array, found: Array) -> int:
    """Solve Z₀ A Z₁ B Z₂ = R, rotations only; found is (2, 3), T (3, 4) and x (2,) are working space.

    zᵀ R z leaves two θ₁; then Z₀ turns A Z₁ B z to R z.
    """
    f0 = A[2, 2] * B[2, 2] - R[2, 2]
    f1 = A[2, 0] * B[0, 2] + A[2, 1] * B[1, 2]
    f2 = A[2, 1] * B[0, 2] - A[2, 0] * B[1, 2]
    if f1 * f1 + f2 * f2 < ON_AXIS * ON_AXIS:
        return UNKNOWN
    count = roots_of_one(0.0, f0, f1, f2, x)
    for n in range(count):
        set_to(A, T)
        after_joint(T, 0.0, x[n], B)
        c, s, determined = turn_to(T[0, 2], T[1, 2], R[0, 2], R[1, 2])
        if not determined:
            return UNKNOWN
        sine = cosine = 0.0  # of (Z₀ A Z₁ B)⁻¹ R
        for i in range(3):
            back = c * R[0, 0] + s * R[1, 0] if i == 0 else c * R[1, 0] - s * R[0, 0] if i == 1 else R[2, 0]
            cosine += T[i, 0] * back
            sine += T[i, 1] * back
        found[n, 0], found[n, 1], found[n, 2] = math.atan2(s, c), x[n], math.atan2(sine, cosine)
    return count


@compiled(inner=True)
def planar_loop(
    A: Array, B: Array, C: Array, slides: Array, normal: Array, T: Array, y: Array, found: Array
) -> int:  # fmt: skip
    """Solve Z₀ A Z₁ B Z₂ C = 1 but for moves along a normal, the normal of all motions.

    found is (2, 3); T (3, 4) and y (2,) are working space.

    The loop begins behind a joint that turns: the point on that joint's axis is a target for the two others.
    """
    k = 2 if not slides[2] else 1 if not slides[1] else 0
    if slides[k]:
        return UNKNOWN
    u, v, w = turned_back(A, normal[0], normal[1], normal[2])  # the normal behind joint 0
    if k == 0:
        return plane_behind_a_turn(B, C, A, slides, k, u, v, T, y, found)
    u, v, w = turned_back(B, u, v, w)
    if k == 1:
        return plane_behind_a_turn(C, A, B, slides, k, u, v, T, y, found)
    u, v, w = turned_back(C, u, v, w)
    return plane_behind_a_turn(A, B, C, slides, k, u, v, T, y, found)


@compiled(inner=True)
def plane_behind_a_turn(
    A: Array, B: Array, C: Array, slides: Array, k: int, nx: float, ny: float, T: Array, y: Array, found: Array
) -> int:
    """Solve Z_i A Z_j B Z_k C = 1 in a plane; joint k turns, i and j are behind it, and n is the plane's normal.

    Z_i A Z_j takes the origin of B to that of C⁻¹: a joint i that turns leaves its distance from the axis alone, one
    that slides leaves its place across.
    """
    i, j = (k + 1) % 3, (k + 2) % 3
    tx, ty, tz = turned_back(C, -C[0, 3], -C[1, 3], -C[2, 3])
    before = across(A, B, slides[i], slides[j], 0.0, nx, ny, tx, ty)
    middle = across(A, B, slides[i], slides[j], 1.0, nx, ny, tx, ty)
    f0, f1, f2 = function_of_samples(slides[j], before, middle, across(A, B, slides[i], slides[j], 2.0, nx, ny, tx, ty))
    count = roots_of_one(slides[j], f0, f1, f2, y)
    for m in range(count):
        set_to(A, T)
        after_joint(T, slides[j], y[m], B)
        c, s, x = 1.0, 0.0, tz - T[2, 3]
        if not slides[i]:
            c, s, determined = turn_to(T[0, 3], T[1, 3], tx, ty)
            if not determined:
                return UNKNOWN
            x = math.atan2(s, c)
        # (Z_i A Z_j B)⁻¹ C⁻¹ x, which Z_k takes to x
        px, py = c * C[0, 0] + s * C[0, 1], c * C[0, 1] - s * C[0, 0]
        cosine = T[0, 0] * px + T[1, 0] * py + T[2, 0] * C[0, 2]
        sine = T[0, 1] * px + T[1, 1] * py + T[2, 1] * C[0, 2]
        found[m, i], found[m, j], found[m, k] = x, y[m], math.atan2(sine, cosine)
    return count


@compiled(inline=True, inner=True)
def across(
    A: Array, B: Array, i_slides: float, j_slides: float, k: float, nx: float, ny: float, tx: float, ty: float
) -> float:  # fmt: skip
    """Return by how much Z_i misses to take A Z_j p to t, at sample k of joint j; p is the origin of B."""
    x, y, z = B[0, 3], B[1, 3], B[2, 3]
    if j_slides:
        z += k - 1.0
    elif k == 1.0:
        x, y = -y, x
    else:
        x, y = (1.0 - k) * x, (1.0 - k) * y
    px, py = A[0, 0] * x + A[0, 1] * y + A[0, 2] * z + A[0, 3], A[1, 0] * x + A[1, 1] * y + A[1, 2] * z + A[1, 3]
    if i_slides:  # across: z × n
        return float(nx * (py - ty) - ny * (px - tx))
    return float(px * px + py * py - tx * tx - ty * ty)


@compiled(inner=True)
def spherical(A: Array, slides: Array, here: float, there: float, found: Array) -> int:
    """Solve Z₀ A₀ Z₁ A₁ ... Z₅ A₅ = 1 where axes 0 to 2 go through one point; A is (6, 3, 4), found is (MANY, 6).

    The point is `here` on axis 0 and `there` on axis 2: A₂ Z₃ A₃ Z₄ A₄ Z₅ A₅ takes the one to the other.
    """
    c, t, z, R = scratch(3), scratch(3), scratch(3), scratch((3, 3))
    rest, turns, T, x, W = scratch((MANY, 3)), scratch((2, 3)), scratch((3, 4)), scratch(2), scratch((3, 4))
    A0, A1, A2, A3, A4, A5 = A[0], A[1], A[2], A[3], A[4], A[5]  # once, since references to views are counted
    z[0], z[1], z[2] = 0.0, 0.0, here
    place(A5, z, c)
    z[2] = there
    place_back(A2, z, t)
    many = point(A3, A4, slides[3:], c, t, rest)
    count = 0
    for n in range(many):
        set_to(A2, T)
        after_joint(T, slides[3], rest[n, 0], A3)
        after_joint(T, slides[4], rest[n, 1], A4)
        after_joint(T, slides[5], rest[n, 2], A5)
        for i in range(3):
            for j in range(3):
                R[i, j] = T[j, i]
        some = orientation(A0, A1, R, W, x, turns)
        if some == UNKNOWN or count + 2 > len(found):
            return UNKNOWN
        for m in range(some):
            for k in range(3):
                found[count, k], found[count, 3 + k] = turns[m, k], rest[n, k]
            count += 1
    return count if many != UNKNOWN else UNKNOWN


@compiled(inner=True)
def beside_a_plane(A: Array, slides: Array, normal: Array, found: Array) -> int:
    """Solve Z₀ A₀ Z₁ A₁ ... Z₅ A₅ = 1 where joints 0 to 2 move in a plane and joint 3 turns, as `ik/loops.py` says."""
    F, G, pairs, plane = scratch((3, 3)), scratch((3, 3)), scratch((MANY, 2)), scratch((2, 3))
    vectors, T, rest, W, y = scratch((7, 3)), scratch((3, 4)), scratch((3, 4)), scratch((3, 4)), scratch(2)
    n2, wanted, m = vectors[0], vectors[1], vectors[2]
    A0, A1, A2, A3, A4, A5 = A[0], A[1], A[2], A[3], A[4], A[5]  # once, since references to views are counted
    turn_back(A0, normal, m)
    turn_back(A1, m, n2)
    turn_back(A2, n2, wanted)
    if wanted[0] * wanted[0] + wanted[1] * wanted[1] < PARALLEL * PARALLEL:
        return UNKNOWN
    plane_equations(A, slides, normal, n2, wanted[2], vectors, F, G)
    many = common_roots(F, G, slides[4], slides[5], pairs)
    count = 0
    for n in range(many):
        set_to(A3, T)
        after_joint(T, slides[4], pairs[n, 0], A4)
        after_joint(T, slides[5], pairs[n, 1], A5)
        turn(T, normal, m)
        x, determined = first_coordinate(0.0, m, wanted)
        if not determined or count + 2 > len(found):
            return UNKNOWN
        set_to(A2, rest)
        after_joint(rest, 0.0, x, T)
        some = planar_loop(A0, A1, rest, slides, normal, W, y, plane)
        if some == UNKNOWN:
            return UNKNOWN
        for s in range(some):
            for k in range(3):
                found[count, k] = plane[s, k]
            found[count, 3], found[count, 4], found[count, 5] = x, pairs[n, 0], pairs[n, 1]
            count += 1
    return count if many != UNKNOWN else UNKNOWN


@compiled(inner=True)
def plane_equations(
    A: Array, slides: Array, normal: Array, n2: Array, wanted: float, vectors: Array, F: Array, G: Array
) -> None:
    """Write the two equations of `beside_a_plane` to F and G, (3, 3); vectors 2 to 6 of (7, 3) are working space.

    m = A₃ Z₄ A₄ Z₅ A₅ n is a direction, and p is where the origin comes, at the samples of the two joints.
    """
    m, p, u, at_m, at_p = vectors[2], vectors[3], vectors[4], vectors[5], vectors[6]
    A3, A4, A5 = A[3], A[4], A[5]
    for i in range(3):
        u[i] = A[1, i, 3]
    place(A[0], u, p)
    level = 0.0
    for i in range(3):
        level += normal[i] * p[i] + n2[i] * A[2, i, 3]
    for k in range(3):
        turn(A5, normal, m)
        sample_turn(slides[5], k, m, u)
        turn(A4, u, at_m)
        for i in range(3):
            p[i] = A5[i, 3]
        sample(slides[5], k, p, u)
        place(A4, u, at_p)
        for i in range(3):
            sample_turn(slides[4], i, at_m, u)
            turn(A3, u, m)
            sample(slides[4], i, at_p, u)
            place(A3, u, p)
            F[i, k] = m[2] - wanted
            G[i, k] = m[0] * p[0] + m[1] * p[1] + m[2] * p[2] + level
    functions_of_samples(slides[4], slides[5], F)
    functions_of_samples(slides[4], slides[5], G)


@compiled(inline=True, inner=True)
def sample_turn(slides: float, k: int, p: Array, moved: Array) -> None:
    """Do what `sample` does to a direction."""
    if slides:
        moved[0], moved[1], moved[2] = p[0], p[1], p[2]
    else:
        sample(0.0, k, p, moved)
