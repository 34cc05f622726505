"""The orientation of a frame, and its full pose."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.inputs import Array, real_array
from robotics1.robot.model import Robot
from robotics1.robot.placements import homogeneous
from robotics1.tasks.representations import RotationItself, SequenceAngles, representation
from robotics1.tasks.task import FrameTask


@dataclass(frozen=True)
class _WithOrientation(FrameTask):
    """A task that tells an orientation, by the rotation itself or by the angles of a sequence.

    Attributes:
        angles: a sequence such as "ZYZ", "XYZ" or "Z-YX"; None for the rotation itself.
        fixed: rotations about the axes of the fixed frame, as roll-pitch-yaw; otherwise about those already moved.
    """

    angles: str | None = None
    fixed: bool = False

    def __post_init__(self) -> None:
        """Refuse a sequence that is none."""
        super().__post_init__()
        representation(self.angles, self.fixed)

    @cached_property
    def told(self) -> RotationItself | SequenceAngles:
        """How the orientation is told."""
        return representation(self.angles, self.fixed)

    @property
    def tells_angles(self) -> bool:
        """Whether a sequence was given."""
        return self.angles is not None

    @property
    def has_constant_rows(self) -> bool:
        """Whether S(T) is the same at every pose: so it is without angles=."""
        return self.angles is None


@dataclass(frozen=True)
class OrientationTask(_WithOrientation):
    """r = R, (3, 3); ṙ stands for ω [rad/s]; e = log3(R_d Rᵀ), the rotation vector that is still missing.

    With angles= it is r = φ, (3,), the angles of a sequence; ṙ = φ̇ = T(φ)⁻¹ ω, whose J is the analytic Jacobian; and
    e = φ_d − φ, each wrapped into (−π, π]. Of the two φ of an orientation the first is told: cos φ₂ > 0 of ZYX and
    its like, sin φ₂ > 0 of ZYZ and its like. A target may be either. Where T is singular TaskError is raised.

    Attributes:
        angles: a sequence such as "ZYZ", "XYZ" or "Z-YX"; None for the rotation itself.
        fixed: rotations about the axes of the fixed frame, as roll-pitch-yaw; otherwise about those already moved.
    """

    @property
    def row_names(self) -> tuple[str, ...]:
        """The components of ω, or the angles."""
        return self.told.names

    @property
    def row_units(self) -> tuple[str, ...]:
        """Radians."""
        return ("rad",) * 3

    def g(self, p: Array, R: Array) -> Array:
        """Return R, (3, 3); with angles= φ, (3,)."""
        return self.told.value(R)

    def S(self, p: Array, R: Array) -> Array:
        """Return [0 1], (3, 6); with angles= [0 T⁻¹]."""
        return np.hstack([np.zeros((3, 3), dtype=int), self.told.rates(R)])

    def target(self, target: Any) -> Array:
        """Return the target as a rotation matrix (3, 3); with angles= as φ, (3,)."""
        return self.told.target(target)

    def difference(self, target: Array, value: Array) -> Array:
        """Return log3(R_d Rᵀ), (3,) [rad]; with angles= φ_d − φ."""
        return self.told.difference(target, value)

    @property
    def pose_rows(self) -> tuple[int, ...]:
        """The rows of the rotation."""
        return (3, 4, 5)

    def goal(self, robot: Robot, target: Any) -> Array:
        """Return a pose with the orientation of the target."""
        T = np.eye(4)
        T[:3, :3] = self.told.rotation(self.target(target))
        return T


@dataclass(frozen=True)
class PoseTask(_WithOrientation):
    """r = T, a `pin.SE3`; ṙ stands for (v, ω); e = (p_d − p, log3(R_d Rᵀ)), so that e ≈ J Δq.

    With angles= it is r = (p, φ), (6,), φ being the angles of a sequence as in `OrientationTask`.

    Attributes:
        angles: a sequence such as "ZYZ", "XYZ" or "Z-YX"; None for the pose itself.
        fixed: rotations about the axes of the fixed frame, as roll-pitch-yaw; otherwise about those already moved.
    """

    @property
    def row_names(self) -> tuple[str, ...]:
        """The components of v and ω, or the coordinates and the angles."""
        return ("x", "y", "z", *self.told.names)

    @property
    def row_units(self) -> tuple[str, ...]:
        """Metres and radians."""
        return ("m",) * 3 + ("rad",) * 3

    def g(self, p: Array, R: Array) -> Any:
        """Return T; of formulas, its homogeneous matrix (4, 4). With angles= (p, φ), (6,)."""
        if self.angles is not None:
            return np.concatenate([p, self.told.value(R)])
        if R.dtype == object:
            return np.vstack([np.column_stack([R, p]), [0, 0, 0, 1]])
        return pin.SE3(R, p)

    def S(self, p: Array, R: Array) -> Array:
        """Return the identity, (6, 6); with angles= diag(1, T⁻¹)."""
        linear, angular = np.eye(6, dtype=int)[:3], np.hstack([np.zeros((3, 3), dtype=int), self.told.rates(R)])
        return np.vstack([linear, angular])

    def target(self, target: Any) -> Any:
        """Return the target as a `pin.SE3`; a homogeneous (4, 4) matrix serves too. With angles= as (p, φ), (6,)."""
        if self.angles is not None:
            r = real_array("the target", target, (6,), "a position [m] and three angles [rad]")
            return np.concatenate([r[:3], self.told.target(r[3:])])
        if target is None:
            raise InputError("the target must be a pin.SE3 or a homogeneous (4, 4) matrix, not None")
        return homogeneous("the target", target)

    def difference(self, target: Any, value: Any) -> Array:
        """Return (p_d − p, log3(R_d Rᵀ)), (6,) [m, rad]; with angles= (p_d − p, φ_d − φ)."""
        if self.angles is not None:
            return np.concatenate([target[:3] - value[:3], self.told.difference(target[3:], value[3:])])
        turn = self.told.difference(target.rotation, value.rotation)
        return np.concatenate([target.translation - value.translation, turn])

    @property
    def pose_rows(self) -> tuple[int, ...]:
        """All."""
        return tuple(range(6))

    @property
    def takes_poses(self) -> bool:
        """Whether a target is a `pin.SE3`: so it is without angles=."""
        return not self.tells_angles

    def goal(self, robot: Robot, target: Any) -> Array:
        """Return the pose of the target."""
        T = self.target(target)
        if self.angles is None:
            return np.asarray(T.homogeneous)
        return np.asarray(pin.SE3(self.told.rotation(T[3:]), T[:3]).homogeneous)
