"""Many targets in one call, on one core, beside the loop that Robotics Toolbox needs; in turns."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from time import process_time
from typing import Any

import numpy as np

from benchmarks.arms import Array
from benchmarks.interleaved import Answer
from benchmarks.peers import CHAN, make_solver
from benchmarks.workloads import Workload

REPEATS = 5


@dataclass(frozen=True)
class BatchScore:
    """How a batch went.

    Attributes:
        ours, loop: the processor time of one target [µs], median of the repeats; None where the solver is absent.
        solved, solved_by_loop: solved inside the limits, by Pinocchio's forward kinematics [%].
    """

    ours: float | None
    loop: float | None
    solved: float | None
    solved_by_loop: float | None

    @property
    def ratio(self) -> float | None:
        """How many times longer the loop takes."""
        return None if self.ours is None or self.loop is None else self.loop / self.ours

    def cells(self) -> list[str]:
        """Return the cells of its row."""
        numbers = (self.ours, self.solved, self.loop, self.solved_by_loop, self.ratio)
        return ["–" if number is None else f"{number:.2f}" for number in numbers]


def run_batch(workload: Workload) -> BatchScore:
    """Return the times of `IKSolver.solve_batch` and of a loop over `ik_LM`, with one thread each."""
    calls = [_our_batch(workload), _their_loop(workload)]
    seconds: list[list[float]] = [[], []]
    answers: list[Sequence[Answer]] = [[], []]
    for _ in range(REPEATS):
        for i, call in enumerate(calls):
            if call is not None:
                begin = process_time()
                result = call()
                seconds[i].append(process_time() - begin)
                answers[i] = result if isinstance(result, list) else _told(result)
    k = len(workload.targets) / 1e6
    times = [float(np.median(s)) / k if s else None for s in seconds]
    solved = [_solved(workload, answers[i]) if seconds[i] else None for i in range(2)]
    return BatchScore(times[0], times[1], solved[0], solved[1])


def _our_batch(workload: Workload) -> Callable[[], Any] | None:
    try:
        from robotics1 import IKSolver, PoseTask
    except ImportError:
        return None
    solver = IKSolver(workload.arm.robot, PoseTask())
    solver.solve_batch(workload.targets[:2], workload.starts[:2])  # compilation is told elsewhere
    return lambda: solver.solve_batch(workload.targets, workload.starts)


def _their_loop(workload: Workload) -> Callable[[], list[Answer]] | None:
    peer = make_solver(CHAN, workload.arm)
    if isinstance(peer, str):
        return None
    targets = [peer.convert(T) for T in workload.targets]
    return lambda: [peer.solve(T, q0) for T, q0 in zip(targets, workload.starts, strict=True)]


def _told(batch: Any) -> list[Answer]:
    return [q if converged else None for q, converged in zip(batch.q, batch.converged, strict=True)]


def _solved(workload: Workload, answers: Sequence[Array | None]) -> float:
    arm = workload.arm
    pairs = zip(answers, workload.targets, strict=True)
    return 100 * sum(q is not None and arm.meets(q, T) and arm.inside(q) for q, T in pairs) / len(workload.targets)
