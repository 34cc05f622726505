"""The angles of a sequence from the rotation: in closed form, and to the last digit.

In the basis e₁, e₂, e₁ × e₂ every sequence is M = R_x(φ₁) R_y(ψ) R_x(φ₃) (see `sequence`), with

    cos ψ = M₁₁,  sin ψ = ±√(M₁₂² + M₁₃²),  φ₁ = atan2(±M₂₁, ∓M₃₁),  φ₃ = atan2(±M₁₂, ±M₁₃).
"""

import math
from typing import Any

import numpy as np

from robotics1.inputs import Array
from robotics1.orientation.expressions import angle_of, complement, root, wrapped
from robotics1.orientation.sequence import EulerSequence


def canonical(sequence: EulerSequence, R: Array) -> Array:
    """Return M, (3, 3): R R(e₂, λ) in the basis e₁, e₂, e₁ × e₂; its entries are those of R, but for their signs."""
    (e1, e2, e3), (n1, n3) = sequence.axes, sequence.normals
    M: Array = np.stack([e1, e2, n1]) @ R @ np.column_stack([e3, e2, n3])
    return M


def sine_squared(sequence: EulerSequence, R: Array) -> Any:
    """Return sin²ψ: M₁₂² + M₁₃², exact also where it is small; of expressions 1 − M₁₁², which is shorter."""
    M = canonical(sequence, R)
    return complement(M[0, 0]) if R.dtype == object else M[0, 1] ** 2 + M[0, 2] ** 2


def first_solution(sequence: EulerSequence, R: Array) -> Array:
    """Return the solution (3,) with sin φ₂ > 0 of a ZYZ or cos φ₂ > 0 of a ZYX and their like, of a regular R."""
    M, sign = canonical(sequence, R), sequence.sign
    if R.dtype == object:
        return solution_formula(sequence, M, sign, sine_squared(sequence, R))
    return completed(sequence, M, angle_of(sign * M[1, 0], -sign * M[2, 0]))


def solution_formula(sequence: EulerSequence, M: Array, sign: int, square: Any) -> Array:
    """Return the solution (3,) of an M of expressions in which sin ψ, whose square is given, has this sign."""
    sine = sign * root(square)
    first, last = angle_of(sign * M[1, 0], -sign * M[2, 0]), angle_of(sign * M[0, 1], sign * M[0, 2])
    return np.array([first, _second(sequence, sine, M[0, 0]), last], dtype=object)[sequence.order]


def completed(sequence: EulerSequence, M: Array, first: float) -> Array:
    """Return the angles (3,) whose moving φ₁ is known: the others are read from R_x(φ₁)ᵀ M = R_y(ψ) R_x(φ₃).

    So the three belong together to the last digit however small sin ψ is; where it is zero, φ₁ may have any value.
    """
    c, s = math.cos(first), math.sin(first)
    second = _second(sequence, s * M[1, 0] - c * M[2, 0], M[0, 0])
    last = angle_of(-(c * M[1, 2] + s * M[2, 2]), c * M[1, 1] + s * M[2, 1])
    return np.array([wrapped(first), second, last])[sequence.order]


def other_solution(sequence: EulerSequence, angles: Array) -> Array:
    """Return the other angles (3,) of the same rotation: ψ → −ψ, and half a turn more of the first and the last."""
    first, second, last = angles
    mirror = 0.0 if sequence.offset[0] else np.pi  # −2λ, but for whole turns
    return np.array([wrapped(first + np.pi), wrapped(mirror - second), wrapped(last + np.pi)])


def _second(sequence: EulerSequence, sine: Any, cosine: Any) -> Any:
    """Return φ₂ = ψ − λ of sin ψ and cos ψ."""
    cos_offset, sin_offset = sequence.offset
    return angle_of(sine * cos_offset - cosine * sin_offset, cosine * cos_offset + sine * sin_offset)
