"""Candidates for all solutions of six joints with a spherical wrist or three joints of a plane, and of one to three."""

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.chain import PRISMATIC, Indices
from robotics1.kernels.compilation import compiled
from robotics1.kernels.equation_pairs import common_roots, function_of_samples, functions_of_samples, sample
from robotics1.kernels.loops import orientation, planar_loop, point
from robotics1.kernels.placements import after_joint, invert, place, set_to, turn_back
from robotics1.kernels.real_roots import roots_of_one
from robotics1.kernels.scratch import scratch

ROWS, TURNS, PLANE = 0, 1, 2  # kinds of formulas of one to three joints
HERE, THERE, NORMAL, LENGTH, LEAST = 0, 1, 2, 5, 6  # the entries of `numbers`, in metres; NORMAL takes three


@compiled(inner=True)
def one_row(slides: float, p: Array, row: Array, value: float, found: Array) -> int:
    """Solve row · Z(x) p = value; found is (MANY, 1)."""
    moved, values, x = scratch(3), scratch(3), scratch(2)
    for k in range(3):
        sample(slides, k, p, moved)
        values[k] = row[0] * moved[0] + row[1] * moved[1] + row[2] * moved[2] - value
    f0, f1, f2 = function_of_samples(slides, values[0], values[1], values[2])
    count = roots_of_one(slides, f0, f1, f2, x)
    for i in range(count):
        found[i, 0] = x[i]
    return count


@compiled(inner=True)
def two_rows(A: Array, slides: Array, c: Array, rows: Array, values: Array, found: Array) -> int:
    """Solve rows · Z₀ A Z₁ c = values; rows are (2, 3), found is (MANY, 2)."""
    F, G, p, moved = scratch((3, 3)), scratch((3, 3)), scratch(3), scratch(3)
    for k in range(3):
        sample(slides[1], k, c, moved)
        place(A, moved, p)
        for i in range(3):
            sample(slides[0], i, p, moved)
            F[i, k] = rows[0, 0] * moved[0] + rows[0, 1] * moved[1] + rows[0, 2] * moved[2] - values[0]
            G[i, k] = rows[1, 0] * moved[0] + rows[1, 1] * moved[1] + rows[1, 2] * moved[2] - values[1]
    functions_of_samples(slides[0], slides[1], F)
    functions_of_samples(slides[0], slides[1], G)
    return common_roots(F, G, slides[0], slides[1], found)


@compiled(contract=True, inner=True)
def placement(links: Array, i: int, A: Array) -> None:
    """Write the placement before joint i to A, (3, 4)."""
    for row in range(3):
        for column in range(4):
            A[row, column] = links[i, 4 * row + column]


@compiled(contract=True, inner=True)
def closing_placement(links: Array, goal: Array, A: Array) -> None:
    """Write P_n T⁻¹ P₀, which closes the loop of the joints, to A, (3, 4)."""
    T, P = scratch((3, 4)), scratch((3, 4))
    placement(links, len(links) - 1, A)
    invert(goal, T)
    after_joint(A, 1.0, 0.0, T)
    placement(links, int(np.int64(0)), P)  # a literal 0 is a type of its own, and would be compiled anew
    after_joint(A, 1.0, 0.0, P)


@compiled(contract=True, inner=True)
def loop_of_six(
    links: Array, goal: Array, link_of: Indices, joint_of: Indices, side: float, A: Array, L: Array, slides: Array
) -> None:
    """Write the placements behind the joints of a loop to A, (6, 3, 4), and whether each joint slides to slides, (6,).

    Args:
        links: with lengths in units, as the goal's.
        link_of, joint_of: (6,) which placement and which joint stand at each place of the loop.
        side: −1 for a loop that is gone through from its other end.
        L: (3, 4) working space.
    """
    for k in range(6):
        slides[k] = links[joint_of[k], PRISMATIC]
        if link_of[k] == 5:
            closing_placement(links, goal, L)
        else:
            placement(links, link_of[k] + 1, L)
        if side < 0.0:
            invert(L, A[k])
        else:
            set_to(L, A[k])


@compiled(contract=True, inner=True)
def in_order_of_joints(count: int, found: Array, joint_of: Indices, side: float, x: Array) -> None:
    """Write the coordinates of a loop, found, to x; both are (MANY, 6)."""
    for n in range(count):
        for k in range(6):
            x[n, joint_of[k]] = side * found[n, k]


@compiled(contract=True, inner=True)
def few_joints(links: Array, goal: Array, kind: int, rows: Indices, numbers: Array, x: Array) -> int:
    """Write candidates for one to three joints to x, (MANY, n), and return how many there are."""
    n = len(links) - 1
    slides, P, A, B = scratch(3), scratch((3, 4)), scratch((3, 4)), scratch((3, 4))
    c, t, d, S = scratch(3), scratch(3), scratch(3), scratch((2, 3))
    for k in range(n):
        slides[k] = links[k, PRISMATIC]
    placement(links, 0, P)
    placement(links, 1, A)
    placement(links, min(2, n), B)
    if kind == TURNS:
        C, R = scratch((3, 4)), scratch((3, 4))
        placement(links, 3, C)
        set_to(C, R)
        for i in range(3):  # R = P₀ᵀ R_d P₃ᵀ
            for j in range(3):
                R[i, j] = 0.0
                for k in range(3):
                    for m in range(3):
                        R[i, j] += P[k, i] * goal[k, m] * C[j, m]
        return orientation(A, B, R, scratch((3, 4)), scratch(2), x)
    if kind == PLANE:
        C = scratch((3, 4))
        closing_placement(links, goal, C)
        turn_back(P, numbers[NORMAL : NORMAL + 3], c)
        return planar_loop(A, B, C, slides, c, scratch((3, 4)), scratch(2), x)
    for i in range(3):
        c[i], d[i] = links[n, 4 * i + 3], goal[i, 3] - P[i, 3]
    if n == 3:
        turn_back(P, d, t)
        return point(A, B, slides, c, t, x)
    for i in range(n):
        t[i] = d[rows[i]]
        for j in range(3):
            S[i, j] = P[rows[i], j]
    return one_row(slides[0], c, S[0], t[0], x) if n == 1 else two_rows(A, slides, c, S, t, x)
