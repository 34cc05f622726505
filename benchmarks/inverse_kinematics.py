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
    single_targets,
    start_table,
    start_targets,
)
from benchmarks.interleaved import run_interleaved
from benchmarks.peers import SOLVERS, Solver, make_solver
from benchmarks.report import conditions, target_table, tell, write
from benchmarks.workloads import SEED, Workload, far, singular, tracking

# work → (how targets and starts are made, how many, in words)
WORKLOADS: dict[str, tuple[Callable[[Arm, int], Workload], int, str]] = {
    FAR: (far, 5000, "The target is the pose of a uniform q inside the limits, the start another such q."),
    TRACKING: (tracking, 5000, "The start is at most 0.05 rad a joint from a solution."),
    SINGULAR: (singular, 1500, "The target is the pose of a singular q inside the limits, the start a uniform q."),
}
QUICK = 100  # targets
RULES = """\
All solvers take turns at each target, and are called once before; the slow ones get every k-th target, and are
compared with our times at the same targets. Solved: Pinocchio's forward kinematics at the answer, outside the timed
call, is within 1e-5 m and 1e-4 rad of the target, and every joint inside its limits. "Gave up": the solver says
itself that it failed. The median and p99 are of the time of a call, the mean is of the processor time of all threads;
all three include the failures. The tolerance of each solver is set so that its answers can meet these: see
`benchmarks/peers/`."""


def measure(arm: Arm, work: str, count: int, names: list[str]) -> Measured:
    """Return what the solvers of these names do with an arm and a workload."""
    workload = WORKLOADS[work][0](arm, count)
    made = {name: make_solver(name, arm) for name in names}
    runs = run_interleaved({name: solver for name, solver in made.items() if isinstance(solver, Solver)}, workload)
    return Measured(arm.name, work, workload, runs, {name: why for name, why in made.items() if isinstance(why, str)})


def main() -> None:
    """Measure all arms and workloads, and write the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} targets of each kind; write nothing")
    quick = parser.parse_args().quick
    singles, batches, sections = [], {}, []
    for work, (make, full, words) in WORKLOADS.items():
        sections.append(f"## {work.capitalize()}\n\n{words}")
        for name, make_arm in ARMS.items():
            arm, count = make_arm(), QUICK if quick else full
            singles.append(measure(arm, work, count, list(SOLVERS)))
            sections.append(f"### {name}\n\n{singles[-1].table()}")
            if work != SINGULAR:
                batches[name, work] = run_batch(make(arm, count))
            tell(f"{work}, {name}:\n{singles[-1].table()}\n")
    starts = cold_starts()
    targets = [target for measured in singles for target in single_targets(measured)]
    targets += [target for (arm_name, work), b in batches.items() for target in batch_targets(arm_name, work, b)]
    parts = [
        "# Inverse kinematics beside the peers",
        conditions("python -m benchmarks.inverse_kinematics", SEED),
        f"## Targets\n\n{target_table(targets + start_targets(starts))}",
        f"## How it is measured\n\n{RULES}",
        *sections,
        f"## Batches on one core\n\n{batch_table(batches)}",
        f"## The first call of a process\n\n{start_table(starts) if starts else 'not measured'}",
    ]
    tell("\n\n".join(parts) if quick else f"written: {write('inverse_kinematics', *parts)}")


if __name__ == "__main__":
    sys.exit(main())
