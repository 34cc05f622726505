"""Whether a joint trajectory stays inside the robot's limits."""

from dataclasses import dataclass

import numpy as np

from robotics1.robot.model import Robot
from robotics1.trajectories.polynomial import PolynomialTrajectory


@dataclass(frozen=True)
class LimitViolation:
    """A joint beyond a limit: the worst value, and when.

    Attributes:
        joint: its name.
        quantity: "position" or "velocity".
        value: the extreme value [rad, m, rad/s or m/s].
        limit: the limit it passes.
        time: when [s].
    """

    joint: str
    quantity: str
    value: float
    limit: float
    time: float

    def __str__(self) -> str:
        return (
            f"the {self.quantity} of {self.joint} is {self.value:.4g} at t = {self.time:.4g} s, "
            f"beyond its limit {self.limit:.4g}"
        )


def limit_violations(robot: Robot, trajectory: PolynomialTrajectory) -> tuple[LimitViolation, ...]:
    """Return where q(t) leaves [lower, upper] or |q̇(t)| exceeds the velocity limit, from the exact extremes."""
    found = []
    bounds = (
        ("position", trajectory, robot.lower, robot.upper),
        ("velocity", trajectory.rate, -robot.max_velocity, robot.max_velocity),
    )
    for quantity, motion, lower, upper in bounds:
        times, values = motion.extremes()
        for i, joint in enumerate(robot.joint_names):
            for row, limit, sign in ((0, lower[i], -1), (1, upper[i], 1)):
                if sign * (values[row, i] - limit) > 1e-9 * max(1.0, abs(limit)) and np.isfinite(limit):
                    found.append(
                        LimitViolation(joint, quantity, float(values[row, i]), float(limit), float(times[row, i]))
                    )
    return tuple(found)
