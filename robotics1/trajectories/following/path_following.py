"""From a task trajectory to a joint trajectory, by integrating the inverse differential kinematics."""

from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.curves.curve import Curve
from robotics1.curves.given import as_curve
from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, a_robot_and_a_task, non_negative_numbers, real_array
from robotics1.robot.model import Robot
from robotics1.tasks.task import Task
from robotics1.trajectories.following.followed_trajectory import FollowedTrajectory
from robotics1.trajectories.following.integration import integrated
from robotics1.trajectories.following.path_flow import AccelerationFlow, VelocityFlow
from robotics1.trajectories.following.resolution import Resolution, Wish, resolution_or_default

PRECISION = 1e-10  # of the integration, relative, and in radians and reaches of the robot
RUNAWAY = 1e4  # rad, or reaches, in the duration: joints that move so fast have met a singularity
FIRST = 0.01  # of a segment: the first step that is tried
STEPS = 1000  # from one switching time to the next: a well-behaved motion takes some tens


def follow_trajectory(
    robot: Robot,
    task: Task,
    trajectory: Any,
    q0: npt.ArrayLike,
    *,
    resolution: Resolution | None = None,
    gain: npt.ArrayLike = 0.0,
    null_velocity: Wish = None,
) -> FollowedTrajectory:
    """Return the joint trajectory of q̇ = J# (ṙ_d + K (r_d − f(q))) + (1 − J⁺J) q̇₀ from q(0) = q0.

    Without a gain the velocity alone is followed, and an error stays; with K it decays as exp(−K t). An inverse without
    damping is softened where σ_min < 1e-4 σ_max, so that a singularity can be passed where nothing is lost in it.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        trajectory: r_d(t), in the form of the task's value: a path with a timing law.
        q0: (n,) where the joints start [rad or m]; they may start off the path.
        resolution: which inverse J# is taken, and what the inputs are; by default the pseudoinverse.
        gain: K [1/s], one number or (m,), not negative.
        null_velocity: q̇₀, (n,) or a function of q: the part of it that does not move the task is added.

    Raises:
        InputError: a shape is wrong, a gain is negative, or the robot has joints with several degrees of freedom.
        TaskError: the task does not fit the robot, or its axes move with it.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.1 (closed-loop inverse kinematics).
    """
    a_robot_and_a_task(robot, task)
    q0, motion = _start(robot, task, trajectory, q0)
    K = non_negative_numbers("gain", gain, task.rows)
    flow = VelocityFlow(robot, task, motion, resolution_or_default(resolution), K, null_velocity)
    return _integrated(flow, q0)


def follow_trajectory_by_acceleration(
    robot: Robot,
    task: Task,
    trajectory: Any,
    state: tuple[npt.ArrayLike, npt.ArrayLike],
    *,
    resolution: Resolution | None = None,
    gains: tuple[npt.ArrayLike, npt.ArrayLike] = (0.0, 0.0),
    null_acceleration: Wish = None,
) -> FollowedTrajectory:
    """Return the joint trajectory of q̈ = J# (r̈_d + K_D ė + K_P e − J̇ q̇) + (1 − J⁺J) q̈₀ from (q0, q̇0).

    The error obeys ë + K_D ė + K_P e = 0 while what is asked is in the range of J.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        trajectory: r_d(t), in the form of the task's value.
        state: q0 (n,) and q̇0 (n,), with an input matrix u0 (k,).
        resolution: which inverse J# is taken, and what the inputs are; by default the pseudoinverse.
        gains: K_P [1/s²] and K_D [1/s], each one number or (m,), not negative.
        null_acceleration: q̈₀, (n,) or a function of q and q̇, such as lambda q, v: -2 * v.

    Raises:
        InputError: a shape is wrong, a gain is negative, or the robot has joints with several degrees of freedom.
        TaskError: the task does not fit the robot, or its axes move with it.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.4.
    """
    a_robot_and_a_task(robot, task)
    q0, u0 = _pair("state", state)
    q0, motion = _start(robot, task, trajectory, q0)
    resolution = resolution_or_default(resolution)
    inputs = resolution.inputs(robot, q0).shape[1]
    u0 = real_array("state[1]", u0, (inputs,), "one number for each joint, or each input")
    K = np.array([non_negative_numbers("gains", value, task.rows) for value in _pair("gains", gains)])
    flow = AccelerationFlow(robot, task, motion, resolution, K, null_acceleration)
    return _integrated(flow, np.concatenate([q0, u0]))


def _integrated(flow: VelocityFlow | AccelerationFlow, start: Array) -> FollowedTrajectory:
    """Integrate from one switching time of the trajectory to the next, to the end or to where it cannot go on.

    It cannot where a joint is too fast, or where the steps become too many.
    """
    ends, n = flow.trajectory.ends, flow.robot.nv
    fastest = RUNAWAY * flow.robot.units / ends[-1]
    if (np.abs(flow.command(0.0, start, "right").qdot) > fastest).any():
        return FollowedTrajectory(flow, (), start, ends[-1])
    inputs = flow.robot.units if flow.resolution.input_matrix is None else np.ones(len(start) - n)
    units = np.concatenate([flow.robot.units, inputs / flow.trajectory.duration])[: len(start)]
    segments = integrated(
        lambda t, state, side: flow.command(t, state, side).rate,
        ends,
        start,
        method="DOP853",
        rtol=PRECISION,
        atol=PRECISION * units,
        first_step=FIRST,
        stop=lambda rates: bool((np.abs(rates[:n]) > fastest).any()),  # the first derivatives of the state are q̇
        most_steps=STEPS,
    )
    return FollowedTrajectory(flow, segments, start, ends[-1])


def _start(robot: Robot, task: Task, trajectory: Any, q0: npt.ArrayLike) -> tuple[Array, Curve]:
    if robot.nq != robot.nv:
        raise InputError(
            f"robot {robot.name!r} has joints with several degrees of freedom; only arms of revolute and prismatic "
            f"joints can follow a trajectory"
        )
    if not robot.nv:
        raise TaskError(f"robot {robot.name!r} has no joint, so that nothing can follow the trajectory")
    task.check_integrable(robot)
    motion = as_curve("trajectory", trajectory, derivatives=2)
    if motion.shape != (task.rows,):
        raise InputError(
            f"the trajectory's velocity must have one number for each of {', '.join(task.row_names)}; it has the shape "
            f"{motion.shape}"
        )
    return robot.configuration(q0), motion


def _pair(name: str, value: Any) -> tuple[Any, Any]:
    try:
        first, second = value
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} must be two values; it is {value!r}") from error
    return first, second
