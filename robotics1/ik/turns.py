"""What a whole turn of a joint changes: nothing, the value of a task's row by a constant, or all of it."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.angles import TURN
from robotics1.inputs import Array
from robotics1.kinematics import frame_jacobian
from robotics1.robot.box import JointBox, nearest_turn
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

MOST_TURNS = 12  # of a leader, after which its follower may be back: multipliers such as 0.5, 1/3, 0.75
SAME = 1e-8  # relative difference of two values that are one
STILL = 1e-4  # a row that changes so little beside another may stand still, but for rounding
STEPS = 200  # of each walk on which jumps are looked for


@dataclass(frozen=True, eq=False)
class WholeTurns:
    """How f(q) changes when a revolute joint turns by its period: f(q + period_j e_j) = f(q) + change_j.

    A function of the user may count turns, as q1 + q3 does, or may jump by a whole turn, as atan2 does. The search
    then goes modulo the change; what it finds is turned until the value itself is the target's.

    Attributes:
        period: (n,) [rad]; ∞ where no number of turns does this, and of prismatic joints.
        change: (m, n) of each row by one period of each joint.
        modulus: (m,) what is left out of the error of each row; 0 if nothing is.
        angle: (m,) True for a row that is an angle: it jumps by whole turns, or it turns with the frame about a
            fixed axis, so that the frame is in the same place when the row has changed by 2π.
    """

    period: Array
    change: Array
    modulus: Array
    angle: npt.NDArray[np.bool_]

    def wrapped(self, e: Array) -> Array:
        """Return an error (m,) without whole moduli."""
        return e - self.modulus * np.round(e / np.where(self.modulus > 0, self.modulus, np.inf))

    def wound(self, q: Array, e: Array, lower: Array, upper: Array) -> Array | None:
        """Return q with joints turned inside [lower, upper] so that the whole moduli in its error e (m,) vanish.

        None if no turns do so.
        """
        left = e - self.wrapped(e)
        if not left.any():
            return q
        counting = np.flatnonzero(self.change.any(axis=0)).tolist()
        for order in (*((j,) for j in counting), tuple(counting)):
            p, rest = self._turned(q, left, order, lower, upper)
            if np.abs(rest).max() < 0.5 * self.modulus[self.modulus > 0].min():
                return p
        return None

    def near(self, q: Array, around: Array, lower: Array, upper: Array) -> Array:
        """Return q with joints whose turns change nothing turned as near to `around` as [lower, upper] allows."""
        alike = np.isfinite(self.period) & ~self.change.any(axis=0)
        period = np.where(alike, self.period, 1.0)
        return np.where(alike, np.clip(nearest_turn(q, around, lower, upper, period), lower, upper), q)

    def _turned(
        self, q: Array, left: Array, joints: tuple[int, ...], lower: Array, upper: Array
    ) -> tuple[Array, Array]:
        """Turn one joint after the other as far as the limits allow; return q and what is left of the error."""
        p, rest = q.copy(), left.copy()
        for j in joints:
            row = int(np.argmax(np.abs(self.change[:, j])))
            wanted = p[j] + self.period[j] * np.round(rest[row] / self.change[row, j])
            turned = nearest_turn(p[j], wanted, lower[j], upper[j], self.period[j])
            rest -= np.round((turned - p[j]) / self.period[j]) * self.change[:, j]
            p[j] = np.clip(turned, lower[j], upper[j])
        return p, rest


def whole_turns(robot: Robot, task: Task, box: JointBox, samples: Array) -> WholeTurns:
    """Return what whole turns change, seen at random configurations, (k, n)."""
    period = np.where(robot.revolute, TURN, np.inf)
    change = np.zeros((task.rows, robot.nq))
    J = np.abs([task.jacobian(robot, q) * robot.units for q in samples[:2]])
    size = np.maximum(
        J.max(axis=(0, 2), initial=0.0), max(STILL * J.max(initial=0.0), 1e-300)
    )  # of changes of the rows
    for j in np.flatnonzero(robot.revolute).tolist():
        period[j], change[:, j] = _change(robot, task, samples, j, size)
    form = task.frame_map()
    own = form is not None and not form.knows_units
    jumps = _jumps(robot, task, box) if own else np.zeros(task.rows, dtype=bool)
    modulus = np.where(jumps, TURN, 0.0)
    for i in range(task.rows):
        steps = np.abs(change[i][change[i] != 0])
        if steps.size:
            modulus[i] = min(steps.min(), modulus[i] or np.inf)
            odd = np.abs(change[i] / modulus[i] - np.round(change[i] / modulus[i])) > SAME
            period[odd], change[:, odd] = np.inf, 0.0
    angle = jumps if form is None or not own else jumps | _turns_with_the_frame(robot, task, form.frame, samples)
    return WholeTurns(period, change, modulus, angle)


def is_own_function(task: Task) -> bool:
    """Return whether a task is a function of the user's own, whose rates and cost are unknown."""
    form = task.frame_map()
    return form is not None and form.S is None


def unknown_turns(robot: Robot, task: Task) -> WholeTurns:
    """Return what is supposed of a task that nobody has looked at: joints without limits are circles."""
    open_ended = robot.revolute & ~np.isfinite(robot.lower) & ~np.isfinite(robot.upper)
    period, nothing = np.where(open_ended, TURN, np.inf), np.zeros(task.rows)
    return WholeTurns(period, np.zeros((task.rows, robot.nq)), nothing, nothing.astype(bool))


def _change(robot: Robot, task: Task, samples: Array, j: int, size: Array) -> tuple[float, Array]:
    """Return the period of a joint, and the change of the rows by it; (∞, 0) if there is none."""
    for turns in range(1, 2 if is_own_function(task) else MOST_TURNS + 1):
        period = turns * TURN
        ahead = samples + period * np.eye(robot.nq)[j]
        change = [task.error(robot, q, task.value(robot, p)) for q, p in zip(samples, ahead, strict=True)]
        if np.all(np.ptp(change, axis=0) <= SAME * size):
            mean = np.mean(change, axis=0)
            return period, np.where(np.abs(mean) <= SAME * size, 0.0, mean)
    return np.inf, np.zeros(task.rows)


def _jumps(robot: Robot, task: Task, box: JointBox) -> npt.NDArray[np.bool_]:
    """Return which rows jump by whole turns, (m,), as atan2 does: seen on three straight walks through the box."""
    rng = np.random.default_rng(0)
    jumps = np.zeros(task.rows, dtype=bool)
    for start, end in zip(box.random(rng, 3), box.random(rng, 3), strict=True):
        far = end + np.where(box.circular, TURN * np.sign(end - start), 0.0)
        walk = start + np.linspace(0, 1, STEPS)[:, None] * (far - start)
        d = np.diff([task.value(robot, q) for q in walk], axis=0)
        usual = np.median(np.abs(d), axis=0)
        whole = np.round(d / TURN)
        jumps |= np.any((whole != 0) & (np.abs(d - TURN * whole) <= 4 * usual + 1e-9) & (usual < 0.5), axis=0)
    return jumps


def _turns_with_the_frame(robot: Robot, task: Task, frame: str | None, samples: Array) -> npt.NDArray[np.bool_]:
    """Return which rows are angles of the frame about a fixed axis, (m,): ṙ = a·ω with a constant, |a| whole."""
    omega = np.hstack([frame_jacobian(robot, q, frame=frame)[3:] for q in samples])
    rows = np.hstack([task.jacobian(robot, q) for q in samples])
    a = np.linalg.lstsq(omega.T, rows.T, rcond=1e-9)[0].T
    exact = np.abs(rows - a @ omega).max(axis=1) <= 1e-7
    length = np.linalg.norm(a, axis=1)
    return np.asarray(exact & (np.round(length) >= 1) & (np.abs(length - np.round(length)) <= 1e-7))
