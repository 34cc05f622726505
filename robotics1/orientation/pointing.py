"""Rotations that take one direction to another, and two directions to two others."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array
from robotics1.notation import joint_value
from robotics1.orientation.elementary import cross_matrix, turn, unit_vector
from robotics1.orientation.expressions import Matrix, as_matrix, expressions
from robotics1.orientation.nearest import ROUNDING, SINGULAR, rotation_of
from robotics1.results import Frozen


@dataclass(frozen=True, eq=False)
class Alignment(Frozen):
    """All rotations with R a = d: R(d, ψ) R₀ for every ψ.

    Attributes:
        rotation: R₀ (3, 3), that turns the body least: by `angle` about `axis`, from where it starts.
        axis: (3,) the unit vector of that turn, normal to both directions; None when the body points there already.
        angle: of that turn [rad], in [0, π].
        unique: whether one turn is the least; between opposite directions it is half a turn about any normal.
        direction: d, (3,), a unit vector.
    """

    rotation: Array
    axis: Array | None
    angle: float
    unique: bool
    direction: Array

    def at(self, psi: Any) -> Matrix:
        """Return R(d, ψ) R₀, (3, 3), the member of the family with a further turn ψ [rad] about d.

        Raises:
            InputError: ψ is neither a number nor an expression.
        """
        return as_matrix(turn(self.direction, expressions("psi", psi, (), "an angle [rad]")[()]) @ self.rotation)

    def explain(self) -> str:
        """Return what the two directions determine of the rotation, in a sentence."""
        family = "every R(d, ψ) R₀ aligns the axis"
        if not self.unique:
            return f"{family}; the directions are opposite: the least turn is π about any normal, such as `axis`"
        return f"{family}; R₀ turns least, by {joint_value(self.angle)}"


def align_direction(a: npt.ArrayLike, d: npt.ArrayLike, *, start: npt.ArrayLike | None = None) -> Alignment:
    """Return all rotations with R a = d, and among them the one nearest to where the body starts.

    With b = R_start a, n = b × d and c = b·d the least turn is R₀ = (1 + [n]× + [n]×²/(1 + c)) R_start, about n by the
    angle between b and d. Where c < 0 it is half a turn about n and the least turn from −b to d; if d = −b, n is any
    normal of b.

    Args:
        a: (3,) an axis of the body, in the body's frame, of any length but zero.
        d: (3,) the direction it shall have, of any length but zero.
        start: (3, 3) the body's present rotation; by default none.

    Raises:
        InputError: a or d has no direction, or start is no rotation.
    """
    a, d = unit_vector("a", a), unit_vector("d", d)
    R = np.eye(3) if start is None else rotation_of("start", start).rotation
    b = R @ a
    n, cosine = np.cross(b, d), float(b @ d)
    sine = float(np.linalg.norm(n))
    if sine <= ROUNDING and cosine > 0:
        return Alignment(_least_turn(b, d) @ R, None, 0.0, True, d)
    unique = sine > ROUNDING
    normal = n if unique else np.eye(3)[np.argmin(np.abs(b))]
    axis = unit_vector("normal", normal - (b @ normal) * b)
    R0 = _least_turn(b, d) if cosine >= 0 else _least_turn(-b, d) @ (2 * np.outer(axis, axis) - np.eye(3))
    return Alignment(R0 @ R, axis, float(np.arctan2(sine, cosine)) if unique else float(np.pi), unique, d)


@dataclass(frozen=True, eq=False)
class FrameAlignment(Frozen):
    """The rotation that takes two directions of the body to two given ones, the first exactly.

    Attributes:
        rotation: R (3, 3), with R a₁ = d₁, and R a₂ in the half plane of d₁ that holds d₂.
        misalignment: the angle between R a₂ and d₂ [rad]: that by which the angle between the axes differs from that
            between the directions.
    """

    rotation: Array
    misalignment: float

    @property
    def exact(self) -> bool:
        """Whether both are aligned, to 1e-7."""
        return self.misalignment <= 1e-7

    def explain(self) -> str:
        """Return whether one rotation aligns both axes, in a sentence."""
        if self.exact:
            return "one rotation aligns both axes"
        return (
            f"no rotation aligns both axes: the angle between them is not that between the directions; the first is "
            f"aligned, and the second is {joint_value(self.misalignment)} from its direction, the least possible"
        )


def align_two_directions(a1: npt.ArrayLike, d1: npt.ArrayLike, a2: npt.ArrayLike, d2: npt.ArrayLike) -> FrameAlignment:
    """Return the rotation with R a₁ = d₁ and R a₂ = d₂, or as near to d₂ as can be.

    R = F(d₁, d₂) F(a₁, a₂)ᵀ, where the frame F(u, v) has its x axis along u and its y axis in the half plane of v. With
    a₁ = x and a₂ = z the columns of R are the frame whose x axis is along d₁ and whose z axis is nearest to d₂.

    Args:
        a1: (3,) an axis of the body, in the body's frame.
        d1: (3,) the direction it shall have.
        a2: (3,) another axis of the body.
        d2: (3,) the direction it shall have.

    Raises:
        InputError: a vector has no direction, or two axes or two directions are parallel: then the turn about them is
            not determined, and `align_direction` gives the family.

    Source: Black, A passive system for determining the attitude of a satellite, AIAA Journal 2, 1964 (TRIAD).
    """
    body, world = _frame("a1", a1, "a2", a2), _frame("d1", d1, "d2", d2)
    R = world @ body.T
    reached, wanted = R @ unit_vector("a2", a2), unit_vector("d2", d2)
    apart = float(np.arctan2(np.linalg.norm(np.cross(reached, wanted)), reached @ wanted))
    return FrameAlignment(R, apart)


def _frame(name: str, u: npt.ArrayLike, other: str, v: npt.ArrayLike) -> Array:
    """Return the frame F(u, v), (3, 3)."""
    x, v = unit_vector(name, u), unit_vector(other, real_array(other, v, (3,), "a direction"))
    z = np.cross(x, v)
    if np.linalg.norm(z) <= SINGULAR:
        raise InputError(
            f"{name} and {other} must not be parallel, or the turn about them is not determined; "
            f"align_direction(a1, d1) gives all rotations that align one axis"
        )
    z = unit_vector("normal", z)
    return np.column_stack([x, np.cross(z, x), z])


def _least_turn(b: Array, d: Array) -> Array:
    """Return 1 + [n]× + [n]×²/(1 + c), (3, 3), n = b × d, c = b·d ≥ 0: the least turn of b to d."""
    N = cross_matrix(np.cross(b, d))
    return np.asarray(np.eye(3) + N + N @ N / (1 + b @ d))
