"""Peers that return all solutions: `make_…(arm)` returns an `AllSolver`, or raises NotThisArmError."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pinocchio as pin

from benchmarks.arms import Arm, Array
from benchmarks.peers import NotThisArmError
from benchmarks.peers.ssik import SAME, artifact_of


@dataclass(frozen=True)
class AllSolver:
    """One way to all solutions of T(q) = T_d.

    Attributes:
        solve: target → its answer. Only this is timed.
        convert: a pose → the target as `solve` wants it.
        read: an answer → the solutions (k, n).
    """

    solve: Callable[[Any], Any]
    convert: Callable[[pin.SE3], Any]
    read: Callable[[Any], Array]


def make_ours(arm: Arm) -> AllSolver:
    """Return `SolutionSolver`."""
    from robotics1 import PoseTask
    from robotics1.ik import SolutionSolver

    return AllSolver(SolutionSolver(arm.robot, PoseTask()), lambda T: T, lambda found: found.q)


def make_ssik_prebuilt(arm: Arm) -> AllSolver:
    """Return ssik's module for an arm of its list."""
    artifact, convert = artifact_of(arm)
    return AllSolver(lambda T: artifact.solve(T, enumerate_windings=False), convert, _of_ssik)


def make_ssik(arm: Arm) -> AllSolver:
    """Return ssik's solver of the arm's URDF."""
    import ssik

    arm_of = ssik.Manipulator.from_urdf(arm.path, base=arm.base, ee=arm.tool)

    def solve(T: Array) -> Any:
        return arm_of.solve(T, enumerate_windings=False, respect_limits=False)

    return AllSolver(solve, lambda T: T.homogeneous, _of_ssik)


def _of_ssik(answers: Any) -> Array:
    return np.array([answer.q for answer in answers], dtype=float)


def make_eaik(arm: Arm) -> AllSolver:
    """Return EAIK's solver of the arm's axes."""
    from eaik.IK_HP import HPRobot

    H, P, R0 = axes_and_offsets(arm)
    solver = HPRobot(H.T, P.T)
    if not solver.hasKnownDecomposition():
        raise NotThisArmError("it knows no decomposition of this arm")

    def convert(T: pin.SE3) -> Array:
        return pin.SE3(T.rotation @ R0.T, T.translation).homogeneous

    def read(found: Any) -> Array:
        exact = ~np.asarray(found.is_LS, dtype=bool).reshape(-1)
        return np.asarray(found.Q, dtype=float).reshape(len(exact), -1)[exact]

    return AllSolver(solver.IK, convert, read)


def make_ik_geo(arm: Arm) -> AllSolver:
    """Return IK-Geo's solver of arms such as the UR5."""
    from ik_geo import Robot

    if arm.name != "UR5":  # its other solvers want the offsets in a form of their own, which is not made here
        raise NotThisArmError("asked about the UR5 alone")
    H, P, R0 = axes_and_offsets(arm)
    solver = Robot.three_parallel_two_intersecting(H.T, P.T)

    def convert(T: pin.SE3) -> tuple[Array, Array]:
        return (T.rotation @ R0.T).T, T.translation  # column by column

    def read(found: Any) -> Array:
        return np.array([q for q, least_squares in found if not least_squares], dtype=float)

    return AllSolver(lambda target: solver.get_ik(*target), convert, read)


def make_jaik(arm: Arm) -> AllSolver:
    """Return jaik's solver of the UR5, by Numba."""
    from jaik import make_robot

    if arm.name != "UR5":
        raise NotThisArmError("it has UR arms alone")
    forward, solve, _ = make_robot("ur5", solver="numba")
    rng = np.random.default_rng(0)
    front, back = _between(arm, lambda q: _pose(*forward(q)), [arm.random(rng) for _ in range(9)])

    def convert(T: pin.SE3) -> tuple[Array, Array]:
        its = front @ T.homogeneous @ back
        return np.ascontiguousarray(its[:3, :3]), np.ascontiguousarray(its[:3, 3])

    def read(found: Any) -> Array:
        Q, valid = (np.asarray(part) for part in found)
        return Q.T[valid.reshape(-1).astype(bool)]  # a column each

    return AllSolver(lambda target: solve(*target), convert, read)


def _pose(R: Any, p: Any) -> Array:
    return pin.SE3(np.asarray(R, dtype=float), np.asarray(p, dtype=float)).homogeneous


def _between(arm: Arm, forward: Callable[[Array], Array], samples: list[Array]) -> tuple[Array, Array]:
    """Return placements F, B with F T(q) B = its T(q): its base may be turned by half a turn, its tool may be turned.

    Raises:
        NotThisArmError: there are none.
    """
    for front in (np.eye(4), np.diag([-1.0, -1, 1, 1])):
        backs = [np.linalg.inv(front @ arm.pose(q).homogeneous) @ forward(q) for q in samples]
        if max(np.abs(back - backs[0]).max() for back in backs) < SAME:
            return front, backs[0]
    raise NotThisArmError("its arm of this name is another")


def axes_and_offsets(arm: Arm) -> tuple[Array, Array, Array]:
    """Return the axes (3, 6) and the offsets between them (3, 7) [m] at q = 0, and the tool's rotation there."""
    model = arm.robot.model
    data = model.createData()
    q = np.zeros(arm.robot.nq)
    pin.computeJointJacobians(model, data, q)
    pin.framesForwardKinematics(model, data, q)
    base, tool = data.oMf[model.getFrameId(arm.base)], arm.pose(q)
    J = pin.getFrameJacobian(model, data, model.getFrameId(arm.tool), pin.LOCAL_WORLD_ALIGNED)
    H = base.rotation.T @ J[3:]
    points = [base.actInv(data.oMi[i]).translation for i in range(1, model.njoints)]
    P = np.diff(np.column_stack([np.zeros(3), *points, tool.translation]), axis=1)
    return H, P, tool.rotation
