"""The position of a frame in polar and in cylindrical coordinates."""

from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from robotics1.angles import warn_of_degrees
from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, one_of, real_array
from robotics1.orientation.expressions import angle_of, root, wrapped
from robotics1.tasks.position import numbers_of
from robotics1.tasks.task import FrameTask, PoseError

PLANES = ("xy", "yz", "zx", "yx", "zy", "xz")
ON_AXIS = 1e-12  # ρ [m] below which θ has no rate: 1/ρ would be rounding


@dataclass(frozen=True)
class PolarTask(FrameTask):
    """r = (ρ, θ): the distance of the frame's origin from the origin of the plane [m], and its direction [rad].

    With the coordinates a and b in the plane: ρ = √(a² + b²) and θ = atan2(b, a) ∈ (−π, π], so that
    ρ̇ = (a ȧ + b ḃ)/ρ and θ̇ = (a ḃ − b ȧ)/ρ². At ρ = 0 the angle has no rate.

    Attributes:
        plane: two letters of "xyz", in the axes of `reference`: θ is measured from the first to the second.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.10 (operational space).
    """

    plane: str = "xy"
    row_units: ClassVar[tuple[str, ...]] = ("m", "rad")

    def __post_init__(self) -> None:
        """Refuse a plane that is none."""
        super().__post_init__()
        one_of("plane", self.plane, PLANES)

    @property
    def row_names(self) -> tuple[str, ...]:
        """Of ρ and θ."""
        return ("ρ", "θ")

    def g(self, p: Array, R: Array) -> Array:
        """Return (ρ, θ), (2,)."""
        a, b = p[numbers_of(self.plane)]
        return np.array([root(a * a + b * b), angle_of(b, a)])

    def S(self, p: Array, R: Array) -> Array:
        """Return the rows of ρ̇ and θ̇, (2, 6).

        Raises:
            TaskError: the frame stands on the axis, where θ has no rate.
        """
        a, b = p[numbers_of(self.plane)]
        square = a * a + b * b
        if p.dtype != object and square < ON_AXIS**2:
            raise TaskError("the frame stands on the axis, where the angle θ has no rate; use PositionTask there")
        rho = root(square)
        rows = 0 * np.hstack([p, p]) * np.ones((2, 1), dtype=int)
        rows[0, numbers_of(self.plane)] = a / rho, b / rho
        rows[1, numbers_of(self.plane)] = -b / square, a / square
        return np.asarray(rows)

    def target(self, target: Any) -> Array:
        """Return the target as (2,) [m, rad]; of a cylindrical one (3,)."""
        r = real_array(
            "the target", target, (self.rows,), f"({', '.join(self.row_names)}) [{', '.join(self.row_units)}]"
        )
        warn_of_degrees("the target", r[1:2])
        if r[0] < 0:
            raise InputError(f"the distance ρ of the target must not be negative; it is {r[0]:g}")
        return r

    def difference(self, target: Array, value: Array) -> Array:
        """Return r_d − r, the angle wrapped into (−π, π]."""
        e = target - value
        e[1] = wrapped(e[1])
        return e

    def pose_error(self) -> PoseError:
        """Return the rows of the coordinates."""
        return PoseError(tuple(sorted(numbers_of(self.plane))), self._goal, by_angles=True)

    def _goal(self, robot: Any, target: Any) -> Array:
        """Return a pose with the coordinates ρ cos θ and ρ sin θ."""
        r = self.target(target)
        T = np.eye(4)
        T[numbers_of(self.plane), 3] = r[0] * np.cos(r[1]), r[0] * np.sin(r[1])
        return T


@dataclass(frozen=True)
class CylindricalTask(PolarTask):
    """r = (ρ, θ, h): the polar coordinates in a plane and the height above it, along the third axis [m, rad, m].

    The height counts along the axis of `reference` that is not in the plane: z above "xy".
    """

    row_units: ClassVar[tuple[str, ...]] = ("m", "rad", "m")

    @property
    def row_names(self) -> tuple[str, ...]:
        """Of ρ and θ, and the letter of the axis."""
        return ("ρ", "θ", "xyz"[self._axis])

    @property
    def _axis(self) -> int:
        return 3 - sum(numbers_of(self.plane))

    def g(self, p: Array, R: Array) -> Array:
        """Return (ρ, θ, h), (3,)."""
        return np.append(super().g(p, R), p[self._axis])

    def S(self, p: Array, R: Array) -> Array:
        """Return the rows of ρ̇, θ̇ and ḣ, (3, 6). Raises as that of `PolarTask`."""
        return np.vstack([super().S(p, R), np.eye(6, dtype=int)[self._axis]])

    def pose_error(self) -> PoseError:
        """Return the rows of the three coordinates."""
        return PoseError((0, 1, 2), self._goal, by_angles=True)

    def _goal(self, robot: Any, target: Any) -> Array:
        """Return a pose with these coordinates."""
        T = super()._goal(robot, target)
        T[self._axis, 3] = self.target(target)[2]
        return T
