"""A task as a search for q sees it: without units, in a box, with the joints that move it."""

from collections.abc import Callable, Hashable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache, wraps
from time import perf_counter
from typing import Any, TypeVar, cast

import numpy as np
import numpy.typing as npt

from robotics1.angles import TURN, without_turns
from robotics1.ik.turns import WholeTurns, is_own_function, unknown_turns, whole_turns
from robotics1.inputs import Array
from robotics1.robot.box import JointBox, intervals, joint_box, refuse_open_ranges, within_two_turns
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

SAMPLES = 6  # random configurations at which the task is looked at
MOVES = 1e-12  # an entry of J, beside the largest of its row, that is not rounding; of differences 1e-8
EVALUATIONS, EVALUATIONS_A_JOINT = 700, 70  # of a function, for all this
ROUNDED = 1e-5  # of the longest length at hand: an arm that is shorter is measured by that
Answer = TypeVar("Answer")


@dataclass(frozen=True, eq=False)
class ScaledTask:
    """A robot, a task and a box; lengths are divided by the size of the arm in that box.

    Attributes:
        robot, task: r = f(q).
        lower, upper: (n,) the limits, narrowed by the given box; they may be infinite.
        box: where starts are drawn; its circles are those of this task.
        moving: (n,) which joints move the task; the others are free, and stay in the middle of the box.
        length: what counts as one length [m]: the links, and the travel of prismatic joints in the box.
        rows: (m,) factors of the rows: 1/length for metres, and of rows without a unit one over their usual change.
        turns: what whole turns of the joints change.
    """

    robot: Robot
    task: Task
    lower: Array
    upper: Array
    box: JointBox
    moving: npt.NDArray[np.bool_]
    length: float
    rows: Array
    turns: WholeTurns

    @property
    def free_joints(self) -> tuple[str, ...]:
        """The names of the joints that do not move the task."""
        moves = self.moving | (self.box.upper == self.box.lower)  # what is locked is not free
        return tuple(name for name, kept in zip(self.robot.joint_names, moves, strict=True) if not kept)

    @property
    def middle(self) -> Array:
        """(n,) the middle of the box [rad or m]."""
        return np.asarray(0.5 * self.box.lower + 0.5 * self.box.upper)

    def random(self, rng: np.random.Generator, count: int) -> Array:
        """Return random configurations, (count, n), with the free joints in the middle."""
        return np.where(self.moving, self.box.random(rng, count), self.middle)

    def shortest_difference(self, p: Array, q: Array) -> Array:
        """Return p − q, (n,), in units, angles the short way round."""
        d = p - q
        return np.asarray(np.where(self.robot.revolute, without_turns(d), d / self.box.unit))

    def error(self, q: Array, target: Any) -> Array:
        """Return r_d − f(q), (m,), without units; ∞ where it is too large for a number."""
        return self.without_units(self.task.error(self.robot, q, target))

    def without_units(self, e: Array) -> Array:
        """Return an error r_d − f(q), (m,), without units and without what whole turns of the joints change."""
        with np.errstate(over="ignore"):
            return np.asarray(self.rows * self.turns.wrapped(e))

    def jacobian(self, q: Array) -> Array:
        """Return J(q), (m, n), without units."""
        return np.asarray(self.rows[:, None] * self.task.jacobian(self.robot, q) * self.box.unit)

    def relative_error(self, q: Array, target: Any) -> float:
        """Return |e(q)| without units, as `relative_size` has it."""
        return self.relative_size(q, self.error(q, target))

    def relative_size(self, q: Array, e: Array) -> float:
        """Return |e| of an error without units, (m,), with lengths relative to the size that the arm has at q.

        In a box of 10⁴ m an arm may well stand within a metre.
        """
        in_metres = np.array(self.task.row_units) == "m"
        with np.errstate(over="ignore"):
            return float(np.hypot.reduce(np.where(in_metres, self.length / self._size_at(q), 1.0) * e))

    def _size_at(self, q: Array) -> float:
        """Return the length of the links and of the prismatic joints at q [m], never near rounding."""
        size = self.robot.fixed_length + float(np.abs(q[~self.robot.revolute]).sum())
        base = float(np.hypot.reduce(self.robot.own_model.jointPlacements[1].translation)) if self.robot.nq else 0.0
        return max(size, ROUNDED * base, ROUNDED * self.length)


def kept_for_poses(find: Callable[[Robot, Task], Answer]) -> Callable[[Robot, Task], Answer]:
    """Keep what a function finds for the last 64 robots and tasks on a pose, which are no functions of the user's."""
    kept = lru_cache(maxsize=64)(find)

    @wraps(find)
    def found(robot: Robot, task: Task) -> Answer:
        form = task.frame_map()
        if form is not None and form.pose_error is not None:
            with suppress(TypeError):  # a task that cannot be hashed
                return kept(robot, cast(Hashable, task))
        return find(robot, task)

    return found


def scaled_task(
    robot: Robot,
    task: Task,
    box: Mapping[str, tuple[float, float]] | None = None,
    *,
    open_ranges: bool = False,
    seconds: float = np.inf,
) -> ScaledTask:
    """Return a task in a box, looked at in random configurations.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        box: joint name → (lower, upper).
        open_ranges: whether prismatic joints may move the task without limits; starts are then drawn in ±2 reaches.
        seconds: how long that may take; where a function takes longer, just joints without limits are circles.

    Raises:
        UnknownNameError, InputError: the box is none, or a prismatic joint that moves the task has no limits.
        TaskError: the task does not fit the robot.
    """
    lower, upper = intervals(robot, box)
    near = joint_box(robot, box, unlimited=2.0)
    length = _length(robot, near)
    units = np.where(robot.revolute, 1.0, length)
    if robot.nq == 0 or _takes_longer(robot, task, near, seconds):
        J, moving, turns = [], np.ones(robot.nq, dtype=bool), unknown_turns(robot, task)
    else:
        samples = near.random(np.random.default_rng(0), SAMPLES)
        J = [task.jacobian(robot, q) for q in samples]
        moving, turns = _moving(task, J, length, units), whole_turns(robot, task, near, samples)
    if not open_ranges:
        ends = (np.where(robot.revolute | ~moving, 0.0, limit) for limit in (lower, upper))
        refuse_open_ranges(robot, *ends)
    where = _circles(robot, replace(near, unit=units), lower, upper, turns.period)
    return ScaledTask(robot, task, lower, upper, where, moving, length, _row_factors(task, J, length), turns)


def _takes_longer(robot: Robot, task: Task, box: JointBox, seconds: float) -> bool:
    """Whether the evaluations of a function that a look at it needs take longer than that [s]."""
    if not is_own_function(task) or not np.isfinite(seconds):
        return False
    begin = perf_counter()
    task.value(robot, 0.5 * box.lower + 0.5 * box.upper)
    return (perf_counter() - begin) * (EVALUATIONS + EVALUATIONS_A_JOINT * robot.nq) > seconds


def _length(robot: Robot, box: JointBox) -> float:
    """Return the length of the links and of the travel in the box [m]; 1 if that is zero."""
    travel = np.maximum(np.abs(box.lower), np.abs(box.upper))[~robot.revolute]
    return robot.fixed_length + float(travel.sum()) or 1.0


def _row_factors(task: Task, J: list[Array], length: float) -> Array:
    usual = np.abs(J).max(axis=(0, 2), initial=0.0) if J else np.zeros(task.rows)
    own = is_own_function(task)
    return np.array(
        [
            1 / length if unit == "m" else 1 / size if unit == "1" and own and size > 0 else 1.0
            for unit, size in zip(task.row_units, usual, strict=True)
        ]
    )


def _moving(task: Task, J: list[Array], length: float, units: Array) -> npt.NDArray[np.bool_]:
    """Return which columns of J, (m, n), do not vanish at every sample: (n,)."""
    entries = np.abs(np.array(J) * _row_factors(task, J, length)[:, None] * units).max(axis=0)
    form = task.frame_map()
    threshold = (1e-8 if form is not None and form.by_differences else MOVES) * np.maximum(
        entries.max(axis=1, keepdims=True), 1e-3
    )
    return np.asarray((entries > threshold).any(axis=0))


def _circles(robot: Robot, near: JointBox, lower: Array, upper: Array, period: Array) -> JointBox:
    """Return the box whose circles are the joints that a period of their own brings back, inside the limits."""
    circular = robot.revolute & np.isfinite(period) & (upper - lower >= period - 1e-9)
    low, high = near.lower.copy(), near.upper.copy()
    turning = robot.revolute & ~circular
    low[turning], high[turning] = within_two_turns(lower[turning], upper[turning])
    for j in np.flatnonzero(circular):
        low[j] = max(lower[j], min(-0.5 * period[j], upper[j] - period[j]))
        high[j] = low[j] + period[j]
    return replace(near, lower=low, upper=high, circular=circular, period=np.where(circular, period, TURN))
