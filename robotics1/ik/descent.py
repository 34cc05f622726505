"""Damped least squares inside the joint limits, for any task: from its error and its Jacobian alone."""

from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field, replace
from time import perf_counter
from typing import Any

import numpy as np

from robotics1.differentiation import configuration_derivative
from robotics1.ik.scaled_task import ScaledTask
from robotics1.inputs import Array
from robotics1.least_squares import generalized_inverse

REACHED = 1e-9  # |e| of a solution, lengths relative to the arm
HOPELESS = 1e9  # |e| in lengths of the arm: there rounding hides what the joints do
FAR = 10.0  # |e|² beyond which the damping grows no more: the way may be long
FLOOR = 1e-20  # λ² that is left at the target: above rounding, and small beside σ² of what still counts as regular
LARGE = 1e-2  # |e| of a miss at which the curvature of the task counts
PATIENCE = 8  # steps without progress, after which a descent is given up
REMEMBERED = 100  # errors
End = tuple[Array, float]


class OutOfTime(Exception):  # noqa: N818 (it is no error: the best so far is the answer)
    """The time for a descent is over."""


@dataclass(frozen=True, eq=False)
class TaskDescent:
    """The way down from a start in a box to f(q) = target, which is in the form of the task's value.

    Attributes:
        problem: the task without units, in its box.
        target: r_d.
        end: the instant of `perf_counter` [s] after which no evaluation of the task begins.
        known: the errors of the last few configurations, by their bytes.
    """

    problem: ScaledTask
    target: Any
    end: float = np.inf
    known: dict[bytes, Array] = field(default_factory=dict, repr=False)

    def until(self, end: float) -> "TaskDescent":
        """Return the same descent, which ends at an instant of `perf_counter` [s]."""
        return replace(self, end=end)

    def _check_time(self) -> None:
        if perf_counter() > self.end:
            raise OutOfTime

    def task_error(self, q: Array) -> Array:
        """Return r_d − f(q), (m,), in the task's units; of the last few configurations it is remembered."""
        known = self.known.get(q.tobytes())
        if known is None:
            self._check_time()
            known = self.problem.task.error(self.problem.robot, q, self.target)
            if len(self.known) > REMEMBERED:
                self.known.clear()
            self.known[q.tobytes()] = known
        return known

    def error(self, q: Array) -> Array:
        """Return e(q), (m,), without units."""
        return self.problem.without_units(self.task_error(q))

    def error_norm(self, q: Array) -> float:
        """Return |r_d − f(q)| in the task's units, also when the time is over."""
        return float(np.hypot.reduce(self.until(np.inf).task_error(q)))

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
        self._check_time()
        problem, task = self.problem, self.problem.task
        form = task.frame_map()
        if form is None or not form.by_differences:
            return problem.jacobian(q)
        r = task.value(problem.robot, q)  # from which the wrapped error is small

        def error(x: Array) -> Array:
            self._check_time()
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
