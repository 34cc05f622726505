"""The solutions of a redundant arm: the curves along which its joints move while the task stands still."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np
from scipy.optimize import minimize_scalar

from robotics1.errors import InputError, TaskError
from robotics1.ik.curve_tracing import STEP, CurveTracer, TracedCurve
from robotics1.ik.result import IKStatus
from robotics1.ik.scaled_task import ScaledTask, scaled_task
from robotics1.ik.solutions import ik_solutions
from robotics1.inputs import Array, counting_number, one_of
from robotics1.notation import count
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.tasks.given import TaskLike, robot_and_task

Criteria = Literal["manipulability", "middle", "near"]
CRITERIA = ("manipulability", "middle", "near")
Criterion = Callable[[Array], float]


@dataclass(frozen=True, eq=False)
class SelfMotionCurve(Frozen):
    """One connected curve of solutions.

    Attributes:
        q: (k, nq) solutions at equal distances along it, inside the joint limits [rad or m]; joints without limits, and
            those that can make a whole turn, are turned into one turn.
        closed: whether the last is followed by the first.
        ends: where an open curve begins and ends: the name of the joint that is at a limit, or "a singularity".
        length: of the curve, in rad and reaches of the arm.
        best: (nq,) the solution on it that is the best by the criterion.
        value: of the criterion there.
    """

    q: Array
    closed: bool
    ends: tuple[str, str]
    length: float
    best: Array
    value: float


@dataclass(frozen=True, eq=False)
class SelfMotion(Frozen):
    """The solutions of a task that more joints move than it has rows.

    Attributes:
        status: INFINITE, or as `ik_solutions` has it where there is no solution, or only single ones.
        dimension: of the set of solutions: how many joint motions leave the task as it is.
        curves: its connected pieces, the longer first, where the dimension is 1.
        q: (k, nq) the solutions that the search has found; where the dimension is larger, samples of the set.
        best: (nq,) the best solution by the criterion; empty if there is none.
        value: of the criterion there.
        criterion: "manipulability", "middle" or "near".
        starts: the random starts. Curves that none of them leads to are missed.
    """

    status: IKStatus
    dimension: int
    curves: tuple[SelfMotionCurve, ...]
    q: Array
    best: Array
    value: float
    criterion: str
    starts: int

    def explain(self) -> str:
        """Return the pieces of the set, in sentences."""
        if not len(self.q):
            return self.status.value
        if not self.curves:
            return f"solutions of dimension {self.dimension}; {count(len(self.q), 'sample')} of them"
        closed = sum(curve.closed for curve in self.curves)
        parts = f"{count(len(self.curves), 'curve')} of solutions, {closed} of them closed"
        ends = sorted({end for curve in self.curves for end in curve.ends if end})
        at = f"; the others end at {', '.join(ends)}" if ends else ""
        return f"{parts}{at}; found from {count(self.starts, 'random start')}, so that there may be others"

    def require(self) -> SelfMotion:
        """Return self if there is a solution.

        Raises:
            NotConverged: there is none.
        """
        return require(self, len(self.q) > 0)


def self_motion(
    robot: RobotLike,
    task: TaskLike,
    target: Any,
    *,
    criterion: Criteria = "manipulability",
    q0: ConfigurationLike | None = None,
    samples: int = 50,
    box: Mapping[str, tuple[float, float]] | None = None,
    starts: int = 30,
    seed: int = 0,
) -> SelfMotion:
    """Return the solutions of f(q) = r_d where more joints move the task than it has rows.

    They are a set of n − m dimensions. If that is 1, it consists of curves with the tangent N(J). Each is followed
    until it closes or a joint is at its limit. `ik_solutions` with `locked` gives the finitely many with given joints.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        target: r_d, in the form of the task's value.
        criterion: what the best solution has the most of: "manipulability", √det(J Jᵀ); "middle",
            −½ Σ ((q − q̄)/(q_max − q_min))² over the joints with limits; or "near", minus the distance from q0.
        q0: (nq,) the configuration for "near" [rad or m].
        samples: of each curve, at equal distances.
        box: joint name → (lower, upper), where to look.
        starts: the random starts that lead to the curves.
        seed: of these.

    Raises:
        InputError: the target has the wrong form; "near" without q0, or q0 without "near".
        TaskError: the task does not fit the robot, or no more joints move it than it has rows.

    Source: Burdick, On the inverse kinematics of redundant manipulators: characterization of the self-motion manifolds,
    ICRA 1989; Liégeois, Automatic supervisory control of the configuration and behavior of multibody mechanisms, 1977.
    """
    robot, task = robot_and_task(robot, task)
    one_of("criterion", criterion, CRITERIA)
    if (q0 is not None) != (criterion == "near"):
        raise InputError("give q0 with criterion='near', and only then")
    samples, starts = counting_number("samples", samples, least=2), counting_number("starts", starts, least=1)
    problem = scaled_task(robot, task, box)
    n = int(np.count_nonzero(problem.moving))
    if n <= task.rows:
        raise TaskError(
            f"{count(n, 'joint')} and {count(task.rows, 'row')} of the task: where no joint is left over there are no "
            f"curves of solutions; ik_solutions has the single ones"
        )
    measure = _measure(problem, criterion, problem.middle if q0 is None else robot.configuration(q0, "q0"))
    found = ik_solutions(robot, task, target, box=box, starts=starts, seed=seed)
    single = found.dimension != 1
    curves = () if single else _curves(problem, task.target(target), found.q, samples, measure)
    candidates = [(curve.value, curve.best) for curve in curves] or [(measure(q), q) for q in found.q]
    value, best = max(candidates, key=lambda pair: pair[0], default=(-np.inf, np.zeros(0)))
    return SelfMotion(found.status, found.dimension, curves, found.q, best, value, criterion, starts)


def _measure(problem: ScaledTask, criterion: str, q0: Array) -> Criterion:
    """Return what is to be large."""
    robot, moving = problem.robot, problem.moving
    limited = np.isfinite(problem.upper - problem.lower) & moving & (problem.upper > problem.lower)

    def manipulability(q: Array) -> float:
        J = problem.task.jacobian(robot, q)[:, moving]
        return float(np.prod(np.linalg.svd(J, compute_uv=False)))

    def middle(q: Array) -> float:
        share = (q - 0.5 * (problem.lower + problem.upper))[limited] / (problem.upper - problem.lower)[limited]
        return -0.5 * float(share @ share)

    def near(q: Array) -> float:
        return -float(np.linalg.norm(problem.box.difference(q, q0)[moving]))

    return {"manipulability": manipulability, "middle": middle, "near": near}[criterion]


def _curves(
    problem: ScaledTask, target: Any, found: Array, samples: int, measure: Criterion
) -> tuple[SelfMotionCurve, ...]:
    """Return the curves through the solutions that were found, each once."""
    tracer = CurveTracer(problem, target)
    traced: list[TracedCurve] = []
    for q in found:
        exact = tracer.corrected(q)
        if exact is not None and not any(_is_on(problem, exact, curve) for curve in traced):
            traced.append(tracer.curve(exact))
    curves = [_sampled(tracer, curve, samples, measure) for curve in traced]
    return tuple(sorted(curves, key=lambda curve: -curve.length))


def _is_on(problem: ScaledTask, q: Array, curve: TracedCurve) -> bool:
    """Whether a solution is on a curve: next to one of its chords."""
    ends = np.roll(curve.q, -1, axis=0) if curve.closed else [*curve.q[1:], curve.q[-1]]
    chords, d = problem.box.difference(np.array(ends), curve.q), problem.box.difference(q, curve.q)
    along = (d * chords).sum(axis=1) / np.maximum((chords * chords).sum(axis=1), 1e-300)
    beside = d - np.clip(along, 0, 1)[:, None] * chords
    return bool(np.linalg.norm(beside, axis=1).min() < 0.25 * STEP)


def _sampled(tracer: CurveTracer, curve: TracedCurve, samples: int, measure: Criterion) -> SelfMotionCurve:
    """Return a curve as solutions at equal distances, and the best on it."""
    box = tracer.problem.box
    steps = [box.difference(b, a) * box.unit for a, b in zip(curve.q[:-1], curve.q[1:], strict=True)]
    steps += [box.difference(curve.q[0], curve.q[-1]) * box.unit] if curve.closed else []
    corners = np.cumsum([curve.q[0], *steps], axis=0)
    s = np.cumsum([0.0, *(np.linalg.norm(step / box.unit) for step in steps)])

    def at(place: float) -> Array:
        guess = np.array([np.interp(place, s, column) for column in corners.T])
        exact = tracer.corrected(guess, across=tracer.tangent(guess))
        inside = None if exact is None else box.nearest(exact)
        nearest = corners[int(np.argmin(np.abs(s - place)))]
        good = inside is not None and np.abs(box.difference(inside, guess)).max() < STEP
        return inside if good and inside is not None and tracer.is_solution(inside) else box.nearest(nearest)

    places = np.linspace(0, s[-1], samples, endpoint=not curve.closed)
    q = np.array([at(place) for place in places])
    values = [measure(p) for p in q]
    i = int(np.argmax(values))
    gap = s[-1] / samples
    bounds = max(0.0, places[i] - gap), min(s[-1], places[i] + gap)
    found = minimize_scalar(lambda place: -measure(at(place)), bounds=bounds, method="bounded", options={"xatol": 1e-6})
    best = at(float(found.x)) if -found.fun > values[i] else q[i]
    return SelfMotionCurve(q, curve.closed, curve.ends, float(s[-1]), best, measure(best))
