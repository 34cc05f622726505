"""What all targets of a robot and a task share: the task in its box, the way to all solutions, the kernel for most."""

from collections.abc import Mapping
from dataclasses import replace
from time import perf_counter
from typing import Any

from robotics1.caching import cached_property
from robotics1.ik.added_joints import way_to_all_solutions
from robotics1.ik.compiled_solutions import CompiledSolutions, compiled_solutions
from robotics1.ik.exact import ExactSolver
from robotics1.ik.scaled_task import ScaledTask, scaled_task
from robotics1.ik.solution_set import IKSolutions
from robotics1.ik.solutions_by_search import searched
from robotics1.inputs import by_name, real_number
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task

PATIENCE = 10.0  # [s] spent without the kernel, after which its compilation, of about as long, is worth it


class Prepared:
    """A robot, a task and a box, ready for targets.

    Attributes:
        problem: the task without units, in its box.
        exact: the way to all solutions; None if none is known.
    """

    def __init__(self, problem: ScaledTask, exact: ExactSolver | None) -> None:
        self.problem, self.exact = problem, exact
        self._spent = 0.0

    @cached_property
    def compiled(self) -> CompiledSolutions | None:
        """The kernel for targets at which no two solutions meet; None if there is none for this arm."""
        return None if self.exact is None else compiled_solutions(self.exact)

    def solve(self, target: Any, starts: int | None, seed: int) -> IKSolutions:
        """Return the solutions of a target, in the form of the task's value.

        The kernel answers if it has been compiled before, or there was time to do so.
        """
        compiled = self.compiled
        if self.exact is not None and compiled is not None and (compiled.is_ready or self._spent > PATIENCE):
            if not compiled.is_ready:
                compiled.compile()
            found = compiled.solve(self.exact.pose_error.goal(self.problem.robot, target))
            if found is not None:
                return found
        begin = perf_counter()
        found = self.carefully(target, starts, seed)
        self._spent += perf_counter() - begin
        return found

    def carefully(self, target: Any, starts: int | None, seed: int) -> IKSolutions:
        """Return the solutions of a target without the kernel."""

        def search(few: int | None) -> IKSolutions:
            return searched(self.problem, target, few or starts, seed)

        return search(None) if self.exact is None else self.exact.solve(target, search)


def prepare(
    robot: Robot,
    task: Task,
    box: Mapping[str, tuple[float, float]] | None = None,
    locked: Mapping[str, float] | None = None,
) -> Prepared:
    """Return what does not depend on the target, of a box and of joints that stand still.

    Raises:
        UnknownNameError, InputError: the box is none, or a prismatic joint that moves the task has no limits.
        TaskError: the task does not fit the robot.
    """
    still = by_name("locked", locked, "{'q1': 0.5}")
    values = {name: real_number(f"the locked {name!r}", value) for name, value in still.items()}
    where = dict(by_name("box", box, "{'q1': (-1, 1)}")) | {name: (value, value) for name, value in values.items()}
    problem = scaled_task(robot, task, where or None)
    problem = replace(problem, moving=problem.moving & (problem.box.lower < problem.box.upper))  # not fixed
    form = way_to_all_solutions(problem)
    exact = None if form is None else ExactSolver(problem, form)
    return Prepared(problem, exact if exact is not None and exact.is_regular else None)
