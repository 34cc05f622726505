"""Questions on a rendez-vous with a target that moves on a line, and on the feedback that a perturbed start needs."""

from collections.abc import Callable
from math import cos, radians, sin
from typing import Any

import numpy as np
import sympy

from robotics1 import LinearMotion, PositionTask, animate, formulas, rendezvous
from robotics1.control import smallest_gain
from robotics1.errors import InputError
from robotics1.plots import plot_path, plot_trajectory
from robotics1.trajectories import MeetingBranch, Rendezvous, TaskTrajectory, polynomial_formula

from ..polynomials import polynomial_rows
from .answer import Answer, Shown, ShownTable
from .kinematics_questions import configuration, robot_of
from .motion_questions import number_in, numbers_in
from .reading import Question, text_of
from .values import formula_of, number_of

MEETING_KEYS = ("q0", "start", "speed", "angle", "meet")


def meeting(question: Question) -> Answer:
    """A rendez-vous with a target that moves on a line: "time", "position", and of each arm "right q", "left qdot", ...

    The target starts at `start` with `speed` in the direction `angle` [degrees]; they meet at a `time`, or where a
    coordinate has a value, `meet = "x = 0"`. In letters: "time formula", "position formula", "velocity formula", and
    the cubic to q_rv, qdot_rv in t_rv, "q(tau) formula", "qdot(tau) formula".
    """
    robot, target, found = _met(question)
    arms = _arms(found)
    numbers: dict[str, Any] = {
        "time": [found.time], "position": found.position, "velocity": found.velocity, "solutions": [len(arms)]
    }  # fmt: skip
    tables, figures = [], []
    for name, branch in arms.items():
        motion = branch.trajectory
        numbers |= _numbers_of(name, branch)
        tables.append(ShownTable(f"{name} arm, τ = t/T, T = {motion.duration:.4f} s", *polynomial_rows(robot, motion)))
        figures.append(plot_trajectory(motion, robot=robot, derivatives=1, title=f"{name} arm"))
        if isinstance(question.task, PositionTask):
            path = TaskTrajectory(robot, question.task, motion)
            figures.append(plot_path(path, target=target, title=f"{name} arm, the way of its tool"))
    page = animate(
        robot, [branch.trajectory for branch in arms.values()], names=[f"{name} arm" for name in arms], target=target
    )
    return Answer(
        _in_letters(question),
        numbers,
        text=f"{found.status.value}.",
        tables=tables,
        figures=figures,
        tabled=[name for name in numbers if name.endswith(("(tau)", "(t)"))],
        page=page.html,
    )


def feedback_gain(question: Question) -> Answer:
    """The smallest K of q̇ = q̇_d + K (q_d − q) with |q_d − q| = `final_error` at the end, if q is `from` first: "gain".

    It also has the "final error" with it, and the "verdict": "feedback", or "replan" where joints are too slow for it.
    """
    robot, _, found = _met(question)
    arms = _arms(found)
    name = question.read("arm", text_of, next(iter(arms)))
    if name not in arms:
        question.place.refuse(
            f"question {question.name}: no arm is called {name!r}; there are {', '.join(arms)}", "arm"
        )
    choice = smallest_gain(
        arms[name].trajectory,
        numbers_in(question, "from"),
        number_in(question, "final_error"),
        rate_limits=robot.max_velocity,
    )
    numbers = {"gain": [choice.gain[0]], "final error": [choice.run.final_error]}
    return Answer({}, numbers, {"verdict": [choice.status.name.lower()]}, text=f"{choice.status.value}.")


def _met(question: Question) -> tuple[Any, LinearMotion, Rendezvous]:
    robot, angle = robot_of(question), radians(number_in(question, "angle"))
    velocity = number_in(question, "speed") * np.array([cos(angle), sin(angle)])
    target = LinearMotion(numbers_in(question, "start"), velocity)
    event = question.read("meet", _event)
    return robot, target, rendezvous(robot, question.task, target, configuration(question, "q0"), meet=event)


def _arms(found: Rendezvous) -> dict[str, MeetingBranch]:
    """Return the branches with their names: of two the right one has the larger last joint."""
    branches = sorted(found.branches, key=lambda branch: -branch.q[-1])
    names = ["right", "left"] if len(branches) == 2 else [f"arm {i + 1}" for i in range(len(branches))]
    return dict(zip(names, branches, strict=True))


def _numbers_of(name: str, branch: MeetingBranch) -> dict[str, Any]:
    motion, T = branch.trajectory, branch.trajectory.duration
    return {
        f"{name} q": branch.q,
        f"{name} qdot": branch.qdot,
        f"{name} start": [*motion(0.0), *motion.velocity(0.0)],
        f"{name} end": [*motion(T), *motion.velocity(T)],
        f"{name} q(tau)": motion.coefficients[2:].ravel(),
        f"{name} q(t)": motion.coefficients_t[2:].ravel(),
        f"{name} qdot(tau)": motion.rate.coefficients[1:].ravel(),
        f"{name} qdot(t)": motion.rate.coefficients_t[1:].ravel(),
    }


def _in_letters(question: Question) -> dict[str, Shown]:
    """Return the formulas of the rendez-vous, with the names of data where the file has names."""
    p0 = formula_of([str(entry) for entry in question.given["start"]])
    speed, angle = (formula_of(str(question.given[key])) for key in ("speed", "angle"))
    if not angle.free_symbols:  # degrees; a name stands for the angle
        angle = sympy.rad(angle)
    pdot = speed * sympy.Matrix([sympy.cos(angle), sympy.sin(angle)])
    q_rv, qdot_rv, t_rv = sympy.symbols("q_rv qdot_rv t_rv", real=True)
    begin = sympy.Symbol("q_0", real=True) if any(configuration(question, "q0")) else 0
    law = polynomial_formula((begin, 0), (q_rv, qdot_rv), t_rv)
    found = formulas(robot_of(question), question.task)
    shown = {"velocity formula": Shown("pdot", pdot)}
    meet = question.given["meet"]
    if isinstance(meet, str) and "=" in meet:
        coordinate, _, level = meet.partition("=")
        k = "xyz".index(coordinate.strip())
        time = sympy.simplify((formula_of(level) - p0[k]) / pdot[k])
        shown |= {"time formula": Shown("t_rv", time), "position formula": Shown("p", sympy.simplify(p0 + pdot * time))}
    if found.jacobian.rows == found.jacobian.cols == 2:
        shown["matching qdot"] = Shown("qdot", sympy.simplify(found.jacobian.inv() * pdot))
    shown["q(tau) formula"] = Shown("q_d", law.formula)
    return shown | {"qdot(tau) formula": Shown("qdot_d", law.rate.formula)}


def _event(value: Any) -> float | Callable[[float, Any], float]:
    """Return a time, or the function that is zero where a coordinate has a value."""
    if not isinstance(value, str):
        return number_of(value, {})
    coordinate, _, right = (part.strip() for part in value.partition("="))
    if coordinate not in ("x", "y", "z") or not right:
        raise InputError(f"they meet at a time [s], or where a coordinate has a value, as in 'x = 0'; it is {value!r}")
    place, level = "xyz".index(coordinate), number_of(right, {})
    return lambda t, p: float(p[place] - level)
