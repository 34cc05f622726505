"""How a task tells an orientation: by the rotation itself, or by the three angles of a sequence."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import pinocchio as pin

from robotics1.errors import InputError, TaskError
from robotics1.inputs import Array, real_array
from robotics1.orientation.euler_inverse import first_solution, other_solution, sine_squared
from robotics1.orientation.expressions import wrapped
from robotics1.orientation.nearest import SINGULAR
from robotics1.orientation.rates import inverse_rate_map, rate_determinant
from robotics1.orientation.sequence import EulerSequence, euler_sequence
from robotics1.robot.placements import rotation_matrix


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
    """Return how an orientation is told; `angles` is a sequence such as "ZYZ", or None.

    Raises:
        InputError: the sequence is none, or axes are said to be fixed without one.
    """
    if angles is not None:
        return SequenceAngles(euler_sequence(angles, fixed))
    if fixed is not False:
        raise InputError(f"fixed={fixed!r} says how angles are meant; give their sequence too, as angles='XYZ'")
    return RotationItself()
