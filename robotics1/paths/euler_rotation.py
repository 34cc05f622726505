"""Orientations whose Euler angles go along a path."""

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array
from robotics1.orientation.rates import rate_map
from robotics1.orientation.sequence import EulerSequence, euler_sequence
from robotics1.paths.harmonic import line_path
from robotics1.paths.path import Path
from robotics1.paths.rotations import RotationPath


@dataclass(frozen=True, eq=False)
class EulerRotation(RotationPath):
    """R(s) = R(φ(s)): the angles of a sequence go along a path, and the axis is not fixed.

    w = Σⱼ aⱼ φⱼ' with the axes aⱼ of the three turns, of which each is carried along by those before it.

    Attributes:
        sequence: the axes.
        angles: φ(s), a path of three angles [rad].
    """

    sequence: EulerSequence
    angles: Path

    @property
    def end(self) -> float:
        """That of the path of the angles."""
        return self.angles.end

    @property
    def breaks(self) -> Array:
        """Those of the path of the angles."""
        return self.angles.breaks

    def _value(self, s: Array, side: str) -> Array:
        R = [self.sequence.turns(phi) for phi in self.angles.derivative(s, 0, side=side)]
        return np.stack([R1 @ R2 @ R3 for R1, R2, R3 in R])

    def _derivative(self, s: Array, order: int, side: str) -> Array:
        if order > 3:
            raise InputError(f"derivatives of Euler angles' rotations are known up to the third; order is {order}")
        given = [self.angles.derivative(s, k, side=side) for k in range(4)]
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


def euler_path(sequence: str, angles: Path | npt.ArrayLike, *, fixed: bool = False) -> EulerRotation:
    """Return the orientation R(φ(s)) while the angles of a sequence go along a path, such as a line.

    Args:
        sequence: three axes, such as "ZYZ", "XYZ", or "Z-YX" with an angle about −y.
        angles: a path of three angles [rad], or (2, 3): the first and the last, joined by a line.
        fixed: rotations about the axes of the fixed frame; otherwise about those that have already moved.

    Raises:
        InputError: the sequence is none, or the path is not one of three angles.
    """
    if not isinstance(angles, Path):
        first, last = real_array("angles", angles, (2, 3), "the first and the last angles [rad], or a path")
        angles = line_path(first, last)
    if angles.dimension != 3:
        raise InputError(f"angles must be a path of three angles; it has {angles.dimension} coordinates")
    return EulerRotation(euler_sequence(sequence, fixed), angles)
