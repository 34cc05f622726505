"""Orientations along a parameter: a turn about a fixed axis, and Euler angles that go along a path."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.curves.arcs import line_path
from robotics1.curves.curve import Curve
from robotics1.curves.given import as_path
from robotics1.curves.named_derivatives import Side
from robotics1.errors import InputError
from robotics1.inputs import Array, moderate_array, real_array
from robotics1.orientation.axis_angle import rotation_to_axis_angle
from robotics1.orientation.elementary import turn, unit_vector
from robotics1.orientation.nearest import rotation_of
from robotics1.orientation.rates import rate_map
from robotics1.orientation.sequence import EulerSequence, euler_sequence


class RotationPath(Curve):
    """R(s), 0 ≤ s ≤ end: (3, 3) for a number, (k, 3, 3) for (k,) parameters.

    The derivative of order 1 is w, the angular velocity per unit of s in world axes: dR/ds = [w]× R, and ω = w ṡ. That
    of order 2 is w', and ω̇ = w' ṡ² + w s̈.
    """

    @property
    def of_points(self) -> bool:
        """No: the values are orientations."""
        return False

    @property
    def shape(self) -> tuple[int, ...]:
        """That of the angular velocity, (3,)."""
        return (3,)

    @abstractmethod
    def _value(self, t: Array, side: Side) -> Array:
        """The rotations at t, (k, 3, 3)."""


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

    def _value(self, t: Array, side: Side) -> Array:
        return np.stack([turn(self.axis, float(angle)) @ self.start for angle in t])

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        return np.tile(self.axis if order == 1 else np.zeros(3), (len(t), 1))


def slerp_path(R0: npt.ArrayLike, R1: npt.ArrayLike, *, long_way: bool = False) -> FixedAxisRotation:
    """Return the turn from R₀ to R₁ about one axis, R(s) = R(r, s) R₀, 0 ≤ s ≤ θ, with θ r = log(R₁ R₀ᵀ), θ ∈ [0, π].

    It is the spherical interpolation of quaternions. At θ = π both ways are equally long; `long_way` takes the other.

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
    angle = float(moderate_array("angle", angle, (), "an angle [rad]"))
    return FixedAxisRotation(
        rotation_of("R0", R0).rotation, np.copysign(1.0, angle) * unit_vector("axis", axis), abs(angle)
    )


@dataclass(frozen=True, eq=False)
class EulerRotation(RotationPath):
    """R(s) = R(φ(s)): the angles of a sequence go along a path, and the axis is not fixed.

    w = Σⱼ aⱼ φⱼ' with the axes aⱼ of the three turns; each axis is carried along by the turns before it.

    Attributes:
        sequence: the axes.
        angles: φ(s), a path of three angles [rad].
    """

    sequence: EulerSequence
    angles: Curve

    @property
    def end(self) -> float:
        """That of the path of the angles."""
        return self.angles.end

    @property
    def breakpoints(self) -> Array:
        """Those of the path of the angles."""
        return self.angles.breakpoints

    def _value(self, t: Array, side: Side) -> Array:
        R = [self.sequence.turns(phi) for phi in self.angles(t, side=side)]
        return np.stack([R1 @ R2 @ R3 for R1, R2, R3 in R])

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        if order > 3:
            raise InputError(f"derivatives of Euler angles' rotations are known up to the third; order is {order}")
        given = self.angles._derivatives(self.angles._snapped(t), range(4), side)
        return np.stack([self._rates(*angles)[order - 1] for angles in zip(*given, strict=True)])

    def _rates(self, phi: Array, d1: Array, d2: Array, d3: Array) -> tuple[Array, Array, Array]:
        """Return w, w', w'', (3,) each, by adding one turn after the other."""
        axes = rate_map(self.sequence, phi).T
        w, w1, w2 = np.zeros((3, 3))
        for j in range(3)[self.sequence.order]:
            a = axes[j]
            a1 = np.cross(w, a)  # a' = w × a with the w of the turns before
            a2 = np.cross(w1, a) + np.cross(w, a1)
            w, w1, w2 = (
                w + a * d1[j],
                w1 + a1 * d1[j] + a * d2[j],
                w2 + a2 * d1[j] + 2 * a1 * d2[j] + a * d3[j],
            )
        return w, w1, w2


def euler_path(sequence: str, angles: Curve | npt.ArrayLike, *, fixed: bool = False) -> EulerRotation:
    """Return the orientation R(φ(s)) while the angles of a sequence go along a path, such as a line.

    Args:
        sequence: three axes, such as "ZYZ", "XYZ", or "Z-YX" with an angle about −y.
        angles: a path of three angles [rad], or (2, 3): the first and the last, joined by a line.
        fixed: rotations about the axes of the fixed frame; otherwise about those that have already moved.

    Raises:
        InputError: the sequence is none, or the path is not one of three angles.
    """
    if not isinstance(angles, Curve):
        first, last = real_array("angles", angles, (2, 3), "the first and the last angles [rad], or a path")
        angles = line_path(first, last)
    return EulerRotation(euler_sequence(sequence, fixed), as_path("angles", angles, (3,)))
