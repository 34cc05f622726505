"""Poses and rotations that a caller hands in, checked."""

from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.angles import warn_of_degrees
from robotics1.errors import InputError
from robotics1.inputs import Array, dimensions, real_array

ROTATION_TOLERANCE = 1e-6  # |RᵀR − 1| of a matrix that is taken for a rotation
QUATERNION_TOLERANCE = 1e-4  # of its length, printed with four digits or more
MEANING = "a pin.SE3 or a homogeneous matrix, a RigidTransform, (xyz, rpy) or (xyz, quaternion)"
PRINTED_DEFECT = 1e-2  # below, it may be a rotation printed with two or more digits


def homogeneous(name: str, value: Any) -> pin.SE3:
    """Return a pose as a new `pin.SE3`; None is the identity.

    It is a `pin.SE3`, a homogeneous matrix (4, 4), a `RigidTransform` of SciPy, or a pair (xyz, rotation) with a
    rotation as `rotation_matrix` takes it.

    Raises:
        InputError: it is none of these, or its rotation is none to within 1e-6.
    """
    if value is None:
        return pin.SE3.Identity()
    if _is_a_pair(value):
        return pin.SE3(rotation_matrix(f"{name}'s rotation", value[1]), real_array(f"{name}'s xyz", value[0], (3,)))
    matrix = value.homogeneous if isinstance(value, pin.SE3) else value
    matrix = matrix.as_matrix() if hasattr(matrix, "as_matrix") and hasattr(matrix, "translation") else matrix
    T = real_array(name, matrix, (4, 4), MEANING)
    if np.abs(T[3] - [0, 0, 0, 1]).max() > ROTATION_TOLERANCE:
        raise InputError(f"{name} must have the last row (0, 0, 0, 1); it is {T[3].tolist()}")
    return pin.SE3(rotation_matrix(f"{name}'s rotation", T[:3, :3]), T[:3, 3])


def _is_a_pair(value: Any) -> bool:
    """Whether a value is (xyz, rotation): three numbers, and three angles, a quaternion, a matrix or a `Rotation`."""
    return isinstance(value, tuple | list) and len(value) == 2 and np.size(value[0]) == 3


def rotation_matrix(name: str, value: Any) -> Array:
    """Return a rotation as a matrix (3, 3).

    It is a matrix, a `Rotation` of SciPy, roll, pitch and yaw (3,) [rad] with R = Rot_z(yaw) Rot_y(pitch) Rot_x(roll),
    or a quaternion (x, y, z, w) of length 1.

    Raises:
        InputError: it is none of these, or the columns are not orthonormal and right-handed to within 1e-6.
    """
    if hasattr(value, "as_quat") and hasattr(value, "as_matrix"):
        value = value.as_matrix()
    if dimensions(name, value) == 1 and len(value) == 3:
        rpy = real_array(name, value, (3,), "roll, pitch and yaw [rad]")
        warn_of_degrees(name, rpy)
        return np.asarray(pin.rpy.rpyToMatrix(rpy))
    if dimensions(name, value) == 1 and len(value) == 4:
        quaternion = real_array(name, value, (4,), "a quaternion (x, y, z, w)")
        length = float(np.linalg.norm(quaternion))
        if abs(length - 1) > QUATERNION_TOLERANCE:
            raise InputError(f"{name} must be a quaternion (x, y, z, w) of length 1; its length is {length:g}")
        return np.asarray(pin.Quaternion(quaternion / length).toRotationMatrix())
    R = real_array(name, value, (3, 3), "a rotation matrix")
    defect = float(np.abs(R.T @ R - np.eye(3)).max())
    if defect > ROTATION_TOLERANCE or np.linalg.det(R) < 0:
        printed = "; of one with few digits, nearest_rotation(R).rotation is exact" * (defect < PRINTED_DEFECT)
        raise InputError(
            f"{name} is no rotation: |RᵀR − 1| is {defect:.1e} and det R is {np.linalg.det(R):.3g}; "
            f"its columns must be orthonormal and right-handed{printed}"
        )
    return R
