"""Poses and rotations that a caller hands in, checked."""

from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array

ROTATION_TOLERANCE = 1e-6  # |RᵀR − 1| of a matrix that is taken for a rotation
PRINTED_DEFECT = 1e-2  # below, it may be a rotation printed with two or more digits


def homogeneous(name: str, value: Any) -> pin.SE3:
    """Return `value`, a `pin.SE3` or a homogeneous (4, 4) matrix, as a new `pin.SE3`; None is the identity.

    Raises:
        InputError: it has another shape, another last row, or its rotation is none to within 1e-6.
    """
    if value is None:
        return pin.SE3.Identity()
    matrix = value.homogeneous if isinstance(value, pin.SE3) else value
    T = real_array(name, matrix, (4, 4), "a pin.SE3 or a homogeneous matrix")
    if not np.allclose(T[3], [0, 0, 0, 1], atol=ROTATION_TOLERANCE):
        raise InputError(f"{name} must have the last row (0, 0, 0, 1); it is {T[3].tolist()}")
    return pin.SE3(rotation_matrix(f"{name}'s rotation", T[:3, :3]), T[:3, 3])


def rotation_matrix(name: str, value: Any) -> Array:
    """Return `value` as a rotation matrix (3, 3).

    Raises:
        InputError: its columns are not orthonormal and right-handed to within 1e-6.
    """
    R = real_array(name, value, (3, 3), "a rotation matrix")
    defect = float(np.abs(R.T @ R - np.eye(3)).max())
    if defect > ROTATION_TOLERANCE or np.linalg.det(R) < 0:
        printed = "; of one with few digits, nearest_rotation(R).rotation is exact" * (defect < PRINTED_DEFECT)
        raise InputError(
            f"{name} is no rotation: |RᵀR − 1| is {defect:.1e} and det R is {np.linalg.det(R):.3g}; "
            f"its columns must be orthonormal and right-handed{printed}"
        )
    return R
