"""Questions on direct and differential kinematics, singularities and statics."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import sympy

from robotics1 import Robot, balancing_torque, find_singularities, formulas, subspaces
from robotics1.singularities import SingularBranch

from .answer import Answer, Branches, Line, Names, NotZero, Shown
from .reading import Question
from .values import conditions_of, formula_of, numbers_of


def robot_of(question: Question) -> Robot:
    """Return the robot of the exercise.

    Raises:
        InputError: it has none.
    """
    if question.exercise.robot is None:
        question.place.refuse(
            f"question {question.name} ({question.ask}) needs a robot in its exercise: robot = or dh ="
        )
    return question.exercise.robot


def configuration(question: Question, key: str = "q") -> Any:
    """Return joint values that are given as numbers, such as [0.5, "pi/2", 0]."""
    robot, names = robot_of(question), question.exercise.names
    return question.read(key, lambda value: robot.configuration(numbers_of(value, names), key))


def where_of(question: Question) -> Any:
    """Return the equations at which a formula is wanted, such as where = "q2 = pi/2"; none without."""
    return question.read("where", conditions_of, ())


def direct_kinematics(question: Question) -> Answer:
    """R = f(q): "formula"; with q also "value"."""
    robot, task = robot_of(question), question.task
    numbers: dict[str, Any] = {}
    if "q" in question.given:
        value = task.value(robot, configuration(question))
        numbers["value"] = np.ravel(getattr(value, "homogeneous", value))
    return Answer({"formula": Shown("r", formulas(robot, task).value)}, numbers)


def jacobian(question: Question) -> Answer:
    """J(q): "formula", also where equations hold; with q "value" and "rank"."""
    robot, task = robot_of(question), question.task
    J = _at(formulas(robot, task).jacobian, where_of(question))
    numbers: dict[str, Any] = {}
    if "q" in question.given:
        numbers["value"] = np.ravel(task.jacobian(robot, configuration(question)))
        numbers["rank"] = [subspaces(task.jacobian(robot, configuration(question))).rank]
    return Answer({"formula": Shown("J", J)}, numbers)


def determinant(question: Question) -> Answer:
    """The determinant of J: "formula"; of a J that is not square the minors "without 1", "without 2", ..."""
    found = formulas(robot_of(question), question.task)
    if found.jacobian.rows == found.jacobian.cols:
        return Answer({"formula": Shown("det(J)", found.determinant)})
    columns = {out: " ".join(str(k + 1) for k in out) for out in found.minors}
    return Answer({f"without {k}": Shown(f"det(J_-{k})", found.minors[out]) for out, k in columns.items()})


def singularities(question: Question) -> Answer:
    """The singular set: "branches", as "q2 = pi/2, q3 = 0", their "count", the joints that are "free"; in sentences."""
    found = find_singularities(robot_of(question), question.task)
    branches = [tuple(branch.conditions) for branch in found.branches]
    return Answer(
        {"branches": Shown("", Branches(branches)), "free": Shown("", Names(found.free_joints))},
        {"count": [len(branches)]},
        text=found.explain(),
    )


def subspaces_of(question: Question) -> Answer:
    """On the singular branch where equations hold: "null", "left null" in formulas, and the "rank".

    Of a left null space of dimension one also what is "lost": ṙ cannot be realised where lᵀ ṙ ≠ 0.
    """
    branch = _branch(question)
    bases = branch.require_formulas()
    found = {}
    for name, symbol, basis in (("null", "qdot", bases.null), ("left null", "f", bases.left_null)):
        for k in range(basis.cols):
            found[name if basis.cols == 1 else f"{name} {k + 1}"] = Shown(symbol, Line(basis.col(k)))
    if bases.left_null.cols == 1:
        rdot = sympy.Matrix(sympy.symbols(f"rdot1:{bases.left_null.rows + 1}", real=True))
        found["lost"] = Shown("", NotZero(bases.left_null.dot(rdot)))
    return Answer(found, {"rank": [branch.rank]}, text=branch.explain())


def _branch(question: Question) -> SingularBranch:
    """Return the branch with the equations of the question."""
    wanted = {condition.lhs: condition.rhs for condition in question.read("where", conditions_of)}
    found = find_singularities(robot_of(question), question.task)
    for branch in found.branches:
        values = {condition.lhs: condition.rhs for condition in branch.conditions}
        if values.keys() == wanted.keys() and all(sympy.simplify(values[q] - wanted[q]) == 0 for q in wanted):
            return branch
    known = "; ".join(", ".join(f"{c.lhs} = {c.rhs}" for c in branch.conditions) for branch in found.branches)
    question.place.refuse(
        f"question {question.name}: no singular branch is where that holds; there are {known}", "where"
    )


def torque(question: Question) -> Answer:
    """Joint torques that balance a force of the environment, τ = −Jᵀ f: "formula", also where; with q "value"."""
    robot, task, names = robot_of(question), question.task, question.exercise.names
    force = question.read("force", lambda value: numbers_of(value, names))
    if len(force) != task.rows:
        question.place.refuse(f"question {question.name}: the force must have {task.rows} numbers", "force")
    J = _at(formulas(robot, task).jacobian, where_of(question))
    symbolic = formula_of([str(entry) for entry in question.given["force"]])
    numbers: dict[str, Any] = {}
    if "q" in question.given:
        numbers["value"] = balancing_torque(task.jacobian(robot, configuration(question)), force)
    return Answer({"formula": Shown("tau", (-J.T * symbolic).applyfunc(sympy.factor))}, numbers)


def _at(formula: sympy.Matrix, conditions: Iterable[sympy.Eq]) -> sympy.Matrix:
    return formula.subs({condition.lhs: condition.rhs for condition in conditions})
