"""The joint trajectory that follows a task trajectory, and how well."""

from __future__ import annotations

from dataclasses import dataclass
from enum import Enum

import numpy as np

from robotics1.curves.interpolants import Extreme
from robotics1.curves.piecewise_polynomial import PiecewisePolynomial
from robotics1.inputs import Array
from robotics1.results import require


class FollowingStatus(Enum):
    """Whether the joints stay on the path."""

    FOLLOWS = "the path is followed: |r_d − r| ≤ 1e-6 all along, in radians and reaches of the robot"
    RETURNS = "the path is left, or begun beside, and regained: at the end |r_d − r| ≤ 1e-6, in radians and reaches"
    DEVIATES = "the end of the path is missed"
    STOPPED = "the joint velocities grow, or change, without bound, as near a singularity: stopped there"


@dataclass(frozen=True, eq=False)
class FollowedTrajectory(PiecewisePolynomial):
    """q(t), (n,) for a number and (k, n) for (k,) times, from the inverse differential kinematics of a task trajectory.

    The polynomials are the solution of the differential equation: q and q̇ to about 1e-9, q̈ to 1e-7, and the third
    derivative to 1e-5.

    Attributes:
        switching_times: those of the task trajectory [s].
        asked_duration: that of the task trajectory [s]; the joints' is less where they stopped before.
        status: whether the joints stay on the path.
        times: (k,) the instants that were looked at: 201, and the switching times [s].
        errors: (k, m) r_d − r at these instants.
        residuals: (k, m) the part of the asked ṙ, or r̈, that is not realised.
        singular_values: (k,) the smallest singular value of the Jacobian, with an input matrix of J G.
    """

    switching_times: Array
    asked_duration: float
    status: FollowingStatus
    times: Array
    errors: Array
    residuals: Array
    singular_values: Array

    @property
    def breakpoints(self) -> Array:
        """The switching times."""
        return self.switching_times

    @property
    def largest_error(self) -> Extreme:
        """Where |r_d − r| is largest, of 201 instants and the switching times."""
        return self._largest(np.linalg.norm(self.errors, axis=1))

    @property
    def largest_residual(self) -> Extreme:
        """Where the part of the asked ṙ, or r̈, that is not realised is largest, of the same instants."""
        return self._largest(np.linalg.norm(self.residuals, axis=1))

    @property
    def least_singular_value(self) -> Extreme:
        """Where the smallest singular value of the Jacobian is least, of the same instants."""
        i = int(np.argmin(self.singular_values))
        return Extreme(float(self.singular_values[i]), float(self.times[i]))

    @property
    def final_error(self) -> float:
        """|r_d − r| at the end."""
        return float(np.linalg.norm(self.errors[-1]))

    def explain(self) -> str:
        """Return the status with its numbers, in a sentence."""
        error, least = self.largest_error, self.least_singular_value
        return (
            f"{self.status.value}; t = {self.duration:.6g} of {self.asked_duration:.6g} s, largest |r_d − r| = "
            f"{error.value:.3g} at t = {error.time:.4g} s, smallest σ = {least.value:.3g} at t = {least.time:.4g} s"
        )

    def require(self) -> FollowedTrajectory:
        """Return the trajectory itself if its end is on the path.

        Raises:
            NotConverged: it is not.
        """
        return require(self, self.status not in (FollowingStatus.DEVIATES, FollowingStatus.STOPPED))

    def _largest(self, norms: Array) -> Extreme:
        i = int(np.argmax(norms))
        return Extreme(float(norms[i]), float(self.times[i]))
