"""Every solution of many targets."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.caching import cached_property
from robotics1.ik.result import IKStatus
from robotics1.ik.solution_set import IKSolutions
from robotics1.inputs import Array
from robotics1.results import Frozen, require
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task


@dataclass(frozen=True, eq=False)
class IKSolutionsBatch(Frozen):
    """The solutions of k targets, in their order: `batch[i]` is the `IKSolutions` of target i.

    Attributes:
        q: (N, nq) the solutions inside the joint limits, target after target [rad or m].
        counts: (k,) how many of them each target has.
        status: (k,) of IKStatus.
        complete: (k,) whether the method proves that a target has no others.
        error_norm: (k,) |r_d − f(q)| at the solution, or the nearest miss [m, rad].
        outside_limits: (M, nq) the solutions outside the limits, target after target.
        outside_counts: (k,) how many of them each target has.
        method: how the solutions of the usual targets were found.
        free_joints: the joints that do not move the task.
        robot, task: whose solutions they are.
        careful: target → its solutions, where the target is near a singularity, or has no solution inside the limits.
    """

    q: Array
    counts: npt.NDArray[np.int64]
    status: npt.NDArray[Any]
    complete: npt.NDArray[np.bool_]
    error_norm: Array
    outside_limits: Array
    outside_counts: npt.NDArray[np.int64]
    method: str
    free_joints: tuple[str, ...]
    careful: Mapping[int, IKSolutions]
    robot: Robot = field(repr=False)
    task: Task = field(repr=False)

    @cached_property
    def ends(self) -> npt.NDArray[np.int64]:
        """(k+1,) the solutions of target i are the rows ends[i], ..., ends[i+1] − 1 of q."""
        return np.append(0, np.cumsum(self.counts))

    @cached_property
    def outside_ends(self) -> npt.NDArray[np.int64]:
        """(k+1,) the same of `outside_limits`."""
        return np.append(0, np.cumsum(self.outside_counts))

    def __len__(self) -> int:
        return len(self.counts)

    def __getitem__(self, i: int) -> IKSolutions:
        i = range(len(self))[i]
        if i in self.careful:
            return self.careful[i]
        q = self.q[self.ends[i] : self.ends[i + 1]]
        return IKSolutions(
            q=q,
            singular=np.zeros(len(q), dtype=bool),
            status=IKStatus.FINITE,
            complete=True,
            method=self.method,
            closest=q[0],
            error_norm=float(self.error_norm[i]),
            free_joints=self.free_joints,
            dimension=0,
            within_limits=np.ones(len(q), dtype=bool),
            outside_limits=self.outside_limits[self.outside_ends[i] : self.outside_ends[i + 1]],
            robot=self.robot,
            task=self.task,
        )

    def explain(self) -> str:
        """Return how many targets have solutions, and why the first of the others has none."""
        without = np.flatnonzero(self.counts == 0)
        if not without.size:
            return f"{len(self)} targets have {len(self.q)} solutions"
        return (
            f"{without.size} of {len(self)} targets have no solution; the first is target {without[0]}: "
            f"{self[int(without[0])].explain()}"
        )

    def require(self) -> IKSolutionsBatch:
        """Return self if every target has a solution.

        Raises:
            NotConverged: one has none; the message says which, and why.
        """
        return require(self, bool((self.counts > 0).all()))
