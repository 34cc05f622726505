"""The tables of benchmarks/results/inverse_kinematics.md."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from benchmarks.batches import BatchScore
from benchmarks.cold_start import ColdStart
from benchmarks.interleaved import Run, ratios, score
from benchmarks.peers import CHAN, OURS, SOLVERS
from benchmarks.report import Target, at_least, at_most, table
from benchmarks.workloads import Workload

FAR, TRACKING, SINGULAR = "far start", "tracking start", "targets at singular configurations"
HEADER = [
    "solver", "targets", "solved %", "gave up", "told success, but misses the tolerance", "or the limits", "median µs",
    "CPU mean µs", "p99 µs", "median / ours", "mean / ours",
]  # fmt: skip


@dataclass(frozen=True, eq=False)
class Measured:
    """What was measured with one arm and one workload.

    Attributes:
        arm, work: as in the tables.
        workload: what was asked.
        runs: solver → what it did.
        absent: solver → why there is none.
        in_a_row: how many targets each was given before the next one's turn.
    """

    arm: str
    work: str
    workload: Workload
    runs: dict[str, Run]
    absent: dict[str, str]
    in_a_row: int = 1

    def beside(self, peer: str) -> tuple[float | None, float | None]:
        """Return how many times longer the peer takes than ours, in the median and in the mean."""
        if OURS in self.runs and peer in self.runs:
            return ratios(self.runs[peer], self.runs[OURS])
        return None, None

    def solved(self) -> float | None:
        """Return what ours solved [%]."""
        return score(self.runs[OURS], self.workload).success if OURS in self.runs else None

    def table(self, solvers: Iterable[str] = SOLVERS) -> str:
        """Return the table of the solvers; one that is absent has its row too."""
        return table(HEADER, [self._row(name) for name in solvers])

    def _row(self, name: str) -> list[str]:
        if name in self.absent:
            return [name, f"**{self.absent[name]}**", *["–"] * (len(HEADER) - 2)]
        s = score(self.runs[name], self.workload)
        solved = f"{s.success:.2f}"
        failures = [f"**{count}**" if count else "0" for count in (s.gave_up, s.missed, s.outside)]
        times = [f"{s.median:.1f}", f"{s.mean:.1f}", f"{s.p99:.0f}"]
        compared = ["–" if ratio is None else f"{ratio:.2f}" for ratio in self.beside(name)]
        return [name, str(s.targets), solved if s.success == 100 else f"**{solved}**", *failures, *times, *compared]


def row_table(measured: Sequence[Measured]) -> str:
    """Return the times of several arms beside each other: median and mean [µs], and how many times ours both are."""
    header = ["solver", *(f"{m.arm}: median µs · CPU mean µs · both / ours" for m in measured)]
    return table(header, [[name, *(_times(m, name) for m in measured)] for name in SOLVERS])


def _times(measured: Measured, name: str) -> str:
    if name in measured.absent:
        return "–"
    s = score(measured.runs[name], measured.workload)
    compared = ["–" if ratio is None else f"{ratio:.2f}" for ratio in measured.beside(name)]
    failed = f" · **{s.targets - s.solved} of {s.targets} failed**" if s.solved < s.targets else ""
    return " · ".join([f"{s.median:.1f}", f"{s.mean:.1f}", *compared]) + failed


def single_targets(measured: Measured) -> list[Target]:
    """Return the targets of single calls."""
    arm, work = measured.arm, measured.work
    work += f", {measured.in_a_row} calls in a row" if measured.in_a_row > 1 else ""
    median, mean = measured.beside(CHAN)
    rows = [at_least(f"{work}, {arm}: solved inside the limits", 100, measured.solved(), " %")]
    if measured.work == FAR:
        rows.append(at_least(f"{work}, {arm}: median, beside {CHAN}", 3, median))
        rows.append(at_least(f"{work}, {arm}: mean, beside {CHAN}", 3, mean))
    if measured.work == TRACKING:
        rows.append(at_least(f"{work}, {arm}: median, beside {CHAN}", 2, median))
    return rows


def batch_targets(arm: str, work: str, batch: BatchScore) -> list[Target]:
    """Return the targets of batches."""
    rows = [
        at_least(f"batch, {work}, {arm}: solved inside the limits", 100, batch.solved, " %"),
        at_least(f"batch, {work}, {arm}: beside the loop of {CHAN}", 5 if work == FAR else 4, batch.ratio),
    ]
    if work == FAR:
        rows.append(at_most(f"batch, {work}, {arm}: of one target (an aim)", 15, batch.ours, " µs"))
    return rows


def batch_table(batches: dict[tuple[str, str], BatchScore]) -> str:
    """Return the times of batches."""
    header = ["arm", "start", "`solve_batch`, µs a target", "solved %", f"{CHAN}, µs a target", "solved %", "ratio"]
    return table(header, [[arm, work, *batch.cells()] for (arm, work), batch in batches.items()])


def start_targets(starts: tuple[ColdStart, ColdStart] | None) -> list[Target]:
    """Return the targets of the first call."""
    empty, filled = starts or (None, None)
    return [
        at_most("first call, nothing compiled yet", 6, empty and empty.seconds, " s"),
        at_least("messages that it compiles", 1, empty and float(bool(empty.message)), ""),
        at_most("first call of a process, compiled before", 0.5, filled and filled.seconds, " s"),
    ]


def start_table(starts: tuple[ColdStart, ColdStart]) -> str:
    """Return the times of the first call."""
    header = ["cache of compiled code", "first call [s]", "with imports and loading [s]", "told"]
    rows = [
        [name, f"{start.seconds:.2f}", f"{start.process:.2f}", start.message or "nothing"]
        for name, start in zip(("empty", "filled"), starts, strict=True)
    ]
    return table(header, rows)
