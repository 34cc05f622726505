"""Accelerations that make the speed grow, and those that make it fall."""

from typing import Any

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.trajectories.limits.demands import Demand
from robotics1.trajectories.protocols import smooth_ends


def growing_and_falling(trajectory: Any, bounds: dict[str, Array]) -> list[Demand]:
    """Return what constant accelerations ask of A where the speed grows, and of D where it falls.

    Raises:
        InputError: the accelerations are not constant between the switching times.
    """
    ends = np.array(smooth_ends(trajectory))
    starts, durations = ends[:-1], np.diff(ends)
    early, late = starts + durations / 4, starts + durations * 3 / 4
    a, last, v = (
        np.reshape(rate(t), (len(t), -1))
        for rate, t in ((trajectory.acceleration, early), (trajectory.acceleration, late), (trajectory.velocity, early))
    )
    if np.abs(a - last).max(initial=0.0) > 1e-9 * np.abs(a).max(initial=0.0):
        raise InputError("a bound of its own on the deceleration is for constant accelerations: trapezoidal velocities")
    v = v - a * durations[:, None] / 4
    found = []
    for j in range(a.shape[1]):
        for quantity, sign in (("acceleration", 1), ("deceleration", -1)):
            during = [_where(sign, *phase) for phase in zip(v[:, j], a[:, j], starts, ends[1:], strict=True)]
            size = np.where([t is None for t in during], 0.0, np.abs(a[:, j]))
            i = int(np.argmax(size))
            if size[i] > 0:
                found.append(Demand(j, quantity, float(a[i, j]), float(bounds[quantity][j]), float(during[i] or 0.0)))
    return found


def _where(sign: int, v: float, a: float, start: float, end: float) -> float | None:
    """Return the first instant of a phase at which the speed grows (sign 1) or falls (sign −1), if there is one.

    Where the velocity comes to zero at an end, but for rounding, it does not change its sign.
    """
    turn = start - v / a if v * a < 0 else start  # until then the speed falls
    rounding = 1e-9 * end
    if sign < 0:
        return start if turn > start + rounding else None
    return turn if turn < end - rounding else None
