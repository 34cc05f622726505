"""How fast a task may go along its path under bounds on the joints' velocities: where, and which joint decides."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
import numpy.typing as npt

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve
from robotics1.curves.named_derivatives import Side
from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, counting_number, positive_bound
from robotics1.least_squares import GeneralizedInverse, generalized_inverse, rank_of
from robotics1.results import Frozen
from robotics1.robot.given import RobotLike
from robotics1.robot.model import Robot
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.rows import unitless_factors, unitless_rows
from robotics1.tasks.task import Task

ROUNDS = 30  # of Newton's method at one point of the path
CLOSE = 1e-10  # |e|, in reaches and rad
REALISED = 1e-7  # |J ρ − p'|/|p'| that is rounding


@dataclass(frozen=True, eq=False)
class SpeedAlongPath(Frozen):
    """The bounds of the joints' velocities as bounds on ṡ along a path.

    Attributes:
        s: (k,) parameters of the path.
        q: (k, n) the configurations there, along one branch.
        rates: (k, n) ρ = dq/ds, so that q̇ = ρ ṡ.
        limit: (k,) the largest ṡ at each: min Vⱼ/|ρⱼ|.
        joint: (k,) the number of the joint that decides it.
        speed: the largest ṡ that can be kept all along.
        speed_at: s where it is decided.
        speed_joint: the name of the joint that decides it.
        breakpoints: of the path.
    """

    s: Array
    q: Array
    rates: Array
    limit: Array
    joint: npt.NDArray[np.intp]
    speed: float
    speed_at: float
    speed_joint: str
    breakpoints: Array

    @property
    def uniform_time(self) -> float:
        """The time at the largest constant ṡ [s]."""
        return float(self.s[-1] / self.speed)

    @property
    def least_time(self) -> float:
        """∫ ds/ṡ with the largest ṡ at each s [s]: the least time of all laws, with velocities bounded alone.

        By the trapezoidal rule over the points: the error falls with the square of their distance.
        """
        return float(np.trapezoid(1 / self.limit, self.s))

    @property
    def joint_path(self) -> PiecewisePolynomial:
        """q(s), cubics through the points with their rates: with accelerations bounded too, `time_optimal` takes it."""
        from scipy.interpolate import CubicHermiteSpline

        return PiecewisePolynomial.from_ppoly(CubicHermiteSpline(self.s, self.q, self.rates))

    def explain(self) -> str:
        """Return the largest constant speed, and what decides it, in a sentence."""
        return (
            f"ṡ is at most {self.speed:.6g} all along, decided at s = {self.speed_at:.6g} by {self.speed_joint}: "
            f"{self.uniform_time:.6g} s; with the largest ṡ everywhere it takes {self.least_time:.6g} s"
        )


def speed_along_path(
    robot: RobotLike,
    task: TaskLike,
    path: Curve,
    q0: npt.ArrayLike,
    *,
    velocity: npt.ArrayLike | None = None,
    samples: int = 400,
) -> SpeedAlongPath:
    """Return how fast a task may go along its path under |q̇| ≤ V: at each s, and all along with a constant ṡ.

    q̇ = ρ ṡ with ρ = J⁺ p'(s), so that ṡ ≤ min Vⱼ/|ρⱼ|. q(s) is found by Newton's method, from each point to the next,
    on the branch of q0. On a path of its arc length ṡ is the speed [m/s].

    Args:
        robot: of revolute and prismatic joints; its limits of position do not count.
        task: r = f(q).
        path: of the task's values: points, planar poses, or poses.
        q0: (nq,) near the configuration at s = 0, which decides the branch [rad or m].
        velocity: V > 0 [rad/s or m/s], (n,) or one number for all; by default the robot's limits.
        samples: of the path, and two at each breakpoint.

    Raises:
        InputError: a joint has no bound, the path is of other values, or a shape is wrong.
        TaskError: the path leaves the workspace, or passes a singularity in a direction that no q̇ realises; the message
            says where.
    """
    robot, task = robot_and_task(robot, task)
    robot.require_single_coordinates("follow a path here")
    curve = as_curve("path", path, derivatives=1)
    bounds = np.array(robot.max_velocity) if velocity is None else positive_bound("velocity", velocity, robot.nv)
    if not np.isfinite(bounds).any():
        raise InputError("no joint has a bound on its velocity: give velocity=..., one number for all or one a joint")
    if curve.shape != (task.rows,) or curve.end <= 0:
        raise InputError(
            f"path must be one of the task, with {task.rows} rows; its tangent has the shape {curve.shape}"
        )
    follower = _Follower(robot, task, curve)
    s, sides = _points(curve, counting_number("samples", samples, least=8, most=100_000))
    q, rates = np.empty((len(s), robot.nq)), np.empty((len(s), robot.nv))
    at = robot.configuration(q0, "q0")
    for i, (x, side) in enumerate(zip(s.tolist(), sides, strict=True)):
        ahead = at if i == 0 else at + rates[i - 1] * (x - s[i - 1])
        at = q[i] = follower.configuration(ahead, x)
        rates[i] = follower.rate(at, x, side)
    limit, joint = _limits(rates, bounds)
    best = int(limit.argmin())
    place, speed = _refined(follower, bounds, s, q, sides, best)
    deciding = int(
        _limits(follower.rate(follower.configuration(q[best], place), place, sides[best])[None], bounds)[1][0]
    )
    once = np.r_[True, np.diff(s) > 0]  # at a breakpoint the first of the two
    return SpeedAlongPath(
        s[once],
        q[once],
        rates[once],
        limit[once],
        joint[once],
        speed,
        place,
        robot.joint_names[deciding],
        np.array(curve.breakpoints),
    )


@dataclass(frozen=True)
class _Follower:
    """The configurations of a task on its path."""

    robot: Robot
    task: Task
    path: Curve

    def configuration(self, q: Array, s: float) -> Array:
        """Return the configuration near q at which the task is at p(s).

        Raises:
            TaskError: there is none.
        """
        target = self.path(s)
        rows = unitless_rows(self.robot, self.task)
        for _ in range(ROUNDS):
            error = self.task.error(self.robot, q, target)
            if np.abs(rows * error).max() <= CLOSE:
                return q
            J = self.task.jacobian(self.robot, q)
            q = q + np.clip(self._inverse(J).solve(error), -0.5, 0.5)
        raise TaskError(f"the path cannot be followed to s = {s:.6g}: no configuration on this branch reaches it")

    def rate(self, q: Array, s: float, side: Side) -> Array:
        """Return ρ = J⁺ p'.

        Raises:
            TaskError: no q̇ realises p'.
        """
        tangent = np.asarray(self.path.derivative(s, 1, side=side))
        J = self.task.jacobian(self.robot, q)
        rho = self._inverse(J).solve(tangent)
        if np.linalg.norm(J @ rho - tangent) > REALISED * np.linalg.norm(tangent):
            raise TaskError(f"at s = {s:.6g} the arm is singular, and no joint velocity follows the path")
        return rho

    def _inverse(self, J: Array) -> GeneralizedInverse:
        return generalized_inverse(J, rank=rank_of(J, unitless_factors(self.robot, self.task)))


def _points(path: Curve, samples: int) -> tuple[Array, list[Side]]:
    """Return parameters, each breakpoint twice, and from which side the tangent is taken there."""
    s: list[float] = []
    sides: list[Side] = []
    for a, b in pairwise(path.ends):
        count = max(4, round(samples * (b - a) / path.end))
        s += np.linspace(a, b, count + 1).tolist()
        sides += ["right" for _ in range(count)]
        sides.append("left")
    return np.array(s), sides


def _limits(rates: Array, bounds: Array) -> tuple[Array, npt.NDArray[np.intp]]:
    """Return min Vⱼ/|ρⱼ| at each point, and the joint."""
    sizes = np.abs(rates) / bounds
    return 1 / np.maximum(sizes.max(axis=1), 1e-300), sizes.argmax(axis=1)


def _refined(
    follower: _Follower, bounds: Array, s: Array, q: Array, sides: list[Side], best: int
) -> tuple[float, float]:
    """Return where the bound on ṡ is least, near the least of the points, and the bound there."""
    from scipy.optimize import minimize_scalar

    def limit(x: float) -> float:
        near = follower.configuration(q[best], x)
        return float(_limits(follower.rate(near, x, sides[best])[None], bounds)[0][0])

    found = [(float(s[best]), limit(float(s[best])))]
    for i in (best - 1, best):
        if 0 <= i < len(s) - 1 and s[i + 1] > s[i]:
            best_inside = minimize_scalar(limit, bounds=(s[i], s[i + 1]), method="bounded", options={"xatol": 1e-10})
            found.append((float(best_inside.x), float(best_inside.fun)))
    return min(found, key=lambda pair: pair[1] * (1 + 1e-12 * (pair is not found[0])))
