"""The projected gradient: a self-motion that increases an objective while the task is realised."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, a_robot_and_a_task, real_number
from robotics1.redundancy.objectives import Objective
from robotics1.results import Frozen, require
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task
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
            f"H = {self.objective:.6g}, Ḣ = {self.rate:.6g}, of which {self.null_rate:.6g} by self-motion; the task is "
            f"{self.velocity.explain()}"
        )

    def require(self) -> "ProjectedGradient":
        """Return self if the task is realised.

        Raises:
            NotConverged: a part of it is not.
        """
        self.velocity.require()
        return require(self, True)


def projected_gradient(
    robot: Robot,
    task: Task,
    rdot: npt.ArrayLike,
    q: npt.ArrayLike,
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
    a_robot_and_a_task(robot, task)
    k = real_number("gain", gain)
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
