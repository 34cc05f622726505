"""Several tasks along their trajectories: by priority, and within the limits of the joint rates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array, counting_number
from robotics1.redundancy.given_levels import Track, tracks_of
from robotics1.redundancy.hierarchy import by_levels
from robotics1.redundancy.null_motion import gradient_of
from robotics1.redundancy.objectives import Objective
from robotics1.redundancy.rate_limits import limits_of
from robotics1.redundancy.within_bounds import BoundedLevel, levels_within
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import Robot
from robotics1.tasks.given import TaskLike
from robotics1.tasks.rows import unitless_rows
from robotics1.trajectories.following.integration import integrated, runaway

PRECISION = 1e-9  # of the integration, relative, and in radians and reaches
FOLLOWED = 1e-5  # |e| in radians and reaches: less is no error
STEPS = 400  # of a motion within limits, at least
MOST_STEPS = 5000  # of a segment: more are needed only where the joints run away


@dataclass(frozen=True, eq=False)
class PriorityRun(Frozen):
    """A motion along the trajectories of several tasks.

    Attributes:
        t: (k,) times [s]; fewer than were asked where the joints ran away.
        q: (k, n) [rad or m].
        qdot: (k, n) [rad/s or m/s].
        errors: of each level (k, m), r_d − r.
        scales: (k, levels) what part of the asked rate the limits leave of each level; 1 without limits, and nan of a
            level that is left out.
        largest_errors: of each level, in radians and reaches of the robot.
        complete: whether the motion came to the end of the trajectories.
    """

    t: Array
    q: Array
    qdot: Array
    errors: tuple[Array, ...]
    scales: Array
    largest_errors: tuple[float, ...]
    complete: bool

    def explain(self) -> str:
        """Return the largest error of each level, and whether the end was reached."""
        levels = [f"level {i}: |e| ≤ {size:.3g}" for i, size in enumerate(self.largest_errors, 1)]
        end = "" if self.complete else f"; the joints ran away at t = {self.t[-1]:.4g} s"
        slow = "" if not (self.scales < 1).any() else f"; slowed down to s = {np.nanmin(self.scales):.3g}"
        return "; ".join(levels) + slow + end

    def require(self) -> PriorityRun:
        """Return self if every level follows its trajectory.

        Raises:
            NotConverged: one does not.
        """
        return require(self, self.complete and max(self.largest_errors) <= FOLLOWED)


def follow_by_priority(
    robot: RobotLike,
    levels: Sequence[tuple[TaskLike, Any] | tuple[TaskLike, Any, npt.ArrayLike]],
    q0: npt.ArrayLike,
    *,
    limits: npt.ArrayLike | None = None,
    objective: Objective | None = None,
    gain: float = 1.0,
    damping: float = 0.0,
    samples: int = 201,
) -> PriorityRun:
    """Return the motion of q̇ by priority for ṙᵢ = ṙ_d,ᵢ(t) + Kᵢ (r_d,ᵢ(t) − fᵢ(q)) from q(0) = q0.

    Without limits q̇ is that of `priority_velocity`, with k ∇H in what is left of the null space; with limits it is that
    of `saturated_priority_velocity`, integrated in steps of 1/400 of the duration, or less.

    Args:
        robot: an arm of revolute and prismatic joints.
        levels: (task, trajectory) or (task, trajectory, K), the most important first. A trajectory of the first level
            gives the duration; a target in the form of the task's value stands still.
        q0: (n,) where the joints start [rad or m].
        limits: (n,) the largest q̇ of each joint, or one number; None for no limits.
        objective: H that the rest of the freedom increases; only without limits.
        gain: k of the objective.
        damping: of the levels after the first; only without limits.
        samples: the number of times that are returned.

    Raises:
        InputError: a shape is wrong, no level has a trajectory, or an objective is given together with limits.
        TaskError: a task does not fit the robot, or its axes move with it.

    Source: Siciliano, Slotine, ICAR 1991; Flacco, De Luca, Khatib, IROS 2012.
    """
    robot = robot_from(robot)
    robot.require_single_coordinates("can follow trajectories")
    q0, tracks = robot.configuration(q0), tracks_of(robot, levels)
    motions = [track.motion for track in tracks if track.motion is not None]
    if not motions:
        raise InputError("at least one level needs a trajectory, such as PathTrajectory(path, law)")
    if limits is not None and (objective is not None or damping):
        raise InputError("with limits the shortest q̇ is taken: leave out objective= and damping=")
    end = min(motion.end for motion in motions)
    ends = sorted({t for motion in motions for t in motion.ends if t < end} | {0.0, end})
    times = np.linspace(0.0, end, counting_number("samples", samples, least=2))
    if limits is not None:
        moved = _moved_within_limits(robot, tracks, limits_of(robot, limits, None), ends, q0, times)
        return _run(robot, tracks, times, *moved, complete=True)  # rates within limits do not run away

    def rate(t: float, q: Array, side: Side) -> Array:
        rows = [(track.task.jacobian(robot, q), track.asked(robot, t, q, side), track.scale) for track in tracks]
        found = by_levels(rows, robot.nv, damping=damping)
        wish = 0.0 if objective is None else found.null @ (found.null.T @ (gain * gradient_of(objective, q, robot.nv)))
        return np.asarray(found.x + wish)

    solution = integrated(
        rate,
        ends,
        q0,
        method="DOP853",
        rtol=PRECISION,
        atol=PRECISION * robot.units,
        max_step=end / 20,
        most_steps=MOST_STEPS,
        fastest=runaway(robot, end),
    )
    reached, states = solution.sampled(times)
    rates = np.array([rate(float(t), q, "right") for t, q in zip(reached, states, strict=True)])
    ones = np.ones((len(states), len(tracks)))
    return _run(robot, tracks, reached, states, rates, ones, complete=solution.end >= end)


def _moved_within_limits(
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

    def rates(asked: list[tuple[Any, Array]], q: Array) -> tuple[Array, tuple[float, ...]]:
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


def _run(
    robot: Robot, tracks: Sequence[Track], t: Array, q: Array, rates: Array, scales: Array, *, complete: bool
) -> PriorityRun:
    errors = tuple(
        np.array([track.error(robot, float(at), state) for at, state in zip(t, q, strict=True)]) for track in tracks
    )
    sizes = tuple(
        float(np.linalg.norm(e * unitless_rows(robot, track.task), axis=1).max())
        for e, track in zip(errors, tracks, strict=True)
    )
    return PriorityRun(t, q, rates, errors, scales, sizes, complete)
