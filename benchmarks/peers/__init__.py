"""The inverse kinematics solvers, one file a peer: `make(arm)` returns a `Solver`.

The tolerance of each is set so that its answers meet 1e-5 m and 1e-4 rad; each looks inside the joint limits.
"""

from collections.abc import Callable
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import pinocchio as pin

from benchmarks.arms import Arm, Array
from benchmarks.report import absence

OURS = "robotics1 `IKSolver`"
CHAN = "Robotics Toolbox `ik_LM`, Chan 0.1"  # what the targets of the project compare with

# name in the tables → (module, function, every k-th target is solved: the slow ones solve fewer)
SOLVERS = {
    OURS: ("ours", "make", 1),
    CHAN: ("robotics_toolbox", "make_chan_01", 1),
    "Robotics Toolbox `ik_LM`, Chan 1.0": ("robotics_toolbox", "make_chan_1", 1),
    "optik": ("optik", "make", 1),
    "TRAC-IK (pytracik), 50 ms": ("trac_ik", "make", 2),
    "ssik prebuilt, nearest to the start": ("ssik", "make_nearest", 1),
    "ssik prebuilt, all solutions": ("ssik", "make_all", 2),
    "Pinocchio, damped least squares in Python": ("pinocchio_loop", "make", 5),
    "pink with restarts": ("pink", "make", 20),
}


class NotThisArmError(Exception):
    """The peer does not have this arm."""


@dataclass(frozen=True)
class Solver:
    """One way to solve T(q) = T_d.

    Attributes:
        solve: (target, q0) → q, or None when it tells that it failed. Only this is timed.
        convert: a pose → the target as `solve` wants it.
        every: it solves every k-th target.
    """

    solve: Callable[[Any, Array], Array | None]
    convert: Callable[[pin.SE3], Any]
    every: int = 1


def make_solver(name: str, arm: Arm) -> Solver | str:
    """Return the solver of that name for the arm, or why there is none."""
    module, function, every = SOLVERS[name]
    try:
        solver = getattr(import_module(f"benchmarks.peers.{module}"), function)(arm)
    except ImportError as error:
        return absence(error)
    except NotThisArmError as error:
        return str(error)
    return Solver(solver.solve, solver.convert, every)
