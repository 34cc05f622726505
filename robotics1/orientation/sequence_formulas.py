"""The formulas of a sequence of three angles: rotation, inverse, rates, singular angles."""

from dataclasses import dataclass
from typing import Any

import numpy as np
import sympy

from robotics1.caching import cached_property
from robotics1.errors import InputError
from robotics1.inputs import Array
from robotics1.orientation.euler_inverse import canonical, solution_formula
from robotics1.orientation.expressions import expressions
from robotics1.orientation.rates import lost_direction, rate_determinant, rate_map
from robotics1.orientation.sequence import EulerSequence, euler_sequence

OFFSETS = {(1, 0): sympy.S.Zero, (-1, 0): sympy.pi, (0, 1): sympy.pi / 2, (0, -1): -sympy.pi / 2}  # λ


@dataclass(frozen=True, eq=False)
class SingularAngle:
    """A value of φ₂ at which a sequence is singular.

    Attributes:
        value: of φ₂.
        rotation: (3, 3) R there.
        combination: what is determined there: φ₁ + φ₃ or φ₁ − φ₃.
        combined: its formula in the entries R11, R12, ... of R.
        lost: (3, 1) the unit vector, in world axes, along which no ω is produced there.
    """

    value: sympy.Expr
    rotation: sympy.Matrix
    combination: sympy.Expr
    combined: sympy.Expr
    lost: sympy.Matrix


@dataclass(frozen=True, eq=False)
class EulerFormulas:
    """The formulas of a sequence.

    Attributes:
        sequence: the axes.
        angles: the symbols of its three angles.
        R: (3, 3) the symbols R11, R12, ... of a rotation, in which `solutions` are written.
    """

    sequence: EulerSequence
    angles: tuple[sympy.Symbol, ...]
    R: sympy.Matrix

    @cached_property
    def rotation(self) -> sympy.Matrix:
        """R(φ), (3, 3)."""
        R1, R2, R3 = self.sequence.turns(self._phi)
        return sympy.Matrix(R1 @ R2 @ R3)

    @cached_property
    def solutions(self) -> sympy.Matrix:
        """Both triples (φ₁, φ₂, φ₃) that give R, (2, 3), where the sequence is not singular."""
        M = canonical(self.sequence, self._entries)
        square = M[0, 1] ** 2 + M[0, 2] ** 2
        signs = (self.sequence.sign, -self.sequence.sign)
        return sympy.Matrix([list(solution_formula(self.sequence, M, sign, square)) for sign in signs])

    @cached_property
    def rate_map(self) -> sympy.Matrix:
        """T(φ), (3, 3), with ω = T φ̇ in world axes."""
        return sympy.Matrix(rate_map(self.sequence, self._phi))

    @cached_property
    def body_rate_map(self) -> sympy.Matrix:
        """RᵀT, (3, 3), with Ω = RᵀT φ̇ in body axes."""
        return sympy.Matrix(rate_map(self.sequence, self._phi, "body"))

    @cached_property
    def inverse_rate_map(self) -> sympy.Matrix:
        """T⁻¹(φ), (3, 3), with φ̇ = T⁻¹ ω, ω in world axes."""
        return self.rate_map.adjugate().applyfunc(sympy.trigsimp) / self.determinant

    @cached_property
    def determinant(self) -> sympy.Expr:
        """Det T: ± cos φ₂ of ZYX and its like, ± sin φ₂ of ZYZ and its like."""
        return rate_determinant(self.sequence, self._phi)

    @cached_property
    def singular(self) -> tuple[SingularAngle, SingularAngle]:
        """The two values of φ₂ where det T = 0, and what is determined and what is lost there."""
        offset = OFFSETS[self.sequence.offset]
        return self._singular(-offset, 1), self._singular(sympy.pi - offset, -1)

    def _singular(self, value: sympy.Expr, sign: int) -> SingularAngle:
        first, second, last = self.angles
        value = sympy.pi - sympy.Mod(sympy.pi - value, 2 * sympy.pi)  # in (−π, π]
        M = canonical(self.sequence, self._entries)
        combined = sympy.atan2((sign if self.sequence.fixed else 1) * M[2, 1], M[1, 1])
        return SingularAngle(
            value=value,
            rotation=self.rotation.subs(second, value).applyfunc(sympy.trigsimp),
            combination=first + sign * last,
            combined=combined,
            lost=sympy.Matrix(lost_direction(self.sequence, self._phi)).subs(second, value),
        )

    @property
    def _phi(self) -> Array:
        return np.array(self.angles, dtype=object)

    @property
    def _entries(self) -> Array:
        return np.array(self.R, dtype=object)


def euler_formulas(sequence: str, *, angles: Any = ("phi1", "phi2", "phi3"), fixed: bool = False) -> EulerFormulas:
    """Return the formulas of a sequence: R(φ), both inverse solutions, ω = T(φ) φ̇, det T, and the singular cases.

    Args:
        sequence: three axes, such as "ZYZ", "XYZ", or "Z-YX" with an angle about −y.
        angles: the names of the three angles, or symbols.
        fixed: rotations about the axes of the fixed frame; otherwise about those that have already moved.

    Raises:
        InputError: the sequence is none, or the angles are not three different names.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, sections 2.4 and 3.6.
    """
    symbols = tuple(expressions("angles", angles, (3,), "names"))
    if len(set(symbols)) < 3 or not all(isinstance(symbol, sympy.Symbol) for symbol in symbols):
        raise InputError(f"angles must be three different names or symbols; they are {angles!r}")
    entries = sympy.Matrix(3, 3, lambda i, j: sympy.Symbol(f"R{i + 1}{j + 1}", real=True))
    return EulerFormulas(euler_sequence(sequence, fixed), symbols, entries)
