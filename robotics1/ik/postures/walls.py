"""Joint values at which det J vanishes whatever the other joints do: factors of det J in one joint, such as sin q₅."""

import numpy as np
import numpy.typing as npt

from robotics1.angles import TURN
from robotics1.ik.postures.determinant import Determinant
from robotics1.inputs import Array

OTHERS = 16  # random values of the other joints
GRID = 360  # values of the joint, in its range
VANISHES = 1e-9  # |det J|, beside its largest value
STEPS, SLOPE = 30, 1e-5  # of Newton's method: a double zero takes many; the difference that gives the slope
SAME = 1e-6  # distance of two walls that are one


def walls(determinant: Determinant, lower: Array, upper: Array, circular: npt.NDArray[np.bool_]) -> dict[int, Array]:
    """Return joint → the values, (k,), at which det J vanishes at all of 16 random values of the other joints.

    Args:
        determinant: det J.
        lower, upper: (nq,) the ranges of joints that do not make whole turns.
        circular: (nq,) the joints that make whole turns.
    """
    q = determinant.problem.random(np.random.default_rng(2), OTHERS)
    box, found = determinant.problem.box, {}
    for j in np.flatnonzero(determinant.active):
        low, high = (-np.pi, np.pi) if circular[j] else (max(lower[j], box.lower[j]), min(upper[j], box.upper[j]))
        values = _common_zeros(determinant, q, int(j), low, high)
        if len(values):
            found[int(j)] = values
    return found


def _common_zeros(determinant: Determinant, q: Array, j: int, low: float, high: float) -> Array:
    """Return the values of joint j in a range at which det J vanishes at all configurations (k, nq)."""

    def values(x: Array) -> Array:
        """Return det J with joint j at x (i,): (i, k)."""
        at = np.repeat(q[None], len(x), axis=0)
        at[:, :, j] = x[:, None]
        return np.asarray(determinant(at.reshape(-1, q.shape[1])).reshape(len(x), -1))

    ticks = np.linspace(low, high, GRID + 1)
    size = np.abs(values(ticks)).max(axis=1)
    before, after = np.append(np.inf, size[:-1]), np.append(size[1:], np.inf)
    found: list[float] = []
    for x in ticks[(size <= before) & (size <= after)]:
        value = float(x)
        for _ in range(STEPS):  # Newton's method for all k at once
            d = values(value + np.array([-SLOPE, 0.0, SLOPE]))
            slope = (d[2] - d[0]) / (2 * SLOPE)
            value -= float(d[1] @ slope / max(float(slope @ slope), 1e-300))
        inside = low - SAME <= value <= high + SAME
        if inside and np.abs(values(np.array([value]))).max() < VANISHES and _is_new(value, found):
            found.append(value)
    return np.array(found)


def _is_new(value: float, found: list[float]) -> bool:
    return all(abs(value - other) > SAME for other in found)


def crossed_wall(
    found: dict[int, Array], a: Array, b: Array, circular: npt.NDArray[np.bool_], revolute: npt.NDArray[np.bool_]
) -> int | None:
    """Return a joint whose walls every path from a to b, (nq,) each, crosses; None if there is none.

    On a circle one wall can be gone around the other way.
    """
    for j, values in found.items():
        if circular[j]:
            places = np.unique(np.round(values % TURN, 6))
            here, there = (int(np.searchsorted(places, x % TURN)) % len(places) for x in (a[j], b[j]))
            if len(places) > 1 and here != there:
                return j
        elif revolute[j]:
            if any(np.floor((a[j] - v) / TURN) != np.floor((b[j] - v) / TURN) for v in values):
                return j
        elif any((a[j] - v) * (b[j] - v) < 0 for v in values):
            return j
    return None
