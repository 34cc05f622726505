"""The joint trajectory that follows a task trajectory, and how well."""

from dataclasses import dataclass
from enum import Enum
from typing import Any

import numpy as np

from robotics1.caching import cached_property
from robotics1.curves.curve import Curve, Side
from robotics1.curves.interpolants import Extreme
from robotics1.differentiation import derivative_inside
from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.results import require
from robotics1.tasks.task import unitless_rows
from robotics1.trajectories.following.integration import Segment
from robotics1.trajectories.following.path_flow import AccelerationFlow, Command, VelocityFlow

ON_PATH = 1e-6  # |r_d − r| in radians, and in reaches of the robot: less is no error
INSTANTS = 201  # at which the error, the residual and σ are looked at, and as many in each segment as fall to it


class FollowingStatus(Enum):
    """Whether the joints stay on the path."""

    FOLLOWS = "the path is followed: |r_d − r| ≤ 1e-6 all along, in radians and reaches of the robot"
    RETURNS = "the path is left, or begun beside, and regained: at the end |r_d − r| ≤ 1e-6, in radians and reaches"
    DEVIATES = "the end of the path is missed"
    STOPPED = "the joint velocities grow, or change, without bound, as near a singularity: stopped there"


@dataclass(frozen=True, eq=False)
class FollowedTrajectory(Curve):
    """q(t), (n,) for a number and (k, n) for (k,) times, from the inverse differential kinematics of a task trajectory.

    q̇ comes from the differential equation; q̈ is its derivative along the solution by differences, exact to about 1e-8,
    and the third derivative of q(t) by differences again, exact to about 1e-5.

    Attributes:
        flow: the differential equation.
        segments: its solution.
        start: the state at t = 0.
        asked_duration: that of the task trajectory [s].
    """

    flow: VelocityFlow | AccelerationFlow
    segments: tuple[Segment, ...]
    start: Array
    asked_duration: float

    @property
    def end(self) -> float:
        """T [s], of the task trajectory; less where it stopped before."""
        return self.segments[-1].end if self.segments else 0.0

    @property
    def shape(self) -> tuple[int, ...]:
        """(n,)."""
        return (self.flow.robot.nv,)

    @property
    def breakpoints(self) -> Array:
        """Those of the task trajectory [s]."""
        return np.array([segment.end for segment in self.segments[:-1]])

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        if order > 3:
            raise InputError(f"derivatives of a followed trajectory are known up to the third; order is {order}")
        of = (self._position, self._velocity, self._acceleration, self._jerk)[order]
        return np.array([of(float(x), side) for x in t])

    def _position(self, t: float, side: Side) -> Array:
        return self._state(t)[: self.flow.robot.nv]

    def _velocity(self, t: float, side: Side) -> Array:
        return self.command(t, side=side).qdot

    def _jerk(self, t: float, side: Side) -> Array:
        return derivative_inside(self._acceleration, t, self._ends, side)

    def command(self, t: float, *, side: Side = "right") -> Command:
        """Return the error, the residual and the smallest singular value at one instant."""
        return self.flow.command(t, self._state(t), side)

    @cached_property
    def record(self) -> tuple[Array, list[Command]]:
        """The instants that were looked at [s], and the commands there."""
        t = np.unique(np.concatenate([np.linspace(0.0, self.duration, INSTANTS), self._ends]))
        return t, [self.command(float(x)) for x in t]

    @property
    def largest_error(self) -> Extreme:
        """Where |r_d − r| is largest, of 201 instants and the switching times."""
        return self._largest(lambda command: float(np.linalg.norm(command.error)))

    @property
    def largest_residual(self) -> Extreme:
        """Where the part of the asked ṙ, or r̈, that is not realised is largest, of the same instants."""
        return self._largest(lambda command: float(np.linalg.norm(command.residual)))

    @property
    def least_singular_value(self) -> Extreme:
        """Where the smallest singular value of the Jacobian is least, of the same instants."""
        least = self._largest(lambda command: -command.sigma)
        return Extreme(-least.value, least.time)

    @property
    def final_error(self) -> float:
        """|r_d − r| at the end."""
        return float(np.linalg.norm(self.record[1][-1].error))

    @property
    def status(self) -> FollowingStatus:
        """Whether the joints stay on the path."""
        if self.duration < self.asked_duration:
            return FollowingStatus.STOPPED
        unitless = unitless_rows(self.flow.robot, self.flow.task)
        errors = np.linalg.norm([unitless * command.error for command in self.record[1]], axis=1)
        if errors[-1] > ON_PATH:
            return FollowingStatus.DEVIATES
        return FollowingStatus.FOLLOWS if errors.max() <= ON_PATH else FollowingStatus.RETURNS

    def explain(self) -> str:
        """Return the status with its numbers, in a sentence."""
        error, least = self.largest_error, self.least_singular_value
        return (
            f"{self.status.value}; t = {self.duration:.6g} of {self.asked_duration:.6g} s, largest |r_d − r| = "
            f"{error.value:.3g} at t = {error.time:.4g} s, smallest σ = {least.value:.3g} at t = {least.time:.4g} s"
        )

    def require(self) -> "FollowedTrajectory":
        """Return the trajectory itself if its end is on the path.

        Raises:
            NotConverged: it is not.
        """
        return require(self, self.status not in (FollowingStatus.DEVIATES, FollowingStatus.STOPPED))

    @property
    def _ends(self) -> list[float]:
        return [0.0, *(segment.end for segment in self.segments)]

    def _state(self, t: float) -> Array:
        for segment in self.segments:
            if t <= segment.end:
                return np.asarray(segment.state(t))
        return self.start if not self.segments else np.asarray(self.segments[-1].state(t))

    def _acceleration(self, t: float, side: Side) -> Array:
        """Return dq̇/dt: the derivative of q̇(x, state + (x − t) rate) at x = t."""
        state = self._state(t)
        rate = self.flow.command(t, state, side).rate

        def velocity(x: float, at: Side) -> Array:
            return self.flow.command(x, state + (x - t) * rate, at).qdot

        return derivative_inside(velocity, t, self._ends, side)

    def _largest(self, of: Any) -> Extreme:
        t, commands = self.record
        values = [of(command) for command in commands]
        i = int(np.argmax(values))
        return Extreme(values[i], float(t[i]))
