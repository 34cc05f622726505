"""What a robot can do at a pose: whether it is reached, by how many configurations, and how good the best are."""

import pickle
from dataclasses import dataclass
from enum import IntEnum
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.caching import cached_property
from robotics1.ik.compiled_solutions import CompiledSolutions
from robotics1.ik.pose_problem import PoseProblem, pose_problem
from robotics1.ik.prepared import prepare
from robotics1.ik.proof import UnreachableProof
from robotics1.inputs import Array, counting_number, real_number
from robotics1.kernels.chain import Indices
from robotics1.kernels.every_solution import COUNT, ERROR, INSIDE
from robotics1.kernels.inverse import solve_all
from robotics1.robot.model import Robot
from robotics1.singularities.measurement import Measurement, measurement_of
from robotics1.singularities.points import singular_points
from robotics1.tasks.task import Task

NOT_COUNTED = 255  # instead of a number of solutions
BESIDE = 1e-7  # [reaches, rad] between a target without a solution and those beside it that are looked at too
WAYS = np.array(
    [[0.6, -0.48, 0.64], [0.8, 0.36, -0.48], [0.0, 0.8, 0.6]]
)  # orthonormal, the first in no special direction
BARELY, FOLDED = 1e-6, 5e-2  # in units, beyond a limit: by rounding, and near a fold that is so far BESIDE
BLOCK = 1024  # poses whose solutions are found at once: they stay in the cache
GROUP = 128  # starts; the one nearest to the pose is taken

Codes = npt.NDArray[np.uint8]


class PoseStatus(IntEnum):
    """What is known of a pose; of two maps joined, the larger of both."""

    UNREACHABLE = 0  # it is proven that no q inside the limits reaches it
    NOT_FOUND = 1  # no start led to it; that proves nothing
    REACHED = 2  # a q inside the limits is known, which forward kinematics verifies


class PoseAnswers(NamedTuple):
    """Of n poses.

    Attributes:
        status: (n,) of `PoseStatus`.
        solutions: (n,) how many configurations reach it; NOT_COUNTED where that is not known.
        manipulability: (n,) the largest of √det(J Jᵀ) of the configurations found; −1 if it is not reached.
        limit_margin: (n,) the largest distance from the joint limits of those found; −1 if it is not reached.
        q: (n, nq) the configuration with the largest manipulability; NaN if it is not reached.
    """

    status: Codes
    solutions: Codes
    manipulability: Array
    limit_margin: Array
    q: Array

    def part(self, some: slice) -> "PoseAnswers":
        """Return the same arrays of some of the poses."""
        arrays: Any = [values[some] for values in self]
        return PoseAnswers(*arrays)


@dataclass(frozen=True, eq=False)
class PoseQuestion:
    """What is asked of each pose; it can be sent.

    Attributes:
        robot, task: whose poses.
        starts: how many starts are followed towards a pose, where no formula gives all solutions.
        seed: of the starts.
        tolerance: on |e| of such a descent [m, rad].
        configurations: how many are sought then of a pose that is reached; the best of them counts.
    """

    robot: Robot
    task: Task
    starts: int
    seed: int
    tolerance: float
    configurations: int

    def packed(self) -> bytes:
        """Return the question as bytes, by which a worker knows that it is prepared for it."""
        return pickle.dumps(self)


def question_of(robot: Robot, task: Task, starts: Any, seed: Any, tolerance: Any, configurations: Any) -> PoseQuestion:
    """Return the question with its options checked.

    Raises:
        InputError: one has a wrong value.
        TaskError: the task does not fit the robot.
    """
    task.check_integrable(robot)
    return PoseQuestion(
        robot,
        task,
        counting_number("starts", starts, least=1, most=1000),
        counting_number("seed", seed),
        real_number("tolerance", tolerance, positive=True),
        counting_number("configurations", configurations, least=1, most=1000),
    )


def _any_between(beyond: Array, most: float) -> npt.NDArray[np.bool_]:
    """Return where one of (n, MANY) numbers is positive, and less than the most."""
    return np.asarray(((beyond > 0) & (beyond < most)).any(axis=1))


@lru_cache(maxsize=4)
def evaluator_of(packed: bytes) -> "PoseEvaluator":
    """Return the evaluator of a question, prepared once in each process."""
    question: PoseQuestion = pickle.loads(packed)
    return PoseEvaluator(question)


class PoseEvaluator:
    """Answers a question about poses, in one thread.

    All solutions come from compiled formulas, where there are such. Other poses, and those at which a formula is in
    doubt, are reached by descents from a fixed number of starts, so that the answer does not depend on the clock.
    """

    def __init__(self, question: PoseQuestion) -> None:
        robot, task = question.robot, question.task
        self.question = question
        self.problem: PoseProblem = pose_problem(robot, task)
        points = singular_points(robot, task, self.problem.box, np.random.default_rng(0))
        self.measurement: Measurement = measurement_of(robot, task, points.require_motion().rank, 1.0)
        self.compiled: CompiledSolutions | None = prepare(robot, task).compiled
        self.proof = UnreachableProof(self.problem)

    @property
    def counts(self) -> bool:
        """Whether the solutions of a pose are counted."""
        return self.compiled is not None

    @cached_property
    def starts(self) -> Array:
        """The table of starts; the first groups are those of fewer starts."""
        groups = max(self.question.starts, self.question.configurations)
        return self.problem.table(np.random.default_rng((self.question.seed, 0)), GROUP * groups)

    def answers(self, goals: Array) -> PoseAnswers:
        """Return what is known of goals (n, 4, 4), in the axes of the task."""
        n, nq = len(goals), self.question.robot.nq
        answer = PoseAnswers(
            np.full(n, PoseStatus.NOT_FOUND, dtype=np.uint8),
            np.full(n, NOT_COUNTED, dtype=np.uint8),
            np.full(n, -1.0),
            np.full(n, -1.0),
            np.full((n, nq), np.nan),
        )
        for start in range(0, n, BLOCK):
            some = slice(start, start + BLOCK)
            self._by_formula(goals[some], answer.part(some))
        doubtful = np.flatnonzero(answer.status == PoseStatus.NOT_FOUND)
        if doubtful.size:
            self._by_descents(goals, doubtful, answer)
        answer.solutions[answer.status == PoseStatus.UNREACHABLE] = 0
        return answer

    def _by_formula(self, goals: Array, answer: PoseAnswers) -> None:
        """Write what the compiled formulas settle; what they leave in doubt stays NOT_FOUND."""
        if self.compiled is None:
            return
        q, inside, none = self._solutions(self.compiled, goals)
        reached = np.flatnonzero(inside)
        answer.status[reached], answer.solutions[reached] = PoseStatus.REACHED, inside[reached]
        if reached.size:
            rows = q[reached][np.arange(q.shape[1]) < inside[reached, None]]
            self._judge(rows, reached, np.append(0, np.cumsum(inside[reached])), answer)
        tolerance = self.question.tolerance
        missed = np.flatnonzero(none)
        answer.status[missed] = PoseStatus.UNREACHABLE
        some = missed[~self.proof.all_at_once(goals[missed], tolerance, tolerance)]
        if some.size:
            beyond = self._beyond(q[some])
            answer.status[some[_any_between(beyond, BARELY)]] = PoseStatus.NOT_FOUND
            self._look_beside(self.compiled, goals, some, (beyond > 0).sum(axis=1), answer)

    def _solutions(self, compiled: CompiledSolutions, goals: Array) -> tuple[Array, Indices, npt.NDArray[np.bool_]]:
        """Return q (n, MANY, nq), how many of each are solutions inside the limits, and where there are none at all."""
        q, found = compiled.solve_here(goals)
        inside = np.where(found[:, COUNT] > 0, found[:, INSIDE], 0).astype(np.int64)
        return q, inside, (found[:, COUNT] < 0) & ~np.isnan(found[:, ERROR])

    def _beyond(self, q: Array) -> Array:
        """Return how far configurations (n, MANY, nq) are outside the limits, (n, MANY), in units; negative inside."""
        own = self.problem.active
        lower, upper, _, unit = self.problem.coordinates[own].T
        return np.asarray((np.maximum(lower - q[:, :, own], q[:, :, own] - upper) / unit).max(axis=2))

    def _look_beside(
        self, compiled: CompiledSolutions, goals: Array, some: Indices, outside: Indices, answer: PoseAnswers
    ) -> None:
        """Look at targets beside those without a solution, to both sides: rounding may hide a double one, at a fold.

        What is reached there to within the tolerance is reached; what is in doubt there is in doubt here, as where
        there are more solutions outside the limits than here, and some of them are near the limits.
        """
        near = BESIDE * np.hypot(self.question.robot.reach, 1.0) <= self.question.tolerance
        ways = WAYS if len(self.problem.active) <= len(WAYS) else WAYS[:1]  # few joints: more ranks may be lost at once
        for way in (*ways, *-ways):
            moved = goals[some].copy()
            moved[:, :3, :3] = pin.exp3(BESIDE * way[[2, 0, 1]]) @ moved[:, :3, :3]
            moved[:, :3, 3] += BESIDE * self.question.robot.reach * way
            q, inside, none = self._solutions(compiled, moved)
            beyond = self._beyond(q)
            none &= ~(_any_between(beyond, FOLDED) & ((beyond > 0).sum(axis=1) > outside))
            met = np.flatnonzero(inside) if near else np.zeros(0, dtype=np.intp)
            answer.status[some[~none]] = PoseStatus.NOT_FOUND
            if met.size:
                answer.status[some[met]] = PoseStatus.REACHED
                self._judge(q[met, 0], some[met], np.arange(len(met) + 1), answer)
            some, outside = some[none], outside[none]
            if not some.size:
                return

    def _by_descents(self, goals: Array, some: npt.NDArray[np.intp], answer: PoseAnswers) -> None:
        """Write what descents reach, and what is seen to be out of reach without them."""
        tolerance = self.question.tolerance
        never = self.proof.all_at_once(goals[some], tolerance, tolerance)
        answer.status[some[never]] = PoseStatus.UNREACHABLE
        some = some[~never]
        if not some.size:
            return
        q, arrived = self._descended(goals[some], self.starts[: GROUP * self.question.starts])
        reached, q = some[arrived], q[arrived]
        answer.status[reached] = PoseStatus.REACHED
        for start in range(0, len(reached), BLOCK):
            part = slice(start, start + BLOCK)
            rows, ends = self._with_others(goals[reached[part]], q[part])
            self._judge(rows, reached[part], ends, answer)

    def _descended(self, goals: Array, starts: Array) -> tuple[Array, npt.NDArray[np.bool_]]:
        """Return where descents to goals (n, 4, 4) end, (n, nq), and which of them arrive."""
        n, tolerance = len(goals), self.question.tolerance
        q, tried, errors = np.empty((n, self.question.robot.nq)), np.empty(n, dtype=np.int64), np.empty(n)
        wanted, middle = np.ascontiguousarray(goals), np.tile(self.problem.middle, (n, 1))
        constants = self.problem.arrays(tolerance)
        solve_all(*constants, starts, GROUP, wanted, middle, False, q, tried, errors)
        return q, errors <= tolerance

    def _with_others(self, goals: Array, q: Array) -> tuple[Array, Indices]:
        """Return configurations of goals (n, 4, 4) whose first is q (n, nq), in one array, and where those of each end.

        Of a redundant arm they are samples of its self-motion: each is the end of a descent from one more start.
        """
        found, there = [q], [np.ones(len(q), dtype=bool)]
        for i in range(1, self.question.configurations):
            other, arrived = self._descended(goals, self.starts[GROUP * i : GROUP * (i + 1)])
            found.append(other)
            there.append(arrived)
        kept = np.stack(there, axis=1)
        return np.stack(found, axis=1)[kept], np.append(0, np.cumsum(kept.sum(axis=1)))

    def _judge(
        self, rows: Array, reached: npt.NDArray[np.intp], ends: npt.NDArray[np.int64], answer: PoseAnswers
    ) -> None:
        """Write the measures of configurations, (N, nq): those of pose i are rows ends[i], ..., ends[i+1] − 1."""
        measure = "manipulability"
        values = np.nan_to_num(self.measurement.measures(np.ascontiguousarray(rows.T), (measure,))[measure])
        best = np.maximum.reduceat(values, ends[:-1])
        answer.manipulability[reached] = best
        answer.limit_margin[reached] = np.maximum.reduceat(self.limit_margins(rows), ends[:-1])
        of_pose = np.repeat(np.arange(len(reached)), np.diff(ends))
        at_best = np.flatnonzero(values >= best[of_pose])
        first = at_best[np.unique(of_pose[at_best], return_index=True)[1]]
        answer.q[reached[of_pose[first]]] = rows[first]

    def limit_margins(self, q: Array) -> Array:
        """Return how far configurations (N, nq) are from the joint limits, (N,).

        The least over the joints that move the task of 2 min(q − lower, upper − q)/(upper − lower): 1 in the middle of
        all ranges, 0 where one joint is at a limit. A joint without limits counts 1.
        """
        own = self.problem.active
        lower, upper, x = self.question.robot.lower[own], self.question.robot.upper[own], q[:, own]
        with np.errstate(invalid="ignore", divide="ignore"):
            margins = 2 * np.minimum(x - lower, upper - x) / (upper - lower)
        return np.asarray(np.where(np.isfinite(margins), margins, 1.0).min(axis=1))
