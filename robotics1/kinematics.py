"""Where a frame is and how fast it moves: forward kinematics, the frame Jacobian and its rate of change."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.errors import InputError, UnknownNameError
from robotics1.inputs import Array, one_of, real_array, true_or_false
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.model import ConfigurationLike, Robot

JacobianKind = Literal["mixed", "space", "body"]
KINDS = {"mixed": pin.LOCAL_WORLD_ALIGNED, "space": pin.WORLD, "body": pin.LOCAL}


def forward_kinematics(
    robot: RobotLike, q: ConfigurationLike, *, frame: str | None = None, point: npt.ArrayLike | None = None
) -> pin.SE3:
    """Return T_world_frame(q): rotation (3, 3) and translation (3,) [m] of a frame, by default the tool.

    Args:
        robot: the robot.
        q: (nq,) configuration [rad or m]; of several, (k, nq), the answer is an array of matrices T, (k, 4, 4).
        frame: the frame's name.
        point: (3,) a point c that is fixed to the frame, in its axes [m], to which the frame's origin is moved:
            p_c = p + R c.

    Raises:
        InputError: q or the point has the wrong shape or is not finite.
        UnknownNameError: there is no such frame.
    """
    robot = robot_from(robot)
    number = robot.frame_id(frame)
    c = point_of_frame(point)
    if is_batch(q):
        return of_each(
            lambda one: forward_kinematics(robot, one, frame=frame, point=point).homogeneous, robot, q, (4, 4)
        )
    pin.forwardKinematics(robot.own_model, robot.data, robot.configuration(q))
    T = pin.SE3(pin.updateFramePlacement(robot.own_model, robot.data, number))
    return T if c is None else pin.SE3(T.rotation, T.act(c))


def frame_jacobian(
    robot: RobotLike,
    q: ConfigurationLike,
    *,
    frame: str | None = None,
    reference: str = "world",
    kind: JacobianKind = "mixed",
    angular_first: bool = False,
    point: npt.ArrayLike | None = None,
) -> Array:
    """Return J(q), (6, nv), with (v, ω) = J q̇: the velocity [m/s] of a point over the angular velocity [rad/s] of the
    frame, both relative to the world.

    ========  ====================================  ================  =========
    kind      the point that v belongs to           axes of the rows  written
    ========  ====================================  ================  =========
    "mixed"   the frame's origin                    the world's       J
    "space"   that of the frame's body which is at  the world's       J_s
              the world's origin
    "body"    the frame's origin                    the frame's own   J_b
    ========  ====================================  ================  =========

    With T = (R, p) the pose of the frame: J_b = diag(Rᵀ, Rᵀ) J and J_s = Ad_T J_b; J_s q̇ is the spatial twist,
    [V_s] = Ṫ T⁻¹, and J_b q̇ the body twist, [V_b] = T⁻¹ Ṫ.

    Args:
        robot: the robot.
        q: (nq,) configuration [rad or m]; of several, (k, nq), the answer is (k, 6, nv).
        frame: whose velocity; by default the tool's.
        reference: the axes the rows of a mixed Jacobian are written in: "world", "tool", or the name of a frame.
            ʳJ = diag(R_rᵀ, R_rᵀ) J: the same velocity, other axes.
        kind: "mixed", "space" or "body".
        angular_first: the rows of ω over those of v, as Lynch and Park write twists.
        point: (3,) a point c that is fixed to the frame, in its axes [m], that takes the place of its origin:
            v_c = v + ω × R c. A space Jacobian is the same for every point.

    Raises:
        InputError: q or the point has the wrong shape or is not finite; or kind is none of these, or has other axes
            than reference.
        UnknownNameError: there is no such frame or reference.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.1; Lynch, Park, Modern Robotics, 2017,
    section 5.1 (space and body).
    """
    robot = robot_from(robot)
    number = robot.frame_id(frame)
    if is_batch(q):
        J_at = partial(frame_jacobian, robot, frame=frame, reference=reference, kind=kind, point=point)
        return of_each(partial(J_at, angular_first=angular_first), robot, q, (6, robot.nv))
    q = robot.configuration(q)
    J = pin.computeFrameJacobian(robot.own_model, robot.data, q, number, KINDS[one_of("kind", kind, tuple(KINDS))])
    J = J.reshape(6, robot.nv)  # Pinocchio drops the second axis of a single column
    c = point_of_frame(point)
    if c is not None and kind != "space":
        arm = robot.data.oMf[number].rotation @ c if kind == "mixed" else c
        J = np.vstack([J[:3] + np.cross(J[3:], arm, axisa=0, axisc=0), J[3:]])
    if not _is(reference, "world"):
        R = reference_axes(robot, q, reference)
        if kind != "mixed":
            raise InputError(
                f"a {kind} Jacobian has axes of its own, so that reference must stay 'world'; it is {reference!r}"
            )
        J = np.vstack([R.T @ J[:3], R.T @ J[3:]])
    return np.asarray(np.roll(J, 3, axis=0) if true_or_false("angular_first", angular_first) else J)


def frame_jacobian_rate(
    robot: RobotLike,
    q: ConfigurationLike,
    qdot: npt.ArrayLike,
    *,
    frame: str | None = None,
    reference: str = "world",
    point: npt.ArrayLike | None = None,
) -> Array:
    """Return J̇(q, q̇), (6, nv), of the frame Jacobian: the acceleration of the frame is (v̇, ω̇) = J q̈ + J̇ q̇.

    v̇ is that of the frame's origin, as a curve in space. In axes that move with ω_r it is the derivative of the matrix
    ʳJ = diag(R_rᵀ, R_rᵀ) J: its blocks are R_rᵀ (J̇ − [ω_r]× J).

    Args:
        robot: the robot.
        q: (nq,) configuration [rad or m].
        qdot: (nv,) q̇ [rad/s or m/s].
        frame: whose; by default the tool's.
        reference: the axes the rows are written in: "world", "tool", or the name of a frame.
        point: (3,) a point that is fixed to the frame, in its axes [m], in the place of its origin.

    Raises:
        InputError: q, qdot or the point has the wrong shape or is not finite.
        UnknownNameError: there is no such frame or reference.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.4; Featherstone, Rigid Body Dynamics
    Algorithms, 2008, section 2.10 (the derivative of a motion vector that is fixed in a moving body).
    """
    robot = robot_from(robot)
    q = robot.configuration(q)
    qdot = velocity_of_joints(robot, "qdot", qdot)
    rate = _jacobian_rate(robot, q, qdot, robot.frame_id(frame), point_of_frame(point))
    if _is(reference, "world"):
        return rate
    R = reference_axes(robot, q, reference)
    J = frame_jacobian(robot, q, frame=frame, point=point)
    omega = frame_jacobian(robot, q, frame=None if _is(reference, "tool") else reference)[3:] @ qdot
    turning = np.vstack([np.cross(omega, J[:3], axisb=0, axisc=0), np.cross(omega, J[3:], axisb=0, axisc=0)])
    return np.vstack([R.T @ (rate - turning)[:3], R.T @ (rate - turning)[3:]])


def _jacobian_rate(robot: Robot, q: Array, qdot: Array, frame: int, point: Array | None) -> Array:
    """Return J̇, (6, nv), of a point of a frame in world axes, from the motions of the joints before it.

    At the world's origin, the unit motion S = (v, ω) of a joint is constant in the axes of the body that the joint
    carries, which moves with V: Ṡ = V × S. At the point p, the frame's origin or another of its points,
    (v + ω × p)˙ = v̇ + ω̇ × p + ω × ṗ. A joint that mimics adds its own motion to the column of its leader. (Pinocchio's
    getFrameJacobianTimeVariation forgets it, and crashes on a model without joints.)
    """
    model, data = robot.own_model, robot.data
    pin.forwardKinematics(model, data, q, qdot)
    pin.computeJointJacobians(model, data)
    T = pin.updateFramePlacement(model, data, frame)
    p = np.array(T.translation if point is None else T.act(point))
    S = np.array(data.J).reshape(6, -1)  # a column for each coordinate of each joint, those that mimic included
    J, rate = np.zeros((6, robot.nv)), np.zeros((6, robot.nv))
    for i in [*model.supports[model.frames[frame].parentJoint]][1:]:  # without the world
        joint, V = model.joints[i], data.oMi[i].act(data.v[i])
        own = S[:, joint.idx_vExtended : joint.idx_vExtended + joint.nvExtended]
        columns = slice(joint.idx_v, joint.idx_v + joint.nvExtended)  # of a joint that mimics, its leader's
        J[:, columns] += own
        rate[:, columns] += V.action @ own
    v = J[:3] + np.cross(J[3:], p, axisa=0, axisc=0)
    rate[:3] += np.cross(rate[3:], p, axisa=0, axisc=0) + np.cross(J[3:], v @ qdot, axisa=0, axisc=0)
    return rate


def reference_axes(robot: Robot, q: ConfigurationLike, reference: str) -> Array:
    """Return R_world_reference(q), (3, 3): the axes of "world", of "tool", or of a named frame.

    Raises:
        UnknownNameError: there is no such frame.
    """
    if _is(reference, "world"):
        return np.eye(3)
    if reference is None:
        raise UnknownNameError("reference named", reference, ("world", "tool", *robot.frame_names))
    frame = None if _is(reference, "tool") else reference
    return np.array(forward_kinematics(robot, q, frame=frame).rotation)


def point_of_frame(point: npt.ArrayLike | None) -> Array | None:
    """Return a point of a frame, in the frame's axes [m], as (3,); None for its origin.

    Raises:
        InputError: it is no such thing.
    """
    return None if point is None else real_array("point", point, (3,), "in the axes of the frame [m]")


def velocity_of_joints(robot: Robot, name: str, value: npt.ArrayLike) -> Array:
    """Return joint velocities or accelerations as (nv,).

    Raises:
        InputError: there is not one finite number for each degree of freedom.
    """
    return real_array(name, value, (robot.nv,), "one number for each degree of freedom")


def is_batch(q: ConfigurationLike) -> bool:
    """Whether q is several configurations, (k, nq)."""
    if isinstance(q, np.ndarray):
        return q.ndim == 2
    try:
        return not isinstance(q, str | Mapping) and np.ndim(q) == 2
    except (TypeError, ValueError):
        return False  # no array at all, which is said where it is read


def of_each(f: Callable[[Array], npt.ArrayLike], robot: Robot, q: Any, shape: tuple[int, ...]) -> Array:
    """Return what a function gives at each of several configurations (k, nq), (k, *shape)."""
    values = [f(one) for one in robot.configurations(q)]
    return np.reshape(np.asarray(values, dtype=float), (len(values), *shape))


def _is(reference: str, name: str) -> bool:
    """Whether a reference is this name; what is no text at all is none, and is refused with the unknown frames."""
    return isinstance(reference, str) and reference == name
