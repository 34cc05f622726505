"""Rendez-vous: be where a moving target is, with its velocity."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import Enum
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.optimize import brentq

from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.errors import InputError, NotConverged
from robotics1.ik.result import IKStatus
from robotics1.ik.solutions import ik_solutions
from robotics1.inputs import Array, answer_of, per_joint, real_array, real_number
from robotics1.least_squares import generalized_inverse
from robotics1.notation import vector
from robotics1.results import Frozen, Listed, require
from robotics1.robot.box import nearest_turn
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike, Robot
from robotics1.singularities.spaces import subspaces_without_units
from robotics1.tables import Table, table_of
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.rows import unitless_factors
from robotics1.tasks.task import Task
from robotics1.trajectories.elementary import cubic
from robotics1.trajectories.limits import LimitUse, limit_violations
from robotics1.trajectories.target_motion import TargetMotion

EVENT = "meet=lambda t, p: p[0]"
INSTANTS = 4000  # at which an event is looked at before its zero is refined


class MeetingStatus(Enum):
    """Whether the robot can meet the target."""

    MEETS = "the robot meets the target in position and velocity"
    BEYOND_LIMITS = "every way to the meeting point passes a limit of the robot"
    VELOCITY_LOST = "the robot reaches the meeting point only in a singular configuration that lacks the velocity"
    UNREACHABLE = "it is proven that the meeting point is out of the robot's reach"
    NOT_FOUND = "no configuration at the meeting point was found; it is likely out of the robot's reach"


@dataclass(frozen=True, eq=False)
class MeetingBranch(Frozen):
    """One way to meet: one inverse kinematics solution of the meeting point, and the motion to it.

    Attributes:
        q: (n,) the configuration at the meeting.
        qdot: (n,) J⁺ v: the joint velocity that matches the target's, or comes closest to it.
        trajectory: the cubic from the present state to (q, qdot).
        singular: whether J loses rank at q.
        velocity_error: (m,) v − J qdot: what of the target's velocity cannot be matched; zero unless singular.
        violations: the joint limits that the trajectory passes.
    """

    q: Array
    qdot: Array
    trajectory: PiecewisePolynomial
    singular: bool
    velocity_error: Array
    violations: tuple[LimitUse, ...]

    @property
    def matches(self) -> bool:
        """Whether the target's velocity is met."""
        return bool(np.linalg.norm(self.velocity_error) == 0)

    @property
    def feasible(self) -> bool:
        """Whether the velocity is met within the robot's limits."""
        return self.matches and not self.violations


@dataclass(frozen=True, eq=False)
class Rendezvous(Listed[MeetingBranch]):
    """When and where the target is met, and every way to do it.

    Attributes:
        time: of the meeting [s].
        position: the target then, in the form of the task's value.
        velocity: (m,) of the target then.
        branches: one for each inverse kinematics solution; those that work come first.
        status: whether one of them works.
        miss: the least distance to the meeting point in the task's units; zero when it is reached.
    """

    entries_in = "branches"

    time: float
    position: Any
    velocity: Array
    branches: tuple[MeetingBranch, ...]
    status: MeetingStatus
    miss: float

    def _tables(self) -> tuple[Table, ...]:
        rows = [
            (str(i), vector(branch.q), vector(branch.qdot), "; ".join(map(str, branch.violations)) or "inside")
            for i, branch in enumerate(self.branches)
        ]
        return (table_of(("", "q", "q̇", "limits"), rows, f"at t = {self.time:.4g} s"),) if rows else ()

    @property
    def trajectory(self) -> PiecewisePolynomial:
        """The trajectory of the first branch.

        Raises:
            NotConverged: there is no branch.
        """
        if not self.branches:
            raise NotConverged(f"{self.status.value}; the nearest miss is {self.miss:.3g}", self)
        return self.branches[0].trajectory

    def explain(self) -> str:
        """Return whether the target is met, and which limits are in the way."""
        why = "; ".join(str(violation) for branch in self.branches for violation in branch.violations)
        return self.status.value + (f": {why}" if why else "")

    def require(self) -> Rendezvous:
        """Return self if the target is met within the limits.

        Raises:
            NotConverged: it is not; the message says why.
        """
        return require(self, self.status is MeetingStatus.MEETS)


def rendezvous(
    robot: RobotLike,
    task: TaskLike,
    target_motion: TargetMotion,
    q0: ConfigurationLike,
    meet: float | Callable[[float, Any], float],
    *,
    qdot0: npt.ArrayLike = 0.0,
    horizon: float = 60.0,
) -> Rendezvous:
    """Return every cubic joint motion from (q0, qdot0) that meets a moving target in position and velocity.

    At the meeting time T, for each solution q of f(q) = p(T): q̇ = J⁺(q) ṗ(T), and q(t) is the cubic between
    the two states. A revolute joint takes the turn nearest to q0.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: what has to meet, such as PositionTask("xy").
        target_motion: p(t) with its velocity: a LinearMotion, FunctionMotion or trajectory.
        q0: (n,) the configuration at t = 0 [rad or m].
        meet: the time T [s], or an event g(t, p) whose first zero after t = 0 counts, as in `lambda t, p: p[0]`.
        qdot0: (n,) the joint velocity at t = 0, or one number for all.
        horizon: how far ahead an event is looked for [s].

    Raises:
        InputError: the event has no zero before the horizon, the time is not positive, or a shape is wrong.
        TaskError: the task does not fit the robot.
    """
    robot, task = robot_and_task(robot, task)
    q0 = robot.configuration(q0)
    qdot0 = per_joint("qdot0", qdot0, robot.nv)
    if isinstance(target_motion, type) or not callable(target_motion) or not hasattr(target_motion, "velocity"):
        raise InputError("target_motion must give p(t) and velocity(t); use LinearMotion or FunctionMotion")
    T = meeting_time(target_motion, meet, horizon)
    position = task.target(target_motion(T))
    velocity = real_array("the target's velocity", target_motion.velocity(T), (task.rows,))
    solutions = ik_solutions(robot, task, position)
    branches = [_branch(robot, task, q, velocity, (q0, qdot0), T) for q in solutions.q]
    branches.sort(key=lambda branch: (not branch.feasible, branch.singular))
    miss = 0.0 if len(solutions) else solutions.error_norm
    return Rendezvous(T, position, velocity, tuple(branches), _status(branches, solutions.status), miss)


def meeting_time(
    target_motion: TargetMotion, meet: float | Callable[[float, Any], float], horizon: float = 60.0
) -> float:
    """Return the time given, or the first zero of the event g(t, p(t)) in (0, horizon] [s].

    The event is looked at 4000 times; two zeros nearer than horizon/4000 can be missed.

    Raises:
        InputError: the time is not positive, or the event has no zero before the horizon.
    """
    if isinstance(meet, type) or hasattr(meet, "velocity"):
        raise InputError(f"meet must be a time, or a function g(t, p) that is zero at it; it is {meet!r}")
    if not callable(meet):
        return real_number("the meeting time", meet, positive=True)
    event = meet
    horizon = real_number("horizon", horizon, positive=True)

    def g(t: float) -> float:
        value = answer_of("the event", event, t, target_motion(t))
        if isinstance(value, bool | np.bool_):
            raise InputError(f"the event must be a number that is zero at the meeting, as in {EVENT}, not {value}")
        return real_number("the event's value", value)

    times = np.linspace(0.0, horizon, INSTANTS + 1)
    before = g(0.0)
    for start, end in pairwise(times):
        after = g(end)
        if after == 0:
            return float(end)
        if before * after < 0:
            return float(brentq(g, start, end, xtol=1e-15 * end, rtol=1e-15))
        before = after
    raise InputError(f"the event does not happen within {horizon:g} s; give another event or a longer horizon")


def _branch(robot: Robot, task: Task, q: Array, velocity: Array, start: tuple[Array, Array], T: float) -> MeetingBranch:
    q0, qdot0 = start
    q = np.where(robot.revolute, nearest_turn(q, q0, robot.lower, robot.upper), q)
    J = task.jacobian(robot, q)
    spaces = subspaces_without_units(J, unitless_factors(robot, task))
    qdot = generalized_inverse(J, rank=spaces.rank).solve(velocity)
    trajectory = cubic(q0, q, T, qdot0, qdot)
    lost = np.zeros_like(velocity) if spaces.contains(velocity) else spaces.unrealisable(velocity)
    singular = spaces.rank < min(J.shape)
    return MeetingBranch(q, qdot, trajectory, singular, lost, limit_violations(robot, trajectory))


def _status(branches: list[MeetingBranch], solutions: IKStatus) -> MeetingStatus:
    if not branches:
        return MeetingStatus.UNREACHABLE if solutions is IKStatus.UNREACHABLE else MeetingStatus.NOT_FOUND
    if any(branch.feasible for branch in branches):
        return MeetingStatus.MEETS
    if any(branch.matches for branch in branches):
        return MeetingStatus.BEYOND_LIMITS
    return MeetingStatus.VELOCITY_LOST
