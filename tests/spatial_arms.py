"""Arms of three joints in space, drawn at random: turns and slides, any twists and offsets, with and without limits."""

from functools import cache
from math import pi

import numpy as np

import robotics1 as r1

LONG_SLIDE = 20.0


@cache
def drawn_arm(seed, kinds=None, *, wide=False):
    """The arm of a seed. Half of the twists are quarters of a turn, and half of the offsets zero or multiples of 0.1.

    With `wide`, the first joint has no limits that matter, so that all solutions of the other two count.
    """
    rng = np.random.default_rng(seed)
    kinds = kinds or "".join(rng.choice(list("RRP"), 3))
    rows, lower, upper = [], [], []
    for i, kind in enumerate(kinds):
        twist = rng.choice([0, pi / 2, -pi / 2, rng.uniform(-3, 3)], p=[0.15, 0.25, 0.2, 0.4])
        a, d = (
            rng.choice([0, round(rng.uniform(-1, 1.5), 1), rng.uniform(0.1, 1.2)], p=[0.25, 0.25, 0.5]) for _ in "ab"
        )
        if i == 2 and kind == "R":
            a = max(abs(a), 0.2)
        turn = rng.choice([0, pi / 2, rng.uniform(-3, 3)])
        rows.append(
            (kind, float(a), float(twist), float(d), 0.0)
            if kind == "R"
            else (kind, float(a), float(twist), 0.0, float(turn))
        )
        low, high = _range(rng, kind)
        if i == 0 and wide:
            low, high = (-pi, pi) if kind == "R" else (-LONG_SLIDE, LONG_SLIDE)
        lower.append(float(low))
        upper.append(float(high))
    return r1.robot_from_dh(rows, lower=lower, upper=upper)


def _range(rng, kind):
    if kind == "P":
        low = rng.uniform(-0.5, 0.5)
        return low, low + rng.uniform(0.3, 1.2)
    if rng.random() < 0.35:
        return -pi, pi
    low = rng.choice([0, -pi / 2, rng.uniform(-3, 2)])
    return low, low + rng.choice([pi / 2, 2, rng.uniform(0.5, 5)])
