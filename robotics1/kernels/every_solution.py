"""All solutions of targets at which no two of them meet: by formula, polished, each once, inside and outside limits.

A kernel returns UNKNOWN where it does not settle a target: near singular solutions, near families, and where none is
inside the limits. `ik/exact.py` then looks carefully.
"""

import math

import numpy as np

from robotics1.inputs import Array
from robotics1.kernels.candidates import LEAST, LENGTH, few_joints, six_joints
from robotics1.kernels.chain import PRISMATIC, Indices
from robotics1.kernels.compilation import compiled
from robotics1.kernels.inverse import TURN, is_pose
from robotics1.kernels.newton import REACHED, distance_of_meeting, near_singular, norm, polish
from robotics1.kernels.real_roots import MANY, UNKNOWN

LOWER, UPPER, MIDDLE, UNIT, ENTRY, SLIDES = 0, 1, 2, 3, 4, 5  # the columns of `joints`
INSIDE, COUNT, ERROR, EDGE = 0, 1, 2, 3  # the columns of `answers`
MISSED = 1e-7  # |e| of what may be a solution after all
SAME, CLOSE = 1e-6, 0.05  # distance of solutions that are one, and of an arm of 1 m that may be about to meet
DOUBLE = 1e-9  # [units, rad] from a target at which two solutions meet, which is to be looked at
AT_LIMIT = 1e-9  # outside of a limit by rounding
SPLIT = 1e-3  # σ_min/σ_max below which two solutions meet, or one is near a family
DIGITS = 1e6  # solutions are sorted by their first six decimals


@compiled(contract=True)
def scaled_links(links: Array, unit: float, scaled: Array) -> None:
    """Write links with lengths in units."""
    for i in range(len(links)):
        for j in range(links.shape[1]):
            scaled[i, j] = links[i, j] / unit if j in (3, 7, 11) else links[i, j]


@compiled(contract=True)
def unit_of(links: Array, goal: Array, length: float) -> float:
    """Return what counts as one length: that of the arm and of the way to the goal."""
    x, y, z = goal[0, 3] - links[0, 3], goal[1, 3] - links[0, 7], goal[2, 3] - links[0, 11]
    unit = length + math.sqrt(x * x + y * y + z * z)
    return unit if unit > 0.0 else 1.0


@compiled(contract=True)
def way_between(links: Array, x: Array, y: Array, way: Array) -> float:
    """Write y − x to way, (n,), angles the short way round, and return its largest entry."""
    apart = 0.0
    for j in range(len(x)):
        way[j] = y[j] - x[j]
        if links[j, PRISMATIC] == 0.0:
            way[j] -= TURN * math.floor(way[j] / TURN + 0.5)
        apart = max(apart, abs(way[j]))
    return apart


@compiled(contract=True)
def polished_once(
    links: Array, goal: Array, rows: Indices, unit: float, least: float, count: int, x: Array, errors: Array,
    partner: Indices, near: Array,
) -> int:  # fmt: skip
    """Polish candidates x, (MANY, n), keep each solution once, and return how many there are; UNKNOWN in doubt.

    Of two that nearly meet, near[i] is how far the target is from one where they do, and partner[i] the other.
    """
    n = len(rows)
    T, axes, J, e = np.empty((3, 4)), np.empty((n, 6)), np.empty((6, n)), np.empty(n)
    M, swaps, step, sigmas = np.empty((6, 6)), np.empty(6, dtype=np.int64), np.empty(n), np.empty(MANY)
    kept, close = 0, CLOSE * math.sqrt(max(1.0, 1.0 / unit))
    for c in range(count):
        error, sigma = polish(links, goal, rows, x[c], T, axes, J, M, swaps, e, step)
        if not error <= REACHED:
            if error < MISSED:
                return UNKNOWN
            continue
        new = True
        for k in range(kept):
            new = new and way_between(links, x[k], x[c], step) >= SAME
        if not new:
            continue
        near[kept], partner[kept], sigmas[kept] = np.inf, kept, sigma
        errors[kept] = norm(e, rows, unit)
        for j in range(n):
            x[kept, j] = x[c, j]
        for k in range(kept):
            if way_between(links, x[k], x[kept], step) < close:
                gap = distance_of_meeting(links, goal, rows, unit, M, x[k], step, T, axes, e)
                if gap < DOUBLE * max(1.0, unit):
                    return UNKNOWN
                if gap < near[kept]:
                    near[kept], partner[kept] = gap, k
                if gap < near[k]:
                    near[k], partner[k] = gap, kept
        kept += 1
    for k in range(kept):
        if sigmas[k] < least and least > SPLIT:
            return UNKNOWN
        alone = partner[k] == k  # else the distance of the singularity is known
        if sigmas[k] < least and alone and near_singular(links, rows, unit, x[k], T, axes, J, M, swaps, e, step):
            return UNKNOWN
    return kept


@compiled(contract=True)
def in_order(
    joints: Array, unit: float, count: int, x: Array, errors: Array, near: Array, q: Array
) -> tuple[int, float, float]:
    """Write solutions to q, (MANY, nq): first those inside the limits, in ascending order, then the others.

    Return how many are inside, |e| of the first, and how far the target is from one where one of these meets another.
    Rows of q hold the values of the other joints already.
    """
    n = len(joints)
    outside, place = np.empty(count, dtype=np.int64), np.empty(count, dtype=np.int64)
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
            q[c, int(joints[j, ENTRY])] = x[place[c], j]
    edge = np.inf
    for c in range(count):
        if outside[c] == 0:  # where its partner is does not matter: J loses rank between them
            edge = min(edge, near[c])
    return inside, errors[place[0]], edge


@compiled(contract=True)
def comes_before(joints: Array, outside: Indices, x: Array, a: int, b: int) -> bool:
    """Whether solution a stands before b: those inside the limits first, then by the first joint that differs."""
    if outside[a] != outside[b]:
        return bool(outside[a] < outside[b])
    for j in range(len(joints)):
        p, r = np.round(DIGITS * x[a, j]), np.round(DIGITS * x[b, j])
        if p != r:
            return bool(p < r)
    return False


@compiled(contract=True)
def scaled_goal(target: Array, unit: float, goal: Array) -> None:
    """Write a target, [R p] in metres, to goal, (3, 4), with p in units."""
    for i in range(3):
        for j in range(3):
            goal[i, j] = target[i, j]
        goal[i, 3] = target[i, 3] / unit


@compiled(contract=True)
def settled(
    links: Array, goal: Array, joints: Array, rows: Indices, unit: float, least: float, count: int, x: Array, q: Array,
    answer: Array,
) -> None:  # fmt: skip
    """Write what is found from candidates x to q and to answer, as `solutions_of_six` does."""
    errors, near, partner = np.empty(MANY), np.empty(MANY), np.empty(MANY, dtype=np.int64)
    answer[INSIDE], answer[COUNT], answer[ERROR], answer[EDGE] = 0.0, UNKNOWN, np.nan, np.inf
    if count > 0:
        count = polished_once(links, goal, rows, unit, least, count, x, errors, partner, near)
    if count == 0:
        answer[ERROR] = np.inf
    if count > 0:
        inside, error, edge = in_order(joints, unit, count, x, errors, near, q)
        answer[INSIDE], answer[COUNT] = inside, (count if inside > 0 else UNKNOWN)
        answer[ERROR], answer[EDGE] = error, edge


@compiled(contract=True)
def solutions_of_six(
    links: Array, joints: Array, rows: Indices, kind: int, link_of: Indices, joint_of: Indices, side: float,
    numbers: Array, targets: Array, q: Array, answers: Array,
) -> None:  # fmt: skip
    """Write all solutions of six joints to q, and what is known of them to answers, for every target.

    Args:
        links: of the chain [m].
        joints: (6, 6) of each joint its limits, what it is turned to, what counts as one, its entry of q, and whether
            it slides.
        rows: (6,) of the pose error.
        kind, link_of, joint_of, side, numbers: as `six_joints` has them.
        targets: (k, 4, 4), in the axes of the links.
        q: (k, MANY, nq) the result; each row holds the other joints' values.
        answers: (k, 4) the result: how many are INSIDE the limits; the COUNT of all, UNKNOWN where the target is left
            to others, or none; the ERROR of the first, whether inside or not, ∞ if there is no solution at all, NaN in
            doubt; how far the target is from the EDGE, ∞ if that is not near.
    """
    scaled, goal, x = np.empty((7, 15)), np.empty((3, 4)), np.empty((MANY, 6))
    for i in range(len(targets)):
        unit, count = 1.0, UNKNOWN
        if is_pose(targets[i]):
            unit = unit_of(links, targets[i], numbers[LENGTH])
            scaled_links(links, unit, scaled)
            scaled_goal(targets[i], unit, goal)
            count = six_joints(scaled, goal, kind, link_of, joint_of, side, numbers, unit, x)
        settled(scaled, goal, joints, rows, unit, numbers[LEAST], count, x, q[i], answers[i])


@compiled(contract=True)
def solutions_of_few(
    links: Array, joints: Array, rows: Indices, kind: int, numbers: Array, targets: Array, q: Array, answers: Array
) -> None:
    """Do what `solutions_of_six` does for one to three joints."""
    n = len(rows)
    scaled, goal, x = np.empty((n + 1, 15)), np.empty((3, 4)), np.empty((MANY, n))
    for i in range(len(targets)):
        unit, count = 1.0, UNKNOWN
        if is_pose(targets[i]):
            unit = unit_of(links, targets[i], numbers[LENGTH])
            scaled_links(links, unit, scaled)
            scaled_goal(targets[i], unit, goal)
            count = few_joints(scaled, goal, kind, rows, numbers, x)
        settled(scaled, goal, joints, rows, unit, numbers[LEAST], count, x, q[i], answers[i])


@compiled(contract=True)
def solutions_of_candidates(
    links: Array, joints: Array, rows: Indices, numbers: Array, target: Array, x: Array, q: Array, answer: Array
) -> None:
    """Do what `solutions_of_six` does for one target from candidates x, (k, 6), in radians and metres."""
    scaled, goal, candidates = np.empty((7, 15)), np.empty((3, 4)), np.empty((MANY, 6))
    unit, count = 1.0, UNKNOWN
    if is_pose(target) and len(x) <= MANY:
        unit, count = unit_of(links, target, numbers[LENGTH]), len(x)
        scaled_links(links, unit, scaled)
        scaled_goal(target, unit, goal)
        for i in range(count):
            for j in range(6):
                candidates[i, j] = x[i, j] / unit if joints[j, SLIDES] != 0.0 else x[i, j]
    settled(scaled, goal, joints, rows, unit, numbers[LEAST], count, candidates, q, answer)
