"""One run of all solvers: they take turns at each target, so that a busy or warm machine is so for all of them."""

import gc
from collections.abc import Iterator
from dataclasses import dataclass
from time import perf_counter_ns, process_time_ns

import numpy as np

from benchmarks.arms import Array
from benchmarks.peers import Solver
from benchmarks.workloads import Workload

Answer = Array | None  # q, or None where the solver told that it failed


@dataclass(frozen=True, eq=False)
class Run:
    """What one solver did.

    Attributes:
        indices: (k,) which targets it was asked.
        wall, cpu: (k,) the time of each call, and the processor time of all its threads [µs]; failures included.
        answers: (k,) what it answered.
    """

    indices: list[int]
    wall: Array
    cpu: Array
    answers: list[Answer]


@dataclass(frozen=True)
class Score:
    """How a run went, by Pinocchio's forward kinematics.

    Attributes:
        targets: how many it was asked.
        solved: how many answers meet the tolerance inside the limits; only they count.
        gave_up: how often it told that it failed.
        missed: how often it told success, and the answer misses the tolerance.
        outside: how often it told success, and the answer meets the tolerance outside the limits.
        median, p99: of the time of a call [µs].
        mean: of the processor time, with all failures [µs].
    """

    targets: int
    solved: int
    gave_up: int
    missed: int
    outside: int
    median: float
    mean: float
    p99: float

    @property
    def success(self) -> float:
        """Solved inside the limits, of all targets [%]."""
        return 100 * self.solved / self.targets


def run_interleaved(solvers: dict[str, Solver], workload: Workload, in_a_row: int = 1) -> dict[str, Run]:
    """Return what each solver did; each is given `in_a_row` targets, then it is the next one's turn.

    With 1 each call finds the processor's caches full of the others' code, as in a program that does much else
    between two calls; with more it finds its own, as in a program that solves one target after the other.
    """
    converted = {name: [solver.convert(T) for T in workload.targets] for name, solver in solvers.items()}
    for name, solver in solvers.items():  # compilation and first allocations are not counted here
        for i in range(min(2, len(workload.targets))):
            solver.solve(converted[name][i], workload.starts[i].copy())
    rows: dict[str, list[tuple[int, int, int]]] = {name: [] for name in solvers}
    answers: dict[str, list[Answer]] = {name: [] for name in solvers}
    gc.collect()
    gc.disable()
    try:
        for name, i in _turns(solvers, len(workload.targets), in_a_row):
            solve, target, q0 = solvers[name].solve, converted[name][i], workload.starts[i].copy()
            cpu, wall = process_time_ns(), perf_counter_ns()
            q = solve(target, q0)
            wall, cpu = perf_counter_ns() - wall, process_time_ns() - cpu
            rows[name].append((i, wall, cpu))
            answers[name].append(None if q is None else np.array(q, dtype=float))
    finally:
        gc.enable()
    return {name: _run(rows[name], answers[name]) for name in solvers}


def _turns(solvers: dict[str, Solver], count: int, in_a_row: int) -> Iterator[tuple[str, int]]:
    """Go through who is called with which target, in a new random order each turn.

    In a fixed one, a solver would always follow the same other, and find as much or as little of its own code in the
    caches as that one leaves.
    """
    rng = np.random.default_rng(0)
    for begin in range(0, count, in_a_row):
        for name in rng.permutation(list(solvers)).tolist():
            for i in range(begin, min(begin + in_a_row, count)):
                if i % solvers[name].every == 0:
                    yield name, i


def _run(rows: list[tuple[int, int, int]], answers: list[Answer]) -> Run:
    table = np.array(rows)
    return Run(table[:, 0].tolist(), table[:, 1] / 1e3, table[:, 2] / 1e3, answers)


def score(run: Run, workload: Workload) -> Score:
    """Return how the run went; this is outside the timed calls."""
    arm, told = workload.arm, [(i, q) for i, q in zip(run.indices, run.answers, strict=True) if q is not None]
    met = [q for i, q in told if arm.meets(q, workload.targets[i])]
    solved = sum(arm.inside(q) for q in met)
    return Score(
        targets=len(run.indices),
        solved=solved,
        gave_up=len(run.indices) - len(told),
        missed=len(told) - len(met),
        outside=len(met) - solved,
        median=float(np.median(run.wall)),
        mean=float(np.mean(run.cpu)),
        p99=float(np.percentile(run.wall, 99)),
    )


def ratios(run: Run, reference: Run) -> tuple[float, float]:
    """Return run / reference of the median and of the mean time, over the targets that both were asked."""
    common = sorted(set(run.indices) & set(reference.indices))
    ours, theirs = (_at(reference, common), _at(run, common))
    return (
        float(np.median(theirs[0]) / np.median(ours[0])),
        float(np.mean(theirs[1]) / np.mean(ours[1])),
    )


def _at(run: Run, indices: list[int]) -> tuple[Array, Array]:
    chosen = np.isin(run.indices, indices)
    return run.wall[chosen], run.cpu[chosen]
