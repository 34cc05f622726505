"""Where the Jacobian of a task loses rank."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from robotics1.errors import FormulaError
from robotics1.inputs import counting_number, one_of, real_number
from robotics1.robot.box import JointBox, joint_box
from robotics1.robot.given import RobotLike
from robotics1.robot.model import Robot
from robotics1.singularities.numeric import numeric_branches
from robotics1.singularities.points import singular_points
from robotics1.singularities.result import SingularBranch, SingularSet
from robotics1.symbolic.polynomials.time_limit import OutOfTime, TimeLimit
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import Task, turns_of

if TYPE_CHECKING:
    from robotics1.singularities.symbolic import Found

Method = Literal["auto", "symbolic", "numeric"]
METHODS = ("auto", "symbolic", "numeric")
WORTH_TELLING = 1e-8  # [rad]
EXACT, DRAWN = 0.75, 0.85  # parts of the time, for equations, and for them and configurations that satisfy them


def find_singularities(
    robot: RobotLike,
    task: TaskLike,
    *,
    method: Method = "auto",
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
            and what is left is the numeric search's. `find_intersections` and `parameter_conditions` of the answer have
            that time once more.

    Raises:
        InputError: an unlimited prismatic joint without a box, or a bad option.
        TaskError: the task does not fit the robot, or no joint moves it.
        FormulaError: method="symbolic", and there are no formulas of the robot or the task.
    """
    robot, task = robot_and_task(robot, task)
    one_of("method", method, METHODS)
    count = counting_number("samples", samples, least=1)
    seed = counting_number("seed", seed)
    limit = TimeLimit(real_number("time_limit", time_limit, positive=True))
    task.check(robot)
    turns = turns_of(robot, task)
    where = joint_box(robot, box, unlimited=2.0, turns=turns)
    if robot.nv == 0:
        return _without_joints(robot, task, where, method)
    note = ""
    if method != "numeric":
        try:
            return _symbolic(robot, task, where, count, seed, limit)
        except FormulaError as error:
            if method == "symbolic":
                raise
            note = f"There are no formulas: {error}."
    return _numeric(robot, task, joint_box(robot, box, turns=turns), count, seed, limit, note)


def _without_joints(robot: Robot, task: Task, where: JointBox, method: str) -> SingularSet:
    """Return the answer for a robot that does not move: J has no columns, and rank 0 is its full rank."""
    note = "The robot has no joints, so that its Jacobian has no columns."
    how = "numeric" if method == "numeric" else "symbolic"
    return SingularSet(robot, task, where, 0, (), how, complete=True, note=note)


def _numeric(
    robot: Robot, task: Task, where: JointBox, count: int, seed: int, limit: TimeLimit, note: str
) -> SingularSet:
    rng = np.random.default_rng(seed)
    points = singular_points(robot, task, where, rng).require_motion()
    branches = numeric_branches(points, count, rng, limit)
    return SingularSet(robot, task, where, points.rank, branches, "numeric", False, note, time_limit=limit.seconds)


def _symbolic(robot: Robot, task: Task, where: JointBox, count: int, seed: int, limit: TimeLimit) -> SingularSet:
    from robotics1.singularities.symbolic import symbolic_branches

    rng = np.random.default_rng(seed)
    try:
        found = symbolic_branches(robot, task, where, rng, limit.part(EXACT), limit.part(DRAWN))
    except OutOfTime:
        by_numbers = _numeric(robot, task, where, count, seed, limit, "")
        return replace(by_numbers, note=_not_complete(limit, len(by_numbers.branches), 0))
    others: list[SingularBranch] = []
    notes = [_note(found)]
    if not found.complete:
        others = [
            branch
            for branch in numeric_branches(found.points, count, rng, limit)
            if not all(any(known.contains(q) for known in found.inside) for q in branch.samples)
        ]
        notes.insert(0, _not_complete(limit, len(others), len(found.inside), found.unproven))
    return SingularSet(
        robot,
        task,
        where,
        found.points.rank,
        (*found.inside, *others),
        "symbolic" if found.complete else "both" if found.inside else "numeric",
        found.complete,
        " ".join(filter(None, notes)),
        tuple(found.outside),
        limit.seconds,
        found.jacobian,
        tuple(found.without_solution),
    )


def _not_complete(limit: TimeLimit, others: int, exact: int, unproven: int = 0) -> str:
    """Say that the exact answer is not complete, and which branches were found by numbers; they stand last."""
    if not others:
        added = "a search by numbers found no other branch"
    elif not exact:
        added = "all branches were found by numbers"
    elif others == 1:
        added = "the last branch was found by numbers"
    else:
        added = f"the last {others} branches were found by numbers"
    if unproven:
        return f"The exact answer is not complete: some equations are not proven to have no solution; {added}."
    return f"The exact answer was not complete after {limit.seconds:g} s; {added}."


def _note(found: Found) -> str:
    """Say which angles were made exact, and where the task has no Jacobian."""
    from robotics1.symbolic.writing.printing import line_text

    sentences = []
    if found.cleaned > WORTH_TELLING:
        sentences.append(f"Angles of the file were made exact multiples of π/12, by at most {found.cleaned:.1e} rad.")
    if found.undefined:
        places = (" and ".join(map(line_text, piece.conditions)) for piece in found.undefined)
        sentences.append(f"Where {' or '.join(places)}, the task itself has no Jacobian.")
    return " ".join(sentences)
