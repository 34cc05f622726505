"""Rotation about one axis by one angle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_number
from robotics1.notation import joint_value
from robotics1.orientation.elementary import turn, unit_vector
from robotics1.orientation.expressions import Matrix, angles_in_radians, as_matrix, expression, expressions
from robotics1.orientation.nearest import PRINTED, rotation_of
from robotics1.orientation.quaternion import quaternion_of
from robotics1.results import Frozen


def axis_angle_to_rotation(axis: Any, angle: Any) -> Matrix:
    """Return R(r, θ) = r rᵀ + cos θ (1 − r rᵀ) + sin θ [r]×, (3, 3): Rodrigues' formula.

    Args:
        axis: (3,) r, of any length but zero.
        angle: θ [rad]. Of SymPy expressions or names, here or in the axis, R is a `sympy.Matrix`.

    Raises:
        InputError: the axis has no direction, or an entry is neither a number nor an expression.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.5.
    """
    axis, angle = expressions("axis", axis, (3,), "a direction"), angles_in_radians("angle", angle, ())
    if object not in (axis.dtype, angle.dtype):
        return turn(unit_vector("axis", axis), float(angle))
    import sympy

    r = np.array([expression("axis", entry) for entry in axis], dtype=object)
    length = sympy.sqrt(r @ r)
    if length == 0:
        raise InputError("axis must have a direction; it is the zero vector")
    return as_matrix(turn(r / length, expression("angle", angle[()])))


@dataclass(frozen=True, eq=False)
class AxisAngle(Frozen):
    """The axis and the angle of a rotation.

    Attributes:
        angle: θ ∈ [0, π] [rad].
        axis: (3,) the unit vector r; None of no rotation, θ = 0, which is one about any axis.
        correction: the largest change of an entry that made a rotation of the given matrix.
    """

    angle: float
    axis: Array | None
    correction: float

    @property
    def solutions(self) -> tuple[tuple[Array, float], ...]:
        """All (r, θ), θ ∈ (−π, π]: (r, θ) and (−r, −θ), at half a turn (r, π) and (−r, π); none of θ = 0."""
        if self.axis is None:
            return ()
        return (self.axis, self.angle), (-self.axis, -self.angle if self.angle < np.pi else self.angle)

    def explain(self) -> str:
        """Return what R determines of the axis and the angle, in a sentence."""
        if self.axis is None:
            return "no rotation: θ = 0, and the axis is not determined: every one gives R"
        if self.angle == np.pi:
            return "half a turn: θ = π about r and about −r are the same rotation"
        return f"two solutions: (r, θ) and (−r, −θ), with θ = {joint_value(self.angle)}"


def rotation_to_axis_angle(R: npt.ArrayLike, *, tolerance: float = PRINTED) -> AxisAngle:
    """Return the axis and the angle of a rotation, with both solutions and the special cases θ = 0 and θ = π.

    θ = 2 atan2(|ε|, η) and r = ε/|ε| of the unit quaternion (η, ε): the angle of tr R = 1 + 2 cos θ and
    R − Rᵀ = 2 sin θ [r]×, but exact also where sin θ vanishes. An |ε| or η counts as zero only where rounding, 2e-15,
    or the correction of R leaves no more of it: an angle of π − 1e-12 is not half a turn.

    Args:
        R: (3, 3), a rotation; one printed with four digits is projected on the nearest.
        tolerance: the largest correction of an entry of R that is accepted.

    Raises:
        InputError: R is no rotation.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, sections 2.5 and 2.6.
    """
    near = rotation_of("R", R, real_number("tolerance", tolerance, non_negative=True))
    eta, *rest = quaternion_of(near)
    epsilon = np.array(rest)
    length = float(np.linalg.norm(epsilon))
    if length == 0.0:
        return AxisAngle(0.0, None, near.correction)
    return AxisAngle(float(2 * np.arctan2(length, eta)), epsilon / length, near.correction)
