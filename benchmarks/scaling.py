"""How maps and scans scale: one process, two, and the overhead of a chunk: `python -m benchmarks.scaling`.

Writes benchmarks/results/scaling.md. Each worker takes one thread. On a machine that has something else to do the clock
of the wall says little: the time of the processors of the workers is written beside it.
"""

from benchmarks.one_thread import one_thread

if __name__ == "__main__":
    one_thread()

import os
import sys
from collections.abc import Callable, Iterator
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter, process_time
from typing import Any

import numpy as np

from benchmarks.arms import ur5
from benchmarks.report import absence, at_least, conditions, table, target_table, tell, write
from robotics1 import PoseTask, scan_singularities
from robotics1.chunks.workers import workers_of
from robotics1.workspaces import reachability_map

SEED = 20250117
POSITIONS, ORIENTATIONS = 3_000, 100
SAMPLES = 20_000_000
REPEATS = 3
EMPTY = 300  # chunks without work
CHUNK = 2**17  # poses
HEADER = ["work", "workers", "s with one", "s with two", "ratio", "s of the processors, one", "the same, two"]
COSTS = ["workers", "ms a chunk", "workers that stay 90 % busy", "ms of the processor", "workers by these"]
RULES = """\
The same map ({poses} poses of a UR5, position by position with {orientations} orientations) and the same scan
({samples} configurations) by one worker and by two, in turn, {repeats} times; the least time on the wall counts.
Workers are started and prepared before. All answers are compared bit by bit. Beside it stands the least time that the
processors of all workers were busy: two workers that add nothing to the work need as much together as one, and on a
machine of their own are then nearly twice as fast. Threads also wait for each other where nothing is compiled, which
that time does not show."""
OVERHEAD_RULES = """\
What handing out a chunk costs the one process that hands out: {empty} chunks with the arrays of {chunk} poses, 100
orientations at each position, and an answer of that size, or none as where workers write to the folder of the map
themselves, but no work. Such a chunk, the largest of a map, takes a
worker {seconds:.2f} s here; so the largest number of workers that one client keeps 90 % busy is 0.9 times the
quotient. The clock of the wall counts what else the machine did, the processor's time does not; of Dask it has that of
the scheduler."""


Opened = tuple[Any, Callable[[], list[int]]]  # an executor, and the numbers of its processes


@contextmanager
def threads(count: int) -> Iterator[Opened]:
    """Open so many threads."""
    with ThreadPoolExecutor(count) as executor:
        yield executor, lambda: [os.getpid()]


@contextmanager
def processes(count: int) -> Iterator[Opened]:
    """Open so many processes."""
    with ProcessPoolExecutor(count) as executor:
        yield executor, lambda: list(executor._processes)


@contextmanager
def dask(count: int) -> Iterator[Opened]:
    """Open a cluster of so many processes on this machine."""
    from distributed import Client, LocalCluster

    with (
        LocalCluster(n_workers=count, threads_per_worker=1, dashboard_address=":0", silence_logs=50) as cluster,
        Client(cluster, set_as_default=False) as client,
    ):
        yield client, lambda: [worker.process.pid for worker in cluster.workers.values()]


KINDS: dict[str, Callable[[int], Any]] = {"threads": threads, "processes": processes, "Dask": dask}


def the_map(executor: Any) -> Any:
    """Return the status of a map."""
    arm = ur5()
    positions = np.random.default_rng(SEED).uniform(-1, 1, (POSITIONS, 3)) * arm.robot.reach
    return reachability_map(arm.robot, PoseTask(), positions, ORIENTATIONS, executor=executor).status


def the_scan(executor: Any) -> Any:
    """Return the worst values of a scan."""
    return scan_singularities(ur5().robot, PoseTask(), samples=SAMPLES, executor=executor).worst_values


def answer_of_a_chunk(positions: Any) -> tuple[Any, ...]:
    """Return as much as a chunk of a map does."""
    k = len(positions)
    return np.zeros((k, 100), dtype=np.uint8), np.zeros((k, 100), dtype=np.uint8), np.zeros(k), np.zeros((k, 8))


def no_answer(positions: Any) -> None:
    """Return nothing, as for a chunk of a map that the worker has written to the map's folder."""


def overhead(executor: Any, work: Callable[[Any], Any]) -> tuple[float, float]:
    """Return the seconds that a chunk without work takes: on the wall, and of the processor of this process."""
    chunks = [np.zeros((CHUNK // 100, 3)) for _ in range(EMPTY)]
    with workers_of(executor) as workers:
        list(workers.in_order(work, iter(chunks[:20])))
        begin, busy = perf_counter(), process_time()
        list(workers.in_order(work, iter(chunks)))
        return (perf_counter() - begin) / EMPTY, (process_time() - busy) / EMPTY


def processor_seconds(numbers: list[int]) -> float:
    """Return how long the processors were busy with processes, themselves and for the system."""
    ticks = [Path(f"/proc/{number}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split() for number in numbers]
    return sum(int(fields[11]) + int(fields[12]) for fields in ticks) / os.sysconf("SC_CLK_TCK")


def best_times(work: Callable[[Any], Any], opened: list[Opened]) -> tuple[list[float], list[float]]:
    """Return of each of the workers the least seconds on the wall, and of the processors; the answers are compared."""
    answers = [work(executor) for executor, _ in opened]  # which prepares the workers
    if not all(np.array_equal(answer, answers[0]) for answer in answers):
        raise RuntimeError("the answers differ")
    walls: list[list[float]] = [[] for _ in opened]
    busy: list[list[float]] = [[] for _ in opened]
    for _ in range(REPEATS):
        for i, (executor, numbers) in enumerate(opened):
            before, begin = processor_seconds(numbers()), perf_counter()
            work(executor)
            walls[i].append(perf_counter() - begin)
            busy[i].append(processor_seconds(numbers()) - before)
    return [min(seconds) for seconds in walls], [min(seconds) for seconds in busy]


def main() -> None:
    """Measure, and write the tables."""
    begin, alone = process_time(), ThreadPoolExecutor(1)
    the_map(alone)
    begin = process_time()
    the_map(alone)
    chunk_seconds = (process_time() - begin) * CHUNK / (POSITIONS * ORIENTATIONS)
    rows, costs, speedups = [], [], {}
    for name, opened in KINDS.items():
        try:
            with opened(1) as one, opened(2) as two:
                for what, work in (("map", the_map), ("scan", the_scan)):
                    walls, busy = best_times(work, [one, two])
                    speedups[name, what] = walls[0] / walls[1]
                    numbers = [f"{seconds:.2f}" for seconds in (*walls, walls[0] / walls[1], *busy)]
                    rows.append([what, name, *numbers])
                    tell(" | ".join(rows[-1]))
                for how, empty in (("", answer_of_a_chunk), (", map in a shared folder", no_answer)):
                    cost = overhead(two[0], empty)
                    texts = [text for s in cost for text in (f"{1000 * s:.2f}", f"{0.9 * chunk_seconds / s:,.0f}")]
                    costs.append([name + how, *texts])
        except ImportError as error:
            rows.append(["–", name, f"**{absence(error)}**", *["–"] * 4])
    target = at_least("two processes beside one, map", 1.8, speedups["processes", "map"])
    parts = [
        "# Scaling",
        conditions("python -m benchmarks.scaling", SEED) + f" Load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores.",
        "## Targets\n\n" + target_table([target, at_least("the same, scan", 1.8, speedups["processes", "scan"])]),
        "## Two workers beside one\n\n"
        + RULES.format(
            poses=f"{POSITIONS * ORIENTATIONS:,}", orientations=ORIENTATIONS, samples=f"{SAMPLES:,}", repeats=REPEATS
        ),
        table(HEADER, rows),
        "## The overhead of a chunk\n\n"
        + OVERHEAD_RULES.format(empty=EMPTY, chunk=f"{CHUNK:,}", seconds=chunk_seconds),
        table(COSTS, costs),
    ]
    tell(f"written: {write('scaling', *parts)}")


if __name__ == "__main__":
    sys.exit(main())
