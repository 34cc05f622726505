"""Where the Jacobian of a task loses rank."""

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from robotics1.errors import FormulaError, TaskError
from robotics1.inputs import a_robot_and_a_task, counting_number, one_of, real_number
from robotics1.robot.box import JointBox, joint_box
from robotics1.robot.model import Robot
from robotics1.singularities.numeric import branches_of
from robotics1.singularities.points import NOTHING_MOVES, singular_points
from robotics1.singularities.result import SingularSet
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.tasks.task import Task
from robotics1.tasks.turns import turns_of

if TYPE_CHECKING:
    from robotics1.singularities.symbolic import Found, SymbolicSearch

METHODS = ("auto", "symbolic", "numeric")
WORTH_TELLING = 1e-8  # [rad]
EXACT, DRAWN = (
    0.75,
    0.85,
)  # parts of the time after which equations, and configurations that satisfy them, must be there


def find_singularities(
    robot: Robot,
    task: Task,
    *,
    method: str = "auto",
    box: Mapping[str, tuple[float, float]] | None = None,
    samples: int = 200,
    seed: int = 0,
    time_limit: float = 30.0,
) -> SingularSet:
    """Return the singular set {q : rank J(q) < ρ} of a task, ρ being the rank of J almost everywhere.

    The symbolic method sets all minors of order ρ to zero, factor by factor, and finds every branch, with its
    equations and bases in q1, q2, ... and the named lengths. Each branch is verified with Pinocchio. If its time
    is over, what it has found stands, the numeric method adds the rest, and `complete` is False.

    The numeric method knows J at any q, and nothing else of the robot: from random starts it moves to the set
    by Newton's method, measures the set's dimension there, sees which joints are constant and which are free,
    and joins what a walk on the set connects. It can miss a small branch, so `complete` is False.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        method: "symbolic", "numeric", or "auto": symbolic, and numeric where there are no formulas.
        box: joint name → (lower, upper), where to look; the numeric method needs it for prismatic joints without
            limits.
        samples: the number of starts of the numeric method.
        seed: of the random numbers.
        time_limit: of both methods together [s]: 85 % of it are the exact answer's, three quarters for its equations,
            and what is left is the numeric search's. What is asked of the answer later, such as `intersections`, has
            that time once more.

    Raises:
        InputError: an unlimited prismatic joint without a box, or a bad option.
        TaskError: the task does not fit the robot, or no joint moves it.
        FormulaError: method="symbolic", and there are no formulas of the robot or the task.
    """
    a_robot_and_a_task(robot, task)
    one_of("method", method, METHODS)
    count = counting_number("samples", samples, least=1)
    seed = counting_number("seed", seed)
    limit = TimeLimit(real_number("time_limit", time_limit, positive=True))
    task.check(robot)
    turns = turns_of(robot, task)
    where = joint_box(robot, box, unlimited=None if method == "numeric" else 2.0, turns=turns)
    if robot.nv == 0:
        return _without_joints(robot, task, method)
    if method == "numeric":
        return _numeric(robot, task, where, count, seed, limit)
    try:
        return _symbolic(robot, task, where, count, seed, limit)
    except FormulaError as error:
        if method == "symbolic":
            raise
        found = _numeric(robot, task, joint_box(robot, box, turns=turns), count, seed, limit)
        return replace(found, note=f"There are no formulas: {error}.")


def _without_joints(robot: Robot, task: Task, method: str) -> SingularSet:
    """Return the answer for a robot that does not move: J has no columns, and rank 0 is its full rank."""
    note = "The robot has no joints, so that its Jacobian has no columns."
    return SingularSet(robot, task, 0, (), "numeric" if method == "numeric" else "symbolic", complete=True, note=note)


def _numeric(robot: Robot, task: Task, where: JointBox, count: int, seed: int, limit: TimeLimit) -> SingularSet:
    rng = np.random.default_rng(seed)
    points = singular_points(robot, task, where, rng)
    if points.rank == 0:
        raise TaskError(NOTHING_MOVES)
    return SingularSet(robot, task, points.rank, branches_of(points, count, rng, limit), "numeric", complete=False)


def _symbolic(robot: Robot, task: Task, where: JointBox, count: int, seed: int, limit: TimeLimit) -> SingularSet:
    from robotics1.singularities.symbolic import symbolic_search

    rng = np.random.default_rng(seed)
    try:
        with limit.part(EXACT).kept():
            search = symbolic_search(robot, task, where, rng, limit.part(EXACT))
    except OutOfTime:
        found = _numeric(robot, task, where, count, seed, limit)
        return replace(found, note=_not_complete(limit, len(found.branches), 0))
    answer = search.branches(rng, limit.part(DRAWN))
    found = SingularSet(
        robot,
        task,
        search.points.rank,
        answer.inside,
        method="symbolic",
        complete=answer.complete,
        note=_note(search, answer),
        outside=answer.outside,
        search=search,
    )
    if answer.complete:
        return found
    others = [
        branch
        for branch in branches_of(search.points, count, rng, limit)
        if not all(any(known.contains(q) for known in answer.inside) for q in branch.samples)
    ]
    note = _not_complete(limit, len(others), len(answer.inside))
    return replace(
        found,
        branches=(*answer.inside, *others),
        method="both" if answer.inside else "numeric",
        note=" ".join(filter(None, (note, found.note))),
    )


def _not_complete(limit: TimeLimit, others: int, exact: int) -> str:
    return f"The exact answer was not complete after {limit.seconds:g} s; {_by_numbers(others, exact)}."


def _by_numbers(others: int, exact: int) -> str:
    """Say which branches the numeric search has added; they stand last."""
    if not others:
        return "a search by numbers found no other branch"
    if not exact:
        return "all branches were found by numbers"
    return (
        "the last branch was found by numbers" if others == 1 else f"the last {others} branches were found by numbers"
    )


def _note(search: "SymbolicSearch", answer: "Found") -> str:
    """Say which angles were made exact, and where the task has no Jacobian."""
    from robotics1.symbolic.writing.printing import line_text

    said = []
    if search.cleaned > WORTH_TELLING:
        said.append(f"Angles of the file were made exact multiples of π/12, by at most {search.cleaned:.1e} rad.")
    if answer.undefined:
        places = (" and ".join(map(line_text, piece.conditions)) for piece in answer.undefined)
        said.append(f"Where {' or '.join(places)}, the task itself has no Jacobian.")
    return " ".join(said)
