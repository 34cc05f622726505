"""How the Jacobian of a task changes with each joint."""

import numpy as np

from robotics1.differentiation import configuration_derivative
from robotics1.errors import TaskError
from robotics1.inputs import Array
from robotics1.kinematics import frame_jacobian
from robotics1.robot.model import Robot
from robotics1.symbolic.polynomials.time_limit import check_time
from robotics1.tasks.rows import constant_rows
from robotics1.tasks.task import Task


def jacobian_slopes(robot: Robot, task: Task, q: Array) -> Array:
    """Return ∂J/∂q, (m, nv, nv): the last index is that of the joint that moves.

    Of joints a and b of a chain, with columns (v, ω) of its frame's Jacobian and a before b,
    ∂v_b/∂q_a = ∂v_a/∂q_b = ω_a × v_b, ∂ω_b/∂q_a = ω_a × ω_b, and ∂ω_a/∂q_b = 0. Rows that depend on the pose, and
    joints that share a coordinate, are differentiated by differences.

    Raises:
        OutOfTime: the time of a limit that is kept is over.

    Source: Bruyninckx and De Schutter, Symbolic differentiation of the velocity mapping for a serial kinematic chain,
    Mechanism and Machine Theory 31, 1996.
    """
    form, S = task.frame_map(), standing_rows(robot, task)
    order = None if form is None or S is None else _order_of_chain(robot, form.frame)
    if form is None or S is None or order is None:

        def in_time(p: Array) -> Array:
            check_time()  # J of an arm of many joints is asked for hundreds of times in one step
            return task.jacobian(robot, p)

        return configuration_derivative(in_time, robot, q)
    J = frame_jacobian(robot, q, frame=form.frame, reference=form.reference).T[order]
    v, omega, k = J[:, :3], J[:, 3:], np.arange(len(order))
    before, behind = np.minimum.outer(k, k), np.maximum.outer(k, k)
    turning = np.tri(len(order), k=-1)[..., None] * np.cross(omega[None], omega[:, None])
    both = np.concatenate([np.cross(omega[before], v[behind]), turning], axis=2)
    slopes = np.zeros((len(S), robot.nv, robot.nv))
    slopes[np.ix_(range(len(S)), order, order)] = np.moveaxis(both @ S.T, 2, 0)
    return slopes


def standing_rows(robot: Robot, task: Task) -> Array | None:
    """Return S, (m, 6), of a task ṙ = S V whose S is the same everywhere and whose axes stand still, else None."""
    try:
        task.check_integrable(robot)
    except TaskError:
        return None
    return constant_rows(task)


def _order_of_chain(robot: Robot, frame: str | None) -> list[int] | None:
    """Return the columns of the joints that carry a frame, from the base; None if one shares its own or has several."""
    model = robot.own_model
    carrying = list(model.supports[model.frames[robot.frame_id(frame)].parentJoint])[1:]  # the first is the world
    joints = [model.joints[number] for number in carrying]
    order = [joint.idx_v for joint in joints]
    alone = len(set(order)) == len(order) and all(joint.nv == 1 for joint in joints)
    return order if alone else None
