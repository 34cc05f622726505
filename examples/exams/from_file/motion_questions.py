"""Questions on inverse kinematics, trajectories and workspaces."""

from collections.abc import Callable
from math import cos, radians, sin
from typing import Any

import numpy as np
import pinocchio as pin

from robotics1 import LinearMotion, MotionLimits, cubic, ik_solutions, iterate_ik, minimum_time, rendezvous
from robotics1.errors import InputError
from robotics1.ik import IKIteration
from robotics1.notation import number, vector
from robotics1.plots import plot_trajectory, plot_workspace
from robotics1.workspaces import workspace as find_workspace

from .answer import Answer, ShownTable
from .kinematics_questions import configuration, robot_of
from .reading import Question, text_of
from .values import number_of, numbers_of


def inverse_kinematics(question: Question) -> Answer:
    """All solutions of a target: "count", and "solution 1", "solution 2", ... in order of q."""
    robot, task = robot_of(question), question.task
    found = ik_solutions(robot, task, _numbers(question, "target"))
    rows = sorted(found.q.tolist(), reverse=True)
    numbers: dict[str, Any] = {"count": [len(rows)], **{f"solution {i}": q for i, q in enumerate(rows, 1)}}
    return Answer(numbers=numbers, text=found.explain())


def iteration(question: Question) -> Answer:
    """An iteration from q0: "q" at its end, "iterations", and the rows "k=0 q", "k=0 r", "k=0 error", "k=0 det"."""
    robot, task = robot_of(question), question.task
    method = question.read("method", text_of, "newton")
    tolerance = question.read("tolerance", lambda value: number_of(value, {}), 1e-4)
    run = iterate_ik(
        robot, task, _numbers(question, "target"), configuration(question, "q0"), method=method, tolerance=tolerance
    )
    numbers: dict[str, Any] = {"q": run.q, "iterations": [run.iterations]}
    for row in run.table:
        r = row.r.translation if isinstance(row.r, pin.SE3) else row.r
        values = {"q": row.q, "r": np.ravel(r), "error": [row.error_norm], "det": [row.det]}
        numbers |= {f"k={row.k} {name}": value for name, value in values.items()}
    return Answer(numbers=numbers, text=run.explain(), tables=[_table(run, method)])


def _table(run: IKIteration, method: str) -> ShownTable:
    rows = [
        (str(row.k), vector(row.q), vector(np.ravel(getattr(row.r, "translation", row.r))), f"{row.error_norm:.5f}",
         number(row.det) if np.isfinite(row.det) else "–")
        for row in run.table
    ]  # fmt: skip
    return ShownTable(f"{method}, iterate by iterate", ("k", "q", "r", "|e|", "det J"), rows)


def meeting(question: Question) -> Answer:
    """A rendez-vous with a target that moves on a line: "time", "position", and of each arm "right q", "left qdot", ...

    The target starts at `start` with `speed` in the direction `angle` [degrees]; they meet at a `time`, or where a
    coordinate has a value, `meet = "x = 0"`.
    """
    robot, task = robot_of(question), question.task
    speed, angle = _number(question, "speed"), _number(question, "angle")
    direction = np.array([cos(radians(angle)), sin(radians(angle))])
    target = LinearMotion(_numbers(question, "start"), speed * direction)
    found = rendezvous(robot, task, target, configuration(question, "q0"), meet=question.read("meet", _event))
    numbers: dict[str, Any] = {"time": [found.time], "position": found.position, "velocity": found.velocity}
    figures = []
    for branch, name in zip(sorted(found.branches, key=lambda b: -b.q[-1]), _names(len(found.branches)), strict=True):
        motion = branch.trajectory
        numbers |= {f"{name} q": branch.q, f"{name} qdot": branch.qdot}
        for symbol, c in (("q(tau)", motion.coefficients), ("q(t)", motion.coefficients_t)):
            numbers[f"{name} {symbol}"] = c[2:].ravel()
        for symbol, c in (("qdot(tau)", motion.rate.coefficients), ("qdot(t)", motion.rate.coefficients_t)):
            numbers[f"{name} {symbol}"] = c[1:].ravel()
        figures.append(plot_trajectory(motion, robot=robot, derivatives=1, title=f"{name} arm"))
    return Answer(numbers=numbers, text=f"{found.status.value}.", figures=figures)


def _names(n: int) -> list[str]:
    return ["right", "left"] if n == 2 else [f"arm {i + 1}" for i in range(n)]


def _event(value: Any) -> float | Callable[[float, Any], float]:
    """Return a time, or the function that is zero where a coordinate has a value."""
    if not isinstance(value, str):
        return number_of(value, {})
    coordinate, _, right = (part.strip() for part in value.partition("="))
    if coordinate not in ("x", "y", "z") or not right:
        raise InputError(f"they meet at a time [s], or where a coordinate has a value, as in 'x = 0'; it is {value!r}")
    place, level = "xyz".index(coordinate), number_of(right, {})
    return lambda t, p: float(p[place] - level)


def fastest(question: Question) -> Answer:
    """The motion in least time between two configurations inside bounds of velocity and acceleration: "time"."""
    start, goal = (_numbers(question, key) for key in ("from", "to"))
    limits = MotionLimits(_numbers(question, "max_velocity"), _numbers(question, "max_acceleration"))
    found = minimum_time(start, goal, limits, question.read("law", text_of, "trapezoidal"))
    motion = plot_trajectory(found.trajectory, title="the fastest motion")
    return Answer(numbers={"time": [found.duration], "joint times": found.joint_durations}, figures=[motion])


def cubic_motion(question: Question) -> Answer:
    """A cubic from one configuration to another: "coefficients" of 1, τ, τ², τ³, joint by joint, "greatest speeds"."""
    start, goal = (_numbers(question, key) for key in ("from", "to"))
    rest = [0.0] * len(start)
    motion = cubic(
        start, goal, _number(question, "time"), _numbers(question, "v0", rest), _numbers(question, "v1", rest)
    )
    extremes = np.abs(motion.extremes(1)[1]).max(axis=0)
    numbers = {"coefficients": motion.coefficients.T.ravel(), "greatest speeds": np.atleast_1d(extremes)}
    return Answer(numbers=numbers, figures=[plot_trajectory(motion, derivatives=2)])


def reached(question: Question) -> Answer:
    """The workspace: "area" or "volume", "least reach", "largest reach"."""
    found = find_workspace(robot_of(question), question.task)
    size = {"area": [found.area]} if found.volume is None else {"area": [found.area], "volume": [found.volume]}
    numbers = {**size, "least reach": [found.r_min], "largest reach": [found.r_max]}
    return Answer(numbers=numbers, text=found.explain().split("\nThe boundary")[0], figures=[plot_workspace(found)])


def _number(question: Question, key: str) -> float:
    return float(question.read(key, lambda value: number_of(value, question.exercise.names)))


def _numbers(question: Question, key: str, otherwise: Any = None) -> Any:
    return question.read(key, lambda value: numbers_of(value, question.exercise.names), otherwise)
