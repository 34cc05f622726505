"""A pose along a parameter: a position, and an orientation that goes with it."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.paths.course import Course
from robotics1.paths.harmonic import line_path
from robotics1.paths.path import Path
from robotics1.paths.points import point
from robotics1.paths.rotations import RotationPath, axis_angle_path


@dataclass(frozen=True, eq=False)
class PosePath(Course):
    """T(s) = (p(s), R(s)): `pin.SE3` for a number, a list of them for (k,) parameters.

    s is the parameter of the position; the orientation goes from its start to its end in the same time. Where the
    position stands still, s is the parameter of the orientation.

    The derivative of order 1 is (p', w), (6,), the twist per unit of s in world axes; that of order 2 is (p'', w').

    Attributes:
        position: a path in space, or a point (3,) that stays [m].
        orientation: R(s), such as `axis_angle_path(R0, R1)`.
    """

    position: Path | npt.ArrayLike
    orientation: RotationPath

    def __post_init__(self) -> None:
        """Refuse a position that is not in space, and a pose that stands still."""
        if not isinstance(self.orientation, RotationPath):
            raise InputError(f"orientation must be such as axis_angle_path(R0, R1); it is {self.orientation!r}")
        if not isinstance(self.position, Path):
            object.__setattr__(self, "position", point("position", self.position, (3,), "a point, or a path"))
        elif self.position.dimension != 3:
            raise InputError(f"position must be a path in space; it has {self.position.dimension} coordinates")
        if self.end == 0:
            raise InputError("the pose must change: neither the position nor the orientation does")

    @property
    def end(self) -> float:
        """That of the position's path, or where it stands still of the orientation's."""
        return self.position.end if isinstance(self.position, Path) else self.orientation.end

    @property
    def breaks(self) -> Array:
        """Those of both."""
        own = self.position.breaks if isinstance(self.position, Path) else np.empty(0)
        turns = self.orientation.breaks / self._pace if self._pace else np.empty(0)
        return np.unique(np.concatenate([own, turns]))

    @property
    def _pace(self) -> float:
        """The orientation's parameter for each unit of s."""
        return self.orientation.end / self.end

    def _value(self, s: Array, side: str) -> list[Any]:
        import pinocchio as pin

        rotations = self.orientation.derivative(self._pace * s, 0, side=side)
        return [pin.SE3(R, p) for R, p in zip(rotations, self._position(s, 0, side), strict=True)]

    def _derivative(self, s: Array, order: int, side: str) -> Array:
        w = self._pace**order * self.orientation.derivative(self._pace * s, order, side=side)
        return np.hstack([self._position(s, order, side), w])

    def _position(self, s: Array, order: int, side: str) -> Array:
        if isinstance(self.position, Path):
            return self.position.derivative(s, order, side=side)
        return np.tile(np.asarray(self.position) if order == 0 else np.zeros(3), (len(s), 1))


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
    still = np.linalg.norm(p1 - p0) <= 1e-12 * max(np.abs(p0).max(), np.abs(p1).max())
    orientation = axis_angle_path(start.rotation, last.rotation)
    if still and orientation.end == 0:
        raise InputError("T0 and T1 must be different poses; they are the same")
    return PosePath(p0 if still else line_path(p0, p1), orientation)
