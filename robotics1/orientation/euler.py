"""Rotation matrices and the angles of a sequence: Euler angles, roll-pitch-yaw, and all others."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, real_number
from robotics1.notation import joint_value
from robotics1.orientation.euler_inverse import canonical, completed, first_solution, other_solution, sine_squared
from robotics1.orientation.expressions import Matrix, angle_of, angles_in_radians, as_matrix
from robotics1.orientation.nearest import PRINTED, SINGULAR, rotation_of
from robotics1.orientation.sequence import EulerSequence, euler_sequence
from robotics1.results import Frozen


def euler_to_rotation(sequence: str, angles: Any, *, fixed: bool = False) -> Matrix:
    """Return R = R(e₁, φ₁) R(e₂, φ₂) R(e₃, φ₃), or with fixed axes R(e₃, φ₃) R(e₂, φ₂) R(e₁, φ₁).

    Args:
        sequence: three axes, such as "ZYZ", "XYZ", or "Z-YX" with an angle about −y; in small letters, as in SciPy,
            axes of the fixed frame.
        angles: (3,) [rad], in the order of the sequence: numbers give a (3, 3) array; SymPy expressions or names
            such as ("alpha", "beta", "gamma"), also among numbers, a `sympy.Matrix`.
        fixed: rotations about the axes of the fixed frame; otherwise about those that have already moved.

    Raises:
        InputError: the sequence is none, or the angles are not three numbers or expressions.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.4; Craig, Introduction to Robotics,
    appendix B.
    """
    R1, R2, R3 = euler_sequence(sequence, fixed).turns(angles_in_radians("angles", angles, (3,)))
    return as_matrix(R1 @ R2 @ R3)


@dataclass(frozen=True, eq=False)
class EulerSolutions(Frozen):
    """The angles of a sequence that give a rotation.

    Attributes:
        sequence: the axes.
        rotation: (3, 3) the rotation.
        solutions: (2, 3) [rad] in (−π, π], the first with cos φ₂ > 0 (ZYX and its like) or sin φ₂ > 0 (ZYZ and its
            like). Where the sequence is singular (1, 3): one of infinitely many, with the last angle zero.
        singular: whether the first and the last axis are parallel.
        combination: what is determined where it is singular: (1, 0, 1) is φ₁ + φ₃, (1, 0, −1) is φ₁ − φ₃; else None.
        combined: the value of that sum or difference [rad], in (−π, π]; else None.
        correction: the largest change of an entry that made a rotation of the given matrix.
    """

    sequence: EulerSequence
    rotation: Array
    solutions: Array
    singular: bool
    combination: tuple[int, int, int] | None
    combined: float | None
    correction: float

    def explain(self) -> str:
        """Return what R determines of the angles, in a sentence."""
        if self.combination is None or self.combined is None:
            return "the angles are determined: there are two solutions"
        sign = "+" if self.combination[2] > 0 else "−"
        return (
            f"singular: φ2 = {joint_value(self.solutions[0, 1])}, and of the others only "
            f"φ1 {sign} φ3 = {joint_value(self.combined)} is determined: infinitely many solutions"
        )

    def with_first(self, first: float) -> Array:
        """Return the solutions (k, 3) whose first angle has this value: one where the sequence is singular,
        otherwise those of `solutions` that have it to 1e-9, so often none.

        Raises:
            InputError: the angle is no number.
        """
        first = real_number("first", first)
        if self.combination is None or self.combined is None:
            apart = np.abs(np.exp(1j * self.solutions[:, 0]) - np.exp(1j * first))
            return np.asarray(self.solutions[apart <= SINGULAR])
        moving_first = self.combination[2] * (self.combined - first) if self.sequence.fixed else first
        return completed(self.sequence, canonical(self.sequence, self.rotation), moving_first)[None]


def rotation_to_euler(
    sequence: str, R: npt.ArrayLike, *, fixed: bool = False, tolerance: float = PRINTED
) -> EulerSolutions:
    """Return all angles (φ₁, φ₂, φ₃) of a sequence that give R: two triples, or where it is singular a family.

    The sequence is singular where the first and the last axis are parallel: cos φ₂ = 0 of a ZYX, sin φ₂ = 0 of a ZYZ.
    There only φ₁ + φ₃ or φ₁ − φ₃ is determined. A sine counts as zero where rounding, 2e-15, or the correction of R
    leaves no more of it: elsewhere both triples give R to the last digits.

    Args:
        sequence: three axes, such as "ZYZ", "XYZ", or "Z-YX" with an angle about −y.
        R: (3, 3), a rotation; one printed with four digits is projected on the nearest.
        fixed: rotations about the axes of the fixed frame; otherwise about those that have already moved.
        tolerance: the largest correction of an entry of R that is accepted.

    Raises:
        InputError: the sequence is none, or R is no rotation.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 2.4.
    """
    order = euler_sequence(sequence, fixed)
    near = rotation_of("R", R, real_number("tolerance", tolerance, non_negative=True))
    if np.sqrt(sine_squared(order, near.rotation)) > near.resolution:
        first = first_solution(order, near.rotation)
        both = np.stack([first, other_solution(order, first)])
        return EulerSolutions(order, near.rotation, both, False, None, None, near.correction)
    M = canonical(order, near.rotation)
    sign = 1 if M[0, 0] > 0 else -1  # cos ψ: the axes are parallel or opposite
    # M = R_x(φ₁ ± φ₃) R_y(ψ) of the moving angles; φ₃ ± φ₁ is ± that
    combined = angle_of(sign * M[2, 1] if fixed else M[2, 1], M[1, 1])
    one = np.array([[combined, completed(order, M, 0.0)[1], 0.0]])
    return EulerSolutions(order, near.rotation, one, True, (1, 0, sign), combined, near.correction)
