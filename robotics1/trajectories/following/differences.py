"""Derivatives of a function of time that is smooth between switching times, from values on one side of them only."""

from collections.abc import Callable, Sequence

import numpy as np

from robotics1.inputs import Array
from robotics1.trajectories.protocols import Side

NODES = 5  # values; the error is of the order of STEP⁴
STEP = 2e-3  # from one to the next, of the interval


def derivative_inside(f: Callable[[float, Side], Array], t: float, ends: Sequence[float], side: Side) -> Array:
    """Return df/dt at t from five values inside the interval between two ends in which t is; at an end, `side` decides.

    Args:
        f: (t, side) → array; it is called at the ends with the side that is inside.
        t: when.
        ends: 0, the switching times, and the duration.
        side: "right" or "left".
    """
    number = int(np.searchsorted(ends, t, side="right" if side == "right" else "left"))
    number = min(max(number, 1), len(ends) - 1)
    a, b = ends[number - 1], ends[number]
    h = STEP * (b - a)
    first = min(max(t - 2 * h, a), b - (NODES - 1) * h)
    nodes = first + h * np.arange(NODES)
    powers = np.vander((nodes - t) / h, NODES, increasing=True).T
    weights = np.linalg.solve(powers, np.eye(NODES)[1]) / h
    values = [f(float(min(max(x, a), b)), "left" if x >= b else "right") for x in nodes]
    return np.asarray(np.tensordot(weights, np.array(values), axes=1))
