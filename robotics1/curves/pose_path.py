"""A pose along a parameter: a position, and an orientation that goes with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.curves.arcs import line_path, turning
from robotics1.curves.curve import Curve
from robotics1.curves.given import as_path
from robotics1.curves.named_derivatives import Side
from robotics1.curves.rotations import FixedAxisRotation, RotationPath, slerp_path
from robotics1.errors import InputError
from robotics1.inputs import Array, moderate_array

STILL = 1e-12  # of the coordinates: an origin that moves less stands still


@dataclass(frozen=True, eq=False)
class PosePath(Curve):
    """T(s) = (p(s), R(s)): `pin.SE3` for a number, a list of them for (k,) parameters.

    s is the parameter of the position; the orientation goes from its start to its end in the same time. Where the
    position stands still, s is the parameter of the orientation.

    The derivative of order 1 is (p', w), (6,), the twist per unit of s in world axes; that of order 2 is (p'', w').

    Attributes:
        position: a path in space, or a point (3,) that stays [m].
        orientation: R(s), such as `slerp_path(R0, R1)`.
    """

    position: Curve | npt.ArrayLike
    orientation: RotationPath

    def __post_init__(self) -> None:
        """Refuse a position that is not in space, and a pose that stands still."""
        if not isinstance(self.orientation, RotationPath):
            raise InputError(f"orientation must be such as slerp_path(R0, R1); it is {self.orientation!r}")
        if isinstance(self.position, Curve):
            as_path("position", self.position, (3,))
        else:
            point = moderate_array("position", self.position, (3,), "a point, or a path in space")
            object.__setattr__(self, "position", point)
        super().__post_init__()
        if self.end == 0:
            raise InputError("the pose must change: neither the position nor the orientation does")

    @property
    def of_points(self) -> bool:
        """No: the values are poses."""
        return False

    @property
    def shape(self) -> tuple[int, ...]:
        """That of the twist, (6,)."""
        return (6,)

    @property
    def end(self) -> float:
        """That of the position's path, or where it stands still of the orientation's."""
        return self.position.end if isinstance(self.position, Curve) else self.orientation.end

    @property
    def breakpoints(self) -> Array:
        """Those of both."""
        own = self.position.breakpoints if isinstance(self.position, Curve) else np.empty(0)
        turns = self.orientation.breakpoints / self._pace if self._pace else np.empty(0)
        return np.unique(np.concatenate([own, turns]))

    @property
    def _pace(self) -> float:
        """The orientation's parameter for each unit of s."""
        return self.orientation.end / self.end

    def _value(self, t: Array, side: Side) -> list[Any]:
        import pinocchio as pin

        rotations = self.orientation(self._pace * t, side=side)
        return [pin.SE3(R, p) for R, p in zip(rotations, self._position(t, 0, side), strict=True)]

    def _derivative(self, t: Array, order: int, side: Side) -> Array:
        w = self._pace**order * self.orientation.derivative(self._pace * t, order, side=side)
        return np.hstack([self._position(t, order, side), w])

    def _position(self, t: Array, order: int, side: Side) -> Array:
        if isinstance(self.position, Curve):
            return np.asarray(self.position.derivative(t, order, side=side))
        return np.tile(np.asarray(self.position) if order == 0 else np.zeros(3), (len(t), 1))


def pose_line(T0: Any, T1: Any) -> PosePath:
    """Return the straight way between two poses: p along a line, R about one axis, with a common parameter.

    s is the length passed, or where the positions are the same the angle. The twist is (p', θ/L r) with the line's
    direction p', its length L, and θ r = log(R₁ R₀ᵀ).

    Args:
        T0, T1: `pin.SE3`, or homogeneous matrices (4, 4).

    Raises:
        InputError: T0 or T1 is no pose, or they are the same.
    """
    from robotics1.robot.placements import homogeneous

    start, last = homogeneous("T0", T0), homogeneous("T1", T1)
    p0, p1 = start.translation, last.translation
    still = np.linalg.norm(p1 - p0) <= STILL * max(np.abs(p0).max(), np.abs(p1).max())
    orientation = slerp_path(start.rotation, last.rotation)
    if still and orientation.end == 0:
        raise InputError("T0 and T1 must be different poses; they are the same")
    return PosePath(p0 if still else line_path(p0, p1), orientation)


def screw_path(T0: Any, T1: Any) -> PosePath:
    """Return the screw motion between two poses, T(s) = e^([S] θ(s)) T_0: a turn about one axis with a slide along it.

    Each point of the body moves on a helix about that axis. s is the length passed by the origin of the frame, or where
    that stands still the angle. The twist is constant, in the world and in the body. `pose_line` goes through the same
    orientations, with the origin on a line.

    Args:
        T0, T1: `pin.SE3`, or homogeneous matrices (4, 4).

    Raises:
        InputError: T0 or T1 is no pose, or they are the same.

    Source: Lynch, Park, Modern Robotics, 2017, section 9.2.1.
    """
    from robotics1.rigid_motions.screw import displacement_screw
    from robotics1.robot.placements import homogeneous

    start, last = homogeneous("T0", T0), homogeneous("T1", T1)
    screw = displacement_screw(last * start.inverse())
    if screw.axis is None or screw.angle == 0:
        return pose_line(start, last)
    r, p0 = screw.axis, np.array(start.translation)
    centre = screw.point + r @ (p0 - screw.point) * r
    a, rise = p0 - centre, screw.pitch * r
    orientation = FixedAxisRotation(np.array(start.rotation), r, screw.angle)
    size = max(np.abs(p0).max(), np.abs(last.translation).max())
    if np.hypot(np.linalg.norm(a), np.linalg.norm(rise)) * screw.angle <= STILL * size:
        return PosePath(p0, orientation)
    return PosePath(turning(centre, a, np.cross(r, a), rise, screw.angle), orientation)
