"""The rotation about an axis, and the skew-symmetric matrix of a vector."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import numpy.typing as npt

from robotics1.errors import InputError
from robotics1.inputs import Array, real_array
from robotics1.orientation.expressions import Matrix, as_matrix, cosine_and_sine, expressions, vanishes

SKEW = 1e-6  # |S + Sᵀ| of a matrix that is taken for skew-symmetric, relative to the larger of 1 and |S|


def cross_matrix(v: Array) -> Array:
    """Return [v]×, (3, 3): [v]× w = v × w; of numbers, or of whatever adds and subtracts."""
    x, y, z = v
    zero = x - x
    return np.array([[zero, -z, y], [z, zero, -x], [-y, x, zero]])


def turn(axis: Array, angle: Any) -> Array:
    """Return R(r, φ) = r rᵀ + cos φ (1 − r rᵀ) + sin φ [r]×, (3, 3), of a unit axis r (3,)."""
    c, s = cosine_and_sine(angle)
    along = np.outer(axis, axis)
    return np.asarray(along + c * (np.eye(3, dtype=int) - along) + s * cross_matrix(axis))


def unit_vector(name: str, v: npt.ArrayLike) -> Array:
    """Return v/|v|, (3,), of a vector of any length but zero.

    Raises:
        InputError: v is no vector of three numbers, or has no length.
    """
    v = real_array(name, v, (3,), "a direction")
    largest = float(np.abs(v).max())
    if largest == 0.0:
        raise InputError(f"{name} must have a direction; it is the zero vector")
    v = np.ldexp(v, -math.frexp(largest)[1])  # by a power of two, so that no square over- or underflows
    return np.asarray(v / np.linalg.norm(v))


def skew(v: npt.ArrayLike) -> Matrix:
    """Return S(v) = [v]×, (3, 3), of v (3,): S(v) w = v × w.

    Of SymPy expressions or names it is a `sympy.Matrix`.

    Raises:
        InputError: v is no vector of three numbers or expressions.
    """
    return as_matrix(cross_matrix(expressions("v", v, (3,))))


def vee(S: Any) -> Matrix:
    """Return the vector v (3,) of a skew-symmetric matrix S (3, 3): the inverse of `skew`.

    Raises:
        InputError: S is not skew-symmetric to within 1e-6, or, of expressions, not identically.
    """
    return axial_vector("S", expressions("S", S, (3, 3), "a skew-symmetric matrix"), SKEW)


def axial_vector(name: str, S: Array, tolerance: float) -> Matrix:
    """Return v (3,) of S = [v]×, (3, 3).

    Raises:
        InputError: |S + Sᵀ| is above the tolerance, relative to the larger of 1 and |S|; of expressions, not zero.
    """
    if S.dtype == object:
        if not all(vanishes(entry) for entry in (S + S.T)[np.triu_indices(3)]):
            raise InputError(f"{name} must be skew-symmetric; S + Sᵀ is {(S + S.T).tolist()}")
        return as_matrix(np.array([S[2, 1], S[0, 2], S[1, 0]]))
    defect = float(np.abs(S + S.T).max())
    if defect > tolerance * max(1.0, float(np.abs(S).max())):
        raise InputError(f"{name} must be skew-symmetric; |S + Sᵀ| is {defect:.1e}")
    return np.array([S[2, 1] - S[1, 2], S[0, 2] - S[2, 0], S[1, 0] - S[0, 1]]) / 2
