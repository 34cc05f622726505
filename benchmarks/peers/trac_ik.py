"""TRAC-IK by its bindings pytracik: KDL's Newton and NLopt's SQP, racing on two threads of their own; 50 ms."""

import pinocchio as pin

from benchmarks.arms import Arm, Array
from benchmarks.peers import Solver

TIMEOUT = 0.05  # [s]
TOLERANCE = 5e-6
MARGIN = 1e-6  # [rad]; it keeps limits in single precision, so that its answers may lie 2e-7 outside


def make(arm: Arm) -> Solver:
    """Return TRAC-IK in its mode "Speed"."""
    from pytracik import TRAC_IK, SolveType, ik, set_joint_limits

    solver = TRAC_IK(arm.base, arm.tool, arm.urdf, TIMEOUT, TOLERANCE, SolveType.Speed)
    set_joint_limits(solver, list(arm.robot.lower + MARGIN), list(arm.robot.upper - MARGIN))

    def solve(target: tuple[float, ...], q0: Array) -> Array | None:
        answer = ik(solver, q0, *target)
        return answer[1:] if answer[0] >= 0 else None  # the first is the number of solutions, or an error

    return Solver(solve, _position_and_quaternion)


def _position_and_quaternion(target: pin.SE3) -> tuple[float, ...]:
    return (*target.translation, *pin.Quaternion(target.rotation).coeffs())
