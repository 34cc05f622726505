"""The projected gradient: a self-motion that increases an objective while the task is realised."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, real_array, real_number
from robotics1.least_squares import rank_of
from robotics1.notation import count
from robotics1.redundancy.objectives import Objective
from robotics1.redundancy.weighted import null_vectors, pivot_columns
from robotics1.results import Frozen, require
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.tasks.function import FunctionTask
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.rows import unitless_factors
from robotics1.tasks.stacked import StackedTask
from robotics1.trajectories.following.joint_rates import JointVelocity, joint_velocity
from robotics1.trajectories.following.resolution import Resolution


@dataclass(frozen=True, eq=False)
class ProjectedGradient(Frozen):
    """q̇ = J# ṙ + k (1 − J⁺J) ∇H at one configuration.

    Attributes:
        qdot: (nv,) q̇ [rad/s or m/s].
        velocity: the answer of the inverse kinematics, with what of ṙ is realised.
        objective: H(q).
        gradient: (nv,) ∇H.
        null_velocity: (nv,) the part of q̇ that does not move the task.
        rate: Ḣ = ∇Hᵀ q̇.
        null_rate: the part of Ḣ that the self-motion makes; never negative for k > 0.
    """

    qdot: Array
    velocity: JointVelocity
    objective: float
    gradient: Array
    null_velocity: Array
    rate: float
    null_rate: float

    def explain(self) -> str:
        """Return the objective with its rate, and what of the task is realised."""
        return (
            f"H = {self.objective:.6g}, Ḣ = {self.rate:.6g}, {self.null_rate:.6g} of it by self-motion; the task is "
            f"{self.velocity.explain()}"
        )

    def require(self) -> ProjectedGradient:
        """Return self if the task is realised.

        Raises:
            NotConverged: a part of it is not.
        """
        self.velocity.require()
        return require(self, True)


def projected_gradient(
    robot: RobotLike,
    task: TaskLike,
    rdot: npt.ArrayLike,
    q: ConfigurationLike,
    objective: Objective,
    *,
    gain: float = 1.0,
    resolution: Resolution | None = None,
) -> ProjectedGradient:
    """Return q̇ = J# ṙ + k (1 − J⁺J) ∇H(q): the task, and a self-motion along the projected gradient of H.

    Along a path, give `null_velocity=lambda q: k * objective.gradient(q)` to `follow_trajectory`.

    Args:
        robot: the robot.
        task: r = f(q).
        rdot: (m,) ṙ, one number for each row of J.
        q: (nq,) configuration [rad or m].
        objective: H, such as `ManipulabilityObjective(robot, task)`; anything with `value(q)` and `gradient(q)`.
        gain: k; negative to make H small.
        resolution: which inverse J# is taken; by default the pseudoinverse.

    Raises:
        InputError: a shape is wrong, or the objective is none.
        TaskError: the task does not fit the robot.

    Source: Liégeois, IEEE Trans. SMC 7, 1977; Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.5.1.
    """
    robot, task = robot_and_task(robot, task)
    q, k = robot.configuration(q), real_number("gain", gain)
    slope = gradient_of(objective, q, robot.nv)
    found = joint_velocity(robot, task, rdot, q, resolution=resolution, null_velocity=k * slope)
    alone = joint_velocity(robot, task, rdot, q, resolution=resolution)
    moved = found.qdot - alone.qdot
    return ProjectedGradient(
        found.qdot,
        found,
        float(objective.value(q)),
        slope,
        moved,
        float(slope @ found.qdot),
        float(slope @ moved),
    )


def gradient_of(objective: Objective, q: npt.ArrayLike, n: int) -> Array:
    """Return ∇H(q), (n,).

    Raises:
        InputError: it is no objective, or one of other joints.
    """
    if isinstance(objective, type) or not callable(getattr(objective, "gradient", None)):
        raise InputError(
            f"the objective must have value(q) and gradient(q), such as ManipulabilityObjective(robot, task); it is "
            f"{objective!r}"
        )
    slope = np.asarray(objective.gradient(q), dtype=float)
    if slope.shape != (n,):
        raise InputError(f"the gradient of the objective must have one number for each of {n} joints: {slope.shape}")
    return slope


def reduced_gradient(
    robot: RobotLike,
    task: TaskLike,
    rdot: npt.ArrayLike,
    q: ConfigurationLike,
    objective: Objective,
    *,
    gain: float = 1.0,
) -> Array:
    """Return q̇, (n,), of the reduced gradient: n − m joints follow the gradient of H, the others realise the task.

    With J = [J_A J_B], J_A the m columns of the largest minor: q̇_B = k (∇_B H − (J_A⁻¹ J_B)ᵀ ∇_A H), and
    q̇_A = J_A⁻¹(ṙ − J_B q̇_B). It needs no pseudoinverse, and H grows faster than with the projected gradient.

    Args:
        robot: an arm with more joints than the task has rows.
        task: r = f(q).
        rdot: (m,) ṙ.
        q: (nq,) configuration [rad or m].
        objective: H.
        gain: k.

    Raises:
        InputError: a shape is wrong, or J has not full row rank at q.
        TaskError: the task does not fit the robot.

    Source: De Luca, Oriolo, The reduced gradient method for solving redundancy in robot arms, Robotersysteme 7, 1991.
    """
    robot, task = robot_and_task(robot, task)
    q, rdot = robot.configuration(q), real_array("rdot", rdot, (task.rows,), "one number for each row of J")
    J, slope = task.jacobian(robot, q), gradient_of(objective, q, robot.nv)
    k = real_number("gain", gain)
    if not robot.nv:
        raise TaskError(f"robot {robot.name!r} has no joint: nothing is redundant")
    if rank_of(J, unitless_factors(robot, task)) < task.rows:
        raise InputError("the reduced gradient needs a Jacobian of full row rank; at this q it has not")
    A = list(pivot_columns(J))
    B = [i for i in range(robot.nv) if i not in A]
    across = np.linalg.solve(J[:, A], J[:, B])
    qdot = np.zeros(robot.nv)
    qdot[B] = k * (slope[B] - across.T @ slope[A])
    qdot[A] = np.linalg.solve(J[:, A], rdot) - across @ qdot[B]
    return qdot


def extended_task(robot: RobotLike, task: TaskLike, objective: Objective) -> StackedTask:
    """Return the task with n − m further rows, h(q) = vᵢ(q)ᵀ ∇H(q), that vanish where H is the largest for the task.

    vᵢ is a basis of N(J) made of its minors. The extended Jacobian is square: with ḣ = 0 the arm tracks the best
    configurations, and closed paths of the task give closed paths of the joints. It is singular where J is, and
    besides at algorithmic singularities. h is differentiated by differences, so that J is exact to about 1e-6.

    Use it as any task: `ik_solutions(robot, extended, [*r, 0])`, `follow_trajectory`, `joint_velocity`.

    Args:
        robot: an arm with more joints than the task has rows.
        task: r = f(q).
        objective: H.

    Raises:
        TaskError: nothing is redundant, or the task does not fit.

    Source: Baillieul, Kinematic programming alternatives for redundant manipulators, ICRA 1985.
    """
    robot, task = robot_and_task(robot, task)
    robot.require_single_coordinates("have an extended task")
    task.check(robot)
    if not robot.nv:
        raise TaskError(f"robot {robot.name!r} has no joint: nothing is redundant")
    free = robot.nv - task.rows
    if free <= 0:
        rows, joints = count(task.rows, "row"), count(robot.nv, "joint")
        raise TaskError(f"the task has {rows} and the robot {joints}: nothing is redundant")
    q = np.random.default_rng(0).uniform(-1, 1, robot.nq)
    gradient_of(objective, q, robot.nv)
    pivots = pivot_columns(task.jacobian(robot, q))

    def h(p: Array, R: Array, x: Array) -> Array:
        return np.array(null_vectors(task.jacobian(robot, x), pivots)) @ objective.gradient(x)

    return StackedTask([task, FunctionTask(h, free, frame=robot.frame_names[0], units=("1",) * free)])
