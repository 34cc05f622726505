"""The exponential of a twist, which is a pose, and its inverse."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt
import pinocchio as pin

from robotics1.inputs import Array, moderate, true_or_false
from robotics1.orientation.axis_angle import rotation_to_axis_angle
from robotics1.rigid_motions.changes_of_frame import linear_first
from robotics1.robot.placements import ROTATION_TOLERANCE, homogeneous


def pose_exp(V: npt.ArrayLike, *, angular_first: bool = False) -> pin.SE3:
    """Return T = e^[V], the pose that the identity reaches when it moves with the constant twist V for a time of 1.

    With θ = |ω|, R = e^[ω]× and p = (1 + (1 − cos θ)/θ² [ω]× + (θ − sin θ)/θ³ [ω]×²) v.

    Args:
        V: (6,) v [m] and ω [rad]: S θ of a screw S and an angle θ, in the axes in which T is.
        angular_first: V is (ω, v), as Lynch and Park write it; otherwise (v, ω).

    Raises:
        InputError: V is not six finite numbers, or one is larger than 1e30.

    Source: Lynch, Park, Modern Robotics, 2017, section 3.3.3.
    """
    return pin.exp6(moderate("V", linear_first("V", V, angular_first)))


def pose_log(T: Any, *, angular_first: bool = False) -> Array:
    """Return V, (6,), with e^[V] = T and |ω| ≤ π: the twist that takes the identity to T in a time of 1.

    With ω = θ r: v = (rᵀp) r + (θ/2) cot(θ/2) (p − (rᵀp) r) − ½ θ r × p. No difference of large numbers is taken, also
    near no turn and near half a turn. At θ = π both r and −r are right; the one is given that
    `rotation_to_axis_angle` gives.

    Args:
        T: a `pin.SE3`, or a homogeneous matrix (4, 4).
        angular_first: give (ω, v), as Lynch and Park write it; otherwise (v, ω).

    Raises:
        InputError: T is no pose.

    Source: Lynch, Park, Modern Robotics, 2017, section 3.3.3.
    """
    pose = homogeneous("T", T)
    moderate("T's translation", pose.translation)
    omega, p = rotation_vector(pose.rotation), np.array(pose.translation)
    theta = float(np.linalg.norm(omega))
    v = p
    if theta > 0:
        along = (omega / theta) @ p * (omega / theta)
        v = along + (theta / 2) / np.tan(theta / 2) * (p - along) - np.cross(omega, p) / 2
    return np.concatenate([omega, v] if true_or_false("angular_first", angular_first) else [v, omega])


def rotation_vector(R: Array) -> Array:
    """Return θ r, (3,), θ ∈ [0, π], of a rotation (3, 3).

    Pinocchio's log3 has all digits of a small turn, and loses some next to half a turn, where the unit quaternion has
    all.
    """
    if np.trace(R) > 1:  # less than a quarter of a turn
        return np.asarray(pin.log3(R))
    turned = rotation_to_axis_angle(R, tolerance=2 * ROTATION_TOLERANCE)
    return np.zeros(3) if turned.axis is None else turned.angle * turned.axis
