"""Inverse kinematics beside the peers, in one run: `python -m benchmarks.inverse_kinematics`.

Writes benchmarks/results/inverse_kinematics.md; with --quick few targets are asked, and it is printed instead.
"""

from benchmarks.one_thread import one_thread

if __name__ == "__main__":
    one_thread()

import argparse
import sys
from collections.abc import Callable

from benchmarks.arms import ARMS, Arm
from benchmarks.batches import run_batch
from benchmarks.cold_start import cold_starts
from benchmarks.ik_tables import (
    FAR,
    SINGULAR,
    TRACKING,
    Measured,
    batch_table,
    batch_targets,
    row_table,
    single_targets,
    start_table,
    start_targets,
)
from benchmarks.interleaved import run_interleaved
from benchmarks.peers import SOLVERS, Solver, make_solver
from benchmarks.report import Target, absence, conditions, target_table, tell, write
from benchmarks.workloads import SEED, Workload, far, singular, tracking

# work → (how targets and starts are made, how many, in words)
WORKLOADS: dict[str, tuple[Callable[[Arm, int], Workload], int, str]] = {
    FAR: (far, 5000, "The target is the pose of a uniform q inside the limits, the start another such q."),
    TRACKING: (tracking, 5000, "The start is at most 0.05 rad a joint from a solution."),
    SINGULAR: (singular, 1500, "The target is the pose of a singular q inside the limits, the start a uniform q."),
}
QUICK = 100  # targets
IN_A_ROW = 25
RULES = """\
All solvers take turns at each target, in random order, and are called twice before; the slow ones get every k-th
target, and are compared with our times at the same targets. Solved: Pinocchio's forward kinematics at the answer,
outside the timed call, is within 1e-5 m and 1e-4 rad of the target, and every joint inside its limits. "Gave up": the
solver says itself that it failed. The median and p99 are of the time of a call, the mean is of the processor time of
all threads; all three include the failures. The tolerance of each solver is set so that its answers can meet these:
see `benchmarks/peers/`."""
IN_WORDS = f"""\
The same, but each solver is given {IN_A_ROW} targets before it is the next one's turn. It then finds its own code in
the processor's caches, as in a program that solves one target after the other; with turns at each target it finds
those of the others, which costs every solver time, and hides most of the difference between fast ones."""


def measure(arm: Arm, work: str, count: int, in_a_row: int = 1) -> Measured:
    """Return what all solvers do with an arm and a workload, the next one's turn coming after `in_a_row` targets."""
    workload = WORKLOADS[work][0](arm, count)
    made = {name: make_solver(name, arm) for name in SOLVERS}
    solvers = {name: solver for name, solver in made.items() if isinstance(solver, Solver)}
    absent = {name: why for name, why in made.items() if isinstance(why, str)}
    runs = run_interleaved(solvers, workload, in_a_row)
    return Measured(arm.name, work, workload, runs, absent, in_a_row)


def available_arms() -> tuple[dict[str, Arm], list[Target]]:
    """Return the arms, and targets not measured for those that cannot be had."""
    arms, targets = {}, []
    for name, make in ARMS.items():
        try:
            arms[name] = make()
        except ImportError as error:
            targets.append(Target(f"{name}, everything", absence(error), None, met=False))
    return arms, targets


def measure_all(quick: bool) -> tuple[list[Target], list[str]]:
    """Return the targets and the sections of the result."""
    arms, targets = available_arms()
    sections, batches, rows = [], {}, []
    for work, (make, full, words) in WORKLOADS.items():
        count = QUICK if quick else full
        sections.append(f"## {work.capitalize()}\n\n{words}")
        for name, arm in arms.items():
            measured = measure(arm, work, count)
            targets += single_targets(measured)
            sections.append(f"### {name}\n\n{measured.table()}")
            tell(f"{work}, {name}:\n{measured.table()}\n")
            if work != SINGULAR:
                batches[name, work] = run_batch(make(arm, count))
        if work != SINGULAR:
            some = [measure(arm, work, count, IN_A_ROW) for arm in arms.values()]
            targets += [target for measured in some for target in single_targets(measured)]
            rows.append(f"### {work.capitalize()}\n\n{row_table(some)}")
    targets += [target for (name, work), batch in batches.items() for target in batch_targets(name, work, batch)]
    sections += [f"## {IN_A_ROW} calls in a row\n\n{IN_WORDS}", *rows]
    sections.append(f"## Batches on one core\n\n{batch_table(batches)}")
    return targets, sections


def main() -> None:
    """Measure everything, and write the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} targets of each kind; write nothing")
    quick = parser.parse_args().quick
    targets, sections = measure_all(quick)
    starts = cold_starts()
    parts = [
        "# Inverse kinematics beside the peers",
        conditions("python -m benchmarks.inverse_kinematics", SEED),
        f"## Targets\n\n{target_table(targets + start_targets(starts))}",
        f"## How it is measured\n\n{RULES}",
        *sections,
        f"## The first call of a process\n\n{start_table(starts) if starts else 'not measured'}",
    ]
    tell("\n\n".join(parts) if quick else f"written: {write('inverse_kinematics', *parts)}")


if __name__ == "__main__":
    sys.exit(main())
