"""Damped least squares inside the joint limits, for any task: the task says no more than its error and Jacobian."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.ik.steps import damped_step
from robotics1.inputs import Array
from robotics1.robot.box import JointBox
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task
from robotics1.tasks.units import unitless_jacobian, unitless_rows

REACHED = 1e-9  # |e| of a solution, lengths in units of the reach
HOPELESS = 1e9  # |e| in reaches: there rounding hides what the joints do
End = tuple[Array, float]


@dataclass(frozen=True, eq=False)
class Descent:
    """The way down from a start in a box to f(q) = target, which is in the form of the task's value."""

    robot: Robot
    task: Task
    target: Any
    box: JointBox

    def error(self, q: Array) -> Array:
        """Return e(q), (m,), lengths in units of the reach."""
        return unitless_rows(self.robot, self.task) * self.task.error(self.robot, q, self.target)

    def descend(self, q: Array, iterations: int = 80) -> End:
        """Return the best configuration of a damped least squares descent inside the box, and its |e|.

        The damping λ² = 1e-10 + |e|²/20 fades with the error, so that the descent ends as Newton's method.
        """
        best, least, stuck = q, np.inf, 0
        for _ in range(iterations):
            e = self.error(q)
            error = float(np.hypot.reduce(e))  # which does not overflow
            stuck = 0 if error < 0.9 * least else stuck + 1
            if error < least:
                best, least = q, error
            if least < 1e-14 or stuck > 12 or (least < REACHED and stuck > 2) or error > HOPELESS:
                break
            q = self.box.nearest(q + self.robot.units * self._step(q, e))
        return best, least

    def nearest_miss(self, q: Array) -> Array:
        """Return the configuration near q with the least |e| inside the box."""
        from scipy.optimize import least_squares

        open_ended = self.box.circular
        lower = np.where(open_ended, -np.inf, self.box.lower)
        upper = np.where(open_ended, np.inf, self.box.upper)
        moving = lower < upper

        def moved(x: Array) -> Array:
            whole = self.box.nearest(q)
            whole[moving] = x
            return whole

        def slope(x: Array) -> Array:
            J = unitless_rows(self.robot, self.task)[:, None] * self.task.jacobian(self.robot, moved(x))
            return np.asarray(-J[:, moving])

        if not moving.any() or np.abs(self.error(q)).max() > HOPELESS:
            return q
        start = self.box.nearest(q)[moving]
        found = least_squares(
            lambda x: self.error(moved(x)), start, jac=slope, bounds=(lower[moving], upper[moving]),
            x_scale=self.robot.units[moving], xtol=1e-12, ftol=1e-15, gtol=1e-15, max_nfev=100,
        )  # fmt: skip
        return self.box.nearest(moved(found.x))

    def _step(self, q: Array, e: Array) -> Array:
        """Return the damped step, in units; a joint that would leave the limit it stands at is held."""
        J = unitless_jacobian(self.robot, self.task, q)
        damping = float(np.sqrt(1e-10 + 0.05 * (e @ e)))
        at_lower, at_upper = ((q == limit) & ~self.box.circular for limit in (self.box.lower, self.box.upper))
        held = np.zeros(len(q), dtype=bool)
        while True:
            step = damped_step(J * ~held, e, damping)
            leaving = ~held & ((at_lower & (step < 0)) | (at_upper & (step > 0)))
            if not leaving.any():
                return step
            held |= leaving
