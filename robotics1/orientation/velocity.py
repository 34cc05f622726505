"""The angular velocity of a rotation that changes."""

from typing import Any

from robotics1.inputs import one_of
from robotics1.orientation.elementary import axial_vector
from robotics1.orientation.expressions import Matrix, expressions, simplified
from robotics1.orientation.nearest import PRINTED, rotation_of


def angular_velocity(R: Any, R_dot: Any, *, reference: str = "world") -> Matrix:
    """Return ω (3,) of Ṙ = [ω]× R in world axes, or Ω = Rᵀω of Ṙ = R [Ω]× in the body's.

    Numbers give an array [rad/s], expressions a `sympy.Matrix`, simplified: with R(s) and dR/ds it is ω per unit of ṡ.

    Args:
        R: (3, 3) the rotation.
        R_dot: (3, 3) its derivative.
        reference: the axes ω is written in: "world" or "body".

    Raises:
        InputError: R is no rotation, or R_dot is not the derivative of one: Ṙ Rᵀ is not skew-symmetric.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.1.1.
    """
    one_of("reference", reference, ("world", "body"))
    R, R_dot = expressions("R", R, (3, 3)), expressions("R_dot", R_dot, (3, 3))
    if object not in (R.dtype, R_dot.dtype):
        R = rotation_of("R", R).rotation
    name, S = ("R_dot Rᵀ", R_dot @ R.T) if reference == "world" else ("Rᵀ R_dot", R.T @ R_dot)
    omega = axial_vector(name, S, PRINTED)
    return omega.applyfunc(simplified) if S.dtype == object else omega
