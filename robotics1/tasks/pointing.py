"""The direction in which an axis of a frame points."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.orientation.elementary import cross_matrix, unit_vector
from robotics1.orientation.pointing import align_direction
from robotics1.robot.model import Robot
from robotics1.tasks.task import FrameTask, PoseError

NAMED = {sign + name: factor * row for sign, factor in (("", 1), ("-", -1))
         for name, row in zip("xyz", np.eye(3, dtype=int), strict=True)}  # fmt: skip

ROUNDING = 1e-15  # of the length of a unit vector


@dataclass(frozen=True)
class PointingTask(FrameTask):
    """r = R a, the unit vector (3,) along an axis a of the frame; ṙ = ω × r = −[r]× ω; e = r_d − r.

    |r| is 1, so that of the three rows at most two are independent: J has rank 2 almost everywhere, and r itself is in
    its left null space. A turn about the axis changes nothing. At r = −r_d, Jᵀe = 0: a method that follows e stands
    still there.

    Attributes:
        axis: "x", "y", "z", "-x", "-y", "-z", or a direction (3,) in the frame, of any length.
    """

    axis: str | tuple[float, float, float] = "z"
    row_names = ("rx", "ry", "rz")
    row_units = ("1", "1", "1")

    def __post_init__(self) -> None:
        """Refuse an axis that is none; a direction is kept as a unit vector."""
        super().__post_init__()
        if not isinstance(self.axis, str):
            a = unit_vector("axis", self.axis)
            given = np.array(self.axis, dtype=float)
            same = np.allclose(given, a, rtol=0.0, atol=ROUNDING)  # else replace() would round it once more
            object.__setattr__(self, "axis", tuple((given if same else a).tolist()))
        elif self.axis not in NAMED:
            raise InputError(f"axis must be 'x', 'y', 'z', one of these with a minus, or a vector; it is {self.axis!r}")

    def g(self, p: Array, R: Array) -> Array:
        """Return r = R a, (3,)."""
        return R @ self._a

    def S(self, p: Array, R: Array) -> Array:
        """Return [0 −[R a]×], (3, 6)."""
        return np.hstack([np.zeros((3, 3), dtype=int), -cross_matrix(R @ self._a)])

    def target(self, target: Any) -> Array:
        """Return the target as a unit vector (3,); it may have any length but zero."""
        return unit_vector("the target", target)

    def difference(self, target: Array, value: Array) -> Array:
        """Return r_d − r, (3,)."""
        return target - value

    def pose_error(self) -> PoseError:
        """Return the rows of the rotation; the turn about the axis does not count."""
        return PoseError((3, 4, 5), self._goal, axis=np.array(self._a, dtype=float))

    def _goal(self, robot: Robot, target: Any) -> Array:
        """Return a pose with R_d a = r_d: the least turn from a to r_d."""
        T = np.eye(4)
        T[:3, :3] = align_direction(np.array(self._a, dtype=float), self.target(target)).rotation
        return T

    @property
    def _a(self) -> Array:
        return NAMED[self.axis] if isinstance(self.axis, str) else np.array(self.axis)
