"""Damped least squares inside the joint limits in Python, for any task: from its error and its Jacobian alone."""

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field, replace
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.differentiation import configuration_derivative
from robotics1.errors import InputError, TaskError
from robotics1.ik.scaled_task import ScaledTask, scaled_task
from robotics1.ik.search import Ends, Found, Table
from robotics1.inputs import Array
from robotics1.kernels.chain import Indices
from robotics1.least_squares import generalized_inverse
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

REACHED = 1e-9  # |e| of a solution, lengths relative to the arm
HOPELESS = 1e9  # |e| in lengths of the arm: there rounding hides what the joints do
FAR = 10.0  # |e|² beyond which the damping grows no more: the way may be long
FLOOR = 1e-20  # λ² that is left at the target: above rounding, and small beside σ² of what still counts as regular
LARGE = 1e-2  # |e| of a miss at which the curvature of the task counts
PATIENCE = 8  # steps without progress, after which a descent is given up
REMEMBERED = 100  # errors
GRACE, LONGER = 0.05, 0.1  # seconds, or of the time limit, that the nearest miss may take longer ...
QUICK = 1e-3  # ... where an evaluation takes less than that [s]
GROUP = 8  # random starts; the one with the least error is taken
PREPARING = 0.2  # of the time limit, that a look at the task may take
End = tuple[Array, float]


class OutOfTime(Exception):  # noqa: N818 (it is no error: the best so far is the answer)
    """The time for a descent is over."""


def no_limit() -> None:
    """Let a descent take the time that it needs."""


def until(end: float) -> Callable[[], None]:
    """Return a clock that raises OutOfTime after an instant of `perf_counter` [s]."""

    def look() -> None:
        if perf_counter() > end:
            raise OutOfTime

    return look


@dataclass(frozen=True, eq=False)
class TaskDescent:
    """The way down from a start in a box to f(q) = target, which is in the form of the task's value.

    Attributes:
        problem: the task without units, in its box.
        target: r_d.
        clock: called before each evaluation of the task; raises OutOfTime when there is no time left.
        known: the errors of the last few configurations, by their bytes.
    """

    problem: ScaledTask
    target: Any
    clock: Callable[[], None] = no_limit
    known: dict[bytes, Array] = field(default_factory=dict, repr=False)

    def until(self, end: float) -> "TaskDescent":
        """Return the same descent, which ends at an instant of `perf_counter` [s]."""
        return replace(self, clock=until(end))

    def task_error(self, q: Array) -> Array:
        """Return r_d − f(q), (m,), in the task's units; of the last few configurations it is remembered."""
        known = self.known.get(q.tobytes())
        if known is None:
            self.clock()
            known = self.problem.task.error(self.problem.robot, q, self.target)
            if len(self.known) > REMEMBERED:
                self.known.clear()
            self.known[q.tobytes()] = known
        return known

    def error(self, q: Array) -> Array:
        """Return e(q), (m,), without units."""
        return self.problem.without_units(self.task_error(q))

    def relative_error(self, q: Array) -> float:
        """Return |e(q)| relative to the size of the arm at q."""
        return self.problem.relative_size(q, self.error(q))

    def descend(self, q: Array, iterations: int = 80) -> End:
        """Return the best configuration of a damped least squares descent inside the box, and its |e|.

        The damping λ² = 1e-20 + min(|e|², 10)/20 fades with the error, so that the descent ends as Newton's method.
        """
        best, least, stuck = q, np.inf, 0
        try:
            for _ in range(iterations):
                e = self.error(q)
                error = float(np.hypot.reduce(e))  # which does not overflow
                stuck = 0 if error < 0.9 * least else stuck + 1
                if error < least:
                    best, least = q, error
                if least < 1e-15 or stuck > PATIENCE or (least < 1e-12 and stuck > 2) or error > HOPELESS:
                    break
                q = self.problem.box.nearest(q + self.problem.box.unit * self._step(q, e))
        except OutOfTime:
            pass
        return best, least

    def nearest_miss(self, q: Array) -> Array:
        """Return the configuration near q with the least |e| inside the box."""
        best, weights = (np.inf, q), self._weights

        def error(p: Array) -> Array:
            nonlocal best
            e = weights * self.error(p)
            best = min(best, (float(np.hypot.reduce(e)), p), key=lambda pair: pair[0])
            return e

        with suppress(OutOfTime):
            self._least_squares(q, error)
        return best[1]

    @property
    def _weights(self) -> Array:
        """(m,) what makes rows without units count as they do in |e| of the task, but for one factor for all."""
        return np.asarray(self.problem.rows.min() / self.problem.rows)

    def _least_squares(self, q: Array, error: Callable[[Array], Array]) -> None:
        """Minimise |e|² from q inside the box, where circles have no limits.

        Far from a solution the curvature of the task counts, which BFGS sees; near one Gauss and Newton are exact.
        """
        from scipy.optimize import least_squares, minimize

        box = self.problem.box
        lower, upper = (
            np.where(box.circular, end, limit) for end, limit in ((-np.inf, box.lower), (np.inf, box.upper))
        )
        moving = self.problem.moving & (lower < upper)
        if np.abs(error(q)).max() > HOPELESS or not moving.any():
            return
        units, start = box.unit[moving], box.nearest(q)

        def moved(x: Array) -> Array:
            whole = start.copy()
            whole[moving] = x * units
            return box.nearest(whole)

        def slope(x: Array) -> Array:
            return np.asarray(-self._weights[:, None] * self.jacobian(moved(x))[:, moving])

        def half_square(x: Array) -> tuple[float, Array]:
            e = error(moved(x))
            return 0.5 * float(e @ e), slope(x).T @ e

        low, high, x, most = lower[moving] / units, upper[moving] / units, start[moving] / units, 100
        if np.hypot.reduce(self.error(start)) > LARGE:
            bounds = list(zip(low, high, strict=True))
            options = {"maxiter": 100, "ftol": 1e-15, "gtol": 1e-9}
            found = minimize(half_square, x, jac=True, method="L-BFGS-B", bounds=bounds, options=options)
            x, most = np.clip(found.x, low, high), 20
        least_squares(
            lambda x: error(moved(x)), x, jac=slope,
            bounds=(low, high), xtol=1e-12, ftol=1e-15, gtol=1e-15, max_nfev=most,
        )  # fmt: skip

    def jacobian(self, q: Array) -> Array:
        """Return J(q), (m, n), without units; of a function without derivative by differences of its wrapped error."""
        self.clock()
        problem, task = self.problem, self.problem.task
        form = task.frame_map()
        if form is None or not form.by_differences:
            return problem.jacobian(q)
        r = task.value(problem.robot, q)  # from which the wrapped error is small

        def error(x: Array) -> Array:
            self.clock()
            return problem.error(x, r)

        return np.asarray(-configuration_derivative(error, problem.robot, q) * problem.box.unit)

    def _step(self, q: Array, e: Array) -> Array:
        """Return Δq = Jᵀ(J Jᵀ + λ²1)⁻¹ e in units; a joint that would leave the limit it stands at is held.

        By the singular values, since a matrix J Jᵀ has lost the digits of the small ones.
        """
        J, box = self.jacobian(q), self.problem.box
        square = 0.05 * min(float(e @ e), FAR)
        at_lower, at_upper = ((q == limit) & ~box.circular for limit in (box.lower, box.upper))
        held = ~self.problem.moving

        def damping(sigma: Array) -> float:
            return float(np.sqrt(square + FLOOR * max(1.0, sigma[0] ** 2)))

        while True:
            step = generalized_inverse(J * ~held, damping).solve(e)
            leaving = ~held & ((at_lower & (step < 0)) | (at_upper & (step > 0)))
            if not leaving.any():
                return step
            held = held | leaving


class PythonDescent:
    """Damped least squares on the task's own error and Jacobian; a goal is the `TaskDescent` to a target.

    Attributes:
        quick: whether the task is evaluated so fast that the best of some starts is worth its price.
    """

    at_once = cores = 1
    enough = 0.6  # the rest of the time is for the nearest miss

    def __init__(self, robot: Robot, task: Task, *, prefer: str, seed: int, tolerance: float, time_limit: float):
        if prefer != "any":
            raise InputError(f"prefer={prefer!r} needs a task on one frame, such as PoseTask; this one takes 'any'")
        task.check_integrable(robot)
        if robot.nv == 0:
            raise TaskError("nothing moves this task: the robot has no joint")
        import scipy.optimize  # noqa: F401  (now, and not while the time runs)

        self.robot, self.task, self.tolerance = robot, task, tolerance
        self.seed, self.grace = seed, max(GRACE, LONGER * time_limit)
        self.problem = scaled_task(robot, task, open_ranges=True, seconds=PREPARING * time_limit)
        begin = perf_counter()
        task.value(robot, self.problem.middle)
        self.quick = perf_counter() - begin < QUICK

    def goals(self, targets: list[Any], first: int | None) -> npt.NDArray[Any]:
        """Return the descents to the targets."""
        goals = np.empty(len(targets), dtype=object)
        goals[:] = [TaskDescent(self.problem, self.task.target(target)) for target in targets]
        return goals

    def tables(self) -> Iterator[Table]:
        """Yield groups of random starts."""
        rng = np.random.default_rng((self.seed, 0))
        while True:
            yield self.problem.random(rng, GROUP), GROUP

    def begin(self, found: Found, tables: Iterator[Table], seconds: float) -> None:
        """Descend from q0, or from the best of the first random starts."""
        around = None if found.starts is None else found.starts[0]
        starts = next(tables) if around is None else (self.problem.box.nearest(around)[None], 1)
        found.q, found.tried, found.error = self.again(found, np.arange(1), starts, seconds)

    def again(self, found: Found, left: Indices, starts: Table, seconds: float) -> Ends:
        """Return where the best of some starts leads."""
        descent = found.goals[left[0]].until(perf_counter() + seconds)
        around = None if found.starts is None else found.starts[left[0]]
        q, _ = descent.descend(self._best(descent, starts[0]))
        q = self._wound(descent, q, around)
        return q[None], np.ones(1, dtype=np.int64), np.array([self._error(descent, q)])

    def unreachable(self, goals: npt.NDArray[Any], seconds: float) -> npt.NDArray[np.bool_]:
        """Return that nothing is proven: of such a task nothing is known."""
        return np.zeros(len(goals), dtype=bool)

    def miss(self, found: Found, never: Indices, seconds: float) -> None:
        """Move what was found to where |e| is least around it; that may take a little longer than the time."""
        grace = self.grace if self.quick else 0.0
        for i in never:
            descent = found.goals[i].until(perf_counter() + seconds + grace)
            q = self._wound(descent, descent.nearest_miss(found.q[i]), None)
            error = self._error(descent, q)
            if error < found.error[i]:
                found.q[i], found.error[i] = q, error

    def prefer(self, found: Found) -> None:
        """Do nothing: the first solution is as good as any."""

    def _best(self, descent: TaskDescent, starts: Array) -> Array:
        """Return the best of some random starts, of a slow function the first one."""
        if not self.quick or len(starts) == 1:
            return np.asarray(starts[0])
        errors = [float(np.hypot.reduce(self.problem.error(q, descent.target))) for q in starts]
        return np.asarray(starts[int(np.nanargmin(errors))])

    def _wound(self, descent: TaskDescent, q: Array, around: Array | None) -> Array:
        """Return q with joints turned as the target counts turns, and the others to within half a turn of `around`."""
        problem, turns = self.problem, self.problem.turns
        try:
            wound = turns.wound(q, descent.task_error(q), problem.lower, problem.upper)
        except OutOfTime:  # before the task was evaluated once
            return q
        q = q if wound is None else wound
        if around is None:
            return q
        near = turns.near(q, around, problem.lower, problem.upper)
        return near if self._error(descent, near) <= max(self.tolerance, self._error(descent, q)) else q

    def _error(self, descent: TaskDescent, q: Array) -> float:
        """Return |r_d − f(q)|, whatever the clock says."""
        error = descent.known.get(q.tobytes())
        if error is None:
            error = self.task.error(self.robot, q, descent.target)
        return float(np.hypot.reduce(error))
