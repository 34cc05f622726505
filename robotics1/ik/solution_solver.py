"""All inverse kinematics solutions of many targets: what does not depend on the target is prepared once."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.ik.boundary_distance import BOUNDARY
from robotics1.ik.compiled_solutions import CompiledSolutions
from robotics1.ik.goals import goal_of, goals_of, numbered
from robotics1.ik.joint_samples import LaterSolutions, moves_of_goals
from robotics1.ik.prepared import Prepared, prepare
from robotics1.ik.result import IKStatus
from robotics1.ik.solution_batch import IKSolutionsBatch
from robotics1.ik.solution_set import IKSolutions
from robotics1.ik.solver import list_of_targets
from robotics1.inputs import Array, by_name, counting_number, real_array
from robotics1.kernels.chain import Indices
from robotics1.kernels.every_solution import COUNT, EDGE, ERROR, INSIDE
from robotics1.other_words import names_what_is_meant
from robotics1.robot.given import RobotLike
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import PoseError


@names_what_is_meant
class SolutionSolver:
    """Finds the solutions of f(q) = r_d that `ik_solutions` finds, with what does not depend on r_d prepared once.

    Where all solutions follow from formulas, these are compiled: the first solver of its kind on a machine takes some
    seconds for that, and a target then takes microseconds. Targets at or near singularities, and those without a
    solution inside the limits, are looked at with more care, which takes milliseconds or more.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        box: joint name → (lower, upper), where to look; needed for prismatic joints without limits that move the task.
        locked: joint name → value [rad or m], of joints that stand still.
        starts: the number of random starts of a search, where no formula is known; None as `ik_solutions` has it.
        seed: of the random starts.

    Raises:
        InputError: a prismatic joint has neither limits nor a box, or an option has a wrong value.
        TaskError: the task does not fit the robot, or its axes move.
    """

    def __init__(
        self,
        robot: RobotLike,
        task: TaskLike,
        *,
        box: Mapping[str, tuple[float, float]] | None = None,
        locked: Mapping[str, float] | None = None,
        starts: int | None = None,
        seed: int = 0,
    ) -> None:
        robot, task = robot_and_task(robot, task)
        self.robot, self.task = robot, task
        self._box = by_name("box", box, "{'q1': (-1, 1)}")
        self._locked = by_name("locked", locked, "{'q1': 0.5}")
        self._starts = None if starts is None else counting_number("starts", starts, least=1)
        self._seed = counting_number("seed", seed)
        task.check_integrable(robot)
        self._prepare()

    def __repr__(self) -> str:
        return f"SolutionSolver({self.robot!r}, {self.task!r})"

    def _prepare(self) -> None:
        self._prepared: Prepared = prepare(self.robot, self.task, self._box, self._locked)
        self._compiled: CompiledSolutions | None = self._prepared.compiled
        self._pose_error: PoseError | None = None
        self._moved: tuple[tuple[int, bytes], tuple[Array, Array] | None] | None = None
        exact = self._prepared.exact
        if self._compiled is not None and exact is not None:
            self._pose_error = exact.pose_error
            self._compiled.compile()  # so that no target pays for the compilation

    def __getstate__(self) -> dict[str, Any]:
        """Return what is pickled and copied: what is prepared, machine code among it, is prepared again."""
        return {
            name: value
            for name, value in vars(self).items()
            if name not in ("_prepared", "_compiled", "_pose_error", "_moved")
        }

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._prepare()

    def __call__(self, target: Any) -> IKSolutions:
        """Return the solutions of one target.

        Args:
            target: r_d, in the form of the task's value.

        Raises:
            InputError: the target has the wrong form, or is not finite.
        """
        if self._compiled is not None and self._pose_error is not None:
            found = self._compiled.solve(goal_of(self.robot, self._pose_error, target))
            if found is not None:
                return found
        return self._carefully(target)

    def solve_batch(self, targets: Any) -> IKSolutionsBatch:
        """Return the solutions of many targets, on all cores.

        Args:
            targets: k targets, in the form of the task's value: a sequence, or an array with k for its first size.

        Raises:
            InputError: there is no target, or one has the wrong form, and the message says which.
        """
        listed = list_of_targets(targets)
        if self._compiled is None or self._pose_error is None:
            return self._one_by_one(len(listed), lambda i: self(listed[i]))
        given = targets if isinstance(targets, np.ndarray) else listed
        q, answers = self._compiled.solve_many(goals_of(self.robot, self._pose_error, given))
        careful: dict[int, IKSolutions] = {}
        for i in np.flatnonzero((answers[:, COUNT] < 0) | (answers[:, EDGE] < BOUNDARY)).tolist():
            found = self._compiled.answer(q[i], *answers[i].tolist())
            with numbered(i):
                careful[i] = self._carefully(listed[i]) if found is None else found
            answers[i, [INSIDE, COUNT]] = 0.0
        inside, counts = answers[:, INSIDE : COUNT + 1].astype(np.int64).T
        return self._batch(q, inside, counts, answers[:, ERROR].copy(), careful)

    def solve_at(self, target: Any, joint: str, values: npt.ArrayLike) -> IKSolutionsBatch:
        """Return the solutions of one target at many values of a locked joint, one entry of the batch for each value.

        So a redundant arm is sampled: a joint is locked, and asked at values all over its range. The first joint and
        the last are the fast ones: a value then moves the goal, and one kernel answers them all. Where a value has no
        solution inside the limits, its status is UNREACHABLE and its error ∞; reading its entry finds the nearest miss.

        Args:
            target: r_d, in the form of the task's value.
            joint: its name, one of `locked`.
            values: (k,) [rad or m].

        Raises:
            InputError: the target has the wrong form, the joint is not locked, or a value is outside its limits.
        """
        if joint not in self._locked:
            raise InputError(f"the joint {joint!r} is not locked; locked are {sorted(self._locked) or 'none'}")
        array = real_array("values", values, (None,), "one for each sample")
        number = self.robot.joint_names.index(joint)
        lower, upper = self.robot.lower[number], self.robot.upper[number]
        if not ((lower <= array) & (array <= upper)).all():
            raise InputError(f"values of {joint!r} must lie in its limits [{lower:g}, {upper:g}]")
        moves = self._moves_of_goals(number, array)
        find = partial(self._solve_locked, target, joint, array)
        if moves is None or self._compiled is None or self._pose_error is None:
            return self._one_by_one(len(array), find)
        before, behind = moves
        q, answers = self._compiled.solve_here(before @ goal_of(self.robot, self._pose_error, target) @ behind)
        q[:, :, number] = array[:, None]
        inside, counts = answers[:, INSIDE : COUNT + 1].astype(np.int64).T
        error = answers[:, ERROR].copy()
        doubt = np.isnan(error) | (answers[:, EDGE] < BOUNDARY)
        missed = np.flatnonzero((counts < 0) & ~doubt)
        found = {i: find(i) for i in np.flatnonzero(doubt).tolist()}
        inside[doubt] = counts[doubt] = counts[missed] = 0
        error[missed] = np.inf
        later = LaterSolutions(found, missed.tolist(), find)
        return self._batch(q, inside, counts, error, found, later)

    def _moves_of_goals(self, number: int, values: Array) -> tuple[Array, Array] | None:
        """Return what `moves_of_goals` does, of the last values without work; None if a pose is free in part."""
        key, exact = (number, values.tobytes()), self._prepared.exact
        if exact is None or len(exact.pose_error.rows) < 6:
            return None
        if self._moved is None or self._moved[0] != key:
            self._moved = key, moves_of_goals(self._prepared.problem, number, values)
        return self._moved[1]

    def _solve_locked(self, target: Any, joint: str, values: Array, i: int) -> IKSolutions:
        """Return the solutions of a target with a locked joint at value i."""
        locked = self._locked | {joint: float(values[i])}
        options: dict[str, Any] = {"box": self._box, "starts": self._starts, "seed": self._seed}
        return SolutionSolver(self.robot, self.task, locked=locked, **options)(target)

    def _carefully(self, target: Any) -> IKSolutions:
        return self._prepared.carefully(self.task.target(target), self._starts, self._seed)

    def _one_by_one(self, k: int, find: Callable[[int], IKSolutions]) -> IKSolutionsBatch:
        careful = {}
        for i in range(k):
            with numbered(i):
                careful[i] = find(i)
        nq = self.robot.nq
        none = np.zeros(k, dtype=np.int64)
        return self._batch(np.zeros((k, 0, nq)), none, none.copy(), np.zeros(k), careful)

    def _batch(
        self,
        q: Array,
        inside: Indices,
        counts: Indices,
        errors: Array,
        careful: dict[int, IKSolutions],
        later: LaterSolutions | None = None,
    ) -> IKSolutionsBatch:
        """Return what the kernel has left, and the answers of the careful way between it, some of which come later."""
        q = q[:, : counts.max(initial=0)]
        place, outside = np.arange(q.shape[1]), counts - inside
        first = place < inside[:, None]
        rows, rest = q[first], q[first != (place < counts[:, None])]
        status = np.full(len(inside), IKStatus.FINITE)
        if later is not None:
            status[later.missed] = IKStatus.UNREACHABLE
        complete = np.ones(len(inside), dtype=bool)
        if careful:
            rows = _between(rows, np.cumsum(inside), {i: found.q for i, found in careful.items()})
            rest = _between(rest, np.cumsum(outside), {i: found.outside_limits for i, found in careful.items()})
        for i, found in careful.items():
            inside[i], outside[i] = len(found), len(found.outside_limits)
            status[i], complete[i], errors[i] = found.status, found.complete, found.error_norm
        facts = {} if self._compiled is None else self._compiled.facts
        return IKSolutionsBatch(
            q=rows,
            counts=inside,
            status=status,
            complete=complete,
            error_norm=errors,
            outside_limits=rest,
            outside_counts=outside,
            method=str(facts.get("method", "search")),
            free_joints=facts["free_joints"] if facts else self._prepared.problem.free_joints,
            careful=careful if later is None else later,
            robot=self.robot,
            task=self.task,
        )


def _between(rows: Array, ends: Indices, others: dict[int, Array]) -> Array:
    """Return the rows of many targets, those of target i ending at ends[i], with the rows of others at their places."""
    parts, begin = [], 0
    for i in sorted(others):
        parts += [rows[begin : ends[i]], others[i]]
        begin = ends[i]
    return np.concatenate([*parts, rows[begin:]])
