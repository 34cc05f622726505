"""The joint ranges that a set of targets needs."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise, product
from math import prod, tau
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.ik.solutions import ik_solutions
from robotics1.ik.solver import list_of_targets
from robotics1.inputs import Array
from robotics1.results import Frozen
from robotics1.robot.given import RobotLike
from robotics1.tasks.given import TaskLike, robot_and_task

MOST_COMBINATIONS = 20_000
ROUNDING = 1e-9  # rad: an angle that is so little before the first one is the first one
SWEEPS = 4


@dataclass(frozen=True, eq=False)
class JointRanges(Frozen):
    """One configuration for each target, chosen so that the joints need little room.

    Attributes:
        q: (k, nq) the configurations, one for each target that is reached [rad or m], without the whole turns that
            would make the ranges large.
        lower, upper: (nq,) the ranges that they need [rad or m].
        unreachable: the numbers of the targets without a solution.
        smallest: whether all combinations of all solutions were compared. Else a good one was sought step by step, or a
            target has infinitely many solutions, or more than were found.
        joint_names: the joints' names.
    """

    q: Array
    lower: Array
    upper: Array
    unreachable: tuple[int, ...]
    smallest: bool
    joint_names: tuple[str, ...]

    def explain(self) -> str:
        """Return the ranges in sentences."""
        lines = [
            f"{name} needs from {low:.6g} to {high:.6g}."
            for name, low, high in zip(self.joint_names, self.lower, self.upper, strict=True)
        ]
        if self.unreachable:
            lines.append(f"Not reached: targets {', '.join(map(str, self.unreachable))}.")
        if not self.smallest:
            lines.append("Not all combinations of solutions were compared: smaller ranges may exist.")
        return "\n".join(lines)


def joint_ranges(robot: RobotLike, task: TaskLike, targets: Sequence[Any]) -> JointRanges:
    """Return small joint ranges with which all targets can be reached.

    Of the solutions of each target one is chosen, so that Σ (upper − lower) is small; a radian counts like a metre.

    Args:
        robot: the arm.
        task: what is wanted.
        targets: its values, in the form of the task's target. Of infinitely many solutions some are taken.

    Raises:
        InputError: there is no target, or none has a solution.
    """
    robot, task = robot_and_task(robot, task)
    wanted = list_of_targets(targets)
    solved = [ik_solutions(robot, task, target) for target in wanted]
    found = [solutions.q for solutions in solved]
    unreachable = tuple(i for i, q in enumerate(found) if not len(q))
    choices = [q for q in found if len(q)]
    if not choices:
        raise InputError("none of the targets has a solution inside the joint limits")
    circular = robot.revolute & (robot.upper - robot.lower >= tau - 1e-9)
    every = prod(len(q) for q in choices) <= MOST_COMBINATIONS
    best = _best(choices, circular) if every else _stepwise(choices, circular)
    q = _without_turns(np.array(best), circular)
    smallest = every and all(solutions.complete and not solutions.dimension for solutions in solved)
    return JointRanges(q, q.min(axis=0), q.max(axis=0), unreachable, smallest, tuple(robot.joint_names))


def _room(q: Array, circular: npt.NDArray[np.bool_]) -> float:
    return float(np.ptp(_without_turns(q, circular), axis=0).sum())


def _best(choices: Sequence[Array], circular: npt.NDArray[np.bool_]) -> list[Array]:
    return min((list(pick) for pick in product(*choices)), key=lambda pick: _room(np.array(pick), circular))


def _stepwise(choices: Sequence[Array], circular: npt.NDArray[np.bool_]) -> list[Array]:
    """Return a choice from each start, improved one target after the other."""
    found = []
    for start in choices[0]:
        pick = [start]
        for q in choices[1:]:
            pick.append(_least(pick, q, [], circular))
        for _ in range(SWEEPS):
            for i, q in enumerate(choices):
                pick[i] = _least(pick[:i], q, pick[i + 1 :], circular)
        found.append(pick)
    return min(found, key=lambda pick: _room(np.array(pick), circular))


def _least(before: list[Array], q: Array, after: list[Array], circular: npt.NDArray[np.bool_]) -> Array:
    """Return the one of q (k, n) that needs the least room beside the others."""
    rooms = [_room(np.array([*before, one, *after]), circular) for one in q]
    return np.asarray(q[int(np.argmin(rooms))])


def _without_turns(q: Array, circular: npt.NDArray[np.bool_]) -> Array:
    """Return angles (k, n) of circular joints in the smallest arc that holds all of a joint."""
    q = q.copy()
    for j in np.flatnonzero(circular):
        around = np.sort(q[:, j] % tau)
        gaps = [b - a for a, b in pairwise([*around, around[0] + tau])]
        k = int(np.argmax(gaps))
        first = around[(k + 1) % len(around)]
        first = first - tau if first > tau / 2 else first
        q[:, j] = first + (q[:, j] - first + ROUNDING) % tau - ROUNDING
    return q
