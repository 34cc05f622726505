"""Every inverse kinematics solution of a target."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from itertools import product
from typing import Any

import numpy as np

from robotics1.errors import InputError
from robotics1.ik.descent import REACHED
from robotics1.ik.exact import ExactSolver
from robotics1.ik.proof import is_out_of_reach
from robotics1.ik.result import IKStatus
from robotics1.ik.scaled_task import ScaledTask, never_changes, scaled_task
from robotics1.ik.solution_search import SolutionSearch
from robotics1.ik.solution_set import IKSolutions
from robotics1.ik.structure import closed_form
from robotics1.inputs import Array, a_robot_and_a_task, by_name, counting_number, one_of, real_number
from robotics1.robot.model import Robot
from robotics1.singularities.points import singular_points
from robotics1.tasks.task import Task

MOST_WINDINGS = 100_000  # copies by whole turns that are listed


def ik_solutions(
    robot: Robot,
    task: Task,
    target: Any,
    *,
    method: str = "auto",
    windings: bool = False,
    box: Mapping[str, tuple[float, float]] | None = None,
    locked: Mapping[str, float] | None = None,
    starts: int = 100,
    seed: int = 0,
) -> IKSolutions:
    """Return the solutions of f(q) = r_d inside the joint limits.

    Where as many joints move the task as it has rows, and the joint axes allow, all solutions follow from polynomials:
    one to three joints that move a point, a planar pose or an orientation; six joints, three of which, one after the
    other, have axes through a point (a spherical wrist) or move in a plane (three parallel axes, as UR arms have). Each
    solution is polished by Newton's method on the robot itself, and verified. `complete` then says that there are no
    others (of six joints not where two solutions meet, since rounding may hide a third), `method` how they were found,
    and BOUNDARY that two of them meet.

    Otherwise a search runs damped least squares from random starts and keeps what differs. It can miss a solution, so
    that `complete` is False where it has found some. UNREACHABLE is proven; a search that finds nothing is NOT_FOUND.

    A row of a `FunctionTask` with the unit "rad" is taken modulo 2π. Without units a row that counts turns, as q1 + q3
    does, has its own value: joints are turned as far as their limits allow until it is the target's. A row that is
    an angle of the frame about a fixed axis, or jumps by 2π as atan2 does, is taken modulo 2π where that fails.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        target: r_d, in the form of the task's value.
        method: "auto", or "search" to search in any case.
        windings: whether to list also what differs by whole turns, inside limits that both end.
        box: joint name → (lower, upper), where to look; needed for prismatic joints without limits that move the task.
        locked: joint name → value [rad or m], of joints that stand still: a redundant arm then has finitely many
            solutions.
        starts: the number of random starts of a search.
        seed: of the random starts.

    Raises:
        InputError: the target has the wrong form, or a prismatic joint has neither limits nor a box.
        TaskError: the task does not fit the robot, or its axes move.

    Source: Pieper, The kinematics of manipulators under computer control, 1968; Siciliano, Sciavicco, Villani, Oriolo,
    Robotics, 2009, section 2.12.
    """
    a_robot_and_a_task(robot, task)
    one_of("method", method, ("auto", "search"))
    if not isinstance(windings, bool):
        raise InputError(f"windings must be True or False, not {windings!r}")
    seed, starts = counting_number("seed", seed), counting_number("starts", starts, least=1)
    task.check_integrable(robot)
    target = task.target(target)
    prepared = _prepared(robot, task, box, locked)
    searched = partial(_searched, prepared.problem, target, starts, seed)
    exact = prepared.exact if method == "auto" else None
    found = searched() if exact is None else exact.solve(target, searched)
    found = replace(found, robot=robot, task=task)
    return with_windings(found, prepared.problem) if windings else found


@dataclass(frozen=True, eq=False)
class Prepared:
    """What does not depend on the target: the task in its box, and the way to all solutions if one is known."""

    problem: ScaledTask
    exact: ExactSolver | None


def _prepared(robot: Robot, task: Task, box: Any, locked: Any) -> Prepared:
    """Return what does not depend on the target; of a task on a pose it is kept."""
    if box is None and not locked and never_changes(task):
        with suppress(TypeError):  # a task that cannot be hashed
            return _kept(robot, task)
    return _prepare(robot, task, box, locked)


def _prepare(robot: Robot, task: Task, box: Any = None, locked: Any = None) -> Prepared:
    still = by_name("locked", locked, "{'q1': 0.5}")
    values = {name: real_number(f"the locked {name!r}", value) for name, value in still.items()}
    where = dict(by_name("box", box, "{'q1': (-1, 1)}")) | {name: (value, value) for name, value in values.items()}
    problem = scaled_task(robot, task, where or None)
    if still:
        moving = problem.moving & ~np.isin(robot.joint_names, list(still))
        problem = replace(problem, moving=moving)
    form = closed_form(robot, task, problem.moving, problem.middle) if problem.moving.any() else None
    exact = None if form is None else ExactSolver(problem, form)
    return Prepared(problem, exact if exact is not None and exact.is_regular else None)


_kept = lru_cache(maxsize=64)(_prepare)


def _searched(problem: ScaledTask, target: Any, starts: int, seed: int) -> IKSolutions:
    """Return the solutions that descents from random starts lead to."""
    robot, task = problem.robot, problem.task
    rng = np.random.default_rng(seed)
    if not problem.moving.any():
        return _of_a_task_that_nothing_moves(problem, target, problem.box.random(rng, starts))
    search = SolutionSearch(problem, target, points=singular_points(robot, task, problem.box, rng))
    ends = [search.descend(q) for q in problem.random(rng, starts)]
    found = search.distinct(ends)
    closest = found[0] if found else search.nearest_miss(min(ends, key=lambda end: end[1])[0])
    if not found:  # what is nearest may be a solution after all
        found = search.distinct([(closest, 0.0)])
    dimension = _dimension(search, found)
    if found:
        status, closest = IKStatus.INFINITE if dimension else IKStatus.FINITE, found[0]
    else:
        status = IKStatus.UNREACHABLE if is_out_of_reach(problem, target) else IKStatus.NOT_FOUND
    return _answer(problem, target, found, status, closest, dimension, [search.singular(q) for q in found])


def with_windings(found: IKSolutions, problem: ScaledTask) -> IKSolutions:
    """Return the solutions with all that differ from them by whole turns inside limits that both end.

    Raises:
        InputError: there are more than `MOST_WINDINGS` of them.
    """
    lower, upper = problem.lower, problem.upper
    turning = problem.robot.revolute & problem.moving & np.isfinite(lower) & np.isfinite(upper)
    period = problem.turns.period
    least = np.where(turning, np.ceil((lower - found.q) / period - 1e-9), 0.0)
    most = np.where(turning, np.floor((upper - found.q) / period + 1e-9), 0.0)
    count = float(np.prod(most - least + 1, axis=1).sum())
    if count > MOST_WINDINGS:
        raise InputError(
            f"inside these limits the solutions have {count:.3g} copies by whole turns; at most {MOST_WINDINGS} are "
            f"listed: narrow the limits with box=, or leave windings out"
        )
    copies, sources = [], []
    for i, q in enumerate(found.q):
        ranges = zip(least[i].astype(int), most[i].astype(int), strict=True)
        for turns in product(*(range(a, b + 1) for a, b in ranges)):
            copies.append(q + np.where(turning, period, 0.0) * turns)
            sources.append(i)
    return replace(
        found,
        q=np.array(copies).reshape(len(copies), problem.robot.nq),
        singular=found.singular[sources],
        within_limits=found.within_limits[sources],
    )


def _dimension(search: "SolutionSearch", found: list[Array]) -> int:
    """Return the dimension of the largest family; where many were found, some of them are asked first."""
    some = found[:: max(1, len(found) // 8)]
    return max((search.dimension(q) for q in some), default=0) or max(
        (search.dimension(q) for q in found if len(found) > len(some)), default=0
    )


def _of_a_task_that_nothing_moves(problem: ScaledTask, target: Any, samples: Array) -> IKSolutions:
    """Return the answer where f(q) is a constant: every q in the box is a solution, or none is."""
    middle = problem.middle
    if problem.relative_error(middle, target) > REACHED:
        proven = is_out_of_reach(problem, target)
        return _answer(problem, target, [], IKStatus.UNREACHABLE if proven else IKStatus.NOT_FOUND, middle, 0, [])
    dimension = int(np.count_nonzero(problem.box.upper > problem.box.lower))
    found = list(samples) if dimension else [middle]
    status = IKStatus.INFINITE if dimension else IKStatus.FINITE
    return _answer(problem, target, found, status, found[0], dimension, [True] * len(found))


def _answer(
    problem: ScaledTask,
    target: Any,
    found: list[Array],
    status: IKStatus,
    closest: Array,
    dimension: int,
    singular: list[bool],
) -> IKSolutions:
    robot = problem.robot
    e = problem.task.error(robot, closest, target)
    e = np.where(problem.turns.angle, problem.turns.wrapped(e), e)  # whole turns of an angle are no error
    return IKSolutions(
        q=np.array(found).reshape(len(found), robot.nq),
        singular=np.array(singular, dtype=bool),
        status=status,
        complete=status is IKStatus.UNREACHABLE or not (dimension or problem.moving.any()),
        method="search",
        closest=closest,
        error_norm=float(np.hypot.reduce(e)),
        free_joints=problem.free_joints,
        dimension=dimension,
        within_limits=np.array([robot.within_limits(q) for q in found], dtype=bool),
        outside_limits=np.zeros((0, robot.nq)),
    )
