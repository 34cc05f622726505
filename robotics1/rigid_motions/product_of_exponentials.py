"""A robot as a product of exponentials: from the screws of its joints, and back."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.dh.entries import Limits, joint_limits
from robotics1.errors import InputError
from robotics1.inputs import Array, moderate, one_of, real_array
from robotics1.kinematics import forward_kinematics, frame_jacobian
from robotics1.rigid_motions.changes_of_frame import adjoint
from robotics1.rigid_motions.exponential import pose_exp
from robotics1.robot.assembly import robot_of_joints
from robotics1.robot.checking import MOST_DEGREES
from robotics1.robot.given import RobotLike, robot_from
from robotics1.robot.joints import Joint, Triple, placed
from robotics1.robot.model import Robot
from robotics1.robot.placements import homogeneous

Axes = Literal["space", "body"]
UNIT = 1e-6  # by which the length of a unit vector may be off
NO_PITCH = 1e-9  # m/rad, of the larger of 1 and |v|: a pitch that rounding leaves
AGREES = 1e-9  # of the larger of 1 and the reach: entries of poses that are the same


def robot_from_screws(
    M: Any,
    *,
    space: Sequence[Any] | None = None,
    body: Sequence[Any] | None = None,
    lower: Limits = None,
    upper: Limits = None,
) -> Robot:
    """Return the robot with T(q) = e^([S₁] q₁) ⋯ e^([Sₙ] qₙ) M, or T(q) = M e^([B₁] q₁) ⋯ e^([Bₙ] qₙ).

    A screw with |ω| = 1 is a revolute joint: v = −ω × point. One with ω = 0 and |v| = 1 is prismatic. One of another
    pitch h = ωᵀv is helical: a revolute joint q_i with a slide `slide{i}` that follows it, h for each radian; it has
    numbers, and no formulas. The joints are q1, q2, ...

    Args:
        M: the tool's pose at q = 0, a `pin.SE3` or (4, 4).
        space: one (ω, v) a joint, in world axes, v [m] that of the point at the world's origin.
        body: instead, one (ω, v) a joint, in the axes and at the origin of the tool at q = 0.
        lower, upper: (n,) joint limits [rad or m]; None, for all or for one, means none.

    Raises:
        InputError: M is no pose, a screw is none, or not one of `space` and `body` is given.

    Source: Lynch, Park, Modern Robotics, 2017, section 4.1.
    """
    home = homogeneous("M", M)
    if (space is None) == (body is None):
        raise InputError("give the screws once: either space=[(w, v), ...] or body=[(w, v), ...]")
    name, given = ("space", space) if body is None else ("body", body)
    pairs = _listed(name, given)
    twists = [_unit_screw(f"screw {i} of {name}", pair) for i, pair in enumerate(pairs, 1)]
    if body is not None:
        twists = [adjoint(home) @ twist for twist in twists]
    limits = joint_limits(lower, upper, [bool(twist[3:].any()) for twist in twists])
    joints: list[Joint] = []
    origin: Array = np.zeros(3)
    for i, twist in enumerate(twists, 1):
        parent = joints[-1].child if joints else "base"
        added, origin = _joints_of(i, twist, parent, origin, limits[0][i - 1], limits[1][i - 1])
        joints += added
    last = pin.SE3(home.rotation, home.translation - origin)
    mount = Joint("tool_mount", "fixed", joints[-1].child, "tool")
    return robot_of_joints("screws", [*joints, placed(mount, last)])


def screws(robot: RobotLike, *, kind: Axes = "space", frame: str | None = None) -> Array:
    """Return the screws (ω, v) of a robot's joints at q = 0, (n, 2, 3), with T(q) = e^([S₁] q₁) ⋯ e^([Sₙ] qₙ) M.

    M = `forward_kinematics(robot, 0)`; `robot_from_screws(M, space=screws(robot))` moves alike. Of kind "body" they
    stand behind M. The screw of a joint that does not move the frame is zero.

    Args:
        robot: the robot.
        kind: "space" or "body".
        frame: the frame at the end; by default the tool.

    Raises:
        InputError: a joint has several coordinates, or follows another, so that the pose is no such product.
        UnknownNameError: there is no such frame.

    Source: Lynch, Park, Modern Robotics, 2017, sections 4.1 and 5.1: at q = 0 they are the columns of the Jacobian.
    """
    robot = robot_from(robot)
    one_of("kind", kind, ("space", "body"))
    robot.require_single_coordinates("are products of exponentials")
    home = np.zeros(robot.nq)
    J = frame_jacobian(robot, home, frame=frame, kind=kind)
    M = forward_kinematics(robot, home, frame=frame)
    rng = np.random.default_rng(0)
    for q in rng.uniform(-1, 1, (3, robot.nq)):
        product = pin.SE3.Identity() if kind == "space" else M
        for column, value in zip(J.T, q, strict=True):
            product = product * pose_exp(column * value)
        product = product * M if kind == "space" else product
        off = product.homogeneous - forward_kinematics(robot, q, frame=frame).homogeneous
        if np.abs(off).max() > AGREES * max(1.0, robot.reach):
            raise InputError("the pose is no product of one exponential a joint: a joint follows another")
    return np.stack([J[3:].T, J[:3].T], axis=1)


def _listed(name: str, screws: Any) -> list[Any]:
    """Return the screws as a list.

    Raises:
        InputError: there is none, or too many.
    """
    try:
        listed = list(screws)
    except TypeError as error:
        raise InputError(f"{name} must be a list of (w, v), one a joint; it is {screws!r}") from error
    if not 0 < len(listed) <= MOST_DEGREES:
        raise InputError(f"{name} must hold 1 to {MOST_DEGREES} screws (w, v), one a joint; it holds {len(listed)}")
    return listed


def _unit_screw(name: str, pair: npt.ArrayLike) -> Array:
    """Return (v, ω), (6,), with |ω| = 1, or ω = 0 and |v| = 1.

    Raises:
        InputError: it is no screw.
    """
    omega, v = moderate(name, real_array(name, pair, (2, 3), "(w, v)"))
    turn, slide = float(np.linalg.norm(omega)), float(np.linalg.norm(v))
    if abs(turn - 1) <= UNIT:
        omega = omega / turn
        h = float(omega @ v)
        return np.concatenate([v - h * omega if abs(h) <= NO_PITCH * max(1.0, slide) else v, omega])
    if turn == 0 and abs(slide - 1) <= UNIT:
        return np.concatenate([v / slide, omega])
    raise InputError(
        f"{name} must have |w| = 1, or w = 0 and |v| = 1; here |w| = {turn:.6g} and |v| = {slide:.6g}. "
        f"Divide (w, v) by |w|, or by |v| where w = 0"
    )


def _joints_of(
    i: int, twist: Array, parent: str, origin: Array, lower: float, upper: float
) -> tuple[list[Joint], Array]:
    """Return the joints of one screw, whose frames have world axes at q = 0, and the origin of the last."""
    v, omega = twist[:3], twist[3:]
    q, child = f"q{i}", f"link{i}"
    if not omega.any():
        return [Joint(q, "prismatic", parent, child, axis=_triple(v), lower=lower, upper=upper)], origin
    point, pitch = np.cross(omega, v), float(omega @ v)
    if abs(pitch) <= NO_PITCH * max(1.0, float(np.linalg.norm(v))):
        xyz = _triple(point - origin)
        return [Joint(q, "revolute", parent, child, xyz, axis=_triple(omega), lower=lower, upper=upper)], point
    half, slide, axis = f"{child}_turned", f"slide{i}", _triple(omega)
    turn = Joint(q, "revolute", parent, half, _triple(point - origin), axis=axis, lower=lower, upper=upper)
    return [turn, Joint(slide, "prismatic", half, child, axis=axis, leader=q, multiplier=pitch)], point


def _triple(values: Array) -> Triple:
    x, y, z = map(float, values)
    return x, y, z
