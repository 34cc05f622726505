"""The orientation of a frame, and its full pose."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.robot.placements import homogeneous, rotation_matrix
from robotics1.tasks.task import FrameTask


@dataclass(frozen=True)
class OrientationTask(FrameTask):
    """r = R, (3, 3); ṙ stands for ω [rad/s]; e = log3(R_d Rᵀ), the rotation vector that is still missing."""

    @property
    def row_names(self) -> tuple[str, ...]:
        """The components of ω."""
        return ("ωx", "ωy", "ωz")

    @property
    def row_units(self) -> tuple[str, ...]:
        """Radians."""
        return ("rad",) * 3

    def g(self, p: Array, R: Array) -> Array:
        """Return R, (3, 3)."""
        return np.array(R)

    def S(self, p: Array, R: Array) -> Array:
        """Return [0 1], (3, 6)."""
        return np.eye(6)[3:]

    def target(self, target: Any) -> Array:
        """Return the target as a rotation matrix (3, 3)."""
        return rotation_matrix("the target", target)

    def difference(self, target: Array, value: Array) -> Array:
        """Return log3(R_d Rᵀ), (3,) [rad]."""
        return np.asarray(pin.log3(target @ value.T))


@dataclass(frozen=True)
class PoseTask(FrameTask):
    """r = T, a `pin.SE3`; ṙ stands for (v, ω); e = (p_d − p, log3(R_d Rᵀ)), so that e ≈ J Δq."""

    @property
    def row_names(self) -> tuple[str, ...]:
        """The components of v and ω."""
        return ("x", "y", "z", "ωx", "ωy", "ωz")

    @property
    def row_units(self) -> tuple[str, ...]:
        """Metres and radians."""
        return ("m",) * 3 + ("rad",) * 3

    def g(self, p: Array, R: Array) -> pin.SE3:
        """Return T; of formulas, its homogeneous matrix (4, 4)."""
        if R.dtype == object:
            return np.vstack([np.column_stack([R, p]), [0, 0, 0, 1]])
        return pin.SE3(R, p)

    def S(self, p: Array, R: Array) -> Array:
        """Return the identity, (6, 6)."""
        return np.eye(6)

    def target(self, target: Any) -> pin.SE3:
        """Return the target as a `pin.SE3`; a homogeneous (4, 4) matrix serves too."""
        if target is None:
            raise InputError("the target must be a pin.SE3 or a homogeneous (4, 4) matrix, not None")
        return homogeneous("the target", target)

    def difference(self, target: pin.SE3, value: pin.SE3) -> Array:
        """Return (p_d − p, log3(R_d Rᵀ)), (6,) [m, rad]."""
        turn = pin.log3(target.rotation @ value.rotation.T)
        return np.concatenate([target.translation - value.translation, turn])
