"""Every inverse kinematics solution of a target."""

from collections.abc import Mapping
from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.analysis.singular_points import ON_THE_SET, singular_points
from robotics1.errors import NotConverged
from robotics1.ik.search import SolutionSearch
from robotics1.inputs import Array, counting_number, one_of
from robotics1.robot.box import joint_box
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task


class IKVerdict(Enum):
    """How many solutions there are."""

    FINITE = "finitely many solutions"
    INFINITE = "infinitely many solutions, of which some are listed"
    UNREACHABLE = "no solution was found: the target is out of reach, or beyond the joint limits"


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
    """

    q: Array
    singular: npt.NDArray[np.bool_]
    verdict: IKVerdict
    complete: bool
    method: str
    closest: Array
    least_error: float

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

    The search runs damped least squares from random starts and keeps what differs. It can miss a solution,
    so `complete` is False.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        target: r_d, in the form of the task's value.
        method: "search".
        box: joint name → (lower, upper), where to look; needed for prismatic joints without limits.
        starts: the number of random starts.
        seed: of the random starts.

    Raises:
        InputError: the target has the wrong form, or a prismatic joint has neither limits nor a box.
        TaskError: the task does not fit the robot, or its axes move.
    """
    one_of("method", method, ("search",))
    task.check_integrable(robot)
    target = task.target(target)
    where = joint_box(robot, box)
    rng = np.random.default_rng(counting_number("seed", seed))
    search = SolutionSearch(robot, task, target, where, singular_points(robot, task, where, rng))
    ends = [search.descend(q) for q in where.random(rng, counting_number("starts", starts, least=1))]
    found = search.distinct(ends)
    families = any(search.in_a_family(q) for q in found)
    verdict = IKVerdict.INFINITE if families else IKVerdict.FINITE if found else IKVerdict.UNREACHABLE
    closest = found[0] if found else search.nearest_miss(min(ends, key=lambda end: end[1])[0])
    return IKSolutions(
        q=np.array(found).reshape(-1, robot.nq),
        singular=np.array([search.points.gap(q) <= ON_THE_SET for q in found], dtype=bool),
        verdict=verdict,
        complete=False,
        method=method,
        closest=closest,
        least_error=float(np.linalg.norm(task.error(robot, closest, target))),
    )
