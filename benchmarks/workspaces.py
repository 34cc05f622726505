"""Workspaces beside sampling, and shares by orientation beside inverse kinematics: `python -m benchmarks.workspaces`.

Writes benchmarks/results/workspaces.md; with --quick less is asked, and it is printed instead.
"""

from benchmarks.one_thread import one_thread

if __name__ == "__main__":
    one_thread()

import argparse
import sys
from collections.abc import Iterator
from time import monotonic, process_time

import numpy as np
import pinocchio as pin

from benchmarks.arms import Arm, Array, arm_of_text, panda, ur5
from benchmarks.peers import Solver, make_solver
from benchmarks.peers.forward_sampling import Sampler, by_loop, samplers
from benchmarks.report import Target, at_most, conditions, table, target_table, tell, write
from robotics1 import PoseTask, PositionTask
from robotics1.workspaces import PoseStatus, ReachabilityMap, extreme_reach, reachability_map, workspace

SEED = 20250116
STEP = 0.05  # [m], of the grids
DRAWN = 5000  # configurations at once
BUDGET, QUICK_BUDGET = 30.0, 3.0  # seconds of wall clock that each peer gets for each arm in each table
POSITIONS, ORIENTATIONS = 24, 6
IK_PEERS = ("TRAC-IK (pytracik), 50 ms", "Pinocchio, damped least squares in Python")
REACH_STARTS = 20_000
KNOWN = "3R with limits"  # the arm whose boundary is known
LIMITED = """<robot name="3R"><link name="base"/>
<link name="one"/><link name="two"/><link name="three"/><link name="tip"/>
<joint name="q1" type="revolute"><parent link="base"/><child link="one"/><origin xyz="0 0 0.4"/><axis xyz="0 0 1"/>
<limit lower="-2.5" upper="2.5" velocity="1" effort="1"/></joint>
<joint name="q2" type="revolute"><parent link="one"/><child link="two"/><origin xyz="0.1 0 0"/><axis xyz="0 -1 0"/>
<limit lower="-0.6" upper="1.9" velocity="1" effort="1"/></joint>
<joint name="q3" type="revolute"><parent link="two"/><child link="three"/><origin xyz="0.5 0 0"/><axis xyz="0 -1 0"/>
<limit lower="-2.4" upper="0.8" velocity="1" effort="1"/></joint>
<joint name="end" type="fixed"><parent link="three"/><child link="tip"/><origin xyz="0.4 0 0"/></joint></robot>"""
VOLUMES = """\
The volume that the tool reaches, whatever its orientation. *Exact* is `workspace`, where the boundary is known. A map
asks the centre of each cell of a grid of {step:g} m. Sampling draws configurations uniform in the limits, in the same
processor time as the map and in ten times as much, but {budget:g} s of wall clock at most, and counts the cells that
the tool falls into: too few where configurations are rare, and too many along the boundary, where a cell counts whose
centre is out of reach. The share is of the cells of our map; *not in our map* are cells that were met although the map
leaves them out, whose centres are thus out of reach: they are along the boundary."""
SHARES = """\
{positions} positions uniform in a cube of half the arm's reach to each side, each with the same {orientations}
orientations: of each orientation the share of positions at which it is reached. A peer is right where Pinocchio
verifies its answer inside the limits. *Wrongly out of reach* counts poses that we call proven out of reach and the peer
reaches; *not found by us* those it reaches and we do not find; *given up* those that we reach and the peer does not.
Each peer has {budget:g} s of wall clock for each arm; *asked* is how many of the poses it came to."""
REACHES = """\
How far the tool gets from the base, as certified by `extreme_reach` in {seconds:g} s of wall clock at most, beside the
farthest of {starts:,} random configurations."""


def volumes(arm: Arm, step: float, budget: float) -> list[list[str]]:
    """Return the rows of one arm: its exact workspace, our map, and sampling."""
    rows, task = [], PositionTask()
    reachability_map(arm.robot, task, step)  # compiles what as many poses need
    begin = process_time()
    known = reachability_map(arm.robot, task, step)
    seconds = process_time() - begin
    if arm.name == KNOWN:
        begin = process_time()
        exact = workspace(arm.robot, task)
        took = f"{process_time() - begin:.2f}"
        rows.append([arm.name, "robotics1 `workspace`, exact", took, f"{exact.volume:.4f}", "–", "–"])
    inside = known.on_grid(known.reached[:, 0])
    rows.append([arm.name, "robotics1 `reachability_map`", f"{seconds:.2f}", f"{known.volume:.4f}", "100 %", "–"])
    low = np.array([axis[0] for axis in known.grid or ()]) - step / 2
    for name, sampler in samplers(arm).items():
        if isinstance(sampler, str):
            rows.append([arm.name, name, f"**{sampler}**", "–", "–", "–"])
            continue
        for took, met in sampled(arm, sampler, inside.shape, low, step, (seconds, 10 * seconds), budget):
            found = f"{100 * (met & inside).sum() / inside.sum():.1f} %"
            rows.append([arm.name, name, took, f"{met.sum() * step**3:.4f}", found, str((met & ~inside).sum())])
    return rows


def sampled(
    arm: Arm, sampler: Sampler, shape: tuple[int, ...], low: Array, step: float, ends: tuple[float, ...], budget: float
) -> Iterator[tuple[str, Array]]:
    """Yield the seconds, and which cells the tool was in until then; the budget is wall clock."""
    met, rng = np.zeros(shape, dtype=bool), np.random.default_rng(SEED)
    sampler(rng.uniform(arm.robot.lower, arm.robot.upper, (2, arm.robot.nq)))
    begin, stop = process_time(), monotonic() + budget
    for end in ends:
        while process_time() - begin < end and monotonic() < stop:
            q = rng.uniform(arm.robot.lower, arm.robot.upper, (DRAWN, arm.robot.nq))
            met[tuple(((sampler(q) - low) / step).astype(int).T)] = True
        took = process_time() - begin
        yield f"{took:.2f}" + (" (budget)" if took < end else ""), met.copy()


def shares(arm: Arm, positions: int, budget: float) -> tuple[list[list[str]], int]:
    """Return the shares of the positions that are reached with each orientation, ours and those of peers, and how many
    poses were called out of reach wrongly.
    """
    rng = np.random.default_rng(SEED)
    places = rng.uniform(-0.5, 0.5, (positions, 3)) * arm.robot.reach
    known = reachability_map(arm.robot, PoseTask(), places, ORIENTATIONS)
    rows = [[arm.name, "robotics1 `reachability_map`", *_percent(known.reached), str(known.status.size), "–", "–", "–"]]
    wrong = 0
    for name in IK_PEERS:
        solver = make_solver(name, arm)
        if isinstance(solver, str):
            rows.append([arm.name, name, *["–"] * ORIENTATIONS, "–", f"**{solver}**", "–", "–"])
            continue
        reached, asked = by_peer(arm, solver, known, budget)
        never = int((reached & (known.status == PoseStatus.UNREACHABLE)).sum())
        unseen = int((reached & (known.status == PoseStatus.NOT_FOUND)).sum())
        given_up = int((known.reached & asked & ~reached).sum())
        rows.append(
            [arm.name, name, *_percent(reached, asked), str(asked.sum()), str(never), str(unseen), str(given_up)]
        )
        wrong += never
    return rows, wrong


def by_peer(arm: Arm, solver: Solver, known: ReachabilityMap, budget: float) -> tuple[Array, Array]:
    """Return which poses (k, o) of a map a peer reaches, and which it was asked within its budget of wall clock."""
    middle, stop = 0.5 * (arm.robot.lower + arm.robot.upper), monotonic() + budget
    reached, asked = np.zeros((2, *known.status.shape), dtype=bool)
    for i, o in np.ndindex(reached.shape):
        if monotonic() > stop:
            break
        T = pin.SE3(known.orientations[o], known.positions[i])
        q = solver.solve(solver.convert(T), middle)
        asked[i, o] = True
        reached[i, o] = q is not None and arm.meets(np.asarray(q), T) and arm.inside(np.asarray(q))
    return reached, asked


def reaches(arm: Arm, seconds: float) -> list[str]:
    """Return how far an arm reaches, proven and sampled."""
    begin = process_time()
    found = extreme_reach(arm.robot, PositionTask(), time_limit=seconds)
    took = process_time() - begin
    q = np.random.default_rng(SEED).uniform(arm.robot.lower, arm.robot.upper, (REACH_STARTS, arm.robot.nq))
    far = float(np.linalg.norm(by_loop(arm)(q), axis=1).max())
    return [arm.name, f"{found.value:.6f}", f"{found.bound:.6f}", f"{found.gap:.1e}", f"{took:.2f}", f"{far:.6f}"]


def _percent(reached: Array, asked: Array | None = None) -> list[str]:
    counts = np.full(reached.shape[1], len(reached)) if asked is None else np.maximum(asked.sum(axis=0), 1)
    return [f"{100 * share:.0f} %" for share in reached.sum(axis=0) / counts]


def main() -> None:
    """Measure, and write the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="coarser grids, fewer poses; write nothing")
    quick = parser.parse_args().quick
    step, positions, seconds, budget = (3 * STEP, 3, 0.5, QUICK_BUDGET) if quick else (STEP, POSITIONS, 20.0, BUDGET)
    arms = (arm_of_text(KNOWN, LIMITED, "base", "tip"), ur5(), panda())
    volume_rows = [row for arm in arms for row in volumes(arm, step, budget)]
    share_rows, wrong = [], 0
    for arm in arms[1:]:
        rows, more = shares(arm, positions, budget)
        share_rows, wrong = share_rows + rows, wrong + more
    targets: list[Target] = [at_most("poses wrongly called out of reach", 0, float(wrong), "")]
    numbers = [f"{i + 1}" for i in range(ORIENTATIONS)]
    columns = ["arm", "way", *numbers, "asked", "wrongly out of reach", "not found by us", "given up"]
    parts = [
        "# Workspaces",
        conditions("python -m benchmarks.workspaces", SEED),
        f"## Targets\n\n{target_table(targets)}",
        "## Volumes\n\n" + VOLUMES.format(step=step, budget=budget),
        table(["arm", "way", "s", "m³", "of our cells", "not in our map"], volume_rows),
        "## Shares by orientation\n\n" + SHARES.format(positions=positions, orientations=ORIENTATIONS, budget=budget),
        table(columns, share_rows),
        "## Reach\n\n" + REACHES.format(seconds=seconds, starts=REACH_STARTS),
        table(["arm", "value m", "bound m", "gap m", "s", "of random ones m"], [reaches(arm, seconds) for arm in arms]),
    ]
    tell("\n\n".join(parts) if quick else f"written: {write('workspaces', *parts)}")


if __name__ == "__main__":
    sys.exit(main())
