"""The orientation of a frame, and its full pose."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.angles import warn_of_degrees
from robotics1.caching import cached_property
from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, real_array
from robotics1.orientation.euler_inverse import first_solution, other_solution, sine_squared
from robotics1.orientation.expressions import wrapped
from robotics1.orientation.nearest import SINGULAR
from robotics1.orientation.rates import inverse_rate_map, rate_determinant
from robotics1.orientation.sequence import EulerSequence, euler_sequence
from robotics1.robot.model import Robot
from robotics1.robot.placements import MEANING, homogeneous, rotation_matrix
from robotics1.tasks.task import FrameTask, PoseError


class RotationItself:
    """R, (3, 3), with ω for its rate."""

    names = ("ωx", "ωy", "ωz")

    def value(self, R: Array) -> Array:
        """Return R, (3, 3)."""
        return np.array(R)

    def rates(self, R: Array) -> Array:
        """Return the identity, (3, 3)."""
        return np.eye(3)

    def target(self, target: Any) -> Array:
        """Return the target as a rotation matrix (3, 3)."""
        return rotation_matrix("the target", target)

    def rotation(self, value: Array) -> Array:
        """Return R, (3, 3)."""
        return value

    def difference(self, target: Array, value: Array) -> Array:
        """Return log3(R_d Rᵀ), (3,) [rad]."""
        return np.asarray(pin.log3(target @ value.T))


@dataclass(frozen=True)
class SequenceAngles:
    """φ, (3,), the first of the two triples that give R, with φ̇ = T⁻¹ ω for its rate; R may be of expressions.

    Each raises TaskError where the sequence is singular.
    """

    sequence: EulerSequence
    names = ("φ1", "φ2", "φ3")

    def value(self, R: Array) -> Array:
        """Return φ, (3,)."""
        self._refuse_singular(R)
        return first_solution(self.sequence, R)

    def rates(self, R: Array) -> Array:
        """Return T⁻¹, (3, 3)."""
        self._refuse_singular(R)
        return inverse_rate_map(self.sequence, R)

    def target(self, target: Any) -> Array:
        """Return φ_d, (3,), as the first of the two triples of its rotation, in (−π, π]."""
        sequence, angles = self.sequence, real_array("the target", target, (3,), f"{self.sequence} angles [rad]")
        warn_of_degrees("the target", angles)
        sine = float(rate_determinant(sequence, angles)) * (1 if sequence.fixed else -1)
        if abs(sine) <= SINGULAR:
            raise TaskError(f"the target's {self._not_determined}")
        first = angles if sine * sequence.sign > 0 else other_solution(sequence, angles)
        return np.array([wrapped(angle) for angle in first])

    def rotation(self, value: Array) -> Array:
        """Return R(φ), (3, 3)."""
        R1, R2, R3 = self.sequence.turns(value)
        return np.asarray(R1 @ R2 @ R3, dtype=float)

    def difference(self, target: Array, value: Array) -> Array:
        """Return φ_d − φ, (3,), each angle wrapped into (−π, π]."""
        return np.array([wrapped(angle) for angle in target - value])

    def _refuse_singular(self, R: Array) -> None:
        square = sine_squared(self.sequence, R)
        if square == 0 or (R.dtype != object and square <= SINGULAR**2):
            raise TaskError(f"the {self._not_determined}")

    @property
    def _not_determined(self) -> str:
        zero = "cos φ2" if self.sequence.offset[0] == 0 else "sin φ2"
        return (
            f"{self.sequence} angles are singular here, {zero} = 0: φ1 and φ3 turn about the same axis, and the "
            f"analytic Jacobian does not exist; use angles= with another sequence, or none"
        )


def representation(angles: str | None, fixed: bool) -> RotationItself | SequenceAngles:
    """Return how an orientation is represented; `angles` is a sequence such as "ZYZ", or None.

    Raises:
        InputError: `angles` is no sequence, or `fixed` is given without one.
    """
    if angles is not None:
        return SequenceAngles(euler_sequence(angles, fixed))
    if fixed is not False:
        raise InputError(f"fixed={fixed!r} says how angles are meant; give their sequence too, as angles='XYZ'")
    return RotationItself()


@dataclass(frozen=True)
class _WithOrientation(FrameTask):
    """A task whose value holds an orientation: the rotation itself, or the angles of a sequence.

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
    def representation(self) -> RotationItself | SequenceAngles:
        """The rotation itself, or the angles of the sequence."""
        return representation(self.angles, self.fixed)

    @property
    def has_constant_rows(self) -> bool:
        """Whether S(T) is the same at every pose: so it is without angles=."""
        return self.angles is None


@dataclass(frozen=True)
class OrientationTask(_WithOrientation):
    """r = R, (3, 3); ṙ stands for ω [rad/s]; e = log3(R_d Rᵀ), the rotation vector that is still missing.

    With angles= it is r = φ, (3,), the angles of a sequence; ṙ = φ̇ = T(φ)⁻¹ ω, whose J is the analytic Jacobian; and
    e = φ_d − φ, each wrapped into (−π, π]. Of the two φ of an orientation the value is the first: cos φ₂ > 0 of ZYX and
    its like, sin φ₂ > 0 of ZYZ and its like. A target may be either. Where T is singular TaskError is raised.

    Attributes:
        angles: a sequence such as "ZYZ", "XYZ" or "Z-YX"; None for the rotation itself.
        fixed: rotations about the axes of the fixed frame, as roll-pitch-yaw; otherwise about those already moved.
    """

    @property
    def row_names(self) -> tuple[str, ...]:
        """The components of ω, or the angles."""
        return self.representation.names

    row_units = ("rad", "rad", "rad")

    def g(self, p: Array, R: Array) -> Array:
        """Return R, (3, 3); with angles= φ, (3,)."""
        return self.representation.value(R)

    def S(self, p: Array, R: Array) -> Array:
        """Return [0 1], (3, 6); with angles= [0 T⁻¹]."""
        return np.hstack([np.zeros((3, 3), dtype=int), self.representation.rates(R)])

    def target(self, target: Any) -> Array:
        """Return the target as a rotation matrix (3, 3); with angles= as φ, (3,)."""
        return self.representation.target(target)

    def difference(self, target: Array, value: Array) -> Array:
        """Return log3(R_d Rᵀ), (3,) [rad]; with angles= φ_d − φ."""
        return self.representation.difference(target, value)

    def pose_error(self) -> PoseError:
        """Return the rows of the rotation."""
        return PoseError((3, 4, 5), self._goal, by_angles=self.angles is not None)

    def _goal(self, robot: Robot, target: Any) -> Array:
        """Return a pose with the orientation of the target."""
        T = np.eye(4)
        T[:3, :3] = self.representation.rotation(self.target(target))
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
        return ("x", "y", "z", *self.representation.names)

    row_units = ("m", "m", "m", "rad", "rad", "rad")

    def g(self, p: Array, R: Array) -> Any:
        """Return T; of formulas, its homogeneous matrix (4, 4). With angles= (p, φ), (6,)."""
        if self.angles is not None:
            return np.concatenate([p, self.representation.value(R)])
        if R.dtype == object:
            return np.vstack([np.column_stack([R, p]), [0, 0, 0, 1]])
        return pin.SE3(R, p)

    def S(self, p: Array, R: Array) -> Array:
        """Return the identity, (6, 6); with angles= diag(1, T⁻¹)."""
        angular = np.hstack([np.zeros((3, 3), dtype=int), self.representation.rates(R)])
        return np.vstack([np.eye(6, dtype=int)[:3], angular])

    def target(self, target: Any) -> Any:
        """Return the target as a `pin.SE3`; see `homogeneous`. With angles= it is (p, φ), (6,)."""
        if self.angles is not None:
            r = real_array("the target", target, (6,), "a position [m] and three angles [rad]")
            return np.concatenate([r[:3], self.representation.target(r[3:])])
        if target is None:
            raise InputError(f"the target must be {MEANING}, not None")
        return homogeneous("the target", target)

    def difference(self, target: Any, value: Any) -> Array:
        """Return (p_d − p, log3(R_d Rᵀ)), (6,) [m, rad]; with angles= (p_d − p, φ_d − φ)."""
        if self.angles is not None:
            return np.concatenate([target[:3] - value[:3], self.representation.difference(target[3:], value[3:])])
        turn = self.representation.difference(target.rotation, value.rotation)
        return np.concatenate([target.translation - value.translation, turn])

    def pose_error(self) -> PoseError:
        """Return all rows; without angles= a target is a pose."""
        by_angles = self.angles is not None
        return PoseError(tuple(range(6)), self._goal, by_angles=by_angles, takes_poses=not by_angles)

    def _goal(self, robot: Robot, target: Any) -> Array:
        """Return the pose of the target."""
        T = self.target(target)
        if self.angles is None:
            return np.asarray(T.homogeneous)
        return np.asarray(pin.SE3(self.representation.rotation(T[3:]), T[:3]).homogeneous)
