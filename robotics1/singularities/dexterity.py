"""How well an arm moves and pushes at one configuration: measure, condition, ellipsoids, transmission."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array
from robotics1.kinematics import is_batch
from robotics1.results import Frozen
from robotics1.robot.given import RobotLike
from robotics1.robot.model import ConfigurationLike
from robotics1.singularities.ellipsoids import Ellipsoid, force_ellipsoid, velocity_ellipsoid
from robotics1.singularities.rounding import RoundedConfiguration, singularity_within_rounding
from robotics1.singularities.spaces import RankStatus, Subspaces
from robotics1.tasks.given import TaskLike, robot_and_task


class Transmission(NamedTuple):
    """Along a direction: the task velocity for |q̇| = 1, and the force for |τ| = 1.

    Attributes:
        velocity: α = 1/√(uᵀ (J Jᵀ)⁻¹ u); 0 where u cannot be realised.
        force: β = 1/√(uᵀ J Jᵀ u); ∞ where a force along u needs no torque.
    """

    velocity: float
    force: float


@dataclass(frozen=True, eq=False)
class Manipulability(Frozen):
    """How a task's velocities and forces depend on those of the joints, at one configuration.

    Attributes:
        J: (m, n) the task's Jacobian, in SI units: 1 rad/s and 1 m/s count alike, among joints and among rows.
        velocity_ellipsoid: {J q̇ : |q̇| ≤ 1}, with the singular values of J as semi-axes, the longest first.
        force_ellipsoid: {f : |Jᵀ f| ≤ 1}, with their inverses along the same axes.
        spaces: the rank and the four subspaces.
        rounded: q with the digits it is given by, and the singular configuration that these may stand for.
    """

    J: Array
    velocity_ellipsoid: Ellipsoid
    force_ellipsoid: Ellipsoid
    spaces: Subspaces
    rounded: RoundedConfiguration | None = None

    @property
    def measure(self) -> float:
        """Yoshikawa's w = √det(J Jᵀ) = σ₁ σ₂ ⋯ σ_m; 0 where the rank is below m."""
        return float(np.prod(self.velocity_ellipsoid.lengths))

    @property
    def condition(self) -> float:
        """κ = σ₁/σ_m; ∞ where the rank is below m, and 1 of an isotropic configuration."""
        sigma = self.velocity_ellipsoid.lengths
        return float(sigma[0] / sigma[-1]) if sigma[-1] > 0 else np.inf

    @property
    def status(self) -> RankStatus:
        """Whether the rank is full, deficient, or not certain with the digits that are known."""
        return self.spaces.status if self._rounds_none else RankStatus.NEARLY_SINGULAR

    @property
    def at_singularity(self) -> Manipulability:
        """The answer at the singular configuration that the digits of q may stand for; without one, this."""
        if self.rounded is None or self.rounded.at_singularity is None:
            return self
        return _of_spaces(self.rounded.at_singularity)

    @property
    def _rounds_none(self) -> bool:
        return self.rounded is None or self.rounded.singular_q is None

    def transmission(self, u: npt.ArrayLike) -> Transmission:
        """Return how velocity and force are transmitted along u (m,), of any length: the radii of both ellipsoids.

        Where the arm moves fast along u it pushes weakly, and the other way round; α β ≤ 1, and = 1 along an axis.

        Raises:
            InputError: u has no direction, or not one number for each row of the task.

        Source: Chiu, Task compatibility of manipulator postures, Int. J. Robotics Research 7, 1988.
        """
        return Transmission(self.velocity_ellipsoid.radius(u), self.force_ellipsoid.radius(u))

    def explain(self) -> str:
        """Return measure and condition, and the status of the rank, in a sentence."""
        numbers = f"w = {self.measure:.6g}, condition {self.condition:.6g}"
        if self.rounded is None or self._rounds_none:
            return f"{numbers}; {self.spaces.explain()}"
        return f"{numbers}; {self.rounded.explain()}; there w = {self.at_singularity.measure:.6g} (at_singularity)"


def manipulability(robot: RobotLike, task: TaskLike, q: ConfigurationLike) -> Manipulability:
    """Return the manipulability of a task at q: w = √det(J Jᵀ), condition, and the velocity and force ellipsoids.

    Where J has rows or joints of several units, w depends on them: choose a task of one unit, as `PositionTask`.
    `plots.plot_ellipses` draws the ellipsoids; with prismatic joints it measures their rates in reaches per second.

    Args:
        robot: the robot.
        task: m rows.
        q: (nq,) configuration [rad or m].

    Raises:
        InputError: q has the wrong shape or is not finite.
        TaskError: the task does not fit the robot.

    Source: Yoshikawa, Manipulability of robotic mechanisms, Int. J. Robotics Research 4, 1985.
    """
    robot, task = robot_and_task(robot, task)
    rounded = singularity_within_rounding(robot, task, q)
    return _of_spaces(rounded.spaces, rounded)


def _of_spaces(spaces: Subspaces, rounded: RoundedConfiguration | None = None) -> Manipulability:
    return Manipulability(spaces.J, velocity_ellipsoid(spaces), force_ellipsoid(spaces), spaces, rounded)


def sigma_min(robot: RobotLike, task: TaskLike, q: ConfigurationLike) -> Any:
    """Return σ_min of J(q), the least of its min(m, n) singular values, a number; of several q, (k,).

    It is zero where J has not its full rank. Of millions of configurations `scan_singularities` finds the least.

    Args:
        robot: the robot.
        task: m rows.
        q: (nq,) a configuration, or (k, nq) several [rad or m].

    Raises:
        InputError: q has the wrong shape or is not finite.
        TaskError: the task does not fit the robot.
    """
    robot, task = robot_and_task(robot, task)
    several = is_batch(q)
    every = robot.configurations(q) if several else [robot.configuration(q)]
    J = np.reshape([task.jacobian(robot, one) for one in every], (len(every), task.rows, robot.nv))
    nothing = 0 in J.shape[1:]  # then no singular value can vanish
    least = np.full(len(J), np.inf) if nothing else np.linalg.svd(J, compute_uv=False)[:, -1]
    return least if several else least[0]
