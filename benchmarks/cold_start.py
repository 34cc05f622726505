"""How long the first call takes in a new process: with an empty cache of compiled code, and with a filled one."""

import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass

import robotics1

FIRST_CALL = """
import time
begin = time.perf_counter()
import robotics1
robot = robotics1.load_robot("ur5", base="base_link", tool="tool0")
target = robotics1.forward_kinematics(robot, [0.3, -1.2, 1.1, 0.4, 0.5, 0.6])
loaded = time.perf_counter()
solver = robotics1.IKSolver(robot, robotics1.PoseTask())
result = solver(target, [0.0] * 6)
called = time.perf_counter()
print(called - loaded, called - begin, result.converged)
"""


@dataclass(frozen=True)
class ColdStart:
    """The first `IKSolver(robot, task)(target, q0)` of a process.

    Attributes:
        seconds: of that line [s], the import of Numba included.
        process: of all after the start of Python, the imports and the loading of the robot included [s].
        message: what it told while it compiled; empty when it told nothing.
    """

    seconds: float
    process: float
    message: str


def cold_starts() -> tuple[ColdStart, ColdStart] | None:
    """Return the first call with an empty NUMBA_CACHE_DIR, and the one after it; None where there is no IKSolver.

    Raises:
        RuntimeError: the call did not solve its target.
    """
    if not hasattr(robotics1, "IKSolver"):
        return None
    with tempfile.TemporaryDirectory() as folder:
        return _first_call(folder), _first_call(folder)


def _first_call(folder: str) -> ColdStart:
    environment = os.environ | {"NUMBA_CACHE_DIR": folder}
    run = subprocess.run(
        [sys.executable, "-c", FIRST_CALL], env=environment, check=True, capture_output=True, text=True
    )
    seconds, process, converged = run.stdout.split()
    if converged != "True":
        raise RuntimeError("the first call did not solve its target")
    return ColdStart(float(seconds), float(process), run.stderr.strip())
