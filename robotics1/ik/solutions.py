"""Every inverse kinematics solution of a target."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.ik.descent import REACHED, End, TaskDescent
from robotics1.ik.proof import is_out_of_reach
from robotics1.ik.result import IKStatus
from robotics1.ik.scaled_task import ScaledTask, scaled_task
from robotics1.inputs import Array, a_robot_and_a_task, counting_number, one_of
from robotics1.results import Frozen, require
from robotics1.robot.model import Robot
from robotics1.singularities.points import ON_THE_SET, SingularPoints, singular_points
from robotics1.tasks.task import Task

SAME = 1e-6  # distance of two solutions that are one
NEARLY_SINGULAR = 1e-3  # σ_ρ, beside the usual σ₁, below which a solution may really be a singular one
ASIDE = 0.05  # step along the null space that looks for a neighbouring solution, in units
FLAT = 1e-6  # σ beside σ₁ of a direction that may be the tangent of a family


@dataclass(frozen=True, eq=False)
class IKSolutions(Frozen):
    """The solutions of f(q) = r_d inside the joint limits, each listed once: whole turns of a joint apart are one.

    Attributes:
        q: (k, nq) the solutions [rad or m].
        singular: (k,) True where J loses rank.
        status: how many there are: FINITE, INFINITE, UNREACHABLE or NOT_FOUND.
        complete: whether the method proves that there are no others.
        method: how they were found.
        closest: (nq,) the configuration with the least error, when there is no solution as well.
        error_norm: |r_d − f(closest)|, in the task's units [m, rad].
        free_joints: the joints that do not move the task, such as fingers beside the tool; in `q` they stand in the
            middle of their range, and their freedom does not count as infinitely many solutions.
        dimension: of the family, when there are infinitely many: 1 for a curve; 0 for finitely many.
        within_limits: (k,) True where a solution is inside the robot's limits, as all that are searched for are.
    """

    q: Array
    singular: npt.NDArray[np.bool_]
    status: IKStatus
    complete: bool
    method: str
    closest: Array
    error_norm: float
    free_joints: tuple[str, ...]
    dimension: int
    within_limits: npt.NDArray[np.bool_]

    def __len__(self) -> int:
        return len(self.q)

    def explain(self) -> str:
        """Return how many solutions there are, and the nearest miss if there is none, in sentences."""
        if not len(self):
            return f"{self.status.value}; the nearest miss is |e| = {self.error_norm:.3g}"
        family = f" of dimension {self.dimension}" if self.dimension else ""
        rest = "these are all" if self.complete else "there may be others"
        free = f"; free joints: {', '.join(self.free_joints)}" if self.free_joints else ""
        return f"{self.status.value}{family}: {len(self)} found by {self.method}, {rest}{free}"

    def require(self) -> "IKSolutions":
        """Return self if there is a solution.

        Raises:
            NotConverged: there is none.
        """
        return require(self, len(self) > 0)


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
        status, closest = IKStatus.INFINITE if dimension else IKStatus.FINITE, found[0]
    else:
        status = IKStatus.UNREACHABLE if is_out_of_reach(problem, target) else IKStatus.NOT_FOUND
    return _answer(problem, target, found, status, closest, dimension, [search.singular(q) for q in found])


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
    )


@dataclass(frozen=True, eq=False)
class SolutionSearch(TaskDescent):
    """The search for the q in a box with f(q) = target; `points` is the singular set of the task."""

    points: SingularPoints | None = None

    def distinct(self, ends: list[End]) -> list[Array]:
        """Return the solutions among the ends, each once, in ascending order."""
        found: list[Array] = []
        for q, _ in sorted(ends, key=lambda end: end[1]):
            p = self._at_the_singularity(q) if self.relative_error(q) <= REACHED else None
            p = None if p is None else self._wound(p)
            if p is not None and all(self._apart(p, other) > SAME for other in found):
                found.append(p)
        return sorted(found, key=lambda q: [round(float(value), 6) for value in q])

    def singular(self, q: Array) -> bool:
        """Whether J loses rank at q."""
        return self.points is not None and self.points.relative_sigma(q) <= ON_THE_SET

    def dimension(self, q: Array) -> int:
        """Return in how many independent directions a step along the null space of J leads to other solutions."""
        moving, units = self.problem.moving, self.problem.box.unit
        J = self.jacobian(q)[:, moving]
        _, sigma, Vt = np.linalg.svd(J)
        flat = np.ones(len(Vt), dtype=bool)
        flat[: len(sigma)] = sigma < FLAT * sigma[0]
        moves = []
        for tangent in Vt[flat]:
            direction = np.zeros(len(q))
            direction[moving] = tangent
            for side in (ASIDE, -ASIDE):
                p, _ = self.descend(self.problem.box.nearest(q + side * units * direction))
                move = self.problem.box.difference(p, q)
                if self.relative_error(p) <= REACHED and 0.2 * ASIDE < np.linalg.norm(move) < 2 * ASIDE:
                    moves.append(move)
                    break
        lengths = np.linalg.svd(np.array(moves), compute_uv=False) if moves else np.zeros(0)
        return int(np.count_nonzero(lengths > 0.1 * ASIDE))

    def _apart(self, p: Array, q: Array) -> float:
        return float(np.abs(self.problem.box.difference(p, q)).max(initial=0.0))

    def _wound(self, q: Array) -> Array | None:
        """Return q with joints turned until f(q) itself is the target; of angles whole turns may be left.

        None if a row that counts turns cannot count as many within the limits.
        """
        problem = self.problem
        e = self.task_error(q)
        wound = problem.turns.wound(q, e, problem.lower, problem.upper)
        if wound is not None:
            return wound
        counting = np.abs(e - problem.turns.wrapped(e)) > 0
        return q if problem.turns.angle[counting].all() else None

    def _at_the_singularity(self, q: Array) -> Array:
        """Return the singular solution next to q, if there is one; else q.

        At a double solution, such as a stretched arm, |e| grows only with the square of the distance, so that a
        descent stops 1e-5 away. There Newton's method on e = 0 together with the loss of rank is exact.
        """
        if self.points is None or self.points.relative_sigma(q) > NEARLY_SINGULAR:
            return q
        box, p = self.problem.box, q
        for _ in range(6):
            A, b = self.points.linearised(p)
            block, J = A * box.unit / self.points.box.unit, self.jacobian(p)
            step = np.linalg.lstsq(np.vstack([J, block]), np.concatenate([self.error(p), -b]), rcond=1e-7)[0]
            p = box.nearest(p + box.unit * step)
        near = self._apart(p, q) < NEARLY_SINGULAR
        reached = self.relative_error(p) <= REACHED and self.points.relative_sigma(p) <= ON_THE_SET
        return p if near and reached else q
