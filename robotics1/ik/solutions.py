"""Every inverse kinematics solution of a target."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import NotConverged
from robotics1.ik.descent import REACHED
from robotics1.ik.proof import is_out_of_reach
from robotics1.ik.scaled_task import ScaledTask, scaled_task
from robotics1.ik.search import SolutionSearch
from robotics1.inputs import Array, a_robot_and_a_task, counting_number, one_of
from robotics1.robot.model import Robot
from robotics1.singularities.points import singular_points
from robotics1.tasks.task import Task


class IKVerdict(Enum):
    """How many solutions there are."""

    FINITE = "finitely many solutions"
    INFINITE = "infinitely many solutions, of which some are listed"
    UNREACHABLE = "it is proven that no q inside the limits reaches the target"
    NOT_FOUND = "no solution was found; that proves nothing, but the target is likely out of reach"


@dataclass(frozen=True, eq=False)
class IKSolutions:
    """The solutions of f(q) = r_d inside the joint limits, each told once: whole turns of a joint apart are one.

    Attributes:
        q: (k, nq) the solutions [rad or m].
        singular: (k,) True where J loses rank.
        verdict: how many there are.
        complete: whether the method proves that there are no others.
        method: how they were found.
        closest: (nq,) the configuration with the least error, when there is no solution as well.
        least_error: |r_d − f(closest)|, in the task's units [m, rad].
        free_joints: the joints that do not move the task, such as fingers beside the tool; in `q` they stand in the
            middle of their range, and their freedom does not count as infinitely many solutions.
        dimension: of the family, when there are infinitely many: 1 for a curve; 0 for finitely many.
        within_limits: (k,) True where a solution is inside the robot's limits, as all that are searched for are.
    """

    q: Array
    singular: npt.NDArray[np.bool_]
    verdict: IKVerdict
    complete: bool
    method: str
    closest: Array
    least_error: float
    free_joints: tuple[str, ...]
    dimension: int
    within_limits: npt.NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.q)

    def require(self) -> "IKSolutions":
        """Return self if there is a solution.

        Raises:
            NotConverged: there is none.
        """
        if not len(self):
            raise NotConverged(f"{self.verdict.value}; the nearest miss is |e| = {self.least_error:.3g}", self)
        return self


def ik_solutions(
    robot: Robot,
    task: Task,
    target: Any,
    *,
    method: str = "search",
    box: Mapping[str, tuple[float, float]] | None = None,
    starts: int = 100,
    seed: int = 0,
) -> IKSolutions:
    """Return the solutions of f(q) = r_d inside the joint limits.

    The search runs damped least squares from random starts and keeps what differs. It can miss a solution, so that
    `complete` is False where it has found some. UNREACHABLE is proven; a search that finds nothing is NOT_FOUND.

    A row of a `FunctionTask` with the unit "rad" is taken modulo 2π. Without units a row that counts turns, as q1 + q3
    does, has its own value: joints are turned as far as their limits allow until it is the target's. A row that is
    an angle of the frame about a fixed axis, or jumps by 2π as atan2 does, is taken modulo 2π where that fails.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        target: r_d, in the form of the task's value.
        method: "search".
        box: joint name → (lower, upper), where to look; needed for prismatic joints without limits that move the task.
        starts: the number of random starts.
        seed: of the random starts.

    Raises:
        InputError: the target has the wrong form, or a prismatic joint has neither limits nor a box.
        TaskError: the task does not fit the robot, or its axes move.
    """
    a_robot_and_a_task(robot, task)
    one_of("method", method, ("search",))
    seed, starts = counting_number("seed", seed), counting_number("starts", starts, least=1)
    task.check_integrable(robot)
    target = task.target(target)
    problem = scaled_task(robot, task, box)
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
        verdict, closest = IKVerdict.INFINITE if dimension else IKVerdict.FINITE, found[0]
    else:
        verdict = IKVerdict.UNREACHABLE if is_out_of_reach(problem, target) else IKVerdict.NOT_FOUND
    return _answer(problem, target, found, verdict, closest, dimension, [search.singular(q) for q in found])


def _dimension(search: SolutionSearch, found: list[Array]) -> int:
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
        return _answer(problem, target, [], IKVerdict.UNREACHABLE if proven else IKVerdict.NOT_FOUND, middle, 0, [])
    dimension = int(np.count_nonzero(problem.box.upper > problem.box.lower))
    found = list(samples) if dimension else [middle]
    verdict = IKVerdict.INFINITE if dimension else IKVerdict.FINITE
    return _answer(problem, target, found, verdict, found[0], dimension, [True] * len(found))


def _answer(
    problem: ScaledTask,
    target: Any,
    found: list[Array],
    verdict: IKVerdict,
    closest: Array,
    dimension: int,
    singular: list[bool],
) -> IKSolutions:
    robot = problem.robot
    return IKSolutions(
        q=np.array(found).reshape(len(found), robot.nq),
        singular=np.array(singular, dtype=bool),
        verdict=verdict,
        complete=verdict is IKVerdict.UNREACHABLE or not (dimension or problem.moving.any()),
        method="search",
        closest=closest,
        least_error=float(np.hypot.reduce(_least(problem, closest, target))),
        free_joints=problem.free_joints,
        dimension=dimension,
        within_limits=np.array([robot.within_limits(q) for q in found], dtype=bool),
    )


def _least(problem: ScaledTask, q: Array, target: Any) -> Array:
    """Return the error at q in the task's units; of a row that is an angle without whole turns."""
    e = problem.task.error(problem.robot, q, target)
    return np.where(problem.turns.angle, problem.turns.wrapped(e), e)
