"""The robust search: from q0, then from further starts, until one arrives or the time is over."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from contextlib import nullcontext
from dataclasses import dataclass
from time import perf_counter
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.ik.goals import numbered
from robotics1.ik.result import IKBatch, IKResult, IKStatus
from robotics1.inputs import Array, dimensions, real_array
from robotics1.kernels.chain import Indices
from robotics1.robot.model import Robot

SOON = 8  # groups of starts that are tried before a proof is tried for longer
SHORT = 0.05  # of the time limit, that the starts between two looks at the clock take
MOST_GROUPS = 256  # of starts between two looks at the clock
PROVING = 0.2  # of the time limit, that a proof may take
Progress = Callable[[int, int], None]
Table = tuple[Array, int]  # starts, and how many of them share a group; of a group one start is tried
Ends = tuple[Array, Indices, Array]  # where descents end, (k, nq), how many starts were tried, (k,), and |e|, (k,)


@dataclass(eq=False)
class Found:
    """What has been found so far for k targets.

    Attributes:
        targets: as they were given.
        first: the number of the first of them in its batch; None for one that stands alone.
        goals: (k, ...) the targets in the form of the search.
        starts: (k, nq) q0 of each target, or None.
        q, tried, error: where the least error is, how many starts were tried, and that error |e|.
        proven: (k,) whether a target is proven to be out of reach.
    """

    targets: list[Any]
    first: int | None
    goals: npt.NDArray[Any]
    starts: Array | None
    q: Array
    tried: npt.NDArray[np.int64]
    error: Array
    proven: npt.NDArray[np.bool_]

    def improve(self, left: Indices, ends: Ends) -> None:
        """Keep of further ends for some of the targets those with a smaller error."""
        q, tried, error = ends
        self.tried[left] += tried
        better = error < self.error[left]
        self.q[left[better]], self.error[left[better]] = q[better], error[better]

    def batch(self, tolerance: float) -> IKBatch:
        """Return the answers."""
        status = np.full(len(self.q), IKStatus.NOT_FOUND)
        status[self.proven] = IKStatus.UNREACHABLE
        status[self.error <= tolerance] = IKStatus.CONVERGED
        return IKBatch(self.q, status, self.error, self.tried)


class Search(ABC):
    """The search for solutions inside the joint limits; a subclass says how starts are followed down to targets.

    Attributes:
        robot: whose joints move.
        tolerance: on |e|.
        time_limit: for one target [s].
        at_once: how many targets are searched for together.
        cores: how many of them at the same time.
        enough: the part of the time limit after which no further starts are tried.
    """

    robot: Robot
    tolerance: float
    time_limit: float
    at_once: int
    cores: int
    enough: float

    @abstractmethod
    def goals(self, targets: list[Any], first: int | None) -> npt.NDArray[Any]:
        """Return the targets in the form of the search, checked; `first` is the number of the first in its batch."""

    @abstractmethod
    def begin(self, found: Found, tables: Iterator[Table], seconds: float) -> None:
        """Try q0, or the first starts where there is none, in not much longer than these seconds."""

    @abstractmethod
    def tables(self) -> Iterator[Table]:
        """Yield further starts, without an end."""

    @abstractmethod
    def again(self, found: Found, left: Indices, starts: Table, seconds: float) -> Ends:
        """Return where further starts lead, for the targets that are left."""

    @abstractmethod
    def miss(self, found: Found, never: Indices, seconds: float) -> None:
        """Move what was found for targets that were not reached to where |e| is least around it."""

    def unreachable(self, goals: npt.NDArray[Any], seconds: float) -> npt.NDArray[np.bool_]:
        """Return which goals are proven to be out of reach in that time: none, where nothing is known of the task."""
        return np.zeros(len(goals), dtype=bool)

    def prefer(self, found: Found) -> None:  # noqa: B027 (the first solution is as good as any)
        """Move the solutions to those that are preferred."""

    def solve(self, target: Any, q0: npt.ArrayLike | None) -> IKResult:
        """Return the answer for one target."""
        start = None if q0 is None else self.robot.configuration(q0, "q0")[None]
        return self._answers([target], start, None)[0]

    def batch(self, targets: list[Any], q0: npt.ArrayLike | None, progress: Progress | None) -> IKBatch:
        """Return the answers for many targets."""
        k, size = len(targets), self.at_once
        starts, parts = None if q0 is None else starts_of_all(self.robot, q0, k), []
        for i in range(0, k, size):
            some = slice(i, min(i + size, k))
            with numbered(i) if size == 1 else nullcontext():
                parts.append(self._answers(targets[some], None if starts is None else starts[some], i))
            if progress is not None:
                progress(some.stop, k)
        return parts[0] if len(parts) == 1 else IKBatch.of(parts)

    def _answers(self, targets: list[Any], starts: Array | None, first: int | None) -> IKBatch:
        begin, k, nq = perf_counter(), len(targets), self.robot.nq
        found = Found(
            targets,
            first,
            self.goals(targets, first),
            starts,
            np.empty((k, nq)),
            np.zeros(k, dtype=np.int64),
            np.full(k, np.inf),
            np.zeros(k, dtype=bool),
        )
        tables = self.tables()
        self.begin(found, tables, self.enough * self.time_limit)
        left = np.flatnonzero(~(found.error <= self.tolerance))  # NaN is a miss
        if left.size:
            spent = self._restart(found, left, tables, (perf_counter() - begin) * self._share(k))
            never = np.flatnonzero(found.error > self.tolerance)  # what the kernel refused has no error
            if never.size:
                self.miss(found, never, self.time_limit - spent)
        self.prefer(found)
        return found.batch(self.tolerance)

    def _share(self, k: int) -> float:
        """Return the part of the time that passes for k targets which each of them has."""
        return min(1.0, self.cores / k)

    def _restart(self, found: Found, left: Indices, tables: Iterator[Table], spent: float) -> float:
        """Try further starts for the targets that are left, until the time is over: return the seconds of a target.

        First comes a short attempt to prove that there is no solution, then starts near the targets, a longer attempt,
        and starts anywhere.
        """
        left, limit, size = self._not_proven(found, left, seconds=0.0), self.enough * self.time_limit, SOON
        for number, (starts, group) in enumerate(tables):
            at = 0
            while at * group < len(starts):
                if not left.size or spent >= limit:
                    return spent
                begin, share = perf_counter(), self._share(left.size)
                some = (starts[at * group : (at + size) * group], group)
                at += size
                found.improve(left, self.again(found, left, some, limit - spent))
                left = left[~(found.error[left] <= self.tolerance)]
                seconds = (perf_counter() - begin) * share
                spent += seconds
                size = int(np.clip(size * SHORT * self.time_limit / seconds, 1, MOST_GROUPS))
            if number == 0 and left.size:
                begin, share = perf_counter(), self._share(left.size)
                left = self._not_proven(found, left, seconds=PROVING * self.time_limit)
                spent += (perf_counter() - begin) * share
        return spent

    def _not_proven(self, found: Found, left: Indices, *, seconds: float) -> Indices:
        """Return the targets that are not proven, in the time, to be out of reach."""
        proven = self.unreachable(found.goals[left], seconds)
        found.proven[left[proven]] = True
        return left[~proven]


def starts_of_all(robot: Robot, q0: npt.ArrayLike, k: int) -> Array:
    """Return the starts of k targets, (k, nq), of q0 for all of them, (nq,), or for each.

    Raises:
        InputError: it is neither, or not finite.
    """
    if dimensions("q0", q0) < 2:
        return np.tile(robot.configuration(q0, "q0"), (k, 1))
    return real_array("q0", q0, (k, robot.nq), "one start for each target")
