"""Where a moving point enters and leaves a workspace."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array, real_number
from robotics1.results import Frozen
from robotics1.workspaces.result import Workspace, check_workspace

RESOLUTION = 1e-5  # of the workspace's largest distance: an excursion that is shorter may be missed
NEAR = 1e-3  # of the workspace's largest distance: a clearance that asks for the distance itself
HALVINGS = 45
FEW_HALVINGS = 14  # where the boundary itself is sampled
MOST_STEPS = 200_000
SPEEDS = 200  # samples of the speed of a motion that is no straight line


@dataclass(frozen=True, eq=False)
class Passages(Frozen):
    """When a moving point is inside a workspace.

    Attributes:
        times: (k,) when it crosses the boundary.
        points: (k, m) where [m].
        entering: (k,) whether it comes in, or else goes out.
        intervals: (j, 2) the times between which it is inside, each cut off at the start and the end of the motion.
        longest: (2,) the longest of them; empty if there is none.
        resolution: excursions across the boundary that are shorter may be missed [m].
    """

    times: Array
    points: Array
    entering: npt.NDArray[np.bool_]
    intervals: Array
    longest: Array
    resolution: float

    def explain(self) -> str:
        """Return the crossings in sentences."""
        if not len(self.intervals):
            return "The point is never inside."
        lines = [f"The point is inside from t = {a:.6g} to t = {b:.6g}." for a, b in self.intervals]
        for t, p, comes in zip(self.times, self.points, self.entering, strict=True):
            where = ", ".join(f"{x:.6g}" for x in p)
            lines.append(f"It {'enters' if comes else 'leaves'} at t = {t:.6g}, at ({where}) m.")
        lines.append(f"An excursion of less than {self.resolution:.1g} m across the boundary may be missed.")
        return "\n".join(lines)


def crossings(ws: Workspace, motion: Any, start: float = 0.0, end: float = 1.0) -> Passages:
    """Return where a moving point enters and leaves a workspace between two times.

    The step from p(t) is as long as the distance from the boundary: no crossing is nearer than that. Across the
    boundary the time is found by halving.

    Args:
        ws: what `workspace(robot, task)` returns.
        motion: p(t), (m,) [m], as a `LinearMotion` or a path; or two points, which t = 0 and t = 1 belong to.
        start, end: the first and the last time.

    Raises:
        InputError: the motion gives no points, or the times are not in order.
    """
    check_workspace(ws)
    first, last = real_number("start", start), real_number("end", end)
    if not last > first:
        raise InputError(f"end must be later than start = {first:g}, not {last:g}")
    position, speed = _motion(motion, first, last)
    flips, resolution = _flips(ws, position, speed, first, last)
    inside = ws.contains(position(first))
    times = np.array([_between(ws, position, a, b) for a, b in flips])
    entering = np.array([inside == bool(k % 2) for k in range(len(times))], dtype=bool)
    marks = [first, *times, last] if inside else [*times, last]
    intervals = np.array(marks[: len(marks) // 2 * 2]).reshape(-1, 2)
    points = np.array([position(t) for t in times]).reshape(len(times), len(position(first)))
    longest = intervals[np.argmax(np.diff(intervals, axis=1))] if len(intervals) else np.empty(0)
    return Passages(times, points, entering, intervals, longest, resolution)


def _motion(motion: Any, first: float, last: float) -> tuple[Callable[[float], Array], float]:
    """Return p(t) and a bound of its speed."""
    if not callable(motion):
        ends = real_array("motion", motion, (2, None), "two points, or a motion p(t)")
        return (lambda t: ends[0] + t * (ends[1] - ends[0])), float(np.linalg.norm(ends[1] - ends[0]))

    def position(t: float) -> Array:
        return real_array("motion(t)", motion(t), (None,), "a point [m]")

    t = np.linspace(first, last, SPEEDS + 1)
    p = np.array([position(float(s)) for s in t])
    speed = float(np.linalg.norm(np.diff(p, axis=0), axis=1).max() / (t[1] - t[0]))
    if hasattr(motion, "velocity"):
        speed = max(speed, *(float(np.linalg.norm(motion.velocity(float(s)))) for s in t))
    straight = np.abs(np.diff(p, n=2, axis=0)).max() < 1e-12 * max(1.0, float(np.abs(p).max()))
    return position, speed * (1 + 1e-9 if straight else 1.2)


def _flips(
    ws: Workspace, position: Callable[[float], Array], speed: float, first: float, last: float
) -> tuple[list[tuple[float, float]], float]:
    """Return intervals of time in which a point goes in or out, and the shortest excursion that is seen [m]."""
    found: list[tuple[float, float]] = []
    if speed == 0:
        return found, 0.0
    least = max(RESOLUTION * ws.r_max, ws.resolution / 4)
    t, inside = first, ws.contains(position(first))
    for _ in range(MOST_STEPS):
        if t >= last:
            return found, least
        p = position(t)
        room = ws.section.clearance(p)
        if room < NEAR * ws.r_max and not ws.resolution:
            room = ws.distance(p)
        room = max(room, least)
        after = min(t + room / speed, last)
        here = ws.contains(position(after))
        if here != inside:
            found.append((t, after))
        t, inside = after, here
    return found, least


def _between(ws: Workspace, position: Callable[[float], Array], a: float, b: float) -> float:
    inside = ws.contains(position(a))
    for _ in range(HALVINGS if not ws.resolution else FEW_HALVINGS):
        middle = (a + b) / 2
        if ws.contains(position(middle)) == inside:
            a = middle
        else:
            b = middle
    return (a + b) / 2
