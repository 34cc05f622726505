"""How long exact answers take, beside the usual route in SymPy: J by differentiation, det, simplify.

Run as `python benchmarks/formulas.py`; writes benchmarks/results/formulas.md.
"""

import multiprocessing
import platform
import statistics
import sys
import time
from collections.abc import Callable
from importlib.metadata import version
from math import pi
from pathlib import Path
from typing import Any

import numpy as np

LIMIT = 60.0  # of the usual route [s]
REPEATS = 5
RESULT = Path(__file__).parent / "results" / "formulas.md"
H = pi / 2

# robot → (DH rows, values of the lengths, rows of the task)
ARMS: dict[str, tuple[list[tuple[Any, ...]], dict[str, float], str]] = {
    "planar 3R": (
        [("R", name, 0, 0, 0) for name in ("l1", "l2", "l3")],
        {"l1": 0.5, "l2": 0.4, "l3": 0.3},
        "planar pose",
    ),
    "anthropomorphic 3R": (
        [("R", 0, H, "d1", 0), ("R", "a2", 0, 0, 0), ("R", "a3", 0, 0, 0)],
        {"d1": 0.3, "a2": 0.5, "a3": 0.4},
        "position",
    ),
    "Stanford": (
        [("R", 0, -H, "d1", 0), ("R", 0, H, "d2", 0), ("P", 0, 0, 0, 0), ("R", 0, -H, 0, 0), ("R", 0, H, 0, 0),
         ("R", 0, 0, "d6", 0)],
        {"d1": 0.4, "d2": 0.15, "d6": 0.26},
        "pose",
    ),
    "Puma 560": (
        [("R", 0, H, 0, 0), ("R", "a2", 0, 0, 0), ("R", "a3", -H, "d3", 0), ("R", 0, H, "d4", 0), ("R", 0, -H, 0, 0),
         ("R", 0, 0, 0, 0)],
        {"a2": 0.43, "a3": 0.02, "d3": 0.15, "d4": 0.43},
        "pose",
    ),
    "UR5": (
        [("R", 0, H, "d1", 0), ("R", "a2", 0, 0, 0), ("R", "a3", 0, 0, 0), ("R", 0, H, "d4", 0),
         ("R", 0, -H, "d5", 0), ("R", 0, 0, "d6", 0)],
        {"d1": 0.089, "a2": -0.425, "a3": -0.392, "d4": 0.109, "d5": 0.095, "d6": 0.082},
        "pose",
    ),
}  # fmt: skip


def ours(name: str) -> tuple[float, float, str]:
    """Return the times of the determinant, and of determinant and branches together (of the 3R arms with their
    bases), each with a new robot, and the determinant.
    """
    from robotics1 import PlanarPoseTask, PoseTask, PositionTask, find_singularities, formulas, robot_from_dh

    rows, values, kind = ARMS[name]
    task = {"planar pose": PlanarPoseTask("xy"), "position": PositionTask("xyz"), "pose": PoseTask()}[kind]
    robot = robot_from_dh(rows, parameters=values)
    determinant, seconds = _timed(lambda: formulas(robot, task).determinant)
    robot = robot_from_dh(rows, parameters=values)

    def complete() -> None:
        _ = formulas(robot, task).determinant
        found = find_singularities(robot, task, method="symbolic")
        for branch in found.branches:
            _ = branch.conditions
            if kind != "pose":
                _ = branch.formulas.null, branch.formulas.range, branch.formulas.left_null

    return seconds, _timed(complete)[1], str(determinant)


def usual(name: str) -> str:
    """Return the determinant by the usual route."""
    import sympy

    rows, values, kind = ARMS[name]
    q = sympy.symbols(f"q1:{len(rows) + 1}", real=True)
    lengths = {key: sympy.Symbol(key, real=True) for key in values}
    T, frames = sympy.eye(4), [sympy.eye(4)]
    for (joint, *numbers), x in zip(rows, q, strict=True):
        a, alpha, d, theta = (lengths.get(number, number) for number in numbers)
        theta, d = (theta + x, d) if joint == "R" else (theta, d + x)
        ca, sa = (0, sympy.sign(alpha)) if alpha else (1, 0)
        c, s = sympy.cos(theta), sympy.sin(theta)
        T = T * sympy.Matrix([[c, -s * ca, s * sa, a * c], [s, c * ca, -c * sa, a * s], [0, sa, ca, d], [0, 0, 0, 1]])
        frames.append(T)
    J = T[:3, 3].jacobian(q)
    if kind == "planar pose":
        J = J[:2, :].col_join(sympy.ones(1, len(q)))
    if kind == "pose":
        axes = [frame[:3, 2] if row[0] == "R" else sympy.zeros(3, 1) for frame, row in zip(frames, rows, strict=False)]
        J = J.col_join(sympy.Matrix.hstack(*axes))
    return str(sympy.simplify(J.det()))


def usual_seconds(name: str) -> float | None:
    """Return the time of the usual route, in a process of its own; None when it is stopped at the limit."""
    context = multiprocessing.get_context("spawn")
    receiver, sender = context.Pipe(duplex=False)
    process = context.Process(target=_report, args=(name, sender))
    process.start()
    try:
        if not receiver.poll(LIMIT + 10):  # ten seconds to start and import
            return None
        return float(receiver.recv())
    finally:
        process.kill()
        process.join()


def _report(name: str, sender: Any) -> None:
    import sympy  # noqa: F401 (imported before the clock starts)

    _, seconds = _timed(lambda: usual(name))
    sender.send(seconds)


def _timed(call: Callable[[], Any]) -> tuple[Any, float]:
    start = time.perf_counter()
    answer = call()
    return answer, time.perf_counter() - start


def main() -> None:
    """Time all arms, and write the table."""
    ours("planar 3R")  # the imports
    lines = [
        "# Exact answers beside the usual route",
        "",
        f"Written by `benchmarks/formulas.py`. Python {platform.python_version()}, {platform.machine()}, "
        f"SymPy {version('sympy')}, python-flint {version('python-flint')}, pin {version('pin')}, "
        f"NumPy {np.__version__}. Medians of {REPEATS} runs after import, each with a new robot; the usual route "
        f"(J by differentiation, `det`, `simplify`) runs once, and is stopped after {LIMIT:g} s.",
        "",
        "| arm, lengths with names | determinant, factored and verified [s] | with all branches (3R: and bases) [s] "
        "| usual route [s] | ratio | determinant |",
        "|---|---|---|---|---|---|",
    ]
    for name in ARMS:
        runs = [ours(name) for _ in range(REPEATS)]
        det, complete = (statistics.median(run[i] for run in runs) for i in (0, 1))
        peer = usual_seconds(name)
        told = f"> {LIMIT:g}" if peer is None else f"{peer:.2f}"
        ratio = f"> {LIMIT / det:.0f}" if peer is None else f"{peer / det:.1f}"
        lines.append(f"| {name} | {det:.3f} | {complete:.3f} | {told} | {ratio} | `{runs[0][2]}` |")
        sys.stdout.write(lines[-1] + "\n")
    RESULT.parent.mkdir(exist_ok=True)
    RESULT.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
