"""Several tasks along their trajectories: by priority, and within the limits of the joint rates."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array, a_task, counting_number, non_negative_numbers
from robotics1.redundancy.hierarchy import by_levels
from robotics1.redundancy.null_motion import gradient_of
from robotics1.redundancy.null_saturation import saturated_levels
from robotics1.redundancy.objectives import Objective
from robotics1.redundancy.saturation import limits_of
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task, unitless_rows
from robotics1.trajectories.following.integration import integrated

PRECISION = 1e-9  # of the integration, relative, and in radians and reaches
FOLLOWED = 1e-5  # |e| in radians and reaches: less is no error
STEPS = 200  # within limits, of the whole motion
MOST_STEPS = 5000  # of a segment: more are needed only where the joints run away

Rates = Callable[[float, Array, Side], tuple[Array, Array]]  # (t, q, side) → q̇ and the scales


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

    def require(self) -> "PriorityRun":
        """Return self if every level follows its trajectory.

        Raises:
            NotConverged: one does not.
        """
        return require(self, self.complete and max(self.largest_errors) <= FOLLOWED)


def follow_by_priority(
    robot: RobotLike,
    levels: Sequence[tuple[Task, Any] | tuple[Task, Any, npt.ArrayLike]],
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
    of `saturated_priority_velocity`, integrated in steps of 1/200 of the duration, or less.

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
    q0, tracks = robot.configuration(q0), _tracks(robot, levels)
    motions = [track.motion for track in tracks if track.motion is not None]
    if not motions:
        raise InputError("at least one level needs a trajectory, such as PathTrajectory(path, law)")
    if limits is not None and (objective is not None or damping):
        raise InputError("with limits the shortest q̇ is taken: leave out objective= and damping=")
    n, end = robot.nv, min(motion.end for motion in motions)
    ends = sorted({t for motion in motions for t in motion.ends if t < end} | {0.0, end})
    bounds = None if limits is None else limits_of(robot, limits, None)

    def rates(t: float, q: Array, side: Side) -> tuple[Array, Array]:
        rows = [(track.task.jacobian(robot, q), track.asked(robot, t, q, side)) for track in tracks]
        if bounds is not None:
            x, scales = saturated_levels(rows, *bounds)
            return x, np.array(scales)
        found = by_levels(rows, n, damping=damping)
        wish = 0.0 if objective is None else found.null @ (found.null.T @ (gain * gradient_of(objective, q, n)))
        return found.x + wish, np.ones(len(rows))

    times = np.linspace(0.0, end, counting_number("samples", samples, least=2))
    if bounds is None:
        states, complete = _integrated(rates, ends, q0, times, robot)
    else:
        states, complete = _stepped(rates, ends, q0, times), True  # rates within limits do not run away
    return _run(robot, tracks, times[: len(states)], states, rates, complete=complete)


def _integrated(rates: Rates, ends: Sequence[float], q0: Array, times: Array, robot: Robot) -> tuple[list[Array], bool]:
    """Return q at the times, as far as the joints do not run away, and whether that is the end."""
    end = ends[-1]
    segments = integrated(
        lambda t, q, side: rates(t, q, side)[0],
        ends,
        q0,
        method="DOP853",
        rtol=PRECISION,
        atol=PRECISION * robot.units,
        max_step=end / 20,
        most_steps=MOST_STEPS,
        stop=lambda rate: bool((np.abs(rate) > 1e4 * robot.units / end).any()),
    )
    reached = segments[-1].end if segments else 0.0
    states = [next((s.state(t) for s in segments if t <= s.end), q0) for t in times[times <= reached]]
    return states, reached >= end


def _stepped(rates: Rates, ends: Sequence[float], q0: Array, times: Array) -> list[Array]:
    """Return q at the times, by Runge and Kutta's fourth order in at least 200 steps.

    Where a joint comes to its limit the rates have a kink, at which an adaptive step would shrink without end.
    """
    fine = np.linspace(0.0, ends[-1], len(times) + (len(times) - 1) * (STEPS // max(1, len(times) - 1)))
    grid = np.unique(np.concatenate([times, fine, ends]))
    found, q = [q0], q0
    for a, b in pairwise(grid):
        h, middle = b - a, 0.5 * (a + b)
        k1 = rates(a, q, "right")[0]
        k2 = rates(middle, q + 0.5 * h * k1, "right")[0]
        k3 = rates(middle, q + 0.5 * h * k2, "right")[0]
        k4 = rates(b, q + h * k3, "left")[0]
        q = q + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        found.append(q)
    return [found[i] for i in np.searchsorted(grid, times)]


@dataclass(frozen=True, eq=False)
class Track:
    """A level: its task, its trajectory or its target at rest, and its gain."""

    task: Task
    motion: Curve | None
    target: Any
    gain: Array

    def error(self, robot: Robot, t: float, q: Array) -> Array:
        """Return r_d(t) − f(q), (m,)."""
        return self.task.error(robot, q, self.target if self.motion is None else self.motion(t))

    def asked(self, robot: Robot, t: float, q: Array, side: Side) -> Array:
        """Return ṙ_d + K e, (m,)."""
        ahead = 0.0 if self.motion is None else self.motion.velocity(t, side=side)
        return np.asarray(ahead + self.gain * self.error(robot, t, q))


def _run(
    robot: Robot,
    tracks: Sequence[Track],
    times: Array,
    states: Sequence[Array],
    rates: Rates,
    *,
    complete: bool,
) -> PriorityRun:
    moved = [rates(float(t), q, "right") for t, q in zip(times, states, strict=True)]
    errors = tuple(
        np.array([track.error(robot, float(t), q) for t, q in zip(times, states, strict=True)]) for track in tracks
    )
    sizes = tuple(
        float(np.linalg.norm(e * unitless_rows(robot, track.task), axis=1).max())
        for e, track in zip(errors, tracks, strict=True)
    )
    joints, scales = (np.array(part) for part in zip(*moved, strict=True))
    return PriorityRun(times, np.array(states), joints, errors, scales, sizes, complete)


def _tracks(robot: Robot, levels: Any) -> list[Track]:
    """Return the levels, checked."""
    if not isinstance(levels, Sequence) or isinstance(levels, str) or not levels:
        raise InputError(f"levels must be a list of (task, trajectory) or (task, trajectory, K); it is {levels!r}")
    found = []
    for number, level in enumerate(levels, 1):
        if not isinstance(level, Sequence) or len(level) not in (2, 3):
            raise InputError(f"level {number} must be (task, trajectory) or (task, trajectory, K); it is {level!r}")
        task, wanted, *gains = level
        a_task(task)
        task.check_integrable(robot)
        K = non_negative_numbers(f"the gain of level {number}", gains[0] if gains else 0.0, task.rows)
        moving = callable(wanted) or hasattr(wanted, "trajectory")
        motion = as_curve(f"the trajectory of level {number}", wanted, derivatives=1) if moving else None
        if motion is not None and motion.shape != (task.rows,):
            raise InputError(f"the trajectory of level {number} must have {task.rows} rows; it has {motion.shape}")
        found.append(Track(task, motion, None if moving else task.target(wanted), K))
    return found
