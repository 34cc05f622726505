"""All inverse kinematics solutions beside the peers, in one run: `python -m benchmarks.all_solutions`.

Writes benchmarks/results/all_solutions.md; with --quick few targets are asked, and it is printed instead.
"""

from benchmarks.one_thread import one_thread

if __name__ == "__main__":
    one_thread()

import argparse
import atexit
import shutil
import tempfile
import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path
from time import perf_counter
from typing import NamedTuple

import numpy as np
import pinocchio as pin

from benchmarks.arms import Arm, Array, ur5
from benchmarks.peers import NotThisArmError
from benchmarks.peers.every_solution import (
    AllSolver,
    make_eaik,
    make_ik_geo,
    make_jaik,
    make_ours,
    make_ssik,
    make_ssik_prebuilt,
)
from benchmarks.report import Target, absence, at_least, at_most, conditions, table, target_table, tell, write
from benchmarks.root_counts import AGAINST, HEADER, against_the_roots
from benchmarks.singular_targets import singular_configurations
from robotics1 import PlanarPoseTask, PoseTask, PositionTask, Robot, load_robot, robot_from_dh
from robotics1.ik import IKStatus, SolutionSolver
from robotics1.tasks.task import Task

SEED, COUNT, QUICK, BATCH, SINGULAR = 0, 1000, 30, 10_000, 100
LAST, SAMPLES = 6, 25  # the joint of a Panda that is sampled, and how often
OURS = "robotics1 `SolutionSolver`"
FROM_URDF = "ssik, from the URDF"
SOLVERS: dict[str, Callable[[Arm], AllSolver]] = {
    OURS: make_ours,
    "ssik prebuilt": make_ssik_prebuilt,
    FROM_URDF: make_ssik,
    "EAIK": make_eaik,
    "IK-Geo": make_ik_geo,
    "jaik, Numba": make_jaik,
}
SLOW = 20e-3  # [s] a call, beyond which every tenth target is asked
H, SIXTH = np.pi / 2, np.pi / 6
E2, D4, D5, D6 = 0.0098, 0.2073 + 0.0741 * np.tan(SIXTH) / np.sin(2 * SIXTH), 0.0856, 0.2028
ROWS = {  # a, α, d
    "Puma 560": [(0, H, 0), (0.4318, 0, 0), (0.0203, -H, 0.15005), (0, H, 0.4318), (0, -H, 0), (0, 0, 0.0563)],
    "Jaco-like 6R": [
        (0, H, 0.2755), (0.41, np.pi, 0), (0, H, -E2), (0, 2 * SIXTH, -D4), (0, 2 * SIXTH, -D5), (0, np.pi, -D6),
    ],
    "random 6R": np.random.default_rng(3).uniform(-1, 1, (6, 3)).round(3).tolist(),
}  # fmt: skip
GENERAL = ("Jaco-like 6R", "random 6R")
SMALL: dict[str, tuple[list[tuple[float, float, float]], Task]] = {
    "2R, a point of the plane": ([(1.2, 0, 0), (0.8, 0, 0)], PositionTask("xy")),
    "3R, a planar pose": ([(1.2, 0, 0), (0.8, 0, 0), (0.3, 0, 0)], PlanarPoseTask()),
    "anthropomorphic 3R, a point": ([(0, H, 0.4), (0.5, 0, 0), (0.35, 0, 0)], PositionTask()),
    "orthogonal 3R, a point": ([(1, -H, 0), (2, H, 1), (1.5, 0, 0)], PositionTask()),
}
RULES = """\
All solvers take turns at each target, the pose of a uniform q in (−π, π), in random order, and are called twice before;
a solver that takes more than 20 ms gets every tenth target. Verified: Pinocchio's forward kinematics at each solution
is within 1e-5 m and 1e-4 rad of the target. Counts are of solutions that differ by more than 1e-3 rad modulo whole
turns, outside the timed calls, and are compared at the same targets with ours."""


def dh_robot(rows: list[tuple[float, float, float]]) -> Robot:
    """Return an arm of revolute joints without limits from a, α, d."""
    return robot_from_dh([("R", a, alpha, d, 0.0) for a, alpha, d in rows])


def arm_of_rows(name: str) -> Arm:
    """Return an arm with its URDF in a file."""
    robot = dh_robot(ROWS[name])
    folder = Path(tempfile.mkdtemp())
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    path = folder / "arm.urdf"
    path.write_text(robot.urdf, encoding="utf-8")
    root = ET.fromstring(robot.urdf)
    children = {joint.find("child").get("link") for joint in root.iter("joint")}  # type: ignore[union-attr]
    base = next(link.get("name") for link in root.iter("link") if link.get("name") not in children)
    return Arm(name, robot, str(base), str(robot.tool), robot.urdf, path)


def distinct(q: Array) -> int:
    """Return how many rows differ modulo whole turns."""
    kept: list[Array] = []
    for p in q:
        if all(np.abs(np.angle(np.exp(1j * (p - other)))).max() > 1e-3 for other in kept):
            kept.append(p)
    return len(kept)


class Measured(NamedTuple):
    """The rows of a table, the figures that targets are about, and of each solver how many solutions it has at which q
    (k, 6).
    """

    rows: list[list[str]]
    figures: dict[str, float | None]
    q: Array
    counts: dict[str, dict[int, int]]


def measure(arm: Arm, count: int) -> Measured:
    """Return what the solvers say about an arm."""
    rng = np.random.default_rng(SEED)
    q = rng.uniform(-np.pi, np.pi, (count, 6))
    poses = [arm.pose(p) for p in q]
    made: dict[str, AllSolver] = {}
    absent: dict[str, str] = {}
    for name, make in SOLVERS.items():
        try:
            made[name] = make(arm)
        except ImportError as error:
            absent[name] = absence(error)
        except NotThisArmError as error:
            absent[name] = str(error)
        except KeyError:
            absent[name] = "does not have this arm"
    times: dict[str, dict[int, float]] = {name: {} for name in made}
    answers: dict[str, dict[int, Array]] = {name: {} for name in made}
    every = {name: _every(solver, poses[:2]) for name, solver in made.items()}
    for i, T in enumerate(poses):
        for name in rng.permutation(list(made)):
            solver = made[name]
            if i % every[name]:
                continue
            target = solver.convert(T)
            begin = perf_counter()
            found = solver.solve(target)
            times[name][i] = perf_counter() - begin
            answers[name][i] = np.asarray(solver.read(found), dtype=float).reshape(-1, 6)
    counts = {name: {i: distinct(found) for i, found in q.items()} for name, q in answers.items()}
    rows, figures = _rows(arm, poses, times, answers, counts, absent)
    return Measured(rows, figures, q, counts)


def _every(solver: AllSolver, poses: list[pin.SE3]) -> int:
    for T in poses:
        begin = perf_counter()
        solver.solve(solver.convert(T))
        seconds = perf_counter() - begin
    return 10 if seconds > SLOW else 1


def _rows(
    arm: Arm,
    poses: list[pin.SE3],
    times: dict[str, dict[int, float]],
    answers: dict[str, dict[int, Array]],
    counts: dict[str, dict[int, int]],
    absent: dict[str, str],
) -> tuple[list[list[str]], dict[str, float | None]]:
    rows, figures = [], {}
    for name in SOLVERS:
        if name in absent:
            rows.append([name, f"**{absent[name]}**", *["–"] * 8])
            continue
        at = list(times[name])
        micro = 1e6 * np.array([times[name][i] for i in at])
        ours = 1e6 * np.array([times[OURS][i] for i in at])
        wrong = sum(not arm.meets(q, poses[i]) for i in at for q in answers[name][i])
        fewer = sum(counts[name][i] < counts[OURS][i] for i in at)
        more = sum(counts[name][i] > counts[OURS][i] for i in at)
        ratio = float(np.median(micro) / np.median(ours))
        mean = float(np.mean([counts[name][i] for i in at]))
        told = [f"{mean:.2f}", str(wrong), str(fewer), str(more)]
        spans = [f"{np.median(micro):.1f}", f"{micro.mean():.1f}", f"{np.percentile(micro, 99):.0f}", f"{ratio:.2f}"]
        rows.append([name, str(len(at)), *told, *spans])
        figures[name] = float(np.median(micro))
        figures[name + " equal"] = 100.0 * (1 - (fewer + more) / len(at))
    return rows, figures


def small_arms(count: int) -> tuple[str, list[Target]]:
    """Return the table and the targets of arms of two and three joints."""
    rows, targets = [], []
    for name, (links, task) in SMALL.items():
        robot = dh_robot(links)
        solver, rng = SolutionSolver(robot, task), np.random.default_rng(SEED)
        goals = [task.value(robot, q) for q in rng.uniform(-np.pi, np.pi, (count, robot.nq))]
        spans = []
        for goal in goals:
            begin = perf_counter()
            solver(goal)
            spans.append(1e6 * (perf_counter() - begin))
        rows.append([name, f"{np.median(spans):.1f}", f"{np.mean(spans):.1f}"])
        targets.append(at_most(f"{name}: median of a call", 25, float(np.median(spans)), " µs"))
    return table(["arm and task", "median µs", "mean µs"], rows), targets


def batch_and_singular(arm: Arm, batch: int, singular: int) -> list[Target]:
    """Return the targets about a batch, preparation and singular poses of the UR5."""
    task, rng = PoseTask(), np.random.default_rng(SEED)
    begin = perf_counter()
    solver = SolutionSolver(arm.robot, task)
    prepared = perf_counter() - begin
    poses = [arm.pose(q) for q in rng.uniform(-np.pi, np.pi, (batch, 6))]
    solver.solve_batch(poses)  # as every other call: twice before it counts
    solver.solve_batch(poses)
    begin = perf_counter()
    found = solver.solve_batch(poses)
    each = 1e6 * (perf_counter() - begin) / batch
    tell(f"batch: {found.explain()}; {len(found.careful)} targets with more care")
    told = 0
    for q in singular_configurations(arm, singular, rng):
        answer = solver(arm.pose(q))
        near = np.abs(np.angle(np.exp(1j * (answer.q - q)))).max(axis=1).min(initial=np.inf)
        curve = answer.status is IKStatus.INFINITE
        told += curve or (answer.status is IKStatus.BOUNDARY and near < 1e-5)
    return [
        at_most("UR5: preparation, compiled before", 0.3, prepared, " s"),
        at_most(f"UR5: a pose in a batch of {batch}, one core", 6, each, " µs"),
        at_least(f"UR5: {singular} singular poses told to be boundaries or families", 100, 100 * told / singular, " %"),
    ]


def samples_of_redundancy(count: int) -> Target:
    """Return the target about a Panda: all solutions at 25 values of its last joint."""
    robot, task, rng = load_robot("panda", tool="panda_hand_tcp"), PoseTask(), np.random.default_rng(SEED)
    values = np.linspace(robot.lower[LAST], robot.upper[LAST], SAMPLES)
    joint, spans = robot.joint_names[LAST], []
    solver = SolutionSolver(robot, task, locked={joint: 0.0})
    for q in rng.uniform(robot.lower, robot.upper, (count, robot.nq)):
        pose = task.value(robot, q)
        begin = perf_counter()
        solver.solve_at(pose, joint, values)
        spans.append(1e6 * (perf_counter() - begin))
    return at_most(f"Panda: a pose with {SAMPLES} samples of redundancy", 200, float(np.median(spans[2:])), " µs")


def main() -> None:
    """Measure, and write the results."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="few targets, printed instead of written")
    quick = parser.parse_args().quick
    count = QUICK if quick else COUNT
    parts, targets = [], []
    header = [
        "solver", "targets", "solutions, mean", "not verified", "fewer than ours", "more than ours", "median µs",
        "mean µs", "p99 µs", "median / ours",
    ]  # fmt: skip
    arms = [ur5(), *map(arm_of_rows, ROWS)]
    for arm in arms:
        found = measure(arm, count)
        parts += [f"## {arm.name}", table(header, found.rows)]
        tell(parts[-2] + "\n\n" + parts[-1])
        most = 2000 if arm.name in GENERAL else 40
        targets.append(at_most(f"{arm.name}: median of a call", most, found.figures.get(OURS), " µs"))
        equal = found.figures.get(FROM_URDF + " equal")
        targets.append(at_least(f"{arm.name}: counts equal to ssik's", 100, equal, " %"))
        if arm.name in GENERAL:
            rows, right = against_the_roots(ROWS[arm.name], found.q, found.counts, OURS)
            parts += [AGAINST, table(HEADER, rows)]
            tell(parts[-1])
            targets.append(at_least(f"{arm.name}: our counts those of all 16 roots", 100, right[OURS], " %"))
    text, some = small_arms(count)
    targets += some + batch_and_singular(arms[0], 20 * count if quick else BATCH, QUICK if quick else SINGULAR)
    targets.append(samples_of_redundancy(count))
    parts = [
        "# All inverse kinematics solutions", conditions("python -m benchmarks.all_solutions", SEED),
        target_table(targets), RULES, *parts, "## Few joints", text,
    ]  # fmt: skip
    tell(target_table(targets))
    if not quick:
        write("all_solutions", *parts)


if __name__ == "__main__":
    main()
