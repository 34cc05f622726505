"""Orientations along a parameter, and the turn about a fixed axis."""

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.orientation.axis_angle import rotation_to_axis_angle
from robotics1.orientation.elementary import turn, unit_vector
from robotics1.orientation.nearest import rotation_of
from robotics1.paths.course import Course
from robotics1.paths.points import point


class RotationPath(Course):
    """R(s), 0 ≤ s ≤ end: (3, 3) for a number, (k, 3, 3) for (k,) parameters.

    The derivative of order 1 is w, the angular velocity per unit of s in world axes: dR/ds = [w]× R, and ω = w ṡ. That
    of order 2 is w', and ω̇ = w' ṡ² + w s̈.
    """

    @abstractmethod
    def _value(self, s: Array, side: str) -> Array:
        """The rotations at s, (k, 3, 3)."""


@dataclass(frozen=True, eq=False)
class FixedAxisRotation(RotationPath):
    """R(s) = R(r, s) R₀: a turn about one axis; s is the angle.

    Attributes:
        start: (3, 3) R₀.
        axis: (3,) the unit vector r in world axes; R₀ᵀ r in those of the start.
        angle: the whole angle θ = end [rad], not negative.
    """

    start: Array
    axis: Array
    angle: float

    @property
    def end(self) -> float:
        """θ."""
        return self.angle

    def _value(self, s: Array, side: str) -> Array:
        return np.stack([turn(self.axis, float(angle)) @ self.start for angle in s])

    def _derivative(self, s: Array, order: int, side: str) -> Array:
        return np.tile(self.axis if order == 1 else np.zeros(3), (len(s), 1))


def axis_angle_path(R0: npt.ArrayLike, R1: npt.ArrayLike, *, long_way: bool = False) -> FixedAxisRotation:
    """Return the turn from R₀ to R₁ about one axis, R(s) = R(r, s) R₀, 0 ≤ s ≤ θ, with θ r = log(R₁ R₀ᵀ), θ ∈ [0, π].

    It is the spherical interpolation of quaternions. At θ = π both ways are equally long; `long_way` tells the other.

    Args:
        R0, R1: (3, 3) the orientations.
        long_way: turn by 2π − θ about −r instead.

    Raises:
        InputError: R0 or R1 is no rotation; or they are the same and the long way is asked, which has no axis.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 4.3.3.
    """
    R0, R1 = rotation_of("R0", R0).rotation, rotation_of("R1", R1).rotation
    turned = rotation_to_axis_angle(R1 @ R0.T)
    if turned.axis is None:
        if long_way:
            raise InputError("R0 and R1 are the same: the whole turn between them has no axis")
        return FixedAxisRotation(R0, np.array([0.0, 0.0, 1.0]), 0.0)
    if long_way:
        return FixedAxisRotation(R0, -turned.axis, 2 * np.pi - turned.angle)
    return FixedAxisRotation(R0, turned.axis, turned.angle)


def turn_path(R0: npt.ArrayLike, axis: npt.ArrayLike, angle: float) -> FixedAxisRotation:
    """Return the turn of R₀ about an axis by an angle of any size, R(s) = R(r, s) R₀, 0 ≤ s ≤ |angle|.

    Args:
        R0: (3, 3) the orientation at the start.
        axis: (3,) in world axes, of any length.
        angle: [rad]; negative: the other way round.

    Raises:
        InputError: R0 is no rotation, or the axis is zero.
    """
    angle = float(point("angle", angle, (), "an angle [rad]"))
    return FixedAxisRotation(
        rotation_of("R0", R0).rotation, np.copysign(1.0, angle) * unit_vector("axis", axis), abs(angle)
    )
