"""Where a frame is and how fast it moves: forward kinematics and the frame Jacobian."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.errors import UnknownNameError
from robotics1.inputs import Array
from robotics1.robot.model import Robot

STEP = 1e-6  # of central differences: error about STEP² from the curve and 1e-16/STEP from rounding


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
    """Return ∂f/∂q by central differences, shape f(q).shape + (nv,): for any f, exact to about 1e-9.

    f may be vector or matrix valued; the steps are taken with `pin.integrate`, so that joints of any kind serve.
    """
    q = robot.configuration(q)
    steps = STEP * np.eye(robot.nv)
    ahead = [f(pin.integrate(robot.model, q, step)) for step in steps]
    back = [f(pin.integrate(robot.model, q, -step)) for step in steps]
    return np.stack([(a - b) / (2 * STEP) for a, b in zip(ahead, back, strict=True)], axis=-1)


def _is(reference: str, name: str) -> bool:
    """Whether a reference is this name; what is no text at all is none, and is refused with the unknown frames."""
    return isinstance(reference, str) and reference == name
