"""The position of a frame, or some of its coordinates."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array
from robotics1.robot.model import Robot
from robotics1.tasks.task import FrameTask, PoseError

AXES = "xyz"


def numbers_of(axes: str) -> list[int]:
    """Return the numbers of axes that are letters of "xyz": 0, 1 or 2."""
    return [AXES.index(axis) for axis in axes]


@dataclass(frozen=True)
class PositionTask(FrameTask):
    """r = the chosen coordinates of the frame's origin [m]; ṙ = the same rows of v.

    Attributes:
        axes: which, such as "xyz", "xy" or "z".
    """

    axes: str = "xyz"
    has_constant_rows = True

    def __post_init__(self) -> None:
        """Refuse axes that are not distinct letters of "xyz"."""
        super().__post_init__()
        letters = self.axes if isinstance(self.axes, str) else ""
        if not letters or len(set(letters)) != len(letters) or not set(letters) <= set(AXES):
            raise InputError(f"axes must be distinct letters of 'xyz', such as 'xy'; it is {self.axes!r}")

    @property
    def row_names(self) -> tuple[str, ...]:
        """The letters of the axes."""
        return tuple(self.axes)

    @property
    def row_units(self) -> tuple[str, ...]:
        """Metres."""
        return ("m",) * len(self.axes)

    def g(self, p: Array, R: Array) -> Array:
        """Return the chosen coordinates of p, (m,)."""
        return p[numbers_of(self.axes)]

    def S(self, p: Array, R: Array) -> Array:
        """Return the chosen rows of [1 0], (m, 6)."""
        return np.eye(6)[numbers_of(self.axes)]

    def target(self, target: Any) -> Array:
        """Return the target as (m,) [m]."""
        return real_array("the target", target, (self.rows,), f"the coordinates {', '.join(self.axes)} [m]")

    def difference(self, target: Array, value: Array) -> Array:
        """Return r_d − r, (m,)."""
        return target - value

    def pose_error(self) -> PoseError:
        """Return the chosen rows of p_d − p."""
        return PoseError(tuple(numbers_of(self.axes)), self._goal)

    def _goal(self, robot: Robot, target: Any) -> Array:
        """Return a pose with the coordinates of the target."""
        T = np.eye(4)
        T[numbers_of(self.axes), 3] = self.target(target)
        return T
