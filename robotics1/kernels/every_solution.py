"""All solutions of targets at which no two of them meet: by formula, polished, each once, inside and outside limits.

A kernel returns UNKNOWN where it does not settle a target: near singular solutions, near families, and where none is
inside the limits. `ik/exact.py` then looks carefully.
"""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.block_jacobian import BLOCK, cosines_and_sines
from robotics1.kernels.candidates import (
    HERE,
    LEAST,
    LENGTH,
    NORMAL,
    THERE,
    few_joints,
    in_order_of_joints,
    loop_of_six,
)
from robotics1.kernels.chain import PRISMATIC, Indices
from robotics1.kernels.compilation import compiled
from robotics1.kernels.conditioning import inverse_jacobian
from robotics1.kernels.inverse import TURN
from robotics1.kernels.loops import beside_a_plane, spherical
from robotics1.kernels.newton import REACHED, distance_of_meeting, near_singular, norm, verified
from robotics1.kernels.real_roots import MANY, UNKNOWN
from robotics1.kernels.scaling import in_own_units
from robotics1.kernels.scratch import scratch, scratch_indices

LOWER, UPPER, MIDDLE, UNIT, ENTRY, SLIDES = 0, 1, 2, 3, 4, 5  # the columns of `joints`
INSIDE, COUNT, ERROR, EDGE = 0, 1, 2, 3  # the columns of `answers`
MISS, GAP, SIGMA = 0, 1, 2  # what is known of each solution: |e|, how far from a fold, a bound of σ_min/σ_max
MISSED = 1e-7  # |e| of what may be a solution after all
SAME, CLOSE = 1e-6, 0.05  # distance of solutions that are one, and of an arm of 1 m that may be about to meet
DOUBLE = 1e-9  # [units, rad] from a target at which two solutions meet, which is to be looked at
AT_LIMIT = 1e-9  # outside of a limit by rounding
SPLIT = 1e-3  # σ_min/σ_max below which two solutions meet, or one is near a family
TOGETHER = -(-6 * MANY // BLOCK) * BLOCK  # coordinates of all candidates, in whole blocks
SETTLED = "(f8[:, ::1], f8[:, ::1], f8[:, ::1], i8[::1], f8, f8, i8, f8[:, ::1], f8[:, ::1], f8[::1])"  # its arguments
DIGITS = 1e6  # solutions are sorted by their first six decimals


@compiled(contract=True, inner=True)
def apart(links: Array, x: Array, a: int, b: int, far: float, way: Array) -> float:
    """Write x[b] − x[a], angles the short way round, to way, (n,), and return its largest entry; ∞ if it is beyond far.

    The rows are numbers and not views, since references are counted, which would take longer than the work.
    """
    largest = 0.0
    for j in range(x.shape[1]):
        way[j] = x[b, j] - x[a, j]
        if links[j, PRISMATIC] == 0.0:
            way[j] -= TURN * np.rint(way[j] / TURN)
        if not abs(way[j]) < far:
            return np.inf
        largest = max(largest, abs(way[j]))
    return largest


@compiled(inner=True)  # not contract, which would be handed on to the reduction of the angles
def trigonometry(count: int, x: Array, trig: Array) -> None:
    """Write the first rows of x, (MANY, n), to the first row of trig, (3, TOGETHER), and their cosines and sines."""
    n, angles, cosines, sines = x.shape[1], trig[0], trig[1], trig[2]
    for c in range(count):
        for j in range(n):
            angles[c * n + j] = x[c, j]
    for begin in range(0, count * n, BLOCK):
        end = begin + BLOCK
        for i in range(count * n, end):
            angles[i] = 0.0
        cosines_and_sines(angles[begin:end], cosines[begin:end], sines[begin:end])


@compiled(contract=True, inner=True)
def each_once(
    links: Array, goal: Array, rows: Indices, unit: float, least: float, count: int, x: Array, of: Array,
    partner: Indices,
) -> int:  # fmt: skip
    """Verify or polish candidates x, (MANY, n), keep each solution once, and return how many; UNKNOWN in doubt.

    Of solution i, of[MISS, i] is |e|. If it nearly meets another, partner[i] is that one, and of[GAP, i] how far the
    target is from one where they do.
    """
    n = len(rows)
    T, axes, M, swaps = scratch((3, 4)), scratch((6, 6)), scratch((6, 6)), scratch_indices(6)
    e, step, trig = scratch(6), scratch(6), scratch((3, TOGETHER))
    trigonometry(count, x, trig)
    kept = int(np.int64(0))  # a literal 0 is a type of its own, for which Numba would compile `apart` anew
    close = CLOSE * math.sqrt(max(1.0, 1.0 / unit))
    for c in range(count):
        error, sigma = verified(links, goal, rows, least, x, c, trig, T, axes, M, swaps, e, step)
        if not error <= REACHED:
            if error < MISSED:
                return UNKNOWN
            continue
        nearest = np.inf
        for k in range(kept):
            nearest = min(nearest, apart(links, x, k, c, close, step))
        if nearest < SAME:
            continue
        of[MISS, kept], of[GAP, kept], of[SIGMA, kept], partner[kept] = norm(e, rows, unit), np.inf, sigma, kept
        for j in range(n):
            x[kept, j] = x[c, j]
        if nearest < np.inf:
            inverse_jacobian(links, rows, T, axes, M, swaps)
            for k in range(kept):
                if apart(links, x, k, kept, close, step) == np.inf:
                    continue
                gap = distance_of_meeting(links, goal, rows, unit, M, x[k], step, T, axes, e)
                if gap < DOUBLE * max(1.0, unit):
                    return UNKNOWN
                if gap < of[GAP, kept]:
                    of[GAP, kept], partner[kept] = gap, k
                if gap < of[GAP, k]:
                    of[GAP, k], partner[k] = gap, kept
        kept += 1
    for k in range(kept):
        if of[SIGMA, k] < least and least > SPLIT:
            return UNKNOWN
        alone = partner[k] == k  # else the distance of the singularity is known
        if of[SIGMA, k] < least and alone and near_singular(links, rows, unit, x[k], T, axes, M, swaps, e, step):
            return UNKNOWN
    return kept


@compiled(contract=True, inner=True)
def in_order(joints: Array, unit: float, count: int, x: Array, of: Array, q: Array) -> tuple[int, float, float]:
    """Write solutions to q, (MANY, nq): first those inside the limits, in ascending order, then the others.

    Return how many are inside, |e| of the first, and how far the target is from one where one of these meets another.
    Rows of q hold the values of the other joints already.
    """
    n = len(joints)
    outside, place = scratch_indices(MANY), scratch_indices(MANY)
    inside = 0
    for c in range(count):
        outside[c], place[c] = 0, c
        for j in range(n):
            value = x[c, j]
            if joints[j, SLIDES] == 0.0:
                value -= TURN * math.ceil((value - joints[j, MIDDLE]) / TURN - 0.5 - 1e-10)  # −π is π
            else:
                value *= unit
            margin = AT_LIMIT * joints[j, UNIT]
            if not joints[j, LOWER] - margin <= value <= joints[j, UPPER] + margin:
                outside[c] = 1
            x[c, j] = value
        if outside[c] == 0:
            inside += 1
            for j in range(n):
                x[c, j] = min(max(x[c, j], joints[j, LOWER]), joints[j, UPPER])
    for c in range(1, count):
        k = c
        while k > 0 and comes_before(joints, outside, x, place[k], place[k - 1]):
            place[k], place[k - 1] = place[k - 1], place[k]
            k -= 1
    for c in range(count):
        for j in range(n):
            q[c, np.int64(joints[j, ENTRY])] = x[place[c], j]
    edge = np.inf
    for c in range(count):
        if outside[c] == 0:  # where its partner is does not matter: J loses rank between them
            edge = min(edge, of[GAP, c])
    return inside, of[MISS, place[0]], edge


@compiled(contract=True, inner=True)
def comes_before(joints: Array, outside: Indices, x: Array, a: int, b: int) -> bool:
    """Whether solution a stands before b: those inside the limits first, then by the first joint that differs."""
    if outside[a] != outside[b]:
        return bool(outside[a] < outside[b])
    for j in range(len(joints)):
        p, r = np.rint(DIGITS * x[a, j]), np.rint(DIGITS * x[b, j])
        if p != r:
            return bool(p < r)
    return False


@compiled(contract=True, inner=True)
def settled(
    links: Array, goal: Array, joints: Array, rows: Indices, unit: float, least: float, count: int, x: Array, q: Array,
    answer: Array,
) -> None:  # fmt: skip
    """Write what is found from candidates x to q and to answer, as `solutions_of_a_wrist` does."""
    of, partner = scratch((3, MANY)), scratch_indices(MANY)
    answer[INSIDE], answer[COUNT], answer[ERROR], answer[EDGE] = 0.0, UNKNOWN, np.nan, np.inf
    if count > 0:
        count = each_once(links, goal, rows, unit, least, count, x, of, partner)
    if count == 0:
        answer[ERROR] = np.inf
    if count > 0:
        inside, error, edge = in_order(joints, unit, count, x, of, q)
        answer[INSIDE], answer[COUNT] = inside, (count if inside > 0 else UNKNOWN)
        answer[ERROR], answer[EDGE] = error, edge


@compiled(contract=True)
def solutions_of_a_wrist(
    links: Array, joints: Array, rows: Indices, link_of: Indices, joint_of: Indices, side: float, numbers: Array,
    targets: Array, q: Array, answers: Array,
) -> None:  # fmt: skip
    """Write all solutions of six joints with a spherical wrist to q, and what is known to answers, for every target.

    Args:
        links: of the chain [m].
        joints: (6, 6) of each joint its limits, what it is turned to, what counts as one, its entry of q, and whether
            it slides.
        rows: (6,) of the pose error.
        link_of, joint_of, side: as `loop_of_six` has them.
        numbers: as the constants HERE, ... of `candidates` say.
        targets: (k, 4, 4), in the axes of the links.
        q: (k, MANY, nq) the result; each row holds the other joints' values.
        answers: (k, 4) the result: how many are INSIDE the limits; the COUNT of all, UNKNOWN where the target is left
            to others, or none; the ERROR of the first, whether inside or not, ∞ if there is no solution at all, NaN in
            doubt; how far the target is from the EDGE, ∞ if that is not near.
    """
    scaled, goal, x = scratch((7, 15)), scratch((3, 4)), scratch((MANY, 6))
    A, L, found, slides = scratch((6, 3, 4)), scratch((3, 4)), scratch((MANY, 6)), scratch(6)
    for i in range(len(targets)):
        unit, count = in_own_units(links, targets[i], numbers[LENGTH], scaled, goal), UNKNOWN
        if unit > 0.0:
            loop_of_six(scaled, goal, link_of, joint_of, side, A, L, slides)
            count = spherical(A, slides, numbers[HERE] / unit, numbers[THERE] / unit, found)
            in_order_of_joints(count, found, joint_of, side, x)
        settled(scaled, goal, joints, rows, unit, numbers[LEAST], count, x, q[i], answers[i])


@compiled(contract=True)
def solutions_of_a_plane(
    links: Array, joints: Array, rows: Indices, link_of: Indices, joint_of: Indices, side: float, numbers: Array,
    targets: Array, q: Array, answers: Array,
) -> None:  # fmt: skip
    """Do what `solutions_of_a_wrist` does for six joints of which three move in a plane."""
    scaled, goal, x = scratch((7, 15)), scratch((3, 4)), scratch((MANY, 6))
    A, L, found, slides = scratch((6, 3, 4)), scratch((3, 4)), scratch((MANY, 6)), scratch(6)
    for i in range(len(targets)):
        unit, count = in_own_units(links, targets[i], numbers[LENGTH], scaled, goal), UNKNOWN
        if unit > 0.0:
            loop_of_six(scaled, goal, link_of, joint_of, side, A, L, slides)
            count = beside_a_plane(A, slides, numbers[NORMAL : NORMAL + 3], found)
            in_order_of_joints(count, found, joint_of, side, x)
        settled(scaled, goal, joints, rows, unit, numbers[LEAST], count, x, q[i], answers[i])


@compiled(contract=True)
def solutions_of_few(
    links: Array, joints: Array, rows: Indices, kind: int, numbers: Array, targets: Array, q: Array, answers: Array
) -> None:
    """Do what `solutions_of_a_wrist` does for one to three joints."""
    n = len(rows)
    scaled, goal, x = np.empty((n + 1, 15)), np.empty((3, 4)), np.empty((MANY, n))
    for i in range(len(targets)):
        unit, count = in_own_units(links, targets[i], numbers[LENGTH], scaled, goal), UNKNOWN
        if unit > 0.0:
            count = few_joints(scaled, goal, kind, rows, numbers, x)
        settled(scaled, goal, joints, rows, unit, numbers[LEAST], count, x, q[i], answers[i])


@compiled(contract=True)
def solutions_of_candidates(
    links: Array, joints: Array, rows: Indices, numbers: Array, target: Array, x: Array, q: Array, answer: Array
) -> None:
    """Do what `solutions_of_a_wrist` does for one target from candidates x, (k, 6), in radians and metres."""
    scaled, goal, candidates = scratch((7, 15)), scratch((3, 4)), scratch((MANY, 6))
    unit, count = in_own_units(links, target, numbers[LENGTH], scaled, goal), UNKNOWN
    if unit > 0.0 and len(x) <= MANY:
        count = len(x)
        for i in range(count):
            for j in range(6):
                candidates[i, j] = x[i, j] / unit if joints[j, SLIDES] != 0.0 else x[i, j]
    settled(scaled, goal, joints, rows, unit, numbers[LEAST], count, candidates, q, answer)
