"""Questions on inverse kinematics, trajectories and workspaces."""

from typing import Any

import numpy as np
import pinocchio as pin
import sympy

from robotics1 import MotionLimits, cubic, formulas, ik_solutions, iterate_ik, minimum_time
from robotics1.ik import IKIteration
from robotics1.notation import number, vector
from robotics1.plots import plot_trajectory, plot_workspace
from robotics1.workspaces import workspace as find_workspace

from .answer import Answer, Shown, ShownTable
from .kinematics_questions import configuration, robot_of
from .reading import Question, text_of
from .values import number_of, numbers_of


def inverse_kinematics(question: Question) -> Answer:
    """All solutions of a target: "count", and "solution 1", "solution 2", ... in order of q."""
    robot, task = robot_of(question), question.task
    found = ik_solutions(robot, task, numbers_in(question, "target"))
    rows = sorted(found.q.tolist(), reverse=True)
    numbers: dict[str, Any] = {"count": [len(rows)], **{f"solution {i}": q for i, q in enumerate(rows, 1)}}
    return Answer(numbers=numbers, text=found.explain())


def iteration(question: Question) -> Answer:
    """An iteration from q0: "q" at its end, "iterations", and the rows "k=0 q", "k=0 r", "k=0 error", "k=0 det".

    Where J is square, Newton's "next q" is the formula q + J⁻¹ (r_d − r), with x_d for the target of x.
    """
    robot, task = robot_of(question), question.task
    method = question.read("method", text_of, "newton")
    tolerance = question.read("tolerance", lambda value: number_of(value, {}), 1e-4)
    run = iterate_ik(
        robot, task, numbers_in(question, "target"), configuration(question, "q0"), method=method, tolerance=tolerance
    )
    numbers: dict[str, Any] = {"q": run.q, "iterations": [run.iterations], "rows": [len(run.table)]}
    for row in run.table:
        r = row.r.translation if isinstance(row.r, pin.SE3) else row.r
        values = {"q": row.q, "r": np.ravel(r), "error": [row.error_norm], "det": [row.det]}
        numbers |= {f"k={row.k} {name}": value for name, value in values.items()}
    words = {"status": [run.status.name.lower()]}
    shown = _next_q(question) if method == "newton" else {}
    rows = ["rows", *(name for name in numbers if name.startswith("k="))]
    columns = ("q", "r", "error", "det")
    return Answer(shown, numbers, words, columns, run.explain(), [_table(run, method)], tabled=rows)


def _next_q(question: Question) -> dict[str, Shown]:
    found = formulas(robot_of(question), question.task)
    J, r = found.jacobian, found.value
    if J.rows != J.cols or r.shape != (J.rows, 1) or J.det() == 0:
        return {}
    target = sympy.Matrix([sympy.Symbol(f"{name}_d", real=True) for name in question.task.row_names])
    return {"next q": Shown("q_next", sympy.Matrix(found.q) + sympy.simplify(J.inv() * (target - r)))}


def _table(run: IKIteration, method: str) -> ShownTable:
    rows = [
        (str(row.k), vector(row.q), vector(np.ravel(getattr(row.r, "translation", row.r))), f"{row.error_norm:.5f}",
         number(row.det) if np.isfinite(row.det) else "–")
        for row in run.table
    ]  # fmt: skip
    return ShownTable(f"{method}, iterate by iterate", ("k", "q", "r", "|e|", "det J"), rows)


def fastest(question: Question) -> Answer:
    """The motion in least time between two configurations inside bounds of velocity and acceleration: "time"."""
    start, goal = (numbers_in(question, key) for key in ("from", "to"))
    limits = MotionLimits(numbers_in(question, "max_velocity"), numbers_in(question, "max_acceleration"))
    found = minimum_time(start, goal, limits, question.read("law", text_of, "trapezoidal"))
    motion = plot_trajectory(found.trajectory, title="the fastest motion")
    return Answer(numbers={"time": [found.duration], "joint times": found.joint_durations}, figures=[motion])


def cubic_motion(question: Question) -> Answer:
    """A cubic from one configuration to another: "coefficients" of 1, τ, τ², τ³, joint by joint, "greatest speeds"."""
    start, goal = (numbers_in(question, key) for key in ("from", "to"))
    rest = [0.0] * len(start)
    motion = cubic(
        start, goal, number_in(question, "time"), numbers_in(question, "v0", rest), numbers_in(question, "v1", rest)
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


def number_in(question: Question, key: str) -> float:
    """Return a number of a question; names of lengths and data have their values."""
    return float(question.read(key, lambda value: number_of(value, question.exercise.names)))


def numbers_in(question: Question, key: str, otherwise: Any = None) -> Any:
    """Return a list of numbers of a question."""
    return question.read(key, lambda value: numbers_of(value, question.exercise.names), otherwise)
