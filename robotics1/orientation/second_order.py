"""Rotations to second order: Ṙ and R̈ of ω and ω̇, ω̇ of R̈, and the accelerations of Euler angles."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from robotics1.inputs import Array, one_of, real_array
from robotics1.orientation.elementary import axial_vector, cross_matrix
from robotics1.orientation.expressions import Matrix, angles_in_radians, as_matrix, expressions, simplified
from robotics1.orientation.nearest import PRINTED, rotation_of
from robotics1.orientation.rates import AXES, Axes, EulerRates, rate_map, rates_of
from robotics1.orientation.sequence import EulerSequence, euler_sequence
from robotics1.printed_digits import shared_half_units
from robotics1.results import Frozen


@dataclass(frozen=True, eq=False)
class RotationRates(Frozen):
    """The derivatives of a rotation matrix: arrays, or matrices in SymPy.

    Attributes:
        first: (3, 3) Ṙ.
        second: (3, 3) R̈; None without an angular acceleration.
    """

    first: Matrix
    second: Matrix | None


def rotation_rates(R: Any, omega: Any, omega_dot: Any = None, *, reference: Axes = "world") -> RotationRates:
    """Return Ṙ = S(ω) R and R̈ = (S(ω̇) + S(ω)²) R; of body axes Ṙ = R S(Ω) and R̈ = R (S(Ω̇) + S(Ω)²).

    Args:
        R: (3, 3) the rotation: numbers, or SymPy expressions and names.
        omega: (3,) the angular velocity [rad/s].
        omega_dot: (3,) the angular acceleration [rad/s²]; in body axes Ω̇, the derivative of the entries of Ω.
        reference: the axes these are written in: "world" or "body".

    Raises:
        InputError: R is no rotation, or a vector has not three numbers or expressions.

    Source: Siciliano, Sciavicco, Villani, Oriolo, Robotics, 2009, section 3.1.1.
    """
    world = one_of("reference", reference, AXES) == "world"
    R = expressions("R", R, (3, 3))
    R = R if R.dtype == object else rotation_of("R", R).rotation
    S = cross_matrix(expressions("omega", omega, (3,), "[rad/s]"))
    first = S @ R if world else R @ S
    if omega_dot is None:
        return RotationRates(as_matrix(first), None)
    turning = cross_matrix(expressions("omega_dot", omega_dot, (3,), "[rad/s²]")) + S @ S
    return RotationRates(as_matrix(first), as_matrix(turning @ R if world else R @ turning))


def angular_acceleration(R: Any, R_dot: Any, R_ddot: Any, *, reference: Axes = "world") -> Matrix:
    """Return ω̇ (3,) of R̈: S(ω̇) = R̈ Rᵀ + Ṙ Ṙᵀ in world axes; in the body's S(Ω̇) = Rᵀ R̈ + Ṙᵀ Ṙ.

    Numbers give an array [rad/s²], expressions a `sympy.Matrix`, simplified.

    Args:
        R, R_dot, R_ddot: (3, 3) the rotation and its two derivatives.
        reference: the axes ω̇ is written in: "world" or "body".

    Raises:
        InputError: R is no rotation, or the derivatives are not those of one.
    """
    world = one_of("reference", reference, AXES) == "world"
    matrices = [expressions(name, M, (3, 3)) for name, M in (("R", R), ("R_dot", R_dot), ("R_ddot", R_ddot))]
    if all(M.dtype != object for M in matrices):
        matrices[0] = rotation_of("R", matrices[0]).rotation
    R, R_dot, R_ddot = matrices
    S = R_ddot @ R.T + R_dot @ R_dot.T if world else R.T @ R_ddot + R_dot.T @ R_dot
    found = axial_vector("what R_ddot leaves beside R_dot R_dotᵀ", S, PRINTED)
    return found.applyfunc(simplified) if S.dtype == object else found


def euler_rate_map_derivative(
    sequence: str, angles: Any, rates: Any, *, fixed: bool = False, reference: Axes = "world"
) -> Matrix:
    """Return Ṫ(φ, φ̇), (3, 3), with ω̇ = T φ̈ + Ṫ φ̇.

    Each axis of T turns with the rotations before it: ȧₖ = (Σⱼ₍ⱼ<ₖ₎ φ̇ⱼ aⱼ) × aₖ in world axes, and with those after it,
    the other way round, in the body's.

    Args:
        sequence: three axes, such as "ZYZ", "XYZ", or "Z-YX" with an angle about −y.
        angles: (3,) φ [rad]: numbers give an array, SymPy expressions or names a `sympy.Matrix`.
        rates: (3,) φ̇ [rad/s].
        fixed: rotations about the axes of the fixed frame; otherwise about those that have already moved.
        reference: the axes ω is written in: "world" or "body".

    Raises:
        InputError: the sequence is none, or there are not three angles and rates.
    """
    order = euler_sequence(sequence, fixed)
    one_of("reference", reference, AXES)
    phi, phi_dot = angles_in_radians("angles", angles, (3,)), expressions("rates", rates, (3,), "[rad/s]")
    return as_matrix(_map_derivative(order, phi, phi_dot, reference))


def _map_derivative(order: EulerSequence, phi: Array, phi_dot: Array, reference: Axes) -> Array:
    axes = rate_map(order, phi, reference).T[order.order]  # a₁, a₂, a₃ of the moving sequence
    speeds = phi_dot[order.order]
    turned = []
    for k, axis in enumerate(axes):
        others = range(k) if reference == "world" else range(k + 1, 3)
        spin = sum((speeds[j] * axes[j] for j in others), 0 * axis)
        turned.append(cross_matrix(spin if reference == "world" else -spin) @ axis)
    return np.column_stack(turned[order.order])


@dataclass(frozen=True, eq=False)
class EulerAccelerations(Frozen):
    """The accelerations of a sequence's angles that give an angular acceleration, or what of it they can give.

    Attributes:
        drift: (3,) Ṫ φ̇, the part of ω̇ that the rates make [rad/s²].
        solved: φ̈ of T φ̈ = ω̇ − Ṫ φ̇, as the rates of an ω; with what is lost where T is singular.
    """

    drift: Array
    solved: EulerRates

    @property
    def accelerations(self) -> Array:
        """(3,) φ̈ [rad/s²]; where T is singular, the shortest that come nearest."""
        return self.solved.rates

    @property
    def singular(self) -> bool:
        """Whether T is singular."""
        return self.solved.singular

    def explain(self) -> str:
        """Return whether φ̈ gives the ω̇, in a sentence."""
        return self.solved.explain().replace("φ̇", "φ̈").replace("this ω", "this ω̇").replace("no ω ", "no ω̇ ")


def euler_accelerations(
    sequence: str, angles: Any, rates: Any, omega_dot: Any, *, fixed: bool = False, reference: Axes = "world"
) -> EulerAccelerations:
    """Return the accelerations φ̈ = T⁻¹ (ω̇ − Ṫ φ̇) of the angles, or where T is singular what of ω̇ can be produced.

    Args:
        sequence: three axes, such as "ZYZ", "XYZ", or "Z-YX" with an angle about −y.
        angles: (3,) φ [rad].
        rates: (3,) φ̇ [rad/s].
        omega_dot: (3,) ω̇ [rad/s²].
        fixed: rotations about the axes of the fixed frame; otherwise about those that have already moved.
        reference: the axes ω̇ is written in: "world" or "body".

    Raises:
        InputError: the sequence is none, or there are not three angles, rates and accelerations.
    """
    order = euler_sequence(sequence, fixed)
    one_of("reference", reference, AXES)
    phi, phi_dot = real_array("angles", angles, (3,), "[rad]"), real_array("rates", rates, (3,), "[rad/s]")
    wanted = real_array("omega_dot", omega_dot, (3,), "[rad/s²]")

    def drift(at: Array) -> Array:
        return _map_derivative(order, at, phi_dot, reference) @ phi_dot

    solved = rates_of(order, phi, lambda at: wanted - drift(at), reference, shared_half_units(wanted))
    return EulerAccelerations(drift(phi), solved)
