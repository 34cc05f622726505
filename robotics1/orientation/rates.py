"""The angular velocity: of a rotation that changes, [ω]× = Ṙ Rᵀ, and of the rates of angles, ω = T(φ) φ̇."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import pi
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from robotics1.inputs import Array, one_of, real_array
from robotics1.notation import joint_value, vector
from robotics1.orientation.elementary import axial_vector, turn
from robotics1.orientation.euler_inverse import sine_squared
from robotics1.orientation.expressions import (
    Matrix,
    angles_in_radians,
    as_matrix,
    cosine_and_sine,
    expressions,
    root,
    simplified,
)
from robotics1.orientation.nearest import PRINTED, SINGULAR, rotation_of
from robotics1.orientation.sequence import EulerSequence, euler_sequence
from robotics1.printed_digits import half_units, shared_half_units
from robotics1.results import Frozen

Axes = Literal["world", "body"]
AXES: tuple[Axes, ...] = get_args(Axes)
SLACK = 1e-6  # relative: how far beyond half a unit a singular angle still counts as within


def euler_rate_map(sequence: str, angles: Any, *, fixed: bool = False, reference: Axes = "world") -> Matrix:
    """Return T(φ), (3, 3), with ω = T φ̇: its columns are the axes about which the three rotations turn.

    Moving axes: T = [e₁, R₁e₂, R₁R₂e₃] in world axes, [R₃ᵀR₂ᵀe₁, R₃ᵀe₂, e₃] in the body's. With λ the angle from the
    first axis to the last about the second, det T = −sin(φ₂ + λ), and of fixed axes sin(φ₂ − λ): −cos φ₂ of ZYX and
    cos φ₂ of XYZ, moving or fixed; −sin φ₂ of moving ZYZ, sin φ₂ of fixed ZYZ.

    Args:
        sequence: three axes, such as "ZYZ", "XYZ", or "Z-YX" with an angle about −y.
        angles: (3,) [rad]: numbers give an array, SymPy expressions or names a `sympy.Matrix`.
        fixed: rotations about the axes of the fixed frame; otherwise about those that have already moved.
        reference: the axes ω is written in: "world" or "body".

    Raises:
        InputError: the sequence is none, or the angles are not three numbers or expressions.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.6.
    """
    one_of("reference", reference, AXES)
    return as_matrix(rate_map(euler_sequence(sequence, fixed), angles_in_radians("angles", angles, (3,)), reference))


def rate_map(sequence: EulerSequence, angles: Array, reference: Axes = "world") -> Array:
    """Return T, (3, 3)."""
    e1, e2, e3 = sequence.axes
    R1, R2, R3 = sequence.turns(angles)
    world = reference == "world"
    columns = [e1, R1 @ e2, R1 @ R2 @ e3] if world else [R3.T @ R2.T @ e1, R3.T @ e2, e3]
    return np.column_stack(columns[sequence.order])


def rate_determinant(sequence: EulerSequence, angles: Array) -> Any:
    """Return det T = −sin ψ; of a fixed sequence, whose columns are those of the moving one reversed, sin ψ."""
    c, s = cosine_and_sine(angles[1])
    cos_offset, sin_offset = sequence.offset
    sine = s * cos_offset + c * sin_offset
    return sine if sequence.fixed else -sine


def lost_direction(sequence: EulerSequence, angles: Array, reference: Axes = "world") -> Array:
    """Return the unit vector (3,) normal to all three axes where sin ψ = 0: no ω has a part along it."""
    (e1, _, e3), (n1, n3) = sequence.axes, sequence.normals
    first, _, last = angles[sequence.order]
    return turn(e1, first) @ n1 if reference == "world" else turn(e3, last).T @ n3


def inverse_rate_map(sequence: EulerSequence, R: Array) -> Array:
    """Return T⁻¹, (3, 3), in world axes, at the first solution of R: φ̇ = T⁻¹ ω; R may be of expressions.

    With a₁ = e₁, a₃ = R e₃ and cos ψ = a₁·a₃, the axes of T are a₁, (a₁ × a₃)/sin ψ and a₃, and the rows of T⁻¹ are
    their reciprocal basis: (a₁ − cos ψ a₃)/sin²ψ, (a₁ × a₃)/sin ψ, (a₃ − cos ψ a₁)/sin²ψ.
    """
    a1, a3 = sequence.axes[0], R @ sequence.axes[2]
    cosine, square = a1 @ a3, sine_squared(sequence, R)
    normal = sequence.sign * np.cross(a1, a3) / root(square)
    rows = [(a1 - cosine * a3) / square, normal, (a3 - cosine * a1) / square]
    return np.stack(rows[sequence.order])


@dataclass(frozen=True, eq=False)
class EulerRates(Frozen):
    """The rates of the angles that produce an angular velocity.

    Attributes:
        rates: (3,) φ̇ [rad/s]; where T is singular the shortest of those that leave the least |ω − T φ̇|.
        determinant: det T.
        singular: whether |det T| ≤ 1e-9.
        unproduced: (3,) ω − T φ̇ [rad/s], the part of ω that no rates produce; zero unless singular.
        lost: (3,) where T is singular, the unit vector along which no ω is produced; else None.
        null: (3,) where T is singular, unit rates that produce no ω; else None.
        near: where φ₂, with the digits it is given by, may be a singular angle: that angle and half a unit of the last
            digit [rad]; else None.
        at_singularity: the answer at that angle; else None.
    """

    rates: Array
    determinant: float
    singular: bool
    unproduced: Array
    lost: Array | None
    null: Array | None
    near: tuple[float, float] | None = None
    at_singularity: EulerRates | None = None

    @property
    def feasible(self) -> bool:
        """Whether the rates produce ω: |ω − T φ̇| ≤ 1e-9 max(1, |ω|), or what the digits of ω and φ leave open."""
        return not self.unproduced.any()

    def explain(self) -> str:
        """Return whether rates of the angles produce ω, in a sentence."""
        if self.near is not None and self.at_singularity is not None:
            angle, half_unit = self.near
            return (
                f"T is nearly singular: φ2 is within {half_unit:.0e} of {joint_value(angle)}, so that det T = "
                f"{self.determinant:.1e} is not more than rounding; the answer there is `at_singularity`: "
                f"{self.at_singularity.explain()}"
            )
        if self.lost is None:
            return f"det T = {self.determinant:.4g}: one φ̇ produces each ω"
        if self.feasible:
            return "T is singular, but infinitely many φ̇ produce this ω; `rates` is the shortest of them"
        return f"T is singular and no φ̇ produces this ω: no ω that it produces has a part along {vector(self.lost)}"


def euler_rates(
    sequence: str, angles: npt.ArrayLike, omega: npt.ArrayLike, *, fixed: bool = False, reference: Axes = "world"
) -> EulerRates:
    """Return the rates φ̇ = T(φ)⁻¹ ω of the angles, or where T is singular what of ω can be produced.

    Args:
        sequence: three axes, such as "ZYZ", "XYZ", or "Z-YX" with an angle about −y.
        angles: (3,) [rad]; a φ₂ such as 1.5708, whose digits may stand for a singular angle, is said to be so.
        omega: (3,) ω [rad/s].
        fixed: rotations about the axes of the fixed frame; otherwise about those that have already moved.
        reference: the axes ω is written in: "world" or "body".

    Raises:
        InputError: the sequence is none, or angles or omega are not three numbers.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.6.
    """
    order = euler_sequence(sequence, fixed)
    one_of("reference", reference, AXES)
    phi = real_array("angles", angles, (3,), "[rad]")
    omega = real_array("omega", omega, (3,), "[rad/s]")
    return rates_of(order, phi, lambda _: omega, reference, shared_half_units(omega))


def rates_of(
    order: EulerSequence, phi: Array, omega_at: Callable[[Array], Array], reference: Axes, open_digits: Array
) -> EulerRates:
    """Return the rates for ω(φ), at φ and at the singular φ that its digits may stand for.

    Args:
        order: the sequence.
        phi: (3,) as given.
        omega_at: φ → ω.
        reference: the axes of ω.
        open_digits: (3,) how far each entry of ω may be off, by its digits.
    """
    digits = half_units(phi)
    digits[1] = 0.0
    found = _rates(order, phi, omega_at(phi), reference, (open_digits, digits))
    near = None if found.singular else _singular_within_digits(order, phi)
    if near is None:
        return found
    singular = np.array([phi[0], near[0], phi[2]])
    there = _rates(order, singular, omega_at(singular), reference, (open_digits, digits))
    return replace(found, near=near, at_singularity=there)


def _singular_within_digits(order: EulerSequence, angles: Array) -> tuple[float, float] | None:
    """Return the singular φ₂ that rounds to the given one, and half a unit of its last digit; None if there is none."""
    half_unit = float(half_units(angles)[1])
    start = pi / 2 if order.offset[0] == 0 else 0.0
    singular = start + pi * round((angles[1] - start) / pi)
    return (singular, half_unit) if 0 < abs(singular - angles[1]) <= half_unit * (1 + SLACK) else None


def _rates(order: EulerSequence, angles: Array, omega: Array, reference: Axes, half: tuple[Array, Array]) -> EulerRates:
    """Return the rates for ω; a part along the lost direction that the digits of ω and φ leave open is none."""
    T, det = rate_map(order, angles, reference), float(rate_determinant(order, angles))
    if abs(det) > SINGULAR:
        return EulerRates(np.linalg.solve(T, omega), det, False, np.zeros(3), None, None)
    lost = lost_direction(order, angles, reference)
    part, size = lost @ omega, float(np.linalg.norm(omega))
    rounding = SINGULAR * max(1.0, size) + np.abs(lost) @ half[0] + half[1].max() * size
    unproduced = part * lost if abs(part) > rounding else np.zeros(3)
    null = np.array([1, 0, -np.sign(T[:, 0] @ T[:, 2])]) / np.sqrt(2)
    return EulerRates(np.linalg.pinv(T, rcond=1e-6) @ omega, det, True, unproduced, lost, null)


def angular_velocity(R: Any, R_dot: Any, *, reference: Axes = "world") -> Matrix:
    """Return ω (3,) of Ṙ = [ω]× R in world axes, or Ω = Rᵀω of Ṙ = R [Ω]× in the body's.

    Numbers give an array [rad/s], expressions a `sympy.Matrix`, simplified: with R(s) and dR/ds it is ω per unit of ṡ.

    Args:
        R: (3, 3) the rotation.
        R_dot: (3, 3) its derivative.
        reference: the axes ω is written in: "world" or "body".

    Raises:
        InputError: R is no rotation, or R_dot is not the derivative of one: Ṙ Rᵀ is not skew-symmetric.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.1.1.
    """
    one_of("reference", reference, AXES)
    R, R_dot = expressions("R", R, (3, 3)), expressions("R_dot", R_dot, (3, 3))
    if object not in (R.dtype, R_dot.dtype):
        R = rotation_of("R", R).rotation
    name, S = ("R_dot Rᵀ", R_dot @ R.T) if reference == "world" else ("Rᵀ R_dot", R.T @ R_dot)
    omega = axial_vector(name, S, PRINTED)
    return omega.applyfunc(simplified) if S.dtype == object else omega
