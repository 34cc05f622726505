"""Joint and Cartesian control laws from what is wanted and from gains."""

from __future__ import annotations

from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from robotics1.control.error_axes import error_axes
from robotics1.control.gain_matrix import gain_matrix
from robotics1.control.law import ControlLaw
from robotics1.curves.given import as_curve
from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, one_of, true_or_false
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import Robot
from robotics1.tasks.function import FunctionTask
from robotics1.tasks.given import TaskLike, robot_and_task
from robotics1.tasks.task import Task
from robotics1.trajectories.following.resolution import Resolution, Wish, resolution_or_default

Method = Literal["newton", "gradient"]
METHODS: tuple[Method, ...] = get_args(Method)


def the_joints(p: Array, R: Array, q: Array) -> Array:
    """Return q."""
    return q


def their_derivative(p: Array, R: Array, q: Array) -> Array:
    """Return the identity."""
    return np.eye(len(q))


def joint_law(
    robot: RobotLike,
    wanted: Any,
    K: npt.ArrayLike,
    D: npt.ArrayLike | None = None,
    *,
    feedforward: bool = True,
) -> ControlLaw:
    """Return the law q̇ = q̇_d + K (q_d − q), or with D q̈ = q̈_d + D (q̇_d − q̇) + K (q_d − q).

    Args:
        robot: an arm of revolute and prismatic joints.
        wanted: q_d(t), a motion, or q_d (n,) at rest.
        K: gains, one number, (n,) or (n, n), positive definite [1/s, or 1/s² of second order].
        D: gains of the velocity error [1/s]; None for a law of first order.
        feedforward: whether q̇_d, or q̈_d, is added.

    Raises:
        InputError: a gain is not positive definite, or the motion is of other joints.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7, with joint errors.
    """
    robot = robot_from(robot)
    robot.require_single_coordinates("have a joint law")
    task = FunctionTask(the_joints, robot.nv, their_derivative, frame=robot.frame_names[0]) if robot.nv else None
    if task is None:
        raise TaskError(f"robot {robot.name!r} has no joint to control")
    return _law(robot, task, wanted, K, D, None, "newton", feedforward, None, None, of_joints=True)


def cartesian_law(
    robot: RobotLike,
    task: TaskLike,
    wanted: Any,
    K: npt.ArrayLike,
    D: npt.ArrayLike | None = None,
    *,
    axes: Any = None,
    method: Method = "newton",
    feedforward: bool = True,
    resolution: Resolution | None = None,
    null_motion: Wish = None,
) -> ControlLaw:
    """Return the law q̇ = J# (ṙ_d + A K Aᵀ e), or with D q̈ = J# (r̈_d + A D Aᵀ ė + A K Aᵀ e − J̇ q̇), e = r_d − f(q).

    In moving axes it has besides the terms of Ȧ that make the error in them obey ė' = −K e', or ë' = −D ė' − K e'.

    Args:
        robot: an arm of revolute and prismatic joints.
        task: r = f(q).
        wanted: r_d(t), a motion, or r_d at rest, in the form of the task's value.
        K: gains, one number, (m,) or (m, m), positive definite [1/s, or 1/s² of second order].
        D: gains of the velocity error [1/s]; None for a law of first order.
        axes: in which the gains count: None for those of the task; an (m, m) rotation whose columns they are; a motion
            R(t) of three axes, as PathTrajectory(turn_path(...), law); or "frenet", the tangent and normals of the
            path of a PathTrajectory.
        method: "newton", with J#; or "gradient", q̇ = Jᵀ K e, of first order and for a target at rest.
        feedforward: whether ṙ_d, or r̈_d, is added.
        resolution: which inverse J# is taken; by default the pseudoinverse, which is J⁻¹ of a square J.
        null_motion: q̇₀ (n,), or a function of q; of second order q̈₀, or a function of q and q̇.

    Raises:
        InputError: a gain is not positive definite, the axes are none, or the motion has other rows than the task.
        TaskError: the task does not fit the robot, or its axes move with it.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, sections 3.7.1 (Newton), 3.7.2 (gradient), 3.7.4
    (second order).
    """
    robot, task = robot_and_task(robot, task)
    robot.require_single_coordinates("have a Cartesian law")
    if not robot.nv:
        raise TaskError(f"robot {robot.name!r} has no joint to control")
    return _law(robot, task, wanted, K, D, axes, method, feedforward, resolution, null_motion, of_joints=False)


def _law(
    robot: Robot,
    task: Task,
    wanted: Any,
    K: npt.ArrayLike,
    D: npt.ArrayLike | None,
    axes: Any,
    method: str,
    feedforward: bool,
    resolution: Resolution | None,
    null_motion: Wish,
    *,
    of_joints: bool,
) -> ControlLaw:
    task.check_integrable(robot)
    m, second = task.rows, D is not None
    moves = callable(wanted) or hasattr(wanted, "trajectory")
    motion = as_curve("wanted", wanted, derivatives=1 + second) if moves else None
    if motion is not None and motion.shape != (m,):
        raise InputError(f"the motion must have {m} rows, as the task {task.row_names}; it has {motion.shape}")
    one = one_of("method", method, METHODS)
    if one == "gradient" and (second or moves or null_motion is not None):
        raise InputError("the gradient law is of first order, for a target at rest, without null motion")
    chosen = resolution_or_default(resolution)
    if chosen.input_matrix is not None:
        raise InputError("a control law commands the joints themselves: leave out the input matrix")
    return ControlLaw(
        robot,
        task,
        None if moves else task.target(wanted),
        motion,
        gain_matrix("K", K, m, symmetric=second),
        None if D is None else gain_matrix("D", D, m, symmetric=True),
        error_axes(axes, m, motion),
        one,
        true_or_false("feedforward", feedforward),
        chosen,
        null_motion,
        of_joints,
    )
