"""A sequence of three rotations about coordinate axes, moving or fixed.

Let e₁, e₂, e₃ be the axes of a moving sequence, R = R(e₁, φ₁) R(e₂, φ₂) R(e₃, φ₃). One picture holds for all of them:
e₁ and e₃ are both normal to e₂, and R(e₂, λ) takes e₁ to e₃, with λ = 0 or π for ZYZ and its like and ±π/2 for ZYX
and its like. So every sequence is R R(e₂, λ) = R(e₁, φ₁) R(e₂, ψ) R(e₁, φ₃) with ψ = φ₂ + λ, the angle from e₁ to
R e₃, and is singular where sin ψ = 0: there the first and the last axis are parallel.

A sequence about fixed axes is the moving one in reverse order.

Source: Shuster, Markley, Generalization of the Euler angles, J. Astronautical Sciences 51, 2003.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.inputs import Array, text
from robotics1.orientation.elementary import turn
from robotics1.results import Frozen


@dataclass(frozen=True, eq=False)
class EulerSequence(Frozen):
    """Three axes e₁, e₂, e₃, with e₂ normal to the others.

    Attributes:
        name: such as "ZYZ" or "Z-YX".
        fixed: whether the axes are those of the fixed frame.
        axes: (3, 3) integers, e₁, e₂, e₃ of the moving sequence as rows.
    """

    name: str
    fixed: bool
    axes: Array

    def __str__(self) -> str:
        return f"{'fixed ' if self.fixed else ''}{self.name}"

    @cached_property
    def order(self) -> slice:
        """The order of the angles in the moving sequence."""
        return slice(None, None, -1 if self.fixed else 1)

    @cached_property
    def offset(self) -> tuple[int, int]:
        """The cosine and sine of λ, the angle from e₁ to e₃ about e₂."""
        e1, e2, e3 = self.axes
        return int(e1 @ e3), int(e2 @ np.cross(e1, e3))

    @cached_property
    def sign(self) -> int:
        """The sign of sin ψ in the first solution: there cos φ₂ > 0 of a ZYX, sin φ₂ > 0 of a ZYZ."""
        return sum(self.offset)

    @cached_property
    def normals(self) -> tuple[Array, Array]:
        """e₁ × e₂ and e₃ × e₂."""
        e1, e2, e3 = self.axes
        return np.cross(e1, e2), np.cross(e3, e2)

    def turns(self, angles: Array) -> list[Array]:
        """Return R(e₁, φ₁), R(e₂, φ₂), R(e₃, φ₃), each (3, 3), of the moving sequence."""
        return [turn(axis, angle) for axis, angle in zip(self.axes, angles[self.order], strict=True)]


def euler_sequence(name: str, fixed: bool = False) -> EulerSequence:
    """Return the sequence of three axes such as "ZYZ", "XYZ" or "Z-YX"; fixed=True, or "xyz": about fixed axes.

    A minus before an axis means that the angle counts positive about its negative sense.

    Raises:
        InputError: the name is none of a sequence, or two consecutive axes are the same.
    """
    if not isinstance(fixed, bool | np.bool_):
        raise InputError(f"fixed must be True (fixed axes) or False (moving axes); it is {fixed!r}")
    name = text("sequence", name)
    return _sequence(name.upper(), True) if name.islower() else _sequence(name, bool(fixed))


@lru_cache(maxsize=256)
def _sequence(name: str, fixed: bool) -> EulerSequence:
    found = re.fullmatch("(-?[XYZ])" * 3, name)
    if not found:
        raise InputError(
            f"sequence must be three axes, such as 'ZYZ', 'XYZ' or 'Z-YX' (a minus turns the axis after it round) of "
            f"the moving frame, or in small letters, as 'xyz', of the fixed frame; it is {name!r}"
        )
    first, second, third = (axis[-1] for axis in found.groups())
    if second in (first, third):
        raise InputError(f"consecutive axes of a sequence must differ, or two of its angles add up; it is {name!r}")
    signs = [-1 if axis[0] == "-" else 1 for axis in found.groups()]
    axes = np.diag(signs) @ np.eye(3, dtype=int)[["XYZ".index(letter) for letter in (first, second, third)]]
    return EulerSequence(name, fixed, axes[:: -1 if fixed else 1])
