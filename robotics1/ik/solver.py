"""Inverse kinematics that keeps to the joint limits, and reports a success only when forward kinematics verifies it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import perf_counter
from typing import Any, Literal

import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.ik.kernel_search import KernelSearch, PoseSolver
from robotics1.ik.python_search import PythonSearch
from robotics1.ik.result import IKBatch, IKResult
from robotics1.ik.search import Search
from robotics1.inputs import counting_number, one_of, real_number
from robotics1.other_words import names_what_is_meant
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.tasks.given import TaskLike, robot_and_task

Preference = Literal["any", "near", "middle"]
PREFERENCES = ("any", "near", "middle")


@names_what_is_meant
class IKSolver:
    """Solves f(q) = r_d for one robot and one task: what does not depend on the target is prepared once.

    Damped least squares, q ← q + Jᵀ(JJᵀ + λ²1)⁻¹e, with a damping that fades with the error and an active set of
    joint limits; from q0, then from random starts near the target, until one arrives or the time is over.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        seed: of the random starts.
        time_limit: for one target [s]. Solutions come in microseconds; only a target that is hard, or cannot be
            reached, uses it up.
        tolerance: on |e| = |r_d − f(q)| in the task's units [m, rad]. Where a task has an orientation as angles, e
            holds the rotation vector log3(R_d Rᵀ) in their place, and is brought to a thousandth of the tolerance.
        prefer: which of the solutions of a redundant arm: "any" takes the first; "near" moves it along the null
            space as near to q0 as that leads, "middle" to the middle of the joint ranges.

    Raises:
        TaskError: the task does not fit the robot, its axes move with it, or no joint moves its frame.
        InputError: an option has a wrong value, or the robot has joints with several degrees of freedom.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7; Sugihara, IEEE Trans. Robotics 27, 2011.
    """

    def __init__(
        self,
        robot: RobotLike,
        task: TaskLike,
        *,
        seed: int = 0,
        time_limit: float = 0.5,
        tolerance: float = 1e-6,
        prefer: Preference = "any",
    ) -> None:
        robot, task = robot_and_task(robot, task)
        self.robot, self.task = robot, task
        self._options: dict[str, Any] = {
            "prefer": one_of("prefer", prefer, PREFERENCES),
            "seed": counting_number("seed", seed),
            "tolerance": real_number("tolerance", tolerance, positive=True),
            "time_limit": real_number("time_limit", time_limit, positive=True),
        }
        self._prepare()

    def __repr__(self) -> str:
        return f"IKSolver({self.robot!r}, {self.task!r})"

    def _prepare(self) -> None:
        form = self.task.frame_map()
        if form is None or form.pose_error is None:
            self._search: Search = PythonSearch(self.robot, self.task, **self._options)
            self._solve = self._search.solve
            return
        search = self._search = KernelSearch(self.robot, self.task, **self._options)
        usual = search.pose_error.takes_poses and search.preferred == "any"
        self._solve = PoseSolver(search).solve if usual else search.solve

    def __getstate__(self) -> dict[str, Any]:
        """Return what is pickled and copied: what is prepared, machine code among it, is prepared again."""
        return {name: value for name, value in vars(self).items() if name not in ("_search", "_solve")}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)
        self._prepare()

    def __call__(self, target: Any, q0: ConfigurationLike | None = None) -> IKResult:
        """Return the answer for one target: a solution inside the joint limits, or the nearest miss and why.

        A solution is near q0 where a descent from q0 finds one; a joint that can make whole turns stays within half
        a turn of its value in q0, where its limits allow.

        Args:
            target: r_d, in the form of the task's value.
            q0: (nq,) where to start, moved inside the limits; None starts at random, the same each time.

        Raises:
            InputError: the target or q0 has the wrong form, or is not finite.
        """
        if isinstance(q0, str | Mapping):
            q0 = self.robot.configuration(q0, "q0")
        return self._solve(target, q0)

    def leave(self, seconds: float) -> None:
        """Leave a target so many seconds, and a fifth of the time limit at least: preparing has taken the rest."""
        self._search.time_limit = max(seconds, 0.2 * self._search.time_limit)

    def solve_batch(
        self, targets: Any, q0: npt.ArrayLike | None = None, *, progress: Callable[[int, int], None] | None = None
    ) -> IKBatch:
        """Return the answers for many targets, on all cores.

        Targets that no start reaches share their time: each is given `time_limit` seconds of one core.

        Args:
            targets: k targets, in the form of the task's value: a sequence, or an array with k for its first size.
            q0: (nq,) the start for all, or (k, nq) one for each; None starts at random.
            progress: called with the numbers of targets done, and of all, now and then.

        Raises:
            InputError: there is no target; one has the wrong form, and the message says which; or q0 has.
        """
        return self._search.batch(list_of_targets(targets), q0, progress)


def solve_ik(
    robot: RobotLike,
    task: TaskLike,
    target: Any,
    q0: ConfigurationLike | None = None,
    *,
    seed: int = 0,
    time_limit: float = 0.5,
    tolerance: float = 1e-6,
    prefer: Preference = "any",
) -> IKResult:
    """Return a solution of f(q) = r_d inside the joint limits, or the nearest miss and why.

    The same as `IKSolver(robot, task, ...)(target, q0)`, which explains the arguments; for more than one target make
    the solver once.

    Raises:
        TaskError, InputError: as `IKSolver` does.
    """
    begin = perf_counter()
    solver = IKSolver(robot, task, seed=seed, time_limit=time_limit, tolerance=tolerance, prefer=prefer)
    solver.leave(time_limit - (perf_counter() - begin))
    return solver(target, q0)


def list_of_targets(targets: Any) -> list[Any]:
    """Return targets as a list.

    Raises:
        InputError: there is none, or it is no sequence.
    """
    try:
        listed = list(targets)
    except TypeError as error:
        raise InputError(f"targets must be a sequence of targets, not {type(targets).__name__}") from error
    if not listed:
        raise InputError("there is no target in targets")
    return listed
