"""All solutions by compiled formulas: what the kernels of `kernels/every_solution.py` are given, and answer."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from robotics1.ik.boundary_distance import BOUNDARY, shortness
from robotics1.ik.exact import AS_FORMULA, REGULAR, ExactSolver
from robotics1.ik.general_six import Roots
from robotics1.ik.result import IKStatus
from robotics1.ik.solution_set import IKSolutions
from robotics1.inputs import Array
from robotics1.kernels.candidates import PLANE, ROWS, TURNS
from robotics1.kernels.chain import Indices
from robotics1.kernels.compilation import is_ready, on_all_cores
from robotics1.kernels.elsewhere import compile_elsewhere
from robotics1.kernels.every_solution import (
    COUNT,
    ERROR,
    INSIDE,
    SETTLED,
    settled,
    solutions_of_a_plane,
    solutions_of_a_wrist,
    solutions_of_candidates,
    solutions_of_few,
)
from robotics1.kernels.real_roots import MANY, UNKNOWN

SINGULAR = 1e-5  # a bound of σ_min/σ_max below which the distance of the singularity is estimated
BACKWARDS = np.array([2, 1, 0, 5, 4, 3])  # the joints of a loop from its other end
BETWEEN = np.array([1, 0, 5, 4, 3, 2])  # and the placements between them


class CompiledSolutions:
    """All solutions of a robot and a task with a closed form, of targets at which no two of them meet."""

    def __init__(self, exact: ExactSolver) -> None:
        problem, chain = exact.problem, exact.form.chain
        own, self.is_short = list(chain.coordinate), exact.is_short
        self.blank = np.tile(problem.middle, (MANY, 1))
        self.facts: dict[str, Any] = {
            "status": IKStatus.FINITE,
            "complete": True,
            "method": exact.form.method,
            "free_joints": problem.free_joints,
            "dimension": 0,
            "boundary_distance": np.inf,
            "families": (),
            "tangents": NO_TANGENTS,
            "hits": NO_HITS,
            "robot": problem.robot,
            "task": problem.task,
        }
        joints = np.column_stack(
            [problem.lower[own], problem.upper[own], problem.middle[own], problem.box.unit[own], own, chain.prismatic]
        )
        rows = np.array(sorted(exact.pose_error.rows), dtype=np.int64)
        self.kernel = partial(self._kernel(exact), *_arrays(exact, joints, rows))

    def _kernel(self, exact: ExactSolver) -> Callable[..., None]:
        if exact.form.loop is None:
            return solutions_of_few
        return solutions_of_a_wrist if exact.form.loop[0].normal is None else solutions_of_a_plane

    @property
    def is_ready(self) -> bool:
        """Whether the kernel runs without being compiled first."""
        return is_ready(self.kernel.func)

    def compile(self) -> None:
        """Compile the kernel, on two cores, unless it is ready."""
        if not self.is_ready:
            compile_elsewhere(settled, SETTLED)
        self.solve(np.eye(4))

    def solve(self, goal: Array) -> IKSolutions | None:
        """Return all solutions of a goal (4, 4) in the task's axes; None where it is left to the careful way."""
        q, answer = self.blank.copy(), np.empty((1, 4))
        self.kernel(goal[None], q[None], answer)
        return self.answer(q, *answer[0].tolist())

    def at_the_boundary(self, found: IKSolutions, edge: float) -> IKSolutions:
        """Return solutions of a target so far from one where two of them meet."""
        return replace(found, status=IKStatus.BOUNDARY, complete=self.is_short, boundary_distance=edge)

    def solve_many(self, goals: Array) -> tuple[Array, Array]:
        """Return what the kernel leaves of goals (k, 4, 4): q (k, MANY, nq), and `answers` (k, 4)."""
        k = len(goals)
        q, answers = np.empty((k, *self.blank.shape)), np.empty((k, 4))
        q[:] = self.blank

        def solve_some(some: slice) -> None:
            self.kernel(goals[some], q[some], answers[some])

        on_all_cores(solve_some, k)
        return q, answers

    def solve_here(self, goals: Array) -> tuple[Array, Array]:
        """Return what `solve_many` does, by this thread alone."""
        q, answers = np.empty((len(goals), *self.blank.shape)), np.empty((len(goals), 4))
        q[:] = self.blank
        self.kernel(goals, q, answers)
        return q, answers

    def answer(self, q: Array, inside: float, count: float, error: float, edge: float) -> IKSolutions | None:
        """Return the solutions that a kernel has left in the rows of q; None where it has left the target.

        The fields are written at once, since a frozen dataclass takes longer to make than a target to solve.
        """
        if count < 0:
            return None
        found = object.__new__(IKSolutions)
        own, k = found.__dict__, int(inside)
        own.update(self.facts)
        own["q"] = solutions = q[:k].copy()
        own["outside_limits"] = outside = q[k : int(count)].copy()
        solutions.setflags(False)  # type: ignore[call-arg]  # write=False, by name, takes twice as long
        outside.setflags(False)  # type: ignore[call-arg]
        own["singular"], own["within_limits"] = NONE[:k], ALL[:k]
        own["closest"], own["error_norm"] = solutions[0], error
        return found if edge >= BOUNDARY else self.at_the_boundary(found, edge)


class EliminatedSolutions(CompiledSolutions):
    """All solutions of six joints without special geometry: roots of a pencil by LAPACK, and the rest in a kernel."""

    def __init__(self, exact: ExactSolver, roots: Callable[[Array], Roots | None]) -> None:
        super().__init__(exact)
        self.roots = roots

    def _kernel(self, exact: ExactSolver) -> Callable[..., None]:
        return solutions_of_candidates

    def solve(self, goal: Array) -> IKSolutions | None:
        """Return all solutions of a goal (4, 4); None where it is left to the careful way."""
        q, answer = self.blank.copy(), np.empty(4)
        self._solve(goal, q, answer)
        return self.answer(q, *answer.tolist())

    def solve_many(self, goals: Array) -> tuple[Array, Array]:
        """Return what `CompiledSolutions.solve_many` does."""
        return self.solve_here(goals)

    def solve_here(self, goals: Array) -> tuple[Array, Array]:
        """Return what `CompiledSolutions.solve_here` does."""
        q, answers = np.empty((len(goals), *self.blank.shape)), np.empty((len(goals), 4))
        q[:] = self.blank
        for goal, rows, answer in zip(goals, q, answers, strict=True):
            self._solve(goal, rows, answer)
        return q, answers

    def _solve(self, goal: Array, q: Array, answer: Array) -> None:
        roots = self.roots(goal) if np.isfinite(goal).all() else None
        answer[INSIDE], answer[COUNT], answer[ERROR] = 0.0, UNKNOWN, np.nan
        if roots is not None and roots.proven:
            self.kernel(goal, np.ascontiguousarray(roots.x), q, answer)
            if answer[COUNT] < np.count_nonzero(roots.real):  # a root that is no solution
                answer[COUNT], answer[ERROR] = UNKNOWN, np.nan


def compiled_solutions(exact: ExactSolver) -> CompiledSolutions | None:
    """Return the way to all solutions with the kernel that fits; None if there is none.

    There is none for fewer joints than rows, nor for three joints that slide beside three that turn.
    """
    roots, n = exact.form.roots, len(exact.form.chain.coordinate)
    if n < len(exact.pose_error.rows) or (n == 6 and roots is None and exact.form.loop is None):
        return None
    return CompiledSolutions(exact) if roots is None else EliminatedSolutions(exact, roots)


ALL, NONE, NO_HITS = np.ones(MANY, dtype=bool), np.zeros(MANY, dtype=bool), np.zeros(0, dtype=np.int64)
NO_TANGENTS = np.zeros((0, 0))
for constant in (ALL, NONE, NO_HITS, NO_TANGENTS):
    constant.setflags(write=False)


def _arrays(exact: ExactSolver, joints: Array, rows: Indices) -> tuple[Any, ...]:
    """Return the first arguments of the kernel."""
    form, chain = exact.form, exact.form.chain
    own = np.column_stack([chain.prismatic, np.arange(len(rows)), np.ones(len(rows))])
    placements = np.array([P[:3] for P in chain.P]).reshape(-1, 12)
    links = np.column_stack([placements, np.vstack([own, np.zeros(3)])])
    least = SINGULAR * shortness(exact.problem) if form.deviation < AS_FORMULA else REGULAR
    if form.roots is not None:
        return links, joints, rows, np.array([0, 0, 0, 0, 0, chain.length, least])
    if form.loop is None:
        turns, moves = np.count_nonzero(rows >= 3), np.count_nonzero(rows < 3)
        kind = ROWS if not turns else PLANE if moves else TURNS
        normal = np.eye(3)[rows[-1] - 3] if kind == PLANE else np.zeros(3)
        return links, joints, rows, kind, np.array([0, 0, *normal, chain.length, least])
    loop, begin = form.loop
    order = (begin + np.arange(6)) % 6
    link_of, joint_of = (order[BETWEEN], order[BACKWARDS]) if loop.backwards else (order, order)
    normal = np.zeros(3) if loop.normal is None else loop.normal
    if loop.backwards:
        A = chain.P[1 + begin : 3 + begin]
        normal = A[1][:3, :3].T @ A[0][:3, :3].T @ normal
    numbers = np.array([*loop.ends, *normal, chain.length, least])
    return links, joints, rows, link_of, joint_of, -1.0 if loop.backwards else 1.0, numbers
