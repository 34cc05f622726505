"""Whether a joint trajectory stays inside the robot's limits."""

from dataclasses import dataclass

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import a_robot
from robotics1.robot.model import Robot
from robotics1.trajectories.limits.motion_limits import MotionLimits
from robotics1.trajectories.peaks.extremes import extremes_of
from robotics1.trajectories.protocols import Trajectory, number_of_joints

ROUNDING = 1e-9  # of the limit, or of the joint's own largest value: a smaller excess is rounding


@dataclass(frozen=True)
class LimitViolation:
    """A joint beyond a limit: the worst value, and when.

    Attributes:
        joint: its name.
        quantity: "position", "velocity", "acceleration" or "jerk".
        value: the extreme value [rad or m, and per s, s², s³].
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


def limit_violations(
    robot: Robot, trajectory: Trajectory, limits: MotionLimits | None = None
) -> tuple[LimitViolation, ...]:
    """Return where q(t) leaves [lower, upper] or a derivative exceeds its limit, from the exact extremes.

    Args:
        robot: its joints' limits of position and velocity count.
        trajectory: of its joints.
        limits: more limits, on velocity, acceleration and jerk; of two on the velocity the smaller counts.

    Raises:
        InputError: the trajectory or the limits are of another number of joints.
    """
    a_robot(robot)
    n = number_of_joints("trajectory", trajectory, robot.nv)
    if limits is not None and not isinstance(limits, MotionLimits):
        raise InputError(f"limits must be MotionLimits(acceleration=..., jerk=...); it is {limits!r}")
    more = (limits or MotionLimits()).of_joints(n)
    velocity = np.minimum(robot.max_velocity, more["velocity"])
    bounds = [("position", robot.lower, robot.upper), ("velocity", -velocity, velocity)]
    bounds += [(quantity, -more[quantity], more[quantity]) for quantity in ("acceleration", "jerk")]
    found = []
    for order, (quantity, lower, upper) in enumerate(bounds):
        if not np.isfinite([lower, upper]).any():
            continue
        times, values = extremes_of(trajectory, order)
        for i, joint in enumerate(robot.joint_names):
            for row, limit, sign in ((0, lower[i], -1), (1, upper[i], 1)):
                rounding = ROUNDING * max(abs(limit), np.abs(values[:, i]).max())
                if np.isfinite(limit) and sign * (values[row, i] - limit) > rounding:
                    found.append(
                        LimitViolation(joint, quantity, float(values[row, i]), float(limit), float(times[row, i]))
                    )
    return tuple(found)
