"""Newton's method on the twist that is missing to a pose, with its table, as Lynch and Park teach it."""

from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

import numpy as np

from robotics1.ik.result import IKStatus
from robotics1.inputs import Array, counting_number, one_of, real_number
from robotics1.kinematics import forward_kinematics, frame_jacobian
from robotics1.least_squares import RANK_TOLERANCE, generalized_inverse
from robotics1.notation import vector
from robotics1.results import Frozen, require, tuple_with_arrays
from robotics1.rigid_motions.changes_of_frame import adjoint
from robotics1.rigid_motions.exponential import pose_log
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import ConfigurationLike
from robotics1.robot.placements import homogeneous
from robotics1.tables import Table, table_of

Kind = Literal["body", "space"]
KINDS = ("body", "space")
TOO_FAR = 1e6  # of a joint [rad, or reaches]: the iteration diverges


@tuple_with_arrays
class TwistIterate(NamedTuple):
    """One row of the table: k, q, the missing twist (v, ω), (6,), and its norms |ω| [rad] and |v| [m]."""

    k: int
    q: Array
    twist: Array
    angle: float
    distance: float


@dataclass(frozen=True, eq=False)
class TwistIteration(Frozen):
    """What an iteration on the missing twist did.

    Attributes:
        status: why it stopped.
        q: (n,) the last iterate [rad or m].
        table: one row an iterate, the start included.
        within_limits: whether q is inside the joint limits; the iteration itself ignores them.
        kind: the axes of the twist, "body" or "space".
    """

    status: IKStatus
    q: Array
    table: tuple[TwistIterate, ...]
    within_limits: bool
    kind: str

    @property
    def converged(self) -> bool:
        """Whether |ω| and |v| are within their tolerances at `q`."""
        return self.status is IKStatus.CONVERGED

    @property
    def iterations(self) -> int:
        """The number of updates of q that were made."""
        return len(self.table) - 1

    def _tables(self) -> tuple[Table, ...]:
        rows = [
            (str(row.k), vector(row.q), vector(row.twist), f"{row.angle:.3g}", f"{row.distance:.3g}")
            for row in self.table
        ]
        return (table_of(("k", "q", "V = (v, ω)", "|ω|", "|v|"), rows),)

    def explain(self) -> str:
        """Return why the iteration stopped, with its numbers, in a sentence."""
        last, after = self.table[-1], f"stopped after {self.iterations} iterations"
        return f"{after} with |ω| = {last.angle:.3g} rad and |v| = {last.distance:.3g} m: {self.status.value}"

    def require(self) -> "TwistIteration":
        """Return self if it converged.

        Raises:
            NotConverged: it did not; the message says why.
        """
        return require(self, self.converged)


def iterate_twist(
    robot: RobotLike,
    pose: Any,
    q0: ConfigurationLike,
    *,
    frame: str | None = None,
    kind: Kind = "body",
    angle_tolerance: float = 1e-3,
    distance_tolerance: float = 1e-4,
    max_iterations: int = 20,
) -> TwistIteration:
    """Iterate q ← q + J_b⁺ V_b, [V_b] = log(T(q)⁻¹ T_d), until |ω_b| and |v_b| are small; return every iterate.

    T e^[V_b] = T_d: the twist takes the frame to its goal in a time of 1, by one screw motion. In the axes of the world
    the step is J_s⁺ V_s, with V_s = Ad_T V_b; of an arm of six joints it is the same one.

    Args:
        robot: an arm of revolute and prismatic joints; its limits are ignored, and looked at in the end.
        pose: T_d, a `pin.SE3`, a matrix (4, 4), or another form of a pose.
        q0: (n,) the start [rad or m].
        frame: the frame's name; None for the tool.
        kind: "body" or "space", the axes of twist and Jacobian.
        angle_tolerance: on |ω| [rad].
        distance_tolerance: on |v| [m]; in "space" v is that of the point at the origin of the world.
        max_iterations: the most updates of q.

    Raises:
        InputError: an argument has the wrong shape or value.
        TaskError: a joint has several coordinates.

    Source: Lynch, Park, Modern Robotics, 2017, section 6.2.2.
    """
    robot = robot_from(robot)
    robot.require_single_coordinates("have a Newton iteration")
    goal, q = homogeneous("pose", pose), robot.configuration(q0, "q0")
    one_of("kind", kind, KINDS)
    eps_angle = real_number("angle_tolerance", angle_tolerance, positive=True)
    eps_distance = real_number("distance_tolerance", distance_tolerance, positive=True)
    limit = counting_number("max_iterations", max_iterations)
    most = TOO_FAR * robot.units * np.maximum(1.0, np.abs(q / robot.units))
    table: list[TwistIterate] = []
    while True:
        T = forward_kinematics(robot, q, frame=frame)
        V = pose_log(T.inverse() * goal)
        V = adjoint(T) @ V if kind == "space" else V
        J = frame_jacobian(robot, q, frame=frame, kind=kind)
        table.append(TwistIterate(len(table), q, V, float(np.linalg.norm(V[3:])), float(np.linalg.norm(V[:3]))))
        ahead = q + generalized_inverse(J).solve(V)
        status: IKStatus | None = None
        if table[-1].angle <= eps_angle and table[-1].distance <= eps_distance:
            status = IKStatus.CONVERGED
        elif np.linalg.norm(J.T @ V) <= RANK_TOLERANCE * np.linalg.norm(J) * np.linalg.norm(V):
            status = IKStatus.STALLED
        elif len(table) > limit:
            status = IKStatus.MAX_ITERATIONS
        elif not (np.abs(ahead) < most).all():
            status = IKStatus.DIVERGED
        if status is not None:
            return TwistIteration(status, q, tuple(table), robot.within_limits(q), kind)
        q = ahead
