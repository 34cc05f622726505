"""J and σ_min of the Panda at random configurations, on one thread: `python -m benchmarks.scans`.

Writes benchmarks/results/scans.md; with --quick few configurations are taken, and it is printed instead.
"""

from benchmarks.one_thread import one_thread

if __name__ == "__main__":
    one_thread()

import argparse
import gc
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from time import process_time
from typing import Any

import numpy as np

from benchmarks.arms import Arm, Array, panda
from benchmarks.jacobian_scans import BEST_PEER, SCANS, Scan, pinocchio_jacobians
from benchmarks.report import Target, absence, at_least, at_most, conditions, table, target_table, tell, write
from benchmarks.singular_targets import singular_configurations

SEED = 20250114
REPEATS = 9
BLOCK, PUBLIC_COUNT = 20_000, 1_000_000  # configurations of one call, and of one public scan
QUICK = 10  # how many times fewer
SINGULAR = 300  # configurations
PUBLIC, KERNEL = "robotics1 `scan_singularities`", "robotics1 kernel, J written"
HEADER = ["way", "configurations/s", f"beside {BEST_PEER}", "error of σ_min", "at singular configurations"]
RULES = """\
All ways take turns, {repeats} times; the rate is by the median of the processor's time. σ_min is of J of the tool in
world axes, metres and radians unscaled, at q uniform in the joint limits, {block} of them a call. A public scan has
{count}, draws them itself, and reduces them to the minimum, quantiles, a histogram and the worst. The error is |σ_min −
that of the SVD of Pinocchio's J| at worst; of the public scan, at the configurations that it returns. Singular
configurations: {singular}, q2 = 0 and the determinant of the other columns driven to 0."""


@dataclass
class Way:
    """One way to scan, and what was measured of it.

    Attributes:
        name: as in the table.
        call: what is timed; None where it is absent.
        count: configurations in one call.
        absent: why there is no call.
        seconds: of the processor, for each repeat.
        error, singular_error: of σ_min, at worst; None where there is none.
    """

    name: str
    call: Callable[[], Any] | None
    count: int
    absent: str = ""
    seconds: list[float] = field(default_factory=list)
    error: float | None = None
    singular_error: float | None = None

    @property
    def rate(self) -> float | None:
        """Configurations a second."""
        return self.count / float(np.median(self.seconds)) if self.seconds else None

    def beside(self, peer: "Way") -> float | None:
        """Return how many times as many configurations a second as the peer it does."""
        return self.rate / peer.rate if self.rate and peer.rate else None

    def row(self, peer: "Way") -> list[str]:
        """Return the cells of its row."""
        ratio = self.beside(peer)
        if self.rate is None or ratio is None:
            return [self.name, f"**{self.absent}**", *["–"] * (len(HEADER) - 2)]
        errors = ["–" if error is None else f"{error:.1e}" for error in (self.error, self.singular_error)]
        return [self.name, f"{self.rate:,.0f}", f"{ratio:.2f}", *errors]


def way(name: str, arm: Arm, q: Array, singular: Array) -> Way:
    """Return one of SCANS, called once, with its errors; absent where something cannot be imported."""
    try:
        scan: Scan = SCANS[name](arm)
    except ImportError as error:
        return Way(name, None, len(q), absent=absence(error))
    errors = [float(np.abs(scan(some) - _sigma_min(arm, some)).max()) for some in (q, singular)]
    return Way(name, lambda: scan(q), len(q), error=errors[0], singular_error=errors[1])


def public_way(arm: Arm, count: int) -> Way:
    """Return `scan_singularities`, called once, with the error of the worst that it returns."""
    try:
        from robotics1 import PoseTask, scan_singularities
    except ImportError as error:
        return Way(PUBLIC, None, count, absent=absence(error))
    task = PoseTask()
    found = scan_singularities(arm.robot, task, samples=count, seed=SEED)
    error = float(np.abs(found.worst_values - _sigma_min(arm, found.worst)).max())
    return Way(PUBLIC, lambda: scan_singularities(arm.robot, task, samples=count, seed=SEED), count, error=error)


def take_turns(ways: list[Way]) -> None:
    """Time all ways that there are, one after the other, again and again."""
    gc.collect()
    gc.disable()
    try:
        for _ in range(REPEATS):
            for one in ways:
                if one.call is not None:
                    begin = process_time()
                    one.call()
                    one.seconds.append(process_time() - begin)
    finally:
        gc.enable()


def targets_of(ways: dict[str, Way]) -> list[Target]:
    """Return the targets of the project beside what was measured."""
    peer, public, kernel = ways[BEST_PEER], ways[PUBLIC], ways[KERNEL]
    errors = [error for one in (public, kernel) for error in (one.error, one.singular_error) if error is not None]
    return [
        at_least(f"public scan, beside {BEST_PEER}", 6, public.beside(peer)),
        at_least(f"kernel, J written, beside {BEST_PEER}", 8, kernel.beside(peer)),
        at_most("error of σ_min, kernel and public scan", 1e-10, max(errors) if errors else None, ""),
    ]


def _sigma_min(arm: Arm, q: Array) -> Array:
    return np.linalg.svd(pinocchio_jacobians(arm, q), compute_uv=False)[:, -1]


def main() -> None:
    """Measure all ways, and write the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} times fewer configurations; write nothing")
    fewer = QUICK if (quick := parser.parse_args().quick) else 1
    arm, rng = panda(), np.random.default_rng(SEED)
    q = rng.uniform(arm.robot.lower, arm.robot.upper, (BLOCK // fewer, arm.robot.nq))
    singular = singular_configurations(arm, SINGULAR, rng)
    ways = {name: way(name, arm, q, singular) for name in SCANS}
    ways[PUBLIC] = public_way(arm, PUBLIC_COUNT // fewer)
    take_turns(list(ways.values()))
    rules = RULES.format(
        repeats=REPEATS, block=f"{len(q):,}", count=f"{PUBLIC_COUNT // fewer:,}", singular=len(singular)
    )
    parts = [
        "# J and σ_min of the Panda",
        conditions("python -m benchmarks.scans", SEED),
        f"## Targets\n\n{target_table(targets_of(ways))}",
        f"## Measured\n\n{rules}",
        table(HEADER, [one.row(ways[BEST_PEER]) for one in ways.values()]),
    ]
    tell("\n\n".join(parts) if quick else f"written: {write('scans', *parts)}")


if __name__ == "__main__":
    sys.exit(main())
