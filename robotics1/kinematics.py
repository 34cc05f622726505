"""Where a frame is and how fast it moves: forward kinematics, the frame Jacobian and its rate of change."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.errors import UnknownNameError
from robotics1.inputs import Array, real_array
from robotics1.robot.model import Robot

STEP = 1e-4  # of differences of fourth order: error about STEP⁴ from the curve and 1e-16/STEP from rounding
STRIDE = 5e-3  # of differences of sixth order: error about STRIDE⁶/140 from the curve and 1e-16/STRIDE from rounding


def forward_kinematics(robot: Robot, q: npt.ArrayLike, *, frame: str | None = None) -> pin.SE3:
    """Return T_world_frame(q): rotation (3, 3) and translation (3,) [m] of a frame, by default the tool.

    Args:
        robot: the robot.
        q: (nq,) configuration [rad or m].
        frame: the frame's name.

    Raises:
        InputError: q has the wrong shape or is not finite.
        UnknownNameError: there is no such frame.
    """
    q = robot.configuration(q)
    number = robot.frame_id(frame)
    pin.forwardKinematics(robot.model, robot.data, q)
    return pin.SE3(pin.updateFramePlacement(robot.model, robot.data, number))


def frame_jacobian(robot: Robot, q: npt.ArrayLike, *, frame: str | None = None, reference: str = "world") -> Array:
    """Return J(q), (6, nv), with (v, ω) = J q̇: the velocity [m/s] of the frame's origin over its angular
    velocity [rad/s], both relative to the world and written in world axes.

    Args:
        robot: the robot.
        q: (nq,) configuration [rad or m].
        frame: whose velocity; by default the tool's.
        reference: the axes the rows are written in: "world", "tool", or the name of a frame.
            ʳJ = diag(R_rᵀ, R_rᵀ) J: the same velocity, other axes.

    Raises:
        InputError: q has the wrong shape or is not finite.
        UnknownNameError: there is no such frame or reference.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.1.
    """
    q = robot.configuration(q)
    number = robot.frame_id(frame)
    J = pin.computeFrameJacobian(robot.model, robot.data, q, number, pin.LOCAL_WORLD_ALIGNED)
    J = J.reshape(6, robot.nv)  # Pinocchio drops the second axis of a single column
    if not _is(reference, "world"):
        R = reference_axes(robot, q, reference)
        J = np.vstack([R.T @ J[:3], R.T @ J[3:]])
    return np.asarray(J)


def frame_jacobian_rate(
    robot: Robot, q: npt.ArrayLike, qdot: npt.ArrayLike, *, frame: str | None = None, reference: str = "world"
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

    Raises:
        InputError: q or qdot has the wrong shape or is not finite.
        UnknownNameError: there is no such frame or reference.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.7.4; the derivative is Pinocchio's.
    """
    q = robot.configuration(q)
    qdot = joint_rates(robot, "qdot", qdot)
    number = robot.frame_id(frame)
    pin.computeJointJacobiansTimeVariation(robot.model, robot.data, q, qdot)
    pin.updateFramePlacement(robot.model, robot.data, number)
    rate = pin.getFrameJacobianTimeVariation(robot.model, robot.data, number, pin.LOCAL_WORLD_ALIGNED)
    rate = np.array(rate.reshape(6, robot.nv))  # Pinocchio drops the second axis of a single column
    if _is(reference, "world"):
        return rate
    R = reference_axes(robot, q, reference)
    J = frame_jacobian(robot, q, frame=frame)
    omega = frame_jacobian(robot, q, frame=None if _is(reference, "tool") else reference)[3:] @ qdot
    turning = np.vstack([np.cross(omega, J[:3], axisb=0, axisc=0), np.cross(omega, J[3:], axisb=0, axisc=0)])
    return np.vstack([R.T @ (rate - turning)[:3], R.T @ (rate - turning)[3:]])


def reference_axes(robot: Robot, q: npt.ArrayLike, reference: str) -> Array:
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


def configuration_derivative(f: Callable[[Array], Array], robot: Robot, q: npt.ArrayLike) -> Array:
    """Return ∂f/∂q by central differences, shape f(q).shape + (nv,): for any f, exact to about 1e-11.

    f may be vector or matrix valued; the steps are taken with `pin.integrate`, so that joints of any kind serve.
    """
    q = robot.configuration(q)

    def along(step: Array) -> Array:
        near, far = (
            f(pin.integrate(robot.model, q, k * step)) - f(pin.integrate(robot.model, q, -k * step)) for k in (1, 2)
        )
        return np.asarray((8 * near - far) / (12 * STEP))

    return np.stack([along(step) for step in STEP * np.eye(robot.nv)], axis=-1)


def directional_derivative(f: Callable[[Array], Array], robot: Robot, q: Array, qdot: Array) -> Array:
    """Return d f(q)/dt while the joints move with q̇, in the shape of f(q): by central differences of sixth order.

    The joints move by multiples of 0.005 rad or m at most; for smooth f it is exact to about 1e-12.
    """
    speed = float(np.abs(qdot).max(initial=0.0))
    if speed == 0:
        return np.zeros_like(f(q))
    step = STRIDE / speed

    def difference(k: int) -> Array:
        ahead, back = (f(pin.integrate(robot.model, q, sign * k * step * qdot)) for sign in (1, -1))
        return np.asarray(ahead - back)

    return np.asarray((45 * difference(1) - 9 * difference(2) + difference(3)) / (60 * step))


def joint_rates(robot: Robot, name: str, value: npt.ArrayLike) -> Array:
    """Return joint velocities or accelerations as (nv,).

    Raises:
        InputError: there is not one finite number for each degree of freedom.
    """
    return real_array(name, value, (robot.nv,), "one number for each degree of freedom")


def _is(reference: str, name: str) -> bool:
    """Whether a reference is this name; what is no text at all is none, and is refused with the unknown frames."""
    return isinstance(reference, str) and reference == name
