"""Reachability maps of a UR5 and a Panda, on one thread: `python -m benchmarks.maps`.

Writes benchmarks/results/maps.md; with --quick fewer poses are asked, and it is printed instead.
"""

from benchmarks.one_thread import one_thread

if __name__ == "__main__":
    one_thread()

import argparse
import sys
from dataclasses import dataclass
from time import process_time

import numpy as np
import pinocchio as pin

from benchmarks.arms import Arm, Array, panda, ur5
from benchmarks.peers import Solver, make_solver
from benchmarks.report import Target, at_least, at_most, conditions, table, target_table, tell, write
from robotics1 import PoseTask
from robotics1.workspaces import PoseStatus, ReachabilityMap, best_placements, reachability_map

SEED = 20250116
ORIENTATIONS = 100
POSITIONS = 10_000
SAME_POSES = 100  # that the peers are asked, of each kind
CELLS = 0.1  # [m], of a grid
QUICK = 20  # how many times fewer
WANTED = {"UR5": 15.0, "Panda": 30.0}  # [s] for 10⁶ poses
PEERS = ("TRAC-IK (pytracik), 50 ms", "ssik prebuilt, all solutions", "Pinocchio, damped least squares in Python")
HEADER = ["arm", "poses", "µs a pose", "s for 10⁶", "reached", "proven out of reach", "not found"]
RULES = """\
Times are of the processor, of one thread; the kernels are compiled before. *In the cube*: positions uniform in a cube
of the arm's reach to each side, each with {orientations} orientations spread evenly over all; {positions} positions.
*Reachable*: poses of configurations uniform in the joint limits, all in reach, one orientation each."""
PEER_RULES = """\
The same {count} poses of each kind for all, in turn; µs are of the processor, of one pose, and the share is of poses
with an answer that Pinocchio verifies inside the limits. What we call out of reach and a peer reaches would be an
error: that is counted in the last column."""
SAMPLING_RULES = """\
The usual way to a map, forward: configurations uniform in the limits, Pinocchio's position of each in a Python loop,
and the cells of a grid of {cells} m that it falls into. Ours asks the centre of each cell, whatever the orientation.
After as many seconds as our map took, and after ten times as many, the share of the cells whose centre is in reach that
the samples have met:"""


@dataclass(frozen=True)
class Measured:
    """One map, with the seconds it took."""

    arm: str
    kind: str
    found: ReachabilityMap
    seconds: float

    @property
    def microseconds(self) -> float:
        """For a pose."""
        return 1e6 * self.seconds / self.found.status.size

    def row(self) -> list[str]:
        """Return the cells of its row."""
        n, counts = self.found.status.size, self.found.counts()
        shares = [
            f"{100 * counts[status] / n:.2f} %"
            for status in (PoseStatus.REACHED, PoseStatus.UNREACHABLE, PoseStatus.NOT_FOUND)
        ]
        return [f"{self.arm}, {self.kind}", f"{n:,}", f"{self.microseconds:.1f}", f"{self.microseconds:.1f}", *shares]


def measured(arm: Arm, kind: str, positions: Array, orientations: object) -> Measured:
    """Return a map with its time."""
    reachability_map(arm.robot, PoseTask(), positions[:1], 2)  # compiles, and prepares
    begin = process_time()
    found = reachability_map(arm.robot, PoseTask(), positions, orientations)
    return Measured(arm.name, kind, found, process_time() - begin)


def reachable_poses(arm: Arm, count: int, rng: np.random.Generator) -> list[pin.SE3]:
    """Return poses of configurations inside the limits."""
    return [arm.pose(arm.random(rng)) for _ in range(count)]


def of_poses(arm: Arm, poses: list[pin.SE3]) -> tuple[Array, float]:
    """Return the statuses (n,) of poses, one orientation each, and the seconds."""
    places = np.array([T.homogeneous for T in poses])
    best_placements(arm.robot, PoseTask(), [np.eye(4)], places[:1], moves="poses")  # compiles, and prepares
    begin = process_time()
    found = best_placements(arm.robot, PoseTask(), [np.eye(4)], places, moves="poses")
    return found.status[:, 0], process_time() - begin


def by_peer(solver: Solver, arm: Arm, poses: list[pin.SE3], ours: Array) -> tuple[float, float, int]:
    """Return µs a pose, the share that is reached, and how many of those we called out of reach."""
    middle = 0.5 * (arm.robot.lower + arm.robot.upper)
    targets, reached, seconds = [solver.convert(T) for T in poses], [], 0.0
    for target, T in zip(targets, poses, strict=True):
        begin = process_time()
        q = solver.solve(target, middle)
        seconds += process_time() - begin
        reached.append(q is not None and arm.meets(np.asarray(q), T) and arm.inside(np.asarray(q)))
    wrong = int(np.count_nonzero(np.array(reached) & (ours == PoseStatus.UNREACHABLE)))
    return 1e6 * seconds / len(poses), 100 * float(np.mean(reached)), wrong


def peers(arm: Arm, poses: list[pin.SE3], kind: str) -> list[list[str]]:
    """Return the rows of us and of the peers for the same poses."""
    ours, seconds = of_poses(arm, poses)
    share = 100 * float(np.mean(ours == PoseStatus.REACHED))
    first = f"{arm.name}, {kind}"
    rows = [[first, "robotics1 map", f"{1e6 * seconds / len(poses):.1f}", f"{share:.1f} %", "–"]]
    for name in PEERS:
        solver = make_solver(name, arm)
        if isinstance(solver, str):
            rows.append([first, name, f"**{solver}**", "–", "–"])
            continue
        microseconds, reached, wrong = by_peer(solver, arm, poses, ours)
        rows.append([first, name, f"{microseconds:,.0f}", f"{reached:.1f} %", str(wrong)])
    return rows


def sampled(arm: Arm, quick: bool) -> list[str]:
    """Return our map of positions beside sampling."""
    step = CELLS * (3 if quick else 1)
    reachability_map(arm.robot, PoseTask(), 10 * step)
    begin = process_time()
    found = reachability_map(arm.robot, PoseTask(), step)
    seconds = process_time() - begin
    inside = found.on_grid(found.reached[:, 0])
    low = np.array([axis[0] for axis in found.grid or ()]) - step / 2
    model, rng = arm.robot.model, np.random.default_rng(SEED)
    data, frame = model.createData(), model.getFrameId(arm.tool)
    met, shares, begin = np.zeros(inside.shape, dtype=bool), [], process_time()
    for end in (seconds, 10 * seconds):
        while process_time() - begin < end:
            for q in rng.uniform(arm.robot.lower, arm.robot.upper, (1000, arm.robot.nq)):
                pin.forwardKinematics(model, data, q)
                p = pin.updateFramePlacement(model, data, frame).translation
                met[tuple(((p - low) / step).astype(int))] = True
        shares.append(f"{100 * float((met & inside).sum() / inside.sum()):.1f} %")
    return [arm.name, f"{inside.size:,}", f"{seconds:.2f}", f"{int(inside.sum()):,}", *shares]


def targets_of(all_measured: list[Measured]) -> list[Target]:
    """Return the targets of the project beside what was measured."""
    targets = [
        at_most(f"10⁶ poses of a {one.arm}, {one.kind}", WANTED[one.arm], one.microseconds, " s")
        for one in all_measured
    ]
    found = [100 * float(one.found.reached.mean()) for one in all_measured if one.kind == "reachable"]
    return [*targets, at_least("of what is reachable, reached, at least", 99.9, min(found), " %")]


def main() -> None:
    """Measure, and write the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} times fewer poses; write nothing")
    fewer = QUICK if (quick := parser.parse_args().quick) else 1
    rng, maps, rows, sampling = np.random.default_rng(SEED), [], [], []
    count = SAME_POSES // fewer
    for arm in (ur5(), panda()):
        cube = rng.uniform(-1, 1, (POSITIONS // fewer, 3)) * arm.robot.reach
        maps.append(measured(arm, "in the cube", cube, ORIENTATIONS))
        poses = reachable_poses(arm, POSITIONS // fewer, rng)
        status, seconds = of_poses(arm, poses)
        maps.append(_as_measured(arm, poses, status, seconds))
        some = maps[-2].found
        drawn = [pin.SE3(some.orientations[i % ORIENTATIONS], some.positions[i]) for i in range(min(count, len(cube)))]
        rows += peers(arm, poses[:count], "reachable") + peers(arm, drawn, "in the cube")
        sampling.append(sampled(arm, quick))
    parts = [
        "# Reachability maps",
        conditions("python -m benchmarks.maps", SEED),
        f"## Targets\n\n{target_table(targets_of(maps))}",
        "## Measured\n\n" + RULES.format(orientations=ORIENTATIONS, positions=f"{POSITIONS // fewer:,}"),
        table(HEADER, [one.row() for one in maps]),
        "## Beside inverse kinematics of others\n\n" + PEER_RULES.format(count=count),
        table(["poses", "way", "µs a pose", "reached", "wrongly called out of reach"], rows),
        "## Beside sampling\n\n" + SAMPLING_RULES.format(cells=CELLS),
        table(["arm", "cells", "s of our map", "in reach", "met after 1 ×", "met after 10 ×"], sampling),
    ]
    tell("\n\n".join(parts) if quick else f"written: {write('maps', *parts)}")


def _as_measured(arm: Arm, poses: list[pin.SE3], status: Array, seconds: float) -> Measured:
    """Return statuses of single poses as a map of one orientation."""
    k = len(poses)
    nothing = np.full(k, np.nan)
    found = ReachabilityMap(
        arm.name, arm.robot.joint_names, PoseTask().row_names, "xyz", np.array([T.translation for T in poses]),
        np.eye(3)[None], None, status[:, None], None, nothing, nothing, nothing[:, None], np.zeros(k, dtype=np.int32),
    )  # fmt: skip
    return Measured(arm.name, "reachable", found, seconds)


if __name__ == "__main__":
    sys.exit(main())
