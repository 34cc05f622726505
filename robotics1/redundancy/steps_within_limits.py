"""The motion of several tasks within the limits of the joint rates, in steps."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from robotics1.inputs import Array
from robotics1.redundancy.given_levels import Track
from robotics1.redundancy.within_bounds import BoundedLevel, levels_within
from robotics1.robot.model import Robot

STEPS = 400  # of the whole motion, at least

Asked = list[tuple[object, Array]]  # of each level, r_d and ṙ_d at an instant


def moved_within_limits(
    robot: Robot,
    tracks: Sequence[Track],
    bounds: tuple[Array, Array],
    ends: Sequence[float],
    q0: Array,
    times: Array,
) -> tuple[Array, Array, Array]:
    """Return q and q̇, (k, n) each, and the scales, (k, levels), at the times, by Runge and Kutta's fourth order.

    Where a joint comes to its limit the rates have a kink, at which an adaptive step would shrink without end: the
    steps have one length, and end where a trajectory has a jump. What is asked is known before: it is taken at all
    instants at once.
    """

    def rates(asked: Asked, q: Array) -> tuple[Array, tuple[float, ...]]:
        rows = []
        for track, (target, ahead) in zip(tracks, asked, strict=True):
            wanted = ahead + track.gain * track.task.error(robot, q, target)
            rows.append(BoundedLevel(track.task.jacobian(robot, q), wanted, np.zeros(len(wanted)), track.scale))
        return levels_within(rows, *bounds)

    intervals = len(times) - 1
    steps = intervals * -(-STEPS // intervals)
    grid = np.unique(np.concatenate([times, np.linspace(0.0, ends[-1], steps + 1), ends]))
    after, before = ([track.sampled(grid, side) for track in tracks] for side in ("right", "left"))
    middle = [track.sampled(0.5 * (grid[1:] + grid[:-1]), "right") for track in tracks]
    states, q = [], q0
    for i, (a, b) in enumerate(pairwise(grid)):
        h = b - a
        k1, scales = rates([level[i] for level in after], q)
        states.append((q, k1, scales))
        halfway = [level[i] for level in middle]
        k2, _ = rates(halfway, q + 0.5 * h * k1)
        k3, _ = rates(halfway, q + 0.5 * h * k2)
        k4, _ = rates([level[i + 1] for level in before], q + h * k3)
        q = q + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
    states.append((q, *rates([level[-1] for level in after], q)))
    chosen = [states[i] for i in np.searchsorted(grid, times)]
    q_, qdot, scale = (np.array(part) for part in zip(*chosen, strict=True))
    return q_, qdot, scale
